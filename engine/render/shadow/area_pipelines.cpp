#include "render/shadow/area_pipelines.h"

#include "render/gpu_scene.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace antumbra::render {

namespace {

using scene::LightShadow;

constexpr uint32_t kOccludersALight = 8;  // of a pixel in closed form; and as many of them may overlap
constexpr uint32_t kTrianglesALight = 64; // of a pixel, where bodies are taken as these
constexpr uint32_t kTriangleEdges = 4;    // one is made where the light's plane cuts it
constexpr uint32_t kCutsAPolygon = 12;    // corners that it may gain
constexpr uint32_t kMostPolygonCorners = 64;
constexpr uint32_t kMostSilhouetteEdges = 64;
// Driver 580.159.04 of NVIDIA compiled threads with 13 KiB of arrays and refused some with 17; the end lies between.
constexpr uint32_t kMostThreadBytes = 14336;

int shaderShadowOf(LightShadow shadow)
{
    return static_cast<int>(traces(shadow)                                   ? shader::kAreaTraced
                            : shadow == LightShadow::None || isShare(shadow) ? shader::kAreaUnshadowed
                                                                             : shader::kAreaAnalytic);
}

/// What is asked for where occluders are seen whole.
AreaSizes ofBodies(AreaSizes sizes)
{
    sizes.occluders = std::min(sizes.occluders, kOccludersALight);
    return sizes;
}

/// What is asked for where one face of a light is seen past one triangle after another.
AreaSizes ofTriangles(const AreaSizes& sizes)
{
    return {.outlineCorners = sizes.faceCorners, .silhouetteEdges = kTriangleEdges, .faces = sizes.faces, .occluders = kTrianglesALight};
}

uint32_t roundedUp(uint32_t count, uint32_t step) { return (count + step - 1) / step * step; }
uint32_t polygonCornersOf(const AreaSizes& sizes) { return sizes.outlineCorners + kCutsAPolygon; }
/// One a body that overlaps others, and what is scratch.
uint32_t polygonPlacesOf(const AreaSizes& sizes) { return std::min(sizes.occluders, kOccludersALight) + 6; }

/// Few different sizes, so that few pipelines are made as lights come and go.
AreaSizes rounded(const AreaSizes& sizes)
{
    return {.isPlanar = sizes.isPlanar,
            .outlineCorners = std::min(roundedUp(sizes.outlineCorners + kCutsAPolygon, 8), kMostPolygonCorners) - kCutsAPolygon,
            .faceCorners = 4,
            .lightVertices = std::bit_ceil(sizes.lightVertices),
            .silhouetteEdges = std::min(roundedUp(sizes.silhouetteEdges, 4), kMostSilhouetteEdges),
            .faces = roundedUp(sizes.faces, 32),
            .occluders = std::bit_ceil(sizes.occluders)};
}

std::vector<gpu::ShaderDefine> sizeDefines(const AreaSizes& sizes)
{
    const auto edges = static_cast<int>(sizes.silhouetteEdges), occluders = static_cast<int>(sizes.occluders);
    return {{"POLYGON_PLACES", static_cast<int>(polygonPlacesOf(sizes))},
            {"POLYGON_CORNERS", static_cast<int>(polygonCornersOf(sizes))},
            {"SILHOUETTE_EDGES", edges * occluders},
            {"SILHOUETTE_BODY_EDGES", edges},
            {"FACE_WORDS", static_cast<int>(sizes.faces / 32)},
            {"OUTLINE_CORNERS", static_cast<int>(sizes.outlineCorners)},
            {"LIGHT_VERTICES", static_cast<int>(sizes.lightVertices)},
            {"AREA_OCCLUDERS", occluders},
            {"AREA_SIGNED", occluders}};
}

/// Of rays, which know no sizes.
const gpu::Pipeline& throughFields(const AreaPipelines::Variant& variant, const FieldFrame& fields)
{
    FieldShader shader{.file = "area_shade.comp"};
    shader.define("SHADOW", shaderShadowOf(variant.shadow));
    shader.define("FIELDS");
    if (variant.isGlossy)
        shader.define("GLOSSY");
    if (variant.shadow == LightShadow::Reference)
        shader.define("REFERENCE");
    if (variant.backend == RayBackend::ComputeBvh)
        shader.define("COMPUTE_BVH");
    return fields.pipelines->of(shader, fields.structure);
}

} // namespace

uint32_t threadBytes(const AreaSizes& sizes)
{
    const uint32_t corners = polygonPlacesOf(sizes) * polygonCornersOf(sizes), edges = sizes.occluders * sizes.silhouetteEdges;
    const uint32_t vectors = corners + 4 * edges + 2 * sizes.silhouetteEdges + 2 * sizes.outlineCorners;
    return vectors * static_cast<uint32_t>(sizeof(vec4)) + 4 * (2 * sizes.lightVertices + 2 * sizes.faces / 32 + 2 * sizes.occluders + 64);
}

AreaSizes roomFor(const AreaSizes& asked, uint32_t mostBytes)
{
    AreaSizes sizes = rounded(asked);
    while (threadBytes(sizes) > mostBytes && sizes.occluders > 1)
        --sizes.occluders;
    return sizes;
}

bool traces(LightShadow shadow) { return shadow == LightShadow::Traced || shadow == LightShadow::Reference; }

bool isShare(LightShadow shadow)
{
    return shadow == LightShadow::Ratio || shadow == LightShadow::Article || shadow == LightShadow::TwoSided;
}

const gpu::Pipeline& AreaPipelines::shade(const Variant& variant, const FieldFrame& fields)
{
    if (traces(variant.shadow) && fields)
        return throughFields(variant, fields);
    const int shadow = shaderShadowOf(variant.shadow);
    const bool hasTriangles = variant.shadow == LightShadow::Triangles, isReference = variant.shadow == LightShadow::Reference;
    const AreaSizes sizes = roomFor(traces(variant.shadow) ? AreaSizes{}
                                    : hasTriangles         ? ofTriangles(variant.sizes)
                                                           : ofBodies(variant.sizes),
                                    device_->info().isCpu ? std::numeric_limits<uint32_t>::max() : kMostThreadBytes);
    const auto found = std::ranges::find_if(made_, [&](const Made& made) {
        return made.shadow == shadow && made.isReference == isReference && made.hasTriangles == hasTriangles &&
               made.isGlossy == variant.isGlossy && made.backend == variant.backend && made.sizes == sizes;
    });
    if (found != made_.end())
        return found->pipeline;
    std::vector<gpu::ShaderDefine> defines = sizeDefines(sizes);
    defines.push_back({"SHADOW", shadow});
    const std::pair<bool, std::string_view> parts[] = {{sizes.isPlanar, "PLANAR_LIGHTS"},
                                                       {variant.isGlossy, "GLOSSY"},
                                                       {hasTriangles, "TRIANGLES"},
                                                       {isReference, "REFERENCE"},
                                                       {variant.backend == RayBackend::ComputeBvh, "COMPUTE_BVH"}};
    for (const auto& [isPart, define] : parts)
        if (isPart)
            defines.push_back({define});
    made_.push_back({shadow, isReference, hasTriangles, variant.isGlossy, variant.backend, sizes,
                     computePipeline(*device_, "area_shade.comp", defines)});
    return made_.back().pipeline;
}

} // namespace antumbra::render
