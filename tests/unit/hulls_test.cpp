#include "bake/hulls.h"
#include "base/error.h"
#include "body_checks.h"
#include "scene/gltf.h"
#include "scene/triangle_joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace antumbra;
using namespace antumbra::bake;
using namespace antumbra::scene;

namespace {

constexpr uint32_t kNoLimit = 1u << 20;

class Random
{
public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    vec3 inCube() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
    mat4 rotation() { return glm::mat4_cast(glm::normalize(quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1f, 1)))); }

private:
    std::mt19937 engine_;
};

std::vector<vec3> pointsInCube(uint32_t count, uint32_t seed)
{
    Random random(seed);
    std::vector<vec3> points(count);
    for (vec3& point : points)
        point = random.inCube();
    return points;
}

std::vector<vec3> moved(std::vector<vec3> points, const mat4& matrix)
{
    for (vec3& point : points)
        point = vec3(matrix * vec4(point, 1));
    return points;
}

/// How far the farthest point lies outside, over the extent.
double excess(const ConvexBody& body, std::span<const vec3> points)
{
    double greatest = 0;
    for (const vec3& point : points)
        greatest = std::max(greatest, heightAbove(body, point));
    return greatest / greatestExtent(points);
}

const Model& walker()
{
    static const Model model = loadGltf(projectPath("assets") / "characters/walker.glb");
    return model;
}

} // namespace

TEST(ConvexHull, HoldsAllOfManyRandomPoints)
{
    for (const uint32_t count : {4u, 5u, 20u, 2000u}) {
        const std::vector<vec3> points = pointsInCube(count, count);
        const std::optional<ConvexBody> body = convexHull(points, kNoLimit);
        ASSERT_TRUE(body);
        expectClosedConvex(*body, 1e-5);
        EXPECT_LE(excess(*body, points), 1e-5);
        for (const vec3& vertex : body->vertices)
            EXPECT_NE(std::ranges::find(points, vertex), points.end());
    }
}

TEST(ConvexHull, MergesTheFacetsOfABoxOfPoints)
{
    Random random(1);
    for (const float scale : {1e-25f, 1e-3f, 1.0f, 1e25f})
        for (const float thickness : {1.0f, 1e-3f}) {
            std::vector<vec3> points;
            for (const vec3 corner : makeCube().positions)
                points.push_back(corner);
            for (int i = 0; i < 300; ++i) { // on the sides
                vec3 point = 0.5f * random.inCube();
                point[i % 3] = std::copysign(0.5f, point[i % 3]);
                points.push_back(point);
            }
            const mat4 matrix = glm::scale(mat4(1), vec3(scale)) * random.rotation() * glm::scale(mat4(1), vec3{1, thickness, 1});
            const std::optional<ConvexBody> body = convexHull(moved(points, matrix), kNoLimit);
            ASSERT_TRUE(body);
            expectClosedConvex(*body, 1e-5);
            EXPECT_EQ(body->faces.size(), 6u) << scale << ' ' << thickness;
            EXPECT_EQ(body->vertices.size(), 8u) << scale << ' ' << thickness;
        }
}

TEST(ConvexHull, FlatPointsMakeAPlanarBody)
{
    Random random(2);
    for (int i = 0; i < 20; ++i) {
        std::vector<vec3> points{{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}};
        for (int k = 0; k < 50; ++k)
            points.emplace_back(random.uniform(0, 2), 0, random.uniform(0, 1));
        const std::vector<vec3> turned = moved(points, random.rotation());
        const std::optional<ConvexBody> body = convexHull(turned, kNoLimit);
        ASSERT_TRUE(body);
        expectPlanarConvex(*body, 1e-5);
        EXPECT_EQ(body->vertices.size(), 4u);
        EXPECT_NEAR(surfaceArea(*body), 2, 1e-5);
    }
}

TEST(ConvexHull, NearlyFlatPointsAreEitherFlatOrClosed)
{
    Random random(3);
    for (int i = 0; i < 120; ++i) {
        const float thickness = std::pow(10.0f, -8 * static_cast<float>(i) / 120);
        const mat4 matrix = random.rotation() * glm::scale(mat4(1), vec3{1, thickness, 1});
        const std::vector<vec3> points = moved(pointsInCube(60, static_cast<uint32_t>(i)), matrix);
        const std::optional<ConvexBody> body = convexHull(points, kNoLimit);
        ASSERT_TRUE(body);
        if (body->isPlanar) {
            expectPlanarConvex(*body, 1e-5);
        } else {
            expectClosedConvex(*body, 1e-5);
            EXPECT_LE(excess(*body, points), 1e-5);
        }
        EXPECT_TRUE(body->isPlanar || thickness > 1e-6f) << thickness;
        EXPECT_TRUE(!body->isPlanar || thickness < 1e-5f) << thickness;
    }
}

TEST(ConvexHull, OfPointsWithoutAreaIsNone)
{
    EXPECT_FALSE(convexHull({}, 8));
    const std::vector<vec3> point{{1, 2, 3}};
    EXPECT_FALSE(convexHull(point, 8));
    EXPECT_FALSE(convexHull(std::vector<vec3>(9, vec3{1, 2, 3}), 8));
    EXPECT_FALSE(convexHull(std::vector<vec3>{{0, 0, 0}, {1, 0, 0}}, 8));
    std::vector<vec3> line;
    for (int i = 0; i < 30; ++i)
        line.push_back(vec3{1, 2, 3} + 0.37f * static_cast<float>(i) * vec3{0.3f, 0.2f, -0.7f});
    EXPECT_FALSE(convexHull(line, 8));
    // Four points of an extent that float does not hold any more.
    EXPECT_FALSE(convexHull(std::vector<vec3>{{0, 0, 0}, {1e-40f, 0, 0}, {0, 1e-40f, 0}, {0, 0, 1e-40f}}, 8));
}

TEST(ConvexHull, DuplicatesChangeNothing)
{
    std::vector<vec3> points = pointsInCube(40, 4);
    const ConvexBody once = *convexHull(points, kNoLimit);
    points.insert(points.end(), points.begin(), points.begin() + 40);
    for (size_t i = 0; i < 40; ++i)
        points.push_back(points[i] * (1 - 1e-7f));
    const ConvexBody body = *convexHull(points, kNoLimit);
    expectClosedConvex(body, 1e-5);
    EXPECT_NEAR(volumeOf(body), volumeOf(once), 1e-5);
}

TEST(ConvexHull, FarFromTheOriginRoundingIsCountedIn)
{
    // At 10 km float has steps of 1 mm: the sides of the cube are flat within that alone.
    Random random(5);
    std::vector<vec3> points = makeCube().positions;
    for (int i = 0; i < 100; ++i)
        points.emplace_back(random.uniform(-0.5f, 0.5f), 0.5f, random.uniform(-0.5f, 0.5f));
    points = moved(points, glm::translate(mat4(1), vec3{10000, 3000, -7000}) * random.rotation());
    const std::optional<ConvexBody> body = convexHull(points, kNoLimit);
    ASSERT_TRUE(body);
    expectClosedConvex(*body, 2e-2);
    EXPECT_LE(body->faces.size(), 8u);
    EXPECT_NEAR(volumeOf(*body), 1, 1e-2);
}

TEST(ConvexHull, RefusesWhatIsNotFiniteAndTooFewVertices)
{
    std::vector<vec3> points = pointsInCube(10, 6);
    points[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(convexHull(points, 8), Error);
    points[3].y = std::numeric_limits<float>::infinity();
    EXPECT_THROW(convexHull(points, 8), Error);
    points[3].y = -2e30f;
    EXPECT_THROW(convexHull(points, 8), Error);
    EXPECT_DEATH(convexHull(pointsInCube(10, 6), 3), "four vertices");
}

TEST(HullsOfModel, OneForEachBoneHoldsItsVertices)
{
    const Model& model = walker();
    const std::vector<Hull> hulls = hullsOfModel(model, kNoLimit);
    const auto vertices = verticesByJoint(model.mesh);
    ASSERT_EQ(hulls.size(), vertices.size());
    for (const Hull& hull : hulls) {
        expectClosedConvex(hull.body, 1e-5);
        std::vector<vec3> points;
        for (const uint32_t vertex : vertices.at(hull.joint))
            points.push_back(model.mesh.positions[vertex]);
        EXPECT_LE(excess(hull.body, points), 1e-5);
    }
}

TEST(HullsOfModel, HullsOf32VerticesHoldNearlyAllOfTheirBones)
{
    const Model& model = walker();
    const auto vertices = verticesByJoint(model.mesh);
    size_t inside = 0;
    size_t count = 0;
    for (const Hull& hull : hullsOfModel(model, 32)) {
        const double tolerance = 0.02 * greatestExtent(hull.body.vertices);
        for (const uint32_t vertex : vertices.at(hull.joint)) {
            inside += heightAbove(hull.body, model.mesh.positions[vertex]) <= tolerance ? 1 : 0;
            ++count;
        }
    }
    EXPECT_GT(static_cast<double>(inside) / static_cast<double>(count), 0.98);
}

TEST(HullsOfModel, ATriangleBelongsToTheJointWithTheGreatestShare)
{
    Model model = rigidModel("two bones", makeCube(), {});
    model.joints.push_back({});
    for (size_t i = 0; i < model.mesh.positions.size(); ++i)
        if (model.mesh.positions[i].y > 0)
            model.mesh.influences[i] = {{0, 1, 0, 0}, {0.1f, 0.9f, 0, 0}};
    // Triangles with two corners above hang on the second joint: the lid, and one of two on each of the four sides.
    const std::vector<Hull> hulls = hullsOfModel(model, 32);
    ASSERT_EQ(hulls.size(), 2u);
    EXPECT_EQ(hulls[0].joint, 0u);
    EXPECT_EQ(hulls[1].joint, 1u);
    size_t corners = 0;
    for (const auto& [joint, vertices] : verticesByJoint(model.mesh))
        corners += vertices.size();
    EXPECT_GT(corners, model.mesh.positions.size()); // those on both sides of the border count twice
}

TEST(HullsOfModel, AreOfPiecesThatHangTogetherWhereTheyAreAskedFor)
{
    Mesh cubes = makeCube(); // whose faces share places and no vertices
    const Mesh second = makeCube();
    const auto first = static_cast<uint32_t>(cubes.positions.size());
    for (const vec3& position : second.positions)
        cubes.positions.push_back(position + vec3(3, 0, 0));
    for (const uint32_t index : second.indices)
        cubes.indices.push_back(first + index);
    cubes.normals.insert(cubes.normals.end(), second.normals.begin(), second.normals.end());
    cubes.uvs.insert(cubes.uvs.end(), second.uvs.begin(), second.uvs.end());
    cubes.triangleMaterials.insert(cubes.triangleMaterials.end(), second.triangleMaterials.begin(), second.triangleMaterials.end());
    const Model model = rigidModel("two cubes", std::move(cubes), {});
    EXPECT_EQ(hullsOfModel(model, 32).size(), 1u);
    const std::vector<Hull> hulls = hullsOfModel(model, 32, HullsBy::Piece);
    ASSERT_EQ(hulls.size(), 2u);
    for (const Hull& hull : hulls) {
        EXPECT_EQ(hull.body.vertices.size(), 8u);
        EXPECT_EQ(hull.vertices.size(), first);
    }
}

TEST(HullsOfModel, LeavesOutWhatHasNoAreaAndNamesTheModelInErrors)
{
    Mesh line = makePlane();
    for (vec3& position : line.positions)
        position.z = 0;
    EXPECT_TRUE(hullsOfModel(rigidModel("line", line, {}), 8).empty());
    EXPECT_TRUE(hullsOfModel(rigidModel("nothing", {}, {}), 8).empty());
    EXPECT_TRUE(hullsOfModel(rigidModel("card", makePlane(), {}), 8).at(0).body.isPlanar);
    Mesh broken = makeCube();
    broken.positions[0].x = NAN;
    try {
        hullsOfModel(rigidModel("broken", broken, {}), 8);
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.which, "broken");
    }
}
