#include "render/shadow/mask_table.h"

#include "render/shader_structs.h"

#include <algorithm>
#include <cmath>

namespace antumbra::render {

namespace {

constexpr double kHalfPi = 1.5707963267948966;

double radicalInverse2(uint32_t i)
{
    double value = 0, digit = 0.5;
    for (; i != 0; i >>= 1, digit *= 0.5)
        value += (i & 1u) != 0 ? digit : 0.0;
    return value;
}

glm::dvec3 unitFromOctahedral(double x, double y)
{
    glm::dvec3 v{x, y, 1.0 - std::abs(x) - std::abs(y)};
    if (v.z < 0.0)
        v = {(1.0 - std::abs(y)) * (x >= 0 ? 1.0 : -1.0), (1.0 - std::abs(x)) * (y >= 0 ? 1.0 : -1.0), v.z};
    return glm::normalize(v);
}

/// The axes of one cell: a direction in their middle, and the farthest any of them is from it.
struct AxisCell
{
    glm::dvec3 middle;
    double radius; // radians
};

/// A cell is a flat patch of one face of the octahedron, or two or four that meet at a fold; seen from the centre its farthest points
/// from the middle are corners of those patches, so corners and the points of the folds' lines through it are all that need be asked.
/// A grid of 8 x 8 steps holds them; rounding of the look-up is covered by a thousandth of a cell and 1e-4 radians.
AxisCell axisCell(uint32_t x, uint32_t y)
{
    constexpr int kSteps = 8;
    const double width = 2.0 / shader::kMaskAxisCells, slack = 1e-3 * width;
    const auto at = [&](double cell, double t) { return std::clamp(-1.0 + width * cell + t * (width + 2 * slack) - slack, -1.0, 1.0); };
    AxisCell cell{unitFromOctahedral(at(x, 0.5), at(y, 0.5)), 0};
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) {
            const glm::dvec3 axis = unitFromOctahedral(at(x, static_cast<double>(i) / kSteps), at(y, static_cast<double>(j) / kSteps));
            cell.radius = std::max(cell.radius, std::acos(std::clamp(glm::dot(axis, cell.middle), -1.0, 1.0)));
        }
    cell.radius += 1e-4;
    return cell;
}

/// Where a point of the unit disk lies along a Hilbert curve over the square about it.
uint32_t curvePosition(vec2 point)
{
    constexpr uint32_t kSide = 256;
    uvec2 p = glm::min(uvec2((point * 0.5f + 0.5f) * static_cast<float>(kSide)), uvec2(kSide - 1));
    uint32_t position = 0;
    for (uint32_t half = kSide / 2; half > 0; half /= 2) {
        const bool right = (p.x & half) != 0, upper = (p.y & half) != 0;
        position += half * half * ((right ? 3u : 0u) ^ (upper ? 1u : 0u));
        if (upper)
            continue;
        if (right)
            p = uvec2(kSide - 1) - p;
        std::swap(p.x, p.y);
    }
    return position;
}

} // namespace

std::vector<vec3> hemisphereSamples(uint32_t count)
{
    std::vector<vec3> samples;
    samples.reserve(count);
    for (uint32_t i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count, phi = 4 * kHalfPi * radicalInverse2(i), r = std::sqrt(u);
        samples.emplace_back(r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - u));
    }
    std::ranges::sort(samples, {}, [](const vec3& sample) { return curvePosition({sample.x, sample.y}); });
    return samples;
}

std::vector<uint32_t> maskTable(const std::vector<vec3>& samples)
{
    constexpr uint32_t axes = shader::kMaskAxisCells * shader::kMaskAxisCells;
    const size_t words = (samples.size() + 31) / 32;
    std::vector<uint32_t> table(words * axes * shader::kMaskAngleCells, 0);
    for (uint32_t axis = 0; axis < axes; ++axis) {
        const AxisCell cell = axisCell(axis % shader::kMaskAxisCells, axis / shader::kMaskAxisCells);
        for (size_t s = 0; s < samples.size(); ++s) {
            const double apart = std::acos(std::clamp(glm::dot(glm::dvec3(samples[s]), cell.middle), -1.0, 1.0)) - cell.radius;
            if (apart > kHalfPi)
                continue;
            // The first cell whose widest cone reaches the sample, and all wider ones.
            const double first = std::ceil(std::sin(std::max(apart, 0.0)) * shader::kMaskAngleCells - 1e-4) - 1.0;
            for (auto angle = static_cast<uint32_t>(std::max(first, 0.0)); angle < shader::kMaskAngleCells; ++angle)
                table[(size_t{angle} * axes + axis) * words + s / 32] |= 1u << s % 32;
        }
    }
    return table;
}

} // namespace antumbra::render
