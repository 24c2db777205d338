#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/skinning.h"
#include "shared/occlusion.h"

// One group a character: its bounds, from its own space to the world.
layout(local_size_x = 32) in;

layout(buffer_reference, scalar) readonly buffer Sources { BlockerSource block[]; };
layout(buffer_reference, scalar) readonly buffer Sphere { SphereBlock block; };
layout(buffer_reference, scalar) readonly buffer InCapsules { CapsuleBlock block[]; };
layout(buffer_reference, scalar) writeonly buffer Blockers { BlockerBlock block[]; };
layout(buffer_reference, scalar) writeonly buffer Capsules { CapsuleBlock block[]; };
layout(push_constant, scalar) uniform Push { BlockerDispatch pc; };

void main()
{
    BlockerSource source = Sources(pc.sources).block[gl_WorkGroupID.x];
    // Instances are traced where the matrix puts them, to rounding: a thousandth more covers it.
    float scale = 1.001 * source.scale;
    for (uint c = gl_LocalInvocationIndex; c < source.capsuleCount; c += 32u) {
        CapsuleBlock capsule = InCapsules(source.capsules).block[c];
        capsule.middle = vec3(source.worldFromLocal * vec4(capsule.middle, 1.0));
        capsule.arm = mat3(source.worldFromLocal) * capsule.arm;
        capsule.radius *= scale;
        capsule.reach *= scale;
        Capsules(pc.capsules).block[source.firstCapsule + c] = capsule;
    }
    if (gl_LocalInvocationIndex == 0u) {
        SphereBlock sphere = Sphere(source.sphere).block;
        vec3 centre = vec3(source.worldFromLocal * vec4(sphere.centre, 1.0));
        Blockers(pc.blockers).block[gl_WorkGroupID.x] =
            BlockerBlock(centre, sphere.radius * scale, source.firstCapsule, source.capsuleCount);
    }
}
