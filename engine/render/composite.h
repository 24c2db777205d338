// From the G-buffer and what hides its light to the picture: first term minus occluded irradiance, tone mapping (Khronos PBR Neutral,
// sRGB), the environment behind it all, and the views that explain it.
#pragma once

#include "render/shadow/area_light.h"
#include "render/shadow/occlusion.h"

#include <array>

namespace antumbra::render {

/// What is to be kept beside the picture.
struct Kept
{
    bool color = false, irradiance = false, occluded = false;

    [[nodiscard]] bool any() const { return color || irradiance || occluded; }
};

struct Composed
{
    graph::ImageRef picture;
    graph::ImageRef color;      // W/(m^2 sr); these three absent unless kept
    graph::ImageRef irradiance; // W/m^2
    graph::ImageRef occluded;   // W/m^2; a: cones
};

class CompositeSystem
{
public:
    explicit CompositeSystem(gpu::Device& device) : device_(&device) {}

    /// Writes `picture`. `traced`, `reference` and `lit` may be absent.
    Composed declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const GBuffer& g,
                     const Traced& traced, graph::ImageRef reference, const AreaLit& lit, graph::ImageRef picture, Kept kept,
                     graph::BufferRef& counters);

private:
    /// What a composition is made for.
    struct Variant
    {
        bool isOccluded, explains, isLit, isGlossy, isUpsampled, isDark;
        [[nodiscard]] size_t index() const
        {
            return isOccluded + 2u * explains + 4u * isLit + 8u * isGlossy + 16u * isUpsampled + 32u * isDark;
        }
    };

    const gpu::Pipeline& composition(Variant variant);
    /// Area light for the pixels that are traced, or for all.
    AreaLit litWhereTraced(graph::FrameGraph& graph, uint32_t frame, const GBuffer& g, const Traced& traced, const AreaLit& found);
    const gpu::Pipeline& sky(bool keepsColor);
    const gpu::Pipeline& lightBody(bool keepsColor);
    void declareSky(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, graph::ImageRef depth, Composed& composed);
    void listLightBodies(const FrameView& view);
    void declareLightBodies(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, graph::ImageRef depth,
                            Composed& composed);

    struct LightBody
    {
        float distance; // metres, of its middle from the eye
        uint32_t light; // into FrameView::areaLights
    };

    gpu::Device* device_;
    std::array<gpu::Pipeline, 64> compositions_; // each made when first asked for
    std::array<gpu::Pipeline, 2> upsamples_;     // by whether glossy
    std::array<gpu::Pipeline, 2> skies_, lightBodies_;
    std::vector<LightBody> farthestFirst_; // of the frame that is declared
};

} // namespace antumbra::render
