// What of an area light's body is seen past a distance field, on the device: as the same light in other words.
#include "gpu/area_shapes.h"
#include "gpu/device_fixture.h"
#include "gpu/field_upload.h"
#include "gpu/kernel.h"
#include "render/body_blocks.h"

namespace antumbra {
namespace {

using scene::SDFShape;

struct LightAsk
{
    vec3 position;
    vec3 normal;
    uint32_t body;
    uint32_t cells;
    shader::BodyArrays arrays;
    shader::FieldsBlock fields;
};

/// At (0, 4, 0), its +Z down.
scene::ConvexBody overhead(const scene::ConvexBody& shape, const glm::dvec3& scale)
{
    return placed(shape, Placement{glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)), scale, {0, 4, 0}});
}

class FieldLight : public DeviceTest
{
protected:
    /// Along a line over a floor, into the shadow of a wall up to the plane x = 0.
    static constexpr int kSteps = 60;
    static vec3 pointAt(int step) { return {-1.5f + 3.0f * static_cast<float>(step) / kSteps, 0.001f, 0.1f}; }
    static FieldSteps wall()
    {
        return fieldOf({{.shape = SDFShape::Plane}, {.shape = SDFShape::Box, .centre = {2, 2, 0}, .halfExtent = {2, 0.3f, 9}}});
    }

    std::vector<FieldSaid> seenOf(const scene::ConvexBody& body, uint32_t flags, vec3 normal = {0, 1, 0})
    {
        render::BodyBlocks blocks;
        blocks.add(body, mat4{1}, flags);
        const gpu::Buffer buffers[] = {gpu::uploadedBuffer(device(), "bodies", std::span<const shader::BodyBlock>(blocks.bodies)),
                                       gpu::uploadedBuffer(device(), "vertices", std::span<const vec3>(blocks.vertices)),
                                       gpu::uploadedBuffer(device(), "faces", std::span<const shader::FaceBlock>(blocks.faces)),
                                       gpu::uploadedBuffer(device(), "corners", std::span<const uint32_t>(blocks.corners)),
                                       gpu::uploadedBuffer(device(), "edges", std::span<const shader::EdgeBlock>(blocks.edges))};
        const shader::BodyArrays arrays{buffers[0].address(), buffers[1].address(), buffers[2].address(), buffers[3].address(),
                                        buffers[4].address()};
        const FieldUpload field(device(), {wall()});
        std::vector<LightAsk> asks;
        for (int i = 0; i < kSteps; ++i)
            asks.push_back({pointAt(i), normal, 0, 8, arrays, field[0]});
        return runKernel<FieldSaid>(device(), "field_light.comp", "LIGHT", asks);
    }
};

TEST_F(FieldLight, AQuadsBodyIsSeenAsTheQuad)
{
    const std::vector<FieldSaid> body = seenOf(overhead(squareShape(), {1, 0.5, 1}), 0);
    const FieldUpload field(device(), {wall()});
    std::vector<CellsAsk> asks;
    for (int i = 0; i < kSteps; ++i)
        asks.push_back({pointAt(i), {0, 1, 0}, {-1, 4, -0.5f}, {2, 0, 0}, {0, 0, 1}, 8, field[0]});
    const std::vector<FieldSaid> quad = runKernel<FieldSaid>(device(), kFieldKernel, "CELLS", asks);
    for (int i = 0; i < kSteps; ++i)
        EXPECT_NEAR(body[i].value, quad[i].value, 0.02) << i; // cells may begin at another corner
}

TEST_F(FieldLight, ABallsBodyIsSeenAsTheBall)
{
    const std::vector<FieldSaid> body = seenOf(overhead(ballShape(1), glm::dvec3(0.8)), 0);
    const FieldUpload field(device(), {wall()});
    std::vector<FieldAsk> asks;
    for (int i = 0; i < kSteps; ++i)
        asks.push_back({pointAt(i), {0, 4, 0}, 0.79f, 16, field[0]});
    const std::vector<FieldSaid> ball = runKernel<FieldSaid>(device(), kFieldKernel, "SUB_CONES", asks);
    for (int i = 0; i < kSteps; ++i)
        EXPECT_NEAR(body[i].value, ball[i].value, 0.03) << i;
}

TEST_F(FieldLight, WhatDoesNotShineOnThePointIsNotHidden)
{
    for (const FieldSaid& each : seenOf(overhead(squareShape(), {1, 0.5, 1}), 0, {0, -1, 0}))
        EXPECT_EQ(each.value, 1);
    const scene::ConvexBody turned = placed(
        squareShape(), Placement{glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0)), glm::dvec3(1), {0, 4, 0}});
    for (const FieldSaid& each : seenOf(turned, 0))
        EXPECT_EQ(each.value, 1);
    const std::vector<FieldSaid> twoSided = seenOf(turned, shader::kBodyTwoSided);
    EXPECT_LT(twoSided.back().value, 0.1f);
}

} // namespace
} // namespace antumbra
