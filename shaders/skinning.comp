#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/skinning.h"

// Morph targets, then linear blend skinning, into the character's own space.
layout(local_size_x = 64) in;

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 value[]; };
layout(buffer_reference, scalar) writeonly buffer OutVectors { vec3 value[]; };
layout(buffer_reference, scalar) readonly buffer Influences { InfluenceBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Matrices { mat4 value[]; };
layout(buffer_reference, scalar) readonly buffer Morphs { MorphBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Floats { float value[]; };
layout(push_constant, scalar) uniform Push { SkinningDispatch pc; };

void main()
{
    uint vertex = gl_GlobalInvocationID.x;
    if (vertex >= pc.vertexCount)
        return;
    vec3 position = Vectors(pc.bindPositions).value[vertex];
    vec3 normal = Vectors(pc.bindNormals).value[vertex];
    for (uint m = 0u; m < pc.morphCount; ++m) {
        MorphBlock morph = Morphs(pc.morphs).block[m];
        float weight = Floats(pc.morphWeights).value[m];
        uint i = vertex - morph.firstVertex; // wraps to a large number below the first
        if (weight == 0.0 || i >= morph.count)
            continue;
        position += weight * Vectors(pc.morphOffsets).value[morph.positions + i];
        if (morph.normals != kNoNormals)
            normal += weight * Vectors(pc.morphOffsets).value[morph.normals + i];
    }

    InfluenceBlock influence = Influences(pc.influences).block[vertex];
    uvec4 joints = uvec4(influence.joints01 & 0xffffu, influence.joints01 >> 16u, influence.joints23 & 0xffffu, influence.joints23 >> 16u);
    mat4 blended = Matrices(pc.joints).value[joints.x] * influence.weights.x;
    for (int k = 1; k < 4; ++k)
        if (influence.weights[k] != 0.0)
            blended += Matrices(pc.joints).value[joints[k]] * influence.weights[k];
    // Normals turn by the cofactor matrix, which stays finite where the inverse would not; mirrored parts keep theirs outside.
    mat3 linear = mat3(blended);
    mat3 cofactor = mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
    vec3 turned = cofactor * normal * (dot(linear[0], cofactor[0]) < 0.0 ? -1.0 : 1.0);
    float squared = dot(turned, turned);
    OutVectors(pc.posedPositions).value[vertex] = vec3(blended * vec4(position, 1.0));
    OutVectors(pc.posedNormals).value[vertex] = squared > 0.0 ? turned * inversesqrt(squared) : vec3(0.0, 1.0, 0.0);
}
