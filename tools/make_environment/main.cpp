// make_environment FOLDER: overcast.hdr, low_sun.hdr and hall.hdr, the same bytes every time.
#include "bake/sh.h"
#include "base/error.h"
#include "base/file.h"
#include "tools/make_environment/radiance.h"
#include "tools/make_environment/rgbe.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antumbra::environment {
namespace {

using RadianceOf = dvec3 (*)(const dvec3& direction);

constexpr uint32_t kWidth = 448, kHeight = 224;

/// The mean over the texel, so that a small bright disc has its right share.
dvec3 texelOf(RadianceOf radianceOf, uint32_t column, uint32_t row)
{
    constexpr int kSamples = 6;
    dvec3 sum{0};
    for (int i = 0; i < kSamples * kSamples; ++i) {
        const int across = i % kSamples, down = i / kSamples;
        const double u = (column + (across + 0.5) / kSamples) / kWidth, v = (row + (down + 0.5) / kSamples) / kHeight;
        sum += radianceOf(bake::equirectangularDirection(u, v));
    }
    return sum / static_cast<double>(kSamples * kSamples);
}

scene::ImageF paint(RadianceOf radianceOf)
{
    scene::ImageF map{.width = kWidth, .height = kHeight, .channels = 3, .values = {}};
    for (uint32_t row = 0; row < kHeight; ++row)
        for (uint32_t column = 0; column < kWidth; ++column) {
            const dvec3 texel = texelOf(radianceOf, column, row);
            for (int channel = 0; channel < 3; ++channel)
                map.values.push_back(static_cast<float>(texel[channel]));
        }
    return map;
}

/// Scaled so that level white ground, lit by the whole upper half, has a luminance of one.
void expose(scene::ImageF& map)
{
    const dvec3 irradiance = bake::irradianceOf(bake::project(map, bake::kMostBands))({0, 1, 0});
    const double luminance = glm::dot(irradiance, dvec3{0.2126, 0.7152, 0.0722}) / std::numbers::pi;
    for (float& value : map.values)
        value = static_cast<float>(value / luminance);
}

void make(const Path& file, RadianceOf radianceOf)
{
    scene::ImageF map = paint(radianceOf);
    expose(map);
    const std::vector<std::byte> bytes = toRgbe(map);
    writeFile(file, bytes);
    fmt::print("{}: {} x {}, brightest {:.1f}, {} bytes\n", file.string(), map.width, map.height, *std::ranges::max_element(map.values),
               bytes.size());
}

} // namespace
} // namespace antumbra::environment

int main(int argumentCount, char** arguments)
{
    using namespace antumbra;
    if (argumentCount != 2) {
        fmt::print(stderr, "usage: make_environment FOLDER\n");
        return static_cast<int>(ExitCode::BadInput);
    }
    try {
        const Path folder = arguments[1];
        environment::make(folder / "overcast.hdr", environment::overcast);
        environment::make(folder / "low_sun.hdr", environment::lowSun);
        environment::make(folder / "hall.hdr", environment::hall);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code);
    }
    return static_cast<int>(ExitCode::Done);
}
