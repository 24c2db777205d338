// The parts of the lab that need no device: sweeps as they are read, and the figures.
#include "app/measure.h"
#include "app/sweep.h"
#include "base/error.h"
#include "unit/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace antumbra::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Sweep sweepOf(const std::string& text)
{
    const TestFolder folder;
    const Path file = folder / "sweep.json";
    writeText(file, text);
    return loadSweep(file);
}

std::string refusal(const std::string& text)
{
    try {
        sweepOf(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::vector<std::string> namesOf(const Sweep& sweep)
{
    std::vector<std::string> names;
    for (const SweepPoint& point : sweep.points)
        names.push_back(point.name);
    return names;
}

TEST(Sweep, APointIsReadWhole)
{
    const Sweep sweep = sweepOf(R"({"name": "s", "repeats": 7, "warmup": 2, "points": [{"name": "p", "scene": "plaza", "size": [320, 180],
        "time": 0.5, "frames": 9, "animate": false, "characters": false, "reference": 4096, "settings": {"occlusion.samples": 64}}]})");
    EXPECT_EQ(sweep.name, "s");
    EXPECT_EQ(sweep.repeats, 7u);
    EXPECT_EQ(sweep.warmUp, 2u);
    ASSERT_EQ(sweep.points.size(), 1u);
    const SweepPoint& point = sweep.points[0];
    EXPECT_EQ(point.scene, "plaza");
    EXPECT_EQ(point.size, uvec2(320, 180));
    EXPECT_EQ(point.seconds, 0.5f);
    EXPECT_EQ(point.frames, 9u);
    EXPECT_FALSE(point.animates);
    EXPECT_FALSE(point.hasCharacters);
    EXPECT_EQ(point.referenceSamples, 4096u);
    EXPECT_EQ(point.settings, (render::Settings{{"occlusion.samples", "64"}}));
}

TEST(Sweep, AGridStandsForEveryCombination)
{
    const Sweep sweep =
        sweepOf(R"({"grid": {"occlusion.scale": ["1", "1/2"], "occlusion.samples": [32, 64]}, "points": [{"scene": "hall"}]})");
    EXPECT_THAT(namesOf(sweep), ElementsAre("hall samples=32 scale=1", "hall samples=32 scale=1/2", "hall samples=64 scale=1",
                                            "hall samples=64 scale=1/2"));
    EXPECT_EQ(sweep.points[3].settings, (render::Settings{{"occlusion.samples", "64"}, {"occlusion.scale", "1/2"}}));
}

TEST(Sweep, AGridOfItsOwnReplacesTheCommonOne)
{
    const Sweep sweep = sweepOf(R"({"grid": {"occlusion.samples": [32, 64]}, "points": [{"scene": "hall", "grid": {}}]})");
    EXPECT_THAT(namesOf(sweep), ElementsAre("hall"));
}

TEST(Sweep, ABakeIsReadWithWhatConcernsIt)
{
    const Sweep sweep = sweepOf(R"({"measure": "bakes", "points": [{"scene": "atrium", "reference": 256, "truth": "map",
        "settings": {"prt.bounces": 1}, "grid": {"prt.bands": [2, 5]}}]})");
    EXPECT_EQ(sweep.measure, Measure::Bakes);
    EXPECT_THAT(namesOf(sweep), ElementsAre("atrium bands=2", "atrium bands=5"));
    EXPECT_EQ(sweep.points[0].truth, BakeTruth::Map);
    EXPECT_EQ(sweep.points[1].settings, (render::Settings{{"prt.bounces", "1"}, {"prt.bands", "5"}}));
    EXPECT_THAT(refusal(R"({"measure": "bakes", "points": [{"scene": "atrium", "size": [320, 180]}]})"), HasSubstr("\"size\""));
    EXPECT_THAT(refusal(R"({"measure": "bakes", "points": [{"scene": "atrium", "settings": {"occlusion.samples": 32}}]})"),
                HasSubstr("does not concern bakes"));
    EXPECT_THAT(refusal(R"({"measure": "bake", "points": []})"), HasSubstr("bakes"));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "atrium", "truth": "map"}]})"), HasSubstr("\"truth\""));
}

TEST(Sweep, UnknownKeysAreRefusedWithTheNearest)
{
    EXPECT_THAT(refusal(R"({"repeat": 1, "points": []})"), AllOf(HasSubstr("\"repeat\""), HasSubstr("\"repeats\"")));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall", "referense": 1}]})"), AllOf(HasSubstr("points[0]"), HasSubstr("\"reference\"")));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall", "settings": {"occlusion.sample": 32}}]})"), HasSubstr("occlusion.samples"));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall"}], "grid": {"occlusion.cullin": ["none"]}})"), HasSubstr("occlusion.culling"));
}

TEST(Sweep, WhatCannotBeMeasuredIsRefused)
{
    EXPECT_THAT(refusal(R"({"points": []})"), HasSubstr("nothing to measure"));
    EXPECT_THAT(refusal(R"({"points": [{"name": "nowhere"}]})"), HasSubstr("needs \"scene\""));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall"}, {"scene": "hall"}]})"), HasSubstr("two are named \"hall\""));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall", "settings": {"occlusion.samples": 33}}]})"), HasSubstr("in steps of 32"));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall", "settings": {"view": "cones"}}]})"), HasSubstr("the lab's own"));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall", "grid": {"occlusion.samples": 64}}]})"), HasSubstr("an array of values"));
    EXPECT_THAT(refusal(R"({"points": [{"scene": "hall", "size": [8, 8]}]})"), HasSubstr("points[0].size"));
}

TEST(Sweep, ThoseOfTheProjectAreRead)
{
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(projectPath("tools") / "sweeps")) {
        if (entry.is_directory())
            continue; // scenes of a sweep
        EXPECT_EQ(loadSweep(entry.path()).name, entry.path().stem().string());
        ++count;
    }
    EXPECT_GE(count, 5u);
}

TEST(Sweep, ResultsDoNotTakeItsPlace)
{
    const TestFolder folder;
    const Path file = folder / "light.json";
    writeText(file, R"({"points": [{"scene": "hall"}]})");
    const Sweep sweep = loadSweep(file);
    EXPECT_THROW(checkKept(file, sweep, folder.path()), Error);
    EXPECT_NO_THROW(checkKept(file, sweep, folder / "results"));
}

TEST(Sweep, AFitNamesATimeAndCounters)
{
    const Sweep sweep = sweepOf(R"({"fit": {"time": "sky", "counters": ["a", "b"]}, "points": [{"scene": "hall"}]})");
    ASSERT_TRUE(sweep.fit);
    EXPECT_EQ(sweep.fit->time, "sky");
    EXPECT_THAT(sweep.fit->counters, ElementsAre("a", "b"));
    EXPECT_THAT(refusal(R"({"fit": {"time": "sky"}, "points": [{"scene": "hall"}]})"), HasSubstr("counters"));
}

TEST(LinearFit, FindsWhatValuesAreMadeOf)
{
    const std::vector<std::vector<double>> quantities{{1e6, 2e6, 5e6, 3e6, 1e6}, {0, 4, 1, 7, 9}};
    std::vector<double> values;
    for (size_t i = 0; i < 5; ++i)
        values.push_back(3 + 2e-6 * quantities[0][i] - 0.5 * quantities[1][i]);
    const LinearFit exact = fitLinear(quantities, values);
    EXPECT_THAT(exact.weights,
                ElementsAre(testing::DoubleNear(3, 1e-6), testing::DoubleNear(2e-6, 1e-12), testing::DoubleNear(-0.5, 1e-6)));
    EXPECT_NEAR(exact.rSquared, 1, 1e-9);
    EXPECT_NEAR(fitLinear(std::vector<std::vector<double>>{{-1, 1, -1, 1}}, std::vector<double>{0, 1, 1, 2}).rSquared, 0.5, 1e-9);
}

TEST(LinearFit, QuantitiesThatFollowFromEachOtherAreRefused)
{
    EXPECT_THROW(fitLinear(std::vector<std::vector<double>>{{1, 2, 3}, {2, 4, 6}}, std::vector<double>{1, 2, 4}), Error);
    EXPECT_THROW(fitLinear(std::vector<std::vector<double>>{{5, 5, 5}}, std::vector<double>{1, 2, 4}), Error);
}

TEST(Quartiles, LieBetweenTheValues)
{
    const Quartiles five = quartilesOf(std::vector<double>{5, 1, 4, 2, 3});
    EXPECT_EQ((std::array{five.lower, five.median, five.upper}), (std::array{2.0, 3.0, 4.0}));
    const Quartiles two = quartilesOf(std::vector<double>{10, 20});
    EXPECT_EQ((std::array{two.lower, two.median, two.upper}), (std::array{12.5, 15.0, 17.5}));
    EXPECT_EQ(quartilesOf(std::vector<double>{7}).upper, 7);
}

constexpr uint32_t kWidth = 32, kHeight = 24;

scene::ImageF filled(uint32_t channels, float value)
{
    return {kWidth, kHeight, channels, std::vector<float>(size_t{kWidth} * kHeight * channels, value)};
}

/// Irradiance 1 of 2 unshadowed, the upper half sky.
Truth halfSky()
{
    Truth truth{filled(3, 1), filled(3, 2), filled(1, 5)};
    std::fill_n(truth.depth.values.begin(), size_t{kWidth} * kHeight / 2, 0.0f);
    return truth;
}

TEST(ImageError, IsZeroForTheTruthItself)
{
    const Truth truth = halfSky();
    const ImageError error = errorOf(truth.irradiance, truth);
    EXPECT_EQ(error.rmse, 0);
    EXPECT_EQ(error.mae, 0);
    EXPECT_EQ(error.percentile99, 0);
    EXPECT_NEAR(error.ssim, 1, 1e-12);
}

TEST(ImageError, OfAConstantIsThatConstant)
{
    const Truth truth = halfSky();
    const ImageError error = errorOf(filled(3, 1.125f), truth);
    EXPECT_NEAR(error.rmse, 0.125, 1e-12);
    EXPECT_NEAR(error.relativeRmse, 0.0625, 1e-12) << "of the unshadowed irradiance, which is 2";
    EXPECT_NEAR(error.mae, 0.125, 1e-12);
    EXPECT_NEAR(error.percentile99, 0.125, 1e-12);
    EXPECT_NEAR(error.ssim, (2 * 1.125 + 4e-4) / (1 + 1.125 * 1.125 + 4e-4), 1e-9) << "means alone differ";
}

TEST(ImageError, TheSkyDoesNotCount)
{
    const Truth truth = halfSky();
    scene::ImageF shown = truth.irradiance;
    std::fill_n(shown.values.begin(), size_t{kWidth} * kHeight / 2 * 3, 1e6f);
    EXPECT_EQ(errorOf(shown, truth).rmse, 0);
    EXPECT_NEAR(errorOf(shown, truth).ssim, 1, 1e-12);
}

TEST(ImageError, TellsRareErrorsFromCommonOnes)
{
    const Truth truth = halfSky();
    const auto errorWith = [&](size_t wrongPixels) {
        scene::ImageF shown = truth.irradiance;
        std::fill_n(shown.values.end() - static_cast<std::ptrdiff_t>(3 * wrongPixels), 3 * wrongPixels, 2.0f);
        return errorOf(shown, truth);
    };
    EXPECT_LT(errorWith(2).percentile99, 1e-9) << "2 of 384 pixels";
    EXPECT_NEAR(errorWith(8).percentile99, 1, 1e-9) << "8 of 384 pixels";
    EXPECT_NEAR(errorWith(96).rmse, 0.5, 1e-9) << "a quarter of the pixels";
}

TEST(ImageError, SimilarityFallsWithNoiseOnStructure)
{
    Truth truth = halfSky();
    scene::ImageF noisy = truth.irradiance;
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, 0.1f);
    for (size_t pixel = 0; pixel < truth.depth.values.size(); ++pixel)
        for (size_t channel = 0; channel < 3; ++channel) {
            float& real = truth.irradiance.values[3 * pixel + channel];
            real = 1 + 0.5f * std::sin(0.7f * static_cast<float>(pixel % kWidth));
            noisy.values[3 * pixel + channel] = real + noise(random);
        }
    const double ssim = errorOf(noisy, truth).ssim;
    EXPECT_LT(ssim, 0.995);
    EXPECT_GT(ssim, 0.8);
}

TEST(ImageError, WhatIsNoNumberIsNotHidden)
{
    const Truth truth = halfSky();
    scene::ImageF shown = truth.irradiance;
    shown.values.back() = std::nanf("");
    EXPECT_TRUE(std::isnan(errorOf(shown, truth).rmse));
}

TEST(ImageError, NothingLitIsRefused)
{
    Truth truth = halfSky();
    truth.depth = filled(1, 0);
    EXPECT_THROW(errorOf(truth.irradiance, truth), Error);
}

} // namespace
} // namespace antumbra::app
