// The player's hold on time: pause, single steps, slower and faster. Camera and light do not obey it.
#pragma once

#include "app/input_frame.h"
#include "ecs/schedule.h"

namespace antumbra::game {

/// A resource.
struct Clock
{
    float scale = 1; // simulated seconds a second of the player, 1/8 to 4
    bool isPaused = false;
};

/// A system, before all that take time: turns the step of the player's time into one of simulated time.
void controlTime(const app::InputFrame& input, Clock& clock, ecs::Seconds& step);

} // namespace antumbra::game
