#include "render/knobs.h"

#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace antumbra::render {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(std::string_view key, std::string_view value)
{
    Knobs knobs;
    try {
        set(knobs, key, value);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

std::string afterSetting(std::string_view key, std::string_view value)
{
    Knobs knobs;
    set(knobs, key, value);
    return get(knobs, key);
}

TEST(Knobs, KeysAreUniqueAndDocumented)
{
    std::set<std::string_view> keys;
    for (const KnobDescription& knob : knobTable()) {
        EXPECT_TRUE(keys.insert(knob.key).second) << knob.key;
        EXPECT_FALSE(knob.doc.empty()) << knob.key;
    }
}

TEST(Knobs, DefaultsReadBackToThemselves)
{
    for (const DeviceClass device : {DeviceClass::Cpu, DeviceClass::Gpu}) {
        for (const KnobDescription& knob : knobTable()) {
            Knobs knobs = defaultKnobs(device);
            const std::string value = get(knobs, knob.key);
            knob.write(knobs, knob.choices.empty() ? knob.range.greatest : knob.choices.back().value);
            set(knobs, knob.key, value);
            EXPECT_EQ(knob.read(knobs), knob.read(defaultKnobs(device))) << knob.key << '=' << value;
        }
    }
}

TEST(Knobs, TheBackendIsTheOneAskedForWhereTheDeviceHasIt)
{
    EXPECT_EQ(backendFor(RayBackend::Auto, true), RayBackend::RayQuery);
    EXPECT_EQ(backendFor(RayBackend::RayQuery, true), RayBackend::RayQuery);
    EXPECT_EQ(backendFor(RayBackend::ComputeBvh, true), RayBackend::ComputeBvh);
    for (const RayBackend wanted : {RayBackend::Auto, RayBackend::RayQuery, RayBackend::ComputeBvh})
        EXPECT_EQ(backendFor(wanted, false), RayBackend::ComputeBvh);
}

TEST(Knobs, EveryChoiceReachesItsOwnField)
{
    for (const KnobDescription& knob : knobTable())
        for (const KnobChoice& choice : knob.choices)
            EXPECT_EQ(afterSetting(knob.key, choice.name), choice.name) << knob.key;
}

TEST(Knobs, EndsOfEveryRangeAreInsideAndBeyondIsNot)
{
    for (const KnobDescription& knob : knobTable()) {
        if (!knob.choices.empty())
            continue;
        const auto& [least, greatest, step] = knob.range;
        const double beyond = step > 0 ? step : 0.001;
        EXPECT_NE(afterSetting(knob.key, std::to_string(least)), "") << knob.key;
        EXPECT_NE(afterSetting(knob.key, std::to_string(greatest)), "") << knob.key;
        EXPECT_THAT(refusal(knob.key, std::to_string(least - beyond)), HasSubstr("takes")) << knob.key;
        EXPECT_THAT(refusal(knob.key, std::to_string(greatest + beyond)), HasSubstr("takes")) << knob.key;
    }
}

TEST(Knobs, TypedFieldsFollowTheirKeys)
{
    Knobs knobs;
    set(knobs, "occlusion.culling", "length");
    set(knobs, "occlusion.scale", "1/4");
    set(knobs, "occlusion.samples", "1024");
    set(knobs, "occlusion.tolerance", "0.01");
    set(knobs, "reference.samples", "1e6");
    set(knobs, "view", "cones");
    EXPECT_EQ(knobs.occlusion.culling, Culling::Length);
    EXPECT_EQ(knobs.occlusion.scale, Scale::Quarter);
    EXPECT_EQ(knobs.occlusion.samples, 1024u);
    EXPECT_EQ(knobs.occlusion.tolerance, 0.01f);
    EXPECT_EQ(knobs.reference.samples, 1000000u);
    EXPECT_EQ(knobs.view, ViewMode::Cones);
}

TEST(Knobs, NumbersMayBeFractionsOrDecimals)
{
    EXPECT_EQ(afterSetting("occlusion.scale", "0.5"), "1/2");
    EXPECT_EQ(afterSetting("occlusion.scale", "2/8"), "1/4");
    EXPECT_EQ(afterSetting("occlusion.samples", "64.0"), "64");
    EXPECT_EQ(afterSetting("occlusion.tolerance", "1/100"), "0.01");
    EXPECT_EQ(afterSetting("reference.samples", "1000000"), "1000000");
}

TEST(Knobs, UnknownKeyNamesTheNearest)
{
    EXPECT_THAT(refusal("occlusion.sample", "64"), AllOf(HasSubstr("occlusion.sample:"), HasSubstr("nearest is occlusion.samples")));
    EXPECT_THROW(get(Knobs{}, "occlusion"), Error);
}

TEST(Knobs, RefusedValueNamesWhatIsAllowed)
{
    EXPECT_EQ(refusal("occlusion.samples", "2048"), "occlusion.samples: takes 32 to 1024, in steps of 32, not \"2048\"");
    EXPECT_EQ(refusal("crowd.count", "1.5"), "crowd.count: takes 1 to 200, a whole number, not \"1.5\"");
    EXPECT_EQ(refusal("occlusion.scale", "2"), "occlusion.scale: takes one of 1 1/2 1/4, not \"2\"");
    EXPECT_EQ(refusal("occlusion.tolerance", "1"), "occlusion.tolerance: takes 0 to 0.1, not \"1\"");
}

TEST(Knobs, GarbageIsRefusedEverywhere)
{
    for (const KnobDescription& knob : knobTable())
        for (const char* value : {"", " ", "nan", "inf", "-1", "1/0", "1/", "0x10", "1e999", "5 ", "Final", "64,5"})
            EXPECT_THAT(refusal(knob.key, value), HasSubstr("takes")) << knob.key << '=' << value;
}

TEST(Knobs, RefusedValueChangesNothing)
{
    Knobs knobs;
    set(knobs, "occlusion.samples", "64");
    EXPECT_THROW(set(knobs, "occlusion.samples", "65"), Error);
    EXPECT_EQ(knobs.occlusion.samples, 64u);
}

TEST(Knobs, CommandLineOverridesSceneFileOverridesDevice)
{
    EXPECT_EQ(resolveKnobs(DeviceClass::Cpu, {}, {}).occlusion.samples, 32u);
    EXPECT_EQ(resolveKnobs(DeviceClass::Gpu, {}, {}).occlusion.samples, 128u);
    const Settings scene{{"occlusion.samples", "256"}, {"occlusion.filter", "0"}};
    const Settings command{{"occlusion.samples", "32"}, {"occlusion.samples", "96"}};
    const Knobs knobs = resolveKnobs(DeviceClass::Cpu, scene, command);
    EXPECT_EQ(knobs.occlusion.samples, 96u);
    EXPECT_EQ(knobs.occlusion.filter, 0u);
    EXPECT_EQ(knobs.occlusion.scale, Scale::Quarter);
}

} // namespace
} // namespace antumbra::render
