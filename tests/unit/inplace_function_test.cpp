#include "base/inplace_function.h"
#include "tests/unit/allocation_counter.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

namespace antumbra {
namespace {

using Sum = InplaceFunction<int(int), 64>;

TEST(InplaceFunction, CallsWhatItHolds)
{
    EXPECT_FALSE(Sum{});
    const Sum plusTwo = [two = 2](int x) { return x + two; };
    EXPECT_TRUE(plusTwo);
    EXPECT_EQ(plusTwo(3), 5);
}

TEST(InplaceFunction, PassesReferencesAndMoveOnlyValuesOn)
{
    int sum = 0;
    const InplaceFunction<void(int&, std::unique_ptr<int>), 16> add = [](int& to, std::unique_ptr<int> value) { to += *value; };
    add(sum, std::make_unique<int>(4));
    EXPECT_EQ(sum, 4);
}

TEST(InplaceFunction, MovesAndDestroysItsCallableOnce)
{
    const auto captured = std::make_shared<int>(1);
    {
        std::vector<Sum> sums;
        for (int i = 0; i < 9; ++i) // grows, and so moves
            sums.emplace_back([captured, i](int x) { return x + i + *captured; });
        EXPECT_EQ(captured.use_count(), 10);
        EXPECT_EQ(sums[5](0), 6);

        sums[5] = std::move(sums[7]);
        EXPECT_EQ(captured.use_count(), 9);
        EXPECT_EQ(sums[5](0), 8);
        EXPECT_FALSE(sums[7]);
    }
    EXPECT_EQ(captured.use_count(), 1);
}

TEST(InplaceFunction, NeverAllocates)
{
    const std::array<int, 12> values{1, 2, 3};
    const uint64_t before = test::allocationCount();
    Sum sum = [values](int x) { return x + values[2]; };
    const Sum moved = std::move(sum);
    EXPECT_EQ(moved(1), 4);
    EXPECT_EQ(test::allocationCount(), before);
}

TEST(InplaceFunctionDeath, AnEmptyOneIsNotCalled) { EXPECT_DEATH(Sum{}(1), "a function that holds a callable"); }

} // namespace
} // namespace antumbra
