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

// Edges of silhouettes, counter-clockwise seen from the point, one body after another: what of them is in front of the cut. All are relative
// to the point.
#ifndef IN_SCRATCH
vec3 edgeStarts[SILHOUETTE_EDGES];
vec3 edgeSpans[SILHOUETTE_EDGES];
vec4 edgePlanes[SILHOUETTE_EDGES]; // unit, what the body hides in front. w: 1 where it is a face's plane, not that of the edge
#endif
int edgeCount = 0;
bool silhouetteFits; // nothing was left out since it was set

// Of the body that was gathered last.
vec3 silhouetteMiddle; // the sum of unit vectors to both ends of each edge
bool hasShortEdge; // whose plane rounding may have tilted
bool hasDropped; // planes that were false

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

void beginSilhouette()
{
    silhouetteMiddle = vec3(0.0);
    hasShortEdge = false;
    hasDropped = false;
}

const float kShortEdge2 = 4.0e-4; // squared chord between unit vectors to its ends

float chord2Of(vec3 startUnit, vec3 endUnit)
{
    vec3 chord = startUnit - endUnit;
    return dot(chord, chord);
}

vec3 unitTo(vec3 v) { return v * inversesqrt(max(dot(v, v), 1.0e-30)); }
vec3 edgeStartUnit(int edge) { return unitTo(edgeStarts[edge]); }
vec3 edgeEndUnit(int edge) { return unitTo(edgeStarts[edge] + edgeSpans[edge]); }

void addEdge(int first, vec3 start, vec3 span, vec4 plane)
{
    bool hasPlane = dot(plane.xyz, plane.xyz) > 0.0;
    bool isFull = edgeCount >= SILHOUETTE_EDGES || edgeCount - first >= SILHOUETTE_BODY_EDGES;
    silhouetteFits = silhouetteFits && !(hasPlane && isFull);
    if (!hasPlane || isFull)
        return;
    edgeStarts[edgeCount] = start;
    edgeSpans[edgeCount] = span;
    edgePlanes[edgeCount++] = plane;
    vec3 startUnit = unitTo(start), endUnit = unitTo(start + span);
    silhouetteMiddle += startUnit + endUnit;
    hasShortEdge = hasShortEdge || (chord2Of(startUnit, endUnit) < kShortEdge2 && plane.w == 0.0);
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
    const float kLeastShare = 1.0e-6; // what is left of an edge has its direction
    vec2 seen = vec2(0.0, 1.0);
    if (isCut) {
        float startHeight = dot(plane.normal, start) + plane.offset, endHeight = dot(plane.normal, start + span) + plane.offset;
        if (startHeight <= 0.0 && endHeight <= 0.0)
            return;
        seen.x = startHeight < 0.0 ? startHeight / (startHeight - endHeight) : 0.0;
        seen.y = endHeight < 0.0 ? startHeight / (startHeight - endHeight) : 1.0;
    }
    addEdge(first, start + seen.x * span, max(seen.y - seen.x, kLeastShare) * span, through);
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
        addEdge(first, start, end - start, through);
}

// Whether some of what was gathered is behind the edge's plane. Rounding tilts planes of short edges, and their neighbours bound what they
// would. Of long ones only those that run back are false.
bool isFalsePlane(int first, int edge, bool isFolded)
{
    vec4 plane = edgePlanes[edge];
    float chord2 = chord2Of(edgeStartUnit(edge), edgeEndUnit(edge)), lowest = 0.0;
    bool isShort = chord2 < kShortEdge2, isTried = (isFolded || isShort) && plane.w == 0.0; // that of a face has nothing to do with the edge
    int end = isTried ? edgeCount : first;
    for (int k = first; k < end; ++k)
        lowest = min(lowest, min(dot(plane.xyz, edgeStartUnit(k)), dot(plane.xyz, edgeEndUnit(k))));
    return lowest < -1.0e-6 && lowest * lowest > (isShort ? min(0.25 * chord2, 1.0e-9) : 1.0e-7);
}

// A mesh of floats is convex to rounding alone. The plane through a short edge tells: it goes where it cuts into the silhouette. And a
// face seen edge-on may count otherwise than its neighbours, front among backs or back among fronts: then edges run back over the others,
// with planes that leave nothing of what the body hides. One such plane has the middle of the silhouette behind it: all are tried then.
void dropFalsePlanes(int first)
{
    const float kFalse = -1.0;
    bool isFolded = false;
    for (int i = first; i < edgeCount; ++i)
        isFolded = isFolded || dot(edgePlanes[i].xyz, silhouetteMiddle) < -2.0e-6 * float(edgeCount - first);
    // Seldom, and CPU devices pay for every word: loops that go round for nobody are jumped over.
    int end = isFolded || hasShortEdge ? edgeCount : first, kept = first;
    for (int i = first; i < end; ++i) {
        bool isFalse = isFalsePlane(first, i, isFolded);
        hasDropped = hasDropped || isFalse;
        edgePlanes[i].w = isFalse ? kFalse : edgePlanes[i].w;
    }
    end = hasDropped ? edgeCount : first;
    for (int i = first; i < end; ++i) {
        vec4 plane = edgePlanes[i];
        if (plane.w == kFalse)
            continue;
        edgeStarts[kept] = edgeStarts[i];
        edgeSpans[kept] = edgeSpans[i];
        edgePlanes[kept++] = plane;
    }
    edgeCount = hasDropped ? kept : edgeCount;
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
    beginSilhouette();
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
