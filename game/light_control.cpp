#include "game/light_control.h"

#include <cmath>

namespace antumbra::game {

void circle(ecs::Each<scene::Transform, scene::Orbit> circling, ecs::Seconds step)
{
    for (auto [transform, orbit] : circling) {
        orbit.radians = std::remainder(orbit.radians + orbit.radiansPerSecond * step.value, 2 * kPi);
        transform.position = orbit.centre + orbit.radius * vec3(std::cos(orbit.radians), 0, -std::sin(orbit.radians));
    }
}

void turnLight(ecs::Each<scene::Environment> environments, const app::InputFrame& input)
{
    for (auto [environment] : environments)
        environment.rotationRadians =
            std::remainder(environment.rotationRadians + input.turnLight * kLightRadiansPerSecond * app::kStepSeconds, 2 * kPi);
}

} // namespace antumbra::game
