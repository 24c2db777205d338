// An area light and what stands before it as a point sees them: the light's outline, and the silhouettes that may meet it
// (methods/area-shadows.md, Depth). Needs what lib/cone_polygon.glsl and lib/silhouette.glsl need, OUTLINE_CORNERS of a light seen from a point,
// LIGHT_VERTICES of a light's body, and AREA_OCCLUDERS.
#ifndef LIB_AREA_OCCLUDERS_GLSL
#define LIB_AREA_OCCLUDERS_GLSL

#include "lib/cone_polygon.glsl"
#include "lib/silhouette.glsl"

// The light's outline, counter-clockwise, relative to the point, and the planes through its edges: unit, the light in front.
vec3 outline[OUTLINE_CORNERS];
vec3 outlinePlanes[OUTLINE_CORNERS]; // zero where the edge is shorter than 0.02 rad: its plane would be rounding
int outlineCount = 0;
bool isLightFlipped; // planar, and seen from behind
bool isLightLost; // it has more corners than fit: some are left out, or all

// Occluders: silhouettes that may meet the outline, as ranges of edges.
int occluderFirst[AREA_OCCLUDERS];
int occluderEnd[AREA_OCCLUDERS];
int occluderCount = 0;
bool isAllHidden;
bool isOccluderLost; // more than fit

// A side of the light counts as seen only from a ten-millionth of the distance on.
bool seesFace(BodyArrays arrays, BodyBlock light, FaceBlock face, vec3 point, float side)
{
    vec3 from = point - bodyVertex(arrays, light, faceCorner(arrays, face, 0u));
    return side * dot(face.normal, from) > 1.0e-7 * length(from);
}

void addOutlineCorner(vec3 corner)
{
    if (outlineCount < OUTLINE_CORNERS)
        outline[outlineCount++] = corner;
}

void findPlanarOutline(BodyArrays arrays, BodyBlock light, vec3 point)
{
    FaceBlock face = bodyFace(arrays, light, 0u);
    bool isFromFront = seesFace(arrays, light, face, point, 1.0);
    isLightFlipped = !isFromFront && (light.flags & kBodyTwoSided) != 0u && seesFace(arrays, light, face, point, -1.0);
    uint all = isFromFront || isLightFlipped ? face.cornerCount : 0u, count = min(all, OUTLINE_CORNERS);
    isLightLost = count < all;
    for (uint i = 0u; i < count; ++i) {
        uint corner = i * all / count; // of too many, some all around
        addOutlineCorner(bodyVertex(arrays, light, faceCorner(arrays, face, isLightFlipped ? corner : all - 1u - corner)) - point);
    }
}

#ifndef PLANAR_LIGHTS
// Whether an outline of directions is wider than a millionth of its length. That of a line is not: its corners are in no order, and a plane
// through it finds more of them on either side than a polygon has.
bool isOutlineWide()
{
    float area = 0.0, longest2 = 0.0;
    for (int i = 1; i + 1 < outlineCount; ++i) {
        vec3 span = outline[i] - outline[0], next = outline[i + 1] - outline[0];
        area += dot(outline[0], cross(span, next));
        longest2 = max(longest2, max(dot(span, span), dot(next, next)));
    }
    return abs(area) > 1.0e-6 * longest2;
}

// The edge of the cone around directions in no order: from the outermost on, always to that which leaves no other outside. For silhouettes
// that are not one loop: faces without area, or seen edge-on, may count otherwise than their neighbours.
void wrapOutline(BodyArrays arrays, BodyBlock light, vec3 point, uint vertices[LIGHT_VERTICES], int count)
{
    vec3 middle = unitOrZero(light.centre - point);
    vec3 first = vec3(0.0);
    float leastCosine = 2.0;
    for (int i = 0; i < count; ++i) {
        vec3 direction = unitOrZero(bodyVertex(arrays, light, vertices[i]) - point);
        first = dot(direction, middle) < leastCosine ? direction : first;
        leastCosine = min(leastCosine, dot(direction, middle));
    }
    vec3 corner = first;
    int seen = -1; // where the corner is in the outline
    while (seen < 0 && outlineCount < min(count, OUTLINE_CORNERS)) {
        addOutlineCorner(corner);
        vec3 next = corner, plane = vec3(0.0);
        for (int i = 0; i < count; ++i) {
            vec3 direction = unitOrZero(bodyVertex(arrays, light, vertices[i]) - point);
            vec3 span = direction - corner;
            bool isApart = dot(span, span) > 1.0e-13; // else the plane is nothing but rounding
            if (isApart && (plane == vec3(0.0) || dot(plane, direction) < 0.0)) {
                next = direction;
                plane = planeThrough(corner, span);
            }
        }
        corner = next;
        for (int i = 0; i < outlineCount; ++i)
            seen = outline[i] == corner ? i : seen;
    }
    // The first ones need not be corners, where all are nearly in one line.
    for (int i = 0; seen > 0 && i + seen < outlineCount; ++i)
        outline[i] = outline[i + seen];
    outlineCount -= max(seen, 0);
    outlineCount = isOutlineWide() ? outlineCount : 0;
}
#endif

// Of a closed body: the edges between faces that are seen and faces that are not, one after another.
void findSolidOutline(BodyArrays arrays, BodyBlock light, vec3 point)
{
#ifndef PLANAR_LIGHTS
    isLightLost = light.vertexCount > LIGHT_VERTICES || light.faceCount > 32u * FACE_WORDS;
    if (isLightLost)
        return;
    for (uint word = 0u; word < FACE_WORDS; ++word)
        frontFaces[word] = 0u;
    for (uint i = 0u; i < light.faceCount; ++i)
        frontFaces[i >> 5u] |= seesFace(arrays, light, bodyFace(arrays, light, i), point, 1.0) ? 1u << (i & 31u) : 0u;
    uint next[LIGHT_VERTICES], starts[LIGHT_VERTICES];
    int edges = 0;
    for (uint i = 0u; i < light.edgeCount && edges < LIGHT_VERTICES; ++i) {
        EdgeBlock edge = BodyEdges(arrays.edges).edge[light.firstEdge + i];
        uint a = edge.vertices & 0xffffu, b = edge.vertices >> 16u;
        bool leftFront = isFront(edge.faces & 0xffffu), rightFront = isFront(edge.faces >> 16u);
        if (leftFront != rightFront) {
            starts[edges] = leftFront ? b : a;
            next[starts[edges++]] = leftFront ? a : b;
        }
    }
    if (edges == 0)
        return;
    bool isComplete = edges < LIGHT_VERTICES; // else some corners may have no next one
    uint vertex = starts[0];
    do {
        addOutlineCorner(bodyVertex(arrays, light, vertex) - point);
        vertex = isComplete ? next[vertex] : vertex;
    } while (vertex != starts[0] && outlineCount < min(edges, OUTLINE_CORNERS));
    if (outlineCount != edges || vertex != starts[0]) {
        outlineCount = 0;
        wrapOutline(arrays, light, point, starts, edges);
    }
#endif
}

// Whether the light shines on the point at all. Forgets the occluders of the light before.
bool beginLight(BodyArrays arrays, BodyBlock light, vec3 point)
{
    outlineCount = 0;
    isLightFlipped = false;
    isLightLost = false;
    edgeCount = 0;
    occluderCount = 0;
    isAllHidden = false;
    isOccluderLost = false;
    if ((light.flags & kBodyPlanar) != 0u)
        findPlanarOutline(arrays, light, point);
    else
        findSolidOutline(arrays, light, point);
    for (int i = 0; i < outlineCount; ++i) {
        vec3 start = unitOrZero(outline[i]), chord = unitOrZero(outline[i + 1 < outlineCount ? i + 1 : 0]) - start;
        outlinePlanes[i] = dot(chord, chord) > 4.0e-4 ? planeThrough(start, chord) : vec3(0.0);
    }
    return outlineCount >= 3;
}

const float kPartingPlane = 1.0e-5; // past what rounding tilts the plane of such an edge by

// Whether the body's sphere meets the cone of the light, as far as its planes tell. After beginLight.
bool mayHide(BodyBlock body, vec3 point)
{
    vec3 to = body.centre - point;
    float least = -1.0001 * body.radius - kPartingPlane * length(to);
    bool may = true;
    for (int i = 0; i < outlineCount; ++i)
        may = may && dot(outlinePlanes[i], to) >= least;
    return may;
}

// Which sides of the plane the outline's corners are on: bit 0: some is in front, bit 1: some is behind.
uint sidesOfOutline(vec3 plane)
{
    uint sides = 0u;
    for (int i = 0; i < outlineCount; ++i) {
        float side = dot(plane, outline[i]), onPlane = kOnPlane * length(outline[i]);
        sides |= side > onPlane ? 1u : side < -onPlane ? 2u : 0u;
    }
    return sides;
}

// Whether the silhouette that was gathered last lies behind one of the outline's planes: two convex cones that do not meet are parted by a
// plane of one of them.
bool outlineMissesSilhouette()
{
    bool misses = false;
    for (int i = 0; i < outlineCount && !misses; ++i) {
        bool isBehind = dot(outlinePlanes[i], outlinePlanes[i]) > 0.0;
        for (int k = 0; k < endCount && isBehind; ++k)
            isBehind = dot(outlinePlanes[i], edgeEnds[k]) <= -kPartingPlane;
        misses = isBehind;
    }
    return misses;
}

// The silhouette of the body, or of what of it lies in front of the plane, unless it cannot meet the light.
void addOccluderPart(BodyArrays arrays, BodyBlock body, vec3 point, bool isCut, CutPlane plane)
{
    int first = edgeCount;
    silhouetteFits = body.faceCount <= 32u * FACE_WORDS;
    if (silhouetteFits)
        isAllHidden = !addSilhouette(arrays, body, point, isCut, plane) || isAllHidden;
    bool misses = silhouetteFits && edgeCount == first, covers = silhouetteFits && edgeCount > first;
    for (int i = first; i < edgeCount && !misses; ++i) {
        uint sides = sidesOfOutline(edgePlanes[i].xyz);
        misses = (sides & 1u) == 0u;
        covers = covers && (sides & 2u) == 0u;
    }
    isAllHidden = isAllHidden || (covers && !misses);
    misses = misses || (silhouetteFits && outlineMissesSilhouette());
    bool fits = silhouetteFits && occluderCount < AREA_OCCLUDERS;
    isOccluderLost = isOccluderLost || (!misses && !fits);
    if (misses || !fits) {
        edgeCount = first;
        return;
    }
    occluderFirst[occluderCount] = first;
    occluderEnd[occluderCount++] = edgeCount;
}

// Where a body is with regard to a plane that ends what counts of it.
const uint kBehindPlane = 0u;
const uint kAcrossPlane = 1u;
const uint kInFrontOfPlane = 2u;

uint placeOfBody(BodyArrays arrays, BodyBlock body, vec3 point, CutPlane plane)
{
    float centreHeight = dot(plane.normal, body.centre - point) + plane.offset;
    if (abs(centreHeight) > body.radius)
        return centreHeight > 0.0 ? kInFrontOfPlane : kBehindPlane;
    float tolerance = 5.0e-7 * reachOf(body, point); // of vertices that were rounded, and of a normal
    bool isWhole = true, hasPart = false;
    for (uint i = 0u; i < body.vertexCount; ++i) {
        float height = dot(plane.normal, bodyVertex(arrays, body, i) - point) + plane.offset;
        isWhole = isWhole && height >= -tolerance;
        hasPart = hasPart || height > tolerance;
    }
    return !hasPart ? kBehindPlane : isWhole ? kInFrontOfPlane : kAcrossPlane;
}

CutPlane planeOfFace(BodyArrays arrays, BodyBlock light, FaceBlock face, vec3 point)
{
    float height = heightOver(arrays, light, face, point);
    return isLightFlipped ? CutPlane(-face.normal, -height) : CutPlane(face.normal, height);
}

// What lies before the light hides it: all of the body where it is in front of one face that is seen, else what is in front of each.
void addOccluder(BodyArrays arrays, BodyBlock light, BodyBlock body, vec3 point)
{
    const CutPlane kNoCut = CutPlane(vec3(0.0), 0.0);
#ifdef PLANAR_LIGHTS
    const bool isPlanar = true;
#else
    bool isPlanar = (light.flags & kBodyPlanar) != 0u;
#endif
    uint faceCount = isPlanar ? 1u : light.faceCount;
    bool isWhole = false;
    for (uint i = 0u; i < faceCount && !isWhole; ++i) {
        FaceBlock face = bodyFace(arrays, light, i);
        isWhole = (isPlanar || seesFace(arrays, light, face, point, 1.0)) &&
                  placeOfBody(arrays, body, point, planeOfFace(arrays, light, face, point)) == kInFrontOfPlane;
    }
    // One call: the search for a silhouette stands in the program once, for CPU devices.
    uint count = isWhole ? 1u : faceCount;
    for (uint i = 0u; i < count; ++i) {
        FaceBlock face = bodyFace(arrays, light, i);
        CutPlane plane = isWhole ? kNoCut : planeOfFace(arrays, light, face, point);
        bool isPart = isWhole || ((isPlanar || seesFace(arrays, light, face, point, 1.0)) &&
                                  placeOfBody(arrays, body, point, plane) == kAcrossPlane);
        if (isPart)
            addOccluderPart(arrays, body, point, !isWhole, plane);
    }
}

#endif
