// Baked light at run time: bakes made by hand, drawn, against the picture without a bake and against the look-ups on the CPU.
#include "truth/baked.h"

#include "bake/look_up.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace antumbra::truth {
namespace {

using render::Aov;
using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;

const std::vector<std::string> kRelightPasses{"prt relight", "volume relight"};

class PrtTest : public DeviceTest
{
};

class PrtBandsTest : public DeviceTest, public testing::WithParamInterface<uint32_t>
{
};

class PrtBackendTest : public BackendTest<Backend>
{
};

/// Root mean square error of a picture against another, as a share of the light there.
double relativeError(const scene::ImageF& picture, const scene::ImageF& truth, const std::vector<size_t>& pixels, double light)
{
    return rmse(picture, truth, pixels) / light;
}

TEST_P(PrtBackendTest, AnOpenPlaneLooksAsItDoesUnbaked)
{
    const bake::Bake bake = openBake(3);
    ShownGround unbaked(device(), nullptr), baked(device(), &bake);
    for (const float rotation : {2.0f, 4.5f}) {
        SCOPED_TRACE(rotation);
        for (ShownGround* shown : {&unbaked, &baked}) {
            shown->set("occlusion.backend", backend().name);
            shown->view().environment.rotationRadians = rotation;
        }
        const std::vector<size_t> surface = surfaceOf(unbaked.capture(Aov::Depth));
        const double light = meanOf(unbaked.capture(Aov::Unshadowed), surface);
        ASSERT_GT(light, 0.1);
        for (const Aov aov : {Aov::Unshadowed, Aov::Occluded, Aov::Irradiance})
            EXPECT_LT(relativeError(baked.capture(aov), unbaked.capture(aov), surface, light), 1e-3) << static_cast<int>(aov);
        EXPECT_LT(relativeError(baked.reference(128), unbaked.reference(128), surface, light), 1e-3);
        EXPECT_GT(meanOf(baked.capture(Aov::Occluded), surface) / light, 0.02) << "nothing casts a shadow";
    }
}

struct SurfacePixel
{
    size_t pixel;
    vec3 position, normal;
    bool isGround;
};

std::vector<SurfacePixel> surfacePixels(Shown& shown)
{
    const scene::ImageF depth = shown.capture(Aov::Depth), normals = shown.capture(Aov::Normal);
    std::vector<SurfacePixel> found;
    for (const size_t pixel : surfaceOf(depth)) {
        const uvec2 place(pixel % Shown::kExtent.x, pixel / Shown::kExtent.x);
        const vec3 position = positionAt(shown.view().camera, Shown::kExtent, place, depth.values[pixel]);
        found.push_back({pixel, position, pixelOf(normals, pixel), std::abs(position.y) < 1e-3f});
    }
    return found;
}

TEST_P(PrtBandsTest, PixelsShowWhatTheLookUpsOnTheCpuFind)
{
    const bake::Bake bake = randomBake(GetParam(), 7);
    ShownGround shown(device(), &bake);
    for (const char* window : {"0", "0.3"}) {
        SCOPED_TRACE(window);
        shown.set("prt.window", window);
        const bake::ShFunction light = environmentLight(shown, GetParam());
        const scene::ImageF unshadowed = shown.capture(Aov::Unshadowed);
        const double scale = glm::length(light.coefficients[0]);
        double greatest[2]{}, sum[2]{};
        for (const SurfacePixel& at : surfacePixels(shown)) {
            const glm::dvec3 expected = at.isGround ? bake::atlasIrradiance(bake, light, groundUv(at.position))
                                                    : bake::localIrradiance(bake, light, at.position, at.normal);
            const double off = glm::length(glm::dvec3(pixelOf(unshadowed, at.pixel)) - expected) / scale;
            greatest[at.isGround ? 0 : 1] = std::max(greatest[at.isGround ? 0 : 1], off);
            sum[at.isGround ? 0 : 1] += glm::length(expected) / scale;
        }
        for (const int where : {0, 1}) {
            EXPECT_LT(greatest[where], 0.02) << where;
            EXPECT_GT(sum[where], 100 * greatest[where]) << "there is light to compare";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Truth, PrtBandsTest, testing::Values(2, 3, 4, 5), testing::PrintToStringParamName());

TEST_F(PrtTest, TheFifthBandHasNoColourWhereTheMeanIsNothing)
{
    const bake::Bake bake = bakeOf(3, {openTexel, [](uint32_t j, uint32_t i) { return j >= 16 && i == 0 ? 1.0 : 0.0; }});
    ShownGround shown(device(), &bake);
    const scene::ImageF unshadowed = shown.capture(Aov::Unshadowed);
    size_t count = 0;
    for (const SurfacePixel& at : surfacePixels(shown))
        if (!at.isGround) {
            ASSERT_EQ(pixelOf(unshadowed, at.pixel), vec3(0)) << at.pixel;
            ++count;
        }
    EXPECT_GT(count, 100u);
}

TEST_P(PrtBackendTest, HalfTheLocalLightHidesHalfAsMuch)
{
    const bake::Bake whole = openBake(3), half = bakeOf(3, {openTexel, [](uint32_t j, uint32_t i) { return 0.5 * openCell(j, i); }});
    ShownGround full(device(), &whole), halved(device(), &half);
    std::vector<size_t> ground;
    for (const SurfacePixel& at : surfacePixels(full))
        if (at.isGround)
            ground.push_back(at.pixel);
    for (ShownGround* shown : {&full, &halved})
        shown->set("occlusion.backend", backend().name);
    for (const bool isReference : {false, true}) {
        const scene::ImageF hidden = isReference ? full.reference(64) : full.capture(Aov::Occluded);
        scene::ImageF less = isReference ? halved.reference(64) : halved.capture(Aov::Occluded);
        for (float& value : less.values)
            value *= 2;
        EXPECT_GT(meanOf(hidden, ground), 0.01);
        EXPECT_LT(relativeError(less, hidden, ground, meanOf(hidden, ground)), 2e-3) << isReference;
    }
}

TEST_P(PrtBackendTest, WhatIsHiddenBeyondTheBakedLightIsClampedAndCounted)
{
    const bake::Bake dim = bakeOf(3, {[](uint32_t i) { return 0.1 * openTexel(i); }, openCell});
    ShownGround shown(device(), &dim);
    shown.set("occlusion.backend", backend().name);
    const scene::ImageF irradiance = shown.capture(Aov::Irradiance), unshadowed = shown.capture(Aov::Unshadowed);
    size_t wrong = 0;
    for (size_t i = 0; i < irradiance.values.size(); ++i)
        wrong += irradiance.values[i] >= 0 && irradiance.values[i] <= std::max(unshadowed.values[i], 0.0f) ? 0 : 1;
    EXPECT_EQ(wrong, 0u);
    const uint32_t clamped = shown.counters().clampedPixels;
    EXPECT_GT(clamped, 50u);
    const bake::Bake open = openBake(3);
    shown.view().bake = &open;
    EXPECT_LT(shown.counters().clampedPixels, clamped) << "as dark as it is bright";
}

INSTANTIATE_TEST_SUITE_P(Truth, PrtBackendTest, testing::Values(kRayQuery, kComputeBvh), backendName);

TEST_F(PrtTest, LightIsRelitInTheFramesInWhichItChangedAndInNoOther)
{
    const bake::Bake bake = openBake(3), other = openBake(3);
    ShownGround shown(device(), &bake);
    const auto expectRelit = [&](bool isRelit, const char* why) {
        shown.draw();
        for (const std::string& pass : kRelightPasses)
            EXPECT_EQ(std::ranges::count(stepsOf(shown), pass), isRelit ? 1 : 0) << pass << ", " << why;
    };
    expectRelit(true, "the first frame");
    expectRelit(false, "nothing changed");
    shown.advance(0.1f);
    expectRelit(false, "only the walker moved");
    EXPECT_EQ(std::ranges::find(shown.renderer().report().absent, "prt relight", &graph::AbsentPass::name)->reason,
              "the light did not change");
    shown.view().environment.rotationRadians += 0.1f;
    expectRelit(true, "turned");
    expectRelit(false, "it stays");
    shown.view().environment.intensity *= 2;
    expectRelit(true, "brighter");
    shown.set("prt.window", "0.1");
    expectRelit(true, "windowed");
    shown.view().camera.eye.x += 1;
    expectRelit(false, "only the camera moved");
    shown.view().bake = &other;
    expectRelit(true, "another bake");
    shown.view().statics.clear();
    shown.view().environment.rotationRadians += 0.1f;
    expectRelit(true, "turned while nothing baked is seen");
}

TEST_F(PrtTest, AfterATurnThePictureIsThatOfAFreshStart)
{
    const bake::Bake bake = randomBake(4, 3);
    ShownGround turned(device(), &bake), fresh(device(), &bake);
    const scene::ImageF before = turned.capture(Aov::Color);
    for (ShownGround* shown : {&turned, &fresh})
        shown->view().environment.rotationRadians += 1;
    const scene::ImageF after = turned.capture(Aov::Color);
    EXPECT_NE(after.values, before.values);
    EXPECT_EQ(after.values, fresh.capture(Aov::Color).values);
    turned.draw(3);
    EXPECT_EQ(turned.capture(Aov::Color).values, after.values) << "frames without a relight keep what was lit";
}

TEST_F(PrtTest, NobodySeesTheLightOfAClosedCell)
{
    const bake::Bake open = openBake(3);
    bake::Bake walled = open;
    const bake::Grid& grid = walled.volume.grid;
    const size_t cells = grid.cellCount();
    RandomInputs random(11);
    for (uint32_t cell = 0; cell < cells; ++cell) { // every second one, so that each place has an open neighbour
        if ((cell % grid.count.x + cell / grid.count.x % grid.count.y + cell / (grid.count.x * grid.count.y)) % 2 == 0)
            continue;
        walled.volume.isOpen[cell] = 0;
        for (size_t plane = 0; plane < walled.volume.planes.size() / cells; ++plane)
            walled.volume.planes[plane * cells + cell] = static_cast<uint16_t>(random.index(0x7c00)); // finite
    }
    ShownGround clear(device(), &open), hidden(device(), &walled);
    const std::vector<size_t> surface = surfaceOf(clear.capture(Aov::Depth));
    const double light = meanOf(clear.capture(Aov::Unshadowed), surface);
    for (const Aov aov : {Aov::Unshadowed, Aov::Occluded})
        EXPECT_LT(relativeError(hidden.capture(aov), clear.capture(aov), surface, light), 1e-3);

    std::ranges::fill(walled.volume.isOpen, uint8_t{1});
    ShownGround leaking(device(), &walled);
    EXPECT_GT(relativeError(leaking.capture(Aov::Unshadowed), clear.capture(Aov::Unshadowed), surface, light), 1);
    std::ranges::fill(walled.volume.isOpen, uint8_t{0});
    ShownGround buried(device(), &walled);
    const scene::ImageF dark = buried.capture(Aov::Unshadowed);
    for (const SurfacePixel& at : surfacePixels(buried))
        if (!at.isGround) {
            ASSERT_EQ(pixelOf(dark, at.pixel), vec3(0));
        }
}

TEST_F(PrtTest, WithoutABakeNothingOfItExists)
{
    const bake::Bake bake = openBake(3);
    { // grows the device's own stores to what any of these needs
        ShownGround grown(device(), &bake);
        grown.draw(4);
    }
    const uint64_t before = settledBytes(device());
    ShownGround shown(device(), nullptr);
    shown.draw(4);
    std::vector<std::string> absent;
    for (const graph::AbsentPass& pass : shown.renderer().report().absent) {
        absent.emplace_back(pass.name);
        if (std::ranges::find(kRelightPasses, absent.back()) != kRelightPasses.end()) {
            EXPECT_EQ(pass.reason, "no StaticPRT with a bake");
        }
    }
    EXPECT_THAT(absent, IsSupersetOf(kRelightPasses));
    for (const std::string& pass : kRelightPasses)
        EXPECT_THAT(stepsOf(shown), Not(Contains(pass)));
    const uint64_t unbaked = settledBytes(device()) - before;

    shown.view().bake = &bake;
    shown.draw(4);
    const uint64_t least = 2 * (bake.atlas.planes.size() + bake.volume.planes.size());
    EXPECT_GE(settledBytes(device()) - before, unbaked + least);
    shown.view().bake = nullptr;
    shown.draw(4);
    const uint64_t bakeUvs = 4096; // of the model stay with it
    EXPECT_LE(settledBytes(device()) - before, unbaked + bakeUvs) << "what is no longer baked is given back";
}

TEST_F(PrtTest, SteadyAndTurningFramesTakeNoMemory)
{
    const bake::Bake bake = openBake(3);
    ShownGround shown(device(), &bake);
    const auto turn = [&] {
        shown.view().environment.rotationRadians += 0.1f;
        shown.draw();
        shown.draw();
    };
    turn();
    turn();
    const uint64_t before = shown.renderer().memory().allocationsEver;
    for (int i = 0; i < 10; ++i)
        turn();
    EXPECT_EQ(shown.renderer().memory().allocationsEver, before);
}

} // namespace
} // namespace antumbra::truth
