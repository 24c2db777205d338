// The light that leaves surfaces, by the transfers of their texels: what bounces and cells gather where their rays hit.
#pragma once

#include "bake/gather.h"
#include "bake/lanes.h"
#include "base/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace antumbra::bake {

/// Coefficient by coefficient, three floats each for its channels, filled up with zeros to whole Fours.
template <uint32_t kCoefficients>
using TransferVector = std::array<Four, (size_t{3} * kCoefficients + 3) / 4>;

/// Calls body.operator()<kBands>() for the number of bands, 2..5.
template <class Body>
void withBands(uint32_t bands, Body&& body)
{
    switch (bands) {
    case 2: return std::forward<Body>(body).template operator()<2>();
    case 3: return std::forward<Body>(body).template operator()<3>();
    case 4: return std::forward<Body>(body).template operator()<4>();
    case 5: return std::forward<Body>(body).template operator()<5>();
    default: check(false, "2 to 5 bands of spherical harmonics");
    }
}

/// What one packet of rays met, seen from in front.
template <uint32_t kCoefficients>
struct Reflections
{
    uint32_t count = 0;
    std::array<uint32_t, kLanes> lanes;
    std::array<TransferVector<kCoefficients>, kLanes> radiances; // as functions of the environment
};

/// Radiance is albedo / pi times the transfer at the hit. The transfer is that of one of the four texels about it, as likely as its
/// bilinear weight is large: a gather meets so many places that the mean is what interpolation would give, at a quarter of the memory.
template <uint32_t kCoefficients>
class ReflectedLight
{
public:
    ReflectedLight(const StaticScene& surfaces, const TexelMap& map, const Transfers& lit) : surfaces_(surfaces), map_(map), lit_(lit) {}

    /// `packet` counts the packets of one gather, and so which texels are chosen.
    void collect(const HitPacket& met, uint32_t packet, Reflections<kCoefficients>& reflections) const
    {
        std::array<Place, kLanes> places;
        uint32_t count = 0;
        for (LaneMask fronts = met.hits & ~met.backs; fronts != 0; fronts &= fronts - 1) {
            const auto lane = static_cast<uint32_t>(std::countr_zero(fronts));
            reflections.lanes[count] = lane;
            places[count++] = find(met.points[lane], packet * kLanes + lane);
        }
        reflections.count = count;
        for (uint32_t i = 0; i < count; ++i)
            choose(places[i]);
        for (uint32_t i = 0; i < count; ++i)
            evaluate(places[i], reflections.radiances[i]);
    }

private:
    struct Place
    {
        SurfacePoint point;
        vec2 bakeUv;
        uint32_t page;  // the chosen place on it
        uint32_t texel; // there, or kNoTexel
        vec3 reflectance;
    };

    /// The memory that choose() and evaluate() read lies anywhere, and comes while the other lanes are looked at.
    Place find(const SurfacePoint& point, uint32_t ray) const
    {
        // Two-dimensional golden ratios: hits that follow each other are chosen for evenly.
        const vec2 share(static_cast<float>(ray * 0xc13fa9a9u) * 0x1p-32f, static_cast<float>(ray * 0x91e10da5u) * 0x1p-32f);
        Place place{.point = point, .bakeUv = bakeUvAt(surfaces_, point)};
        const vec2 at = glm::clamp(place.bakeUv * vec2(map_.extent) - 0.5f + share, vec2(0), vec2(map_.extent) - 1.0f);
        place.page = static_cast<uint32_t>(at.y) * map_.extent.x + static_cast<uint32_t>(at.x);
        __builtin_prefetch(&map_.texels[place.page]);
        return place;
    }

    void choose(Place& place) const
    {
        place.reflectance = albedoAt(surfaces_, place.point) / kPi;
        place.texel = map_.texels[place.page];
        if (place.texel == kNoTexel || lit_.isValid[place.texel] == 0) {
            place.texel = kNoTexel;
            return;
        }
        for (uint32_t k = 0; k < kCoefficients; k += kCoefficientsPerLine)
            __builtin_prefetch(transferOf(place.texel) + size_t{3} * k);
    }

    void evaluate(const Place& place, TransferVector<kCoefficients>& radiance) const
    {
        if (place.texel != kNoTexel)
            return scaled(transferOf(place.texel), place.reflectance, radiance);
        // At the rim of a chart, where what was chosen is none: the mean of those that are.
        radiance = {};
        const Footprint footprint = footprintAt(map_, lit_.isValid, place.bakeUv);
        for (uint32_t i = 0; i < footprint.count; ++i) {
            TransferVector<kCoefficients> part;
            scaled(transferOf(footprint.texels[i]), footprint.weights[i] * place.reflectance, part);
            for (size_t k = 0; k < part.size(); ++k)
                radiance[k] += part[k];
        }
    }

    static void scaled(const float* transfer, vec3 scale, TransferVector<kCoefficients>& result)
    {
        const Four scales[3] = {
            {scale.x, scale.y, scale.z, scale.x}, {scale.y, scale.z, scale.x, scale.y}, {scale.z, scale.x, scale.y, scale.z}};
        result.back() = Four{};
        std::memcpy(result.data(), transfer, sizeof(float) * 3 * kCoefficients);
        for (size_t k = 0; k < result.size(); ++k)
            result[k] *= scales[k % 3];
    }

    [[nodiscard]] const float* transferOf(uint32_t texel) const { return &lit_.values[size_t{texel} * kCoefficients].x; }

    static constexpr uint32_t kCoefficientsPerLine = 5;

    const StaticScene& surfaces_;
    const TexelMap& map_;
    const Transfers& lit_;
};

} // namespace antumbra::bake
