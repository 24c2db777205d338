// What the passes that find a frame's area light share. Owns nothing.
#pragma once

#include "render/gbuffer.h"

namespace antumbra::render {

/// How many pixels are lit, and which.
struct LitPixels
{
    uvec2 extent{0};
    uint32_t scale = 1; // pixels of the G-buffer along one of theirs

    [[nodiscard]] size_t count() const { return size_t{extent.x} * extent.y; }
};

/// Lights that are shadowed alike stand together.
struct AreaLightRange
{
    scene::LightShadow shadow = scene::LightShadow::Analytic;
    uint32_t first = 0; // parts of lights, as AreaBlock::lights counts them
    uint32_t end = 0;

    [[nodiscard]] uint32_t count() const { return end - first; }
};

struct LitFrame
{
    const FrameView* view;
    const GpuScene* scene;
    const GBuffer* g;
    const Posed* posed;
    const FieldFrame* fields;
    VkDeviceAddress area; // AreaBlock
    LitPixels pixels;
    uint32_t slot; // of the FrameBlock
    bool isGlossy;
};

} // namespace antumbra::render
