// `antumbra info`, `inspect` and `graph`: what there is, told and not played.
#include "app/commands.h"
#include "app/playback.h"
#include "base/file.h"
#include "graph/dot.h"
#include "scene/gltf.h"

#include <fmt/ranges.h>

namespace antumbra::app {

ExitCode runInfo()
{
    const gpu::Device device({});
    const gpu::DeviceInfo& info = device.info();
    fmt::print("device     {} ({})\n", info.name, info.isCpu ? "CPU" : "GPU");
    fmt::print("driver     {}\n", info.driver);
    fmt::print("Vulkan     {}\n", info.api);
    fmt::print("subgroup   {}\n", info.subgroupSize);
    fmt::print("timestamps {}\n",
               info.nanosecondsPerTick > 0 ? fmt::format("{} ns", info.nanosecondsPerTick) : "none: passes show no times");
    fmt::print("missing    {}\n", info.missingOptional.empty() ? "nothing" : fmt::format("{}", fmt::join(info.missingOptional, ", ")));
    fmt::print("occlusion  {}\n", info.rayQuery
                                      ? "ray-query: the device has ray queries in shaders"
                                      : "compute-bvh, whatever occlusion.backend asks for: the device has no ray queries in shaders");
    const render::Knobs knobs = render::defaultKnobs(deviceClassOf(info));
    fmt::print("defaults   for a {}:\n", info.isCpu ? "CPU" : "GPU");
    for (const render::KnobDescription& knob : render::knobTable())
        fmt::print("  {:<22} {}\n", knob.key, render::get(knobs, knob.key));
    return ExitCode::Done;
}

ExitCode runInspect(const InspectOptions& options)
{
    fmt::print("{}", scene::inspect(options.file));
    return ExitCode::Done;
}

ExitCode runGraph(const GraphOptions& options)
{
    gpu::Device device({});
    const Stage stage(findScene(options.scene, options.settings), 0, noGameplay, options.settings);
    render::Renderer renderer(device, stage.assets(), uvec2(640, 360));
    render::FrameView view;
    stage.extract(view);
    view.knobs = render::resolveKnobs(deviceClassOf(device.info()), stage.settings(), options.settings);
    renderer.render(view);
    device.waitIdle();
    const bool isDot = options.output.extension() == ".dot";
    writeText(options.output,
              isDot ? graph::toDot(renderer.frameGraph(), renderer.plan()) : graph::toJson(renderer.frameGraph(), renderer.plan()));
    return ExitCode::Done;
}

} // namespace antumbra::app
