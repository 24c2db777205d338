#include "tools/lab/bake_share.h"

#include "bake/texel_rays.h"
#include "tools/lab/embree_alone.h"
#include "tools/lab/stopwatch.h"

#include <algorithm>

namespace antumbra::lab {

namespace {

using bake::Range;

constexpr uint32_t kPlaces = 16;          // spread over the page, and over the grid
constexpr uint32_t kTexelsPerPlace = 128; // about as many as the baker deals out at a time
constexpr uint32_t kCellsPerPlace = 16;
constexpr size_t kPacketsAtATime = 256; // stay in a cache

/// Transfers such that bounces have something to read everywhere.
bake::Transfers allLit(const bake::TexelMap& map, const bake::BakeSettings& settings)
{
    bake::Transfers lit = noTransfers(map, settings);
    std::ranges::fill(lit.values, vec3(0.1f));
    std::ranges::fill(lit.isValid, uint8_t{1});
    return lit;
}

/// Some of `all`, at most `count` a place, none twice.
std::vector<Range> spread(uint32_t all, uint32_t count)
{
    std::vector<Range> ranges;
    for (uint32_t place = 0; place < kPlaces; ++place) {
        const auto first = static_cast<uint32_t>(uint64_t{all} * place / kPlaces);
        const auto next = static_cast<uint32_t>(uint64_t{all} * (place + 1) / kPlaces);
        ranges.push_back({first, std::min(count, next - first)});
    }
    return ranges;
}

/// How often what was measured goes into all.
double timesIn(uint32_t all, const std::vector<Range>& ranges)
{
    uint32_t measured = 0;
    for (const Range range : ranges)
        measured += range.count;
    return static_cast<double>(all) / std::max(measured, 1u);
}

class ShareBench
{
public:
    ShareBench(const bake::StaticScene& surfaces, const bake::Grid& grid, const bake::BakeSettings& settings)
        : grid_(grid), settings_(settings), map_(mapTexels(surfaces, bake::kPointsPerTexel)), rays_(surfaces), alone_(surfaces),
          texelRays_(surfaces, map_, settings.raysPerTexel), lit_(allLit(map_, settings)), gathered_(lit_)
    {
    }

    BakeShare measure()
    {
        const std::vector<Range> texels = spread(map_.texelCount(), kTexelsPerPlace), cells = spread(grid_.cellCount(), kCellsPerPlace);
        for (const Range range : texels)
            measureTexels(range);
        for (const Range range : cells)
            measureCells(range);
        const double passes = timesIn(map_.texelCount(), texels), volumes = timesIn(grid_.cellCount(), cells);
        for (double Paired::*time : {&Paired::bakerMilliseconds, &Paired::aloneMilliseconds})
            share_.all.*time = passes * (share_.direct.*time + settings_.bounces * (share_.bounce.*time)) + volumes * (share_.volume.*time);
        share_.texels = map_.texelCount();
        return share_;
    }

private:
    void measureTexels(Range range)
    {
        share_.direct.bakerMilliseconds += millisecondsOf([&] { gatherDirect(rays_, map_, settings_, range, gathered_); });
        share_.direct.aloneMilliseconds += traceTexels(range);
        share_.bounce.bakerMilliseconds += millisecondsOf([&] { gatherBounce(rays_, map_, settings_, lit_, range, gathered_); });
        share_.bounce.aloneMilliseconds += traceTexels(range);
    }

    double traceTexels(Range range)
    {
        double milliseconds = 0;
        for (uint32_t texel = range.first; texel < range.first + range.count; ++texel)
            for (uint32_t point = 0; point < texelRays_.pointCount(texel); ++point)
                texelRays_.forEach(texel, point, [&](vec3 origin, const bake::DirectionPacket& directions, bake::LaneMask above) {
                    alone_.add(origin, directions, above);
                    milliseconds += alone_.traceAfter(kPacketsAtATime);
                });
        return milliseconds + alone_.trace();
    }

    void measureCells(Range range)
    {
        share_.volume.bakerMilliseconds += millisecondsOf([&] { gatherCells(rays_, map_, settings_, lit_, grid_, range, light_); });
        for (uint32_t cell = range.first; cell < range.first + range.count; ++cell)
            for (const bake::DirectionPacket& local : sphere_) {
                bake::DirectionPacket directions;
                rotate(bake::rotationOf(bake::scrambled(cell)), local, directions);
                alone_.add(grid_.position(cell), directions, bake::kAllLanes);
                share_.volume.aloneMilliseconds += alone_.traceAfter(kPacketsAtATime);
            }
        share_.volume.aloneMilliseconds += alone_.trace();
    }

    const bake::Grid& grid_;
    const bake::BakeSettings& settings_;
    bake::TexelMap map_;
    bake::RayScene rays_;
    EmbreeAlone alone_;
    bake::TexelRays texelRays_;
    bake::Transfers lit_, gathered_;
    bake::CellLight light_ = noCellLight(grid_, settings_);
    std::vector<bake::DirectionPacket> sphere_ = bake::sphereDirections((settings_.raysPerCell + bake::kLanes - 1) / bake::kLanes);
    BakeShare share_;
};

} // namespace

BakeShare measureShare(const bake::StaticScene& surfaces, const bake::Grid& grid, const bake::BakeSettings& settings)
{
    return ShareBench(surfaces, grid, settings).measure();
}

} // namespace antumbra::lab
