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
constexpr size_t kConeCount = 80000; // times the samples: ten million tests

// A corner of a cell or a point of its border, a hair to either side: there the axis is farthest from the cell's middle.
vec3 borderAxis(RandomInputs& random)
{
    const auto border = [&] {
        return -1 + 2.0 * random.index(shader::kMaskAxisCells + 1) / shader::kMaskAxisCells + random.uniform(-1e-5, 1e-5);
    };
    const double x = std::clamp(border(), -1.0, 1.0), y = random.index(2) == 0 ? std::clamp(border(), -1.0, 1.0) : random.uniform(-1, 1);
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z >= 0)
        return vec3(glm::normalize(dvec3(x, y, z)));
    return vec3(glm::normalize(dvec3(std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), z)));
}

vec3 anyAxis(RandomInputs& random, const std::vector<vec3>& awkward)
{
    switch (random.index(4)) {
    case 0: return awkward[random.index(static_cast<uint32_t>(awkward.size()))];
    case 1: return vec3(random.direction());
    default: return borderAxis(random);
    }
}

// Half angles near nothing and near pi/2, on the borders of cells, and such that the cone just reaches a sample.
double anySine(RandomInputs& random, const dvec3& axis, const std::vector<vec4>& samples)
{
    switch (random.index(8)) {
    case 0: return random.index(shader::kMaskAngleCells + 1) / double{shader::kMaskAngleCells};
    case 1: return random.logUniform(1e-6, 1);
    case 2: return 1 - random.logUniform(1e-7, 1);
    default: break;
    }
    const dvec3 sample(samples[random.index(static_cast<uint32_t>(samples.size()))]);
    return glm::dot(axis, sample) > 0 ? std::min(glm::length(glm::cross(axis, sample)) + 2e-6, 1.0) : random.uniform(0, 1);
}

std::vector<In> cones(const std::vector<vec4>& samples)
{
    RandomInputs random(4);
    const std::vector<vec3> awkward = awkwardDirections();
    std::vector<In> inputs(kConeCount);
    for (In& in : inputs) {
        in.axis = anyAxis(random, awkward);
        in.sine = static_cast<float>(anySine(random, dvec3(in.axis), samples));
    }
    return inputs;
}

class LibMaskTable : public DeviceTest
{
};

TEST_F(LibMaskTable, HoldsEverySampleOfEveryCone)
{
    const std::vector<vec4> samples = render::hemisphereSamples(kSampleCount);
    const std::vector<uint32_t> table = render::maskTable(samples);
    const std::vector<In> inputs = cones(samples);
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
