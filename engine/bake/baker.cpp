#include "bake/baker.h"

#include "bake/bake_run.h"
#include "bake/settings.h"

#include <fmt/format.h>

namespace antumbra::bake {

namespace {

Pass passOver(std::string stage, const BakeSettings& settings, Transfers& result, std::function<void(Range)> gather)
{
    return {.stage = std::move(stage),
            .units = static_cast<uint32_t>(result.isValid.size()),
            .raysPerUnit = settings.raysPerTexel,
            .values = &result.values,
            .flags = &result.isValid,
            .gather = std::move(gather)};
}

Pass passOver(std::string stage, const BakeSettings& settings, CellLight& result, std::function<void(Range)> gather)
{
    return {.stage = std::move(stage),
            .units = static_cast<uint32_t>(result.isOpen.size()),
            .raysPerUnit = settings.raysPerCell,
            .values = &result.values,
            .flags = &result.isOpen,
            .gather = std::move(gather)};
}

void add(Transfers& sum, const Transfers& bounce)
{
    for (size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] += bounce.values[i];
    sum.isValid = bounce.isValid;
}

} // namespace

std::optional<Bake> bakeScene(const StaticScene& scene, const BakeSettings& settings, const BakeJob& job)
{
    const TexelMap map = mapTexels(scene, kPointsPerTexel);
    const RayScene rays(scene);
    const Grid grid = gridOver(scene.bounds(), settings.cellMetres);
    Bake bake{.settings = settings, .sceneHash = hashOf(scene), .atlas = {}, .volume = {}};
    BakeRun run(job, bake.sceneHash, settings, rayCount(settings, map.texelCount(), grid.cellCount()));

    Transfers last = noTransfers(map, settings); // what the last bounce added
    const auto direct = [&](Range range) { gatherDirect(rays, map, settings, range, last); };
    if (!run.finish(passOver("direct light", settings, last, direct)))
        return std::nullopt;

    Transfers lit = noTransfers(map, settings); // all before it: by what surfaces shine
    for (uint32_t bounce = 1; bounce <= settings.bounces; ++bounce) {
        add(lit, last);
        Transfers next = noTransfers(map, settings);
        const auto reflected = [&](Range range) { gatherBounce(rays, map, settings, last, range, next); };
        if (!run.finish(passOver(fmt::format("bounce {}", bounce), settings, next, reflected)))
            return std::nullopt;
        last = std::move(next);
    }

    CellLight light = noCellLight(grid, settings);
    const auto incident = [&](Range range) { gatherCells(rays, map, settings, lit, grid, range, light); };
    if (!run.finish(passOver("volume", settings, light, incident)))
        return std::nullopt;

    add(lit, last);
    bake.atlas = packed(lit, map, scene);
    bake.volume = packed(light, grid);
    return bake;
}

} // namespace antumbra::bake
