#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/bvh.h"

// One thread an instance: its bounds in the world, from those of its pose.
layout(local_size_x = 64) in;

layout(buffer_reference, scalar) readonly buffer Placements { BvhPlacement placement[]; };
layout(buffer_reference, scalar) readonly buffer Nodes { BvhNode node[]; };
layout(buffer_reference, scalar) writeonly buffer Instances { BvhInstance instance[]; };
layout(buffer_reference, scalar) writeonly buffer Scene { BvhScene scene; };
layout(push_constant, scalar) uniform Push { BvhSceneDispatch pc; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i == 0u)
        Scene(pc.scene).scene = BvhScene(pc.instances, pc.instanceCount, 0u);
    if (i >= pc.instanceCount)
        return;
    BvhPlacement placed = Placements(pc.placements).placement[i];
    BvhNode root = Nodes(placed.instance.nodes).node[1];
    mat3 linear = mat3(placed.worldFromLocal);
    mat3 absolute = mat3(abs(linear[0]), abs(linear[1]), abs(linear[2]));
    vec3 centre = vec3(placed.worldFromLocal * vec4(0.5 * (root.lowest + root.highest), 1.0));
    vec3 halfExtent = absolute * (0.5 * (root.highest - root.lowest));
    // Rays are taken to the mesh's space, not the mesh to the world's: room for what rounding makes of that.
    halfExtent += 1.0e-6 * (halfExtent + absolute * max(abs(root.lowest), abs(root.highest)) + abs(placed.worldFromLocal[3].xyz));
    placed.instance.lowest = centre - halfExtent;
    placed.instance.highest = centre + halfExtent;
    Instances(pc.instances).instance[i] = placed.instance;
}
