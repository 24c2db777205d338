// Changes of the World that wait until no system runs. They are applied in the order recorded; what is meant for an entity
// that is gone by then is dropped.
#pragma once

#include "ecs/world.h"

namespace antumbra::ecs {

/// The waiting changes. Keeps its memory, so that a steady stream of changes allocates nothing.
class Changes
{
public:
    template <class T>
    void add(Entity entity, T value)
    {
        std::vector<T>& values = valuesOf<T>();
        values.push_back(std::move(value));
        changes_.push_back({entity, static_cast<uint32_t>(values.size() - 1), [](Changes& self, World& world, const Change& change) {
                                world.add(change.entity, std::move(self.valuesOf<T>()[change.value]));
                            }});
    }
    template <class T>
    void remove(Entity entity)
    {
        changes_.push_back({entity, 0, [](Changes&, World& world, const Change& change) { world.remove<T>(change.entity); }});
    }
    void destroy(Entity entity);

    /// Leaves nothing waiting.
    void apply(World& world);

private:
    struct Change
    {
        Entity entity;
        uint32_t value; // into the values of its type
        void (*apply)(Changes&, World&, const Change&);
    };
    struct AnyValues
    {
        virtual ~AnyValues() = default;
        virtual void clear() = 0;
    };
    template <class T>
    struct Values final : AnyValues
    {
        void clear() override { values.clear(); }
        std::vector<T> values;
    };

    template <class T>
    std::vector<T>& valuesOf()
    {
        const uint32_t type = typeIndex<T>();
        if (type >= values_.size())
            values_.resize(type + 1);
        if (!values_[type])
            values_[type] = std::make_unique<Values<T>>();
        return static_cast<Values<T>&>(*values_[type]).values;
    }

    std::vector<Change> changes_;
    std::vector<std::unique_ptr<AnyValues>> values_; // by typeIndex
};

/// A system's parameter: creates, destroys, adds and removes while others are iterated over.
class Commands
{
public:
    Commands(World& world, Changes& changes) : world_(world), changes_(changes) {}

    /// The entity is alive at once; its components come with the other changes.
    template <class... Components>
    Entity create(Components... components)
    {
        const Entity entity = world_.create();
        (changes_.add(entity, std::move(components)), ...);
        return entity;
    }
    void destroy(Entity entity) { changes_.destroy(entity); }
    template <class T>
    void add(Entity entity, T value)
    {
        changes_.add(entity, std::move(value));
    }
    template <class T>
    void remove(Entity entity)
    {
        changes_.remove<T>(entity);
    }

private:
    World& world_;
    Changes& changes_;
};

} // namespace antumbra::ecs
