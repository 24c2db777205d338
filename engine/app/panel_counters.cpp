#include "app/panel_sections.h"
#include "render/overlay_style.h"

namespace antumbra::app {

namespace {

/// Three digits that matter and a unit's letter: "12.3 M".
Line shortCount(double count)
{
    const auto scaled = [](double value, std::string_view letter) {
        return Line("{:.{}f} {}", value, value < 10 ? 2 : value < 100 ? 1 : 0, letter);
    };
    if (count < 1e4)
        return Line("{:.0f}", count);
    if (count < 1e6)
        return scaled(count / 1e3, "k");
    return count < 1e9 ? scaled(count / 1e6, "M") : scaled(count / 1e9, "G");
}

void buildCount(std::string_view name, uint32_t count) { buildRow(name, shortCount(count), render::kOverlayText); }

/// Pixels that should not be.
void buildFault(std::string_view name, uint32_t pixels)
{
    buildRow(name, Line("{}", pixels), pixels > 0 ? render::kOverlayBroken : render::kOverlayQuiet);
}

void buildBytes(std::string_view name, uint64_t bytes)
{
    buildRow(name, Line("{:.1f} MiB", static_cast<double>(bytes) / (1024.0 * 1024.0)), render::kOverlayText);
}

} // namespace

void buildCounters(const shader::CounterBlock& counters, const render::Knobs& knobs, uvec2 extent)
{
    const uvec2 edge(static_cast<uint32_t>(knobs.occlusion.scale));
    const uvec2 traced = (extent + edge - 1u) / edge;
    const double pixels = static_cast<double>(traced.x) * traced.y;
    const double considered = counters.raysConsidered;
    buildCount("rays considered", counters.raysConsidered);
    buildCount("rays traced", counters.raysTraced);
    buildRow("share", considered > 0 ? Line("{:.2f} %", 100 * counters.raysTraced / considered) : Line("-"), render::kOverlayText);
    buildRow("cones a pixel", pixels > 0 ? Line("{:.3f}", counters.cones / pixels) : Line("-"), render::kOverlayText);
    if (counters.pieces > 0) // area lights
        buildCount("pieces", counters.pieces);
    if (counters.fieldEvaluations > 0)
        buildCount("sdf evaluations", counters.fieldEvaluations);
    buildCount("fallback pixels", counters.fallbackPixels);
    buildFault("clamped pixels", counters.clampedPixels);
    buildFault("NaN pixels", counters.nanPixels);
    buildFault("Inf pixels", counters.infPixels);
    buildFault("negative pixels", counters.negativePixels);
}

void buildMemory(const render::MemoryReport& memory)
{
    buildBytes("reserved", memory.reserved);
    buildBytes("used", memory.used);
    buildBytes("transient", memory.transient);
    buildBytes("history", memory.history);
    buildRow("allocations so far", Line("{}", memory.allocationsEver), render::kOverlayText);
}

} // namespace antumbra::app
