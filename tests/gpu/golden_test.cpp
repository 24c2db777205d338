// The golden cases through the core of `antumbra eval`.
#include "app/eval.h"
#include "base/error.h"
#include "gpu/device_fixture.h"
#include "unit/test_folder.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

namespace antumbra::app {
namespace {

class Golden : public DeviceTest
{
protected:
    /// A file of these cases; it stays until the next test.
    static Path written(const std::string& text)
    {
        static const TestFolder folder;
        Path file = folder / "cases.json";
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

TEST_F(Golden, Area)
{
    if (!std::filesystem::exists(golden("area.json")))
        GTEST_SKIP() << golden("area.json") << " is not there";
    expectAllRight(evaluateArea(device(), golden("area.json")));
}

/// Over the cases of that class, of what evaluateSdf found.
double rmseOfClass(const Path& file, const Evaluation& evaluation, std::string_view name)
{
    const nlohmann::json document = nlohmann::json::parse(readText(file));
    const nlohmann::json results = nlohmann::json::parse(evaluation.results);
    const nlohmann::json& cases = document.is_array() ? document : document["cases"];
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < cases.size(); ++i)
        if (cases[i]["class"] == name) {
            sum += std::pow(results[i]["visibility"].get<double>() - cases[i]["visibility"].get<double>(), 2);
            ++count;
        }
    return std::sqrt(sum / count);
}

TEST_F(Golden, SixteenConesSeeWhatOneEdgeIsNot)
{
    if (!std::filesystem::exists(golden("sdf.json")))
        GTEST_SKIP() << golden("sdf.json") << " is not there";
    const Evaluation evaluation = evaluateSdf(device(), golden("sdf.json"), {.cones = 16});
    for (const char* name :
         {"thin_wire_centre", "bars", "annular", "torus_hole", "slit", "thin_slab_edge", "two_depths", "horizon", "tiny_light"})
        EXPECT_LT(rmseOfClass(golden("sdf.json"), evaluation, name), 0.03) << name;
}

TEST_F(Golden, Sdf)
{
    if (!std::filesystem::exists(golden("sdf.json")))
        GTEST_SKIP() << golden("sdf.json") << " is not there";
    for (const auto& [cones, bound] : {std::pair(1u, 0.08), std::pair(4u, 0.04), std::pair(7u, 0.03), std::pair(16u, 0.02)}) {
        const Evaluation evaluation = evaluateSdf(device(), golden("sdf.json"), {.cones = cones});
        EXPECT_LT(rmseOfClass(golden("sdf.json"), evaluation, "random"), bound) << cones;
        if (cones >= 7)
            expectAllRight(evaluation);
    }
    const Evaluation one = evaluateSdf(device(), golden("sdf.json"), {.shadow = render::FieldShadow::Cone});
    const Evaluation unsigned_ = evaluateSdf(device(), golden("sdf.json"), {.shadow = render::FieldShadow::Aaltonen});
    EXPECT_LT(rmseOfClass(golden("sdf.json"), one, "random"), 0.08);
    EXPECT_LT(rmseOfClass(golden("sdf.json"), one, "random"), rmseOfClass(golden("sdf.json"), unsigned_, "random"));
}

TEST_F(Golden, AnEmptyListIsDone)
{
    const Path file = written(R"({"cases": []})");
    for (const Evaluation& evaluation : {evaluateCones(device(), file), evaluateIrradiance(device(), file), evaluateArea(device(), file)}) {
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
        EXPECT_THROW((void)evaluateArea(device(), file), Error) << text;
    }
}

// A light of 2 m by 2 m, 1 m over the point, with a card before it: right but for what a test puts in place of a part.
std::string areaCase(std::string_view part = "", std::string_view instead = "")
{
    std::string text = R"({"cases": [{"id": "one", "x": [0, 0, 0], "normal": [0, 0, 1], "tangent": [1, 0, 0],
        "ltc_inv": [1, 0, 0, 0, 1, 0, 0, 0, 1],
        "light": {"vertices": [[-1, -1, 1], [-1, 1, 1], [1, 1, 1], [1, -1, 1]], "faces": [[0, 1, 2, 3]], "two_sided": false},
        "occluders": [{"kind": "card", "vertices": [[-1, -1, 0.5], [0, -1, 0.5], [0, 1, 0.5], [-1, 1, 0.5]], "faces": [[0, 1, 2, 3]]}],
        "expected": {"unoccluded": 0.5541, "shadowed": 0.2771}, "tolerance_abs": 1e-4}]})";
    if (!part.empty())
        text.replace(text.find(part), part.size(), instead);
    return text;
}

// The share of a centred square, twice as wide as it is distant, is 4 atan(1 / sqrt 2) / (pi sqrt 2) = 0.5541; the card hides one half of
// it.
TEST_F(Golden, AWrongShareIsOutOfTolerance)
{
    EXPECT_EQ(evaluateArea(device(), written(areaCase())).comparison.outOfTolerance(), 0u);
    const Comparison wrong = evaluateArea(device(), written(areaCase("0.2771", "0.2791"))).comparison;
    EXPECT_EQ(wrong.outOfTolerance(), 1u);
    EXPECT_NEAR(wrong.worst(), 0.002, 1e-4);
}

TEST_F(Golden, MalformedAreaCasesAreRefusedByNameOfTheFile)
{
    constexpr std::pair<const char*, const char*> kFaults[] = {
        {R"("x": [0, 0, 0])", R"("x": [0, 0])"},
        {R"("tangent": [1, 0, 0])", R"("tangent": "x")"},
        {R"("ltc_inv": [1, 0, 0, )", R"("ltc_inv": [)"},
        {R"("ltc_inv": [1)", R"("ltc_inv": [1e99)"},
        {R"("light": {"vertices")", R"("light": {"points")"},
        {R"([-1, -1, 1])", R"([-1, -1])"},
        {R"([-1, -1, 1])", R"([-1, null, 1])"},
        {R"("faces": [[0, 1, 2, 3]])", R"("faces": [])"},
        {R"("faces": [[0, 1, 2, 3]])", R"("faces": [[0, 1]])"},
        {R"("faces": [[0, 1, 2, 3]])", R"("faces": [[0, 1, 4]])"},
        {R"("faces": [[0, 1, 2, 3]])", R"("faces": [[0, 1, -1]])"},
        {R"("faces": [[0, 1, 2, 3]])", R"("faces": [[0, 1, 2], [0, 1, 3]])"},
        {R"("faces": [[0, 1, 2, 3]])", R"("faces": [[0, 1, 2], [0, 2, 3]])"},
        {R"("two_sided": false)", R"("two_sided": 2)"},
        {R"("kind": "card")", R"("kind": "cord")"},
        {R"("kind": "card")", R"("kind": "convex")"},
        {R"("unoccluded": 0.5541, )", ""},
    };
    for (const auto& [part, instead] : kFaults) {
        const Path file = written(areaCase(part, instead));
        try {
            (void)evaluateArea(device(), file);
            ADD_FAILURE() << instead << " in place of " << part;
        } catch (const Error& error) {
            EXPECT_EQ(error.which, file.string()) << instead;
        }
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
