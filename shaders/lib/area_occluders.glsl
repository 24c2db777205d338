// What stands before an area light as a point sees it: the silhouettes that may meet the light's outline (methods/area-shadows.md, Depth).
// Needs what lib/light_outline.glsl needs, and AREA_OCCLUDERS. Variant TRIANGLES: past the triangles that face the point one by one (KT et
// al. 2021, section 4.4); splits of cones need not know that they share edges.
#ifndef LIB_AREA_OCCLUDERS_GLSL
#define LIB_AREA_OCCLUDERS_GLSL

#include "lib/light_outline.glsl"
#ifdef TRIANGLES
#include "lib/triangles.glsl"
#endif

// Occluders: silhouettes that may meet the outline, as ranges of edges.
int occluderFirst[AREA_OCCLUDERS];
int occluderEnd[AREA_OCCLUDERS];
int occluderCount = 0;
bool isAllHidden;
bool isOccluderLost; // more than fit
int mostPlanes = SILHOUETTE_BODY_EDGES; // of an occluder

// Whether the light shines on the point at all. Forgets the occluders of the light before.
bool beginLight(BodyArrays arrays, BodyBlock light, vec3 point)
{
    edgeCount = 0;
    occluderCount = 0;
    isAllHidden = false;
    isOccluderLost = false;
    findOutline(arrays, light, point);
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

// Whether the silhouette that was gathered last, from `first` on, lies behind one of the outline's planes: two convex cones that do not meet
// are parted by a plane of one of them. Of edges that were dropped nobody knows.
bool outlineMissesSilhouette(int first)
{
    bool misses = false;
    for (int i = 0; i < outlineCount && !misses; ++i) {
        vec3 plane = outlinePlanes[i];
        bool isBehind = !hasDropped && dot(plane, plane) > 0.0;
        for (int k = first; k < edgeCount && isBehind; ++k)
            isBehind = max(dot(plane, edgeStartUnit(k)), dot(plane, edgeEndUnit(k))) <= -kPartingPlane;
        misses = isBehind;
    }
    return misses;
}

void swapEdges(int a, int b)
{
    vec3 start = edgeStarts[a], span = edgeSpans[a];
    vec4 plane = edgePlanes[a];
    edgeStarts[a] = edgeStarts[b];
    edgeSpans[a] = edgeSpans[b];
    edgePlanes[a] = edgePlanes[b];
    edgeStarts[b] = start;
    edgeSpans[b] = span;
    edgePlanes[b] = plane;
}

// Of the silhouette that was gathered last, from `first` on, at most mostPlanes edges, evenly around: what they bound is more than the body
// hides.
int endOfFewer(int first)
{
    int kept = min(edgeCount - first, mostPlanes);
    if (kept == edgeCount - first)
        return edgeCount;
    vec3 middle = unitOrZero(silhouetteMiddle);
    vec3 across = unitOrZero(edgePlanes[first].xyz - middle * dot(middle, edgePlanes[first].xyz)), beside = cross(middle, across);
    for (int i = 0; i < kept; ++i) {
        float turn = 6.28318531 * float(i) / float(kept), most = -2.0;
        vec3 wanted = across * cos(turn) + beside * sin(turn);
        int best = first + i;
        for (int k = first + i; k < edgeCount; ++k) {
            float like = dot(edgePlanes[k].xyz, wanted);
            best = like > most ? k : best;
            most = max(most, like);
        }
        swapEdges(first + i, best);
    }
    return first + kept;
}

// What the edges from `first` on bound is an occluder, unless it cannot meet the light.
void keepOccluder(int first)
{
    bool misses = silhouetteFits && edgeCount == first, covers = silhouetteFits && edgeCount > first;
    for (int i = first; i < edgeCount && !misses; ++i) {
        uint sides = sidesOfOutline(edgePlanes[i].xyz);
        misses = (sides & 1u) == 0u;
        covers = covers && (sides & 2u) == 0u;
    }
    isAllHidden = isAllHidden || (covers && !misses);
    misses = misses || (silhouetteFits && outlineMissesSilhouette(first));
    bool fits = silhouetteFits && occluderCount < AREA_OCCLUDERS;
    isOccluderLost = isOccluderLost || (!misses && !fits);
    edgeCount = misses || !fits ? first : endOfFewer(first);
    if (misses || !fits)
        return;
    occluderFirst[occluderCount] = first;
    occluderEnd[occluderCount++] = edgeCount;
}

// What the body hides, or what of it lies in front of the plane.
void addOccluderPart(BodyArrays arrays, BodyBlock body, vec3 point, bool isCut, CutPlane plane)
{
    silhouetteFits = body.faceCount <= 32u * FACE_WORDS;
#ifdef TRIANGLES
    isOccluderLost = isOccluderLost || !silhouetteFits;
    uint hiding = silhouetteFits ? hidingOf(arrays, body, point) : kHidesNothing;
    isAllHidden = isAllHidden || hiding == kHidesAll;
    uint count = hiding == kHidesPart ? body.faceCount : 0u;
    for (uint i = 0u; i < count; ++i) {
        FaceBlock face = bodyFace(arrays, body, i);
        uint triangles = hidesByFace(body, face, i) ? face.cornerCount - 2u : 0u;
        for (uint k = 0u; k < triangles; ++k) {
            int first = edgeCount;
            silhouetteFits = true;
            addTriangle(first, arrays, body, point, face, i, k, isCut, plane);
            keepOccluder(first);
        }
    }
#else
    int first = edgeCount;
    if (silhouetteFits)
        isAllHidden = !addSilhouette(arrays, body, point, isCut, plane) || isAllHidden;
    keepOccluder(first);
#endif
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

// As a surface meets it.
BodyBlock occluderBefore(BodyArrays arrays, uint index, bool isMoving)
{
    BodyBlock body = Bodies(arrays.bodies).body[index];
    bool isSolid = (body.flags & kBodySkin) != 0u && !isMoving;
    body.flags &= isSolid ? ~kBodyHollow : ~0u;
    return body;
}

// What lies before the light hides it: all of the body where it is in front of one face that is seen, else what is in front of each.
void addOccluder(BodyArrays arrays, BodyBlock light, BodyBlock body, vec3 point)
{
    const CutPlane kNoCut = CutPlane(vec3(0.0), 0.0);
#if defined(TRIANGLES)
    const bool isOneFace = true; // of the light, and it is seen
    uint firstFace = litFace, endFace = litFace + 1u;
#elif defined(PLANAR_LIGHTS)
    const bool isOneFace = true;
    const uint firstFace = 0u, endFace = 1u;
#else
    bool isOneFace = (light.flags & kBodyPlanar) != 0u;
    uint firstFace = 0u, endFace = light.faceCount;
#endif
    bool isWhole = false;
    for (uint i = firstFace; i < endFace && !isWhole; ++i) {
        FaceBlock face = bodyFace(arrays, light, i);
        isWhole = (isOneFace || seesFace(arrays, light, face, point, 1.0)) &&
                  placeOfBody(arrays, body, point, planeOfFace(arrays, light, face, point)) == kInFrontOfPlane;
    }
    // One call: the search for a silhouette stands in the program once, for CPU devices.
    uint end = isWhole ? firstFace + 1u : endFace;
    for (uint i = firstFace; i < end; ++i) {
        FaceBlock face = bodyFace(arrays, light, i);
        CutPlane plane = isWhole ? kNoCut : planeOfFace(arrays, light, face, point);
        bool isPart = isWhole || ((isOneFace || seesFace(arrays, light, face, point, 1.0)) &&
                                  placeOfBody(arrays, body, point, plane) == kAcrossPlane);
        if (isPart)
            addOccluderPart(arrays, body, point, !isWhole, plane);
    }
}

#endif
