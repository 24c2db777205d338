// The mask table as the device looks it up: no sample of a cone may be missing from its cell, wherever the axis lies.
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"
#include "render/shader_structs.h"
#include "render/shadow/mask_table.h"

namespace antumbra {
namespace {

using glm::dvec3;

struct In
{
    vec3 axis;
    float sine;
};

constexpr uint32_t kSampleCount = 128;
constexpr size_t kConeCount = 20000; // times the samples: 2.56 million tests

// Axes at random, on folds and poles, and on the borders between cells; half angles at random, on borders, near nothing and near pi/2.
std::vector<In> cones()
{
    RandomInputs random(4);
    const std::vector<vec3> awkward = awkwardDirections();
    const auto axis = [&]() -> vec3 {
        if (random.index(3) == 0)
            return awkward[random.index(static_cast<uint32_t>(awkward.size()))];
        if (random.index(2) == 0)
            return vec3(random.direction());
        const dvec3 v(-1 + 2.0 * random.index(shader::kMaskAxisCells) / shader::kMaskAxisCells, random.uniform(-1, 1), 0);
        const double z = 1 - std::abs(v.x) - std::abs(v.y);
        return vec3(glm::normalize(z >= 0 ? dvec3(v.x, v.y, z) : dvec3(1 - std::abs(v.y), 1 - std::abs(v.x), z)));
    };
    const auto sine = [&]() -> double {
        switch (random.index(4)) {
        case 0: return random.index(shader::kMaskAngleCells + 1) / double{shader::kMaskAngleCells};
        case 1: return random.logUniform(1e-6, 1);
        case 2: return 1 - random.logUniform(1e-7, 1);
        default: return std::sin(random.uniform(0, std::numbers::pi / 2));
        }
    };
    std::vector<In> inputs(kConeCount);
    for (In& in : inputs)
        in = {axis(), static_cast<float>(sine())};
    return inputs;
}

class LibMaskTable : public DeviceTest
{
};

TEST_F(LibMaskTable, HoldsEverySampleOfEveryCone)
{
    const std::vector<vec4> samples = render::hemisphereSamples(kSampleCount);
    const std::vector<uint32_t> table = render::maskTable(samples);
    const std::vector<In> inputs = cones();
    const std::vector<uint32_t> cells = runKernel<uint32_t>(device(), "lib_functions.comp", "MASK_CELL", inputs);
    uint64_t inside = 0, candidates = 0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_LT(cells[i] * size_t{kSampleCount / 32}, table.size()) << i;
        const uint32_t* mask = &table[cells[i] * size_t{kSampleCount / 32}];
        const dvec3 axis = glm::normalize(dvec3(inputs[i].axis));
        const double chord = 2 * std::sin(0.5 * std::asin(double{inputs[i].sine}));
        for (uint32_t s = 0; s < kSampleCount; ++s) {
            const bool isInside = glm::distance(axis, glm::normalize(dvec3(samples[s]))) <= chord;
            const bool isCandidate = (mask[s / 32] >> s % 32 & 1u) != 0;
            inside += isInside ? 1 : 0;
            candidates += isCandidate ? 1 : 0;
            ASSERT_TRUE(isCandidate || !isInside) << "cone " << i << ", sample " << s;
        }
    }
    // A table of ones would miss nothing either.
    EXPECT_GT(inside, kConeCount);
    EXPECT_LT(static_cast<double>(candidates), 2.0 * static_cast<double>(inside));
}

} // namespace
} // namespace antumbra
