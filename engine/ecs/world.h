// All entities, their components, and the resources that exist once. Runs nothing: systems and their order are a Schedule's.
// A World belongs to one thread at a time.
#pragma once

#include "ecs/component_store.h"
#include "ecs/entity.h"
#include "ecs/resources.h"

namespace antumbra::ecs {

template <class... Terms>
class Each;

namespace detail {
enum class Presence;
template <class T, Presence presence>
struct Column;
template <class T>
struct Term;
} // namespace detail

class World
{
public:
    /// Allowed at any time: an entity without components is in no Each.
    Entity create();
    /// `components` are of different types.
    template <class... Components>
    Entity create(Components... components)
    {
        checkNotIterating();
        const Entity entity = create();
        (makeStore<Components>().insert(entity.index, std::move(components)), ...);
        return entity;
    }
    /// Removes all components too. Returns false when `entity` is no longer alive.
    bool destroy(Entity entity);
    [[nodiscard]] bool isAlive(Entity entity) const
    {
        return entity.index < generations_.size() && generations_[entity.index] == entity.generation && entity.generation % 2 == 1;
    }
    [[nodiscard]] size_t entityCount() const { return generations_.size() - free_.size(); }

    // While an Each lives, components may not come or go, because that moves others: record it through Commands.

    /// Replaces the component where there is one. `entity` must be alive.
    template <class T>
    T& add(Entity entity, T value)
    {
        check(isAlive(entity), "an entity that is alive");
        checkNotIterating();
        ComponentStore<T>& store = makeStore<T>();
        const uint32_t position = store.set().positionOf(entity.index);
        if (position != EntitySet::kAbsent)
            return store.values()[position] = std::move(value);
        return store.insert(entity.index, std::move(value));
    }
    /// Returns false when the entity is no longer alive or has no such component.
    template <class T>
    bool remove(Entity entity)
    {
        checkNotIterating();
        ComponentStore<T>* store = findStore<T>();
        const uint32_t position = store != nullptr && isAlive(entity) ? store->set().positionOf(entity.index) : EntitySet::kAbsent;
        if (position == EntitySet::kAbsent)
            return false;
        store->eraseAt(position);
        return true;
    }

    /// Null where the entity is no longer alive or has no such component.
    template <class T>
    [[nodiscard]] const T* find(Entity entity) const
    {
        ComponentStore<T>* store = findStore<T>();
        const uint32_t position = store != nullptr && isAlive(entity) ? store->set().positionOf(entity.index) : EntitySet::kAbsent;
        return position != EntitySet::kAbsent ? store->values() + position : nullptr;
    }
    template <class T>
    [[nodiscard]] T* find(Entity entity)
    {
        return const_cast<T*>(std::as_const(*this).template find<T>(entity));
    }
    template <class T>
    [[nodiscard]] bool has(Entity entity) const
    {
        return find<T>(entity) != nullptr;
    }
    template <class T>
    [[nodiscard]] const T& get(Entity entity) const
    {
        const T* value = find<T>(entity);
        check(value != nullptr, "an entity that has the component");
        return *value;
    }
    template <class T>
    [[nodiscard]] T& get(Entity entity)
    {
        return const_cast<T&>(std::as_const(*this).template get<T>(entity));
    }

    /// One value of its type for the whole world, replaced where there is one.
    template <class T>
    T& setResource(T value)
    {
        return resources_.set(std::move(value));
    }
    /// The resource must have been set.
    template <class T>
    [[nodiscard]] const T& resource() const
    {
        return resources_.get<T>();
    }
    template <class T>
    [[nodiscard]] T& resource()
    {
        return const_cast<T&>(resources_.get<T>());
    }

private:
    template <class... Terms>
    friend class Each;
    template <class T, detail::Presence presence>
    friend struct detail::Column;
    template <class T>
    friend struct detail::Term;

    template <class T>
    [[nodiscard]] ComponentStore<T>* findStore() const
    {
        const uint32_t type = typeIndex<T>();
        return type < stores_.size() ? static_cast<ComponentStore<T>*>(stores_[type].get()) : nullptr;
    }
    template <class T>
    ComponentStore<T>& makeStore()
    {
        if (ComponentStore<T>* store = findStore<T>()) [[likely]]
            return *store;
        return static_cast<ComponentStore<T>&>(addStore(typeIndex<T>(), std::make_unique<ComponentStore<T>>()));
    }
    AnyStore& addStore(uint32_t type, std::unique_ptr<AnyStore> store);
    void checkNotIterating() const { check(livingEaches_ == 0, "no change of components while an Each lives: use Commands"); }

    std::vector<uint32_t> generations_; // odd: alive
    std::vector<uint32_t> free_;
    std::vector<std::unique_ptr<AnyStore>> stores_; // by typeIndex, null where no entity ever had the component
    Resources resources_;
    mutable uint32_t livingEaches_ = 0;
};

} // namespace antumbra::ecs
