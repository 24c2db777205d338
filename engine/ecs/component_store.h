// One kind of component, for all entities that have it: a sparse set. Values are contiguous, their order is not kept,
// and a reference to one holds until the store next changes.
#pragma once

#include "base/check.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace antumbra::ecs {

/// Which entities are in, and at which position of the dense order. Knows entities by index alone: they leave every set when they die,
/// so only the World has to compare generations.
class EntitySet
{
public:
    static constexpr uint32_t kAbsent = ~0u;
    static constexpr uint32_t kPageLength = 4096;

    /// The look-up by itself, for loops; good until the set changes.
    class Index
    {
    public:
        [[nodiscard]] uint32_t positionOf(uint32_t entity) const
        {
            const size_t page = entity / kPageLength;
            return page < pageCount_ ? (*pages_[page])[entity % kPageLength] : kAbsent;
        }

    private:
        friend class EntitySet;
        explicit Index(const EntitySet& set) : pages_(set.pages_.data()), pageCount_(set.pages_.size()) {}
        const std::array<uint32_t, kPageLength>* const* pages_;
        size_t pageCount_;
    };

    [[nodiscard]] Index index() const { return Index(*this); }
    [[nodiscard]] uint32_t positionOf(uint32_t entity) const { return index().positionOf(entity); }
    [[nodiscard]] std::span<const uint32_t> entities() const { return entities_; }

    /// Appends `entity`, which must not be in.
    void insert(uint32_t entity)
    {
        const uint32_t page = entity / kPageLength;
        if (page >= pages_.size() || pages_[page] == &kEmptyPage) [[unlikely]]
            makePage(page);
        (*pages_[page])[entity % kPageLength] = static_cast<uint32_t>(entities_.size());
        entities_.push_back(entity);
    }

    /// The last entity takes over `position`.
    void eraseAt(uint32_t position)
    {
        const uint32_t last = entities_.back();
        const uint32_t erased = std::exchange(entities_[position], last);
        (*pages_[last / kPageLength])[last % kPageLength] = position;
        (*pages_[erased / kPageLength])[erased % kPageLength] = kAbsent;
        entities_.pop_back();
    }

private:
    using Page = std::array<uint32_t, kPageLength>;

    void makePage(uint32_t page);

    static Page kEmptyPage;                         // stands for every page that nobody was ever in, so that a look-up need not ask
    std::vector<Page*> pages_;                      // by entity
    std::vector<std::unique_ptr<Page>> ownedPages_; // in order of creation
    std::vector<uint32_t> entities_;
};

/// A store whose type is not known: what destroying an entity needs, and nothing else goes through it.
class AnyStore
{
public:
    AnyStore() = default;
    AnyStore(const AnyStore&) = delete;
    AnyStore& operator=(const AnyStore&) = delete;
    virtual ~AnyStore() = default;
    virtual void eraseAt(uint32_t position) = 0;

    [[nodiscard]] const EntitySet& set() const { return set_; }

protected:
    EntitySet set_;
};

template <class T>
class ComponentStore final : public AnyStore
{
public:
    /// Appends; the entity must have no such component.
    T& insert(uint32_t entity, T value)
    {
        set_.insert(entity);
        return values_.emplace_back(std::move(value));
    }

    void eraseAt(uint32_t position) override
    {
        set_.eraseAt(position);
        if (position + 1 != values_.size())
            values_[position] = std::move(values_.back());
        values_.pop_back();
    }

    /// In the order of set().entities().
    [[nodiscard]] T* values() { return values_.data(); }

private:
    std::vector<T> values_;
};

} // namespace antumbra::ecs
