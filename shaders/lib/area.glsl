// How much of an area light's reflection reaches a point past convex bodies, in closed form: KT, Sakurikar, Narayanan 2021 on linearly
// transformed cosines (Heitz et al. 2016, eq. 3 to 5), with splits of convex cones in place of the paper's set difference
// (methods/area-shadows.md). Needs what lib/area_occluders.glsl needs, and AREA_SIGNED: so few occluders are left, or fewer, where light is not
// split around them. Variant PIECES_ARE_TOLD calls tellPiece() for every polygon that is left: with AREA_SIGNED 0 those are what is seen.
// A lobe's linear transform takes directions to a space where it is the clamped cosine about +Z.
#ifndef LIB_AREA_GLSL
#define LIB_AREA_GLSL

#include "lib/area_occluders.glsl"

#ifdef PIECES_ARE_TOLD
void tellPiece(int place);
#endif

#ifdef TWO_LOBES
const int kFrames = POLYGON_PLACES - 4; // of the search below; the other places are scratch
#else
const int kFrames = POLYGON_PLACES - 2;
#endif

// Shares of the lobe's whole: 0 <= visible <= unoccluded <= 1.
struct AreaShare
{
    float unoccluded;
    float visible;
    uint pieces; // polygons that were integrated
    uint fallbacks; // of them, what was left to samples
};

// The planes of the edges in the lobe's space.
#ifndef IN_SCRATCH
vec3 lobePlanes[SILHOUETTE_EDGES];
#endif

vec3 lobePlane(int edge, mat3 lobe, mat3 lobeOfPlanes)
{
    vec4 plane = edgePlanes[edge];
    // The vectors themselves keep the digits that a plane of nearly parallel ones would lose in a narrow lobe.
    return plane.w > 0.0 ? unitOrZero(lobeOfPlanes * plane.xyz) : planeThrough(lobe * edgeStarts[edge], lobe * edgeSpans[edge]);
}

// The light's polygon in the lobe's space to place 0, cut by the lobe's horizon and the true one.
void placeLight(mat3 lobe, vec3 horizon)
{
    const int kUncut = 1, kCutOnce = 2;
    beginPolygon(kUncut);
    for (int i = 0; i < outlineCount; ++i) {
        vec3 corner = lobe * outline[i], next = lobe * outline[i + 1 < outlineCount ? i + 1 : 0];
        addCorner(kUncut, unitOrZero(corner), planeThrough(corner, next - corner).z);
    }
    cut(kUncut, crossingOf(kUncut, vec3(0.0, 0.0, 1.0)), kCutOnce, kUncut, false, true);
    for (int i = 0; i < cornerCounts[kCutOnce]; ++i)
        polygonCorners[kCutOnce * POLYGON_CORNERS + i].z = max(polygonCorners[kCutOnce * POLYGON_CORNERS + i].z, 0.0);
    cut(kCutOnce, crossingOf(kCutOnce, horizon), 0, kUncut, false, true);
}

// The search: polygons of light, each with the occluders that are still to be taken from it.
int framePlace[kFrames];
float frameSign[kFrames];
int frameOccluder[kFrames]; // the next one, or the one that is being split by
int frameEdge[kFrames]; // the next edge to split by; -1: none is
int scratchA, scratchB;
bool hiddenFits;

// The part of the polygon that the occluder hides, in scratchA; whether there is any. Both scratch places may change names. Where the part
// needs more corners than there are, hiddenFits gets false.
bool findHidden(int place, int occluder)
{
    int from = place;
    bool isHit = true;
    hiddenFits = true;
    for (int edge = occluderFirst[occluder]; edge < occluderEnd[occluder] && isHit; ++edge) {
        Crossing crossing = crossingOf(from, lobePlanes[edge]);
        hiddenFits = hiddenFits && (!isCut(crossing) || hasRoomForCut(from));
        cut(from, crossing, scratchB, scratchA, false, isCut(crossing));
        if (isCut(crossing)) {
            int made = scratchB;
            scratchB = scratchA;
            scratchA = made;
            from = scratchA;
        }
        isHit = crossing.hasFront && cornerCounts[from] > 0;
    }
    if (from == place)
        cornerCounts[scratchA] = 0; // all of it is hidden
    return isHit;
}

bool isInsideOccluder(vec3 direction, int occluder)
{
    bool isInside = true;
    for (int edge = occluderFirst[occluder]; edge < occluderEnd[occluder]; ++edge)
        isInside = isInside && dot(lobePlanes[edge], direction) > 0.0;
    return isInside;
}

// Share of the polygon's form factor that the occluders from `first` on leave, by points on the flat triangles of its corners.
float sampledShare(int place, int first)
{
    const int kSamples = 8; // a triangle
    float seen = 0.0, all = 1.0e-30; // never zero
    vec3 a = polygonCorners[place * POLYGON_CORNERS].xyz;
    for (int i = 1; i + 1 < cornerCounts[place]; ++i) {
        vec3 b = polygonCorners[place * POLYGON_CORNERS + i].xyz, c = polygonCorners[place * POLYGON_CORNERS + i + 1].xyz;
        float turn = abs(dot(a, cross(b - a, c - a))); // of the triangle's area and its distance
        for (int k = 0; k < kSamples; ++k) {
            float u = sqrt((float(k) + 0.5) / float(kSamples)), v = float(bitfieldReverse(uint(k))) * 2.3283064365386963e-10;
            vec3 at = a * (1.0 - u) + b * (u * (1.0 - v)) + c * (u * v);
            float distance2 = dot(at, at);
            float weight = turn * max(at.z, 0.0) / (distance2 * distance2);
            bool isHidden = false;
            for (int occluder = first; occluder < occluderCount; ++occluder)
                isHidden = isHidden || isInsideOccluder(at, occluder);
            seen += isHidden ? 0.0 : weight;
            all += weight;
        }
    }
    return seen / all;
}

// Goes on with the frame at the top; returns the frame that is the top then.
int splitFurther(int top)
{
    int place = framePlace[top], occluder = frameOccluder[top], edge = frameEdge[top];
    if (edge == occluderEnd[occluder] || cornerCounts[place] == 0)
        return top - 1; // what is left is hidden
    Crossing crossing = crossingOf(place, lobePlanes[edge]);
    frameEdge[top] = edge + 1;
    if (!crossing.hasBehind)
        return top;
    if (!crossing.hasFront) {
        frameOccluder[top] = occluder + 1; // all of it is outside
        frameEdge[top] = -1;
        return top;
    }
    int outside = framePlace[top + 1];
    cut(place, crossing, scratchA, outside, true, true);
    framePlace[top] = scratchA;
    scratchA = place;
    frameSign[top + 1] = frameSign[top];
    frameOccluder[top + 1] = occluder + 1;
    frameEdge[top + 1] = -1;
    return cornerCounts[outside] > 0 ? top + 1 : top;
}

#ifdef TWO_LOBES

// Variant: a second lobe sees the light past the same occluders. Its transform takes directions from the first one's space; what is left
// of the light is found once, and integrated for both.
mat3 secondLobe;
AreaShare secondShare;

float secondFormFactor(int place, bool isWanted)
{
    const int kUncut = POLYGON_PLACES - 2, kAbove = POLYGON_PLACES - 1;
    int count = isWanted ? cornerCounts[place] : 0, base = place * POLYGON_CORNERS;
    beginPolygon(kUncut);
    vec3 corner = secondLobe * polygonCorners[base].xyz;
    for (int i = 0; i < count; ++i) {
        vec3 next = secondLobe * polygonCorners[base + (i + 1 < count ? i + 1 : 0)].xyz;
        addCorner(kUncut, unitOrZero(corner), planeThrough(corner, next - corner).z);
        corner = next;
    }
    Crossing horizon = crossingOf(kUncut, vec3(0.0, 0.0, 1.0));
    cut(kUncut, horizon, kAbove, kUncut, false, isCut(horizon));
    return formFactor(isCut(horizon) ? kAbove : kUncut, isWanted && horizon.hasFront);
}

#endif

// Of the polygon at place 0. One that the point nearly lies in rounds to anything.
float wholeShare() { return clamp(formFactor(0, true), 0.0, 1.0); }

// What rounding leaves of nothing is nothing, so that an umbra is black. Corners are off by 6e-8, in narrow lobes by many times that, along
// an outline as long as the root of the light's share.
float withoutRounding(float visible, float unoccluded)
{
    float rounding = min(1.0e-6 * sqrt(unoccluded), 1.0e-3 * unoccluded);
    return visible > rounding ? min(visible, unoccluded) : 0.0;
}

// The form factor of what the occluders leave of the polygon at place 0. `mostPieces`: the rest is left to samples.
AreaShare visibleShare(uint mostPieces)
{
    AreaShare found = AreaShare(wholeShare(), 0.0, 1u, 0u);
#ifdef TWO_LOBES
    secondShare = AreaShare(clamp(secondFormFactor(0, true), 0.0, 1.0), 0.0, 0u, 0u);
#endif
    bool isSplit = false; // the light itself
    for (int i = 0; i < kFrames; ++i)
        framePlace[i] = i;
    scratchA = kFrames;
    scratchB = kFrames + 1;
    frameSign[0] = 1.0;
    frameOccluder[0] = 0;
    frameEdge[0] = -1;
    int top = cornerCounts[0] > 0 ? 0 : -1;
    while (top >= 0) {
        int place = framePlace[top];
        bool isFull = top + 1 >= kFrames || !hasRoomForCut(place) || found.pieces >= mostPieces;
#if AREA_SIGNED < AREA_OCCLUDERS
        if (frameEdge[top] >= 0 && !isFull) {
            top = splitFurther(top);
            isSplit = true;
            continue;
        }
#endif
        int occluder = frameOccluder[top];
        bool isHit = false;
        while (occluder < occluderCount && !isHit && !isFull) {
            isHit = findHidden(place, occluder);
            isFull = !hiddenFits;
            occluder += isHit ? 0 : 1;
        }
        isHit = isHit && !isFull;
        if (isHit && cornerCounts[scratchA] == 0) {
            --top; // all of it is hidden
        } else if (isHit && occluderCount - occluder > AREA_SIGNED) {
            frameOccluder[top] = occluder;
            frameEdge[top] = occluderFirst[occluder];
        } else {
            // Few are left: what is hidden is taken away again, which makes fewer pieces than splitting around it.
            bool goesOn = isHit && occluderCount - occluder > 1;
            if (goesOn) {
                int hidden = scratchA;
                scratchA = framePlace[top + 1];
                framePlace[top + 1] = hidden;
                frameSign[top + 1] = -frameSign[top];
                frameOccluder[top] = occluder + 1;
                frameOccluder[top + 1] = occluder + 1;
                frameEdge[top] = -1;
                frameEdge[top + 1] = -1;
                ++top;
                continue;
            }
            float share = isFull ? sampledShare(place, frameOccluder[top]) : 1.0;
            bool isKnown = top == 0 && !isSplit;
            float whole = isKnown ? found.unoccluded : formFactor(place, !isKnown);
            found.visible += frameSign[top] * share * (whole - formFactor(scratchA, isHit));
#ifdef TWO_LOBES
            whole = isKnown ? secondShare.unoccluded : secondFormFactor(place, !isKnown);
            secondShare.visible += frameSign[top] * share * (whole - secondFormFactor(scratchA, isHit));
#endif
#ifdef PIECES_ARE_TOLD
            tellPiece(place);
#endif
            found.fallbacks += isFull ? 1u : 0u;
            found.pieces += isHit ? 2u : 1u;
            --top;
        }
    }
    found.visible = withoutRounding(found.visible, found.unoccluded);
#ifdef TWO_LOBES
    secondShare.visible = withoutRounding(secondShare.visible, secondShare.unoccluded);
#endif
    return found;
}

// After beginLight and addOccluder. `lobe` takes world directions to the lobe's space; `normal` is the surface's.
AreaShare areaShare(mat3 lobe, vec3 normal, uint mostPieces)
{
    mat3 lobeOfPlanes = transpose(inverse(lobe));
    for (int i = 0; i < edgeCount; ++i)
        lobePlanes[i] = lobePlane(i, lobe, lobeOfPlanes);
    placeLight(lobe, unitOrZero(lobeOfPlanes * normal));
#ifdef TWO_LOBES
    secondShare = AreaShare(0.0, 0.0, 0u, 0u);
#endif
    return isAllHidden ? AreaShare(wholeShare(), 0.0, 1u, 0u) : visibleShare(mostPieces);
}

#endif
