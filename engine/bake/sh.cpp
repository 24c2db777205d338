// Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001: the cosine lobe's
// coefficients (eq. 8) and the product form of irradiance (eq. 7).
#include "bake/sh.h"

#include "bake/sh_polynomials.h"
#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antumbra::bake {

namespace {

using glm::dvec3;

constexpr double kPiExact = std::numbers::pi;

void checkBands(uint32_t bands) { check(bands >= kFewestBands && bands <= kMostBands, "2 to 5 bands of spherical harmonics"); }

uint32_t indexOf(double share, uint32_t count) { return std::min(static_cast<uint32_t>(share * count), count - 1); }

void accumulate(ShFunction& function, const ShBasis& basis, const dvec3& weighted)
{
    for (uint32_t i = 0; i < function.coefficientCount(); ++i)
        function.coefficients[i] += basis[i] * weighted;
}

} // namespace

dvec3 ShFunction::operator()(const dvec3& direction) const
{
    const ShBasis basis = shBasis(direction);
    dvec3 sum{0};
    for (uint32_t i = 0; i < coefficientCount(); ++i)
        sum += basis[i] * coefficients[i];
    return sum;
}

ShBasis shBasis(const dvec3& direction)
{
    ShBasis basis;
    evaluateShPolynomials<kMostBands, double>(direction.x, direction.y, direction.z, basis.data());
    return basis;
}

dvec3 equirectangularDirection(double u, double v)
{
    const double azimuth = 2 * kPiExact * (u - 0.5);
    const double polar = kPiExact * v;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

dvec3 texelTowards(const scene::ImageF& map, const dvec3& direction)
{
    const double u = 0.5 + std::atan2(direction.x, -direction.z) / (2 * kPiExact);
    const double v = std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPiExact;
    const float* texel = &map.values[(size_t{indexOf(v, map.height)} * map.width + indexOf(u, map.width)) * map.channels];
    return {texel[0], texel[1], texel[2]};
}

ShFunction project(const scene::ImageF& map, uint32_t bands)
{
    checkBands(bands);
    check(map.width > 0 && map.height > 0 && map.channels >= 3, "a map of three channels that is not empty");
    check(map.values.size() == size_t{map.width} * map.height * map.channels, "a map with all its texels");

    ShFunction result{.bands = bands};
    for (uint32_t row = 0; row < map.height; ++row) {
        const double top = std::cos(kPiExact * row / map.height);
        const double bottom = std::cos(kPiExact * (row + 1) / map.height);
        const double solidAngle = 2 * kPiExact / map.width * (top - bottom);
        for (uint32_t column = 0; column < map.width; ++column) {
            const float* texel = &map.values[(size_t{row} * map.width + column) * map.channels];
            const dvec3 direction = equirectangularDirection((column + 0.5) / map.width, (row + 0.5) / map.height);
            accumulate(result, shBasis(direction), solidAngle * dvec3{texel[0], texel[1], texel[2]});
        }
    }
    return result;
}

// A rotated function stays in its bands, so projecting it again is exact if the quadrature is: the integrand is a
// polynomial of degree 8 at most, which five Gauss-Legendre nodes in y and nine steps of azimuth integrate without error.
ShFunction rotatedAboutY(const ShFunction& function, double radians)
{
    struct Node
    {
        double y, weight;
    };
    constexpr std::array kNodes{Node{-0.9061798459386640, 0.2369268850561891}, Node{-0.5384693101056831, 0.4786286704993665},
                                Node{0, 0.5688888888888889}, Node{0.5384693101056831, 0.4786286704993665},
                                Node{0.9061798459386640, 0.2369268850561891}};
    constexpr uint32_t kSteps = 9;

    checkBands(function.bands);
    ShFunction result{.bands = function.bands};
    for (const Node& node : kNodes) {
        const double radius = std::sqrt(1 - node.y * node.y);
        for (uint32_t step = 0; step < kSteps; ++step) {
            const double azimuth = 2 * kPiExact * step / kSteps;
            const dvec3 direction{radius * std::sin(azimuth), node.y, radius * std::cos(azimuth)};
            const dvec3 before{radius * std::sin(azimuth - radians), node.y, radius * std::cos(azimuth - radians)};
            accumulate(result, shBasis(direction), node.weight * 2 * kPiExact / kSteps * function(before));
        }
    }
    return result;
}

ShFunction windowed(const ShFunction& function, double strength)
{
    ShFunction result = function;
    for (uint32_t band = 0; band < function.bands; ++band)
        for (uint32_t i = band * band; i < (band + 1) * (band + 1); ++i)
            result.coefficients[i] /= 1 + strength * std::pow(band * (band + 1.0), 2);
    return result;
}

ShFunction irradianceOf(const ShFunction& radiance)
{
    constexpr std::array kCosineLobe{kPiExact, 2 * kPiExact / 3, kPiExact / 4, 0.0, -kPiExact / 24};

    checkBands(radiance.bands);
    ShFunction result{.bands = radiance.bands};
    for (uint32_t band = 0; band < radiance.bands; ++band)
        for (uint32_t i = band * band; i < (band + 1) * (band + 1); ++i)
            result.coefficients[i] = kCosineLobe[band] * radiance.coefficients[i];
    return result;
}

} // namespace antumbra::bake
