// M_ji = integral of Y_j (V Y_i + (1 - V) albedo / pi T_i) dw over the sphere: the light that comes in, projected where it comes in
// (neighbourhood transfer of Sloan et al. 2002, section 6, in matrices).
#include "bake/reflected_light.h"
#include "bake/sh_polynomials.h"

#include <bit>
#include <cmath>

namespace antumbra::bake {

namespace {

constexpr float kPersonMetres = 2;

template <uint32_t kBands>
class CellGatherer
{
public:
    static constexpr uint32_t kCoefficients = kBands * kBands;

    CellGatherer(const RayScene& rays, uint32_t raysPerCell, ReflectedLight<kCoefficients> reflected)
        : rays_(rays), reflected_(reflected), pattern_(sphereDirections((std::max(raysPerCell, 1u) + kLanes - 1) / kLanes))
    {
    }

    /// Replaces `matrix`; false, and zero, where the cell lies inside something solid.
    bool gather(vec3 position, uint64_t key, std::span<vec3> matrix) const
    {
        const mat3 frame = rotationOf(key);
        Sums sums{};
        uint32_t backs = 0;
        for (const DirectionPacket& local : pattern_) {
            DirectionPacket directions;
            rotate(frame, local, directions);
            HitPacket met;
            rays_.intersect(position, directions, kAllLanes, met);
            backs += static_cast<uint32_t>(std::popcount(met.backs));
            Basis basis;
            evaluateShPolynomials<kBasisBands, float>(directions.x, directions.y, directions.z, basis.data());
            addOpen(basis, kAllLanes & ~met.hits, sums);
            addReflected(basis, met, sums);
        }
        const auto count = static_cast<float>(rayCount());
        const bool isOpen = static_cast<float>(backs) <= kMostBackHits * count;
        for (size_t entry = 0; entry < matrix.size(); ++entry) {
            const vec3 reflected(sums.reflected[3 * entry], sums.reflected[3 * entry + 1], sums.reflected[3 * entry + 2]);
            matrix[entry] = isOpen ? 4 * kPi / count * (sumOf(sums.open[entry]) + reflected) : vec3{0};
        }
        return isOpen;
    }

    [[nodiscard]] size_t rayCount() const { return pattern_.size() * kLanes; }

private:
    static constexpr uint32_t kBasisBands = std::max(kBands, 3u);
    using Basis = std::array<Lanes, kBasisBands * kBasisBands>;

    /// Row by row of the matrix.
    struct Sums
    {
        std::array<Lanes, size_t{kLocalCoefficients} * kCoefficients> open;
        TransferVector<kLocalCoefficients * kCoefficients> reflected;
    };

    static void addOpen(const Basis& basis, LaneMask open, Sums& sums)
    {
        if (open == 0)
            return;
        Lanes weight;
        setWeights(open, weight);
        for (uint32_t j = 0; j < kLocalCoefficients; ++j) {
            const Lanes weighted = weight * basis[j];
            for (uint32_t i = 0; i < kCoefficients; ++i)
                sums.open[j * kCoefficients + i] += weighted * basis[i];
        }
    }

    void addReflected(const Basis& basis, const HitPacket& met, Sums& sums) const
    {
        using Radiance = TransferVector<kCoefficients>;
        reflected_.forEach(met, [&](uint32_t lane, const Radiance& radiance) {
            for (uint32_t j = 0; j < kLocalCoefficients; ++j)
                addScaled<std::tuple_size_v<Radiance>>(basis[j][lane], radiance.data(), &sums.reflected[j * radiance.size()]);
        });
    }

    const RayScene& rays_;
    ReflectedLight<kCoefficients> reflected_;
    std::vector<DirectionPacket> pattern_;
};

} // namespace

CellLight noCellLight(const Grid& grid, const BakeSettings& settings)
{
    const uint32_t coefficients = settings.coefficientCount();
    return {coefficients, std::vector<vec3>(size_t{grid.cellCount()} * kLocalCoefficients * coefficients, vec3{0}),
            std::vector<uint8_t>(grid.cellCount(), 0)};
}

Grid gridOver(const Aabb& bounds, float cellMetres)
{
    check(!bounds.isEmpty() && cellMetres > 0, "a box with something in it and cells of some size");
    vec3 extent = bounds.extent();
    extent.y = std::max(extent.y, kPersonMetres);
    const vec3 count = glm::max(glm::ceil(extent / cellMetres), vec3{1});
    const vec3 spacing = glm::max(extent / count, vec3{1.0e-3f * cellMetres});
    return {.origin = bounds.lowest + 0.5f * spacing, .spacing = spacing, .count = uvec3(count)};
}

RayCounts gatherCells(const RayScene& rays, const TexelMap& map, const BakeSettings& settings, const Transfers& lit, const Grid& grid,
                      Range range, CellLight& result)
{
    const size_t entries = size_t{kLocalCoefficients} * settings.coefficientCount();
    check(lit.coefficientCount == settings.coefficientCount() && lit.isValid.size() == map.texelCount(),
          "transfers of this map's texels and these settings' bands");
    check(result.isOpen.size() == grid.cellCount() && result.values.size() == grid.cellCount() * entries, "light of this grid's cells");
    check(uint64_t{range.first} + range.count <= grid.cellCount(), "cells of the grid");
    RayCounts counts;
    withBands(settings.bands, [&]<uint32_t kBands>() {
        const CellGatherer<kBands> gatherer(rays, settings.raysPerCell, {rays.surfaces(), map, lit});
        for (uint32_t cell = range.first; cell < range.first + range.count; ++cell) {
            const std::span matrix = std::span(result.values).subspan(cell * entries, entries);
            result.isOpen[cell] = gatherer.gather(grid.position(cell), scrambled(cell), matrix) ? 1 : 0;
        }
        counts.rays = gatherer.rayCount() * range.count;
    });
    return counts;
}

} // namespace antumbra::bake
