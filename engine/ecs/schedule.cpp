#include "ecs/schedule.h"

#include "base/error.h"

namespace antumbra::ecs {

namespace {

/// [a][b]: b must run before a, directly or through others.
using Order = std::vector<std::vector<bool>>;

void closeTransitively(Order& isAfter)
{
    for (size_t via = 0; via < isAfter.size(); ++via) {
        for (std::vector<bool>& row : isAfter) {
            if (!row[via])
                continue;
            for (size_t earlier = 0; earlier < row.size(); ++earlier)
                row[earlier] = row[earlier] || isAfter[via][earlier];
        }
    }
}

/// The first thing both touch and at least one writes; null where there is none.
const Access* conflict(const std::vector<Access>& a, const std::vector<Access>& b)
{
    for (const Access& mine : a) {
        for (const Access& theirs : b) {
            if (mine.type == theirs.type && (mine.writes || theirs.writes))
                return &mine;
        }
    }
    return nullptr;
}

/// Indices such that every system stands behind those it is after, and keeps its place where it is free to.
std::vector<size_t> sorted(const Order& isAfter)
{
    std::vector<size_t> order;
    std::vector<bool> isPlaced(isAfter.size(), false);
    const auto isReady = [&](size_t system) {
        for (size_t earlier = 0; earlier < isAfter.size(); ++earlier) {
            if (isAfter[system][earlier] && !isPlaced[earlier])
                return false;
        }
        return !isPlaced[system];
    };
    while (order.size() < isAfter.size()) {
        size_t next = 0;
        while (!isReady(next))
            ++next;
        isPlaced[next] = true;
        order.push_back(next);
    }
    return order;
}

} // namespace

size_t Schedule::indexOf(std::string_view name) const
{
    for (size_t i = 0; i < systems_.size(); ++i) {
        if (systems_[i].name == name)
            return i;
    }
    return systems_.size();
}

void Schedule::push(System system)
{
    check(indexOf(system.name) == systems_.size(), "a system name that is not taken");
    systems_.push_back(std::move(system));
    isCompiled_ = false;
}

Schedule::Added& Schedule::Added::after(std::string name)
{
    schedule_.systems_[index_].predecessors.push_back(std::move(name));
    schedule_.isCompiled_ = false;
    return *this;
}

void Schedule::compile()
{
    const size_t count = systems_.size();
    Order isAfter(count, std::vector<bool>(count, false));
    std::string faults;
    for (size_t i = 0; i < count; ++i) {
        for (const std::string& name : systems_[i].predecessors) {
            if (const size_t earlier = indexOf(name); earlier < count)
                isAfter[i][earlier] = true;
            else
                faults += "; " + systems_[i].name + " comes after " + name + ", which does not exist";
        }
    }
    closeTransitively(isAfter);
    for (size_t i = 0; i < count; ++i) {
        if (isAfter[i][i])
            faults += "; " + systems_[i].name + " comes after itself";
        for (size_t j = i + 1; j < count; ++j) {
            const Access* shared = conflict(systems_[i].accesses, systems_[j].accesses);
            if (shared != nullptr && !isAfter[i][j] && !isAfter[j][i])
                faults +=
                    "; " + systems_[i].name + " and " + systems_[j].name + " share " + std::string(shared->name) + " without an order";
        }
    }
    if (!faults.empty())
        throw Error(faults.substr(2), "schedule");

    std::vector<System> inOrder;
    for (const size_t i : sorted(isAfter))
        inOrder.push_back(std::move(systems_[i]));
    systems_ = std::move(inOrder);
    isCompiled_ = true;
}

void Schedule::run(World& world)
{
    check(isCompiled_, "a schedule that was compiled after its last change");
    for (System& system : systems_)
        system.run(world, changes_);
    changes_.apply(world);
}

std::vector<std::string_view> Schedule::names() const
{
    std::vector<std::string_view> names;
    for (const System& system : systems_)
        names.push_back(system.name);
    return names;
}

} // namespace antumbra::ecs
