// Values that exist once, each found by its type. Knows nothing of entities.
#pragma once

#include "base/check.h"
#include "ecs/type_index.h"

#include <memory>
#include <utility>
#include <vector>

namespace antumbra::ecs {

class Resources
{
public:
    /// Replaces the value of this type where there is one.
    template <class T>
    T& set(T value)
    {
        const uint32_t type = typeIndex<T>();
        while (values_.size() <= type)
            values_.emplace_back(nullptr, [](void*) {});
        values_[type] = Value(new T(std::move(value)), [](void* held) { delete static_cast<T*>(held); });
        return *static_cast<T*>(values_[type].get());
    }
    template <class T>
    [[nodiscard]] const T& get() const
    {
        const uint32_t type = typeIndex<T>();
        check(type < values_.size() && values_[type], "a resource that was set");
        return *static_cast<const T*>(values_[type].get());
    }

private:
    using Value = std::unique_ptr<void, void (*)(void*)>;
    std::vector<Value> values_; // by typeIndex
};

} // namespace antumbra::ecs
