#include "bake/settings.h"

#include <cmath>
#include <fmt/format.h>

namespace antumbra::bake {

bool BakeSetting::allows(double value) const
{
    // Written so that NaN is refused as well.
    return value >= static_cast<double>(static_cast<float>(least)) && value <= greatest && (!isWhole || value == std::floor(value));
}

uint64_t rayCount(const BakeSettings& settings, uint64_t texels, uint64_t cells)
{
    return texels * settings.raysPerTexel * (1 + settings.bounces) + cells * settings.raysPerCell;
}

std::string difference(const BakeSettings& found, const BakeSettings& wanted)
{
    std::string text;
    for (const BakeSetting& setting : kBakeSettings)
        if (setting.read(found) != setting.read(wanted))
            text += fmt::format("{}{} is {:.6g} and not {:.6g}", text.empty() ? "" : ", ", setting.key, setting.read(found),
                                setting.read(wanted));
    return text;
}

} // namespace antumbra::bake
