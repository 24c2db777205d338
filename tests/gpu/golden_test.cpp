// The golden cases through the core of `antumbra eval`.
#include "app/eval.h"
#include "base/error.h"
#include "gpu/device_fixture.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <unistd.h>

namespace antumbra::app {
namespace {

class Golden : public DeviceTest
{
protected:
    /// A file of these cases; it stays until the next test.
    static Path written(const std::string& text)
    {
        Path file = Path(testing::TempDir()) / ("antumbra_cases_" + std::to_string(getpid()) + ".json");
        writeText(file, text);
        return file;
    }
    static Path golden(const std::string& name) { return Path(ANTUMBRA_SHARED_DIR) / "golden" / name; }

    static void expectAllRight(const Evaluation& evaluation)
    {
        EXPECT_GT(evaluation.cases, 0u);
        EXPECT_EQ(evaluation.comparison.count(), evaluation.cases);
        EXPECT_EQ(evaluation.comparison.outOfTolerance(), 0u)
            << evaluation.comparison.worstId() << " is off by " << evaluation.comparison.worst();
        EXPECT_EQ(nlohmann::json::parse(evaluation.results).size(), evaluation.cases);
    }
};

TEST_F(Golden, Cones)
{
    if (!std::filesystem::exists(golden("cones.json")))
        GTEST_SKIP() << golden("cones.json") << " is not there";
    expectAllRight(evaluateCones(device(), golden("cones.json")));
}

TEST_F(Golden, Irradiance)
{
    if (!std::filesystem::exists(golden("irradiance.json")))
        GTEST_SKIP() << golden("irradiance.json") << " is not there";
    expectAllRight(evaluateIrradiance(device(), golden("irradiance.json")));
}

TEST_F(Golden, AnEmptyListIsDone)
{
    const Path file = written(R"({"cases": []})");
    for (const Evaluation& evaluation : {evaluateCones(device(), file), evaluateIrradiance(device(), file)}) {
        EXPECT_EQ(evaluation.cases, 0u);
        EXPECT_EQ(nlohmann::json::parse(evaluation.results), nlohmann::json::array());
    }
}

// A sphere at (0, 2, 0) seen from the origin: sin psi = 1/2, so constant light of 1 hides pi / 4.
const std::string kCase = R"({"cases": [{"id": "one", "p": [0, 0, 0], "n": [0, 1, 0], "sphere": {"center": [0, 2, 0], "radius": 1},
    "env": {"type": "const", "L": 1}, "E_occluded": ANSWER, "E_unshadowed": 3.14159265}]})";

std::string withAnswer(const std::string& answer)
{
    std::string text = kCase;
    return text.replace(text.find("ANSWER"), 6, answer);
}

TEST_F(Golden, AWrongAnswerIsOutOfTolerance)
{
    EXPECT_EQ(evaluateIrradiance(device(), written(withAnswer("0.785398"))).comparison.outOfTolerance(), 0u);
    const Comparison wrong = evaluateIrradiance(device(), written(withAnswer("0.82"))).comparison;
    EXPECT_EQ(wrong.outOfTolerance(), 1u);
    EXPECT_NEAR(wrong.worst(), (0.82 - 0.785398) / std::numbers::pi, 1e-3);
    EXPECT_EQ(wrong.worstId(), "one");
}

TEST_F(Golden, MoreCasesThanABatchHolds)
{
    nlohmann::json document = nlohmann::json::parse(withAnswer("0.785398"));
    document["cases"] = nlohmann::json::array_t(2500, document["cases"][0]);
    const Evaluation evaluation = evaluateIrradiance(device(), written(document.dump()));
    EXPECT_EQ(evaluation.comparison.count(), 2500u);
    EXPECT_EQ(evaluation.comparison.outOfTolerance(), 0u);
}

TEST_F(Golden, MalformedCasesAreRefusedByNameOfTheFile)
{
    for (const char* text : {"", "[", "[]", "{}", R"({"cases": 1})", R"({"cases": [1]})", R"({"cases": [{}]})",
                             R"({"cases": [{"id": "a"}]})", R"({"cases": [{"id": "a", "p": [0, 0], "n": [0, 1, 0], "spheres": []}]})",
                             R"({"cases": [{"id": "a", "p": [0, 0, 0], "n": [0, 0, 0], "spheres": []}]})",
                             R"({"cases": [{"id": "a", "p": [0, 0, 0], "n": [0, 1, 0], "spheres": [{"center": [0, 0, 0]}]}]})",
                             R"({"cases": [{"id": "a", "p": [0, 0, 0], "n": [0, 1, 0], "spheres": [], "cones": 1, "merged": []}]})"})
    {
        const Path file = written(text);
        try {
            (void)evaluateCones(device(), file);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.which, file.string()) << text;
        }
        EXPECT_THROW((void)evaluateIrradiance(device(), file), Error) << text;
    }
}

TEST(Comparison, NotANumberIsOutOfTolerance)
{
    Comparison comparison;
    EXPECT_EQ(comparison.rmse(), 0);
    comparison.add("right", 0.5, 1);
    comparison.add("not a number", std::numeric_limits<double>::quiet_NaN(), 1);
    EXPECT_EQ(comparison.outOfTolerance(), 1u);
    EXPECT_EQ(comparison.worstId(), "not a number");
}

} // namespace
} // namespace antumbra::app
