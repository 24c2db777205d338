#include "bake/settings.h"

#include "bake/sh.h"

#include <cmath>
#include <fmt/format.h>

namespace antumbra::bake {

namespace {

template <auto Field>
constexpr BakeSetting setting(std::string_view name, double least, double greatest, std::string_view doc)
{
    using Value = std::remove_reference_t<decltype(BakeSettings{}.*Field)>;
    return {
        .name = name,
        .doc = doc,
        .least = least,
        .greatest = greatest,
        .isWhole = std::is_integral_v<Value>,
        .read = [](const BakeSettings& settings) { return static_cast<double>(settings.*Field); },
        .write = [](BakeSettings& settings, double value) { settings.*Field = static_cast<Value>(value); },
    };
}

constexpr BakeSetting kSettings[] = {
    setting<&BakeSettings::bands>("bands", kFewestBands, kMostBands, "bands of the environment's spherical harmonics"),
    setting<&BakeSettings::bounces>("bounces", 0, 4, "diffuse interreflections"),
    setting<&BakeSettings::raysPerTexel>("rays", 64, 4096, "rays a texel and bounce"),
    setting<&BakeSettings::raysPerCell>("cell_rays", 64, 16384, "rays a cell of the irradiance volume"),
    setting<&BakeSettings::texelsPerMetre>("density", 0.01, 1000, "texels a metre, where the page holds as many"),
    setting<&BakeSettings::mostTexels>("page", 16, 8192, "greatest side of the page, in texels"),
    setting<&BakeSettings::cellMetres>("cell", 0.01, 1000, "edge of a cell of the irradiance volume, in metres"),
};

} // namespace

bool BakeSetting::allows(double value) const
{
    // Written so that NaN is refused as well.
    return value >= static_cast<double>(static_cast<float>(least)) && value <= greatest && (!isWhole || value == std::floor(value));
}

std::span<const BakeSetting> bakeSettings() { return kSettings; }

uint64_t rayCount(const BakeSettings& settings, uint64_t texels, uint64_t cells)
{
    return texels * settings.raysPerTexel * (1 + settings.bounces) + cells * settings.raysPerCell;
}

std::string difference(const BakeSettings& found, const BakeSettings& wanted)
{
    std::string text;
    for (const BakeSetting& setting : kSettings)
        if (setting.read(found) != setting.read(wanted))
            text += fmt::format("{}prt.{} is {:.6g} and not {:.6g}", text.empty() ? "" : ", ", setting.name, setting.read(found),
                                setting.read(wanted));
    return text;
}

} // namespace antumbra::bake
