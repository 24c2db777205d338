// All that the passes of one frame see: flat arrays, no World. Filled by extract, read by everybody behind it.
#pragma once

#include "bake/bake.h"
#include "base/math.h"
#include "render/knobs.h"
#include "render/shader_structs.h"
#include "scene/mesh.h"
#include "scene/shadow_components.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace antumbra::render {

struct CameraView
{
    vec3 eye{0, 1.6f, 5};      // metres
    quat rotation{1, 0, 0, 0}; // looks along -Z
    float verticalFovRadians = 0.8f;
    float nearMetres = 0.05f; // there is no far plane
};

struct EnvironmentView
{
    uint32_t image = 0;        // into scene::Assets::environments; kNoIndex: there is none, and no light from it
    float rotationRadians = 0; // turns the light about +Y, counter-clockwise seen from above
    float intensity = 1;
};

/// A model at rest. Static objects keep their first term and hide no light from anyone but static samples behind them.
struct StaticDraw
{
    uint32_t model = 0; // into scene::Assets::models
    mat4 world{1};
    bool isBaked = false; // its first term is FrameView::bake's, where there is one, at the mesh's bakeUvs
};

/// A posed model. `slot` stays the character's as long as it lives: what the device keeps for it hangs there.
struct CharacterDraw
{
    uint32_t slot = 0;
    uint32_t model = 0;
    mat4 world{1};
    uint32_t firstJoint = 0; // into FrameView::joints, one a joint of the model
    uint32_t firstMorphWeight = 0;
    uint64_t poseVersion = 0; // changes when the pose does
};

/// An area light: every one of its parts shines.
struct AreaLightDraw
{
    uint32_t firstPart = 0; // into scene::Assets::bodyParts
    uint32_t partCount = 0;
    uint32_t model = 0; // what is seen of it, into scene::Assets::models
    mat4 world{1};
    vec3 radiance{0}; // W/(m^2 sr)
    bool isTwoSided = false;
    bool isSphere = false;                    // its body stands for the sphere around it
    std::optional<scene::LightShadow> shadow; // none: as the knob area.shadow says
};

/// A body that blocks area lights.
struct OccluderDraw
{
    uint32_t part = 0;                // into scene::Assets::bodyParts
    mat4 world{1};                    // of the part: posed where a joint moves it
    uint32_t light = scene::kNoIndex; // into FrameView::areaLights: the one that it is the body of, which it does not hide
};

/// A step of a distance field, in its place.
struct FieldStepDraw
{
    uint32_t field = 0;
    int32_t order = 0;   // of the steps of a field,
    uint32_t listed = 0; // then this
    shader::FieldStepBlock step{};
    shader::FieldSurfaceBlock surface{};
};

struct FrameView
{
    CameraView camera;
    EnvironmentView environment;
    const bake::Bake* bake = nullptr; // null: nothing is baked; what it points to stays as it is while frames show it
    std::vector<StaticDraw> statics;
    std::vector<CharacterDraw> characters;
    std::vector<AreaLightDraw> areaLights;
    std::vector<OccluderDraw> occluders;           // none without a light
    std::vector<FieldStepDraw> fieldSteps;         // field by field, in order
    std::vector<shader::FieldStepBlock> boneSteps; // fields that only area lights see, none without a light
    std::vector<mat4> joints;
    std::vector<float> morphWeights;
    Knobs knobs;
    bool waitsForPipelines = true; // else fields of another structure than before are shown once what they take is made
    float exposure = 1;
    std::optional<ivec2> probedPixel; // whose area light is taken apart
    uint32_t splitColumn = 0;         // columns left of it show the final picture, the rest knobs.view

    /// What gives the first terms: null where nothing is baked or the knob turns it off.
    [[nodiscard]] const bake::Bake* shownBake() const { return knobs.prt.isShown && hasEnvironment() ? bake : nullptr; }
    [[nodiscard]] bool hasEnvironment() const { return environment.image != scene::kNoIndex; }
    [[nodiscard]] scene::LightShadow shadowOf(const AreaLightDraw& light) const { return light.shadow.value_or(knobs.area.shadow); }
    /// Whether a light is shadowed by rays.
    [[nodiscard]] bool tracesAreaLights() const
    {
        using enum scene::LightShadow;
        return std::ranges::any_of(areaLights, [this](const AreaLightDraw& light) {
            const scene::LightShadow shadow = shadowOf(light);
            return shadow != None && shadow != Analytic && shadow != Triangles;
        });
    }
    /// Whether a light is shadowed by what accumulates to the truth.
    [[nodiscard]] bool hasReferenceLights() const
    {
        return std::ranges::any_of(areaLights,
                                   [this](const AreaLightDraw& light) { return shadowOf(light) == scene::LightShadow::Reference; });
    }
    /// Whether something in view hides light of the environment from frame to frame.
    [[nodiscard]] bool hidesEnvironment() const { return hasEnvironment() && !(characters.empty() && fieldSteps.empty()); }
    /// Why not, where it does not.
    [[nodiscard]] std::string_view whyNothingHides() const
    {
        return hasEnvironment() ? "no DynamicSkinned in the scene" : "no Environment in the scene";
    }
    /// Whether a pass traces rays through the scene.
    [[nodiscard]] bool tracesRays() const { return hidesEnvironment() || tracesAreaLights(); }
    /// Keeps the memory.
    void clear()
    {
        statics.clear();
        characters.clear();
        areaLights.clear();
        occluders.clear();
        fieldSteps.clear();
        boneSteps.clear();
        joints.clear();
        morphWeights.clear();
    }
};

} // namespace antumbra::render
