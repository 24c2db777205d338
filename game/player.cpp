#include "game/player.h"

#include <cmath>

namespace antumbra::game {

void controlPlayer(ecs::Each<Intent, ecs::With<Player>> players, const CameraRig& rig, const app::InputFrame& input)
{
    // The camera stands at `yaw` as seen from its target, so ahead is away from there.
    const vec2 ahead{-std::sin(rig.yaw), -std::cos(rig.yaw)};
    const vec2 right{-ahead.y, ahead.x};
    for (auto [intent] : players)
        intent = {
            .walk = right * input.move.x + ahead * input.move.y, .isRunning = input.isRunning, .waves = input.asks(app::Action::Wave)};
}

} // namespace antumbra::game
