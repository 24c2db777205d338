// shaders/lib/hemisphere.glsl, octahedral.glsl and sh.glsl on the device against the same in double.
#include "bake/sh.h"
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"
#include "render/shadow/samples.h"

#include <algorithm>

namespace antumbra {
namespace {

using glm::dvec3;

constexpr size_t kCount = 100000;
constexpr std::string_view kKernel = "lib_functions.comp";

std::vector<vec3> directions()
{
    std::vector<vec3> directions = awkwardDirections();
    RandomInputs random(3);
    while (directions.size() < kCount)
        directions.emplace_back(random.direction());
    return directions;
}

class LibHemisphere : public DeviceTest
{
};

TEST_F(LibHemisphere, OctahedralRoundTripIsGoodToRounding)
{
    struct Out
    {
        vec2 square;
        vec3 direction;
    };
    const std::vector<vec3> inputs = directions();
    const std::vector<Out> outputs = runKernel<Out>(device(), kKernel, "OCTAHEDRAL", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_LE(std::max(std::abs(outputs[i].square.x), std::abs(outputs[i].square.y)), 1.0f) << i;
        ASSERT_LT(glm::distance(dvec3(outputs[i].direction), dvec3(inputs[i])), 4e-7) << i;
    }
}

TEST_F(LibHemisphere, FramesAreOrthonormalAndRightHanded)
{
    struct In
    {
        vec3 normal;
        float radians;
    };
    std::vector<In> inputs;
    for (const vec3& normal : directions())
        inputs.push_back({normal, static_cast<float>(inputs.size() % 7)});
    inputs.push_back({{0, 0, -1}, 0});
    const std::vector<mat3> outputs = runKernel<mat3>(device(), kKernel, "TANGENT_FRAME", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const glm::dmat3 frame(outputs[i]), product = glm::transpose(frame) * frame;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                ASSERT_NEAR(product[column][row], row == column ? 1 : 0, 1e-6) << i;
        ASSERT_NEAR(glm::determinant(frame), 1, 1e-6) << i;
        ASSERT_EQ(outputs[i][2], inputs[i].normal) << i;
    }
}

TEST_F(LibHemisphere, TheHostHasTheSameSamples)
{
    for (const uint32_t count : {32u, 128u, 1024u, 4096u}) {
        std::vector<uvec2> inputs;
        for (uint32_t i = 0; i < count; ++i)
            inputs.emplace_back(i, count);
        std::vector<vec3> onDevice = runKernel<vec3>(device(), kKernel, "HAMMERSLEY", inputs);
        std::vector<vec3> onHost = render::hemisphereSamples(count);
        ASSERT_EQ(onHost.size(), count);
        // Every height is there once, so it tells which sample is which; the host keeps them in another order.
        std::ranges::sort(onDevice, {}, &vec3::z);
        std::ranges::sort(onHost, {}, &vec3::z);
        for (uint32_t i = 0; i < count; ++i)
            ASSERT_LT(glm::distance(onDevice[i], onHost[i]), 2e-4f) << i << " of " << count;
    }
}

TEST_F(LibHemisphere, SphericalHarmonicsMatchTheBake)
{
    const std::vector<vec3> inputs = directions();
    const auto outputs = runKernel<std::array<float, 25>>(device(), kKernel, "SH_BASIS", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const bake::ShBasis expected = bake::shBasis(dvec3(inputs[i]));
        for (size_t k = 0; k < outputs[i].size(); ++k)
            ASSERT_NEAR(outputs[i][k], expected[k], k < 16 ? 4e-7 : 1e-6)
                << i << ' ' << k; // the fifth band: terms of 35 times 0.11, rounded
    }
}

} // namespace
} // namespace antumbra
