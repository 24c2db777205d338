// Contiguous values behind generational ids: an id outlives its value safely and never finds another's.
#pragma once

#include "base/check.h"

#include <cstdint>
#include <vector>

namespace antumbra {

/// `Tag` keeps ids of different kinds apart. Generation 0 is never alive, so a default id is the null id.
template <class Tag>
struct SlotId
{
    uint32_t index = 0;
    uint32_t generation = 0;

    friend bool operator==(SlotId, SlotId) = default;
    explicit operator bool() const { return generation != 0; }
};

/// Values are contiguous and in no kept order; insertion, erasure and look-up take constant time.
template <class T, class Tag = T>
class SlotMap
{
public:
    using Id = SlotId<Tag>;

    Id insert(T value)
    {
        if (free_.empty()) {
            slots_.push_back({});
            free_.push_back(static_cast<uint32_t>(slots_.size() - 1));
        }
        const uint32_t slot = free_.back();
        free_.pop_back();
        slots_[slot].position = static_cast<uint32_t>(values_.size());
        values_.push_back(std::move(value));
        slotOf_.push_back(slot);
        return {slot, ++slots_[slot].generation};
    }

    /// Returns false when `id` is no longer alive.
    bool erase(Id id)
    {
        if (!contains(id))
            return false;
        const uint32_t position = slots_[id.index].position;
        values_[position] = std::move(values_.back());
        slotOf_[position] = slotOf_.back();
        slots_[slotOf_[position]].position = position;
        values_.pop_back();
        slotOf_.pop_back();
        ++slots_[id.index].generation;
        free_.push_back(id.index);
        return true;
    }

    // Odd generations are alive, even ones free.
    [[nodiscard]] bool contains(Id id) const
    {
        return id.index < slots_.size() && slots_[id.index].generation == id.generation && id.generation % 2 == 1;
    }

    [[nodiscard]] T& operator[](Id id)
    {
        check(contains(id), "an id that is alive");
        return values_[slots_[id.index].position];
    }
    [[nodiscard]] const T& operator[](Id id) const { return const_cast<SlotMap&>(*this)[id]; }

    [[nodiscard]] size_t size() const { return values_.size(); }
    [[nodiscard]] bool empty() const { return values_.empty(); }
    auto begin() { return values_.begin(); }
    auto end() { return values_.end(); }
    auto begin() const { return values_.begin(); }
    auto end() const { return values_.end(); }

private:
    struct Slot
    {
        uint32_t position = 0;
        uint32_t generation = 0;
    };

    std::vector<T> values_;
    std::vector<uint32_t> slotOf_;
    std::vector<Slot> slots_;
    std::vector<uint32_t> free_;
};

} // namespace antumbra
