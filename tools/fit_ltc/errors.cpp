#include "tools/fit_ltc/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace antumbra::fit {

namespace {

constexpr uint32_t kDirections = 1024; // from the lobe, and as many from the cosine
constexpr uint32_t kPlacesSeed = 1, kDirectionsSeed = 2;

// Means over a band, a tenth above what a table of 64 nodes a side can do. Below 0.1 lobes are thinner than its steps.
constexpr std::array<Distance, kBandEnds.size()> kBounds{
    {{0.21, 0.17}, {0.041, 0.018}, {0.097, 0.046}, {0.132, 0.092}, {0.093, 0.094}, {0.058, 0.062}}};

void add(Errors& errors, const Distance& distance)
{
    ++errors.places;
    errors.mean.l1 += (distance.l1 - errors.mean.l1) / errors.places;
    errors.mean.l2 += (distance.l2 - errors.mean.l2) / errors.places;
    errors.worst = {std::max(errors.worst.l1, distance.l1), std::max(errors.worst.l2, distance.l2)};
}

Distance distanceAt(const bake::LtcTables& tables, double roughness, double cosView, const Pattern& pattern)
{
    const bake::LtcTexel found = bake::lookUp(tables, roughness, cosView);
    const Lobe lobe(std::max(cosView, bake::kLeastCosView), std::max(roughness * roughness, bake::kLeastAlpha), pattern);
    return lobe.distanceTo(bake::Ltc(found.matrix), found.amplitude.x);
}

std::string nameOf(size_t band) { return fmt::format("{:.1f} to {:.1f}", band == 0 ? 0.0 : kBandEnds[band - 1], kBandEnds[band]); }

std::string lineOf(const std::string& name, const Errors& errors)
{
    return fmt::format("{:<12}{:>8}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}\n", name, errors.places, 100 * errors.mean.l1,
                       100 * errors.worst.l1, 100 * errors.mean.l2, 100 * errors.worst.l2);
}

void tellGreater(std::string& text, const std::string& where, const Distance& mean, const Distance& most)
{
    const auto tell = [&](const char* norm, double value, double allowed) {
        if (!(value <= allowed))
            text += fmt::format("{}{}, mean {}: {:.3f} % > {:.3f} %", text.empty() ? "" : "; ", where, norm, 100 * value, 100 * allowed);
    };
    tell("L1", mean.l1, most.l1);
    tell("L2", mean.l2, most.l2);
}

} // namespace

ErrorReport errorsOf(const bake::LtcTables& tables, uint32_t density)
{
    const Pattern directions = hammersleyPattern(kDirections, kDirectionsSeed);
    ErrorReport report;
    double begin = 0;
    for (size_t band = 0; band < kBandEnds.size(); ++band) {
        const double width = kBandEnds[band] - begin;
        const auto places = static_cast<uint32_t>(std::lround(10 * width * density));
        for (const glm::dvec2& place : hammersleyPattern(places, kPlacesSeed)) {
            const Distance distance = distanceAt(tables, begin + width * place.x, 1 - place.y * place.y, directions);
            add(report.bands[band], distance);
            add(report.all, distance);
        }
        begin = kBandEnds[band];
    }
    return report;
}

std::string describe(const ErrorReport& report)
{
    std::string text =
        fmt::format("{:<12}{:>8}{:>10}{:>10}{:>10}{:>10}\n", "roughness", "places", "mean L1%", "worst L1%", "mean L2%", "worst L2%");
    for (size_t band = 0; band < report.bands.size(); ++band)
        text += lineOf(nameOf(band), report.bands[band]);
    return text + lineOf("all", report.all);
}

std::string whereWorse(const ErrorReport& ours, const ErrorReport& theirs)
{
    std::string text;
    for (size_t band = 0; band < ours.bands.size(); ++band)
        tellGreater(text, nameOf(band), ours.bands[band].mean, theirs.bands[band].mean);
    tellGreater(text, "all", ours.all.mean, theirs.all.mean);
    return text;
}

std::string whereOutOfBounds(const ErrorReport& report)
{
    std::string text;
    for (size_t band = 0; band < report.bands.size(); ++band)
        tellGreater(text, nameOf(band), report.bands[band].mean, kBounds[band]);
    return text;
}

} // namespace antumbra::fit
