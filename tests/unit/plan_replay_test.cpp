// Random frames, planned and then played on a model of memory that is too simple to be wrong: every read must find the version it was
// declared with, in its layout, made visible by a barrier, in memory that nobody else has taken.
#include "graph/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

namespace antumbra::graph {
namespace {

struct DeclaredAccess
{
    uint32_t resource;
    uint32_t before; // versions as handles carry them, 0 for none
    uint32_t after;
    Use use;
};

struct DeclaredPass
{
    std::vector<DeclaredAccess> accesses;
    bool sideEffect = false;
};

/// A frame's declaration beside the test's own record of it, which owes nothing to the graph's.
class RandomFrame
{
public:
    RandomFrame(FrameGraph& graph, std::array<HistorySlot, 2>& slots, uint32_t seed) : graph_(graph), random_(seed)
    {
        for (uint32_t i = upTo(3); i > 0; --i)
            importOne();
        for (HistorySlot& slot : slots)
            if (chance(0.5))
                addHistory(slot);
        for (uint32_t i = 2 + upTo(20); i > 0; --i)
            addPass();
        writeHistories();
        for (uint32_t i = upTo(3); i > 0 && !held_.empty(); --i)
            addOutput();
    }

    std::vector<DeclaredPass> passes;
    std::map<uint32_t, uint32_t> newest;  // version, by resource
    std::map<uint32_t, UseSet> outputs;   // by resource
    std::set<uint32_t> undefinedVersions; // whose contents nobody may count on

private:
    struct Held
    {
        Handle handle;
        Kind kind;
        bool readable;
        bool mustBeWritten;
    };

    uint32_t upTo(uint32_t greatest) { return std::uniform_int_distribution<uint32_t>(0, greatest)(random_); }
    bool chance(double share) { return std::bernoulli_distribution(share)(random_); }
    template <class T, size_t kCount>
    T oneOf(const std::array<T, kCount>& values)
    {
        return values[upTo(kCount - 1)];
    }

    ImageDesc someImage() { return {.format = gpu::Format::R32Float, .extent = {1 + upTo(3), 1 + upTo(3)}}; }
    Use readingUse(Kind kind)
    {
        constexpr std::array kOfImages{Use::Sampled, Use::StorageRead, Use::DepthRead, Use::TransferRead};
        constexpr std::array kOfBuffers{Use::StorageRead, Use::AccelBuildInput, Use::Indirect, Use::VertexRead, Use::TransferRead};
        return kind == Kind::Image ? oneOf(kOfImages) : oneOf(kOfBuffers);
    }
    Use writingUse(Kind kind)
    {
        constexpr std::array kOfImages{Use::StorageWrite, Use::ColorAttachment, Use::TransferWrite};
        constexpr std::array kOfBuffers{Use::StorageWrite, Use::TransferWrite, Use::AccelWrite};
        return kind == Kind::Image ? oneOf(kOfImages) : oneOf(kOfBuffers);
    }

    void hold(Held held, bool hasContents)
    {
        held_.push_back(held);
        newest[held.handle.index] = held.handle.version;
        if (!hasContents)
            undefinedVersions.insert(held.handle.version);
    }

    void importOne()
    {
        const Kind kind = chance(0.7) ? Kind::Image : Kind::Buffer;
        const UseSet initial = chance(0.3) ? UseSet{} : chance(0.5) ? UseSet{readingUse(kind)} : UseSet{writingUse(kind)};
        if (kind == Kind::Buffer)
            hold({graph_.importBuffer("imported", 64, ImportedBuffer{1}, initial), kind, true, false}, true);
        else
            hold({graph_.import("imported", someImage(), ImportedImage{1}, initial), kind, !initial.empty(), false}, !initial.empty());
    }

    void addHistory(HistorySlot& slot)
    {
        const History history = graph_.history("history", {.format = gpu::Format::R32Float, .extent = {4, 4}}, slot);
        hold({history.before, Kind::Image, true, false}, history.valid);
        hold({history.now, Kind::Image, false, true}, false);
        outputs[history.now.index] |= Use::Sampled;
    }

    void addPass()
    {
        Pass pass = graph_.add("pass");
        DeclaredPass& declared = passes.emplace_back();
        std::ranges::shuffle(held_, random_);
        const size_t known = held_.size();
        for (size_t i = 0; i < std::min<size_t>(known, 4); ++i) {
            if (held_[i].readable && chance(0.6))
                read(pass, held_[i]);
            else if (chance(0.3))
                write(pass, held_[i]);
        }
        for (uint32_t i = upTo(2); i > 0; --i)
            create(pass);
        if (chance(0.1)) {
            pass.sideEffect();
            declared.sideEffect = true;
        }
    }

    void read(Pass& pass, const Held& held)
    {
        const Use first = readingUse(held.kind);
        const Use second = readingUse(held.kind);
        for (const Use use : {first, second}) {
            if (use != first && held.kind == Kind::Image && layoutOf(use) != layoutOf(first))
                continue;
            if (held.kind == Kind::Image)
                pass.read(ImageRef{held.handle}, use);
            else
                pass.read(BufferRef{held.handle}, use);
            passes.back().accesses.push_back({held.handle.index, held.handle.version, 0, use});
        }
    }

    void write(Pass& pass, Held& held)
    {
        const Use use = writingUse(held.kind);
        const uint32_t before = held.handle.version;
        if (held.kind == Kind::Image)
            held.handle = pass.write(ImageRef{held.handle}, use);
        else
            held.handle = pass.write(BufferRef{held.handle}, use);
        held.readable = true;
        held.mustBeWritten = false;
        newest[held.handle.index] = held.handle.version;
        passes.back().accesses.push_back({held.handle.index, before, held.handle.version, use});
    }

    void create(Pass& pass)
    {
        const Kind kind = chance(0.7) ? Kind::Image : Kind::Buffer;
        const Use use = writingUse(kind);
        const Handle handle = kind == Kind::Image ? Handle{pass.create("transient", someImage(), use)}
                                                  : Handle{pass.createBuffer("transient", 1 + upTo(99), use)};
        hold({handle, kind, true, false}, true);
        passes.back().accesses.push_back({handle.index, 0, handle.version, use});
    }

    void writeHistories()
    {
        for (Held& held : held_)
            if (held.mustBeWritten) {
                Pass pass = graph_.add("write history");
                passes.emplace_back();
                write(pass, held);
            }
    }

    void addOutput()
    {
        const Held& held = held_[upTo(static_cast<uint32_t>(held_.size()) - 1)];
        if (outputs.contains(held.handle.index))
            return;
        const UseSet after = chance(0.5) ? UseSet{readingUse(held.kind)} : UseSet{};
        outputs[held.handle.index] = after;
        if (held.kind == Kind::Image)
            graph_.output(ImageRef{held.handle}, after);
        else
            graph_.output(BufferRef{held.handle}, after);
    }

    FrameGraph& graph_;
    std::mt19937 random_;
    std::vector<Held> held_;
};

/// The passes that lead to an output or a side effect, by searching until nothing more is found.
std::vector<uint32_t> neededPasses(const RandomFrame& frame)
{
    std::set<uint32_t> versions;
    for (const auto& [resource, after] : frame.outputs)
        versions.insert(frame.newest.at(resource));
    std::set<uint32_t> needed;
    for (bool found = true; found;) {
        found = false;
        for (uint32_t pass = 0; pass < frame.passes.size(); ++pass) {
            const auto& [accesses, sideEffect] = frame.passes[pass];
            const bool isNeeded = sideEffect || std::ranges::any_of(accesses, [&](const DeclaredAccess& access) {
                                      return access.after != 0 && versions.contains(access.after);
                                  });
            if (!isNeeded || !needed.insert(pass).second)
                continue;
            found = true;
            for (const DeclaredAccess& access : accesses)
                versions.insert(access.before);
        }
    }
    return {needed.begin(), needed.end()};
}

/// Memory as a device without any coherence would have it.
class Model
{
public:
    Model(const FrameGraph& graph, const RandomFrame& frame, const Plan& plan) : graph_(graph), frame_(frame), plan_(plan)
    {
        states_.resize(graph.resources().size());
        for (size_t i = 0; i < states_.size(); ++i)
            states_[i].ready = states_[i].done = graph.resources()[i].initial;
    }

    void apply(const Barrier& barrier)
    {
        State& state = states_[barrier.resource];
        const uint32_t memory = plan_.resources[barrier.resource].memory;
        if (memory != kNone && (!owners_.contains(memory) || owners_[memory] != barrier.resource)) {
            EXPECT_TRUE(barrier.discard);
            if (owners_.contains(memory)) {
                EXPECT_TRUE(barrier.from.contains(states_[owners_[memory]].done)) << "the memory is still in use";
            }
            owners_[memory] = barrier.resource;
        } else {
            EXPECT_TRUE(barrier.from.contains(state.done)) << "the barrier waits for too little";
            EXPECT_TRUE(state.ready.contains(barrier.from)) << "the barrier waits for what never was";
        }
        if (barrier.discard)
            state.contents = 0;
        state.ready = barrier.to;
        state.done = {};
    }

    void run(const DeclaredPass& pass)
    {
        std::map<uint32_t, UseSet> uses;
        for (const DeclaredAccess& access : pass.accesses)
            uses[access.resource] |= access.use;
        for (const auto& [resource, together] : uses) {
            State& state = states_[resource];
            expectReady(resource, together);
            EXPECT_TRUE(writes(together) ? state.done.empty() : !writes(state.done)) << "a hazard without a barrier";
            state.done |= together;
        }
        for (const DeclaredAccess& access : pass.accesses) {
            if (access.before != 0)
                expectContents(access.resource, access.before);
            if (access.after != 0)
                states_[access.resource].contents = access.after;
        }
    }

    void expectReady(uint32_t resource, UseSet uses)
    {
        EXPECT_TRUE(states_[resource].ready.contains(uses)) << "not visible to " << nameOfFirst(uses);
        if (graph_.resources()[resource].kind == Kind::Image) {
            EXPECT_EQ(layoutOf(states_[resource].ready), layoutOf(uses));
        }
        const uint32_t memory = plan_.resources[resource].memory;
        if (memory != kNone) {
            EXPECT_EQ(owners_[memory], resource) << "the memory belongs to another";
        }
    }

    void expectContents(uint32_t resource, uint32_t version)
    {
        State& state = states_[resource];
        if (frame_.undefinedVersions.contains(version))
            return;
        // What came into the frame has contents that no pass wrote.
        const bool isFromBefore = state.contents == kFromBefore && graph_.resources()[resource].origin != Origin::Transient;
        EXPECT_TRUE(isFromBefore ? isFirst(resource, version) : state.contents == version) << "not the version that was declared";
    }

private:
    static constexpr uint32_t kFromBefore = ~0u;

    struct State
    {
        UseSet ready; // what the last barrier made it ready for
        UseSet done;  // what was done with it since
        uint32_t contents = kFromBefore;
    };

    static std::string_view nameOfFirst(UseSet uses)
    {
        std::string_view name;
        uses.forEach([&](Use use) { name = nameOf(use); });
        return name;
    }

    bool isFirst(uint32_t resource, uint32_t version) const
    {
        for (const DeclaredPass& pass : frame_.passes)
            for (const DeclaredAccess& access : pass.accesses)
                if (access.resource == resource && access.after == version)
                    return false;
        return true;
    }

    const FrameGraph& graph_;
    const RandomFrame& frame_;
    const Plan& plan_;
    std::vector<State> states_;
    std::map<uint32_t, uint32_t> owners_; // of shared memory: which resource has it
};

void replay(const FrameGraph& graph, const RandomFrame& frame, const Plan& plan)
{
    Model model(graph, frame, plan);
    std::vector<uint32_t> run;
    for (const Step& step : plan.steps) {
        for (const Barrier& barrier : plan.barriersOf(step.barriers))
            model.apply(barrier);
        model.run(frame.passes[step.pass]);
        run.push_back(step.pass);
    }
    EXPECT_EQ(run, neededPasses(frame));

    for (const Barrier& barrier : plan.barriersOf(plan.finalBarriers))
        model.apply(barrier);
    for (const auto& [resource, after] : frame.outputs) {
        model.expectContents(resource, frame.newest.at(resource));
        if (!after.empty())
            model.expectReady(resource, after);
    }
}

void expectMemoryIsSharedWell(const FrameGraph& graph, const Plan& plan)
{
    for (const uint32_t a : plan.transients) {
        const PlannedResource& first = plan.resources[a];
        ASSERT_LT(first.memory, plan.memory.size());
        EXPECT_GE(plan.memory[first.memory].bytes, graph.resources()[a].bytes);
        EXPECT_EQ(plan.memory[first.memory].kind, graph.resources()[a].kind);
        for (const uint32_t b : plan.transients) {
            const PlannedResource& second = plan.resources[b];
            if (a != b && first.memory == second.memory) {
                EXPECT_TRUE(first.last < second.first || second.last < first.first) << "both live at once in the same memory";
            }
        }
    }
}

TEST(PlanReplay, RandomFramesKeepEveryPromise)
{
    FrameGraph graph;
    std::array<HistorySlot, 2> slots;
    Plan plan;
    size_t steps = 0;
    size_t absent = 0;
    size_t shared = 0;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(seed);
        graph.reset();
        const RandomFrame frame(graph, slots, seed);
        compile(graph, plan);
        replay(graph, frame, plan);
        expectMemoryIsSharedWell(graph, plan);
        ASSERT_FALSE(HasFailure());
        steps += plan.steps.size();
        absent += plan.absent.size();
        shared += plan.transients.size() - plan.memory.size();
    }
    EXPECT_GT(steps, 1000u) << "the frames must be worth replaying";
    EXPECT_GT(absent, 1000u);
    EXPECT_GT(shared, 1000u);
}

} // namespace
} // namespace antumbra::graph
