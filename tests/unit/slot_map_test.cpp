#include "base/slot_map.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <string>

namespace {

using antumbra::SlotMap;
using Texts = SlotMap<std::string>;

TEST(SlotMap, FindsWhatWasInserted)
{
    Texts texts;
    const Texts::Id first = texts.insert("first");
    const Texts::Id second = texts.insert("second");
    EXPECT_EQ(texts[first], "first");
    EXPECT_EQ(texts[second], "second");
    EXPECT_EQ(texts.size(), 2u);
}

TEST(SlotMap, TheDefaultIdIsNull)
{
    Texts texts;
    EXPECT_FALSE(Texts::Id{});
    EXPECT_FALSE(texts.contains({}));
    const Texts::Id id = texts.insert("x");
    EXPECT_TRUE(id);
    EXPECT_FALSE(texts.contains({}));
}

TEST(SlotMap, AnIdOutlivesItsValueAndNeverFindsAnothers)
{
    Texts texts;
    const Texts::Id old = texts.insert("old");
    EXPECT_TRUE(texts.erase(old));
    EXPECT_FALSE(texts.erase(old));
    const Texts::Id fresh = texts.insert("fresh");
    EXPECT_EQ(fresh.index, old.index);
    EXPECT_FALSE(texts.contains(old));
    EXPECT_EQ(texts[fresh], "fresh");
}

TEST(SlotMap, HoldsMoveOnlyValues)
{
    SlotMap<std::unique_ptr<int>> owners;
    const auto first = owners.insert(std::make_unique<int>(1));
    const auto second = owners.insert(std::make_unique<int>(2));
    owners.erase(first);
    EXPECT_EQ(*owners[second], 2);
}

TEST(SlotMapDeathTest, RefusesDeadIds)
{
    Texts texts;
    const Texts::Id id = texts.insert("x");
    texts.erase(id);
    EXPECT_DEATH((void)texts[id], "alive");
}

TEST(SlotMap, AgreesWithAMapOverRandomOperations)
{
    SlotMap<uint32_t> values;
    std::map<uint64_t, uint32_t> model;
    std::vector<SlotMap<uint32_t>::Id> ids;
    std::mt19937 random(7);
    const auto keyOf = [](SlotMap<uint32_t>::Id id) { return uint64_t{id.generation} << 32 | id.index; };
    for (uint32_t i = 0; i < 20'000; ++i) {
        if (ids.empty() || random() % 2 == 0) {
            ids.push_back(values.insert(i));
            ASSERT_TRUE(model.emplace(keyOf(ids.back()), i).second) << "the id was in use";
        } else {
            const auto id = ids[random() % ids.size()];
            ASSERT_EQ(values.erase(id), model.erase(keyOf(id)) == 1);
        }
    }
    ASSERT_EQ(values.size(), model.size());
    for (const auto id : ids) {
        const auto expected = model.find(keyOf(id));
        ASSERT_EQ(values.contains(id), expected != model.end());
        if (expected != model.end()) {
            ASSERT_EQ(values[id], expected->second);
        }
    }
}

} // namespace
