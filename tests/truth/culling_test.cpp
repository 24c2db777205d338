// Culling spares rays and changes nothing: for the same samples every kind gives the picture of none.
#include "truth/shown.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace antumbra::truth {
namespace {

using render::Aov;

constexpr double kSummationOrder = 1e-5; // relative
constexpr float kHalfStep = 0x1p-10f;    // between neighbouring half floats, relative, at most

struct Case
{
    std::string name;
    std::function<scene::SceneFile()> scene;
    std::vector<float> seconds{0};
    std::string file; // that must be there

    friend void PrintTo(const Case& test, std::ostream* out) { *out << test.name; }
};

std::string sharedCharacter(const std::string& file) { return (Path(ANTUMBRA_SHARED_DIR) / "assets/characters" / file).string(); }

/// A model of others, stretched and turned, in its first clip.
Case characterCase(const std::string& name, const std::string& file)
{
    return {.name = name,
            .scene =
                [file] {
                    scene::SceneFile scene = scene::sceneOfModel(sharedCharacter(file), projectPath("assets") / "environments/low_sun.hdr");
                    scene::Transform& transform = scene.entities.back().transform;
                    transform.scale = {1.7f, 0.6f, 1.1f};
                    transform.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 0.5f)));
                    return scene;
                },
            .seconds = {0.2f, 0.7f},
            .file = sharedCharacter(file)};
}

class CullingTest : public BackendTest<testing::tuple<Case, Backend>>
{
protected:
    void SetUp() override
    {
        BackendTest::SetUp();
        if (IsSkipped() || HasFatalFailure())
            return;
        if (!test().file.empty() && !std::filesystem::exists(test().file))
            GTEST_SKIP() << "there is no " << test().file;
    }

    [[nodiscard]] static const Case& test() { return testing::get<Case>(GetParam()); }
};

/// The pictures are half floats: sums that differ by a share s of their value come out a step apart in a share s / step of the pixels,
/// so the mean difference is the true one, and no pixel is off by more than a step.
void expectEqual(const scene::ImageF& culled, const scene::ImageF& unculled, const scene::ImageF& unshadowed,
                 const std::vector<size_t>& surface)
{
    double difference = 0, whole = 0;
    double greatest = 0; // in steps
    for (const size_t pixel : surface)
        for (int channel = 0; channel < 3; ++channel) {
            const float truth = pixelOf(unculled, pixel)[channel];
            const float off = std::abs(pixelOf(culled, pixel)[channel] - truth);
            const float light = std::abs(pixelOf(unshadowed, pixel)[channel]);
            difference += off;
            whole += light;
            greatest = std::fmax(greatest, off / (kHalfStep * std::abs(truth) + static_cast<float>(kSummationOrder) * light));
        }
    EXPECT_LE(difference / whole, kSummationOrder);
    EXPECT_LE(greatest, 1.001) << "a ray that counts was culled";
}

TEST_P(CullingTest, ChangesNothing)
{
    Shown shown(device(), test().scene());
    shown.set("occlusion.backend", backend().name);
    for (const float seconds : test().seconds) {
        shown.advance(seconds);
        shown.set("occlusion.culling", "none");
        const scene::ImageF unculled = shown.capture(Aov::Occluded);
        const scene::ImageF unshadowed = shown.capture(Aov::Unshadowed);
        const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
        ASSERT_GT(meanOf(unculled, surface), 1e-3 * meanOf(unshadowed, surface)) << "nothing casts a shadow";
        for (const char* culling : {"direction", "length", "bones"}) {
            SCOPED_TRACE(fmt::format("{} at {} s", culling, seconds));
            shown.set("occlusion.culling", culling);
            expectEqual(shown.capture(Aov::Occluded), unculled, unshadowed, surface);
        }
    }
}

TEST_P(CullingTest, SparesRays)
{
    Shown shown(device(), test().scene());
    shown.set("occlusion.backend", backend().name);
    shown.advance(test().seconds.front());
    const auto tracedWith = [&](const char* culling) {
        shown.set("occlusion.culling", culling);
        const shader::CounterBlock counters = shown.counters();
        EXPECT_GT(counters.raysConsidered, 0u);
        return static_cast<double>(counters.raysTraced) / counters.raysConsidered;
    };
    const double none = tracedWith("none"), direction = tracedWith("direction"), length = tracedWith("length"), bones = tracedWith("bones");
    EXPECT_EQ(none, 1);
    EXPECT_LT(direction, 0.8);
    EXPECT_EQ(length, direction) << "the same rays, only shorter";
    EXPECT_LT(bones, 1.02 * length) << "about a cube, a capsule is no tighter than a sphere; with limbs it is";
}

TEST_P(CullingTest, HoldsForSampleCountsThatFillNoWholeMask)
{
    Shown shown(device(), test().scene());
    shown.set("occlusion.backend", backend().name);
    shown.advance(test().seconds.front());
    shown.set("occlusion.samples", "160");
    shown.set("occlusion.culling", "none");
    const scene::ImageF unculled = shown.capture(Aov::Occluded);
    const scene::ImageF unshadowed = shown.capture(Aov::Unshadowed);
    shown.set("occlusion.culling", "bones");
    expectEqual(shown.capture(Aov::Occluded), unculled, unshadowed, surfaceOf(shown.capture(Aov::Depth)));
}

std::string caseName(const testing::TestParamInfo<testing::tuple<Case, Backend>>& test) { return testing::get<Case>(test.param).name; }

Case plaza()
{
    return {"Plaza", [] { return namedScene("plaza"); }, {0, 0.35f, 0.5f}, ""};
}
Case hall()
{
    return {"Hall", [] { return namedScene("hall"); }, {0, 0.35f}, ""};
}
Case crowd()
{
    return {"Crowd", [] { return namedScene("crowd", {{"crowd.count", "10"}}); }, {0.2f, 0.45f}, ""};
}

INSTANTIATE_TEST_SUITE_P(RayQuery, CullingTest,
                         testing::Combine(testing::Values(plaza(), hall(), crowd(), characterCase("CesiumMan", "CesiumMan.glb"),
                                                          characterCase("Fox", "Fox.glb"),
                                                          characterCase("RiggedFigure", "RiggedFigure.glb"),
                                                          characterCase("AnimatedMorphCube", "AnimatedMorphCube.glb"),
                                                          characterCase("Robot", "raylib_robot.glb")),
                                          testing::Values(kRayQuery)),
                         caseName);
INSTANTIATE_TEST_SUITE_P(ComputeBvh, CullingTest,
                         testing::Combine(testing::Values(plaza(), hall(), characterCase("CesiumMan", "CesiumMan.glb"),
                                                          characterCase("AnimatedMorphCube", "AnimatedMorphCube.glb")),
                                          testing::Values(kComputeBvh)),
                         caseName);

} // namespace
} // namespace antumbra::truth
