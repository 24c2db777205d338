// The GGX reflection against closed forms, linearly transformed cosines against what they are, and the tables that ship.
#include "bake/ltc.h"
#include "base/error.h"
#include "scene/images.h"
#include "tools/fit_ltc/errors.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace antumbra::bake {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::dvec4;

constexpr double kPiExact = std::numbers::pi;
constexpr double kAlphas[] = {0.2, 0.5, 1};
const Path kPublished = Path(ANTUMBRA_SHARED_DIR) / "assets/ltc";

Path temporary(const std::string& name)
{
    static const TestFolder folder;
    return folder / name;
}

dvec3 directionOf(double cosine, double azimuth)
{
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

double integralOverSphere(const std::function<double(const dvec3&)>& function, int rows = 400)
{
    const int columns = rows;
    double sum = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            sum += function(directionOf(1 - 2 * (row + 0.5) / rows, 2 * kPiExact * (column + 0.5) / columns));
    return 4 * kPiExact / rows / columns * sum;
}

double reflectedOf(const dvec3& view, double alpha)
{
    return integralOverSphere([&](const dvec3& light) { return ggxReflection(view, light, alpha) * std::max(light.z, 0.0); });
}

const LtcTables& shipped()
{
    static const LtcTables tables = loadLtcTables(projectPath("assets") / "fits");
    return tables;
}

/// Tables of two nodes a side that are no fit of anything.
LtcTables anyTables()
{
    LtcTables tables{.size = 2, .matrix = {}, .amplitude = {}};
    for (uint32_t i = 0; i < 4; ++i) {
        const auto step = static_cast<float>(i);
        tables.matrix.emplace_back(1 + step, 0.1f, -0.2f * step, 0.5f);
        tables.amplitude.emplace_back(0.1f * step, 0.05f * step, 0, 0);
    }
    return tables;
}

TEST(Ggx, IsReciprocal)
{
    for (const double alpha : kAlphas)
        for (int i = 0; i < 20; ++i) {
            const dvec3 view = directionOf(0.05 + 0.045 * i, 1.0 * i), light = directionOf(0.97 - 0.045 * i, 2.3 * i);
            const double there = ggxReflection(view, light, alpha);
            EXPECT_GT(there, 0);
            EXPECT_NEAR(there, ggxReflection(light, view, alpha), 1e-12 * there);
        }
    EXPECT_EQ(ggxReflection({0, 0, 1}, directionOf(-0.1, 0), 0.5), 0);
    EXPECT_EQ(ggxReflection(directionOf(-0.1, 0), {0, 0, 1}, 0.5), 0);
}

TEST(Ggx, ReflectsNoMoreThanComesIn)
{
    for (const double alpha : kAlphas)
        for (const double cosView : {0.2, 0.6, 1.0}) {
            const double reflected = reflectedOf(directionOf(cosView, 0), alpha);
            EXPECT_LE(reflected, 1) << alpha << ' ' << cosView;
            EXPECT_NEAR(fit::normsOf(cosView, alpha, fit::gridPattern(128)).magnitude, reflected, 2e-3) << alpha << ' ' << cosView;
        }
}

TEST(Ggx, RoughestSurfaceReflectsItsClosedForm)
{
    EXPECT_NEAR(reflectedOf({0, 0, 1}, 1), 1 - std::numbers::ln2, 1e-4);
    EXPECT_NEAR(fit::normsOf(1, 1, fit::gridPattern(256)).magnitude, 1 - std::numbers::ln2, 1e-4);
}

// Without shadowing every visible normal sends all of its light somewhere, below the surface too (Heitz 2014, section 4).
TEST(Ggx, MaskedNormalsPassTheWeakWhiteFurnace)
{
    for (const double alpha : kAlphas)
        for (const double cosView : {0.1, 0.5, 0.9}) {
            const dvec3 view = directionOf(cosView, 0);
            const double sum = integralOverSphere([&](const dvec3& light) {
                return ggxNormals(glm::normalize(view + light), alpha) / (1 + ggxLambda(cosView, alpha)) / (4 * cosView);
            });
            EXPECT_NEAR(sum, 1, 5e-3) << alpha << ' ' << cosView;
        }
}

TEST(Ggx, IsFiniteForTheNarrowestLobe)
{
    for (const double cosView : {kLeastCosView, 0.01, 1.0}) {
        const fit::LobeNorms norms = fit::normsOf(cosView, kLeastAlpha, fit::gridPattern(64));
        EXPECT_GT(norms.magnitude, 0.95) << cosView;
        EXPECT_LE(norms.magnitude, 1.0001) << cosView;
        EXPECT_NEAR(norms.fresnel, norms.magnitude * std::pow(1 - cosView, 5), 1e-3) << cosView;
    }
}

TEST(Ltc, OfTheIdentityIsTheClampedCosine)
{
    const Ltc cosine(dvec4(1, 0, 0, 1));
    for (int i = 0; i < 20; ++i) {
        const dvec3 direction = directionOf(-0.95 + 0.1 * i, 1.0 * i);
        EXPECT_NEAR(cosine.density(direction), std::max(direction.z, 0.0) / kPiExact, 1e-14);
    }
}

TEST(Ltc, IntegratesToOneInAnyScale)
{
    const dmat3 inverse(1.4, 0, 0.3, 0, 1, 0, -0.5, 0, 0.7);
    const auto densityOf = [](const Ltc& ltc) { return [&ltc](const dvec3& direction) { return ltc.density(direction); }; };
    for (const Ltc& ltc : {Ltc(dvec4(1, 0, 0, 1)), Ltc(inverse), Ltc(dvec4(0.6, -0.1, 0.5, 0.3))})
        EXPECT_NEAR(integralOverSphere(densityOf(ltc)), 1, 1e-3);
    const dvec3 direction = directionOf(0.4, 2);
    EXPECT_NEAR(Ltc(7.0 * inverse).density(direction), Ltc(inverse).density(direction), 1e-14);
    EXPECT_NEAR(Ltc(inverse).density(direction), Ltc(dvec4(1.4, 0.3, -0.5, 0.7)).density(direction), 1e-14) << "the order of a texel";
}

TEST(LtcTables, NodesAreTexelCentres)
{
    const LtcTables& tables = shipped();
    for (const uint32_t row : {0u, 20u, 63u})
        for (const uint32_t column : {0u, 31u, 63u}) {
            const LtcTexel found = lookUp(tables, column / 63.0, 1 - row * row / (63.0 * 63.0));
            EXPECT_LT(glm::length(found.matrix - dvec4(tables.matrix[row * 64 + column])), 1e-9) << row << ' ' << column;
            EXPECT_LT(glm::length(found.amplitude - dvec4(tables.amplitude[row * 64 + column])), 1e-9) << row << ' ' << column;
        }
    const LtcTexel middle = lookUp(anyTables(), 0.5, 0.75);
    EXPECT_NEAR(middle.matrix.x, 2.5, 1e-6);
    EXPECT_NEAR(middle.amplitude.x, 0.15, 1e-6);
    EXPECT_EQ(lookUp(tables, 2, -1).matrix, lookUp(tables, 1, 0).matrix) << "beyond the edges is the edge";
}

TEST(LtcTables, ComeBackAsTheyWereSaved)
{
    const LtcTables tables = anyTables();
    saveLtcTables(temporary("saved"), tables);
    const LtcTables loaded = loadLtcTables(temporary("saved"));
    EXPECT_EQ(loaded.size, tables.size);
    EXPECT_EQ(loaded.matrix, tables.matrix);
    EXPECT_EQ(loaded.amplitude, tables.amplitude);
}

TEST(LtcTables, WrongFilesAreRefusedByName)
{
    const Path good = temporary("good"), bad = temporary("bad.exr");
    saveLtcTables(good, anyTables());
    const auto expectRefused = [&](const Path& matrix, const Path& amplitude, const Path& culprit, const std::string& reason) {
        try {
            loadLtcTables(matrix, amplitude);
            ADD_FAILURE() << "not refused: " << reason;
        } catch (const Error& error) {
            EXPECT_EQ(error.which, culprit.string());
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    };
    const Path matrix = good / kLtcMatrixFile, amplitude = good / kLtcAmplitudeFile;
    const auto expectBad = [&](const scene::ImageF& picture, const std::string& reason) {
        scene::saveExr(bad, picture);
        expectRefused(bad, amplitude, bad, reason);
    };
    expectRefused(good / "absent.exr", amplitude, good / "absent.exr", "no such file");
    expectRefused(matrix, good / "absent.exr", good / "absent.exr", "no such file");
    expectRefused(amplitude, amplitude, amplitude, "determinant");
    expectRefused(matrix, matrix, matrix, "share");
    expectBad({2, 2, 3, std::vector<float>(12, 1)}, "3 channels");
    expectBad({2, 3, 4, std::vector<float>(24, 1)}, "2 x 3");
    expectBad({1, 1, 4, {1, 0, 0, 1}}, "1 x 1");
    expectBad({2, 2, 4, std::vector<float>(16, std::numeric_limits<float>::quiet_NaN())}, "not finite");
    scene::saveExr(bad, {3, 3, 4, std::vector<float>(36, 0.5f)});
    expectRefused(matrix, bad, bad, "3 texels a side");
    writeText(bad, "no picture");
    expectRefused(bad, amplitude, bad, "not a PNG");
}

TEST(ShippedLtcTables, AreSmallAndOfTheAgreedSize)
{
    EXPECT_EQ(shipped().size, 64u);
    const Path folder = projectPath("assets") / "fits";
    EXPECT_LE(std::filesystem::file_size(folder / kLtcMatrixFile) + std::filesystem::file_size(folder / kLtcAmplitudeFile), 256u * 1024);
}

TEST(ShippedLtcTables, AreNearTheReflectionBetweenTheirNodes)
{
    EXPECT_EQ(fit::whereOutOfBounds(fit::errorsOf(shipped(), 100)), "");
    LtcTables shifted = shipped();
    std::shift_left(shifted.matrix.begin(), shifted.matrix.end(), 1);
    EXPECT_NE(fit::whereOutOfBounds(fit::errorsOf(shifted, 100)), "") << "the bounds find a table that is a node off";
}

TEST(ShippedLtcTables, AreNoWorseThanThePublishedOnes)
{
    const Path matrix = kPublished / "ltc_1.exr", amplitude = kPublished / "ltc_2.exr";
    if (!std::filesystem::exists(matrix))
        GTEST_SKIP() << "no " << matrix;
    const fit::ErrorReport ours = fit::errorsOf(shipped(), 100), theirs = fit::errorsOf(loadLtcTables(matrix, amplitude), 100);
    EXPECT_EQ(fit::whereWorse(ours, theirs), "");
    EXPECT_NE(fit::whereWorse(theirs, ours), "");
    EXPECT_LT(theirs.all.mean.l1, 0.2) << "read in another order than they were written in";
}

TEST(ShippedLtcTables, HoldWhatIsReflectedAtAnySpecularColour)
{
    for (const double f0 : {0.0, 0.04, 1.0})
        for (const double cosView : {0.25, 0.7}) {
            const dvec3 view = directionOf(cosView, 0);
            const double reflected = integralOverSphere([&](const dvec3& light) {
                const double cosHalf = glm::dot(view, glm::normalize(view + light));
                const double fresnel = f0 + (1 - f0) * std::pow(1 - cosHalf, 5);
                return fresnel * ggxReflection(view, light, 0.36) * std::max(light.z, 0.0);
            });
            const dvec4 amplitude = lookUp(shipped(), 0.6, cosView).amplitude;
            EXPECT_NEAR(f0 * amplitude.x + (1 - f0) * amplitude.y, reflected, 5e-3 * reflected) << f0 << ' ' << cosView;
        }
}

TEST(ShippedLtcTables, ChangeAsTheReflectionDoes)
{
    const LtcTables& tables = shipped();
    const auto at = [](const std::vector<vec4>& table, uint32_t column, uint32_t row) { return table[row * 64 + column]; };
    for (uint32_t i = 1; i < 64; ++i) {
        EXPECT_LT(at(tables.amplitude, i, 0).x, at(tables.amplitude, i - 1, 0).x) << "rougher, more is lost: " << i;
        EXPECT_GT(at(tables.amplitude, 20, i).y, at(tables.amplitude, 20, i - 1).y) << "flatter, Fresnel gives more: " << i;
    }
    for (uint32_t i = 8; i < 64; ++i)
        EXPECT_GT(at(tables.matrix, i, 0).w, at(tables.matrix, i - 1, 0).w) << "rougher, wider: " << i;
    for (size_t i = 0; i < tables.amplitude.size(); ++i)
        EXPECT_LE(tables.amplitude[i].y, tables.amplitude[i].x) << i;
}

} // namespace
} // namespace antumbra::bake
