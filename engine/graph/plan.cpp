// Linear in passes and accesses, but for the sharing of memory, which is quadratic in transients.
#include "graph/plan.h"

#include "graph/check_named.h"

#include <algorithm>
#include <utility>

namespace antumbra::graph {

namespace {

bool isNeeded(const FrameGraph& graph, const PassNode& pass, const std::vector<uint32_t>& readers)
{
    const auto isRead = [&](const Access& access) { return access.after != kNone && readers[access.after] > 0; };
    return pass.sideEffect || std::ranges::any_of(graph.accesses(pass), isRead);
}

// One sweep from the frame's outputs back to its first pass: a pass comes after all it needs, so its readers are counted before it is met.
void countReaders(const FrameGraph& graph, Plan& plan)
{
    plan.readers.assign(graph.versionCount(), 0);
    for (const Output& output : graph.outputs())
        ++plan.readers[graph.resources()[output.resource].version];
    for (size_t pass = graph.passes().size(); pass-- > 0;) {
        const PassNode& node = graph.passes()[pass];
        if (!isNeeded(graph, node, plan.readers))
            continue;
        for (const Access& access : graph.accesses(node))
            if (access.before != kNone)
                ++plan.readers[access.before];
    }
}

std::string_view firstWritten(const FrameGraph& graph, const PassNode& pass)
{
    for (const Access& access : graph.accesses(pass))
        if (access.after != kNone)
            return graph.resources()[access.resource].label;
    return {};
}

void listSteps(const FrameGraph& graph, Plan& plan)
{
    for (uint32_t pass = 0; pass < graph.passes().size(); ++pass) {
        const PassNode& node = graph.passes()[pass];
        if (isNeeded(graph, node, plan.readers))
            plan.steps.push_back({.pass = pass});
        else
            plan.absent.push_back({.name = node.name, .reason = {}, .unread = firstWritten(graph, node)});
    }
    for (const SkippedPass& skipped : graph.skipped())
        plan.absent.push_back({.name = skipped.name, .reason = skipped.reason, .unread = {}});
}

void findLifetimes(const FrameGraph& graph, Plan& plan)
{
    plan.resources.assign(graph.resources().size(), {});
    for (size_t i = 0; i < plan.resources.size(); ++i)
        plan.resources[i].left = graph.resources()[i].initial;
    for (uint32_t step = 0; step < plan.steps.size(); ++step)
        for (const Access& access : graph.accesses(graph.passes()[plan.steps[step].pass])) {
            PlannedResource& planned = plan.resources[access.resource];
            planned.uses |= access.use;
            planned.first = std::min(planned.first, step);
            planned.last = step;
        }
    for (const Output& output : graph.outputs()) {
        plan.resources[output.resource].uses |= output.after;
        plan.resources[output.resource].last = static_cast<uint32_t>(plan.steps.size());
    }
}

// The image written now is the one read in the next frame: it must suit both. A pair is declared side by side.
void joinHistories(const FrameGraph& graph, Plan& plan)
{
    for (uint32_t i = 0; i < plan.resources.size(); ++i) {
        if (graph.resources()[i].origin != Origin::HistoryBefore)
            continue;
        PlannedResource& before = plan.resources[i];
        PlannedResource& now = plan.resources[i + 1];
        checkNamed(graph.resources()[i + 1].written, "the history '{}' to be written in the frame that declares it",
                   graph.resources()[i].label);
        before.uses = now.uses |= before.uses;
    }
}

bool overlap(const PlannedResource& a, const PlannedResource& b) { return a.first <= b.last && b.first <= a.last; }

// The greatest first, each into the first memory that is free all its life: memory never has to grow.
void shareMemory(const FrameGraph& graph, Plan& plan)
{
    const std::span<const Resource> resources = graph.resources();
    for (uint32_t i = 0; i < resources.size(); ++i)
        if (resources[i].origin == Origin::Transient && plan.resources[i].first != kNone)
            plan.transients.push_back(i);
    std::ranges::sort(plan.transients, [&](uint32_t a, uint32_t b) {
        return resources[a].bytes != resources[b].bytes ? resources[a].bytes > resources[b].bytes : a < b;
    });

    for (auto next = plan.transients.begin(); next != plan.transients.end(); ++next) {
        PlannedResource& planned = plan.resources[*next];
        const auto isFree = [&](uint32_t memory) {
            return plan.memory[memory].kind == resources[*next].kind && std::none_of(plan.transients.begin(), next, [&](uint32_t other) {
                       return plan.resources[other].memory == memory && overlap(plan.resources[other], planned);
                   });
        };
        planned.memory = 0;
        while (planned.memory < plan.memory.size() && !isFree(planned.memory))
            ++planned.memory;
        if (planned.memory == plan.memory.size())
            plan.memory.push_back({.kind = resources[*next].kind, .bytes = resources[*next].bytes});
    }
}

struct Arrival
{
    uint32_t resource;
    UseSet uses;
    bool first;  // nothing used the resource before in this frame
    bool clears; // what it held is overwritten
};

// A transient waits for whoever had its memory before, in this frame; what an earlier frame did there is not known to the plan.
UseSet takeMemory(Plan& plan, uint32_t transient)
{
    const uint32_t occupant = std::exchange(plan.memory[plan.resources[transient].memory].occupant, transient);
    return occupant == kNone ? UseSet{} : plan.resources[occupant].left;
}

// Reads that follow each other in one layout share the barrier before the first of them; all else gets its own.
void makeReady(const FrameGraph& graph, Plan& plan, const Arrival& arrival)
{
    const Resource& resource = graph.resources()[arrival.resource];
    PlannedResource& planned = plan.resources[arrival.resource];
    const bool isTransient = resource.origin == Origin::Transient;
    if (arrival.first && isTransient)
        planned.left = takeMemory(plan, arrival.resource);

    const bool undefined = arrival.first && (isTransient || (resource.kind == Kind::Image && resource.initial.empty()));
    const bool sameLayout = resource.kind == Kind::Buffer || layoutOf(planned.left) == layoutOf(arrival.uses);
    const bool readsOn = !undefined && !planned.left.empty() && sameLayout && !writes(planned.left | arrival.uses);
    if (readsOn && planned.left.contains(arrival.uses))
        return;
    const UseSet before = planned.left;
    planned.left = readsOn ? before | arrival.uses : arrival.uses;
    if (readsOn && planned.barrier != kNone) {
        plan.barriers[planned.barrier].to = planned.left;
    } else {
        planned.barrier = static_cast<uint32_t>(plan.barriers.size());
        plan.barriers.push_back({arrival.resource, before, planned.left, undefined || arrival.clears});
    }
}

UseSet usesIn(std::span<const Access> accesses, uint32_t resource)
{
    UseSet uses;
    for (const Access& access : accesses)
        if (access.resource == resource)
            uses |= access.use;
    return uses;
}

void planStep(const FrameGraph& graph, Plan& plan, uint32_t index)
{
    Step& step = plan.steps[index];
    step.barriers.first = static_cast<uint32_t>(plan.barriers.size());
    step.attachments.first = static_cast<uint32_t>(plan.attachments.size());
    const std::span<const Access> accesses = graph.accesses(graph.passes()[step.pass]);
    for (size_t i = 0; i < accesses.size(); ++i) {
        const Access& access = accesses[i];
        const Resource& resource = graph.resources()[access.resource];
        const PlannedResource& planned = plan.resources[access.resource];
        const bool first = planned.first == index;
        const bool clears = first && resource.image.clear && isAttachment(access.use) && writes(access.use);
        if (usesIn(accesses.first(i), access.resource).empty())
            makeReady(graph, plan, {access.resource, usesIn(accesses, access.resource), first, clears});
        if (isAttachment(access.use)) {
            const bool discards = first && resource.initial.empty();
            const bool isKept = resource.origin != Origin::Transient || planned.last > index;
            plan.attachments.push_back({access.resource, access.use, clears ? Load::Clear : discards ? Load::Discard : Load::Keep, isKept});
        }
    }
    step.barriers.count = static_cast<uint32_t>(plan.barriers.size()) - step.barriers.first;
    step.attachments.count = static_cast<uint32_t>(plan.attachments.size()) - step.attachments.first;
}

void planOutputs(const FrameGraph& graph, Plan& plan)
{
    plan.finalBarriers.first = static_cast<uint32_t>(plan.barriers.size());
    for (const Output& output : graph.outputs())
        if (!output.after.empty())
            makeReady(graph, plan, {output.resource, output.after, plan.resources[output.resource].first == kNone, false});
    plan.finalBarriers.count = static_cast<uint32_t>(plan.barriers.size()) - plan.finalBarriers.first;
}

} // namespace

Plan compile(const FrameGraph& graph)
{
    Plan plan;
    compile(graph, plan);
    return plan;
}

void compile(const FrameGraph& graph, Plan& plan)
{
    plan.steps.clear();
    plan.barriers.clear();
    plan.attachments.clear();
    plan.transients.clear();
    plan.memory.clear();
    plan.absent.clear();

    countReaders(graph, plan);
    listSteps(graph, plan);
    findLifetimes(graph, plan);
    joinHistories(graph, plan);
    shareMemory(graph, plan);
    for (uint32_t step = 0; step < plan.steps.size(); ++step)
        planStep(graph, plan, step);
    planOutputs(graph, plan);
}

std::string reasonOf(const AbsentPass& pass)
{
    if (!pass.reason.empty())
        return std::string{pass.reason};
    return pass.unread.empty() ? "it writes nothing" : fmt::format("nothing reads '{}'", pass.unread);
}

} // namespace antumbra::graph
