// What the terms of an Each look up, yield and touch. Internal to each.h.
#pragma once

#include "ecs/world.h"

#include <tuple>

namespace antumbra::ecs {

// The terms besides T and const T, which are required and yield a reference, and Entity, which yields the entity itself.
template <class T>
struct With; // required, yields nothing: for markers
template <class T>
struct Without; // refused, yields nothing
template <class T>
struct Maybe; // yields T* (or const T*), null where the entity has none

/// A component or resource that a system touches.
struct Access
{
    uint32_t type = 0;
    std::string_view name;
    bool writes = false;
};

template <class T>
Access accessTo()
{
    return {typeIndex<T>(), typeName<std::remove_const_t<T>>(), !std::is_const_v<T>};
}

namespace detail {

enum class Presence { Required, Refused, Any };

inline const EntitySet kEmptySet;

/// One store as a loop sees it; a store that does not exist reads as empty.
template <class T, Presence presence>
struct Column
{
    using Component = T;
    static constexpr Presence kPresence = presence;

    explicit Column(const World& world) : Column(world.findStore<std::remove_const_t<T>>()) {}
    explicit Column(ComponentStore<std::remove_const_t<T>>* store)
        : set(store != nullptr ? &store->set() : &kEmptySet), index(set->index()), values(store != nullptr ? store->values() : nullptr)
    {
    }
    [[nodiscard]] uint32_t locate(uint32_t entity) const { return index.positionOf(entity); }
    [[nodiscard]] static bool accepts(uint32_t position)
    {
        return presence == Presence::Any || (presence == Presence::Required) == (position != EntitySet::kAbsent);
    }

    const EntitySet* set;
    EntitySet::Index index;
    T* values;
};

template <class T>
struct Term : Column<T, Presence::Required>
{
    using Column<T, Presence::Required>::Column;
    static constexpr bool kTouchesValues = true;
    std::tuple<T&> yield(uint32_t position) const { return {this->values[position]}; }
};

template <class T>
struct Term<Maybe<T>> : Column<T, Presence::Any>
{
    using Column<T, Presence::Any>::Column;
    static constexpr bool kTouchesValues = true;
    std::tuple<T*> yield(uint32_t position) const { return {position != EntitySet::kAbsent ? this->values + position : nullptr}; }
};

template <class T>
struct Term<With<T>> : Column<const T, Presence::Required>
{
    using Column<const T, Presence::Required>::Column;
    static constexpr bool kTouchesValues = false;
    std::tuple<> yield(uint32_t) const { return {}; }
};

template <class T>
struct Term<Without<T>> : Column<const T, Presence::Refused>
{
    using Column<const T, Presence::Refused>::Column;
    static constexpr bool kTouchesValues = false;
    std::tuple<> yield(uint32_t) const { return {}; }
};

template <>
struct Term<Entity>
{
    static constexpr Presence kPresence = Presence::Any;
    static constexpr bool kTouchesValues = false;

    explicit Term(const World& world) : generations(&world.generations_) {}
    [[nodiscard]] static uint32_t locate(uint32_t entity) { return entity; }
    [[nodiscard]] static bool accepts(uint32_t) { return true; }
    std::tuple<Entity> yield(uint32_t entity) const { return {Entity{entity, (*generations)[entity]}}; }

    const std::vector<uint32_t>* generations; // may grow during the loop
};

template <class T>
constexpr bool readsOnly()
{
    if constexpr (Term<T>::kTouchesValues)
        return std::is_const_v<typename Term<T>::Component>;
    else
        return true;
}

} // namespace detail

} // namespace antumbra::ecs
