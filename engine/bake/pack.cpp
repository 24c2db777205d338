#include "bake/gather.h"

#include "base/check.h"

#include <glm/gtc/packing.hpp>

namespace antumbra::bake {

namespace {

/// How far values spread beyond a chart, texels: bilinear look-ups reach one, lower mip levels and other resolutions some more.
constexpr uint32_t kReach = 4;

uint16_t half(float value)
{
    constexpr float kLargestHalf = 65504;
    return glm::packHalf1x16(glm::clamp(value, -kLargestHalf, kLargestHalf));
}

} // namespace

TransferAtlas packed(const Transfers& total, const TexelMap& map)
{
    const uint32_t coefficients = total.coefficientCount;
    check(total.isValid.size() == map.texelCount() && total.values.size() == size_t{map.texelCount()} * coefficients,
          "transfers of this map's texels");
    const std::vector<uint32_t> sources = dilated(map, total.isValid, kReach);
    const size_t places = sources.size();
    TransferAtlas atlas{.extent = map.extent, .planes = std::vector<uint16_t>(places * coefficients * 3, 0)};
    for (size_t place = 0; place < places; ++place) {
        if (sources[place] == kNoTexel)
            continue;
        const vec3* transfer = &total.values[size_t{sources[place]} * coefficients];
        for (uint32_t i = 0; i < coefficients; ++i)
            for (int channel = 0; channel < 3; ++channel)
                atlas.planes[(size_t{i} * 3 + channel) * places + place] = half(transfer[i][channel]);
    }
    return atlas;
}

IrradianceVolume packed(const CellLight& light, const Grid& grid)
{
    const size_t cells = grid.cellCount(), entries = size_t{kLocalCoefficients} * light.coefficientCount;
    check(light.isOpen.size() == cells && light.values.size() == cells * entries, "light of this grid's cells");
    IrradianceVolume volume{.grid = grid, .planes = std::vector<uint16_t>(cells * entries * 3, 0), .isOpen = light.isOpen};
    for (size_t cell = 0; cell < cells; ++cell) {
        if (!light.isOpen[cell])
            continue;
        for (size_t entry = 0; entry < entries; ++entry)
            for (int channel = 0; channel < 3; ++channel)
                volume.planes[(entry * 3 + channel) * cells + cell] = half(light.values[cell * entries + entry][channel]);
    }
    return volume;
}

} // namespace antumbra::bake
