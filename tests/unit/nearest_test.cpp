#include "base/nearest.h"

#include <gtest/gtest.h>

namespace antumbra {
namespace {

constexpr std::string_view kFruit[] = {"apple", "pear", "plum"};

TEST(NearestWord, IsTheWordItselfWhereKnown) { EXPECT_EQ(nearestWord("pear", kFruit), "pear"); }

TEST(NearestWord, AllowsForAMissingAWrongAndAnAddedLetter)
{
    EXPECT_EQ(nearestWord("aple", kFruit), "apple");
    EXPECT_EQ(nearestWord("plim", kFruit), "plum");
    EXPECT_EQ(nearestWord("spear", kFruit), "pear");
}

TEST(NearestWord, OfNothingIsTheShortest) { EXPECT_EQ(nearestWord("", kFruit), "pear"); }

} // namespace
} // namespace antumbra
