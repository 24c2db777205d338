// The contract of a ray back-end (shaders/lib/ray_query.glsl, shaders/lib/bvh.glsl), kept by both, against a search through all triangles
// in double.
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"
#include "gpu/traced_scene.h"
#include "render/shader_structs.h"
#include "render/shadow/bvh.h"

#include <limits>

namespace antumbra {
namespace {

using glm::dvec3;
using render::RayBackend;
using shader::kMaskDynamic;
using shader::kMaskStatic;

constexpr float kFar = 1e30f;
constexpr double kNowhere = 1e30;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Ray
{
    uint64_t scene = 0;
    vec3 origin{0};
    vec3 direction{0, 0, 1};
    float far = kFar;
    uint32_t padding = 0;
};

struct Hidden
{
    uint32_t before; // far
    uint32_t ofAll;  // by the search without end
};

class RayBackends : public DeviceTest, public testing::WithParamInterface<RayBackend>
{
protected:
    void SetUp() override
    {
        DeviceTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure() && render::backendFor(GetParam(), device().info().rayQuery) != GetParam())
            GTEST_SKIP() << "the device has no ray queries";
    }

    std::vector<Hidden> trace(std::vector<PlacedMesh>& meshes, std::vector<Ray> rays)
    {
        const TracedScene scene(device(), GetParam(), meshes);
        for (Ray& ray : rays)
            ray.scene = scene.address();
        return runKernel<Hidden>(device(), "ray_backends.comp", GetParam() == RayBackend::RayQuery ? "RAY_QUERY" : "COMPUTE_BVH", rays);
    }
};

scene::Mesh scattered(RandomInputs& random, uint32_t triangleCount)
{
    scene::Mesh mesh;
    const auto point = [&random](double size) {
        return vec3(dvec3(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)));
    };
    for (uint32_t i = 0; i < triangleCount; ++i) {
        const vec3 at = point(2);
        for (uint32_t corner = 0; corner < 3; ++corner) {
            mesh.indices.push_back(3 * i + corner);
            mesh.positions.push_back(at + point(0.6));
        }
    }
    mesh.triangleMaterials.resize(triangleCount);
    return mesh;
}

/// Along one ray: the closest hits, and whether rounding could decide otherwise.
struct Found
{
    double dynamicAt = kNowhere, staticAt = kNowhere;
    bool isClose = false; // to an edge, or to the origin

    void addTriangle(const Ray& ray, const dvec3 (&corners)[3], uint32_t mask)
    {
        const dvec3 direction(ray.direction), u = corners[1] - corners[0], v = corners[2] - corners[0],
                                              from = dvec3(ray.origin) - corners[0];
        const double determinant = glm::dot(glm::cross(direction, v), u);
        const double a = glm::dot(glm::cross(direction, v), from) / determinant, b = glm::dot(glm::cross(from, u), direction) / determinant;
        const double at = glm::dot(glm::cross(from, u), v) / determinant;
        const double inside = std::min({a, b, 1 - a - b});
        if (!(inside > -1e-4 && at > -1e-4))
            return;
        isClose |= inside < 1e-4 || at < 1e-4;
        double& closest = mask == kMaskDynamic ? dynamicAt : staticAt;
        closest = std::min(closest, at);
    }
    [[nodiscard]] bool isDoubtful(double far) const
    {
        return isClose || (dynamicAt < kNowhere && (std::abs(dynamicAt - staticAt) < 1e-4 || std::abs(dynamicAt - far) < 1e-4));
    }
};

Found searched(const std::vector<PlacedMesh>& meshes, const Ray& ray)
{
    Found found;
    for (const PlacedMesh& placed : meshes) {
        const std::vector<uint32_t>& indices = placed.mesh.indices;
        for (size_t i = 0; i < indices.size(); i += 3) {
            dvec3 corners[3];
            for (size_t corner = 0; corner < 3; ++corner)
                corners[corner] = glm::dmat4(placed.worldFromLocal) * glm::dvec4(placed.mesh.positions[indices[i + corner]], 1);
            found.addTriangle(ray, corners, placed.mask);
        }
    }
    return found;
}

mat4 turnedAndStretched()
{
    return glm::translate(mat4{1}, {0.5f, -1, 0.3f}) * glm::mat4_cast(glm::angleAxis(1.1f, glm::normalize(vec3(1, 2, 3)))) *
           glm::scale(mat4{1}, {1.5f, 0.4f, -0.8f});
}

TEST_P(RayBackends, FindWhatASearchThroughAllTrianglesFinds)
{
    RandomInputs random(11);
    std::vector<PlacedMesh> meshes{{scattered(random, 40), mat4{1}, kMaskStatic},
                                   {scattered(random, 61), turnedAndStretched(), kMaskDynamic},
                                   {scattered(random, 1), glm::translate(mat4{1}, {1, 1, 1}), kMaskDynamic},
                                   {scattered(random, 7), turnedAndStretched(), kMaskStatic}};
    std::vector<Ray> rays(20000);
    for (Ray& ray : rays) {
        ray.origin = vec3(3.0 * random.direction());
        ray.direction = glm::normalize(vec3(random.uniform(0, 1.5) * random.direction()) - ray.origin);
        ray.far = static_cast<float>(random.logUniform(1, 10));
    }
    const std::vector<Hidden> results = trace(meshes, rays);
    size_t hidden = 0, doubtful = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const Found found = searched(meshes, rays[i]);
        if (found.isDoubtful(static_cast<double>(rays[i].far))) {
            ++doubtful;
            continue;
        }
        const bool isHidden = found.dynamicAt < found.staticAt;
        ASSERT_EQ(results[i].ofAll, isHidden ? 1u : 0u) << i;
        ASSERT_EQ(results[i].before, isHidden && found.dynamicAt < static_cast<double>(rays[i].far) ? 1u : 0u) << i;
        hidden += isHidden ? 1 : 0;
    }
    EXPECT_GT(hidden, rays.size() / 20);
    EXPECT_LT(doubtful, rays.size() / 20);
}

/// From inside a closed sphere: how many of the rays to the targets get out.
size_t escapes(std::vector<PlacedMesh>& meshes, const std::vector<vec3>& targets, const auto& trace)
{
    constexpr vec3 kInside(0.013f, 0.04f, -0.02f);
    std::vector<Ray> rays;
    for (const vec3& target : targets)
        rays.push_back({.origin = kInside, .direction = glm::normalize(target - kInside)});
    const std::vector<Hidden> results = trace(meshes, rays);
    return static_cast<size_t>(
        std::ranges::count_if(results, [](const Hidden& result) { return result.before == 0 || result.ofAll == 0; }));
}

TEST_P(RayBackends, LetNothingSlipThroughAClosedMesh)
{
    std::vector<PlacedMesh> meshes{{scene::makeSphere(), mat4{1}, kMaskDynamic}};
    scene::Mesh& sphere = meshes[0].mesh;
    for (vec3& position : sphere.positions)
        position = glm::round(position * 4096.0f) / 4096.0f; // closes seam and poles
    const auto traced = [this](std::vector<PlacedMesh>& scene, const std::vector<Ray>& rays) { return trace(scene, rays); };

    RandomInputs random(5);
    std::vector<vec3> anywhere = awkwardDirections(), edges;
    while (anywhere.size() < 50000)
        anywhere.emplace_back(random.direction());
    for (size_t i = 0; i < sphere.indices.size(); ++i) {
        const vec3 a = sphere.positions[sphere.indices[i]], b = sphere.positions[sphere.indices[i - i % 3 + (i + 1) % 3]];
        for (const float share : {0.5f, 0.1f, 0.77f})
            edges.push_back(glm::mix(a, b, share));
    }
    EXPECT_EQ(escapes(meshes, anywhere, traced), 0u);
    EXPECT_EQ(escapes(meshes, edges, traced), 0u);
    // Where six edges meet, rounding may put the ray on the wrong side of all of them.
    EXPECT_LT(escapes(meshes, sphere.positions, traced), sphere.positions.size() / 30);
}

TEST_P(RayBackends, TakeRaysAlongTheAxesAndFlatBoxes)
{
    // A floor of no height, its edges on the planes that the origins lie in.
    std::vector<PlacedMesh> meshes{{scene::makePlane(), mat4{1}, kMaskDynamic}};
    std::vector<Ray> rays;
    for (const float zero : {0.0f, -0.0f})
        for (const vec3 origin : {vec3(0.2f, 1, 0.1f), vec3(-0.3f, 1, zero), vec3(zero, 2, 0.4f)})
            rays.push_back({.origin = origin, .direction = {zero, -1, zero}});
    const size_t hits = rays.size();
    for (const float zero : {0.0f, -0.0f})
        for (const vec3 origin : {vec3(0.2f, 1, 0.1f), vec3(2, -1, 0), vec3(0.6f, 3, 0.4f)})
            rays.push_back({.origin = origin, .direction = {zero, origin.x < 0.5f ? 1.0f : -1.0f, zero}});
    const std::vector<Hidden> results = trace(meshes, rays);
    for (size_t i = 0; i < rays.size(); ++i)
        EXPECT_EQ(results[i].before, i < hits ? 1u : 0u) << i;
}

TEST_P(RayBackends, HitNothingWithNonsense)
{
    std::vector<PlacedMesh> meshes{{scene::makeCube(), mat4{1}, kMaskDynamic}};
    std::vector<Ray> rays;
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        rays.push_back({.origin = {bad, 0, 0}});
        rays.push_back({.origin = vec3(bad)});
    }
    rays.push_back({.direction = {kNan, 0, 1}});
    rays.push_back({.direction = vec3(kNan)});
    rays.push_back({.direction = vec3(0)});
    for (const Hidden& result : trace(meshes, rays))
        EXPECT_EQ(result.before + result.ofAll, 0u);
}

TEST_P(RayBackends, HitNoTriangleWithoutArea)
{
    scene::Mesh flat;
    flat.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    flat.indices = {0, 1, 1, 0, 0, 0, 0, 2, 1, 1, 0, 1, 2, 2, 0, 0, 1, 2};
    flat.triangleMaterials.resize(6);
    std::vector<PlacedMesh> meshes{{flat, mat4{1}, kMaskDynamic}};
    std::vector<Ray> rays;
    for (const float x : {-1.0f, -0.5f, 0.0f, 0.25f, 1.0f})
        rays.push_back({.origin = {x, 0, -1}});
    for (const Hidden& result : trace(meshes, rays))
        EXPECT_EQ(result.before + result.ofAll, 0u);
}

INSTANTIATE_TEST_SUITE_P(Contract, RayBackends, testing::Values(RayBackend::RayQuery, RayBackend::ComputeBvh),
                         [](const auto& test) { return test.param == RayBackend::RayQuery ? "RayQuery" : "ComputeBvh"; });

class BvhRefit : public DeviceTest
{
};

TEST_F(BvhRefit, MakesTheTreeThatTheHostMakes)
{
    RandomInputs random(2);
    for (const uint32_t count : {1u, 5u, 64u, 3000u}) {
        SCOPED_TRACE(count);
        scene::Mesh mesh = scattered(random, count);
        const std::vector<shader::BvhNode> rest = render::bvhOf(mesh.positions, mesh.indices);
        for (vec3& position : mesh.positions)
            position = vec3(position.y, 2 * position.x, position.z + position.y);
        const gpu::Buffer restNodes = gpu::uploadedBuffer(device(), "rest", std::span<const shader::BvhNode>(rest));
        const gpu::Buffer positions = gpu::uploadedBuffer(device(), "positions", std::span<const vec3>(mesh.positions));
        const gpu::Buffer indices = gpu::uploadedBuffer(device(), "indices", std::span<const uint32_t>(mesh.indices));
        const gpu::Buffer posed(device(), "posed", rest.size() * sizeof(shader::BvhNode), gpu::MemoryKind::Readback);
        dispatchNow(device(), gpu::computePipeline(device(), "bvh_refit.comp"),
                    shader::BvhRefitDispatch{restNodes.address(), posed.address(), positions.address(), indices.address(),
                                             render::bvhLeafCount(count)},
                    1);
        const std::vector<shader::BvhNode> expected = render::bvhOf(mesh.positions, mesh.indices);
        const auto nodes = gpu::mappedValues<const shader::BvhNode>(posed, rest.size());
        for (size_t i = 1; i < nodes.size(); ++i) {
            ASSERT_EQ(nodes[i].lowest, expected[i].lowest) << i;
            ASSERT_EQ(nodes[i].highest, expected[i].highest) << i;
            ASSERT_EQ(nodes[i].firstTriangle, expected[i].firstTriangle) << i;
            ASSERT_EQ(nodes[i].triangleCount, expected[i].triangleCount) << i;
        }
    }
}

} // namespace
} // namespace antumbra
