// A G-buffer pixel as a point in the world. Needs shared/frame.h.
#ifndef LIB_SURFACE_GLSL
#define LIB_SURFACE_GLSL

#include "lib/octahedral.glsl"

// The way from the eye to what lies `depthView` metres deep.
vec3 fromEye(FrameBlock frame, vec2 pixel, float depthView)
{
    return (frame.cornerRay + pixel.x * frame.rayX + pixel.y * frame.rayY) * depthView;
}

// `pixel` is the pixel's centre in pixels; `depth` is reversed: 1 at the near plane, 0 at infinity.
vec3 worldPosition(FrameBlock frame, vec2 pixel, float depth)
{
    return frame.eye + fromEye(frame, pixel, frame.near / depth);
}

// How far a position may be off: rounding of the depth, of the way back to the world and of the posed vertices, 2^-24 of the largest
// term each; sixteen such steps and a micrometre.
float positionError(vec3 position, vec3 eye)
{
    vec3 magnitude = abs(position) + abs(eye) + abs(position - eye);
    return 1.0e-6 * max(magnitude.x, max(magnitude.y, magnitude.z)) + 1.0e-6;
}

// Where rays leave: on the outer side of the surface, past every error. The normal is the geometric one.
vec3 rayOrigin(vec3 position, vec3 normalGeometric, vec3 eye) { return position + normalGeometric * (4.0 * positionError(position, eye)); }

// The plane through a pixel's surface, for telling which neighbours lie on it.
struct PixelPlane
{
    float alongRay; // normal . ray of the pixel
    vec2 perPixel; // its change a pixel to the right and down
    float depthView; // metres
    vec3 normal;
};

PixelPlane pixelPlane(FrameBlock frame, vec2 pixel, float depthView, vec3 normal)
{
    vec3 ray = fromEye(frame, pixel, 1.0);
    return PixelPlane(dot(normal, ray), vec2(dot(normal, frame.rayX), dot(normal, frame.rayY)), depthView, normal);
}

// 1 for a neighbour on the same plane, towards 0 off it: a half at 0.5 % of the view depth away.
float samePlane(PixelPlane plane, vec2 offset, float depthViewThere)
{
    float distance = depthViewThere * (plane.alongRay + dot(plane.perPixel, offset)) - plane.depthView * plane.alongRay;
    float off = distance * (200.0 / plane.depthView);
    return 1.0 / (1.0 + off * off * off * off);
}

// 1 for a neighbour that faces the same way, a half at 12 degrees.
float sameFacing(PixelPlane plane, vec3 normalThere)
{
    float c = max(dot(plane.normal, normalThere), 0.0);
    c *= c;
    c *= c;
    c *= c;
    c *= c;
    return c * c;
}

// 1 for a neighbour of the plane's own surface, towards 0 for another's, 0 for none, whose depth is 0; `offset` in pixels.
float likeness(PixelPlane plane, vec2 offset, float depthViewThere, vec3 normalThere)
{
    return depthViewThere > 0.0 ? samePlane(plane, offset, depthViewThere) * sameFacing(plane, normalThere) : 0.0;
}

#endif
