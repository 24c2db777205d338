// The twin of the area lights' method against the golden cases, against rays that share nothing with it, and the device against it.
#include "app/eval_cases.h"
#include "gpu/area_cases.h"
#include "gpu/area_runner.h"
#include "gpu/area_truth.h"
#include "gpu/area_twin.h"
#include "gpu/device_fixture.h"

#include <fmt/format.h>

#include <filesystem>

namespace antumbra {
namespace {

template <class Real>
class AreaTwin : public testing::Test
{
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(AreaTwin, Reals);

TYPED_TEST(AreaTwin, GoldenCases)
{
    const Path file = Path(ANTUMBRA_SHARED_DIR) / "golden" / "area.json";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is not there";
    const app::EvalCases cases(file);
    EXPECT_GT(cases.size(), 0u);
    for (size_t first = 0; first < cases.size(); first += app::EvalCases::kBatch)
        for (const app::EvalCase& each : cases.batch(first)) {
            const AreaShares shares = areaTwin<TypeParam>(areaProblemOf(each));
            const auto expected = [&](const char* key) { return each.value["expected"][key].template get<double>(); };
            EXPECT_NEAR(shares.unoccluded, expected("unoccluded"), each.value["tolerance_abs"]) << each.id;
            EXPECT_NEAR(shares.visible, expected("shadowed"), each.value["tolerance_abs"]) << each.id;
        }
}

// Bodies that do not hold the point, since rays find a light that is in the same body.
app::AreaProblem sampledProblem(uint32_t index, RandomInputs& random)
{
    const auto make = [&](std::string_view name) {
        for (const AreaCategory& category : areaCategories())
            if (category.name == name)
                return category.make(random);
        ADD_FAILURE() << name << " is no category";
        return app::AreaProblem{};
    };
    constexpr std::string_view kNames[] = {"SharedEdges", "AcrossLightsPlane", "AcrossLightBodies",
                                           "NotConvex",   "ManyOccluders",     "Hulls42"};
    return index % 2 == 0 ? commonAreaProblem(random, 4) : make(kNames[index / 2 % std::size(kNames)]);
}

// 16 runs of a grid of 90^2 directions: the mean of the runs is off by their standard error, which itself is known to a fifth. Of 96
// values, by Student's distribution with 15 degrees of freedom, one in 500 such tests would have a value off by 7 of them.
TEST(AreaTruth, TheTwinIsWhatRaysSee)
{
    constexpr uint32_t kProblems = 48, kGrid = 90, kRuns = 16;
    constexpr double kErrors = 7;
    // Where no ray or every ray hits there is no spread; a share less than a ray's tenth goes unseen.
    constexpr double kFloor = 0.1 / (kGrid * kGrid);
    RandomInputs random(5);
    double largestError = 0;
    for (uint32_t i = 0; i < kProblems; ++i) {
        const app::AreaProblem problem = sampledProblem(i, random);
        const AreaShares shares = areaTwin<double>(problem);
        const SampledShares sampled = sampledShares(problem, kGrid, kRuns, random);
        EXPECT_NEAR(shares.unoccluded, sampled.shares.unoccluded, kErrors * sampled.standardErrors.unoccluded + kFloor) << i;
        EXPECT_NEAR(shares.visible, sampled.shares.visible, kErrors * sampled.standardErrors.visible + kFloor) << i;
        largestError = std::max({largestError, sampled.standardErrors.unoccluded, sampled.standardErrors.visible});
    }
    EXPECT_LT(largestError, 1e-3) << "else the bound says little";
}

class AreaOnDevice : public DeviceTest
{
};

// Of one problem the device has the exact sum of one order; the twin takes lights face by face and shares no text.
TEST_F(AreaOnDevice, IsTheTwin)
{
    constexpr uint32_t kCount = 3000;
    RandomInputs random(6);
    std::vector<app::AreaProblem> problems;
    for (uint32_t i = 0; i < kCount; ++i)
        problems.push_back(commonAreaProblem(random, 5));
    AreaRunner runner(device());
    const std::vector<shader::AreaAnswer> found = runner.run(problems);
    double worst = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const AreaShares expected = areaTwin<double>(problems[i]);
        EXPECT_NEAR(found[i].unoccluded, expected.unoccluded, kTolerance) << i;
        EXPECT_NEAR(found[i].shadowed, expected.visible, kTolerance) << i;
        EXPECT_EQ(found[i].fallbacks, 0u) << i;
        worst = std::max({worst, std::abs(found[i].unoccluded - expected.unoccluded), std::abs(found[i].shadowed - expected.visible)});
    }
    RecordProperty("worst", fmt::format("{:.2e}", worst));
}

} // namespace
} // namespace antumbra
