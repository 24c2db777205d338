// The light that leaves surfaces, by the transfers of their texels: what bounces and cells gather where their rays hit.
#pragma once

#include "bake/gather.h"
#include "base/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace antumbra::bake {

/// Channel by channel, coefficient by coefficient: as three floats a coefficient.
template <uint32_t kCoefficients>
using TransferVector = std::array<float, size_t{3} * kCoefficients>;

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

/// sum += weight * values.
template <size_t kCount>
void addScaled(float weight, const float* __restrict values, float* __restrict sum)
{
    for (size_t k = 0; k < kCount; ++k)
        sum[k] += weight * values[k];
}

template <uint32_t kCoefficients>
class ReflectedLight
{
public:
    using Radiance = TransferVector<kCoefficients>;

    ReflectedLight(const StaticScene& surfaces, const TexelMap& map, const Transfers& lit) : surfaces_(surfaces), map_(map), lit_(lit) {}

    /// Calls visit(lane, radiance) for what the lanes met from in front; radiance, as a function of the environment, is albedo / pi times
    /// the transfer there.
    template <class Visit>
    void forEach(const HitPacket& met, Visit&& visit) const
    {
        std::array<Place, kLanes> places;
        uint32_t count = 0;
        for (LaneMask fronts = met.hits & ~met.backs; fronts != 0; fronts &= fronts - 1)
            find(met, static_cast<uint32_t>(std::countr_zero(fronts)), places[count++]);
        for (uint32_t i = 0; i < count; ++i) {
            Radiance radiance{};
            evaluate(places[i], radiance);
            visit(places[i].lane, radiance);
        }
    }

private:
    struct Place
    {
        uint32_t lane;
        vec3 reflectance;
        Footprint footprint;
    };

    /// Asks for the memory that evaluate() reads: it lies anywhere, and comes while the other lanes are found.
    void find(const HitPacket& met, uint32_t lane, Place& place) const
    {
        constexpr uint32_t kCoefficientsPerLine = 5;
        const SurfacePoint& point = met.points[lane];
        place.lane = lane;
        place.reflectance = albedoAt(surfaces_, point) / kPi;
        place.footprint = footprintAt(map_, lit_.isValid, bakeUvAt(surfaces_, point));
        for (uint32_t i = 0; i < place.footprint.count; ++i)
            for (uint32_t k = 0; k < kCoefficients; k += kCoefficientsPerLine)
                __builtin_prefetch(transferOf(place.footprint.texels[i]) + size_t{3} * k);
    }

    void evaluate(const Place& place, Radiance& radiance) const
    {
        for (uint32_t i = 0; i < place.footprint.count; ++i)
            addScaled<std::tuple_size_v<Radiance>>(place.footprint.weights[i], transferOf(place.footprint.texels[i]), radiance.data());
        for (size_t k = 0; k < radiance.size(); k += 3) {
            radiance[k] *= place.reflectance.x;
            radiance[k + 1] *= place.reflectance.y;
            radiance[k + 2] *= place.reflectance.z;
        }
    }

    [[nodiscard]] const float* transferOf(uint32_t texel) const { return &lit_.values[size_t{texel} * kCoefficients].x; }

    const StaticScene& surfaces_;
    const TexelMap& map_;
    const Transfers& lit_;
};

} // namespace antumbra::bake
