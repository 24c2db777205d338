// From what hands do to what steps are asked: pictures and steps come at different rates, and nothing that was pressed may be lost
// or happen twice.
#pragma once

#include "app/controls.h"

namespace antumbra::app {

class Input
{
public:
    /// Once a picture.
    void take(const HandState& hands);
    /// Once a step. What happens once (a press, a drag, the wheel) goes to the first step after it.
    InputFrame nextStep();

private:
    InputFrame next_;
    vec2 orbit_{0};  // radians a second, held
    float zoom_ = 0; // notches a second, held
};

} // namespace antumbra::app
