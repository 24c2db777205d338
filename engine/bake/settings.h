// The settings of a bake by their keys: knobs, files and messages share them and their ranges.
#pragma once

#include "bake/bake.h"
#include "bake/sh.h"

#include <string>
#include <string_view>
#include <type_traits>

namespace antumbra::bake {

/// Every setting is a number that a float holds exactly; `write` does not check its range.
struct BakeSetting
{
    std::string_view key;
    std::string_view doc;
    double least;
    double greatest;
    bool isWhole;
    double (*read)(const BakeSettings&);
    void (*write)(BakeSettings&, double);

    [[nodiscard]] bool allows(double value) const;
};

template <auto Field>
constexpr BakeSetting bakeSetting(std::string_view key, double least, double greatest, std::string_view doc)
{
    using Value = std::remove_reference_t<decltype(BakeSettings{}.*Field)>;
    return {
        .key = key,
        .doc = doc,
        .least = least,
        .greatest = greatest,
        .isWhole = std::is_integral_v<Value>,
        .read = [](const BakeSettings& settings) { return static_cast<double>(settings.*Field); },
        .write = [](BakeSettings& settings, double value) { settings.*Field = static_cast<Value>(value); },
    };
}

inline constexpr BakeSetting kBakeSettings[] = {
    bakeSetting<&BakeSettings::bands>("prt.bands", kFewestBands, kMostBands, "spherical harmonic bands of the light that is baked for"),
    bakeSetting<&BakeSettings::bounces>("prt.bounces", 0, 4, "diffuse interreflections that are baked"),
    bakeSetting<&BakeSettings::raysPerTexel>("prt.rays", 64, 4096, "baked rays a texel and bounce"),
    bakeSetting<&BakeSettings::raysPerCell>("prt.cell_rays", 64, 16384, "baked rays a cell of the irradiance volume"),
    bakeSetting<&BakeSettings::texelsPerMetre>("prt.density", 0.01, 1000, "baked texels a metre, where the page holds as many"),
    bakeSetting<&BakeSettings::mostTexels>("prt.page", 16, 8192, "greatest side of the page of baked texels"),
    bakeSetting<&BakeSettings::cellMetres>("prt.cell", 0.01, 1000, "metres between cells of the irradiance volume"),
};

/// How many rays so many texels and cells take.
uint64_t rayCount(const BakeSettings& settings, uint64_t texels, uint64_t cells);

/// What differs, as in "prt.bounces is 1 and not 2"; empty where nothing does.
std::string difference(const BakeSettings& found, const BakeSettings& wanted);

} // namespace antumbra::bake
