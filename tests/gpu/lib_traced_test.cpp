// shaders/lib/traced.glsl on the device: what a texel keeps of a traced pixel, and what surfaces that face elsewhere make of it.
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"

namespace antumbra {
namespace {

using glm::dvec3;

struct In
{
    vec3 irradiance, towards, normal, otherNormal;
    float depthView;
    uint32_t cones;
};
struct Out
{
    vec3 own, other, normal;
    float depthView;
    uint32_t cones;
};

class LibTraced : public DeviceTest
{
protected:
    std::vector<Out> run(const std::vector<In>& inputs) { return runKernel<Out>(device(), "lib_functions.comp", "TRACED_PIXEL", inputs); }
};

double sumOf(const vec3& channels) { return double{channels.x} + double{channels.y} + double{channels.z}; }

std::vector<In> randomInputs()
{
    RandomInputs random(3);
    std::vector<In> inputs(100000);
    for (In& in : inputs) {
        const double scale = random.logUniform(1e-2, 1e3);
        in.irradiance = vec3(scale * dvec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)));
        in.towards = vec3(random.direction());
        in.normal = vec3(random.direction());
        in.otherNormal = vec3(random.direction());
        in.depthView = static_cast<float>(random.logUniform(1e-3, 1e6));
        in.cones = static_cast<uint32_t>(random.index(1200));
    }
    return inputs;
}

TEST_F(LibTraced, ATexelKeepsThePixel)
{
    const std::vector<In> inputs = randomInputs();
    const std::vector<Out> outs = run(inputs);
    double light = 0, direction = 0, depth = 0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const In& in = inputs[i];
        light = std::max(light, glm::distance(dvec3(outs[i].own), dvec3(in.irradiance)) / sumOf(in.irradiance));
        direction = std::max(direction, glm::distance(dvec3(outs[i].normal), dvec3(in.normal)));
        depth = std::max(depth, std::abs(double{outs[i].depthView} / double{in.depthView} - 1));
        ASSERT_EQ(outs[i].cones, std::min(in.cones, 1023u));
    }
    EXPECT_LT(light, 3e-3);
    EXPECT_LT(direction, 1.5e-3);
    EXPECT_LT(depth, 1.3e-4);
}

// By the cosines to the middle of what hides light; where that lies along the horizon nobody lacks more than about three times as much.
TEST_F(LibTraced, SurfacesThatFaceElsewhereLackByTheirCosine)
{
    const std::vector<In> inputs = randomInputs();
    const std::vector<Out> outs = run(inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const In& in = inputs[i];
        const double cosine = glm::dot(dvec3(in.towards), dvec3(in.normal)), other = glm::dot(dvec3(in.towards), dvec3(in.otherNormal));
        const double sum = sumOf(in.irradiance), found = sumOf(outs[i].other);
        if (cosine > 0) {
            ASSERT_LE(found, 3.3 * sum) << i;
        }
        if (cosine > 0.34) {
            ASSERT_NEAR(found, sum * std::max(other / cosine, 0.0), 5e-3 * sum) << i;
        }
    }
}

TEST_F(LibTraced, WhereNothingIsHiddenOrSeenNothingIs)
{
    const vec3 up(0, 1, 0);
    const std::vector<Out> outs =
        run({{vec3(0), up, up, up, 0, 0}, {vec3(60000), up, up, up, 1, 0}, {vec3(1), -up, up, vec3(1, 0, 0), 1, 0}});
    EXPECT_EQ(outs[0].own, vec3(0));
    EXPECT_EQ(outs[0].depthView, 0);
    EXPECT_LE(sumOf(outs[1].own), 65504 * 1.001) << "no more than a half holds";
    EXPECT_TRUE(std::isfinite(sumOf(outs[2].own)) && std::isfinite(sumOf(outs[2].other))) << "hidden from behind";
}

} // namespace
} // namespace antumbra
