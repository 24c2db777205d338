// The walker's motions, each a closed loop on the spot: who plays one moves the model against the planted feet.
#pragma once

#include "scene/model.h"
#include "tools/make_character/pose.h"

#include <functional>
#include <string>
#include <vector>

namespace antumbra::character {

struct Motion
{
    std::string name;
    double duration; // seconds
    double keysPerSecond;
    std::function<Pose(double phase)> at; // phase 0..1; 1 repeats 0
};

/// idle, walk (1.4 m/s), run (3.3 m/s), wave, turn (to the left, 1.2 rad/s).
std::vector<Motion> motions();

/// Keys of the hips' place and of every joint's rotation; node i is joint i.
scene::Clip toClip(const Motion& motion);

} // namespace antumbra::character
