// The format of Ward, Real Pixels (Graphics Gems II, 1991), with the scanline run-length coding of the Radiance software.
#include "tools/make_environment/rgbe.h"

#include "base/check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace antumbra::environment {

namespace {

using Texel = std::array<uint8_t, 4>;

Texel toTexel(const float* rgb)
{
    const float greatest = std::max({rgb[0], rgb[1], rgb[2]});
    if (greatest < 1e-32f)
        return {};
    int exponent = 0;
    std::frexp(greatest, &exponent);
    const auto mantissa = [&](float value) { return static_cast<uint8_t>(std::min(std::round(std::ldexp(value, 8 - exponent)), 255.0f)); };
    return {mantissa(rgb[0]), mantissa(rgb[1]), mantissa(rgb[2]), static_cast<uint8_t>(exponent + 128)};
}

size_t runLength(std::span<const uint8_t> values)
{
    constexpr size_t kLongestRun = 127;
    const auto end = std::ranges::find_if(values, [&](uint8_t value) { return value != values.front(); });
    return std::min<size_t>(static_cast<size_t>(end - values.begin()), kLongestRun);
}

/// A run is 128 + its length and the value, anything else its length and the values.
void appendCoded(std::vector<std::byte>& bytes, std::span<const uint8_t> values)
{
    constexpr size_t kWorthARun = 4, kLongestLiteral = 128;
    while (!values.empty()) {
        const size_t run = runLength(values);
        size_t literal = 0;
        while (literal < std::min(values.size(), kLongestLiteral) && runLength(values.subspan(literal)) < kWorthARun)
            ++literal;
        if (run >= kWorthARun) {
            bytes.push_back(std::byte(128 + run));
            bytes.push_back(std::byte{values.front()});
        } else {
            bytes.push_back(std::byte(literal));
            for (const uint8_t value : values.first(literal))
                bytes.push_back(std::byte{value});
        }
        values = values.subspan(run >= kWorthARun ? run : literal);
    }
}

} // namespace

std::vector<std::byte> toRgbe(const scene::ImageF& image)
{
    check(image.width >= 8 && image.width < 32768 && image.channels == 3, "three channels and 8 to 32767 columns");
    const std::string header = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
    const auto characters = std::as_bytes(std::span(header));
    std::vector<std::byte> bytes(characters.begin(), characters.end());
    for (uint32_t row = 0; row < image.height; ++row) {
        std::array<std::vector<uint8_t>, 4> planes;
        for (uint32_t column = 0; column < image.width; ++column) {
            const Texel texel = toTexel(&image.values[(size_t{row} * image.width + column) * 3]);
            for (size_t plane = 0; plane < 4; ++plane)
                planes[plane].push_back(texel[plane]);
        }
        for (const uint32_t start : {2u, 2u, image.width >> 8, image.width & 255u})
            bytes.push_back(std::byte(start));
        for (const std::vector<uint8_t>& plane : planes)
            appendCoded(bytes, plane);
    }
    return bytes;
}

} // namespace antumbra::environment
