#include "ecs/commands.h"

namespace antumbra::ecs {

void Changes::destroy(Entity entity)
{
    changes_.push_back({entity, 0, [](Changes&, World& world, const Change& change) { world.destroy(change.entity); }});
}

void Changes::apply(World& world)
{
    for (const Change& change : changes_) {
        if (world.isAlive(change.entity))
            change.apply(*this, world, change);
    }
    changes_.clear();
    for (const std::unique_ptr<AnyValues>& values : values_) {
        if (values)
            values->clear();
    }
}

} // namespace antumbra::ecs
