// T = integral of V Y (n.w) dw and, bounce by bounce, T' = integral of (1 - V) albedo / pi T (n.w) dw (Sloan et al. 2002, sections 4.1 and
// 4.2), by directions as dense as the cosine: pi times their mean.
#include "bake/reflected_light.h"
#include "bake/sh_polynomials.h"
#include "bake/texel_rays.h"

#include <bit>

namespace antumbra::bake {

namespace {

/// The environment through what is open.
template <uint32_t kBands>
class DirectLight
{
public:
    using Sum = std::array<Lanes, kBands * kBands>;

    void add(const DirectionPacket& directions, LaneMask above, const HitPacket& met, uint32_t, Sum& sum) const
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

    void add(const DirectionPacket&, LaneMask, const HitPacket& met, uint32_t packet, Sum& sum) const
    {
        Reflections<kBands * kBands> reflections;
        reflected_.collect(met, packet, reflections);
        for (uint32_t i = 0; i < reflections.count; ++i)
            for (size_t k = 0; k < sum.size(); ++k)
                sum[k] += reflections.radiances[i][k];
    }

    static void addTo(std::span<vec3> total, const Sum& sum)
    {
        for (size_t k = 0; k < 3 * total.size(); ++k)
            total[k / 3][static_cast<int>(k % 3)] += sum[k / 4][k % 4];
    }

private:
    ReflectedLight<kBands * kBands> reflected_;
};

/// Gathers texels, one after the other.
template <class Light>
class TexelGatherer
{
public:
    TexelGatherer(const RayScene& rays, const TexelMap& map, uint32_t raysPerTexel, const Light& light)
        : rays_(rays), light_(light), texelRays_(rays.surfaces(), map, raysPerTexel)
    {
    }

    /// Replaces `transfer`; false, and zero, where all points lie inside something solid.
    bool gather(uint32_t texel, std::span<vec3> transfer)
    {
        const uint32_t points = texelRays_.pointCount(texel), raysPerPoint = texelRays_.raysPerPoint(points);
        std::ranges::fill(transfer, vec3{0});
        uint32_t outside = 0;
        packet_ = 0;
        for (uint32_t point = 0; point < points; ++point) {
            typename Light::Sum sum{};
            if (trace(texel, point, kMostBackHits * static_cast<float>(raysPerPoint), sum)) {
                Light::addTo(transfer, sum);
                ++outside;
            }
        }
        for (vec3& value : transfer)
            value *= outside > 0 ? kPi / static_cast<float>(outside * raysPerPoint) : 0.0f;
        return outside > 0;
    }

    [[nodiscard]] RayCounts counts() const { return counts_; }

private:
    /// False where the point lies inside something solid.
    bool trace(uint32_t texel, uint32_t point, float mostBacks, typename Light::Sum& sum)
    {
        uint32_t backs = 0;
        texelRays_.forEach(texel, point, [&](vec3 origin, const DirectionPacket& directions, LaneMask above) {
            HitPacket met;
            rays_.intersect(origin, directions, above, met);
            light_.add(directions, above, met, packet_++, sum);
            backs += static_cast<uint32_t>(std::popcount(met.backs));
            counts_.rays += static_cast<uint32_t>(std::popcount(above));
        });
        return static_cast<float>(backs) <= mostBacks;
    }

    const RayScene& rays_;
    const Light& light_;
    TexelRays texelRays_;
    uint32_t packet_ = 0; // of the texel
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
