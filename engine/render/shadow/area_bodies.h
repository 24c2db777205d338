// The area lights of a frame and what stands before them, in the world, on their way to the device. Sees no pixels.
#pragma once

#include "gpu/device.h"
#include "render/body_blocks.h"
#include "render/shadow/lit_frame.h"
#include "scene/assets.h"

namespace antumbra::render {

/// What the largest of a frame's bodies ask of a shader: it is compiled for that, so that nobody pays for more.
struct AreaSizes
{
    bool isPlanar = true;         // every light is
    uint32_t outlineCorners = 4;  // of a light seen from a point
    uint32_t faceCorners = 4;     // of a light's face
    uint32_t lightVertices = 4;   // of a light's body
    uint32_t silhouetteEdges = 4; // of one occluder seen from a point
    uint32_t faces = 1;           // of a body
    uint32_t occluders = 1;       // that may stand before a light

    friend bool operator==(const AreaSizes&, const AreaSizes&) = default;
};

class AreaBodies
{
public:
    explicit AreaBodies(gpu::Device& device, const scene::Assets& assets) : device_(&device), assets_(&assets) {}

    /// Between Device::beginFrame and endFrame. `fields` is the address of a FieldsBlock, or null. Returns that of the frame's AreaBlock.
    /// Keeps its memory.
    VkDeviceAddress write(const FrameView& view, uint32_t tilesAcross, VkDeviceAddress fields);

    [[nodiscard]] std::span<const AreaLightRange> ranges() const { return ranges_; }
    [[nodiscard]] const AreaSizes& sizes() const { return sizes_; }
    [[nodiscard]] uint32_t lightCount() const { return static_cast<uint32_t>(lights_.size()); }
    [[nodiscard]] uint32_t occluderCount() const { return static_cast<uint32_t>(owners_.size()); }

private:
    void addLights(const FrameView& view);
    void addOccluders(const FrameView& view);

    gpu::Device* device_;
    const scene::Assets* assets_;
    BodyBlocks bodies_;
    std::vector<shader::AreaLightBlock> lights_;
    std::vector<uint32_t> owners_;
    std::vector<AreaLightRange> ranges_;
    AreaSizes sizes_;
};

} // namespace antumbra::render
