// An area light as a point sees it: the outline of its cone. Needs what lib/cone_polygon.glsl and lib/silhouette.glsl need, OUTLINE_CORNERS
// of a light seen from a point, LIGHT_VERTICES of a light's body. Variants: PLANAR_LIGHTS alone; TRIANGLES: one face of the light at a time.
#ifndef LIB_LIGHT_OUTLINE_GLSL
#define LIB_LIGHT_OUTLINE_GLSL

#include "lib/cone_polygon.glsl"
#include "lib/silhouette.glsl"

// The light's outline, counter-clockwise, relative to the point, and the planes through its edges: unit, the light in front.
vec3 outline[OUTLINE_CORNERS];
vec3 outlinePlanes[OUTLINE_CORNERS]; // zero where the edge is shorter than 0.02 rad: its plane would be rounding
int outlineCount = 0;
bool isLightFlipped; // planar, and seen from behind
bool isLightLost; // it has more corners than fit: some are left out, or all

#ifdef TRIANGLES
uint litFace = 0u; // of the light
#endif

void addOutlineCorner(vec3 corner)
{
    if (outlineCount < OUTLINE_CORNERS)
        outline[outlineCount++] = corner;
}

void findFaceOutline(BodyArrays arrays, BodyBlock light, uint index, vec3 point)
{
    FaceBlock face = bodyFace(arrays, light, index);
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
        frontFaces[faceWord(word)] = 0u;
    for (uint i = 0u; i < light.faceCount; ++i)
        frontFaces[faceWord(i >> 5u)] |= seesFace(arrays, light, bodyFace(arrays, light, i), point, 1.0) ? 1u << (i & 31u) : 0u;
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
    isLightLost = edges > OUTLINE_CORNERS;
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

// Of what of the light the point sees; none: nothing.
void findOutline(BodyArrays arrays, BodyBlock light, vec3 point)
{
    outlineCount = 0;
    isLightFlipped = false;
    isLightLost = false;
#ifdef TRIANGLES
    findFaceOutline(arrays, light, litFace, point);
#else
    if ((light.flags & kBodyPlanar) != 0u)
        findFaceOutline(arrays, light, 0u, point);
    else
        findSolidOutline(arrays, light, point);
#endif
    for (int i = 0; i < outlineCount; ++i) {
        vec3 start = unitOrZero(outline[i]), chord = unitOrZero(outline[i + 1 < outlineCount ? i + 1 : 0]) - start;
        outlinePlanes[i] = dot(chord, chord) > 4.0e-4 ? planeThrough(start, chord) : vec3(0.0);
    }
}

#endif
