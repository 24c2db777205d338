// The whole of it: baked light, light of the volume on characters, and what they hide subtracted, against path tracing of everything.
#include "bake/bake_error.h"
#include "bake/path_tracer.h"
#include "bake/statics.h"
#include "ecs/each.h"
#include "scene/animation.h"
#include "scene/animator.h"
#include "truth/shown.h"

#include <array>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace antumbra::truth {
namespace {

using render::Aov;

/// A scene at one moment as rays meet it.
struct Moment
{
    bake::StaticScene statics, characters, all;
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
    const auto add = [&](bake::StaticScene& part, const scene::Model& model, const scene::Mesh& posed, const mat4& matrix) {
        append(part, model, posed, matrix);
        append(moment.all, model, posed, matrix);
    };
    for (auto [drawable, matrix] : ecs::Each<const scene::Drawable, const scene::WorldMatrix, ecs::Without<scene::DynamicSkinned>>(world)) {
        const scene::Model& model = assets.models[drawable.model];
        add(moment.statics, model, restMesh(model), matrix.now);
    }
    const auto& poses = world.resource<scene::PoseStore>();
    for (auto [drawable, matrix, pose] :
         ecs::Each<const scene::Drawable, const scene::WorldMatrix, const scene::Pose, ecs::With<scene::DynamicSkinned>>(world))
    {
        const scene::Model& model = assets.models[drawable.model];
        add(moment.characters, model, posedMesh(model, poses.joints(pose), poses.morphWeights(pose)), matrix.now);
    }
    return moment;
}

/// What is measured apart.
enum Part { Floor, Character, Elsewhere, kPartCount };

/// A picture: its fineness, and the moment of the characters' motion.
struct Picture
{
    uvec2 extent;
    float seconds;

    friend void PrintTo(const Picture& picture, std::ostream* out)
    {
        *out << picture.extent.x << " x " << picture.extent.y << " after " << picture.seconds << " s";
    }
};

class BakedCharacters : public DeviceTest, public testing::WithParamInterface<Picture>
{
protected:
    static constexpr uint32_t kPaths = 128;
    static constexpr size_t kStride = 3; // of pixels that show no character

    void measure(Shown& shown, const Moment& moment)
    {
        const bake::RayScene statics(moment.statics), characters(moment.characters), all(moment.all);
        const render::EnvironmentView& environment = shown.view().environment;
        const bake::BakeSettings& settings = shown.view().bake->settings;
        bake::ShFunction light = rotatedAboutY(bake::project(shown.assets().environments[environment.image], settings.bands),
                                               static_cast<double>(environment.rotationRadians));
        for (glm::dvec3& coefficient : light.coefficients)
            coefficient *= static_cast<double>(environment.intensity);
        const scene::ImageF irradiance = shown.capture(Aov::Irradiance), depth = shown.capture(Aov::Depth),
                            normals = shown.capture(Aov::Normal);
        const uvec2 extent = GetParam().extent;
        for (const size_t pixel : surfaceOf(depth)) {
            const auto index = static_cast<uint32_t>(pixel);
            const uvec2 place(index % extent.x, index / extent.x);
            const vec3 position = positionAt(shown.view().camera, extent, place, depth.values[pixel]), normal = pixelOf(normals, pixel);
            const std::optional<Part> part = partAt(statics, characters, shown.view().camera.eye, position, normal);
            if (!part || (part != Character && pixel % kStride != 0))
                continue;
            const auto traced = [&](uint64_t seed) {
                return tracedIrradiance(all, light, settings.bounces, position, normal, kPaths, 2 * pixel + seed);
            };
            errors_[*part].add(pixelOf(irradiance, pixel), traced(0), traced(1));
        }
    }

    /// As a share of the mean irradiance of the part.
    [[nodiscard]] double error(Part part) const { return errors_[part].relative(); }

private:
    /// Nothing at a rim that rasterisation and rays see differently.
    static std::optional<Part> partAt(const bake::RayScene& statics, const bake::RayScene& characters, vec3 eye, vec3 position, vec3 normal)
    {
        const vec3 toSurface = position - eye;
        const auto distanceIn = [&](const bake::RayScene& rays) {
            bake::RayScene::Hit hit;
            return rays.intersect(eye, glm::normalize(toSurface), hit) ? hit.distance : std::numeric_limits<float>::infinity();
        };
        const float toStatic = distanceIn(statics), toCharacter = distanceIn(characters);
        if (std::abs(std::min(toStatic, toCharacter) - glm::length(toSurface)) > 0.02f)
            return std::nullopt;
        return toCharacter < toStatic ? Character : position.y < 0.01f && normal.y > 0.9f ? Floor : Elsewhere;
    }

    std::array<bake::ErrorAgainstTruth, kPartCount> errors_;
};

TEST_P(BakedCharacters, MeetPathTracingHoweverTheLightIsTurned)
{
    Shown shown(device(), namedScene("atrium"), GetParam().extent, GetParam().seconds);
    ASSERT_NE(shown.view().bake, nullptr) << "the atrium ships with its bake";
    shown.set("occlusion.samples", "256");
    shown.set("occlusion.filter", "5");
    const Moment moment = momentOf(shown.stage().world(), shown.stage().assets());
    for (int turn = 0; turn < 5; ++turn) {
        measure(shown, moment);
        shown.view().environment.rotationRadians += 0.4f * kPi;
    }
    for (const auto& [name, part] : {std::pair("floor", Floor), std::pair("characters", Character), std::pair("elsewhere", Elsewhere)})
        RecordProperty(fmt::format("relative_rmse_{}", name), fmt::format("{:.4f}", error(part)));
    EXPECT_LE(error(Floor), 0.05);
    EXPECT_LE(error(Character), 0.05);
    // Columns and railings, which have few texels; asked of nobody, and kept from growing.
    EXPECT_LE(error(Elsewhere), 0.14);
}

INSTANTIATE_TEST_SUITE_P(Truth, BakedCharacters,
                         testing::Values(Picture{{96, 54}, 0}, Picture{{192, 108}, 0}, Picture{{128, 72}, 0.4f}, Picture{{160, 90}, 1.1f}));

} // namespace
} // namespace antumbra::truth
