#include "game/time_control.h"

#include <algorithm>

namespace antumbra::game {

void controlTime(const app::InputFrame& input, Clock& clock, ecs::Seconds& step)
{
    if (input.asks(app::Action::Slower))
        clock.scale = std::max(clock.scale / 2, 1.0f / 8);
    if (input.asks(app::Action::Faster))
        clock.scale = std::min(clock.scale * 2, 4.0f);
    if (input.asks(app::Action::Pause))
        clock.isPaused = !clock.isPaused;
    const bool isMoving = !clock.isPaused || input.asks(app::Action::SingleStep);
    step.value = isMoving ? clock.scale * app::kStepSeconds : 0;
}

} // namespace antumbra::game
