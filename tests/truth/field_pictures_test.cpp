// Distance fields in scenes: their shadows together with those of meshes against rays that meet both, and what is not called for.
#include "render/field_structure.h"
#include "truth/shown.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace antumbra::truth {
namespace {

using render::Aov;
using testing::Contains;
using testing::Not;

struct FieldPicture
{
    const char* scene;
    double error; // of the mean irradiance
};

void PrintTo(const FieldPicture& picture, std::ostream* out) { *out << picture.scene; }

class FieldPictures : public DeviceTest
{
protected:
    static scene::ImageF truthOf(Shown& shown, uint32_t samples)
    {
        shown.set("area.shadow", "reference");
        shown.set("reference.samples", std::to_string(samples));
        do
            shown.draw();
        while (shown.renderer().referenceSamples().value() < samples);
        scene::ImageF mean = shown.capture(Aov::Irradiance);
        shown.set("area.shadow", "analytic");
        return mean;
    }

    static scene::ImageF irradianceBy(Shown& shown, const char* shadow)
    {
        shown.set("sdf.shadow", shadow);
        return shown.capture(Aov::Irradiance);
    }

    static void expectSound(Shown& shown)
    {
        const shader::CounterBlock counters = shown.counters();
        EXPECT_EQ(counters.nanPixels + counters.infPixels + counters.negativePixels, 0u);
    }
};

class FieldPicturesOf : public FieldPictures, public testing::WithParamInterface<FieldPicture>
{
};

TEST_P(FieldPicturesOf, SubConesAreNearTheTruth)
{
    Shown shown(device(), namedScene(GetParam().scene), Shown::kExtent);
    shown.set("area.scale", "1");
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    const scene::ImageF truth = truthOf(shown, 128);
    const double light = meanOf(truth, surface);
    const double none = rmse(irradianceBy(shown, "none"), truth, surface), aaltonen = rmse(irradianceBy(shown, "aaltonen"), truth, surface),
                 cones = rmse(irradianceBy(shown, "sub-cones"), truth, surface);
    RecordProperty("none", std::to_string(none / light));
    RecordProperty("aaltonen", std::to_string(aaltonen / light));
    RecordProperty("cones", std::to_string(cones / light));
    EXPECT_LT(cones, GetParam().error * light);
    EXPECT_LT(cones, 0.7 * aaltonen);
    EXPECT_GT(none, 2.5 * GetParam().error * light) << "there is next to no shadow to get wrong";
    shown.set("area.rays", "64");
    EXPECT_LT(rmse(irradianceBy(shown, "traced"), truth, surface), GetParam().error * light);
    expectSound(shown);
}

INSTANTIATE_TEST_SUITE_P(Truth, FieldPicturesOf,
                         testing::Values(FieldPicture{"garden", 0.08}, FieldPicture{"csg", 0.1}, FieldPicture{"clay", 0.05}),
                         [](const auto& test) { return std::string(test.param.scene); });

// A field's shadow and a mesh's are taken for independent: exact where one of them hides all or nothing.
TEST_F(FieldPictures, RaysMeetMeshesAndFields)
{
    scene::SceneFile open = darkScene();
    open.entities.push_back(lampAt({0, 1.5f, 0}));
    scene::SceneFile mesh = open, field = open, both = open;
    mesh.entities.push_back(blocker({-0.4f, 0.5f, 0}, vec3(0.3f)));
    field.entities.push_back(fieldBall({0.4f, 0.5f, 0}, 0.18f));
    both.entities.push_back(mesh.entities.back());
    both.entities.push_back(field.entities.back());
    const auto litBy = [](gpu::Device& on, const scene::SceneFile& scene) {
        Shown shown(on, scene);
        const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
        return meanOf(truthOf(shown, 256), surface);
    };
    const double all = litBy(device(), open), pastMesh = litBy(device(), mesh), pastField = litBy(device(), field),
                 pastBoth = litBy(device(), both);
    EXPECT_LT(pastMesh, 0.99 * all);
    EXPECT_LT(pastField, 0.99 * all);
    EXPECT_LT(pastBoth, std::min(pastMesh, pastField));
}

// Few steps are written out for the compiler, part by part where the camera sees them; many that melt into each other are one part, which
// is walked through (render/field_structure.h).
TEST_F(FieldPictures, WrittenOutAndWalkedThroughFieldsAreTheSame)
{
    const scene::SceneFile written = namedScene("garden");
    scene::SceneFile walked = written;
    for (size_t i = 0; i <= render::kMostWrittenSteps; ++i) {
        walked.entities.push_back(fieldBall({0, -60, 0}, 0.1f)); // out of sight
        scene::SDFPrimitive& melted = *walked.entities.back().sdfPrimitive;
        melted.operation = scene::SDFOperation::SmoothUnion;
        melted.blend = 0.1f;
        melted.order = 1000; // after all of the sculpture
    }
    struct Pictures
    {
        scene::ImageF lit, depth;
    };
    const auto shownBy = [](gpu::Device& on, const scene::SceneFile& scene) {
        Shown shown(on, scene, {320, 180});
        return Pictures{shown.capture(Aov::Irradiance), shown.capture(Aov::Depth)};
    };
    const Pictures byText = shownBy(device(), written), byWalk = shownBy(device(), walked);
    const std::vector<size_t> surface = surfaceOf(byText.depth);
    const double light = meanOf(byText.lit, surface);
    // A ray ends within 0.3 of a pixel of what it meets, wherever its march began: silhouettes and the edges of shade are a matter of that.
    const auto countOf = [&](auto&& differs) { return std::ranges::count_if(surface, differs); };
    const std::vector<float>& depths = byText.depth.values;
    EXPECT_LT(countOf([&](size_t i) { return std::abs(byWalk.depth.values[i] - depths[i]) > 0.01f * depths[i]; }),
              0.001 * static_cast<double>(surface.size()));
    EXPECT_LT(countOf([&](size_t i) { return glm::distance(pixelOf(byWalk.lit, i), pixelOf(byText.lit, i)) > 0.1 * light; }),
              0.005 * static_cast<double>(surface.size()));
}

TEST_F(FieldPictures, WhereNothingAsksForFieldsNothingIsThere)
{
    scene::SceneFile scene = darkScene();
    scene.entities.push_back(lampAt({0, 1, 0}));
    Shown without(device(), scene);
    without.draw();
    EXPECT_THAT(stepsOf(without), Not(Contains("sdf shadow")));
    scene.entities.push_back(fieldBall({0, 0.4f, 0}, 0.2f));
    Shown with(device(), scene);
    with.draw();
    EXPECT_THAT(stepsOf(with), Contains("sdf shadow"));
    for (const auto& [key, value] : {std::pair("sdf.shadow", "none"), std::pair("area.shadow", "traced")}) {
        Shown off(device(), scene);
        off.set(key, value);
        off.draw();
        EXPECT_THAT(stepsOf(off), Not(Contains("sdf shadow"))) << key;
    }
}

// Light of the environment that a field hides is that of the closed form: FormFactorTest.
TEST_F(FieldPictures, HideLightOfTheEnvironmentWhereThereIsNoMeshToo)
{
    scene::SceneFile scene = emptyScene();
    scene.entities = {fieldBall({-0.4f, 0.5f, 0}, 0.4f), fieldBall({0.4f, 0.5f, 0}, 0.4f)};
    Shown shown(device(), scene);
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    const scene::ImageF occluded = shown.capture(Aov::Occluded), truth = shown.reference(1024);
    const double light = meanOf(shown.capture(Aov::Unshadowed), surface);
    EXPECT_GT(meanOf(truth, surface), 0.01 * light);
    EXPECT_LT(rmse(occluded, truth, surface), 0.02 * light);
    // Only what the other ball hides: nothing hides light from itself that is convex.
    scene.entities.pop_back();
    Shown alone(device(), scene);
    const std::vector<size_t> ball = surfaceOf(alone.capture(Aov::Depth));
    EXPECT_LT(meanOf(alone.capture(Aov::Occluded), ball), 0.002 * light);
    expectSound(shown);
}

// Rays of ray-query find fields by their boxes in the acceleration structure, those of compute-bvh ask each.
TEST_F(FieldPictures, AreMetByRaysOfBothBackEnds)
{
    scene::SceneFile scene = emptyScene();
    for (const float height : {0.3f, 0.8f})
        for (const float aside : {-0.5f, 0.0f, 0.5f})
            scene.entities.push_back(fieldBall({aside, height, 0}, 0.2f));
    Shown shown(device(), scene);
    const auto occludedBy = [&](const Backend& backend) {
        shown.set("occlusion.backend", backend.name);
        scene::ImageF occluded = shown.capture(Aov::Occluded);
        const bool hasBoxes = backend.backend == render::RayBackend::RayQuery && device().info().rayQuery;
        EXPECT_EQ(std::ranges::count(stepsOf(shown), "box builds"), hasBoxes ? 1 : 0) << backend.name;
        return occluded;
    };
    const scene::ImageF queried = occludedBy(kRayQuery), asked = occludedBy(kComputeBvh);
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    EXPECT_GT(meanOf(queried, surface), 0.01 * meanOf(shown.capture(Aov::Unshadowed), surface));
    EXPECT_EQ(queried.values, asked.values);
    expectSound(shown);
    shown.set("occlusion.backend", "ray-query");
    shown.view().fieldSteps.clear();
    shown.draw();
    EXPECT_THAT(stepsOf(shown), Not(Contains("box builds")));
}

// What a new structure takes is made beside the frames: these show the fields as they were, then as they are, and nothing between.
TEST_F(FieldPictures, StayUntilWhatANewStructureTakesIsMade)
{
    const auto sceneOf = [](bool isRing) {
        scene::SceneFile scene = darkScene();
        scene.entities.push_back(lampAt({0, 1.5f, 0}));
        scene.entities.push_back(fieldBall({0, 0.5f, 0}, 0.2f));
        if (isRing)
            *scene.entities.back().sdfPrimitive = {.shape = scene::SDFShape::Torus, .radius = 0.3f, .minorRadius = 0.1f};
        return scene;
    };
    Shown shown(device(), sceneOf(false)), changed(device(), sceneOf(true));
    const scene::ImageF before = shown.capture(Aov::Irradiance), after = changed.capture(Aov::Irradiance);
    shown.view().waitsForPipelines = false;
    const std::vector<render::FieldStepDraw> ball = shown.view().fieldSteps;
    shown.view().fieldSteps = changed.view().fieldSteps;
    EXPECT_EQ(shown.capture(Aov::Irradiance).values, before.values);
    EXPECT_TRUE(shown.renderer().report().hasLateFields);
    const auto start = std::chrono::steady_clock::now();
    scene::ImageF now = before;
    while (now.values == before.values && std::chrono::steady_clock::now() - start < std::chrono::seconds(60))
        now = shown.capture(Aov::Irradiance);
    EXPECT_EQ(now.values, after.values);
    EXPECT_FALSE(shown.renderer().report().hasLateFields);
    // What was made once is there at once.
    shown.view().fieldSteps = ball;
    EXPECT_EQ(shown.capture(Aov::Irradiance).values, before.values);
    expectSound(shown);
}

TEST_F(FieldPictures, MovingFieldsTakeNoMemory)
{
    Shown shown(device(), namedScene("garden"));
    shown.set("area.scale", "1/4");
    const auto move = [&] {
        for (render::FieldStepDraw& step : shown.view().fieldSteps)
            step.step.localFromWorld[1].w += 0.003f;
        shown.draw();
    };
    for (int i = 0; i < 6; ++i)
        move();
    const uint64_t before = shown.renderer().memory().allocationsEver;
    for (int i = 0; i < 10; ++i)
        move();
    EXPECT_EQ(shown.renderer().memory().allocationsEver, before);
    expectSound(shown);
}

} // namespace
} // namespace antumbra::truth
