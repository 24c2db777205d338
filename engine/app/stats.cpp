#include "app/stats.h"

#include <nlohmann/json.hpp>

namespace antumbra::app {

namespace {

using Json = nlohmann::ordered_json;

Json orNull(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

Json summaryOf(const SampleWindow& times)
{
    return {{"median", orNull(times.median())}, {"min", orNull(times.least())}, {"max", orNull(times.greatest())}};
}

Json knobsOf(const render::Knobs& knobs)
{
    Json values = Json::object();
    for (const render::KnobDescription& knob : render::knobTable()) {
        const std::string value = render::get(knobs, knob.key);
        values[std::string(knob.key)] = knob.choices.empty() ? Json::parse(value) : Json(value);
    }
    return values;
}

Json qualityOf(const QualityControl& quality)
{
    return {{"target_ms", quality.targetMilliseconds()},
            {"held", quality.isTargetHeld()},
            {"level", quality.level()},
            {"lowest_level", quality.lowestLevel()}};
}

Json passesOf(const Profiler& profiler, const render::FrameReport& report)
{
    Json passes = Json::array();
    for (const PassTimes& pass : profiler.passes())
        passes.push_back({{"name", pass.name}, {"gpu_ms", summaryOf(pass.milliseconds)}, {"culled", false}, {"reason", ""}});
    const Json noTimes = {{"median", nullptr}, {"min", nullptr}, {"max", nullptr}};
    for (const graph::AbsentPass& pass : report.absent)
        passes.push_back({{"name", pass.name}, {"gpu_ms", noTimes}, {"culled", true}, {"reason", reasonOf(pass)}});
    return passes;
}

Json countersOf(const shader::CounterBlock& counters)
{
    return {{"rays_considered", counters.raysConsidered},
            {"rays_traced", counters.raysTraced},
            {"cones", counters.cones},
            {"pieces", counters.pieces},
            {"sdf_evaluations", counters.fieldEvaluations},
            {"fallback_pixels", counters.fallbackPixels},
            {"clamped_pixels", counters.clampedPixels},
            {"nan_pixels", counters.nanPixels},
            {"inf_pixels", counters.infPixels},
            {"negative_pixels", counters.negativePixels}};
}

Json bytesOf(const render::MemoryReport& memory)
{
    return {{"reserved", memory.reserved}, {"used", memory.used}, {"transient", memory.transient}, {"history", memory.history}};
}

} // namespace

std::string statsJson(const StatsInput& input)
{
    Json stats = {{"device", input.device},
                  {"driver", input.driver},
                  {"scene", input.scene},
                  {"size", {input.size.x, input.size.y}},
                  {"frames", input.frames},
                  {"knobs", knobsOf(input.knobs)},
                  {"frame_ms", summaryOf(input.profiler.frameMilliseconds())},
                  {"gpu_frame_ms", summaryOf(input.profiler.gpuMilliseconds())},
                  {"passes", passesOf(input.profiler, input.report)},
                  {"counters", countersOf(input.report.counters)},
                  {"memory_bytes", bytesOf(input.memory)}};
    if (input.quality != nullptr)
        stats["quality"] = qualityOf(*input.quality);
    return stats.dump(2) + '\n';
}

} // namespace antumbra::app
