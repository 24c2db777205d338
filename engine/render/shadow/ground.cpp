#include "render/shadow/ground.h"

namespace antumbra::render {

namespace {

using graph::Use;

constexpr std::string_view kPass = "ground shadow";

} // namespace

const gpu::Pipeline& GroundSystem::pipeline(RayBackend backend)
{
    const bool usesBvh = backend == RayBackend::ComputeBvh;
    gpu::Pipeline& shadow = shadow_[usesBvh ? 1 : 0];
    if (!shadow) {
        constexpr gpu::ShaderDefine bvh{"COMPUTE_BVH"};
        shadow = computePipeline(*device_, "ground_shadow.comp", usesBvh ? std::span(&bvh, 1) : std::span<const gpu::ShaderDefine>{});
    }
    return shadow;
}

Grounds GroundSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const Baked& baked,
                              const Posed& posed)
{
    const bool bounces = baked && view.bake->settings.bounces > 0;
    if (!bounces || !posed.bounds) {
        graph.skip(kPass, !baked     ? "no baked light is shown"
                          : !bounces ? "no light bounces in the bake"
                                     : "no DynamicSkinned in the scene");
        return {};
    }
    const auto count = static_cast<uint32_t>(view.characters.size());
    graph::Pass pass = graph.add(kPass);
    pass.read(posed.scene, posed.sceneUse);
    pass.read(posed.bounds, Use::StorageRead);
    pass.read(baked.cells, Use::StorageRead);
    const graph::BufferRef blocks = pass.createBuffer("grounds", count * sizeof(shader::GroundBlock), Use::StorageWrite);
    pass.record([&shadow = pipeline(scene.backend()), &scene, frame, blocks, count](graph::Recorder& recorder) {
        recorder.dispatch(shadow,
                          shader::GroundDispatch{.scene = scene.tracedAddress(),
                                                 .blockers = scene.blockers().address(),
                                                 .grounds = recorder.address(blocks),
                                                 .frame = frame,
                                                 .padding = 0},
                          {count, 1}, {1, 1});
    });
    return {blocks, count};
}

} // namespace antumbra::render
