#include "render/shadow/samples.h"

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

} // namespace antumbra::render
