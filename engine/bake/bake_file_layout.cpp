#include "bake/bake_file_layout.h"

#include "bake/settings.h"
#include "base/fnv1a.h"

#include <fmt/format.h>

namespace antumbra::bake {

namespace {

void addColours(std::vector<std::string>& channels, const std::string& layer)
{
    for (const char* colour : {"R", "G", "B"})
        channels.push_back(fmt::format("{}.{}", layer, colour));
}

} // namespace

std::string settingAttribute(std::string_view key) { return fmt::format("antumbra:{}", key); }

std::vector<std::string> transferChannels(uint32_t coefficientCount)
{
    std::vector<std::string> channels;
    for (uint32_t i = 0; i < coefficientCount; ++i)
        addColours(channels, fmt::format("T{:02}", i));
    return channels;
}

std::vector<std::string> volumeChannels(uint32_t coefficientCount)
{
    std::vector<std::string> channels;
    for (uint32_t j = 0; j < kLocalCoefficients; ++j)
        for (uint32_t i = 0; i < coefficientCount; ++i)
            addColours(channels, fmt::format("M{:02}_{:02}", j, i));
    channels.emplace_back("open");
    return channels;
}

uvec2 volumeExtent(const Grid& grid) { return {grid.count.x, grid.count.y * grid.count.z}; }

uint64_t checksumOf(const Bake& bake)
{
    Fnv1a hash;
    for (const BakeSetting& setting : kBakeSettings)
        hash.add(setting.read(bake.settings));
    hash.add(bake.sceneHash);
    hash.add(bake.atlas.extent);
    hash.add(std::span(bake.atlas.planes));
    hash.add(bake.volume.grid);
    hash.add(std::span(bake.volume.planes));
    hash.add(std::span(bake.volume.isOpen));
    return hash.value();
}

std::string hexadecimal(uint64_t value) { return fmt::format("{:016x}", value); }

} // namespace antumbra::bake
