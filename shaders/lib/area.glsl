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
    int uncutCount = 0;
    for (int i = 0; i < outlineCount; ++i) {
        vec3 corner = lobe * outline[i], next = lobe * outline[i + 1 < outlineCount ? i + 1 : 0];
        addCorner(kUncut, uncutCount, unitOrZero(corner), planeThrough(corner, next - corner).z);
    }
    cornerCounts[kUncut] = uncutCount;
    cut(kUncut, crossingOf(kUncut, vec3(0.0, 0.0, 1.0)), kCutOnce, kUncut, false, true);
    for (int i = 0; i < cornerCounts[kCutOnce]; ++i)
        polygonCorners[kCutOnce * POLYGON_CORNERS + i].z = max(polygonCorners[kCutOnce * POLYGON_CORNERS + i].z, 0.0);
    cut(kCutOnce, crossingOf(kCutOnce, horizon), 0, kUncut, false, true);
}

// Places of polygons that hold none, a bit each.
const int kPlaceWords = (kFrames + 33) / 32; // two are for what is being cut
uint freePlaces[kPlaceWords];

int takePlace()
{
    int word = 0;
    for (int i = 1; i < kPlaceWords; ++i)
        word = freePlaces[word] == 0u ? i : word;
    int place = 32 * word + findLSB(freePlaces[word]);
    freePlaces[word] &= freePlaces[word] - 1u;
    return place;
}

void givePlace(int place) { freePlaces[kPlaceWords == 1 ? 0 : place / 32] |= 1u << uint(place % 32); }

const int kNowhere = -1; // no place

// The place of the polygon's part that the occluder hides, which is `place` itself where all is hidden; kNowhere: none is. Not `fits`: the
// part needs more corners than there are.
int findHidden(int place, int occluder, out bool fits)
{
    int from = place, next = takePlace(), other = takePlace(), end = occluderEnd[occluder];
    bool isHit = true;
    fits = true;
    for (int edge = occluderFirst[occluder]; edge < end && isHit; ++edge) {
        Crossing crossing = crossingOf(from, lobePlanes[edge]);
        fits = fits && (!isCut(crossing) || hasRoomForCut(from));
        cut(from, crossing, next, other, false, isCut(crossing));
        if (isCut(crossing)) {
            from = next;
            next = other;
            other = from;
        }
        isHit = crossing.hasFront && cornerCounts[from] > 0;
    }
    givePlace(next);
    if (!isHit || from == place)
        givePlace(other);
    return isHit ? from : kNowhere;
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

// The search: polygons of light, each with the occluders that are still to be taken from it.
struct Frame
{
    int place; // kNowhere: there is none left
    bool isTaken; // away from what is seen, instead of added to it
    int occluder; // the next one, or the one that is being split by
    int edge; // the next edge to split by; -1: none is
};

// Those that wait, a word each: CPU devices pay for every word that threads find at places of their own. From bit 0 the place, from 7 the
// occluder, from 17 the edge and one, in 31 whether it is taken.
#if POLYGON_PLACES > 1 << 7 || AREA_OCCLUDERS >= 1 << 10 || SILHOUETTE_EDGES >= 1 << 14
#error "a frame does not fit its word"
#endif
uint frames[kFrames];
int frameCount;

void pushFrame(Frame frame)
{
    frames[frameCount++] = uint(frame.place) | uint(frame.occluder) << 7u | uint(frame.edge + 1) << 17u | uint(frame.isTaken) << 31u;
}

// Done with a frame: the next.
Frame nextFrame(Frame frame)
{
    givePlace(frame.place);
    if (frameCount == 0)
        return Frame(kNowhere, false, 0, -1);
    uint word = frames[--frameCount];
    return Frame(int(word & 0x7fu), word >> 31u != 0u, int(word >> 7u & 0x3ffu), int(word >> 17u & 0x3fffu) - 1);
}

// Goes on splitting by the frame's occluder; returns the frame to go on with.
Frame splitFurther(Frame frame)
{
    if (frame.edge == occluderEnd[frame.occluder] || cornerCounts[frame.place] == 0)
        return nextFrame(frame); // what is left is hidden
    Crossing crossing = crossingOf(frame.place, lobePlanes[frame.edge]);
    ++frame.edge;
    if (!crossing.hasBehind)
        return frame;
    Frame outside = Frame(frame.place, frame.isTaken, frame.occluder + 1, -1);
    if (!crossing.hasFront)
        return outside; // all of it
    int before = frame.place;
    frame.place = takePlace();
    outside.place = takePlace();
    cut(before, crossing, frame.place, outside.place, true, true);
    givePlace(before);
    if (cornerCounts[outside.place] == 0) {
        givePlace(outside.place);
        return frame;
    }
    pushFrame(frame);
    return outside;
}

#ifdef TWO_LOBES

// Variant: a second lobe sees the light past the same occluders. Its transform takes directions from the first one's space; what is left
// of the light is found once, and integrated for both.
mat3 secondLobe;
AreaShare secondShare;

float secondFormFactor(int place, bool isWanted)
{
    const int kUncut = POLYGON_PLACES - 2, kAbove = POLYGON_PLACES - 1;
    int count = isWanted ? cornerCounts[place] : 0, base = place * POLYGON_CORNERS, uncutCount = 0;
    vec3 corner = secondLobe * polygonCorners[base].xyz;
    for (int i = 0; i < count; ++i) {
        vec3 next = secondLobe * polygonCorners[base + (i + 1 < count ? i + 1 : 0)].xyz;
        addCorner(kUncut, uncutCount, unitOrZero(corner), planeThrough(corner, next - corner).z);
        corner = next;
    }
    cornerCounts[kUncut] = uncutCount;
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
    for (int i = 0; i < kPlaceWords; ++i)
        freePlaces[i] = 0xffffffffu;
    freePlaces[0] = 0xfffffffeu;
    frameCount = 0;
    Frame frame = Frame(cornerCounts[0] > 0 ? 0 : kNowhere, false, 0, -1);
    while (frame.place != kNowhere) {
        bool isFull = frameCount + 1 >= kFrames || !hasRoomForCut(frame.place) || found.pieces >= mostPieces;
#if AREA_SIGNED < AREA_OCCLUDERS
        if (frame.edge >= 0 && !isFull) {
            frame = splitFurther(frame);
            isSplit = true;
            continue;
        }
#endif
        int occluder = frame.occluder, hidden = kNowhere;
        while (occluder < occluderCount && hidden == kNowhere && !isFull) {
            bool fits;
            hidden = findHidden(frame.place, occluder, fits);
            isFull = !fits;
            occluder += hidden == kNowhere ? 1 : 0;
        }
        bool isHit = hidden != kNowhere && !isFull;
        if (isHit && hidden == frame.place) {
            frame = nextFrame(frame); // all of it is hidden
            continue;
        }
        bool goesOn = isHit && occluderCount - occluder > 1;
        if (isHit && occluderCount - occluder > AREA_SIGNED) {
            frame.occluder = occluder;
            frame.edge = occluderFirst[occluder];
            givePlace(hidden);
        } else if (goesOn) {
            // Few are left: what is hidden is taken away again, which makes fewer pieces than splitting around it.
            pushFrame(Frame(frame.place, frame.isTaken, occluder + 1, -1));
            frame = Frame(hidden, !frame.isTaken, occluder + 1, -1);
        } else {
            float share = (isFull ? sampledShare(frame.place, frame.occluder) : 1.0) * (frame.isTaken ? -1.0 : 1.0);
            bool isKnown = frameCount == 0 && !isSplit;
            int taken = isHit ? hidden : frame.place;
            float whole = isKnown ? found.unoccluded : formFactor(frame.place, !isKnown);
            found.visible += share * (whole - formFactor(taken, isHit));
#ifdef TWO_LOBES
            whole = isKnown ? secondShare.unoccluded : secondFormFactor(frame.place, !isKnown);
            secondShare.visible += share * (whole - secondFormFactor(taken, isHit));
#endif
#ifdef PIECES_ARE_TOLD
            tellPiece(frame.place);
#endif
            found.fallbacks += isFull ? 1u : 0u;
            found.pieces += isHit ? 2u : 1u;
            if (hidden != kNowhere)
                givePlace(hidden);
            frame = nextFrame(frame);
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
