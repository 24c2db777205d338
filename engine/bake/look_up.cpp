#include "bake/look_up.h"

#include "base/check.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

namespace antumbra::bake {

namespace {

double half(const std::vector<uint16_t>& planes, size_t index) { return static_cast<double>(glm::unpackHalf1x16(planes[index])); }

double sideWeight(int step, float part) { return step == 1 ? part : 1 - part; }

/// 0 inside the outermost cells, 1 from one cell beyond them on; `place` in cells from the first.
double shareOutside(vec3 place, vec3 last)
{
    const vec3 beyond = glm::max(-place, place - last) - 0.5f;
    return glm::clamp(std::max({beyond.x, beyond.y, beyond.z}), 0.0f, 1.0f);
}

/// Adds the light of one cell, row by row of its matrix.
void addCell(ShFunction& sum, const IrradianceVolume& volume, const ShFunction& radiance, uint32_t cell, double weight)
{
    const uint32_t columns = radiance.coefficientCount();
    const size_t cellCount = volume.grid.cellCount();
    for (uint32_t j = 0; j < kLocalCoefficients; ++j)
        for (uint32_t i = 0; i < columns; ++i)
            for (uint32_t c = 0; c < 3; ++c) {
                const size_t plane = (size_t{j} * columns + i) * 3 + c;
                const auto channel = static_cast<int>(c);
                sum.coefficients[j][channel] += weight * half(volume.planes, plane * cellCount + cell) * radiance.coefficients[i][channel];
            }
}

} // namespace

glm::dvec3 atlasIrradiance(const Bake& bake, const ShFunction& radiance, vec2 bakeUv)
{
    check(radiance.bands == bake.settings.bands, "light of the bake's bands");
    const uvec2 extent = bake.atlas.extent;
    const vec2 place = bakeUv * vec2(extent) - 0.5f, corner = glm::floor(place), part = place - corner;
    glm::dvec3 sum{0};
    for (int k = 0; k < 4; ++k) {
        const ivec2 step(k & 1, k >> 1);
        const uvec2 texel(glm::clamp(ivec2(corner) + step, ivec2(0), ivec2(extent) - 1));
        const double weight = sideWeight(step.x, part.x) * sideWeight(step.y, part.y);
        for (uint32_t i = 0; i < radiance.coefficientCount(); ++i)
            for (uint32_t c = 0; c < 3; ++c) {
                const size_t plane = size_t{i} * 3 + c;
                const auto channel = static_cast<int>(c);
                sum[channel] +=
                    weight * radiance.coefficients[i][channel] * half(bake.atlas.planes, (plane * extent.y + texel.y) * extent.x + texel.x);
            }
    }
    return sum;
}

ShFunction localRadiance(const Bake& bake, const ShFunction& radiance, vec3 position)
{
    check(radiance.bands == bake.settings.bands, "light of the bake's bands");
    const Grid& grid = bake.volume.grid;
    const vec3 last = vec3(grid.count) - 1.0f;
    const vec3 unclamped = (position - grid.origin) / grid.spacing, place = glm::clamp(unclamped, vec3(0), last);
    const vec3 corner = glm::min(glm::floor(place), glm::max(last - 1.0f, vec3(0))), part = place - corner;
    const double outside = shareOutside(unclamped, last);
    ShFunction sum{.bands = kLocalBands, .coefficients = {}};
    for (uint32_t i = 0; i < std::min(kLocalCoefficients, radiance.coefficientCount()); ++i)
        sum.coefficients[i] = outside * radiance.coefficients[i];
    double whole = outside;
    for (int k = 0; k < 8; ++k) {
        const ivec3 step(k & 1, k >> 1 & 1, k >> 2);
        const uvec3 at = glm::min(uvec3(corner) + uvec3(step), grid.count - 1u);
        const uint32_t cell = (at.z * grid.count.y + at.y) * grid.count.x + at.x;
        const double weight = (1 - outside) * sideWeight(step.x, part.x) * sideWeight(step.y, part.y) * sideWeight(step.z, part.z);
        if (bake.volume.isOpen[cell] == 0 || weight == 0)
            continue;
        addCell(sum, bake.volume, radiance, cell, weight);
        whole += weight;
    }
    if (whole > 0)
        for (glm::dvec3& coefficient : sum.coefficients)
            coefficient /= whole;
    return sum;
}

glm::dvec3 localIrradiance(const Bake& bake, const ShFunction& radiance, vec3 position, vec3 normal)
{
    constexpr uint32_t kFifthBand = 16;
    static_assert(kLocalBands == 5);
    const auto sumOf = [](const glm::dvec3& colour) { return colour.x + colour.y + colour.z; };
    ShFunction local = localRadiance(bake, radiance, position);
    const glm::dvec3 light = glm::max(local.coefficients[0], glm::dvec3(0)), tint = light / std::max(sumOf(light), 1e-30);
    for (uint32_t i = kFifthBand; i < kLocalCoefficients; ++i)
        local.coefficients[i] = sumOf(local.coefficients[i]) * tint;
    return irradianceOf(local)(normal);
}

} // namespace antumbra::bake
