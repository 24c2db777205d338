#include "ecs/world.h"

#include <atomic>

namespace antumbra::ecs {

uint32_t takeTypeIndex()
{
    static std::atomic<uint32_t> last = 0;
    return ++last;
}

Entity World::create()
{
    if (free_.empty()) {
        generations_.push_back(1);
        return {static_cast<uint32_t>(generations_.size() - 1), 1};
    }
    const uint32_t index = free_.back();
    free_.pop_back();
    return {index, ++generations_[index]};
}

bool World::destroy(Entity entity)
{
    checkNotIterating();
    if (!isAlive(entity))
        return false;
    for (const std::unique_ptr<AnyStore>& store : stores_) {
        const uint32_t position = store ? store->set().positionOf(entity.index) : EntitySet::kAbsent;
        if (position != EntitySet::kAbsent)
            store->eraseAt(position);
    }
    ++generations_[entity.index];
    free_.push_back(entity.index);
    return true;
}

AnyStore& World::addStore(uint32_t type, std::unique_ptr<AnyStore> store)
{
    check(type != 0, "a World that is used after main has begun");
    if (type >= stores_.size())
        stores_.resize(type + 1);
    stores_[type] = std::move(store);
    return *stores_[type];
}

} // namespace antumbra::ecs
