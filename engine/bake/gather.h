// Light transport by rays: transfer vectors of texels and light matrices of cells (Sloan et al. 2002; Xu et al. 2022, eq. 6). Every texel
// and cell is gathered by itself, with rays that depend on its place alone, so that who gathers what in which order changes no bit.
// Knows neither files nor threads.
#pragma once

#include "bake/bake.h"
#include "bake/ray_scene.h"
#include "bake/texels.h"

namespace antumbra::bake {

/// Where more of the rays meet surfaces from behind, their origin lies inside something solid: such points count for nothing.
inline constexpr float kMostBackHits = 0.25f;

struct Range
{
    uint32_t first = 0;
    uint32_t count = 0;
};

/// One vector a texel: values[texel * coefficientCount + i].
struct Transfers
{
    uint32_t coefficientCount = 0;
    std::vector<vec3> values;
    std::vector<uint8_t> isValid; // one a texel: 0 where all its points lie inside something solid
};
Transfers noTransfers(const TexelMap& map, const BakeSettings& settings); // zero, nothing valid

struct RayCounts
{
    uint64_t rays = 0;
};

// Rays go in packets: texels take settings.raysPerTexel rounded up to whole packets at every point, and no more points than there are
// packets; cells take settings.raysPerCell rounded up.

/// The environment's own light, at texels `range`.
RayCounts gatherDirect(const RayScene& rays, const TexelMap& map, const BakeSettings& settings, Range range, Transfers& result);

/// The light that comes off surfaces lit as `before` says (one bounce less), at texels `range`; validity is that of `before`.
RayCounts gatherBounce(const RayScene& rays, const TexelMap& map, const BakeSettings& settings, const Transfers& before, Range range,
                       Transfers& result);

/// One matrix a cell: values[(cell * kLocalCoefficients + j) * coefficientCount + i].
struct CellLight
{
    uint32_t coefficientCount = 0;
    std::vector<vec3> values;
    std::vector<uint8_t> isOpen;
};
CellLight noCellLight(const Grid& grid, const BakeSettings& settings); // zero, nothing open

/// The grid over `bounds` with cells of about `cellMetres`, a point in the middle of each; at least as high as who stands there.
Grid gridOver(const Aabb& bounds, float cellMetres);

/// `lit`: sum of the transfers of all bounces but the last, by which surfaces shine.
RayCounts gatherCells(const RayScene& rays, const TexelMap& map, const BakeSettings& settings, const Transfers& lit, const Grid& grid,
                      Range range, CellLight& result);

/// As files and devices hold them. Places near a chart take the nearest valid texel's value, stitched over seams; all others, and closed
/// cells, are zero.
TransferAtlas packed(const Transfers& total, const TexelMap& map, const StaticScene& scene);
IrradianceVolume packed(const CellLight& light, const Grid& grid);

} // namespace antumbra::bake
