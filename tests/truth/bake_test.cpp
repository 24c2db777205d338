// The baked light of the atrium, and of rooms with known answers, against path tracing of the same surfaces.
#include "app/baked_light.h"
#include "app/stage.h"
#include "app/surfaces.h"
#include "bake/bake_error.h"
#include "bake/bake_file.h"
#include "bake/baker.h"
#include "bake/look_up.h"
#include "bake/path_tracer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>

namespace antumbra::truth {
namespace {

using app::Surfaces;
using bake::ShFunction;

/// The bake that ships, and what it was made of.
class BakedAtrium : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        const scene::SceneFile file = app::findScene("atrium", {});
        const bake::BakeSettings settings = app::bakeSettingsOf(file, {});
        surfaces_ = std::make_unique<Surfaces>(file, settings);
        rays_ = std::make_unique<bake::RayScene>(surfaces_->scene);
        bake_ = std::make_unique<bake::Bake>(bake::loadBake(bake::bakePathOf(file.file)));
        ASSERT_EQ(staleness(*bake_, hashOf(surfaces_->scene), settings), "");
        light_ = bake::project(surfaces_->assets.environments.front(), settings.bands);
    }
    static void TearDownTestSuite()
    {
        rays_.reset();
        surfaces_.reset();
        bake_.reset();
    }

    static const bake::StaticScene& scene() { return surfaces_->scene; }
    static const bake::RayScene& rays() { return *rays_; }
    static const bake::Bake& bake() { return *bake_; }
    static ShFunction lightTurned(double degrees) { return rotatedAboutY(light_, glm::radians(degrees)); }

private:
    static inline std::unique_ptr<Surfaces> surfaces_;
    static inline std::unique_ptr<bake::RayScene> rays_;
    static inline std::unique_ptr<bake::Bake> bake_;
    static inline ShFunction light_;
};

TEST_F(BakedAtrium, MeetsPathTracingHoweverTheLightIsTurned)
{
    const std::vector<bake::SurfacePoint> points = seenPoints(rays(), 1500, 1);
    for (const double degrees : {0.0, 72.0, 144.0, 216.0, 288.0}) {
        const bake::ErrorAgainstTruth error = errorOf(bake(), rays(), lightTurned(degrees), lightTurned(degrees), points, 256);
        EXPECT_LE(error.relative(), 0.04) << "turned by " << degrees << " degrees";
        RecordProperty(fmt::format("relative_rmse_{}", degrees), fmt::format("{:.4f}", error.relative()));
        EXPECT_GT(error.mean(), 0.05) << "there is no light to get wrong";
    }
}

/// An edge of two triangles in the world whose sides lie apart on the page.
struct Seam
{
    bake::SurfacePoint sides[2];
};

/// In the middle of edges where charts meet and the surface goes on smoothly.
std::vector<Seam> seamsOf(const bake::StaticScene& scene)
{
    using Key = std::array<float, 6>;
    const auto keyOf = [](vec3 a, vec3 b) {
        const bool isOrdered = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        const vec3 first = isOrdered ? a : b, second = isOrdered ? b : a;
        return Key{first.x, first.y, first.z, second.x, second.y, second.z};
    };
    constexpr vec2 kMiddles[3] = {{0.499f, 0.001f}, {0.5f, 0.499f}, {0.001f, 0.499f}}; // just inside of edges 01, 12, 20
    std::map<Key, std::vector<bake::SurfacePoint>> edges;
    for (uint32_t triangle = 0; triangle < scene.triangleCount(); ++triangle)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = scene.indices[3 * triangle + k], b = scene.indices[3 * triangle + (k + 1) % 3];
            edges[keyOf(scene.positions[a], scene.positions[b])].push_back({triangle, kMiddles[k]});
        }
    std::vector<Seam> seams;
    for (const auto& [key, sides] : edges) {
        if (sides.size() != 2)
            continue;
        const bool isSmooth = glm::dot(shadingNormalAt(scene, sides[0]), shadingNormalAt(scene, sides[1])) > 0.9999f &&
                              glm::dot(geometricNormal(scene, sides[0].triangle), geometricNormal(scene, sides[1].triangle)) > 0.9f;
        const float apart =
            glm::distance(bakeUvAt(scene, sides[0]) * vec2(scene.atlasExtent), bakeUvAt(scene, sides[1]) * vec2(scene.atlasExtent));
        if (isSmooth && apart > 1.0f)
            seams.push_back({{sides[0], sides[1]}});
    }
    return seams;
}

TEST_F(BakedAtrium, ShowsNoSeams)
{
    const ShFunction light = lightTurned(0);
    const std::vector<bake::SurfacePoint> points = seenPoints(rays(), 2000, 2);
    double mean = 0;
    for (const bake::SurfacePoint& point : points)
        mean += atlasIrradiance(bake(), light, bakeUvAt(scene(), point)).y / static_cast<double>(points.size());
    std::vector<double> steps;
    for (const Seam& seam : seamsOf(scene()))
        steps.push_back(std::abs(atlasIrradiance(bake(), light, bakeUvAt(scene(), seam.sides[0])).y -
                                 atlasIrradiance(bake(), light, bakeUvAt(scene(), seam.sides[1])).y) /
                        mean);
    ASSERT_FALSE(steps.empty());
    std::ranges::sort(steps);
    for (const double share : {0.5, 0.9, 0.99, 1.0})
        RecordProperty(fmt::format("seam_{}", share),
                       fmt::format("{:.4f}", steps[static_cast<size_t>(share * static_cast<double>(steps.size() - 1))]));
    EXPECT_LE(steps.back(), 0.02) << steps.size() << " seams";
}

TEST_F(BakedAtrium, AReducedBakeIsTheSameLight)
{
    const scene::SceneFile file = app::findScene("atrium", {});
    bake::BakeSettings settings = app::bakeSettingsOf(file, {});
    settings.texelsPerMetre *= 0.5f;
    settings.raysPerTexel = 128;
    settings.cellMetres *= 2;
    const Surfaces reduced(file, settings);
    const std::optional<bake::Bake> again = bakeScene(reduced.scene, settings, {});
    ASSERT_TRUE(again);
    const bake::RayScene reducedRays(reduced.scene);
    const ShFunction light = lightTurned(30);
    bake::ErrorAgainstTruth difference;
    for (const bake::SurfacePoint& point : seenPoints(rays(), 1500, 3)) {
        // The same triangle lies elsewhere on the other page, and elsewhere in its list.
        const vec3 normal = geometricNormal(scene(), point.triangle), from = positionAt(scene(), point) + 1.0e-3f * normal;
        bake::RayScene::Hit hit;
        if (!reducedRays.intersect(from, -normal, hit) || hit.distance > 2.0e-3f)
            continue;
        const glm::dvec3 shipped = atlasIrradiance(bake(), light, bakeUvAt(scene(), point));
        difference.add(atlasIrradiance(*again, light, bakeUvAt(reduced.scene, hit.point)), shipped, shipped);
    }
    EXPECT_LE(difference.relative(), 0.06);
    EXPECT_GT(difference.relative(), 0) << "the bake was compared with itself";
}

/// A closed room of walls `thickness` thick, 4 m wide inside, in the light.
scene::SceneFile closedRoom(float thickness)
{
    scene::SceneFile scene;
    scene.environment = scene::SceneEnvironment{};
    const auto add = [&](vec3 centre, vec3 size) {
        scene::SceneEntity box{.mesh = {scene::MeshKind::Cube, {}}, .isStaticPRT = true};
        box.transform.position = centre;
        box.transform.scale = size;
        scene.entities.push_back(box);
    };
    const float middle = 2.0f + 0.5f * thickness, outer = 4.0f + 2.0f * thickness;
    for (const float side : {-1.0f, 1.0f}) {
        add({side * middle, 0, 0}, {thickness, outer, outer});
        add({0, side * middle, 0}, {4, thickness, outer});
        add({0, 0, side * middle}, {4, 4, thickness});
    }
    return scene;
}

TEST(BakedRoom, LetsNoLightThroughItsWalls)
{
    bake::BakeSettings settings{.raysPerTexel = 64, .raysPerCell = 256, .texelsPerMetre = 8, .cellMetres = 0.4f};
    const Surfaces room(closedRoom(0.5f), settings);
    const std::optional<bake::Bake> bake = bakeScene(room.scene, settings, {});
    ASSERT_TRUE(bake);
    const bake::RayScene rays(room.scene);
    const ShFunction light = bake::project(room.assets.environments.front(), settings.bands);
    double outside = 0;
    for (const bake::SurfacePoint& point : seenPoints(rays, 2000, 4)) {
        const vec3 position = positionAt(room.scene, point);
        const double irradiance = atlasIrradiance(*bake, light, bakeUvAt(room.scene, point)).y;
        const bool isInside = glm::all(glm::lessThan(glm::abs(position), vec3(2.01f)));
        if (isInside)
            EXPECT_LE(irradiance, 0.01 * std::numbers::pi) << position.x << " " << position.y << " " << position.z;
        else
            outside = std::max(outside, irradiance);
    }
    EXPECT_GT(outside, 0.9 * std::numbers::pi);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-1.99f, 1.99f);
    for (int i = 0; i < 500; ++i) {
        const vec3 position(place(random), place(random), place(random));
        EXPECT_LE(localRadiance(*bake, light, position).coefficients[0].y, 0.01 * light.coefficients[0].y);
    }
    EXPECT_GT(localRadiance(*bake, light, {2.95f, 2.95f, 2.95f}).coefficients[0].y, 0.4 * light.coefficients[0].y);
}

} // namespace
} // namespace antumbra::truth
