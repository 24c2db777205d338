// Systems in an order that their footprints allow. Refuses two systems that touch the same data, one of them writing, without an order
// between them. Runs on the caller's thread; holds no state of the simulation.
#pragma once

#include "ecs/system.h"

#include <functional>
#include <string>

namespace antumbra::ecs {

/// The simulated time that one run advances by; a resource like any other.
struct Seconds
{
    float value = 0;
};

class Schedule
{
public:
    class Added;

    /// `system` is a function or a lambda of Each<...>, Commands and resources. Names are unique.
    template <class System>
    Added add(std::string name, System system);

    /// Sorts the systems: an order that was asked for first, then the order of adding.
    /// Throws Error that names every conflicting pair, an order that is unknown or runs in a circle.
    void compile();

    /// Runs every system once, then applies what they asked of Commands: no system's matches depend on where it stands.
    /// compile() must have come after the last add().
    void run(World& world);

    /// Names in the order of running.
    [[nodiscard]] std::vector<std::string_view> names() const;

private:
    struct System
    {
        std::string name;
        std::vector<Access> accesses;
        std::vector<std::string> predecessors;
        std::function<void(World&, Changes&)> run;
    };

    [[nodiscard]] size_t indexOf(std::string_view name) const;
    void push(System system);

    std::vector<System> systems_;
    Changes changes_;
    bool isCompiled_ = false;
};

/// What was added last, to say what it comes after.
class Schedule::Added
{
public:
    Added& after(std::string name);

private:
    friend class Schedule;
    Added(Schedule& schedule, size_t index) : schedule_(schedule), index_(index) {}
    Schedule& schedule_;
    size_t index_;
};

template <class F>
Schedule::Added Schedule::add(std::string name, F system)
{
    push({std::move(name), detail::Signature<F>::accesses(), {}, [system = std::move(system)](World& world, Changes& changes) mutable {
              detail::Signature<F>::call(system, world, changes);
          }});
    return {*this, systems_.size() - 1};
}

} // namespace antumbra::ecs
