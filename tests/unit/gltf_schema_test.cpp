#include "scene/gltf_schema.h"

#include <gtest/gtest.h>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

constexpr Property kLeaf[] = {{"size", number().above(0).upTo(1).required()}};
constexpr Property kOtherPlace[] = {{"size", number()}};
constexpr Property kTree[] = {
    {"kind", text().among("oak elm").selecting("elm")},
    {"elm", boolean().excluding("oak")},
    {"oak", boolean().needing("kind")},
    {"count", integer().from(1)},
    {"leaves", arrayOf(object(kLeaf), 1, 3)},
    {"best", indexInto("/leaves")},
    {"paths", arrayOf(indexInto("/leaves")).distinct()},
    {"named", mapOf(indexInto("/leaves"))},
    {"variants", arrayOfMapsOf(indexInto("/leaves"))},
    {"spare", object(kOtherPlace)},
};
constexpr Extension kKnown[] = {{"KNOWN", kTree, kLeaf}};

std::string complaintAbout(const char* json)
{
    Json root = Json::parse(json);
    try {
        checkShape(root, kTree, kKnown);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(GltfSchema, AcceptsWhatFits)
{
    EXPECT_EQ(complaintAbout("{}"), "");
    EXPECT_EQ(complaintAbout(R"({"unknown": [1, "a", null]})"), "");
    EXPECT_EQ(complaintAbout(R"({"kind": "oak", "oak": true, "count": 3, "leaves": [{"size": 1}], "best": 0, "named": {"a": 0}})"), "");
    EXPECT_EQ(complaintAbout(R"({"extensions": {"KNOWN": {"size": 1}, "OTHER": {}}})"), "");
}

TEST(GltfSchema, NamesThePlaceAndTheFault)
{
    EXPECT_EQ(complaintAbout("[]"), "the document must be an object");
    EXPECT_EQ(complaintAbout(R"({"count": "1"})"), "count must be an integer");
    EXPECT_EQ(complaintAbout(R"({"count": 0.5})"), "count must be an integer");
    EXPECT_EQ(complaintAbout(R"({"count": null})"), "count must be an integer");
    EXPECT_EQ(complaintAbout(R"({"count": 0})"), "count is 0, out of range");
    EXPECT_EQ(complaintAbout(R"({"kind": "ash"})"), "kind is ash, which is none of: oak elm");
    EXPECT_EQ(complaintAbout(R"({"leaves": []})"), "leaves must not be empty");
    EXPECT_EQ(complaintAbout(R"({"leaves": {}})"), "leaves must be an array");
    EXPECT_EQ(complaintAbout(R"({"leaves": [{"size": 1}, 7]})"), "leaves[1] must be an object");
    EXPECT_EQ(complaintAbout(R"({"leaves": [{"size": 1}, {}]})"), "leaves[1].size is missing");
    EXPECT_EQ(complaintAbout(R"({"leaves": [{"size": 0}]})"), "leaves[0].size is 0, out of range");
    EXPECT_EQ(complaintAbout(R"({"leaves": [{"size": 1}, {"size": 1}, {"size": 1}, {"size": 1}]})"), "leaves has too many elements");
    EXPECT_EQ(complaintAbout(R"({"name": 3})"), "name must be a text");
}

TEST(GltfSchema, IndicesMustMeetTheirArray)
{
    EXPECT_EQ(complaintAbout(R"({"best": 0})"), "best is 0, but /leaves has 0 elements");
    EXPECT_EQ(complaintAbout(R"({"best": 1, "leaves": [{"size": 1}]})"), "best is 1, but /leaves has 1 elements");
    EXPECT_EQ(complaintAbout(R"({"best": -1, "leaves": [{"size": 1}]})"), "best is -1, out of range");
    EXPECT_EQ(complaintAbout(R"({"paths": [0, 0], "leaves": [{"size": 1}]})"), "paths has an element twice");
    EXPECT_EQ(complaintAbout(R"({"named": {"a": 4}, "leaves": [{"size": 1}]})"), "named.a is 4, but /leaves has 1 elements");
    EXPECT_EQ(complaintAbout(R"({"variants": [{}], "leaves": [{"size": 1}]})"), "variants[0] must not be empty");
}

TEST(GltfSchema, SiblingsDependOnEachOther)
{
    EXPECT_EQ(complaintAbout(R"({"kind": "elm"})"), "kind is \"elm\" and needs the property of that name");
    EXPECT_EQ(complaintAbout(R"({"oak": true})"), "oak needs kind beside it");
    EXPECT_EQ(complaintAbout(R"({"kind": "oak", "oak": true, "elm": true})"), "elm excludes oak beside it");
}

TEST(GltfSchema, ExtensionsBelongSomewhere)
{
    EXPECT_EQ(complaintAbout(R"({"extensions": {"OTHER": 3}})"), "extensions.OTHER must be an object");
    EXPECT_EQ(complaintAbout(R"({"extensions": {"KNOWN": {}}})"), "extensions.KNOWN.size is missing");
    EXPECT_EQ(complaintAbout(R"({"spare": {"extensions": {"KNOWN": {"size": 1}}}})"), "spare.extensions.KNOWN does not belong here");
}

TEST(GltfSchema, IntegersWrittenAsFloatsBecomeIntegers)
{
    Json root = Json::parse(R"({"count": 2.0})");
    checkShape(root, kTree, {});
    EXPECT_TRUE(root["count"].is_number_integer());
    EXPECT_EQ(root["count"], 2);
}
