// The functions of shaders/lib, one at a time: the define names it, In and Out are its arguments and results.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/frame.h"
#include "shared/occlusion.h"
#include "lib/surface.glsl"
#include "lib/hemisphere.glsl"
#include "lib/sh.glsl"
#include "lib/cone.glsl"
#include "lib/disc.glsl"
#include "lib/intersect.glsl"
#include "lib/compose.glsl"
#include "lib/float21.glsl"
#include "lib/tone.glsl"
#include "lib/traced.glsl"
#include "lib/spread.glsl"
#include "lib/whole.glsl"
#define POLYGON_PLACES 3
#define POLYGON_CORNERS 40
#include "lib/cone_polygon.glsl"

#ifdef ARC_SINE

struct In { float sine; };
struct Out { float angle; };
Out evaluate(In x) { return Out(arcSine(x.sine)); }

#elif defined(ANGLE_BETWEEN)

struct In { vec3 a; vec3 b; };
struct Out { float angle; };
Out evaluate(In x) { return Out(angleBetween(x.a, x.b)); }

#elif defined(CONE_POLYGON)

// Corners are unit and counter-clockwise seen from outside; what is cut is in front of the plane and behind it.
struct In { vec3 corners[32]; uint count; vec3 plane; };
struct Out { float whole; float front; float behind; uint sides; uint frontCorners; uint behindCorners; };
Out evaluate(In x)
{
    int count = 0;
    for (uint i = 0u; i < x.count; ++i) {
        vec3 normal = cross(x.corners[i], x.corners[(i + 1u) % x.count]);
        addCorner(0, count, x.corners[i], normal.z / max(length(normal), 1.0e-30));
    }
    cornerCounts[0] = count;
    Crossing crossing = crossingOf(0, x.plane);
    uint sides = (crossing.hasFront ? 1u : 0u) | (crossing.hasBehind ? 2u : 0u);
    cut(0, crossing, 1, 2, true, true);
    return Out(formFactor(0, true), formFactor(1, true), formFactor(2, true), sides, uint(cornerCounts[1]), uint(cornerCounts[2]));
}

#elif defined(BOUNDS)

struct In { vec3 p; vec3 n; vec3 a; vec3 b; float radius; vec3 direction; };
struct ConeOut { vec3 axis; float cosine; float chord; float halfAngle; float height; uint all; uint holds; };
struct Out { ConeOut sphere; uint mayMeetCapsule; uint isBehind; uint hitsSphere; float share; };
ConeOut described(Cone cone, vec3 direction)
{
    return ConeOut(cone.axis, cone.cosine, cone.chord, cone.halfAngle, cone.height, uint(cone.all), uint(holds(cone, direction)));
}
// The sphere is the one at a.
Out evaluate(In x)
{
    Cone sphere = coneOfSphere(x.p, x.n, x.a, x.radius);
    vec3 arm = 0.5 * (x.b - x.a);
    CapsuleBound capsule = boundOfCapsule(0.5 * ((x.a - x.p) + (x.b - x.p)), arm, x.radius, x.radius + 1.0005 * length(arm) + 1.0e-6); // reach as bone_fit.comp gives it
    return Out(described(sphere, x.direction), uint(mayMeet(capsule, x.direction)), uint(isBehind(x.p, x.n, x.a, x.radius)),
               uint(hitsSphere(x.p, x.direction, x.a, x.radius)), greatestShare(sphere, x.n));
}

#elif defined(DISC)

struct In { vec3 toCentre; float radius; vec3 normal; };
struct Out { vec3 vector; float cut; };
Out evaluate(In x)
{
    vec3 vector = discVector(x.toCentre, x.radius);
    return Out(vector, cutFormFactor(vector, x.normal));
}

#elif defined(TRACED_PIXEL)

// What surfaces lack, one that faces as it does and another.
struct In { vec3 irradiance; vec3 towards; vec3 normal; vec3 otherNormal; float depthView; uint cones; };
struct Out { vec3 own; vec3 other; vec3 normal; float depthView; uint cones; };
Out evaluate(In x)
{
    float sum = x.irradiance.r + x.irradiance.g + x.irradiance.b;
    TracedPixel t = unpackTraced(packTraced(
        TracedPixel(hiddenVector(sum, x.towards, x.normal), tintOf(x.irradiance), x.cones, kNoBlocker, x.depthView, x.normal)));
    return Out(coloured(lackedBy(x.normal, t.hidden), t.tint), coloured(lackedBy(x.otherNormal, t.hidden), t.tint), t.normal, t.depthView,
               t.cones);
}

#elif defined(SPREAD_ROW)

struct In { uint row; uint rows; };
struct Out { uint row; };
Out evaluate(In x) { return Out(spreadRow(x.row, x.rows)); }

#elif defined(WHOLE_OF)

struct In { vec3 value; };
struct Out { ivec3 whole; };
Out evaluate(In x) { return Out(wholeOf(x.value)); }

#elif defined(OCTAHEDRAL)

struct In { vec3 direction; };
struct Out { vec2 square; vec3 direction; };
Out evaluate(In x)
{
    vec2 square = octahedralFromUnit(x.direction);
    return Out(square, unitFromOctahedral(square));
}

#elif defined(TANGENT_FRAME)

struct In { vec3 normal; float radians; };
struct Out { vec3 x; vec3 y; vec3 z; };
Out evaluate(In x)
{
    mat3 frame = turnedFrame(x.normal, x.radians);
    return Out(frame[0], frame[1], frame[2]);
}

#elif defined(HAMMERSLEY)

struct In { uint i; uint count; };
struct Out { vec3 direction; };
Out evaluate(In x) { return Out(cosineHammersley(x.i, x.count, 0.5)); }

#elif defined(SH_BASIS)

struct In { vec3 direction; };
struct Out { float basis[25]; };
Out evaluate(In x)
{
    Out result;
    shBasis5(x.direction, result.basis);
    return result;
}

#elif defined(FLOATS_21)

struct In { vec3 value; };
struct Out { vec3 value; };
Out evaluate(In x) { return Out(unpackFloats21(packFloats21(x.value))); }

#elif defined(RAY_ORIGIN)

struct In { vec3 position; vec3 normal; vec3 eye; };
struct Out { vec3 origin; float error; };
Out evaluate(In x) { return Out(rayOrigin(x.position, x.normal, x.eye), positionError(x.position, x.eye)); }

#elif defined(COMPOSE)

struct In { vec3 firstTerm; vec3 occluded; };
struct Out { vec3 shadowed; uint isClamped; };
Out evaluate(In x) { return Out(shadowedIrradiance(x.firstTerm, x.occluded), uint(isClamped(x.firstTerm, x.occluded))); }

#elif defined(TONE)

struct In { vec3 radiance; };
struct Out { vec3 mapped; vec3 encoded; };
Out evaluate(In x)
{
    vec3 mapped = toneMapped(x.radiance);
    return Out(mapped, srgbEncoded(mapped));
}

#endif

layout(buffer_reference, scalar) readonly buffer Inputs { In value[]; };
layout(buffer_reference, scalar) writeonly buffer Outputs { Out value[]; };
layout(push_constant, scalar) uniform Push
{
    uint64_t inputs;
    uint64_t outputs;
    uint count;
} pc;

layout(local_size_x = 64) in;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < pc.count)
        Outputs(pc.outputs).value[i] = evaluate(Inputs(pc.inputs).value[i]);
}
