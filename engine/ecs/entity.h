// What the World hands out instead of pointers: eight bytes that never come to mean another thing. Carries no data of its own.
#pragma once

#include "base/slot_map.h"

namespace antumbra::ecs {

class World;

/// Passed by value; a default Entity is the null one. Only its World can tell whether it is alive.
using Entity = SlotId<World>;

} // namespace antumbra::ecs
