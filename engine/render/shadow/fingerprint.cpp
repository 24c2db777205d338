#include "render/shadow/fingerprint.h"

#include "base/fnv1a.h"

namespace antumbra::render {

uint64_t fingerprintOf(const FrameView& view, RayBackend backend, uvec2 extent, bool hasLateFields)
{
    Fnv1a print;
    const auto add = [&print](const auto&... values) { (print.add(values), ...); };
    add(backend, extent, hasLateFields, view.camera.eye, view.camera.rotation, view.camera.verticalFovRadians);
    add(view.environment.image, view.environment.rotationRadians, view.environment.intensity);
    add(view.shownBake(), view.knobs.prt.window);
    for (const StaticDraw& draw : view.statics)
        add(draw.model, draw.world, draw.isBaked);
    for (const CharacterDraw& draw : view.characters)
        add(draw.slot, draw.model, draw.world, draw.poseVersion);
    for (const AreaLightDraw& light : view.areaLights)
        add(light.firstPart, light.partCount, light.world, light.radiance, light.isTwoSided, view.shadowOf(light));
    for (const FieldStepDraw& draw : view.fieldSteps)
        add(draw.step, draw.surface);
    return print.value();
}

} // namespace antumbra::render
