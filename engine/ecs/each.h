// The entities that have certain components, as a range: `for (auto [a, b] : Each<A, const B>(world))`. A system takes one by value,
// and const says what it only reads. Keeps no list: every loop walks the smallest store, and no component comes or goes while one lives.
#pragma once

#include "ecs/each_term.h"

#include <iterator>
#include <optional>

namespace antumbra::ecs {

/// Terms: T, const T, Entity, With<T>, Without<T>, Maybe<T> (each_term.h). Visits in the order of the smallest required store.
template <class... Terms>
class Each
{
    static constexpr size_t kRequiredCount = (size_t{detail::Term<Terms>::kPresence == detail::Presence::Required} + ...);
    static_assert(kRequiredCount > 0, "an Each needs a component to look for");
    using Columns = std::tuple<detail::Term<Terms>...>;
    using Positions = std::array<uint32_t, sizeof...(Terms)>;

public:
    using Row = decltype(std::tuple_cat(std::declval<detail::Term<Terms>>().yield(0)...));

    explicit Each(World& world) : Each(world, Begun{}) {}
    explicit Each(const World& world) requires(detail::readsOnly<Terms>() && ...) : Each(world, Begun{}) {}
    Each(const Each&) = delete;
    Each& operator=(const Each&) = delete;
    ~Each() { --world_.livingEaches_; }

    class Iterator
    {
    public:
        using value_type = Row;
        using difference_type = std::ptrdiff_t;

        explicit Iterator(const Each& each) : each_(&each) { skipToMatch(); }
        Row operator*() const { return each_->rowAt(positions_); }
        Iterator& operator++()
        {
            ++place_;
            skipToMatch();
            return *this;
        }
        void operator++(int) { ++*this; }
        bool operator==(std::default_sentinel_t) const { return place_ == each_->led_.size(); }

    private:
        void skipToMatch()
        {
            while (place_ < each_->led_.size() && !each_->matches(place_, positions_))
                ++place_;
        }

        const Each* each_;
        uint32_t place_ = 0; // in the leader
        Positions positions_{};
    };

    [[nodiscard]] Iterator begin() const { return Iterator(*this); }
    [[nodiscard]] std::default_sentinel_t end() const { return {}; }

    /// The row of one entity, or nothing where it is no longer alive or does not match.
    [[nodiscard]] std::optional<Row> find(Entity entity) const
    {
        Positions positions{};
        const bool isFound = world_.isAlive(entity) && all(positions, [&](const auto& column, uint32_t& position) {
                                 position = column.locate(entity.index);
                                 return column.accepts(position);
                             });
        return isFound ? std::optional<Row>(rowAt(positions)) : std::nullopt;
    }

    /// What a system with this parameter touches.
    static void addAccesses(std::vector<Access>& accesses) { (addAccess<Terms>(accesses), ...); }

private:
    struct Begun
    {
    };
    using Sequence = std::index_sequence_for<Terms...>;

    Each(const World& world, Begun) : world_(world), columns_(detail::Term<Terms>(world)...)
    {
        ++world_.livingEaches_;
        std::apply([this](const auto&... columns) { (this->leadIfSmaller(columns), ...); }, columns_);
        led_ = leader_->entities();
    }

    template <class Column>
    void leadIfSmaller(const Column& column)
    {
        if constexpr (Column::kPresence == detail::Presence::Required) {
            if (leader_ == nullptr || column.set->entities().size() < leader_->entities().size())
                leader_ = column.set;
        }
    }

    /// The leader's own position is `place`: only the other columns are looked up.
    bool matches(uint32_t place, Positions& positions) const
    {
        return all(positions, [&]<class Column>(const Column& column, uint32_t& position) {
            if constexpr (Column::kPresence == detail::Presence::Required) {
                if (kRequiredCount == 1 || column.set == leader_) {
                    position = place;
                    return true;
                }
            }
            position = column.locate(led_[place]);
            return column.accepts(position);
        });
    }

    template <class Match>
    bool all(Positions& positions, const Match& match) const
    {
        return [&]<size_t... I>(std::index_sequence<I...>) { return (match(std::get<I>(columns_), positions[I]) && ...); }
        (Sequence{});
    }

    Row rowAt(const Positions& positions) const
    {
        return [&]<size_t... I>(std::index_sequence<I...>) { return std::tuple_cat(std::get<I>(columns_).yield(positions[I])...); }
        (Sequence{});
    }

    template <class T>
    static void addAccess(std::vector<Access>& accesses)
    {
        if constexpr (detail::Term<T>::kTouchesValues)
            accesses.push_back(accessTo<typename detail::Term<T>::Component>());
    }

    const World& world_;
    Columns columns_;
    const EntitySet* leader_ = nullptr;
    std::span<const uint32_t> led_; // the leader's entities
};

} // namespace antumbra::ecs
