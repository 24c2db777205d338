#include "scene/mean_albedo.h"

#include <gtest/gtest.h>

namespace antumbra::scene {
namespace {

void expectNear(vec3 value, vec3 expected, float tolerance)
{
    EXPECT_LT(glm::length(value - expected), tolerance) << value.x << " " << value.y << " " << value.z;
}

TEST(MeanAlbedo, OfOneMaterialIsItsOwn)
{
    expectNear(meanAlbedo(rigidModel("cube", makeCube(), {.albedo = {0.1f, 0.5f, 0.9f}})), {0.1f, 0.5f, 0.9f}, 1e-6f);
}

TEST(MeanAlbedo, WeighsByArea)
{
    Mesh mesh = makePlane();
    for (vec3& position : mesh.positions)
        if (position.x > 0)
            position.x = 1.5f; // two square metres
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const vec3 corner : {vec3(0, 1, 0), vec3(0, 1, 2), vec3(2, 1, 0)}) { // two more
        mesh.positions.push_back(corner);
        mesh.normals.emplace_back(0, 1, 0);
        mesh.uvs.emplace_back(0);
    }
    for (const uint32_t corner : {0u, 1u, 2u})
        mesh.indices.push_back(first + corner);
    mesh.triangleMaterials.push_back(1);
    Model model = rigidModel("two", mesh, {.albedo = vec3(0.2f)});
    model.materials.push_back({.albedo = vec3(0.6f)});
    expectNear(meanAlbedo(model), vec3(0.4f), 1e-6f);
}

TEST(MeanAlbedo, TakesThePicturesMeanInLinearLight)
{
    Model model = rigidModel("plane", makePlane(), {.albedo = {1, 0.5f, 1}, .albedoImage = 0});
    model.images.push_back({2, 1, {255, 255, 255, 255, 0, 0, 188, 255}});
    expectNear(meanAlbedo(model), {0.5f, 0.25f, 0.5f + 0.5f * srgbDecoded(188 / 255.0f)}, 1e-6f);
}

TEST(MeanAlbedo, IsBlackWithoutArea)
{
    Mesh mesh = makePlane();
    for (vec3& position : mesh.positions)
        position = vec3(std::numeric_limits<float>::quiet_NaN());
    expectNear(meanAlbedo(rigidModel("nothing", mesh, {})), vec3(0), 1e-6f);
}

} // namespace
} // namespace antumbra::scene
