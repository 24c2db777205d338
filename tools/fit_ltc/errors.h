// How far tables are from the reflection where they were not fitted: between nodes, towards other directions than the fit's.
#pragma once

#include "tools/fit_ltc/lobe.h"

#include <array>
#include <string>

namespace antumbra::fit {

/// Roughness up to which a band goes from the one before.
inline constexpr std::array kBandEnds{0.1, 0.2, 0.4, 0.6, 0.8, 1.0};

struct Errors
{
    uint32_t places = 0;
    Distance mean, worst;
};

struct ErrorReport
{
    std::array<Errors, kBandEnds.size()> bands;
    Errors all; // of all roughnesses alike
};

/// At `density` places in a tenth of roughness, 1 or more; views evenly over a table's rows. The same places for all tables.
ErrorReport errorsOf(const bake::LtcTables& tables, uint32_t density);

/// A line for each band and one for all; the relative errors in percent.
std::string describe(const ErrorReport& report);

/// Which means of `ours` are greater than those of `theirs`, in words; empty where none is.
std::string whereWorse(const ErrorReport& ours, const ErrorReport& theirs);
/// Which means of a report are greater than the tool allows in the tables it ships, in words; empty where none is.
std::string whereOutOfBounds(const ErrorReport& report);

} // namespace antumbra::fit
