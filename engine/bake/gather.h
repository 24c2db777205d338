// Light transport by rays: transfer vectors of texels and light matrices of cells (Sloan et al. 2002; Xu et al. 2022, eq. 6). Every texel
// and cell is gathered by itself, with rays that depend on its place alone, so that who gathers what in which order changes no bit.
// Knows neither files nor threads.
#pragma once

#include "bake/bake.h"
#include "bake/texels.h"

#include <memory>

namespace antumbra::bake {

/// What rays meet; through Embree. Cut-out surfaces let rays through where they are holes. Any number of threads may trace.
class RayScene
{
public:
    /// `scene` must outlive it.
    explicit RayScene(const StaticScene& scene);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    struct Hit
    {
        SurfacePoint point;
        float distance = 0;  // metres
        bool isBack = false; // of a triangle seen from its inside
    };
    /// True where something is hit; the nearest.
    bool intersect(vec3 origin, vec3 direction, Hit& hit) const;

    [[nodiscard]] const StaticScene& surfaces() const { return *surfaces_; }
    /// Bytes that the acceleration structure took.
    [[nodiscard]] uint64_t bytes() const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
    const StaticScene* surfaces_;
};

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
CellLight noCellLight(const Grid& grid, const BakeSettings& settings);

/// The grid over `bounds` with cells of about settings.cellMetres.
Grid gridOver(const Aabb& bounds, float cellMetres);

/// `lit`: sum of the transfers of all bounces but the last, by which surfaces shine.
RayCounts gatherCells(const RayScene& rays, const TexelMap& map, const BakeSettings& settings, const Transfers& lit, const Grid& grid,
                      Range range, CellLight& result);

/// As files and devices hold them; texels and cells that are not valid take their neighbours' where that hides a seam.
TransferAtlas packed(const Transfers& total, const TexelMap& map);
IrradianceVolume packed(const CellLight& light, const Grid& grid);

} // namespace antumbra::bake
