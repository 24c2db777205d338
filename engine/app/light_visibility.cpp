#include "app/light_visibility.h"

#include "base/check.h"
#include "base/error.h"
#include "ecs/each.h"
#include "scene/components.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/gtx/component_wise.hpp>

namespace antumbra::app {

namespace {

constexpr std::string_view kPrefix = "visibility:";

} // namespace

std::optional<std::string> lightOfAov(std::string_view aov)
{
    return aov.starts_with(kPrefix) ? std::optional(std::string(aov.substr(kPrefix.size()))) : std::nullopt;
}

uint32_t lightNamed(const ecs::World& world, const render::FrameView& view, const std::string& name)
{
    std::string known;
    for (auto [own, bodies] : ecs::Each<const scene::Name, const scene::LightBodies>(world)) {
        const auto found = std::ranges::find(view.areaLights, bodies.first, &render::AreaLightDraw::firstPart);
        if (own.text == name && found != view.areaLights.end())
            return static_cast<uint32_t>(found - view.areaLights.begin());
        known += fmt::format("{}{}", known.empty() ? "" : ", ", own.text);
    }
    throw Error(known.empty() ? "no AreaLight of the scene has a name" : fmt::format("no AreaLight has that name; there are {}", known),
                name);
}

render::FrameView viewOfLight(const render::FrameView& view, uint32_t light)
{
    render::FrameView alone = view;
    alone.environment.image = scene::kNoIndex;
    alone.areaLights = {view.areaLights.at(light)};
    vec3& radiance = alone.areaLights[0].radiance;
    radiance /= std::max(glm::compMax(radiance), 1e-30f);
    for (render::OccluderDraw& occluder : alone.occluders)
        occluder.light = occluder.light == light ? 0 : scene::kNoIndex;
    return alone;
}

scene::ImageF shareOf(const scene::ImageF& lit, const scene::ImageF& unshadowed)
{
    check(lit.channels == 3 && lit.values.size() == unshadowed.values.size(), "pictures of one size");
    scene::ImageF share{lit.width, lit.height, 1, {}};
    for (size_t i = 0; i < lit.values.size(); i += 3) {
        const float all = unshadowed.values[i] + unshadowed.values[i + 1] + unshadowed.values[i + 2];
        const float some = lit.values[i] + lit.values[i + 1] + lit.values[i + 2];
        share.values.push_back(all > 0 ? std::clamp(some / all, 0.0f, 1.0f) : 0.0f);
    }
    return share;
}

} // namespace antumbra::app
