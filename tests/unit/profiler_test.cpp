#include "app/profiler.h"

#include "tests/unit/allocation_counter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace antumbra::app {
namespace {

using graph::PassTime;

render::FrameReport reportOf(std::span<const PassTime> passes, std::optional<double> milliseconds = std::nullopt)
{
    return {.passes = passes, .frameMilliseconds = milliseconds};
}

std::vector<std::string> namesOf(const Profiler& profiler)
{
    std::vector<std::string> names;
    for (const PassTimes& pass : profiler.passes())
        names.push_back(pass.name);
    return names;
}

TEST(SampleWindow, HasNoMedianBeforeTheFirstValue)
{
    const SampleWindow window(4);
    EXPECT_FALSE(window.median() || window.least() || window.greatest());
}

TEST(SampleWindow, KeepsTheNewestInOrder)
{
    SampleWindow window(3);
    for (const double value : {5.0, 1.0, 4.0, 2.0})
        window.push(value);
    ASSERT_EQ(window.size(), 3u);
    EXPECT_EQ((std::array{window[0], window[1], window[2]}), (std::array{1.0, 4.0, 2.0}));
    EXPECT_EQ(window.median(), 2.0);
    EXPECT_EQ(window.least(), 1.0);
    EXPECT_EQ(window.greatest(), 4.0);
}

TEST(SampleWindow, AgreesWithSortingAnew)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<int> few(0, 9); // many equal values
    std::vector<double> all;
    SampleWindow window(64);
    for (int i = 0; i < 500; ++i) {
        all.push_back(few(random));
        window.push(all.back());
        std::vector<double> newest(all.end() - std::min<std::ptrdiff_t>(64, std::ssize(all)), all.end());
        for (size_t k = 0; k < newest.size(); ++k)
            ASSERT_EQ(window[k], newest[k]);
        std::ranges::sort(newest);
        const size_t count = newest.size();
        ASSERT_EQ(window.median(), (newest[(count - 1) / 2] + newest[count / 2]) / 2);
        ASSERT_EQ(window.least(), newest.front());
        ASSERT_EQ(window.greatest(), newest.back());
    }
}

TEST(Profiler, ListsThePassesOfTheNewestFrameInItsOrder)
{
    Profiler profiler;
    profiler.record(reportOf(std::array{PassTime{"posing", 1.0}, PassTime{"composite", 2.0}}), std::nullopt);
    profiler.record(reportOf(std::array{PassTime{"composite", 4.0}, PassTime{"tonemap", 1.0}}), std::nullopt);
    EXPECT_THAT(namesOf(profiler), testing::ElementsAre("composite", "tonemap"));
    EXPECT_EQ(profiler.passes()[0].milliseconds.median(), 3.0);
}

TEST(Profiler, RemembersAPassThatComesBack)
{
    Profiler profiler;
    profiler.record(reportOf(std::array{PassTime{"a", 1.0}, PassTime{"b", 5.0}}), std::nullopt);
    profiler.record(reportOf(std::array{PassTime{"a", 1.0}}), std::nullopt);
    profiler.record(reportOf(std::array{PassTime{"b", 7.0}, PassTime{"a", 1.0}}), std::nullopt);
    EXPECT_THAT(namesOf(profiler), testing::ElementsAre("b", "a"));
    EXPECT_EQ(profiler.passes()[0].milliseconds.median(), 6.0);
}

TEST(Profiler, KeepsPassesOfOneNameApart)
{
    Profiler profiler;
    for (int frame = 0; frame < 3; ++frame)
        profiler.record(reportOf(std::array{PassTime{"capture", 1.0}, PassTime{"capture", 9.0}}), std::nullopt);
    ASSERT_EQ(profiler.passes().size(), 2u);
    EXPECT_EQ(profiler.passes()[0].milliseconds.greatest(), 1.0);
    EXPECT_EQ(profiler.passes()[1].milliseconds.least(), 9.0);
}

TEST(Profiler, TimesThatCannotBeHadStayAbsent)
{
    Profiler profiler;
    profiler.record(reportOf(std::array{PassTime{"composite", std::nullopt}}), 16.0);
    EXPECT_FALSE(profiler.passes()[0].milliseconds.median());
    EXPECT_FALSE(profiler.gpuMilliseconds().median());
    EXPECT_EQ(profiler.frameMilliseconds().median(), 16.0);
}

TEST(Profiler, ForgetsTheWarmUp)
{
    Profiler profiler;
    profiler.record(reportOf(std::array{PassTime{"composite", 900.0}}, 900.0), 950.0);
    profiler.clear();
    EXPECT_TRUE(profiler.passes().empty());
    profiler.record(reportOf(std::array{PassTime{"composite", 1.0}}, 2.0), 3.0);
    EXPECT_EQ(profiler.passes()[0].milliseconds.greatest(), 1.0);
    EXPECT_EQ(profiler.gpuMilliseconds().greatest(), 2.0);
    EXPECT_EQ(profiler.frameMilliseconds().greatest(), 3.0);
}

TEST(Profiler, AllocatesNothingWhereTheSamePassesComeAgain)
{
    const std::array passes{PassTime{"posing", 1.0}, PassTime{"occlusion trace", 2.0}, PassTime{"composite", 3.0}};
    Profiler profiler;
    profiler.record(reportOf(passes, 6.0), 7.0);
    const uint64_t before = test::allocationCount();
    for (int frame = 0; frame < 300; ++frame)
        profiler.record(reportOf(passes, 6.0 + frame), 7.0);
    EXPECT_EQ(test::allocationCount(), before);
}

} // namespace
} // namespace antumbra::app
