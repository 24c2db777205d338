#include "bake/packing.h"

#include "bake/overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace antumbra::bake {

TEST(FlatTriangles, TouchButDoNotOverlap)
{
    FlatTriangles taken(vec2(0), vec2(4), 8);
    EXPECT_TRUE(taken.add({vec2(0, 0), vec2(2, 0), vec2(0, 2)}));
    EXPECT_TRUE(taken.add({vec2(2, 0), vec2(2, 2), vec2(0, 2)}));
    EXPECT_TRUE(taken.add({vec2(2, 2), vec2(2, 0), vec2(4, 1)})) << "half an edge in common";
    EXPECT_FALSE(taken.add({vec2(2, 0), vec2(2, 2), vec2(0, 2)})) << "the same again";
    EXPECT_FALSE(taken.add({vec2(0, 2), vec2(2, 2), vec2(2, 0)})) << "turned over";
    EXPECT_FALSE(taken.add({vec2(0.5f, 0.5f), vec2(0.6f, 0.5f), vec2(0.5f, 0.6f)})) << "inside";
    EXPECT_FALSE(taken.add({vec2(-1, -1), vec2(9, -1), vec2(-1, 9)})) << "around";
    EXPECT_TRUE(taken.add({vec2(4, 4), vec2(3, 4), vec2(4, 3)}));
}

TEST(Packing, KeepsRectanglesApart)
{
    std::mt19937 random(5);
    std::vector<uvec2> rectangles(500);
    for (uvec2& rectangle : rectangles)
        rectangle = {1 + random() % 40, 1 + random() % 12};
    const std::optional<Packing> packing = pack(rectangles, 512);
    ASSERT_TRUE(packing);
    std::vector<uint8_t> page(size_t{packing->page.x} * packing->page.y);
    for (size_t i = 0; i < rectangles.size(); ++i)
        for (uint32_t y = 0; y < rectangles[i].y; ++y)
            for (uint32_t x = 0; x < rectangles[i].x; ++x) {
                const uvec2 place = packing->corners[i] + uvec2(x, y);
                ASSERT_TRUE(place.x < packing->page.x && place.y < packing->page.y);
                ASSERT_EQ(page[size_t{place.y} * packing->page.x + place.x]++, 0);
            }
    EXPECT_GT(static_cast<double>(std::ranges::count(page, 1)) / static_cast<double>(page.size()), 0.9);
    EXPECT_FALSE(pack(rectangles, 128));
    EXPECT_FALSE(fits(rectangles, 128));
    EXPECT_TRUE(fits(rectangles, 512));
}

} // namespace antumbra::bake
