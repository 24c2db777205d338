// "Which dynamic surface is hit first, and is a static one in front?": by a loop over the instances of a BvhScene and a walk through the
// tree of each. Needs no ray query, no stack and no bindings. Needs shared/occlusion.h.
#ifndef LIB_BVH_GLSL
#define LIB_BVH_GLSL

#include "shared/bvh.h"

const float kRayFar = 1.0e30;

layout(buffer_reference, scalar) readonly buffer BvhSceneAt { BvhScene scene; };
layout(buffer_reference, scalar) readonly buffer BvhInstances { BvhInstance instance[]; };
layout(buffer_reference, scalar) readonly buffer BvhNodes { BvhNode node[]; };
layout(buffer_reference, scalar) readonly buffer BvhPositions { vec3 position[]; };
layout(buffer_reference, scalar) readonly buffer BvhIndices { uint index[]; };

struct BvhRay
{
    vec3 origin;
    vec3 direction; // of any length: distances are multiples of it
    vec3 inverse;
};

BvhRay bvhRay(vec3 origin, vec3 direction)
{
    // A component of zero would make 0 * infinity on the boxes' faces.
    const float kLeast = 1.0e-20;
    vec3 divisor = mix(direction, mix(vec3(kLeast), vec3(-kLeast), lessThan(direction, vec3(0.0))), lessThan(abs(direction), vec3(kLeast)));
    return BvhRay(origin, direction, 1.0 / divisor);
}

// By slabs. The far side lies a little farther than computed, by more than rounding (Ize 2013): no triangle in the box is lost.
bool meetsBox(BvhRay ray, vec3 lowest, vec3 highest, float far)
{
    vec3 a = (lowest - ray.origin) * ray.inverse, b = (highest - ray.origin) * ray.inverse;
    vec3 entries = min(a, b), exits = max(a, b);
    float entry = max(max(entries.x, entries.y), max(entries.z, 0.0));
    float exit = 1.0000005 * min(min(exits.x, exits.y), exits.z);
    return entry <= min(exit, far);
}

// Where the ray meets the triangle if that is before `far`, else `far`. The function of an edge is odd in the edge and nothing else differs
// between the two triangles at it, so they agree on which side the ray passes and it slips through between no two. NaN compares false, and
// a triangle without area has no inside.
float distanceToTriangle(BvhRay ray, vec3 a, vec3 b, vec3 c, float far)
{
    a -= ray.origin;
    b -= ray.origin;
    c -= ray.origin;
    vec3 sides = vec3(dot(cross(c - b, c + b), ray.direction), dot(cross(a - c, a + c), ray.direction),
                      dot(cross(b - a, b + a), ray.direction));
    bool isInside = all(greaterThanEqual(sides, vec3(0.0))) || all(lessThanEqual(sides, vec3(0.0)));
    float whole = sides.x + sides.y + sides.z;
    vec3 along = vec3(dot(a, ray.direction), dot(b, ray.direction), dot(c, ray.direction));
    float at = dot(sides, along) / (whole * dot(ray.direction, ray.direction));
    return isInside && whole != 0.0 && at > 0.0 && at < far ? at : far;
}

float distanceToLeaf(BvhInstance mesh, uint node, BvhRay ray, float far)
{
    BvhNode leaf = BvhNodes(mesh.nodes).node[node];
    BvhPositions vertices = BvhPositions(mesh.positions);
    BvhIndices corners = BvhIndices(mesh.indices);
    for (uint i = 3u * leaf.firstTriangle; i < 3u * (leaf.firstTriangle + leaf.triangleCount); i += 3u)
        far = distanceToTriangle(ray, vertices.position[corners.index[i]], vertices.position[corners.index[i + 1u]],
                                 vertices.position[corners.index[i + 2u]], far);
    return far;
}

// The node after all below this one, from left to right; behind the last comes the root.
uint nodeAfter(uint node) { return (node + 1u) >> findLSB(node + 1u); }

// The closest hit before `far`, or any where any will do; else `far`. The ray is in the mesh's space.
float distanceToMesh(BvhInstance mesh, BvhRay ray, bool anyWillDo, float far)
{
    float closest = far;
    uint node = 1u;
    do {
        // Down to the next leaf first, triangles afterwards: lanes that walk different ways then meet at their leaves.
        bool isAtLeaf;
        do {
            bool meets = meetsBox(ray, BvhNodes(mesh.nodes).node[node].lowest, BvhNodes(mesh.nodes).node[node].highest, closest);
            isAtLeaf = meets && node >= mesh.leafCount;
            if (!isAtLeaf)
                node = meets ? 2u * node : nodeAfter(node);
        } while (!isAtLeaf && node != 1u);
        if (isAtLeaf) {
            closest = distanceToLeaf(mesh, node, ray, closest);
            node = nodeAfter(node);
        }
    } while (node != 1u && !(anyWillDo && closest < far));
    return closest;
}

struct BvhHit
{
    float at; // `far` where nothing is hit
    uint mask; // of the instance; 0 where nothing is hit
};

// The closest hit before `far` among the instances in `mask`, or any where any will do.
BvhHit hitInScene(BvhScene scene, uint mask, bool anyWillDo, vec3 origin, vec3 direction, float far)
{
    BvhRay ray = bvhRay(origin, direction);
    BvhHit hit = BvhHit(far, 0u);
    for (uint i = 0u; i < scene.instanceCount; ++i) {
        BvhInstance instance = BvhInstances(scene.instances).instance[i];
        bool isWanted = (instance.mask & mask) != 0u && !(anyWillDo && hit.mask != 0u);
        if (isWanted && meetsBox(ray, instance.lowest, instance.highest, hit.at)) {
            vec4 rows[3] = instance.localFromWorld;
            vec4 from = vec4(origin, 1.0);
            BvhRay local = bvhRay(vec3(dot(rows[0], from), dot(rows[1], from), dot(rows[2], from)),
                                  vec3(dot(rows[0].xyz, direction), dot(rows[1].xyz, direction), dot(rows[2].xyz, direction)));
            float at = distanceToMesh(instance, local, anyWillDo, hit.at);
            if (at < hit.at)
                hit = BvhHit(at, instance.mask);
        }
    }
    return hit;
}

// How far off something among `mask` is that is hit before `far`: the nearest, or any where any will do. Negative where there is nothing.
float distanceToBlocker(uint64_t scene, uint mask, vec3 origin, vec3 direction, float far, bool anyWillDo)
{
    BvhHit hit = hitInScene(BvhSceneAt(scene).scene, mask, anyWillDo, origin, direction, far);
    return hit.mask != 0u ? hit.at : -1.0;
}

// How far off the dynamic surface is that the ray hits before any static one; negative where there is none. One that is no triangle may be
// `known` to be hit so far off; negative: none. The search stands in the
// program once, for CPU devices.
float dynamicHitFirst(uint64_t scene, vec3 origin, vec3 direction, float far, float known)
{
    BvhHit hit = BvhHit(known >= 0.0 ? known : far, 0u);
    bool isHidden = false;
    for (uint asked = kMaskDynamic; asked != 0u; asked = asked == kMaskDynamic && isHidden ? kMaskStatic : 0u) {
        hit = hitInScene(BvhSceneAt(scene).scene, asked, asked == kMaskStatic, origin, direction, hit.at);
        isHidden = asked == kMaskDynamic ? hit.mask != 0u || known >= 0.0 : hit.mask == 0u;
    }
    return isHidden ? hit.at : -1.0;
}

// The same by one ray through everything: what a renderer without culling does.
float dynamicHitFirstOfAll(uint64_t scene, vec3 origin, vec3 direction, float known)
{
    float far = known >= 0.0 ? known : kRayFar;
    BvhHit hit = hitInScene(BvhSceneAt(scene).scene, kMaskAll, false, origin, direction, far);
    return hit.mask == kMaskStatic ? -1.0 : hit.mask == kMaskDynamic ? hit.at : known;
}

#endif
