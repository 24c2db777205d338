#include "render/shadow/area_bodies.h"

#include "render/frame_copy.h"

#include <array>

namespace antumbra::render {

namespace {

using scene::LightShadow;

void grow(uint32_t& size, size_t wanted) { size = std::max(size, static_cast<uint32_t>(wanted)); }

uint32_t flagsOf(const scene::BodyPart& part)
{
    const bool isSkin = part.isHollow && part.joint != scene::kNoIndex;
    return (part.isHollow ? shader::kBodyHollow : 0u) | (isSkin ? shader::kBodySkin : 0u);
}

} // namespace

void AreaBodies::addLights(const FrameView& view)
{
    // The reference first: what others add is not to be part of its mean.
    constexpr std::array kOrder{LightShadow::Reference, LightShadow::Analytic, LightShadow::Triangles, LightShadow::None,
                                LightShadow::Traced,    LightShadow::Ratio,    LightShadow::Article,   LightShadow::TwoSided};
    for (const LightShadow shadow : kOrder) {
        const uint32_t first = lightCount();
        for (uint32_t index = 0; index < view.areaLights.size(); ++index) {
            const AreaLightDraw& light = view.areaLights[index];
            if (view.shadowOf(light) != shadow)
                continue;
            for (uint32_t part = light.firstPart; part < light.firstPart + light.partCount; ++part) {
                const scene::ConvexBody& body = assets_->bodyParts[part].body;
                const uint32_t flags = (light.isTwoSided ? shader::kBodyTwoSided : 0u) | (light.isSphere ? shader::kBodySphere : 0u);
                lights_.push_back({light.radiance, bodies_.add(body, light.world, flags), index});
                sizes_.isPlanar = sizes_.isPlanar && body.isPlanar;
                grow(sizes_.outlineCorners, body.isPlanar ? body.corners.size() : body.vertices.size());
                for (const scene::ConvexBody::Face& face : body.faces)
                    grow(sizes_.faceCorners, face.cornerCount);
                grow(sizes_.lightVertices, body.vertices.size());
                grow(sizes_.faces, body.faces.size());
            }
        }
        if (lightCount() > first)
            ranges_.push_back({shadow, first, lightCount()});
    }
}

void AreaBodies::addOccluders(const FrameView& view)
{
    for (const OccluderDraw& occluder : view.occluders) {
        const scene::BodyPart& part = assets_->bodyParts[occluder.part];
        bodies_.add(part.body, occluder.world, flagsOf(part), part.margin);
        owners_.push_back(occluder.light);
        // No vertex is twice on a silhouette; a plane that cuts the body adds an edge.
        grow(sizes_.silhouetteEdges, part.body.vertices.size() + 1);
        grow(sizes_.faces, part.body.faces.size());
    }
    grow(sizes_.occluders, owners_.size());
}

VkDeviceAddress AreaBodies::write(const FrameView& view, uint32_t tilesAcross, VkDeviceAddress fields)
{
    bodies_.clear();
    lights_.clear();
    owners_.clear();
    ranges_.clear();
    sizes_ = {};
    addLights(view);
    const auto firstOccluder = static_cast<uint32_t>(bodies_.bodies.size());
    addOccluders(view);
    const shader::AreaBlock block{.arrays = {.bodies = frameCopy(*device_, bodies_.bodies),
                                             .vertices = frameCopy(*device_, bodies_.vertices),
                                             .faces = frameCopy(*device_, bodies_.faces),
                                             .corners = frameCopy(*device_, bodies_.corners),
                                             .edges = frameCopy(*device_, bodies_.edges)},
                                  .fields = fields,
                                  .lights = frameCopy(*device_, lights_),
                                  .owners = frameCopy(*device_, owners_),
                                  .firstOccluder = firstOccluder,
                                  .occluderCount = occluderCount(),
                                  .lightCount = lightCount(),
                                  .tilesAcross = tilesAcross};
    return frameCopy(*device_, std::span<const shader::AreaBlock>(&block, 1));
}

} // namespace antumbra::render
