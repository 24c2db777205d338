#include "render/shadow/occlusion_pipelines.h"

#include "render/gpu_scene.h"

namespace antumbra::render {

const gpu::Pipeline& OcclusionPipelines::of(const Variant& variant, const FieldFrame& fields)
{
    FieldShader shader{.file = "occlusion_trace.comp"};
    shader.define("CULLING", static_cast<int>(variant.culling));
    const std::pair<bool, std::string_view> parts[] = {{variant.isReference, "REFERENCE"},
                                                       {variant.isLocal, "LOCAL_LIGHT"},
                                                       {variant.backend == RayBackend::ComputeBvh, "COMPUTE_BVH"},
                                                       {static_cast<bool>(fields), "FIELDS"}};
    for (const auto& [isPart, define] : parts)
        if (isPart)
            shader.define(define);
    if (fields)
        return fields.pipelines->of(shader, fields.structure);
    const auto found = std::ranges::find(made_, variant, &Made::variant);
    if (found != made_.end())
        return found->pipeline;
    made_.push_back({variant, computePipeline(*device_, shader.file, shader.defined())});
    return made_.back().pipeline;
}

} // namespace antumbra::render
