// What the shader of area lights is compiled for.
#include "render/shadow/area_pipelines.h"

#include <gtest/gtest.h>

#include <limits>

namespace antumbra::render {
namespace {

constexpr uint32_t kNoLimit = std::numeric_limits<uint32_t>::max();

TEST(AreaRoom, HoldsWhatIsAskedForWhereThereIsNoLimit)
{
    for (const uint32_t corners : {4u, 20u, 33u})
        for (const uint32_t edges : {4u, 9u, 33u})
            for (const uint32_t occluders : {1u, 3u, 8u}) {
                const AreaSizes room = roomFor({.outlineCorners = corners, .silhouetteEdges = edges, .occluders = occluders}, kNoLimit);
                EXPECT_GE(room.outlineCorners, corners);
                EXPECT_GE(room.silhouetteEdges, edges);
                EXPECT_GE(room.occluders, occluders);
            }
}

TEST(AreaRoom, GivesUpOccludersOneByOneWhereThereIs)
{
    const AreaSizes asked{.outlineCorners = 20, .silhouetteEdges = 16, .occluders = 8};
    const AreaSizes whole = roomFor(asked, kNoLimit);
    EXPECT_EQ(roomFor(asked, threadBytes(whole)), whole);
    const AreaSizes less = roomFor(asked, threadBytes(whole) - 1);
    EXPECT_EQ(less.occluders, whole.occluders - 1);
    EXPECT_LT(threadBytes(less), threadBytes(whole));
    EXPECT_EQ(less.outlineCorners, whole.outlineCorners);
}

TEST(AreaRoom, KeepsOneOccluder) { EXPECT_EQ(roomFor({.silhouetteEdges = 64, .occluders = 8}, 1).occluders, 1u); }

TEST(AreaRoom, PaysForNoMoreOccludersThanThereAre)
{
    EXPECT_LT(threadBytes(roomFor({.occluders = 1}, kNoLimit)), threadBytes(roomFor({.occluders = 8}, kNoLimit)));
}

} // namespace
} // namespace antumbra::render
