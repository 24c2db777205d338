// shaders/lib/surface.glsl, compose.glsl, tone.glsl, float21.glsl and whole.glsl on the device: what must hold of every pixel.
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"

namespace antumbra {
namespace {

using glm::dvec3;

constexpr size_t kCount = 100000;
constexpr std::string_view kKernel = "lib_functions.comp";

class LibPicture : public DeviceTest
{
};

struct SurfaceIn
{
    vec3 position, normal, eye;
};
struct SurfaceOut
{
    vec3 origin;
    float error;
};

TEST_F(LibPicture, RaysLeaveOnTheOuterSideOfTheSurface)
{
    RandomInputs random(5);
    std::vector<SurfaceIn> inputs(kCount);
    for (SurfaceIn& in : inputs)
        in = {vec3(random.direction() * random.logUniform(1e-3, 1e5)), vec3(random.direction()),
              vec3(random.direction() * random.logUniform(1e-3, 1e5))};
    const std::vector<SurfaceOut> outputs = runKernel<SurfaceOut>(device(), kKernel, "RAY_ORIGIN", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 step = dvec3(outputs[i].origin) - dvec3(inputs[i].position);
        const double magnitude = std::max(glm::length(dvec3(inputs[i].position)), glm::length(dvec3(inputs[i].eye)));
        ASSERT_GT(outputs[i].error, 0.5e-6 * magnitude) << i;
        ASSERT_GT(glm::dot(step, dvec3(inputs[i].normal)), outputs[i].error) << i;
        ASSERT_LT(glm::length(step), 2e-5 * magnitude + 1e-5) << i;
    }
}

TEST_F(LibPicture, RayOriginsAreFinite)
{
    std::vector<SurfaceIn> inputs;
    for (const float a : {0.0f, 1e-40f, 1.0f, 1e18f})
        for (const float b : {0.0f, -1e-40f, 1.0f, -1e18f})
            inputs.push_back({{a, b, a}, {0, 0, 1}, {b, b, a}});
    for (const SurfaceOut& out : runKernel<SurfaceOut>(device(), kKernel, "RAY_ORIGIN", inputs))
        EXPECT_TRUE(std::isfinite(out.origin.x + out.origin.y + out.origin.z + out.error));
}

TEST_F(LibPicture, ShadowedIrradianceStaysBetweenNothingAndTheFirstTerm)
{
    struct In
    {
        vec3 firstTerm, occluded;
    };
    struct Out
    {
        vec3 shadowed;
        uint32_t isClamped;
    };
    RandomInputs random(6);
    std::vector<In> inputs(kCount);
    for (In& in : inputs)
        in = {vec3(random.direction() * random.logUniform(1e-6, 1e6)) + 0.5f, vec3(random.direction() * random.logUniform(1e-6, 1e6))};
    const std::vector<Out> outputs = runKernel<Out>(device(), kKernel, "COMPOSE", inputs);
    for (size_t i = 0; i < inputs.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float first = std::max(inputs[i].firstTerm[c], 0.0f), left = inputs[i].firstTerm[c] - inputs[i].occluded[c];
            ASSERT_FLOAT_EQ(outputs[i].shadowed[c], std::clamp(left, 0.0f, first)) << i;
            // A first term below nothing is ringing of its own, not the occlusion's.
            if (outputs[i].isClamped == 0 && inputs[i].firstTerm[c] >= 0) {
                ASSERT_NEAR(outputs[i].shadowed[c], left, 1.01e-3 * std::abs(inputs[i].firstTerm[c]) + 1.01e-6) << i;
            }
        }
}

struct ToneOut
{
    vec3 mapped, encoded;
};

TEST_F(LibPicture, MoreRadianceIsNeverShownDarker)
{
    constexpr size_t kSteps = 2000;
    std::vector<vec3> inputs;
    for (const vec3 color : {vec3(1), vec3(1, 0.5f, 0.1f), vec3(0.02f, 0.9f, 0.3f), vec3(1, 0, 0), vec3(0, 0, 1), vec3(0.3f, 0.29f, 0.31f)})
        for (size_t i = 0; i < kSteps; ++i)
            inputs.push_back(color * std::exp(-12.0f + 24.0f * static_cast<float>(i) / kSteps));
    const std::vector<ToneOut> outputs = runKernel<ToneOut>(device(), kKernel, "TONE", inputs);
    const auto peak = [](const vec3& v) { return std::max({v.x, v.y, v.z}); };
    for (size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_GE(std::min({outputs[i].mapped.x, outputs[i].mapped.y, outputs[i].mapped.z}), 0.0f) << i;
        ASSERT_LE(peak(outputs[i].mapped), 1.0f + 1e-6f) << i;
        if (i % kSteps != 0) {
            ASSERT_GE(peak(outputs[i].mapped), peak(outputs[i - 1].mapped) - 1e-6f) << i;
        }
        for (int c = 0; c < 3; ++c) {
            const double linear = outputs[i].mapped[c];
            ASSERT_NEAR(outputs[i].encoded[c], linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055, 2e-5) << i;
        }
    }
}

TEST_F(LibPicture, ToneMappingIsFinite)
{
    const std::vector<vec3> inputs{vec3(0),  vec3(1e-40f),          vec3(1e18f), vec3(1e18f, 0, 0), vec3(0, 1e-40f, 1e18f),
                                   vec3(-1), vec3(-1e18f, 1, 1e18f)};
    for (const ToneOut& out : runKernel<ToneOut>(device(), kKernel, "TONE", inputs))
        for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(std::isfinite(out.mapped[c]) && std::isfinite(out.encoded[c]));
}

TEST_F(LibPicture, Floats21KeepTwelveBits)
{
    RandomInputs random(17);
    std::vector<vec3> inputs{vec3(0), vec3(65504), vec3(-65504, 1e-30f, -0.0f), vec3(1, 2, 3)};
    while (inputs.size() < kCount)
        inputs.emplace_back(random.direction() * random.logUniform(1e-6, 6e4));
    const std::vector<vec3> outputs = runKernel<vec3>(device(), kKernel, "FLOATS_21", inputs);
    for (size_t i = 0; i < inputs.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_LE(std::abs(outputs[i][c] - inputs[i][c]), 1.3e-4f * std::abs(inputs[i][c])) << i << ' ' << c;
}

TEST_F(LibPicture, WholePartsAreRoundedDown)
{
    RandomInputs random(18);
    constexpr float kEnd = 4194304; // 2^22
    std::vector<vec3> inputs{{0, -0.0f, 1}, {0.99999994f, 1e-38f, -1e-38f}, {-kEnd, kEnd - 0.5f, kEnd - 1}, {-0.5f, -1, -1.5f}};
    while (inputs.size() < kCount)
        inputs.emplace_back(random.direction() * random.logUniform(1e-3, 4e6));
    const std::vector<ivec3> outputs = runKernel<ivec3>(device(), kKernel, "WHOLE_OF", inputs);
    for (size_t i = 0; i < inputs.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_EQ(outputs[i][c], static_cast<int>(std::floor(inputs[i][c]))) << inputs[i][c];
}

} // namespace
} // namespace antumbra
