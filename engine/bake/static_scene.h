// All that is StaticPRT as one soup of triangles in the world: what baking rays meet, and what is lit. Holds no transport.
#pragma once

#include "bake/atlas.h"
#include "base/bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace antumbra::bake {

struct StaticScene
{
    uvec2 atlasExtent{0};
    std::vector<vec3> positions;             // metres, world
    std::vector<vec3> normals;               // unit, shading
    std::vector<vec2> uvs;                   // of the albedo image
    std::vector<vec2> bakeUvs;               // 0..1 over the atlas
    std::vector<uint32_t> indices;           // three a triangle, counter-clockwise seen from outside
    std::vector<uint32_t> triangleMaterials; // one a triangle
    std::vector<scene::Material> materials;  // albedoImage indexes `images`
    std::vector<const scene::Image8*> images;

    [[nodiscard]] uint32_t triangleCount() const { return static_cast<uint32_t>(triangleMaterials.size()); }
    [[nodiscard]] Aabb bounds() const;
};

/// A place on a triangle: corner 0 weighs 1 - x - y, corner 1 x, corner 2 y.
struct SurfacePoint
{
    uint32_t triangle = 0;
    vec2 barycentric{0};
};

vec3 positionAt(const StaticScene& scene, const SurfacePoint& point);
vec3 geometricNormal(const StaticScene& scene, uint32_t triangle); // unit
/// Unit; the geometric one where the vertices' cancel out.
vec3 shadingNormalAt(const StaticScene& scene, const SurfacePoint& point);
vec2 bakeUvAt(const StaticScene& scene, const SurfacePoint& point);
/// Linear, 0..1; what is not finite counts as 0.
vec3 albedoAt(const StaticScene& scene, const SurfacePoint& point);
/// Whether the surface is cut out there.
bool isHole(const StaticScene& scene, const SurfacePoint& point);

/// `objects` as the atlas was laid out for. Their images must outlive the scene.
StaticScene flatten(std::span<const AtlasObject> objects, const Atlas& atlas);

/// Of all that baked light depends on.
uint64_t hashOf(const StaticScene& scene);

} // namespace antumbra::bake
