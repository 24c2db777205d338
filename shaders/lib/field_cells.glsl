// How much of a light of any outline is seen past a signed distance field: its outline is divided into cells, each with a cone of its own;
// the nearest edge in a cone cuts its cell, and what is left is integrated by Lambert's formula (Ban, Balint, Valasek 2020, section 4.2,
// without its samples; methods/sdf-cones.md, Lights of any shape). The approximation: one straight edge a cell. Needs lib/field_cone.glsl
// and lib/cone_polygon.glsl, with kCellPlaces places.
#ifndef LIB_FIELD_CELLS_GLSL
#define LIB_FIELD_CELLS_GLSL

const int kCellPlaces = 6;
const int kCellLight = 0; // the whole, then what is left of it; takes turns with the next
const int kCellStrip = 2; // the same of a strip
const int kCell = 4;
const int kCellSeen = 5;

// A light as a point sees it.
struct CellLight
{
    vec3 point;
    float distanceHere; // of the field
    mat3 frame; // tangent, bitangent, normal of the surface: polygons have z along the normal
    vec4 plane; // where the light is: dot(xyz, way from the point) = w; unit, w >= 0
};

// A corner of the outline and the next, both relative to the point; corners run as lib/cone_polygon.glsl has them. To place kCellLight + 1.
void addCellCorner(mat3 frame, inout int count, vec3 corner, vec3 next)
{
    vec3 a = normalize(corner * frame), plane = cross(a, normalize(next * frame) - a);
    addCorner(kCellLight + 1, count, a, plane.z * inversesqrt(max(dot(plane, plane), 1.0e-30)));
}

// Where a division's planes are: the direction c + x e1 + y e2 has the coordinates x and y.
struct CellGrid
{
    mat3 axes; // e1, e2, c
    vec2 lowest;
    vec2 highest;
    uvec2 cells;
};

vec3 polygonMiddle(int place)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < cornerCounts[place]; ++i)
        sum += polygonCorners[place * POLYGON_CORNERS + i].xyz;
    return sum * inversesqrt(max(dot(sum, sum), 1.0e-30));
}

vec2 cellCoordinates(vec3 direction, mat3 axes) { return (direction * axes).xy / max(dot(direction, axes[2]), 0.05); }

// Along the polygon's longest edge and across it, as many of each as make the cells squarest.
CellGrid cellGrid(int place, uint count)
{
    vec3 middle = polygonMiddle(place);
    mat3 axes = tangentFrame(middle);
    vec2 along = vec2(1.0, 0.0);
    float longest2 = 0.0;
    vec2 a = cellCoordinates(polygonCorners[place * POLYGON_CORNERS].xyz, axes);
    for (int i = 0; i < cornerCounts[place]; ++i) {
        vec2 b = cellCoordinates(polygonCorners[place * POLYGON_CORNERS + (i + 1 < cornerCounts[place] ? i + 1 : 0)].xyz, axes);
        float length2 = dot(b - a, b - a);
        along = length2 > longest2 ? (b - a) * inversesqrt(length2) : along;
        longest2 = max(longest2, length2);
        a = b;
    }
    axes = mat3(axes[0] * along.x + axes[1] * along.y, axes[1] * along.x - axes[0] * along.y, middle);
    CellGrid grid = CellGrid(axes, vec2(1.0e9), vec2(-1.0e9), uvec2(1u, count));
    for (int i = 0; i < cornerCounts[place]; ++i) {
        vec2 at = cellCoordinates(polygonCorners[place * POLYGON_CORNERS + i].xyz, axes);
        grid.lowest = min(grid.lowest, at);
        grid.highest = max(grid.highest, at);
    }
    vec2 extent = grid.highest - grid.lowest;
    float least = 1.0e30;
    for (uint across = 1u; across <= count; ++across) {
        float longest = max(extent.x / float(across), extent.y / float(count / across));
        bool isSquarer = count % across == 0u && longest < least;
        grid.cells = isSquarer ? uvec2(across, count / across) : grid.cells;
        least = isSquarer ? longest : least;
    }
    return grid;
}

// The cone that holds the polygon, and how far along its axis no ball in it goes past the light's plane.
FieldCone coneOfPolygon(CellLight light, int place, out float end)
{
    vec3 middle = polygonMiddle(place);
    float cosine = 1.0;
    for (int i = 0; i < cornerCounts[place]; ++i)
        cosine = min(cosine, dot(middle, polygonCorners[place * POLYGON_CORNERS + i].xyz));
    float sine = min(sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0)), 0.95);
    vec3 axis = light.frame * middle;
    float facing = max(dot(light.plane.xyz, axis), 1.0e-4), distanceLight = light.plane.w / facing;
    end = light.plane.w / (facing + sine);
    return coneToSphere(light.point, axis, max(distanceLight, 1.0e-6), distanceLight * sine, 0.0);
}

// Through the apex and the edge that the cone meets at its narrowest; unit, what is clear in front.
vec3 edgePlane(FieldCone cone, FieldMarch march, FieldSlope slope)
{
    vec3 across = slope.across * inversesqrt(max(dot(slope.across, slope.across), 1.0e-12));
    vec3 plane = across * march.at + cone.axis * (march.distance / slope.greatest);
    return plane * inversesqrt(max(dot(plane, plane), 1.0e-30));
}

// The form factor of what is seen of the polygon at kCell, `whole` all of it, where the cone that holds the light met what it found.
float cellSeen(FieldsBlock fields, CellLight light, FieldCone wide, FieldMarch found, float whole)
{
    float end;
    FieldCone cone = coneOfPolygon(light, kCell, end);
    FieldMarch march = marchPart(fields, cone, wide, found, end, light.distanceHere);
    if (march.least >= 1.0 || march.least <= -1.0)
        return march.least > 0.0 ? whole : 0.0;
    FieldSlope slope = slopeAcross(fields, cone.apex + cone.axis * march.at, tangentFrame(cone.axis), march.distance,
                                   kSlopeNudge * radiusAt(cone, march.at), false);
    cut(kCell, crossingOf(kCell, edgePlane(cone, march, slope) * light.frame), kCellSeen, kCell, false, true);
    float seen = clamp(formFactor(kCellSeen, true), 0.0, whole);
    return mix(march.least > 0.0 ? whole : 0.0, seen, edgeCertainty(slope));
}

// Share of the light's form factor that is seen; 1 where none of it is over the horizon. After addCellCorner for each corner,
// whose count is that of place kCellLight + 1.
float cellVisibility(FieldsBlock fields, vec3 p, mat3 frame, vec4 plane, uint count)
{
    cut(kCellLight + 1, crossingOf(kCellLight + 1, vec3(0.0, 0.0, 1.0)), kCellLight, kCell, false, true);
    float distanceHere = fieldDistance(fields, p);
    if (cornerCounts[kCellLight] < 3 || !(distanceHere > 0.0))
        return distanceHere > 0.0 ? 1.0 : 0.0;
    CellLight light = CellLight(p, distanceHere, frame, plane);
    float end;
    FieldCone cone = coneOfPolygon(light, kCellLight, end);
    // Cones about cells may stand out of the one about the light.
    fields = fieldsInCone(fields, FieldCone(p, cone.axis, cone.radius, min(1.2 * cone.slope, 0.9999)), 1.2 * end);
    FieldMarch march = marchCone(fields, cone, vec2(0.0, end), distanceHere, farthestDistance(fields, p), kWideTolerance);
    if (march.least >= 1.0 || march.least <= -1.0)
        return march.least > 0.0 ? 1.0 : 0.0;
    CellGrid grid = cellGrid(kCellLight, count);
    vec2 step = (grid.highest - grid.lowest) / vec2(grid.cells);
    int rest = kCellLight;
    float seen = 0.0, all = 0.0;
    for (uint i = 0u; i < grid.cells.x; ++i) {
        float x = i + 1u < grid.cells.x ? grid.lowest.x + step.x * float(i + 1u) : 1.0e6;
        cut(rest, crossingOf(rest, normalize(grid.axes[0] - grid.axes[2] * x)), kCellLight + 1 - rest, kCellStrip, true, true);
        rest = kCellLight + 1 - rest;
        int strip = kCellStrip;
        for (uint j = 0u; j < grid.cells.y; ++j) {
            float y = j + 1u < grid.cells.y ? grid.lowest.y + step.y * float(j + 1u) : 1.0e6;
            int next = 2 * kCellStrip + 1 - strip;
            cut(strip, crossingOf(strip, normalize(grid.axes[1] - grid.axes[2] * y)), next, kCell, true, true);
            strip = next;
            float whole = clamp(formFactor(kCell, true), 0.0, 1.0);
            if (whole > 0.0)
                seen += cellSeen(fields, light, cone, march, whole);
            all += whole;
        }
    }
    return all > 0.0 ? clamp(seen / all, 0.0, 1.0) : 1.0;
}

#endif
