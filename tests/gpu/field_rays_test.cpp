// Rays through distance fields: the boxes in the acceleration structure hide no group from them, and they go as far in a pool as alone.
#include "gpu/device_fixture.h"
#include "gpu/field_upload.h"
#include "gpu/kernel.h"
#include "gpu/traced_scene.h"
#include "render/field_boxes.h"

namespace antumbra {
namespace {

struct Ray
{
    uint64_t scene;
    vec3 origin;
    vec3 direction;
    float far;
    uint32_t padding;
    shader::FieldsBlock fields;
};

struct Found
{
    uvec2 asked, queried; // sets of groups
    vec2 askedWay, queriedWay;
    float alone, pooled; // how far it goes
};

constexpr uint32_t kPooled = 64; // rays

class FieldRays : public DeviceTest, public testing::WithParamInterface<uint32_t>
{
protected:
    void SetUp() override
    {
        DeviceTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure() && !device().info().rayQuery)
            GTEST_SKIP() << "the device has no ray queries";
    }

    std::vector<Found> trace(RandomInputs& random, const FieldSteps& steps, uint32_t rayCount)
    {
        const FieldUpload uploaded(device(), {steps});
        std::vector<shader::FieldGroupBlock> groups;
        render::writeGroups(steps, groups);
        std::vector<VkAabbPositionsKHR> boxes;
        render::writeBoxes(groups, boxes);
        const TracedScene scene(device(), boxes);
        std::vector<Ray> rays;
        for (uint32_t i = 0; i < rayCount; ++i) {
            // Every fourth along an axis, every eighth from afar.
            const vec3 along = i % 4 == 0 ? vec3(i % 3 == 0, i % 3 == 1, i % 3 == 2) : vec3(random.direction());
            const vec3 from = vec3(random.direction()) * static_cast<float>(random.uniform(0, i % 8 == 0 ? 1000 : 4));
            rays.push_back({scene.address(), from, along, static_cast<float>(random.logUniform(0.1, 1e4)), 0, uploaded[0]});
        }
        return runKernel<Found>(device(), "field_rays.comp", "FIELD_RAYS", rays);
    }
};

TEST_P(FieldRays, MeetTheSameByQueryAndGoAsFarTogetherAsAlone)
{
    RandomInputs random(GetParam());
    uint32_t metCount = 0;
    for (uint32_t field = 0; field < 12; ++field) {
        const std::vector<Found> found = trace(random, randomField(random, GetParam()), 16 * kPooled - 7);
        for (size_t i = 0; i < found.size(); ++i) {
            const Found& ray = found[i];
            EXPECT_EQ(ray.queried, ray.asked) << field << " " << i;
            EXPECT_EQ(ray.queriedWay, ray.askedWay) << field << " " << i;
            EXPECT_EQ(ray.pooled, ray.alone) << field << " " << i;
            metCount += ray.alone >= 0 ? 1 : 0;
        }
    }
    EXPECT_GT(metCount, 1000u);
}
INSTANTIATE_TEST_SUITE_P(Steps, FieldRays, testing::Values(1u, 12u, 120u, 300u), testing::PrintToStringParamName());

} // namespace
} // namespace antumbra
