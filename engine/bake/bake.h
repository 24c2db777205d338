// What is baked of a scene's light: how every texel and every cell of space answers to the environment. Plain data; knows neither
// files nor devices.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <vector>

namespace antumbra::bake {

/// What a bake is made with; equal settings and an equal scene give an equal bake, to the byte.
struct BakeSettings
{
    uint32_t bands = 3;   // of the environment's spherical harmonics, 2..5
    uint32_t bounces = 2; // diffuse interreflections, 0..4
    uint32_t raysPerTexel = 512;
    uint32_t raysPerCell = 2048;
    float texelsPerMetre = 8;
    uint32_t mostTexels = 2048; // along a side of the atlas; it takes a lower density where it would be larger
    float cellMetres = 0.8f;

    [[nodiscard]] uint32_t coefficientCount() const { return bands * bands; }
    friend bool operator==(const BakeSettings&, const BakeSettings&) = default;
};

/// Diffuse precomputed radiance transfer (Sloan et al. 2002; Xu et al. 2022, eq. 6): E = sum of T_i L_i, W/m^2, channel by channel, for
/// the environment's coefficients L_i in W/(m^2 sr).
struct TransferAtlas
{
    uvec2 extent{0};              // texels
    std::vector<uint16_t> planes; // half floats, [coefficient * 3 + channel][y][x]; rows from v = 0
};

/// Points of space in rows: origin + spacing * (x, y, z).
struct Grid
{
    vec3 origin{0};  // metres, world
    vec3 spacing{1}; // metres
    uvec3 count{0};

    [[nodiscard]] uint32_t cellCount() const { return count.x * count.y * count.z; }
    /// x runs fastest, then y, then z.
    [[nodiscard]] vec3 position(uint32_t cell) const
    {
        return origin + spacing * vec3(cell % count.x, cell / count.x % count.y, cell / (count.x * count.y));
    }
};

/// Bands of local incident light, whatever the environment's number of bands: indoors it comes from a few sides. Of two walkers in a hall,
/// with their shadows, irradiance is off by 4.9 % with four bands and by 2.8 with five.
inline constexpr uint32_t kLocalBands = 5;
inline constexpr uint32_t kLocalCoefficients = kLocalBands * kLocalBands;

/// From the environment's light to the radiance that comes in at a point, with occlusion and interreflections by what is static:
/// l_j = sum of M_ji L_i, channel by channel.
struct IrradianceVolume
{
    Grid grid;
    std::vector<uint16_t> planes; // half floats, [(j * coefficientCount + i) * 3 + channel][cell]
    std::vector<uint8_t> isOpen;  // one a cell: 0 inside a wall, whose light nobody may see
};

struct Bake
{
    BakeSettings settings;
    uint64_t sceneHash = 0; // of the StaticScene it was made of
    TransferAtlas atlas;
    IrradianceVolume volume;
};

} // namespace antumbra::bake
