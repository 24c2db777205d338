// What a system's parameters say: where each comes from, and what the system touches. Internal to schedule.h.
#pragma once

#include "ecs/commands.h"
#include "ecs/each.h"

namespace antumbra::ecs::detail {

/// A parameter that is no Each and no Commands is a resource: `const T&` and `T` read it, `T&` writes it.
template <class P>
struct Parameter
{
    using Resource = std::remove_reference_t<P>;
    static P resolve(World& world, Changes&) { return world.resource<std::remove_const_t<Resource>>(); }
    static void addAccesses(std::vector<Access>& accesses)
    {
        accesses.push_back(accessTo<std::conditional_t<std::is_reference_v<P>, Resource, const Resource>>());
    }
};
template <class... Terms>
struct Parameter<Each<Terms...>>
{
    static Each<Terms...> resolve(World& world, Changes&) { return Each<Terms...>(world); }
    static void addAccesses(std::vector<Access>& accesses) { Each<Terms...>::addAccesses(accesses); }
};
template <>
struct Parameter<Commands>
{
    static Commands resolve(World& world, Changes& changes) { return {world, changes}; }
    static void addAccesses(std::vector<Access>&) {}
};

template <class System>
struct Signature : Signature<decltype(&System::operator())>
{
};
template <class... Parameters>
struct Signature<void (*)(Parameters...)>
{
    template <class System>
    static void call(System& system, World& world, Changes& changes)
    {
        system(Parameter<Parameters>::resolve(world, changes)...);
    }
    static std::vector<Access> accesses()
    {
        std::vector<Access> accesses;
        (Parameter<Parameters>::addAccesses(accesses), ...);
        return accesses;
    }
};
template <class System, class... Parameters>
struct Signature<void (System::*)(Parameters...) const> : Signature<void (*)(Parameters...)>
{
};
template <class System, class... Parameters>
struct Signature<void (System::*)(Parameters...)> : Signature<void (*)(Parameters...)>
{
};

} // namespace antumbra::ecs::detail
