#include "render/shadow/prt.h"

#include "base/check.h"

#include <array>

namespace antumbra::render {

namespace {

using graph::Use;

constexpr uint32_t kRows = bake::kLocalCoefficients;
static_assert(kRows == shader::kLocalShCoefficients);
constexpr uint32_t kRowThreads = shader::kFifthBand + (kRows - shader::kFifthBand) / 3;

void checkWhole(const bake::Bake& bake)
{
    const uint32_t coefficients = bake.settings.coefficientCount();
    const auto& [extent, transfers] = bake.atlas;
    check(extent.x > 0 && extent.y > 0 && extent.x % 2 == 0, "an atlas of pairs of texels");
    check(transfers.size() == size_t{extent.x} * extent.y * coefficients * 3, "a transfer vector a texel");
    const size_t cells = bake.volume.grid.cellCount();
    check(cells > 0 && bake.volume.isOpen.size() == cells, "a volume whose every cell is open or closed");
    check(bake.volume.planes.size() == cells * kRows * coefficients * 3, "a matrix a cell");
}

/// Zero where the cell is closed, so that no light of it is ever seen.
std::vector<uint16_t> openMatrices(const bake::IrradianceVolume& volume)
{
    std::vector<uint16_t> planes = volume.planes;
    for (size_t i = 0; i < planes.size(); ++i)
        if (volume.isOpen[i % volume.isOpen.size()] == 0)
            planes[i] = 0;
    return planes;
}

/// In the dark.
std::vector<shader::CellBlock> cellsOf(const bake::IrradianceVolume& volume)
{
    std::vector<shader::CellBlock> cells(volume.isOpen.size());
    for (size_t i = 0; i < cells.size(); ++i)
        cells[i].radiance[0].y = volume.isOpen[i] != 0 ? shader::kCellIsOpen : 0;
    return cells;
}

template <class T>
gpu::Buffer upload(gpu::Device& device, std::string_view label, const std::vector<T>& values)
{
    return gpu::uploadedBuffer(device, label, std::span<const T>(values));
}

} // namespace

PrtSystem::OnDevice PrtSystem::made(const bake::Bake& bake) const
{
    checkWhole(bake);
    return {.bake = &bake,
            .prtRelight = computePipeline(*device_, "prt_relight.comp"),
            .volumeRelight = computePipeline(*device_, "volume_relight.comp"),
            .transfers = upload(*device_, "transfers", bake.atlas.planes),
            .texels = gpu::Buffer(*device_, "baked texels", size_t{bake.atlas.extent.x} * bake.atlas.extent.y * sizeof(uvec2)),
            .matrices = upload(*device_, "cell matrices", openMatrices(bake.volume)),
            .cells = upload(*device_, "cells", cellsOf(bake.volume)),
            .litBy = {}};
}

shader::BakedLight PrtSystem::prepare(const bake::Bake* bake)
{
    if (held_ && held_->bake != bake)
        held_.reset();
    if (bake == nullptr)
        return {};
    if (!held_)
        held_.emplace(made(*bake));
    const bake::Grid& grid = bake->volume.grid;
    return {.texels = held_->texels.address(),
            .cells = held_->cells.address(),
            .origin = grid.origin,
            .cellsPerMetre = 1.0f / grid.spacing,
            .lastCell = ivec3(grid.count) - 1,
            .lastTexel = ivec2(bake->atlas.extent) - 1};
}

void PrtSystem::declareAtlas(graph::FrameGraph& graph, uint32_t frame, Baked& baked) const
{
    graph::Pass pass = graph.add("prt relight");
    baked.texels = pass.write(baked.texels, Use::StorageWrite);
    pass.record([this, frame, lit = baked.texels](graph::Recorder& recorder) {
        const uvec2 extent = held_->bake->atlas.extent, wordCount{extent.x / 2, extent.y};
        recorder.dispatch(held_->prtRelight,
                          shader::PrtRelight{.transfers = held_->transfers.address(),
                                             .texels = recorder.address(lit),
                                             .frame = frame,
                                             .coefficientCount = held_->bake->settings.coefficientCount(),
                                             .wordCount = wordCount},
                          wordCount, {64, 1});
    });
}

void PrtSystem::declareVolume(graph::FrameGraph& graph, uint32_t frame, Baked& baked) const
{
    graph::Pass pass = graph.add("volume relight");
    baked.cells = pass.write(baked.cells, Use::StorageWrite);
    pass.record([this, frame, lit = baked.cells](graph::Recorder& recorder) {
        const uint32_t cellCount = held_->bake->volume.grid.cellCount();
        recorder.dispatch(held_->volumeRelight,
                          shader::VolumeRelight{.matrices = held_->matrices.address(),
                                                .cells = recorder.address(lit),
                                                .frame = frame,
                                                .coefficientCount = held_->bake->settings.coefficientCount(),
                                                .cellCount = cellCount},
                          {cellCount, kRowThreads}, {64, 1});
    });
}

Baked PrtSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const shader::FrameBlock& light)
{
    const auto skip = [&](std::string_view reason) {
        for (const std::string_view pass : {"prt relight", "volume relight"})
            graph.skip(pass, reason);
    };
    if (!held_) {
        skip(view.bake != nullptr ? "prt.bake is off" : "no StaticPRT with a bake");
        return {};
    }
    Baked baked{.texels = graph.importBuffer("baked texels", held_->texels.bytes(), graph::importedBuffer(held_->texels)),
                .cells = graph.importBuffer("cells", held_->cells.bytes(), graph::importedBuffer(held_->cells))};
    const auto radiance = std::to_array(light.radianceSh);
    if (held_->litBy == radiance) {
        skip("the light did not change");
        return baked;
    }
    held_->litBy = radiance;
    declareAtlas(graph, frame, baked);
    declareVolume(graph, frame, baked);
    graph.output(baked.texels); // for the frames that follow, whoever looks at them
    graph.output(baked.cells);
    return baked;
}

} // namespace antumbra::render
