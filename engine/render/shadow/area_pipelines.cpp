#include "render/shadow/area_pipelines.h"

#include "render/gpu_scene.h"

#include <algorithm>
#include <bit>

namespace antumbra::render {

namespace {

using scene::LightShadow;

constexpr uint32_t kOccludersALight = 8;  // of a pixel in closed form; and as many of them may overlap
constexpr uint32_t kTrianglesALight = 64; // of a pixel, where bodies are taken as these
constexpr uint32_t kTriangleEdges = 4;    // one is made where the light's plane cuts it
constexpr uint32_t kCutsAPolygon = 12;    // corners that it may gain
constexpr uint32_t kMostPolygonCorners = 64;
constexpr uint32_t kMostSilhouetteEdges = 64;

int shaderShadowOf(LightShadow shadow)
{
    return static_cast<int>(traces(shadow)                                   ? shader::kAreaTraced
                            : shadow == LightShadow::None || isShare(shadow) ? shader::kAreaUnshadowed
                                                                             : shader::kAreaAnalytic);
}

/// Few different sizes, so that few pipelines are made as lights come and go.
AreaSizes rounded(const AreaSizes& sizes)
{
    return {.isPlanar = sizes.isPlanar,
            .outlineCorners = std::min(std::bit_ceil(sizes.outlineCorners + kCutsAPolygon), kMostPolygonCorners) - kCutsAPolygon,
            .faceCorners = 4,
            .lightVertices = std::bit_ceil(sizes.lightVertices),
            .silhouetteEdges = std::min(std::bit_ceil(sizes.silhouetteEdges), kMostSilhouetteEdges),
            .faces = (sizes.faces + 31) / 32 * 32};
}

/// What is asked for where one face of a light is seen past one triangle after another.
AreaSizes ofTriangles(const AreaSizes& sizes)
{
    return {.outlineCorners = sizes.faceCorners, .silhouetteEdges = kTriangleEdges, .faces = sizes.faces};
}

std::vector<gpu::ShaderDefine> sizeDefines(const AreaSizes& sizes, uint32_t occluders)
{
    const auto polygonCorners = static_cast<int>(sizes.outlineCorners + kCutsAPolygon);
    const auto edges = static_cast<int>(sizes.silhouetteEdges);
    return {{"POLYGON_PLACES", static_cast<int>(kOccludersALight) + 6},
            {"POLYGON_CORNERS", polygonCorners},
            {"SILHOUETTE_EDGES", edges * static_cast<int>(occluders)},
            {"SILHOUETTE_BODY_EDGES", edges},
            {"FACE_WORDS", static_cast<int>(sizes.faces / 32)},
            {"OUTLINE_CORNERS", static_cast<int>(sizes.outlineCorners)},
            {"LIGHT_VERTICES", static_cast<int>(sizes.lightVertices)},
            {"AREA_OCCLUDERS", static_cast<int>(occluders)},
            {"AREA_SIGNED", static_cast<int>(occluders)}};
}

} // namespace

bool traces(LightShadow shadow) { return shadow == LightShadow::Traced || shadow == LightShadow::Reference; }

bool isShare(LightShadow shadow)
{
    return shadow == LightShadow::Ratio || shadow == LightShadow::Article || shadow == LightShadow::TwoSided;
}

const gpu::Pipeline& AreaPipelines::shade(const Variant& variant)
{
    const int shadow = shaderShadowOf(variant.shadow);
    const bool hasTriangles = variant.shadow == LightShadow::Triangles, isReference = variant.shadow == LightShadow::Reference;
    const AreaSizes sizes = rounded(traces(variant.shadow) ? AreaSizes{} : hasTriangles ? ofTriangles(variant.sizes) : variant.sizes);
    const auto found = std::ranges::find_if(made_, [&](const Made& made) {
        return made.shadow == shadow && made.isReference == isReference && made.hasTriangles == hasTriangles &&
               made.isGlossy == variant.isGlossy && made.hasFields == variant.hasFields && made.backend == variant.backend &&
               made.sizes == sizes;
    });
    if (found != made_.end())
        return found->pipeline;
    std::vector<gpu::ShaderDefine> defines = sizeDefines(sizes, hasTriangles ? kTrianglesALight : kOccludersALight);
    defines.push_back({"SHADOW", shadow});
    const std::pair<bool, std::string_view> parts[] = {
        {sizes.isPlanar, "PLANAR_LIGHTS"}, {variant.isGlossy, "GLOSSY"}, {hasTriangles, "TRIANGLES"},
        {variant.hasFields, "FIELDS"},     {isReference, "REFERENCE"},   {variant.backend == RayBackend::ComputeBvh, "COMPUTE_BVH"}};
    for (const auto& [isPart, define] : parts)
        if (isPart)
            defines.push_back({define});
    made_.push_back({shadow, isReference, hasTriangles, variant.isGlossy, variant.hasFields, variant.backend, sizes,
                     computePipeline(*device_, "area_shade.comp", defines)});
    return made_.back().pipeline;
}

} // namespace antumbra::render
