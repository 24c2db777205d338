// Shadows of sphere lights past distance fields against rays: the paper's order of methods, and what more cones bring
// (methods/sdf-cones.md); and quad lights by cells. 128 x 72 pixels and 196 rays; 256 x 144 and 400 where ANTUMBRA_LONG is set.
#include "app/measure.h"
#include "gpu/device_fixture.h"
#include "gpu/field_upload.h"
#include "gpu/kernel.h"
#include "truth/field_scenes.h"

#include <atomic>
#include <cstdlib>

namespace antumbra::truth {
namespace {

using scene::ImageF;

struct Method
{
    std::string_view name;
    std::string_view define;
    uint32_t cones = 0;
};

constexpr Method kQuilez{"quilez", "QUILEZ"}, kAaltonen{"aaltonen", "AALTONEN"}, kCone{"cone", "ONE_CONE"},
    kFour{"sub-cones 4", "SUB_CONES", 4}, kSeven{"sub-cones 7", "SUB_CONES", 7}, kSixteen{"sub-cones 16", "SUB_CONES", 16};

struct Measured
{
    double rmse = 0;
    double ssim = 0;
    double evaluations = 0; // a receiver
};

class FieldShadows : public DeviceTest
{
protected:
    static bool isLong() { return std::getenv("ANTUMBRA_LONG") != nullptr; }
    static uvec2 extent() { return isLong() ? uvec2(256, 144) : uvec2(128, 72); }

    static ImageF picture(const std::vector<FieldReceiver>& receivers, const std::vector<double>& values, uint32_t channels)
    {
        ImageF image{extent().x, extent().y, channels, std::vector<float>(size_t{extent().x} * extent().y * channels)};
        for (size_t i = 0; i < receivers.size(); ++i)
            for (uint32_t channel = 0; channel < channels; ++channel)
                image.values[receivers[i].pixel * channels + channel] = static_cast<float>(values[i]);
        return image;
    }

    static app::Truth truthOf(const FieldScene& scene, const std::vector<FieldReceiver>& receivers)
    {
        const std::vector<double> seen = eachOf(receivers, [&](const FieldReceiver& at, uint32_t seed) {
            return sphereSeen(scene.steps, at.position, glm::dvec3(scene.light), double{scene.radius}, isLong() ? 20 : 14, seed);
        });
        const std::vector<double> ones(receivers.size(), 1);
        return {picture(receivers, seen, 3), picture(receivers, ones, 3), picture(receivers, ones, 1)};
    }

    Measured measure(const FieldScene& scene, const std::vector<FieldReceiver>& receivers, const app::Truth& truth, const Method& method)
    {
        const FieldUpload uploaded(device(), {scene.steps});
        std::vector<FieldAsk> asks;
        for (const FieldReceiver& at : receivers)
            asks.push_back({vec3(at.position), scene.light, scene.radius, method.cones, uploaded[0]});
        std::vector<double> seen;
        double evaluations = 0;
        for (const FieldSaid& each : runKernel<FieldSaid>(device(), kFieldKernel, method.define, asks)) {
            seen.push_back(each.value);
            evaluations += each.evaluations;
        }
        const app::ImageError error = app::errorOf(picture(receivers, seen, 3), truth);
        const Measured measured{error.rmse, error.ssim, evaluations / static_cast<double>(receivers.size())};
        std::printf("%-6s %-13s RMSE %.4f  SSIM %.4f  evaluations %.1f\n", scene.name.c_str(), std::string(method.name).c_str(),
                    measured.rmse, measured.ssim, measured.evaluations);
        return measured;
    }
};

TEST_F(FieldShadows, ConesKeepThePapersOrderAndSubConesComeClose)
{
    Measured seven, quilez;
    for (const FieldScene& scene : fieldScenes()) {
        const std::vector<FieldReceiver> receivers = receiversOf(scene, extent());
        const app::Truth truth = truthOf(scene, receivers);
        const Measured unsigned_ = measure(scene, receivers, truth, kAaltonen), one = measure(scene, receivers, truth, kCone),
                       signed_ = measure(scene, receivers, truth, kQuilez), four = measure(scene, receivers, truth, kFour),
                       sub = measure(scene, receivers, truth, kSeven), sixteen = measure(scene, receivers, truth, kSixteen);
        EXPECT_GT(one.ssim, unsigned_.ssim) << scene.name;
        EXPECT_LT(one.rmse, unsigned_.rmse) << scene.name;
        EXPECT_LT(four.rmse, one.rmse) << scene.name;
        EXPECT_LT(sub.rmse, four.rmse) << scene.name;
        EXPECT_LT(sixteen.rmse, sub.rmse) << scene.name;
        seven.rmse += sub.rmse / 4;
        seven.ssim += sub.ssim / 4;
        seven.evaluations += sub.evaluations / 4;
        quilez.evaluations += signed_.evaluations / 4;
    }
    std::printf("mean sub-cones 7: RMSE %.4f SSIM %.4f, %.2f times the evaluations of quilez\n", seven.rmse, seven.ssim,
                seven.evaluations / quilez.evaluations);
    EXPECT_LE(seven.rmse, 0.015);
    EXPECT_GE(seven.ssim, 0.98);
    EXPECT_LE(seven.evaluations, 1.5 * quilez.evaluations);
}

class FieldCells : public DeviceTest
{
protected:
    static constexpr uvec2 kExtent{96, 54};

    /// Those whose horizon the whole quad is over or crosses.
    static std::vector<FieldReceiver> litReceivers(const FieldScene& scene, const FieldQuad& quad)
    {
        std::vector<FieldReceiver> receivers = receiversOf(scene, kExtent);
        std::erase_if(receivers, [&](const FieldReceiver& at) { return quadSeen({}, at, quad, 4, 0).whole < 1e-6; });
        return receivers;
    }

    Measured cells(const FieldScene& scene, const FieldQuad& quad, const std::vector<FieldReceiver>& receivers,
                   const std::vector<double>& truth, uint32_t count, std::string_view define = "CELLS")
    {
        const FieldUpload uploaded(device(), {scene.steps});
        std::vector<CellsAsk> asks;
        for (const FieldReceiver& at : receivers)
            asks.push_back({vec3(at.position), vec3(at.normal), vec3(quad.corner), vec3(quad.a), vec3(quad.b), count, uploaded[0]});
        Measured measured;
        const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, define, asks);
        for (size_t i = 0; i < said.size(); ++i) {
            EXPECT_TRUE(said[i].value >= 0 && said[i].value <= 1) << scene.name;
            measured.rmse += std::pow(said[i].value - truth[i], 2) / static_cast<double>(said.size());
            measured.evaluations += static_cast<double>(said[i].evaluations) / static_cast<double>(said.size());
        }
        measured.rmse = std::sqrt(measured.rmse);
        return measured;
    }

    static Measured rays(const FieldScene& scene, const FieldQuad& quad, const std::vector<FieldReceiver>& receivers,
                         const std::vector<double>& truth, int side)
    {
        std::atomic<uint64_t> evaluations = 0;
        const std::vector<double> seen = eachOf(receivers, [&](const FieldReceiver& at, uint32_t seed) {
            const QuadSeen found = quadSeen(scene.steps, at, quad, side, seed + 1000000);
            evaluations += found.evaluations;
            return found.share;
        });
        Measured measured{.evaluations = static_cast<double>(evaluations) / static_cast<double>(receivers.size())};
        for (size_t i = 0; i < seen.size(); ++i)
            measured.rmse += std::pow(seen[i] - truth[i], 2) / static_cast<double>(seen.size());
        measured.rmse = std::sqrt(measured.rmse);
        return measured;
    }
};

TEST_F(FieldCells, EightCellsSeeQuadsAsManyRaysDo)
{
    for (const FieldScene& scene : fieldScenes()) {
        const FieldQuad quad = quadOf(scene);
        const std::vector<FieldReceiver> receivers = litReceivers(scene, quad);
        const std::vector<double> truth =
            eachOf(receivers, [&](const FieldReceiver& at, uint32_t seed) { return quadSeen(scene.steps, at, quad, 20, seed).share; });
        const auto told = [&](const char* what, int count, const Measured& found) {
            std::printf("%-6s %2d %-12s RMSE %.4f  evaluations %.1f\n", scene.name.c_str(), count, what, found.rmse, found.evaluations);
            return found;
        };
        const Measured one = told("cells", 1, cells(scene, quad, receivers, truth, 1)),
                       eight = told("cells", 8, cells(scene, quad, receivers, truth, 8)),
                       many = told("cells", 32, cells(scene, quad, receivers, truth, 32));
        const Measured paper = told("edge samples", 64, cells(scene, quad, receivers, truth, 64, "EDGE_SAMPLES"));
        EXPECT_LE(eight.rmse, 0.02) << scene.name;
        EXPECT_LT(eight.rmse, 0.5 * paper.rmse) << scene.name;
        EXPECT_LT(eight.rmse, one.rmse) << scene.name;
        EXPECT_LT(many.rmse, eight.rmse) << scene.name;
        for (const int side : {3, 4}) {
            const Measured traced = told("rays", side * side, rays(scene, quad, receivers, truth, side));
            EXPECT_GT(traced.evaluations, 3 * eight.evaluations) << scene.name;
            EXPECT_GT(traced.rmse, eight.rmse) << scene.name;
        }
    }
}

} // namespace
} // namespace antumbra::truth
