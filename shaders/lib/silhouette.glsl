// Convex bodies as they are seen from a point: the planes through the point that bound what they hide (methods/area-shadows.md, Guards 3
// and 4, Depth). Needs SILHOUETTE_EDGES, of all bodies together, and FACE_WORDS, a bit a face of the largest.
#ifndef LIB_SILHOUETTE_GLSL
#define LIB_SILHOUETTE_GLSL

#include "lib/bodies.glsl"

// What can be seen of the body must lie in front of this plane: dot(normal, v - point) + offset > 0.
struct CutPlane
{
    vec3 normal;
    float offset; // of the point itself; metres
};

// Edges of silhouettes, counter-clockwise seen from the point, one body after another. All are relative to the point.
#ifndef IN_SCRATCH
vec3 edgeStarts[SILHOUETTE_EDGES];
vec3 edgeSpans[SILHOUETTE_EDGES];
vec4 edgePlanes[SILHOUETTE_EDGES]; // unit, what the body hides in front. w: 1 where it is a face's plane, not that of the edge
#endif
vec3 edgeEnds[2 * SILHOUETTE_BODY_EDGES]; // unit, of the body that was gathered last: what of the edge is in front of the cut
int edgeCount = 0;
int endCount = 0; // of edgeEnds
bool silhouetteFits; // nothing was left out since it was set

uint frontFaces[FACE_WORDS]; // of the body that was looked at last; those in whose plane the point lies count as front
uint levelFaces[FACE_WORDS]; // the point lies in their plane
bool hasFaces; // some have area

float greatestHeight; // of the point over the planes of their faces, metres

// A single word is no array: CPU devices keep it in a register.
uint faceWord(uint word) { return FACE_WORDS == 1 ? 0u : word; }
bool isFront(uint face) { return (frontFaces[faceWord(face >> 5u)] >> (face & 31u) & 1u) != 0u; }
bool isLevel(uint face) { return (levelFaces[faceWord(face >> 5u)] >> (face & 31u) & 1u) != 0u; }

// Finds frontFaces, levelFaces, hasFaces and greatestHeight; whether there is any front one. `tolerance` in metres: so near its plane a
// point is level with a face. A face without area has no sides: one that counted as front would make any body open.
bool findFronts(BodyArrays arrays, BodyBlock body, vec3 point, float tolerance)
{
    bool hasFront = false;
    hasFaces = false;
    greatestHeight = -1.0e30;
    for (uint word = 0u; 32u * word < body.faceCount; ++word) {
        uint fronts = 0u, levels = 0u;
        uint count = min(body.faceCount - 32u * word, 32u);
        for (uint bit = 0u; bit < count; ++bit) {
            FaceBlock face = bodyFace(arrays, body, 32u * word + bit);
            float height = heightOver(arrays, body, face, point);
            bool hasArea = dot(face.normal, face.normal) > 0.0;
            greatestHeight = max(greatestHeight, height);
            fronts |= hasArea && height >= -tolerance ? 1u << bit : 0u;
            levels |= hasArea && abs(height) <= tolerance ? 1u << bit : 0u;
            hasFaces = hasFaces || hasArea;
        }
        frontFaces[faceWord(word)] = fronts;
        levelFaces[faceWord(word)] = levels;
        hasFront = hasFront || fronts != 0u;
    }
    return hasFront;
}

// Farther than any vertex of the body.
float reachOf(BodyBlock body, vec3 point) { return distance(body.centre, point) + body.radius; }

void addEdge(int first, vec3 start, vec3 span, vec4 plane, vec3 startSeen, vec3 endSeen)
{
    bool hasPlane = dot(plane.xyz, plane.xyz) > 0.0;
    bool isFull = edgeCount >= SILHOUETTE_EDGES || edgeCount - first >= SILHOUETTE_BODY_EDGES;
    silhouetteFits = silhouetteFits && !(hasPlane && isFull);
    if (!hasPlane || isFull)
        return;
    edgeStarts[edgeCount] = start;
    edgeSpans[edgeCount] = span;
    edgePlanes[edgeCount] = plane;
    edgeEnds[endCount++] = startSeen * inversesqrt(max(dot(startSeen, startSeen), 1.0e-30));
    edgeEnds[endCount++] = endSeen * inversesqrt(max(dot(endSeen, endSeen), 1.0e-30));
    ++edgeCount;
}

vec3 unitOrZero(vec3 v)
{
    float length2 = dot(v, v);
    return length2 > 0.0 ? v * inversesqrt(length2) : vec3(0.0);
}

// Of the plane through the point that holds `start` and `start + span`: exacter than by both ends, which may be close together.
vec3 planeThrough(vec3 start, vec3 span) { return unitOrZero(cross(start, unitOrZero(span))); }

// The edge where some of it is in front of the cut.
void addEdgeInFront(int first, vec3 start, vec3 span, vec4 through, bool isCut, CutPlane plane)
{
    vec3 end = start + span, startSeen = start, endSeen = end;
    if (isCut) {
        float startHeight = dot(plane.normal, start) + plane.offset, endHeight = dot(plane.normal, end) + plane.offset;
        if (startHeight <= 0.0 && endHeight <= 0.0)
            return;
        startSeen = startHeight < 0.0 ? start + span * (startHeight / (startHeight - endHeight)) : start;
        endSeen = endHeight < 0.0 ? end - span * (endHeight / (endHeight - startHeight)) : end;
    }
    addEdge(first, start, span, through, startSeen, endSeen);
}

void addSilhouetteEdge(int first, BodyArrays arrays, BodyBlock body, vec3 point, EdgeBlock edge, bool isCut, CutPlane plane)
{
    uint left = edge.faces & 0xffffu, right = edge.faces >> 16u;
    bool leftFront = isFront(left);
    bool rightFront = right == kNoFace ? !leftFront : isFront(right);
    if (leftFront == rightFront)
        return;
    uint front = leftFront ? left : right;
    vec3 a = bodyVertex(arrays, body, edge.vertices & 0xffffu) - point, b = bodyVertex(arrays, body, edge.vertices >> 16u) - point;
    vec3 start = leftFront ? b : a, end = leftFront ? a : b;
    vec3 span = end - start;
    // The planes of a face's edges say nothing to a point level with it; its own does.
    bool isOfFace = front != kNoFace && isLevel(front);
    vec4 through = isOfFace ? vec4(-bodyFace(arrays, body, front).normal, 1.0) : vec4(planeThrough(start, span), 0.0);
    addEdgeInFront(first, start, span, through, isCut, plane);
}

// Where a front face goes through the cut, what lies before it ends: from crossing to crossing.
void addCutFace(int first, BodyArrays arrays, BodyBlock body, vec3 point, uint index, CutPlane plane)
{
    FaceBlock face = bodyFace(arrays, body, index);
    vec3 leaving = vec3(0.0), entering = vec3(0.0);
    bool leaves = false, enters = false;
    vec3 a = bodyVertex(arrays, body, faceCorner(arrays, face, face.cornerCount - 1u)) - point;
    float aHeight = dot(plane.normal, a) + plane.offset;
    for (uint i = 0u; i < face.cornerCount; ++i) {
        vec3 b = bodyVertex(arrays, body, faceCorner(arrays, face, i)) - point;
        float bHeight = dot(plane.normal, b) + plane.offset;
        if ((aHeight > 0.0) != (bHeight > 0.0)) {
            float share = aHeight > 0.0 ? aHeight / (aHeight - bHeight) : bHeight / (bHeight - aHeight); // of the end behind
            vec3 at = aHeight > 0.0 ? mix(a, b, share) : mix(b, a, share);
            leaving = aHeight > 0.0 ? at : leaving;
            entering = aHeight > 0.0 ? entering : at;
            leaves = leaves || aHeight > 0.0;
            enters = enters || bHeight > 0.0;
        }
        a = b;
        aHeight = bHeight;
    }
    vec3 start = isFront(index) ? entering : leaving, end = isFront(index) ? leaving : entering;
    vec4 through = isLevel(index) ? vec4(-face.normal, 1.0) : vec4(planeThrough(start, end - start), 0.0);
    if (leaves && enters)
        addEdge(first, start, end - start, through, start, end);
}

// A mesh of floats is convex to rounding alone. The plane through a short edge tells: it goes where it cuts into the silhouette. And a
// face seen edge-on may count otherwise than its neighbours, front among backs or back among fronts: then edges run back over the others,
// with planes that leave nothing of what the body hides. One such plane has the middle of the silhouette behind it: all are tried then.
void dropFalsePlanes(int first)
{
    vec3 middle = vec3(0.0);
    for (int k = 0; k < endCount; ++k)
        middle += edgeEnds[k];
    bool isFolded = false;
    for (int i = first; i < edgeCount; ++i)
        isFolded = isFolded || dot(edgePlanes[i].xyz, middle) < -1.0e-6 * float(endCount);
    int kept = first;
    for (int i = first; i < edgeCount; ++i) {
        vec3 chord = edgeEnds[2 * (i - first)] - edgeEnds[2 * (i - first) + 1];
        float chord2 = dot(chord, chord), lowest = 0.0;
        bool isTried = (isFolded || chord2 < 4.0e-4) && edgePlanes[i].w == 0.0; // that of a face has nothing to do with the edge
        int count = isTried ? endCount : 0;
        for (int k = 0; k < count; ++k)
            lowest = min(lowest, dot(edgePlanes[i].xyz, edgeEnds[k]));
        // Rounding tilts planes of short edges, and their neighbours bound what they would. Of long ones only those that run back go.
        float most2 = chord2 < 4.0e-4 ? min(0.25 * chord2, 1.0e-9) : 1.0e-7;
        if (lowest < -1.0e-6 && lowest * lowest > most2)
            continue;
        if (kept < i) { // seldom, and CPU devices pay for every word
            edgeStarts[kept] = edgeStarts[i];
            edgeSpans[kept] = edgeSpans[i];
            edgePlanes[kept] = edgePlanes[i];
        }
        ++kept;
    }
    edgeCount = kept;
}

// What a body hides from a point.
const uint kHidesNothing = 0u;
const uint kHidesPart = 1u;
const uint kHidesAll = 2u; // the point is inside it

// Finds what findFronts() does.
uint hidingOf(BodyArrays arrays, BodyBlock body, vec3 point)
{
    bool isPlanar = (body.flags & kBodyPlanar) != 0u;
    bool hasFront = findFronts(arrays, body, point, 5.0e-7 * reachOf(body, point));
    if (!hasFaces)
        return kHidesNothing; // a line or a place
    if (isPlanar && (isLevel(0u) || (!hasFront && (body.flags & kBodyFrontOnly) != 0u)))
        return kHidesNothing; // edge-on, or a side that does not block
    if ((body.flags & kBodyHollow) != 0u && greatestHeight <= body.margin)
        return kHidesNothing; // what it stands for may be here
    return isPlanar || hasFront ? kHidesPart : kHidesAll;
}

// Adds the edges that bound what the body hides. None: it hides nothing. False: the point is inside it, and all is hidden.
bool addSilhouette(BodyArrays arrays, BodyBlock body, vec3 point, bool isCut, CutPlane plane)
{
    uint hiding = hidingOf(arrays, body, point);
    if (hiding != kHidesPart)
        return hiding == kHidesNothing;
    int first = edgeCount;
    endCount = 0;
    for (uint i = 0u; i < body.edgeCount; ++i)
        addSilhouetteEdge(first, arrays, body, point, BodyEdges(arrays.edges).edge[body.firstEdge + i], isCut, plane);
    if (isCut)
        for (uint i = 0u; i < body.faceCount; ++i)
            if ((body.flags & kBodyPlanar) != 0u || isFront(i))
                addCutFace(first, arrays, body, point, i, plane);
    dropFalsePlanes(first);
    return true;
}

#endif
