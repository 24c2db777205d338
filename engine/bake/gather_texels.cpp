// T = integral of V Y (n.w) dw and, bounce by bounce, T' = integral of (1 - V) albedo / pi T (n.w) dw (Sloan et al. 2002, sections 4.1 and
// 4.2), by directions as dense as the cosine: pi times their mean.
#include "bake/reflected_light.h"
#include "bake/sh_polynomials.h"

#include <bit>

namespace antumbra::bake {

namespace {

/// The environment through what is open.
template <uint32_t kBands>
class DirectLight
{
public:
    using Sum = std::array<Lanes, kBands * kBands>;

    void add(const DirectionPacket& directions, LaneMask above, const HitPacket& met, Sum& sum) const
    {
        const LaneMask open = above & ~met.hits;
        if (open == 0)
            return;
        Lanes weight;
        setWeights(open, weight);
        Sum basis;
        evaluateShPolynomials<kBands, float>(directions.x, directions.y, directions.z, basis.data());
        for (size_t i = 0; i < sum.size(); ++i)
            sum[i] += weight * basis[i];
    }

    static void addTo(std::span<vec3> total, const Sum& sum)
    {
        for (size_t i = 0; i < sum.size(); ++i)
            total[i] += vec3{sumOf(sum[i])};
    }
};

/// What surfaces send on.
template <uint32_t kBands>
class BouncedLight
{
public:
    using Sum = TransferVector<kBands * kBands>;

    explicit BouncedLight(ReflectedLight<kBands * kBands> reflected) : reflected_(reflected) {}

    void add(const DirectionPacket&, LaneMask, const HitPacket& met, Sum& sum) const
    {
        reflected_.forEach(met,
                           [&](uint32_t, const Sum& radiance) { addScaled<std::tuple_size_v<Sum>>(1.0f, radiance.data(), sum.data()); });
    }

    static void addTo(std::span<vec3> total, const Sum& sum)
    {
        for (size_t k = 0; k < sum.size(); ++k)
            total[k / 3][static_cast<int>(k % 3)] += sum[k];
    }

private:
    ReflectedLight<kBands * kBands> reflected_;
};

/// The lanes that leave on the outer side of the surface.
LaneMask lanesAbove(const DirectionPacket& directions, vec3 normal)
{
    const Lanes height = directions.x * normal.x + directions.y * normal.y + directions.z * normal.z;
    LaneMask above = 0;
    for (uint32_t lane = 0; lane < kLanes; ++lane)
        if (height[lane] > 0)
            above |= 1u << lane;
    return above;
}

/// Gathers texels with directions that it keeps from one to the next.
template <class Light>
class TexelGatherer
{
public:
    TexelGatherer(const RayScene& rays, const TexelMap& map, uint32_t raysPerTexel, const Light& light)
        : rays_(rays), map_(map), light_(light), packetsPerTexel_((std::max(raysPerTexel, 1u) + kLanes - 1) / kLanes)
    {
    }

    /// Replaces `transfer`; false, and zero, where all points lie inside something solid.
    bool gather(uint32_t texel, std::span<vec3> transfer)
    {
        const std::span<const SurfacePoint> points = map_.pointsOf(texel);
        const auto used = std::min(static_cast<uint32_t>(points.size()), packetsPerTexel_);
        const std::vector<DirectionPacket>& pattern = patternFor(used);
        const uint64_t key = scrambled(uint64_t{map_.places[texel].y} << 32 | map_.places[texel].x);
        std::ranges::fill(transfer, vec3{0});
        uint32_t outside = 0;
        for (uint32_t i = 0; i < used; ++i) {
            typename Light::Sum sum{};
            if (trace(points[i * points.size() / used], 2 * kPi * unitFloat(scrambled(key + i)), pattern, sum)) {
                Light::addTo(transfer, sum);
                ++outside;
            }
        }
        for (vec3& value : transfer)
            value *= outside > 0 ? kPi / static_cast<float>(outside * pattern.size() * kLanes) : 0.0f;
        return outside > 0;
    }

    [[nodiscard]] RayCounts counts() const { return counts_; }

private:
    /// False where the point lies inside something solid.
    bool trace(const SurfacePoint& point, float radians, std::span<const DirectionPacket> pattern, typename Light::Sum& sum)
    {
        const StaticScene& surfaces = rays_.surfaces();
        const vec3 origin = rayOrigin(surfaces, point), normal = geometricNormal(surfaces, point.triangle);
        const mat3 frame = frameAbout(shadingNormalAt(surfaces, point), radians);
        uint32_t backs = 0;
        for (const DirectionPacket& local : pattern) {
            DirectionPacket directions;
            rotate(frame, local, directions);
            const LaneMask above = lanesAbove(directions, normal);
            HitPacket met;
            rays_.intersect(origin, directions, above, met);
            light_.add(directions, above, met, sum);
            backs += static_cast<uint32_t>(std::popcount(met.backs));
            counts_.rays += static_cast<uint32_t>(std::popcount(above));
        }
        return static_cast<float>(backs) <= kMostBackHits * static_cast<float>(pattern.size() * kLanes);
    }

    const std::vector<DirectionPacket>& patternFor(uint32_t points)
    {
        if (patterns_.size() <= points)
            patterns_.resize(points + 1);
        if (patterns_[points].empty())
            patterns_[points] = cosineDirections((packetsPerTexel_ + points - 1) / points);
        return patterns_[points];
    }

    const RayScene& rays_;
    const TexelMap& map_;
    const Light& light_;
    uint32_t packetsPerTexel_;
    std::vector<std::vector<DirectionPacket>> patterns_; // by number of points
    RayCounts counts_;
};

void checkFits(const TexelMap& map, const BakeSettings& settings, const Transfers& transfers)
{
    check(transfers.coefficientCount == settings.coefficientCount() && transfers.isValid.size() == map.texelCount() &&
              transfers.values.size() == size_t{map.texelCount()} * transfers.coefficientCount,
          "transfers of this map's texels and these settings' bands");
}

std::span<vec3> transferOf(Transfers& transfers, uint32_t texel)
{
    return std::span(transfers.values).subspan(size_t{texel} * transfers.coefficientCount, transfers.coefficientCount);
}

} // namespace

Transfers noTransfers(const TexelMap& map, const BakeSettings& settings)
{
    const uint32_t coefficients = settings.coefficientCount();
    return {coefficients, std::vector<vec3>(size_t{map.texelCount()} * coefficients, vec3{0}), std::vector<uint8_t>(map.texelCount(), 0)};
}

RayCounts gatherDirect(const RayScene& rays, const TexelMap& map, const BakeSettings& settings, Range range, Transfers& result)
{
    checkFits(map, settings, result);
    check(uint64_t{range.first} + range.count <= map.texelCount(), "texels of the map");
    RayCounts counts;
    withBands(settings.bands, [&]<uint32_t kBands>() {
        const DirectLight<kBands> light;
        TexelGatherer gatherer(rays, map, settings.raysPerTexel, light);
        for (uint32_t texel = range.first; texel < range.first + range.count; ++texel)
            result.isValid[texel] = gatherer.gather(texel, transferOf(result, texel)) ? 1 : 0;
        counts = gatherer.counts();
    });
    return counts;
}

RayCounts gatherBounce(const RayScene& rays, const TexelMap& map, const BakeSettings& settings, const Transfers& before, Range range,
                       Transfers& result)
{
    checkFits(map, settings, before);
    checkFits(map, settings, result);
    check(&before != &result, "another place for the result than what it is made of");
    check(uint64_t{range.first} + range.count <= map.texelCount(), "texels of the map");
    RayCounts counts;
    withBands(settings.bands, [&]<uint32_t kBands>() {
        const BouncedLight<kBands> light(ReflectedLight<kBands * kBands>(rays.surfaces(), map, before));
        TexelGatherer gatherer(rays, map, settings.raysPerTexel, light);
        for (uint32_t texel = range.first; texel < range.first + range.count; ++texel)
            if (before.isValid[texel])
                result.isValid[texel] = gatherer.gather(texel, transferOf(result, texel)) ? 1 : 0;
        counts = gatherer.counts();
    });
    return counts;
}

} // namespace antumbra::bake
