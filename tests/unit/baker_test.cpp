#include "bake/baker.h"

#include "base/error.h"
#include "base/fnv1a.h"
#include "unit/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <barrier>
#include <numeric>
#include <set>
#include <thread>

namespace antumbra::bake {
namespace {

using testing::HasSubstr;

/// Adds a square that faces the way of cross(right, up), with edges of 2 m, its chart the `slot`th of six on the page.
void addWall(StaticScene& scene, vec3 middle, vec3 right, vec3 up, uint32_t slot)
{
    const auto first = static_cast<uint32_t>(scene.positions.size());
    const vec2 corner = vec2(uvec2(slot % 3, slot / 3)) / vec2(3, 2);
    for (const vec2 at : {vec2{0, 0}, vec2{1, 0}, vec2{1, 1}, vec2{0, 1}}) {
        scene.positions.push_back(middle + (2 * at.x - 1) * right + (2 * at.y - 1) * up);
        scene.normals.push_back(glm::cross(right, up));
        scene.uvs.push_back(at);
        scene.bakeUvs.push_back(corner + (0.1f + 0.8f * at) * vec2(1.0f / 3, 0.5f));
    }
    for (const uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u})
        scene.indices.push_back(first + index);
    scene.triangleMaterials.insert(scene.triangleMaterials.end(), 2, 0);
}

/// Five walls that face inwards, open towards +Z.
StaticScene openRoom(uvec2 extent = {24, 16})
{
    StaticScene room;
    room.atlasExtent = extent;
    room.materials.push_back({.albedo = {0.5f, 0.6f, 0.7f}});
    addWall(room, {0, 0, 0}, {1, 0, 0}, {0, 0, -1}, 0);
    addWall(room, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, 1);
    addWall(room, {-1, 1, 0}, {0, 0, -1}, {0, 1, 0}, 2);
    addWall(room, {1, 1, 0}, {0, 0, 1}, {0, 1, 0}, 3);
    addWall(room, {0, 1, -1}, {1, 0, 0}, {0, 1, 0}, 4);
    return room;
}

// Some tiles a pass.
constexpr BakeSettings kSettings{.bands = 2, .bounces = 1, .raysPerTexel = 1024, .raysPerCell = 4096, .cellMetres = 0.4f};

uint64_t hashOf(const Bake& bake)
{
    Fnv1a hash;
    hash.add(bake.atlas.extent);
    hash.add(std::span(bake.atlas.planes));
    hash.add(bake.volume.grid);
    hash.add(std::span(bake.volume.planes));
    hash.add(std::span(bake.volume.isOpen));
    return hash.value();
}

class BakerTest : public testing::Test
{
protected:
    /// Interrupts after so many of the questions.
    static std::function<bool()> after(uint32_t questions)
    {
        return [left = questions]() mutable { return left-- == 0; };
    }

    uint64_t wholeBake() const
    {
        static const uint64_t whole = hashOf(*bakeScene(openRoom(), kSettings, {.threads = 1}));
        return whole;
    }

    void interruptAfter(uint32_t questions, bool isResumed = false) const
    {
        const BakeJob job{.threads = 1, .partial = partial_, .isResumed = isResumed, .isInterrupted = after(questions)};
        ASSERT_FALSE(bakeScene(openRoom(), kSettings, job).has_value());
    }

    std::string complaint(const StaticScene& scene, const BakeSettings& settings) const
    {
        try {
            bakeScene(scene, settings, {.threads = 1, .partial = partial_, .isResumed = true});
            return "";
        } catch (const Error& error) {
            EXPECT_EQ(error.which, partial_.string());
            return error.what();
        }
    }

    std::optional<Bake> resumed() const { return bakeScene(openRoom(), kSettings, {.threads = 2, .partial = partial_, .isResumed = true}); }

    TestFolder folder_;
    Path partial_ = folder_ / "room.partial";
};

TEST_F(BakerTest, TheNumberOfThreadsChangesNoByte)
{
    for (const uint32_t threads : {2u, 3u})
        EXPECT_EQ(hashOf(*bakeScene(openRoom(), kSettings, {.threads = threads})), wholeBake()) << threads;
}

TEST_F(BakerTest, LightComesIn)
{
    const Bake bake = *bakeScene(openRoom(), kSettings, {.threads = 2});
    EXPECT_EQ(bake.settings, kSettings);
    EXPECT_EQ(bake.sceneHash, hashOf(openRoom()));
    EXPECT_EQ(bake.atlas.extent, uvec2(24, 16));
    EXPECT_EQ(bake.atlas.planes.size(), size_t{24} * 16 * 12);
    EXPECT_GT(*std::ranges::max_element(bake.atlas.planes), 0);
    EXPECT_GT(std::accumulate(bake.volume.isOpen.begin(), bake.volume.isOpen.end(), 0), 0);
}

TEST_F(BakerTest, EachBounceCounts)
{
    std::set<uint64_t> bakes;
    for (const uint32_t bounces : {0u, 1u, 2u}) {
        BakeSettings settings = kSettings;
        settings.bounces = bounces;
        bakes.insert(hashOf(*bakeScene(openRoom(), settings, {.threads = 2})));
    }
    EXPECT_EQ(bakes.size(), 3u);
}

/// Processes as threads that wait for each other.
class Together
{
public:
    explicit Together(uint32_t count) : barrier_(static_cast<std::ptrdiff_t>(count)), told_(count) {}

    Peers peers(uint32_t rank)
    {
        return {.rank = rank, .count = static_cast<uint32_t>(told_.size()), .exchange = [this, rank](Bytes mine) {
                    told_[rank] = std::move(mine);
                    barrier_.arrive_and_wait();
                    std::vector<Bytes> all = told_;
                    barrier_.arrive_and_wait();
                    return all;
                }};
    }

private:
    std::barrier<> barrier_;
    std::vector<Bytes> told_;
};

TEST_F(BakerTest, TheNumberOfProcessesChangesNoByte)
{
    for (const uint32_t count : {2u, 3u}) {
        Together together(count);
        std::vector<std::optional<Bake>> bakes(count);
        {
            std::vector<std::jthread> processes;
            for (uint32_t rank = 0; rank < count; ++rank)
                processes.emplace_back(
                    [&, rank] { bakes[rank] = bakeScene(openRoom(), kSettings, {.threads = 1, .peers = together.peers(rank)}); });
        }
        for (const std::optional<Bake>& bake : bakes)
            EXPECT_EQ(hashOf(bake.value()), wholeBake()) << count;
    }
}

TEST_F(BakerTest, AnInterruptedProcessEndsAllAndAnotherNumberOfThemGoesOn)
{
    Together together(2);
    {
        std::vector<std::jthread> processes;
        for (uint32_t rank = 0; rank < 2; ++rank)
            processes.emplace_back([&, rank] {
                const BakeJob job{.threads = 1,
                                  .peers = together.peers(rank),
                                  .partial = rank == 0 ? partial_ : Path(),
                                  .isInterrupted = rank == 1 ? after(5) : nullptr};
                EXPECT_FALSE(bakeScene(openRoom(), kSettings, job).has_value());
            });
    }
    EXPECT_EQ(hashOf(resumed().value()), wholeBake());
}

TEST_F(BakerTest, ResumesToTheSameBytesFromWhereverItWasInterrupted)
{
    for (const uint32_t questions : {0u, 1u, 4u, 9u, 13u}) {
        interruptAfter(questions);
        EXPECT_EQ(hashOf(resumed().value()), wholeBake()) << questions;
    }
}

TEST_F(BakerTest, WhatWasDoneIsNotDoneAgain)
{
    interruptAfter(2);
    interruptAfter(2, true);
    const uint64_t size = std::filesystem::file_size(partial_);
    interruptAfter(2, true);
    EXPECT_GT(std::filesystem::file_size(partial_), size);
    resumed();
    // All is kept: nothing is left to do, so that nobody can interrupt.
    EXPECT_TRUE(bakeScene(openRoom(), kSettings, {.partial = partial_, .isResumed = true, .isInterrupted = after(0)}).has_value());
}

TEST_F(BakerTest, ARecordThatIsCutShortIsMadeAgain)
{
    interruptAfter(5);
    std::filesystem::resize_file(partial_, std::filesystem::file_size(partial_) - 7);
    EXPECT_EQ(hashOf(resumed().value()), wholeBake());
    EXPECT_EQ(hashOf(resumed().value()), wholeBake()) << "what was written after the cut is read again";
}

TEST_F(BakerTest, APartialOfSomethingElseIsRefused)
{
    interruptAfter(3);
    BakeSettings more = kSettings;
    more.raysPerTexel = 2048;
    EXPECT_THAT(complaint(openRoom(), more), HasSubstr("prt.rays is 1024 and not 2048"));
    EXPECT_THAT(complaint(openRoom({48, 24}), kSettings), HasSubstr("another scene"));
    writeText(partial_, "something else, long enough to hold what a partial file begins with and then some more words");
    EXPECT_THAT(complaint(openRoom(), kSettings), HasSubstr("not what this program keeps"));
    std::filesystem::remove(partial_);
    EXPECT_THAT(complaint(openRoom(), kSettings), HasSubstr("no such file"));
}

TEST_F(BakerTest, ADamagedPartialIsRefused)
{
    interruptAfter(5);
    const std::vector<std::byte> whole = readFile(partial_);
    for (const size_t place : {size_t{40}, size_t{80}, whole.size() / 2, whole.size() - 1}) {
        std::vector<std::byte> flipped = whole;
        flipped[place] ^= std::byte{1};
        writeFile(partial_, flipped);
        EXPECT_THAT(complaint(openRoom(), kSettings), HasSubstr("damaged")) << place;
    }
}

TEST_F(BakerTest, ReportsThatRaysGrowToAll)
{
    std::vector<BakeProgress> reports;
    bakeScene(openRoom(), kSettings, {.threads = 1, .report = [&](const BakeProgress& progress) { reports.push_back(progress); }});
    ASSERT_FALSE(reports.empty());
    EXPECT_TRUE(std::ranges::is_sorted(reports, {}, &BakeProgress::raysDone));
    for (const BakeProgress& report : reports) {
        EXPECT_LE(report.raysDone, report.raysAll);
        EXPECT_GE(report.secondsLeft, 0);
    }
}

TEST(BakeEstimate, GrowsAsTheBakeDoes)
{
    const StaticScene room = openRoom();
    const BakeEstimate once = estimate(room, kSettings);
    BakeSettings more = kSettings;
    more.raysPerTexel *= 2;
    more.raysPerCell *= 2;
    EXPECT_EQ(estimate(room, more).rays, 2 * once.rays);
    EXPECT_EQ(estimate(room, more).bytes, once.bytes);
    EXPECT_GT(estimate(openRoom({3600, 2400}), kSettings).bytes, 3600u * 2400u * 12 * sizeof(uint16_t));
    more.bands = 5;
    EXPECT_GT(estimate(openRoom({3600, 2400}), more).bytes, 2 * estimate(openRoom({3600, 2400}), kSettings).bytes);
}

TEST(BakeEstimate, CountsTexelsToAFewPercent)
{
    // Each of five charts is 240 x 240 texels and touches no more.
    BakeSettings settings = kSettings;
    settings.bounces = 0;
    const StaticScene room = openRoom({900, 600});
    const uint64_t cells = uint64_t{5} * 5 * 5;
    const double texels = static_cast<double>(estimate(room, settings).rays - cells * settings.raysPerCell) / settings.raysPerTexel;
    EXPECT_NEAR(texels, 5 * 240 * 240, 0.02 * 5 * 240 * 240);
}

TEST(BakeEstimate, FindsTheDensityThatFits)
{
    // 240 texels on 2 m.
    BakeSettings settings = kSettings;
    settings.texelsPerMetre = 1000;
    const StaticScene room = openRoom({900, 600});
    const uint64_t needed = estimate(room, settings).bytes;
    EXPECT_NEAR(densityWithin(room, settings, needed).value(), 120, 0.1);
    const float density = densityWithin(room, settings, needed * 2 / 3).value();
    EXPECT_LT(density, 120);
    EXPECT_GT(density, 60);
    const auto side = static_cast<uint32_t>(density / 120 * 900);
    EXPECT_NEAR(static_cast<double>(estimate(openRoom(side * uvec2(3, 2) / 3u), settings).bytes), static_cast<double>(needed) * 2 / 3,
                0.02 * static_cast<double>(needed));
    EXPECT_FALSE(densityWithin(room, settings, 1 << 20).has_value());
}

} // namespace
} // namespace antumbra::bake
