#include "game/light_control.h"

#include <cmath>

namespace antumbra::game {

void turnLight(ecs::Each<scene::Environment> environments, const app::InputFrame& input)
{
    for (auto [environment] : environments)
        environment.rotationRadians =
            std::remainder(environment.rotationRadians + input.turnLight * kLightRadiansPerSecond * app::kStepSeconds, 2 * kPi);
}

} // namespace antumbra::game
