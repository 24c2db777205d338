// What the project ships: the walker's shape and gaits, the environments' size and brightness, scenes that load.
#include "bake/sh.h"
#include "scene/animation.h"
#include "scene/gltf.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <tuple>

namespace antumbra::scene {
namespace {

const Model& walker()
{
    static const Model model = loadGltf(projectPath("assets") / "characters/walker.glb");
    return model;
}

const Clip& clipOf(std::string_view name)
{
    const auto clip = std::ranges::find(walker().clips, name, &Clip::name);
    check(clip != walker().clips.end(), "a clip of the walker");
    return *clip;
}

std::vector<vec3> positionsAt(const Clip& clip, float seconds)
{
    LocalPose pose;
    setRest(pose, walker());
    sample(pose, clip, seconds);
    std::vector<mat4> jointMatrices(walker().joints.size()), nodeToModel;
    resolve(jointMatrices, nodeToModel, pose, walker());
    return posedMesh(walker(), jointMatrices, pose.morphWeights).positions;
}

float lowest(const std::vector<vec3>& positions)
{
    return std::ranges::min(positions, {}, [](const vec3& p) { return p.y; }).y;
}

/// Over a loop, the worst speed against the ground of the vertex that stands best; the body moves as the clip asks, m/s and radians/s.
float worstSlide(const Clip& clip, float speed, float turnRate)
{
    constexpr int kSteps = 90;
    constexpr float kTouching = 0.004f;
    const float step = clip.duration / kSteps;
    float worst = 0;
    std::vector<vec3> before = positionsAt(clip, 0);
    for (int i = 1; i <= kSteps; ++i) {
        std::vector<vec3> now = positionsAt(clip, step * static_cast<float>(i));
        float best = std::numeric_limits<float>::max();
        for (size_t v = 0; v < now.size(); ++v)
            if (now[v].y < kTouching && before[v].y < kTouching) {
                const vec3 body = vec3(0, 0, speed) + turnRate * vec3(now[v].z, 0, -now[v].x);
                const vec3 slide = (now[v] - before[v]) / step + body;
                best = std::min(best, std::hypot(slide.x, slide.z));
            }
        worst = std::max(worst, best);
        before = std::move(now);
    }
    return worst;
}

TEST(ShippedWalker, StandsOnTheGroundAtHumanHeight)
{
    const Aabb box = walker().mesh.bounds();
    EXPECT_NEAR(box.lowest.y, 0, 0.002);
    EXPECT_NEAR(box.highest.y, 1.75, 0.02);
    const size_t triangles = walker().mesh.indices.size() / 3;
    EXPECT_GE(triangles, 2900u);
    EXPECT_LE(triangles, 3500u);
    EXPECT_LE(std::filesystem::file_size(projectPath("assets") / "characters/walker.glb"), 600u * 1024);
}

TEST(ShippedWalker, IsClosed)
{
    const Mesh& mesh = walker().mesh;
    using Corner = std::tuple<float, float, float>;
    const auto cornerOf = [&](size_t i) {
        const vec3 p = mesh.positions[mesh.indices[i]];
        return Corner{p.x, p.y, p.z};
    };
    std::map<std::pair<Corner, Corner>, int> passes;
    for (size_t i = 0; i < mesh.indices.size(); ++i)
        ++passes[{cornerOf(i), cornerOf(i % 3 == 2 ? i - 2 : i + 1)}];
    for (const auto& [edge, count] : passes) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(passes.contains({edge.second, edge.first}));
    }
}

TEST(ShippedWalker, ClipsLoopAboveTheGround)
{
    for (const char* name : {"idle", "walk", "run", "wave", "turn"}) {
        const Clip& clip = clipOf(name);
        const std::vector<vec3> first = positionsAt(clip, 0), last = positionsAt(clip, clip.duration);
        for (size_t v = 0; v < first.size(); ++v)
            ASSERT_LT(glm::distance(first[v], last[v]), 1e-4f) << name;
        for (int i = 0; i < 20; ++i)
            EXPECT_GT(lowest(positionsAt(clip, clip.duration * static_cast<float>(i) / 20)), -0.003f) << name;
        EXPECT_GT(glm::distance(first[0], positionsAt(clip, 0.3f * clip.duration)[0]), 1e-4f) << name << " stands still";
    }
}

TEST(ShippedWalker, FeetDoNotSlide)
{
    EXPECT_LT(worstSlide(clipOf("idle"), 0, 0), 0.01f);
    EXPECT_LT(worstSlide(clipOf("walk"), 1.4f, 0), 0.1f);
    EXPECT_LT(worstSlide(clipOf("turn"), 0, 1.2f), 0.1f);
    EXPECT_GT(worstSlide(clipOf("walk"), 0.7f, 0), 0.3f) << "the measure sees a foot that slides";
}

TEST(ShippedEnvironments, AreSmallAndExposedAlike)
{
    for (const char* name : {"overcast.hdr", "low_sun.hdr", "hall.hdr"}) {
        const Path file = projectPath("assets") / "environments" / name;
        EXPECT_LE(std::filesystem::file_size(file), 256u * 1024) << name;
        const glm::dvec3 up = bake::irradianceOf(bake::project(loadRadiance(file), 5))({0, 1, 0});
        EXPECT_NEAR(glm::dot(up, {0.2126, 0.7152, 0.0722}), std::numbers::pi, 0.02) << name;
    }
}

TEST(ShippedScenes, Load)
{
    const Path scenes = projectPath("assets") / "scenes";
    for (const char* name : {"plaza", "hall"}) {
        const SceneFile scene = loadScene(scenes / (std::string(name) + ".json"));
        EXPECT_EQ(std::ranges::count(scene.entities, true, &SceneEntity::isDynamicSkinned), 2) << name;
        EXPECT_EQ(std::ranges::count(scene.entities, "player", &SceneEntity::name), 1) << name;
    }
    const auto crowd = [&](const Settings& overrides) {
        return std::ranges::count(loadScene(scenes / "crowd.json", overrides).entities, true, &SceneEntity::isDynamicSkinned);
    };
    EXPECT_EQ(crowd({}), 10);
    EXPECT_EQ(crowd({{"crowd.count", "200"}}), 200);
}

} // namespace
} // namespace antumbra::scene
