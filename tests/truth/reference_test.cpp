// The reference against itself and against a closed form; the occlusion pass against the reference.
#include "truth/shown.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace antumbra::truth {
namespace {

using render::Aov;

class ReferenceTest : public DeviceTest
{
};

class FormFactorTest : public BackendTest<std::tuple<Backend, bool>>
{
};

/// Of triangles, or a distance field.
scene::SceneFile sphereOnPlane(bool isField)
{
    scene::SceneFile scene = emptyScene();
    scene.entities = {staticShape(scene::MeshKind::Plane, {0, 0, 0}, {6, 1, 6}),
                      isField ? fieldBall({0, 0.5f, 0}, 0.5f) : movingShape(scene::MeshKind::Sphere, {0, 0.5f, 0}, {1, 1, 1})};
    return scene;
}

/// What the next `samples` have to say that the first `samples` have not.
scene::ImageF secondHalf(const scene::ImageF& first, const scene::ImageF& both)
{
    scene::ImageF second = both;
    for (size_t i = 0; i < both.values.size(); ++i)
        second.values[i] = 2 * both.values[i] - first.values[i];
    return second;
}

TEST_F(ReferenceTest, DisjointHalvesAgreeTheBetterTheLongerTheyAre)
{
    for (const char* name : {"plaza", "hall"}) {
        SCOPED_TRACE(name);
        Shown shown(device(), namedScene(name));
        const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
        const double light = meanOf(shown.capture(Aov::Unshadowed), surface);
        const scene::ImageF first64 = shown.reference(64), first128 = shown.reference(128);
        const scene::ImageF first512 = shown.reference(512), first1024 = shown.reference(1024);
        const double few = rmse(first64, secondHalf(first64, first128), surface);
        const double many = rmse(first512, secondHalf(first512, first1024), surface);
        EXPECT_GT(few, 0) << "the halves are the same samples";
        EXPECT_LT(many, 0.5 * few);
        EXPECT_LT(many / light, 0.02);
    }
}

TEST_F(ReferenceTest, StartsAnewWhenTheViewChanges)
{
    Shown shown(device(), namedScene("plaza"));
    const scene::ImageF before = shown.reference(128);
    const float rotation = shown.view().environment.rotationRadians;
    shown.view().environment.rotationRadians += 1;
    const scene::ImageF turned = shown.reference(128);
    shown.view().environment.rotationRadians = rotation;
    EXPECT_NE(turned.values, before.values);
    EXPECT_EQ(shown.reference(128).values, before.values);
}

TEST_F(ReferenceTest, TheErrorOfThePassFallsWithItsSamples)
{
    Shown shown(device(), namedScene("plaza"));
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    const scene::ImageF truth = shown.reference(2048);
    const auto errorWith = [&](const char* samples) {
        shown.set("occlusion.samples", samples);
        return rmse(shown.capture(Aov::Occluded), truth, surface);
    };
    const double with32 = errorWith("32"), with128 = errorWith("128"), with512 = errorWith("512");
    EXPECT_LT(with128, 0.6 * with32);
    EXPECT_LT(with512, 0.6 * with128);
    EXPECT_LT(with512 / meanOf(shown.capture(Aov::Unshadowed), surface), 0.01);
}

struct FormFactorError
{
    double rmse = 0, bias = 0, greatest = 0; // as shares of the unshadowed irradiance, pi
};

/// Beside the closed form, on the plane: a sphere wholly above the horizon hides (r/d)^2 cos(theta) of uniform light, and one that rests
/// on the plane is.
FormFactorError formFactorError(Shown& shown, const scene::ImageF& depth, const scene::ImageF& occluded)
{
    FormFactorError error;
    size_t count = 0;
    double darkest = 0;
    for (const size_t pixel : surfaceOf(depth)) {
        const vec3 position =
            positionAt(shown.view().camera, Shown::kExtent, {pixel % Shown::kExtent.x, pixel / Shown::kExtent.x}, depth.values[pixel]);
        if (std::abs(position.y) > 1e-3f)
            continue; // the sphere itself
        const double expected = 0.25 * 0.5 / std::pow(glm::distance(position, vec3(0, 0.5f, 0)), 3);
        const double off = pixelOf(occluded, pixel).y / std::numbers::pi - expected;
        error.rmse += off * off;
        error.bias += off;
        error.greatest = std::max(error.greatest, std::abs(off));
        darkest = std::max(darkest, expected);
        ++count;
    }
    EXPECT_GT(count, 1000u);
    EXPECT_GT(darkest, 0.5) << "the contact is not in view";
    error.rmse = std::sqrt(error.rmse / static_cast<double>(count));
    error.bias /= static_cast<double>(count);
    return error;
}

TEST_P(FormFactorTest, TheReferenceFindsIt)
{
    Shown shown(device(), sphereOnPlane(std::get<bool>(GetParam())));
    shown.set("occlusion.backend", backend().name);
    const FormFactorError error = formFactorError(shown, shown.capture(Aov::Depth), shown.reference(4096));
    EXPECT_LT(error.rmse, 0.001);
    EXPECT_NEAR(error.bias, 0, 0.0003) << "the sphere's facets alone make 0.00013";
    EXPECT_LT(error.greatest, 0.006);
}

TEST_P(FormFactorTest, ThePassFindsItWithEveryCulling)
{
    Shown shown(device(), sphereOnPlane(std::get<bool>(GetParam())));
    shown.set("occlusion.backend", backend().name);
    shown.set("occlusion.samples", "1024");
    const scene::ImageF depth = shown.capture(Aov::Depth);
    for (const char* culling : {"none", "direction", "length", "bones"}) {
        SCOPED_TRACE(culling);
        shown.set("occlusion.culling", culling);
        const FormFactorError error = formFactorError(shown, depth, shown.capture(Aov::Occluded));
        EXPECT_LT(error.rmse, 0.002);
        EXPECT_NEAR(error.bias, 0, 0.0003);
        EXPECT_LT(error.greatest, 0.008);
    }
}

INSTANTIATE_TEST_SUITE_P(Truth, FormFactorTest, testing::Combine(testing::Values(kRayQuery, kComputeBvh), testing::Bool()),
                         [](const auto& test) {
                             return backendName({std::get<Backend>(test.param), 0}) + (std::get<bool>(test.param) ? "Field" : "Triangles");
                         });

} // namespace
} // namespace antumbra::truth
