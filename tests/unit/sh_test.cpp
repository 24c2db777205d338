// Spherical harmonics against quadrature, closed forms, published constants and independently projected maps.
#include "bake/sh.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

namespace antumbra::bake {
namespace {

using glm::dvec3;
using scene::ImageF;

constexpr double kPiExact = std::numbers::pi;
const Path kEnvironments = Path(ANTUMBRA_SHARED_DIR) / "assets/environments";

ImageF paint(uint32_t width, uint32_t height, const std::function<dvec3(const dvec3&)>& radiance)
{
    ImageF map{.width = width, .height = height, .channels = 3, .values = {}};
    for (uint32_t row = 0; row < height; ++row)
        for (uint32_t column = 0; column < width; ++column) {
            const dvec3 value = radiance(equirectangularDirection((column + 0.5) / width, (row + 0.5) / height));
            for (int channel = 0; channel < 3; ++channel)
                map.values.push_back(static_cast<float>(value[channel]));
        }
    return map;
}

dvec3 turnedAboutY(const dvec3& v, double radians)
{
    return {std::cos(radians) * v.x + std::sin(radians) * v.z, v.y, -std::sin(radians) * v.x + std::cos(radians) * v.z};
}

/// Distinct numbers in every coefficient of every channel.
ShFunction anyFunction(uint32_t bands)
{
    ShFunction function{.bands = bands};
    for (uint32_t i = 0; i < function.coefficientCount(); ++i)
        function.coefficients[i] = {std::sin(1.0 + i), std::cos(2.0 * i), std::sin(3.0 + 0.7 * i)};
    return function;
}

double greatestDifference(const ShFunction& a, const ShFunction& b)
{
    double greatest = 0;
    for (uint32_t i = 0; i < kMostCoefficients; ++i)
        for (int channel = 0; channel < 3; ++channel)
            greatest = std::max(greatest, std::abs(a.coefficients[i][channel] - b.coefficients[i][channel]));
    return greatest;
}

double bandNorm(const ShFunction& function, uint32_t band, int channel)
{
    double sum = 0;
    for (uint32_t i = band * band; i < (band + 1) * (band + 1); ++i)
        sum += function.coefficients[i][channel] * function.coefficients[i][channel];
    return std::sqrt(sum);
}

std::vector<dvec3> someDirections()
{
    std::vector<dvec3> directions;
    for (int i = 0; i < 40; ++i)
        directions.push_back(equirectangularDirection(std::fmod(0.618034 * i, 1.0), (i + 0.5) / 40));
    return directions;
}

nlohmann::json readJson(const Path& path)
{
    std::ifstream file(path);
    return nlohmann::json::parse(file);
}

ShFunction functionOf(const nlohmann::json& coefficients)
{
    ShFunction function{.bands = 3};
    for (uint32_t i = 0; i < function.coefficientCount(); ++i)
        function.coefficients[i] = {coefficients[i][0], coefficients[i][1], coefficients[i][2]};
    return function;
}

TEST(Sh, BasisIsOrthonormal)
{
    std::array<std::array<double, kMostCoefficients>, kMostCoefficients> products{};
    constexpr int kRows = 400, kColumns = 32;
    for (int row = 0; row < kRows; ++row) {
        const double weight = 2 * kPiExact / kColumns * (std::cos(kPiExact * row / kRows) - std::cos(kPiExact * (row + 1) / kRows));
        for (int column = 0; column < kColumns; ++column) {
            const ShBasis basis = shBasis(equirectangularDirection((column + 0.5) / kColumns, (row + 0.5) / kRows));
            for (uint32_t i = 0; i < kMostCoefficients; ++i)
                for (uint32_t j = 0; j < kMostCoefficients; ++j)
                    products[i][j] += weight * basis[i] * basis[j];
        }
    }
    for (uint32_t i = 0; i < kMostCoefficients; ++i)
        for (uint32_t j = 0; j < kMostCoefficients; ++j)
            EXPECT_NEAR(products[i][j], i == j ? 1 : 0, 2e-4) << i << ' ' << j;
}

TEST(Sh, BasisHasTheAgreedOrderAndSigns)
{
    const dvec3 d = glm::normalize(dvec3{0.3, 0.5, 0.7});
    const ShBasis basis = shBasis(d);
    EXPECT_NEAR(basis[1], 0.4886025119 * d.y, 1e-9);
    EXPECT_NEAR(basis[2], 0.4886025119 * d.z, 1e-9);
    EXPECT_NEAR(basis[3], 0.4886025119 * d.x, 1e-9);
    EXPECT_NEAR(basis[6], 0.3153915653 * (3 * d.z * d.z - 1), 1e-9);
    EXPECT_NEAR(basis[8], 0.5462742153 * (d.x * d.x - d.y * d.y), 1e-9);
}

TEST(Sh, MapDirectionsFollowTheConvention)
{
    const auto expectNear = [](const dvec3& a, const dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-12); };
    expectNear(equirectangularDirection(0.5, 0.5), {0, 0, -1});
    expectNear(equirectangularDirection(0.75, 0.5), {1, 0, 0});
    expectNear(equirectangularDirection(0.3, 0), {0, 1, 0});
    for (const dvec3& d : someDirections())
        expectNear(equirectangularDirection(0.5 + std::atan2(d.x, -d.z) / (2 * kPiExact), std::acos(d.y) / kPiExact), d);
}

TEST(Sh, ConstantMapGivesPiTimesItsRadiance)
{
    const ImageF map = paint(64, 32, [](const dvec3&) { return dvec3{0.5, 1, 2}; });
    for (uint32_t bands = kFewestBands; bands <= kMostBands; ++bands) {
        const ShFunction irradiance = irradianceOf(project(map, bands));
        for (const dvec3& n : someDirections())
            EXPECT_LT(glm::length(irradiance(n) - kPiExact * dvec3{0.5, 1, 2}), 0.01);
    }
}

TEST(Sh, ProjectionFindsTheCoefficientsItWasPaintedWith)
{
    for (uint32_t bands = kFewestBands; bands <= kMostBands; ++bands) {
        const ShFunction function = anyFunction(bands);
        const ImageF map = paint(256, 128, [&](const dvec3& d) { return function(d); });
        EXPECT_LT(greatestDifference(project(map, bands), function), 2e-3) << bands;
    }
}

TEST(Sh, IrradianceIsTheCosineIntegral)
{
    const ShFunction radiance = anyFunction(5);
    const ShFunction irradiance = irradianceOf(radiance);
    for (const dvec3& n : {dvec3{0, 1, 0}, glm::normalize(dvec3{1, -2, 3}), dvec3{0, 0, -1}}) {
        const ImageF weighted = paint(512, 256, [&](const dvec3& d) { return std::max(glm::dot(n, d), 0.0) * radiance(d); });
        const dvec3 integral = project(weighted, 2).coefficients[0] * std::sqrt(4 * kPiExact);
        EXPECT_LT(glm::length(integral - irradiance(n)), 2e-3);
    }
}

TEST(Sh, RotationTurnsTheFunctionCounterClockwise)
{
    for (uint32_t bands = kFewestBands; bands <= kMostBands; ++bands)
        for (const double radians : {0.0, 0.4, kPiExact / 2, -2.9, 7.5}) {
            const ShFunction function = anyFunction(bands);
            const ShFunction rotated = rotatedAboutY(function, radians);
            for (const dvec3& d : someDirections())
                EXPECT_LT(glm::length(rotated(turnedAboutY(d, radians)) - function(d)), 1e-12);
        }
    ShFunction fromX{.bands = 2};
    fromX.coefficients[3] = dvec3{1};
    EXPECT_NEAR(rotatedAboutY(fromX, kPiExact / 2).coefficients[2].x, -1, 1e-14) << "light from +X comes from -Z after a quarter turn";
}

TEST(Sh, RotationEqualsRotatedProjection)
{
    const auto lamp = [](const dvec3& d) {
        return dvec3{1, 0.8, 0.5} * std::exp(8 * (glm::dot(d, glm::normalize(dvec3{1, 0.7, -0.4})) - 1));
    };
    const ShFunction before = project(paint(256, 128, lamp), 5);
    const ShFunction after = project(paint(256, 128, [&](const dvec3& d) { return lamp(turnedAboutY(d, -1.1)); }), 5);
    EXPECT_LT(greatestDifference(rotatedAboutY(before, 1.1), after), 1e-4);
    EXPECT_GT(greatestDifference(before, after), 0.1);
}

TEST(Sh, RotationKeepsTheNormOfEachBand)
{
    const ShFunction function = anyFunction(5);
    const ShFunction rotated = rotatedAboutY(function, 0.83);
    for (uint32_t band = 0; band < 5; ++band)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(bandNorm(rotated, band, channel), bandNorm(function, band, channel), 1e-12);
}

TEST(ShDeathTest, RefusesAnotherNumberOfBands)
{
    EXPECT_DEATH(project(paint(4, 2, [](const dvec3&) { return dvec3{1}; }), 6), "bands");
}

/// Irradiance by the constants of the 2001 paper's equation 13.
dvec3 publishedIrradiance(const ShFunction& light, const dvec3& n)
{
    constexpr double c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227, c5 = 0.247708;
    const auto& l = light.coefficients;
    return c1 * l[8] * (n.x * n.x - n.y * n.y) + c3 * l[6] * n.z * n.z + c4 * l[0] - c5 * l[6] +
           2 * c1 * (l[4] * n.x * n.y + l[7] * n.x * n.z + l[5] * n.y * n.z) + 2 * c2 * (l[3] * n.x + l[1] * n.y + l[2] * n.z);
}

TEST(Sh, IrradianceAgreesWithThePublishedConstants)
{
    const Path file = kEnvironments / "sh_reference.json";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is absent";
    const nlohmann::json published = readJson(file).at("published");
    ASSERT_FALSE(published.empty());
    for (const auto& [name, coefficients] : published.items()) {
        const ShFunction light = functionOf(coefficients);
        const ShFunction irradiance = irradianceOf(light);
        for (const dvec3& n : someDirections())
            EXPECT_LT(glm::length(irradiance(n) - publishedIrradiance(light, n)), 1e-5 * bandNorm(light, 0, 1) + 1e-5) << name;
    }
}

/// The file's maps have Z up and the left edge at +X: its (x, y, z) is our (z, -x, y).
ShFunction inOurAxes(const ShFunction& theirs)
{
    ShFunction ours{.bands = 3};
    const ImageF map = paint(512, 256, [&](const dvec3& d) { return theirs({d.z, -d.x, d.y}); });
    return project(map, ours.bands);
}

TEST(Sh, AgreesWithIndependentProjectionsOfRealMaps)
{
    const Path file = kEnvironments / "sh_of_these_maps.json";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is absent";
    const nlohmann::json maps = readJson(file).at("maps");
    ASSERT_FALSE(maps.empty());
    for (const auto& [name, coefficients] : maps.items()) {
        const ShFunction expected = inOurAxes(functionOf(coefficients));
        const ShFunction projected = project(scene::loadRadiance(kEnvironments / name), 3);
        EXPECT_LT(greatestDifference(projected, expected), 1e-3 * bandNorm(expected, 0, 1)) << name;
    }
}

TEST(Sh, AWindowDampsHigherBandsMore)
{
    const ShFunction function = anyFunction(4), damped = windowed(function, 0.1);
    EXPECT_EQ(greatestDifference(windowed(function, 0), function), 0);
    EXPECT_EQ(damped.bands, 4u);
    for (uint32_t i = 0; i < 16; ++i) {
        const double expected[] = {1, 1 / 1.4, 1 / 4.6, 1 / 15.4};
        const uint32_t band = i == 0 ? 0 : i < 4 ? 1 : i < 9 ? 2 : 3;
        EXPECT_LT(glm::length(damped.coefficients[i] - expected[band] * function.coefficients[i]), 1e-12) << i;
    }
}

TEST(Sh, TexelsLieWhereProjectionTakesThemToBe)
{
    constexpr uint32_t kWidth = 24, kHeight = 10;
    uint32_t next = 0;
    const ImageF map = paint(kWidth, kHeight, [&](const dvec3&) { return dvec3(++next); });
    for (uint32_t row = 0; row < kHeight; ++row)
        for (uint32_t column = 0; column < kWidth; ++column)
            for (const double off : {0.01, 0.5, 0.99}) {
                const dvec3 direction = equirectangularDirection((column + off) / kWidth, (row + off) / kHeight);
                EXPECT_EQ(texelTowards(map, direction).x, row * kWidth + column + 1);
            }
    for (const double y : {-1.0, 1.0})
        EXPECT_TRUE(std::isfinite(texelTowards(map, {0, y, 0}).x));
    EXPECT_TRUE(std::isfinite(texelTowards(map, {0, 0, 1}).x)) << "the map's rim";
}

} // namespace
} // namespace antumbra::bake
