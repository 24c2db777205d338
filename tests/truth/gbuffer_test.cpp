// The g-buffer against rays cast on the CPU: every pixel shows the nearest triangle that faces it, in its material's colour.
#include "truth/shown.h"

#include "base/file.h"
#include "scene/animation.h"
#include "scene/gltf.h"

#include <cmath>
#include <limits>

namespace antumbra::truth {
namespace {

using render::Aov;

struct Hit
{
    float depthView = std::numeric_limits<float>::infinity(); // metres
    vec3 albedo{0};
};

struct Ray
{
    vec3 origin, direction; // one metre of view depth long
};

/// Möller and Trumbore 1997.
void intersect(Hit& nearest, const Ray& ray, vec3 a, vec3 b, vec3 c, const scene::Material& material)
{
    const vec3 ab = b - a, ac = c - a, p = glm::cross(ray.direction, ac);
    const float determinant = glm::dot(ab, p); // positive where the front is seen
    if (material.twoSided ? determinant == 0 : determinant <= 0)
        return;
    const vec3 fromA = ray.origin - a, q = glm::cross(fromA, ab);
    const float u = glm::dot(fromA, p) / determinant, v = glm::dot(ray.direction, q) / determinant;
    const float t = glm::dot(ac, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest.depthView)
        nearest = {t, material.albedo};
}

Ray rayThrough(const render::CameraView& camera, uvec2 pixel)
{
    return {camera.eye, positionAt(camera, Shown::kExtent, pixel, 1.0f) - camera.eye};
}

class GBufferTest : public DeviceTest, public testing::WithParamInterface<vec3>
{
};

TEST_P(GBufferTest, ShowsTheNearestTriangleThatFacesThePixel)
{
    const scene::Model model = scene::loadGltf(projectPath("assets") / "scenes/atrium_small.glb");
    const scene::Mesh mesh = scene::restMesh(model);
    scene::SceneFile hall = namedScene("hall");
    hall.entities.resize(1); // the atrium
    hall.camera.target = hall.camera.position + GetParam();
    Shown shown(device(), hall);
    const scene::ImageF depth = shown.capture(Aov::Depth), albedo = shown.capture(Aov::Albedo);

    size_t compared = 0, different = 0;
    for (uint32_t y = 0; y < Shown::kExtent.y; y += 2)
        for (uint32_t x = 0; x < Shown::kExtent.x; x += 3) {
            const Ray ray = rayThrough(shown.view().camera, {x, y});
            Hit hit;
            for (size_t i = 0; i < mesh.indices.size(); i += 3)
                intersect(hit, ray, mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                          mesh.positions[mesh.indices[i + 2]], model.materials[mesh.triangleMaterials[i / 3]]);
            const size_t pixel = x + size_t{y} * Shown::kExtent.x;
            const float expected = std::isinf(hit.depthView) ? 0 : hit.depthView;
            const bool isSame = std::abs(depth.values[pixel] - expected) <= 1e-3f * expected &&
                                glm::all(glm::lessThan(glm::abs(pixelOf(albedo, pixel) - hit.albedo), vec3(0.01f)));
            ++compared;
            different += isSame ? 0 : 1;
        }
    // Rays that pass within a rounding of an edge may go either way.
    EXPECT_LE(different, compared / 200);
}

INSTANTIATE_TEST_SUITE_P(LookingAlong, GBufferTest,
                         testing::Values(vec3{-4.3f, -0.6f, -1.45f}, vec3{1, 0.8f, 0.5f}, vec3{-0.3f, -1, 0.2f}, vec3{-1, 0.1f, -2}));

} // namespace
} // namespace antumbra::truth
