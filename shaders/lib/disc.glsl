// What a level disc is worth as a light: form factors. Up is +Y.
#ifndef LIB_DISC_GLSL
#define LIB_DISC_GLSL

#include "lib/angle.glsl"

// The vector form factor of a disc that faces up: its length is the form factor, 0..1, of a surface that faces along it, and its product with
// a normal that of a surface which all of the disc is in front of. `toCentre` is the disc's from the point; nothing for points below the disc.
// Howell's catalogue of configuration factors, C-20 and C-21, written so that nothing cancels.
vec3 discVector(vec3 toCentre, float radius)
{
    float height = max(-toCentre.y, 0.0), aside = length(toCentre.xz);
    float scale = 1.0 / max(max(height, aside), max(radius, 1.0e-30)); // only ratios count, and their squares are floats
    height *= scale;
    aside *= scale;
    radius *= scale;
    float height2 = height * height, radius2 = radius * radius;
    float nearRim = length(vec2(height, aside - radius)), farRim = length(vec2(height, aside + radius));
    float rims = max(nearRim * farRim, 1.0e-18); // nothing on the rim alone
    float beside = (aside - radius) * (aside + radius) + height2; // negative within the sphere about the disc
    float down = beside > 0.0 ? 2.0 * radius2 * height2 / (rims * (rims + beside)) : 0.5 - 0.5 * beside / rims;
    float outward = 2.0 * height * radius2 * scale / (rims * max(rims + height2 + aside * aside + radius2, 1.0e-18));
    return vec3(outward * toCentre.x, height > 0.0 ? -down : 0.0, outward * toCentre.z);
}

// The form factor, for a surface with that normal, of what has such a vector, cut by the surface's horizon: as a sphere would be that has the
// same (Snyder 1996, "Area light sources for real-time graphics"; Hill and Heitz 2016 use it for polygons).
float cutFormFactor(vec3 vector, vec3 normal)
{
    float sine2 = min(length(vector), 1.0); // of the sphere's half angle
    float cosine = clamp(dot(vector, normal) / max(sine2, 1.0e-30), -1.0, 1.0);
    float sine = sqrt(sine2), tilt = sqrt(max(1.0 - cosine * cosine, 0.0));
    if (cosine >= sine || cosine <= -sine)
        return sine2 * max(cosine, 0.0);
    // Where the horizon cuts the sphere's rim, as seen along the normal. Neither quotient has a divisor of zero: |cosine| < sine <= 1.
    float cotangent = sqrt(max(1.0 - sine2, 0.0)) / sine;
    float rim = clamp(-cotangent * cosine / tilt, -1.0, 1.0);
    float across = tilt * sqrt(max(1.0 - rim * rim, 0.0));
    float share = (cosine * acos(rim) - cotangent * across) * sine2 + (across > 0.0 ? atan(across, cotangent) : 0.0);
    return max(share, 0.0) / (2.0 * kHalfPi);
}

#endif
