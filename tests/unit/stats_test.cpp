#include "app/stats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>

namespace antumbra::app {
namespace {

using Json = nlohmann::ordered_json;

// A run of two frames: one pass with times, one without, one skipped and one culled.
class Stats : public testing::Test
{
protected:
    Stats()
    {
        profiler_.record(report_, 20.0);
        profiler_.record(report_, 40.0);
    }

    [[nodiscard]] Json written() const
    {
        return Json::parse(statsJson({.device = "llvmpipe",
                                      .driver = "Mesa 25",
                                      .scene = "plaza",
                                      .size = {640, 360},
                                      .frames = 2,
                                      .knobs = knobs_,
                                      .quality = quality_ ? &*quality_ : nullptr,
                                      .profiler = profiler_,
                                      .report = report_,
                                      .memory = memory_}));
    }

    std::array<graph::PassTime, 2> passes_{{{"occlusion trace", 12.5}, {"tonemap", std::nullopt}}};
    std::array<graph::AbsentPass, 2> absent_{{{"skinning", "no DynamicSkinned in view", {}}, {"upsample", {}, "occluded"}}};
    render::FrameReport report_{
        .passes = passes_, .absent = absent_, .counters = {.raysConsidered = 4000000000u, .raysTraced = 7, .nanPixels = 3}, .frame = 2};
    render::MemoryReport memory_{.reserved = 5000000000, .used = 4, .transient = 3, .history = 2};
    render::Knobs knobs_;
    std::optional<QualityControl> quality_;
    Profiler profiler_;
};

TEST_F(Stats, HoldsTheContractsKeysInOrder)
{
    std::vector<std::string> keys;
    const Json stats = written();
    for (const auto& [key, value] : stats.items())
        keys.push_back(key);
    EXPECT_THAT(keys, testing::ElementsAre("device", "driver", "scene", "size", "frames", "knobs", "frame_ms", "gpu_frame_ms", "passes",
                                           "counters", "memory_bytes"));
}

TEST_F(Stats, SummarisesFrames)
{
    EXPECT_EQ(written()["frame_ms"], (Json{{"median", 30.0}, {"min", 20.0}, {"max", 40.0}}));
    EXPECT_EQ(written()["size"], (Json{640, 360}));
}

TEST_F(Stats, ATimeThatCannotBeHadReadsNull)
{
    const Json nothing = {{"median", nullptr}, {"min", nullptr}, {"max", nullptr}};
    EXPECT_EQ(written()["gpu_frame_ms"], nothing);
    EXPECT_EQ(written()["passes"][1], (Json{{"name", "tonemap"}, {"gpu_ms", nothing}, {"culled", false}, {"reason", ""}}));
    EXPECT_EQ(written()["passes"][0]["gpu_ms"]["median"], 12.5);
}

TEST_F(Stats, NamesWhatDidNotRunAndWhy)
{
    const Json passes = written()["passes"];
    ASSERT_EQ(passes.size(), 4u);
    EXPECT_EQ(passes[2]["name"], "skinning");
    EXPECT_EQ(passes[2]["culled"], true);
    EXPECT_EQ(passes[2]["reason"], "no DynamicSkinned in view");
    EXPECT_EQ(passes[3]["reason"], "nothing reads 'occluded'");
}

TEST_F(Stats, KnobsReadBackThroughSet)
{
    render::set(knobs_, "occlusion.samples", "96");
    render::set(knobs_, "occlusion.tolerance", "0.003");
    render::set(knobs_, "occlusion.scale", "1/4");
    render::Knobs again;
    const Json knobs = written()["knobs"];
    for (const auto& [key, value] : knobs.items())
        render::set(again, key, value.is_string() ? value.get<std::string>() : value.dump());
    for (const render::KnobDescription& knob : render::knobTable())
        EXPECT_EQ(knob.read(again), knob.read(knobs_)) << knob.key;
}

TEST_F(Stats, SaysWhatIsDoneForAFrameTime)
{
    EXPECT_FALSE(written().contains("quality"));
    knobs_.occlusion.samples = 128;
    knobs_.occlusion.scale = render::Scale::Full;
    quality_.emplace(20, knobs_, knobs_);
    for (int frame = 0; frame < 20; ++frame)
        quality_->take(30, knobs_);
    EXPECT_EQ(written()["quality"], (Json{{"target_ms", 20.0}, {"held", false}, {"level", 1}, {"lowest_level", 4}}));
    EXPECT_EQ(written()["knobs"]["occlusion.samples"], 64);
}

TEST_F(Stats, CountsAndBytesAreWhole)
{
    EXPECT_EQ(written()["counters"]["rays_considered"], 4000000000u);
    EXPECT_EQ(written()["counters"]["nan_pixels"], 3);
    EXPECT_EQ(written()["memory_bytes"]["reserved"], 5000000000);
}

} // namespace
} // namespace antumbra::app
