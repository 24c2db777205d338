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
        uint32_t backs = 0, packet = 0;
        for (const DirectionPacket& local : pattern_) {
            DirectionPacket directions;
            rotate(frame, local, directions);
            HitPacket met;
            rays_.intersect(position, directions, kAllLanes, met);
            backs += static_cast<uint32_t>(std::popcount(met.backs));
            Basis basis;
            evaluateShPolynomials<kBasisBands, float>(directions.x, directions.y, directions.z, basis.data());
            addOpen(basis, kAllLanes & ~met.hits, sums);
            addReflected(basis, met, packet++, sums);
        }
        const auto count = static_cast<float>(rayCount());
        const bool isOpen = static_cast<float>(backs) <= kMostBackHits * count;
        for (uint32_t j = 0; j < kLocalCoefficients; ++j)
            for (uint32_t i = 0; i < kCoefficients; ++i)
                matrix[j * kCoefficients + i] = isOpen ? 4 * kPi / count * (openAt(sums, j, i) + reflectedAt(sums, j, i)) : vec3{0};
        return isOpen;
    }

    [[nodiscard]] size_t rayCount() const { return pattern_.size() * kLanes; }

private:
    static constexpr uint32_t kRowsAtOnce = 5;
    static_assert(kLocalCoefficients % kRowsAtOnce == 0);
    static constexpr uint32_t kBasisBands = std::max(kBands, kLocalBands);
    using Basis = std::array<Lanes, kBasisBands * kBasisBands>;

    /// By rows of the matrix.
    struct Sums
    {
        std::array<std::array<Lanes, kCoefficients>, kLocalCoefficients> open; // from the diagonal on: what is before it is the same
        std::array<TransferVector<kCoefficients>, kLocalCoefficients> reflected;
    };

    static float openAt(const Sums& sums, uint32_t j, uint32_t i)
    {
        return sumOf(i < j && j < kCoefficients ? sums.open[i][j] : sums.open[j][i]);
    }

    static vec3 reflectedAt(const Sums& sums, uint32_t j, uint32_t i)
    {
        const auto at = [&](uint32_t k) { return sums.reflected[j][k / 4][k % 4]; };
        return {at(3 * i), at(3 * i + 1), at(3 * i + 2)};
    }

    static void addOpen(const Basis& basis, LaneMask open, Sums& sums)
    {
        if (open == 0)
            return;
        Lanes weight;
        setWeights(open, weight);
        for (uint32_t j = 0; j < kLocalCoefficients; ++j) {
            const Lanes weighted = weight * basis[j];
            for (uint32_t i = j < kCoefficients ? j : 0; i < kCoefficients; ++i)
                sums.open[j][i] += weighted * basis[i];
        }
    }

    void addReflected(const Basis& basis, const HitPacket& met, uint32_t packet, Sums& sums) const
    {
        Reflections<kCoefficients> reflections;
        reflected_.collect(met, packet, reflections);
        for (uint32_t first = 0; first < kLocalCoefficients; first += kRowsAtOnce)
            addToRows(first, basis, reflections, sums);
    }

    /// Column by column, so that the rows' parts of it stay in registers over the packet.
    static void addToRows(uint32_t first, const Basis& basis, const Reflections<kCoefficients>& reflections, Sums& sums)
    {
        std::array<std::array<Four, kRowsAtOnce>, kLanes> weights;
        for (uint32_t hit = 0; hit < reflections.count; ++hit)
            for (uint32_t j = 0; j < kRowsAtOnce; ++j)
                weights[hit][j] = Four{} + basis[first + j][reflections.lanes[hit]];
        for (size_t k = 0; k < sums.reflected[0].size(); ++k) {
            std::array<Four, kRowsAtOnce> column;
            for (uint32_t j = 0; j < kRowsAtOnce; ++j)
                column[j] = sums.reflected[first + j][k];
            for (uint32_t hit = 0; hit < reflections.count; ++hit)
                for (uint32_t j = 0; j < kRowsAtOnce; ++j)
                    column[j] += weights[hit][j] * reflections.radiances[hit][k];
            for (uint32_t j = 0; j < kRowsAtOnce; ++j)
                sums.reflected[first + j][k] = column[j];
        }
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
