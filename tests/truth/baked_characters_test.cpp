// The whole of it: baked light, light of the volume on characters, and what they hide subtracted, against path tracing of everything.
#include "bake/bake_error.h"
#include "bake/path_tracer.h"
#include "bake/statics.h"
#include "ecs/each.h"
#include "scene/animation.h"
#include "scene/animator.h"
#include "truth/shown.h"

#include <fmt/format.h>

namespace antumbra::truth {
namespace {

using render::Aov;

/// A scene at one moment as rays meet it; the characters' triangles come last.
struct Moment
{
    bake::StaticScene surfaces;
    uint32_t firstCharacterTriangle = 0;
};

void append(bake::StaticScene& surfaces, const scene::Model& model, const scene::Mesh& posed, const mat4& world)
{
    const auto firstVertex = static_cast<uint32_t>(surfaces.positions.size());
    const auto firstMaterial = static_cast<uint32_t>(surfaces.materials.size());
    for (size_t i = 0; i < posed.positions.size(); ++i) {
        surfaces.positions.push_back(vec3(world * vec4(posed.positions[i], 1)));
        surfaces.normals.push_back(glm::normalize(mat3(world) * posed.normals[i]));
        surfaces.uvs.push_back(posed.uvs[i]);
        surfaces.bakeUvs.emplace_back(0);
    }
    for (size_t i = 0; i < posed.indices.size(); ++i)
        surfaces.indices.push_back(firstVertex + posed.indices[i]);
    for (const uint32_t material : posed.triangleMaterials)
        surfaces.triangleMaterials.push_back(firstMaterial + material);
    for (scene::Material material : model.materials) {
        ASSERT_EQ(material.albedoImage, scene::kNoIndex) << "characters of these tests have no images";
        surfaces.materials.push_back(material);
    }
}

Moment momentOf(const ecs::World& world, const scene::Assets& assets)
{
    Moment moment;
    for (auto [drawable, matrix] : ecs::Each<const scene::Drawable, const scene::WorldMatrix, ecs::Without<scene::DynamicSkinned>>(world)) {
        const scene::Model& model = assets.models[drawable.model];
        append(moment.surfaces, model, restMesh(model), matrix.now);
    }
    moment.firstCharacterTriangle = moment.surfaces.triangleCount();
    const auto& poses = world.resource<scene::PoseStore>();
    for (auto [drawable, matrix, pose] :
         ecs::Each<const scene::Drawable, const scene::WorldMatrix, const scene::Pose, ecs::With<scene::DynamicSkinned>>(world))
    {
        const scene::Model& model = assets.models[drawable.model];
        append(moment.surfaces, model, posedMesh(model, poses.joints(pose), poses.morphWeights(pose)), matrix.now);
    }
    return moment;
}

class BakedCharacters : public DeviceTest
{
};

TEST_F(BakedCharacters, MeetPathTracing)
{
    constexpr uint32_t kPaths = 256;
    Shown shown(device(), namedScene("atrium"));
    ASSERT_NE(shown.view().bake, nullptr) << "the atrium ships with its bake";
    const scene::ImageF irradiance = shown.capture(Aov::Irradiance), depth = shown.capture(Aov::Depth), normal = shown.capture(Aov::Normal);

    const Moment moment = momentOf(shown.stage().world(), shown.stage().assets());
    const bake::RayScene rays(moment.surfaces);
    const render::EnvironmentView& environment = shown.view().environment;
    bake::ShFunction light =
        rotatedAboutY(bake::project(shown.stage().assets().environments[environment.image], shown.view().bake->settings.bands),
                      static_cast<double>(environment.rotationRadians));
    for (glm::dvec3& coefficient : light.coefficients)
        coefficient *= static_cast<double>(environment.intensity);
    bake::ErrorAgainstTruth onFloor, onCharacters;
    for (const size_t pixel : surfaceOf(depth)) {
        const auto index = static_cast<uint32_t>(pixel);
        const vec3 position =
            positionAt(shown.view().camera, Shown::kExtent, {index % Shown::kExtent.x, index / Shown::kExtent.x}, depth.values[pixel]);
        const vec3 toSurface = position - shown.view().camera.eye;
        bake::RayScene::Hit hit;
        if (!rays.intersect(shown.view().camera.eye, glm::normalize(toSurface), hit) ||
            std::abs(hit.distance - glm::length(toSurface)) > 0.02f)
            continue; // a rim that rasterisation and rays see differently
        const auto traced = [&](uint64_t seed) {
            return tracedIrradiance(rays, light, shown.view().bake->settings.bounces, position, pixelOf(normal, pixel), kPaths,
                                    2 * pixel + seed);
        };
        const bool isCharacter = hit.point.triangle >= moment.firstCharacterTriangle;
        (isCharacter ? onCharacters : onFloor).add(pixelOf(irradiance, pixel), traced(0), traced(1));
    }
    RecordProperty("relative_rmse_floor", fmt::format("{:.4f}", onFloor.relative()));
    RecordProperty("relative_rmse_characters", fmt::format("{:.4f}", onCharacters.relative()));
    EXPECT_LE(onFloor.relative(), 0.05);
    EXPECT_LE(onCharacters.relative(), 0.05);
}

} // namespace
} // namespace antumbra::truth
