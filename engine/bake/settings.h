// The settings of a bake by their names: knobs, files and messages share them and their ranges.
#pragma once

#include "bake/bake.h"

#include <span>
#include <string>
#include <string_view>

namespace antumbra::bake {

/// Every setting is a number that a float holds exactly; `write` does not check its range.
struct BakeSetting
{
    std::string_view name; // after "prt."
    std::string_view doc;
    double least;
    double greatest;
    bool isWhole;
    double (*read)(const BakeSettings&);
    void (*write)(BakeSettings&, double);

    [[nodiscard]] bool allows(double value) const;
};

std::span<const BakeSetting> bakeSettings();

/// How many rays so many texels and cells take.
uint64_t rayCount(const BakeSettings& settings, uint64_t texels, uint64_t cells);

/// What differs, as in "prt.bounces is 1 and not 2"; empty where nothing does.
std::string difference(const BakeSettings& found, const BakeSettings& wanted);

} // namespace antumbra::bake
