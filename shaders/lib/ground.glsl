// Light that the ground below a character would send up and, shadowed by it, does not. Needs shared/occlusion.h.
#ifndef LIB_GROUND_GLSL
#define LIB_GROUND_GLSL

#include "lib/disc.glsl"

layout(buffer_reference, scalar) readonly buffer Grounds { GroundBlock block[]; };

// Each ring ends three times as far out as the one in it; where the outermost does, the shadow of a ball at height h has fallen to a tenth.
float innermostRing(float sphereRadius, float height) { return 2.0 * max(sphereRadius, height) * pow(3.0, 1.0 - float(kGroundRings)); }

// Share of what the ground does not send up that a place misses: beyond the character's sphere other things may stand in between, so that
// it fades away.
float nearnessTo(GroundBlock ground, vec3 position)
{
    float away = distance(position, ground.centre + vec3(0.0, ground.height, 0.0));
    return clamp(2.0 - away / max(ground.radius, 1.0e-30), 0.0, 1.0); // scaled to nothing, a character has no radius
}

// The irradiance that a surface at the point misses, W/m^2.
vec3 missedFromGround(uint64_t grounds, uint count, vec3 position, vec3 normal)
{
    vec3 missed = vec3(0.0);
    for (uint k = 0u; k < count; ++k) {
        GroundBlock ground = Grounds(grounds).block[k];
        float nearness = nearnessTo(ground, position);
        // A loop that goes round for nobody is what spares CPU devices the work.
        uint rings = nearness > 0.0 ? kGroundRings : 0u;
        vec3 sum = vec3(0.0);
        float within = 0.0; // form factor of what the ring is about
        float radius = innermostRing(ground.radius, ground.height);
        for (uint i = 0u; i < rings; ++i) {
            float disc = cutFormFactor(discVector(ground.centre - position, radius), normal);
            sum += (disc - within) * ground.missed[i];
            within = disc;
            radius *= 3.0;
        }
        missed += 2.0 * kHalfPi * nearness * sum;
    }
    return missed;
}

#endif
