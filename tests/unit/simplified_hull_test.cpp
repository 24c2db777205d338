#include "bake/hulls.h"
#include "body_checks.h"
#include "scene/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace antumbra;
using namespace antumbra::bake;
using namespace antumbra::scene;

namespace {

constexpr uint32_t kNoLimit = 1u << 20;

std::vector<vec3> pointsInCube(uint32_t count)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<vec3> points(count);
    for (vec3& point : points)
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = uniform(random);
    return points;
}

/// The area that a body covers seen along a direction, m^2.
double coveredArea(const ConvexBody& body, glm::dvec3 direction)
{
    const std::vector<glm::dvec3> normals = faceNormals(body);
    double area = 0;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const auto loop = body.loop(face);
        const auto at = [&](size_t i) { return glm::dvec3(body.vertices[loop[i]]) - glm::dvec3(body.vertices[loop[0]]); };
        for (size_t i = 1; i + 1 < loop.size(); ++i)
            area += 0.25 * std::abs(glm::dot(glm::cross(at(i), at(i + 1)), direction));
    }
    return area;
}

/// The mean over directions of how much the area covered is off, over the full body's.
double meanAreaError(const ConvexBody& full, const ConvexBody& body)
{
    constexpr int kDirections = 100;
    double sum = 0;
    for (int i = 0; i < kDirections; ++i) {
        const double y = 1 - (2 * i + 1.0) / kDirections;
        const double azimuth = i * 2.399963;
        const glm::dvec3 direction(std::sqrt(1 - y * y) * std::cos(azimuth), y, std::sqrt(1 - y * y) * std::sin(azimuth));
        const double area = coveredArea(full, direction);
        sum += std::abs(coveredArea(body, direction) - area) / area / kDirections;
    }
    return sum;
}

} // namespace

TEST(SimplifiedHull, KeepsTheLimitTheSurfaceAndTheMiddle)
{
    std::vector<vec3> points = pointsInCube(500);
    for (vec3& point : points)
        point = vec3{3, -1, 2} + vec3{0.5f, 0.25f, 0.15f} * glm::normalize(point);
    const ConvexBody full = *convexHull(points, kNoLimit);
    ASSERT_GT(full.vertices.size(), 400u);
    for (const uint32_t limit : {4u, 5u, 8u, 13u, 32u, 400u}) {
        const ConvexBody body = *convexHull(points, limit);
        expectClosedConvex(body, 1e-5);
        EXPECT_LE(body.vertices.size(), limit);
        EXPECT_GE(body.vertices.size(), std::min(limit, 128u));
        EXPECT_NEAR(surfaceArea(body) / surfaceArea(full), 1, 1e-5);
        Aabb box;
        for (const vec3& vertex : body.vertices)
            box.add(vertex);
        EXPECT_LT(glm::distance(box.centre(), vec3(3, -1, 2)), limit < 8 ? 0.3f : 0.1f);
    }
}

TEST(SimplifiedHull, ASphereErrsNoMoreThanTheHeaderSays)
{
    const ConvexBody full = *convexHull(makeSphere().positions, kNoLimit);
    const std::pair<uint32_t, double> bounds[]{{8, 0.08}, {12, 0.025}, {16, 0.019}, {32, 0.008}};
    for (const auto& [limit, bound] : bounds)
        EXPECT_LT(meanAreaError(full, *convexHull(makeSphere().positions, limit)), bound) << limit;
}

TEST(SimplifiedHull, ABoxAmongFinerPointsStaysTheBox)
{
    // Eight corners and, a hair outside the sides, points that are not worth a vertex.
    std::vector<vec3> points = makeCube().positions;
    for (vec3 point : pointsInCube(60)) {
        const int axis = static_cast<int>(points.size() % 3);
        point *= 0.45f;
        point[axis] = std::copysign(0.5001f, point[axis]);
        points.push_back(point);
    }
    ASSERT_GT(convexHull(points, kNoLimit)->vertices.size(), 8u);
    const ConvexBody body = *convexHull(points, 8);
    EXPECT_EQ(body.vertices.size(), 8u);
    for (const vec3& vertex : body.vertices)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(std::abs(vertex[axis]), 0.5f, 1e-3);
}

TEST(SimplifiedHull, TakesPyramidsWhoseOtherCornersAreFlat)
{
    std::vector<vec3> points{{0, 1, 0}};
    for (int i = 0; i < 60; ++i)
        points.emplace_back(std::cos(0.10472f * static_cast<float>(i)), 0, std::sin(0.10472f * static_cast<float>(i)));
    const ConvexBody body = *convexHull(points, 9);
    expectClosedConvex(body, 1e-5);
    EXPECT_EQ(body.vertices.size(), 9u);
    EXPECT_EQ(body.faces.size(), 9u);
}

TEST(SimplifiedHull, AFlatOneKeepsItsAreaAndMiddle)
{
    std::vector<vec3> points;
    for (int i = 0; i < 90; ++i)
        points.emplace_back(5 + std::cos(0.0698f * static_cast<float>(i)), 1, 2 * std::sin(0.0698f * static_cast<float>(i)));
    const ConvexBody full = *convexHull(points, kNoLimit);
    for (const uint32_t limit : {4u, 7u, 16u}) {
        const ConvexBody body = *convexHull(points, limit);
        expectPlanarConvex(body, 1e-5);
        EXPECT_EQ(body.vertices.size(), limit);
        EXPECT_NEAR(surfaceArea(body) / surfaceArea(full), 1, 1e-5);
        EXPECT_NEAR(body.vertices[0].y, 1, 1e-6);
    }
}

TEST(SimplifiedHull, BonesErrNoMoreThanTheHeaderSays)
{
    const Model model = loadGltf(projectPath("assets") / "characters/walker.glb");
    const std::vector<Hull> full = hullsOfModel(model, kNoLimit);
    const std::pair<uint32_t, double> bounds[]{{8, 0.045}, {12, 0.028}, {16, 0.018}, {32, 0.004}};
    for (const auto& [limit, bound] : bounds) {
        const std::vector<Hull> hulls = hullsOfModel(model, limit);
        ASSERT_EQ(hulls.size(), full.size());
        double sum = 0;
        int count = 0;
        for (size_t i = 0; i < hulls.size(); ++i) {
            EXPECT_LE(hulls[i].body.vertices.size(), limit);
            expectClosedConvex(hulls[i].body, 1e-5);
            if (full[i].body.vertices.size() <= limit)
                continue;
            sum += meanAreaError(full[i].body, hulls[i].body);
            ++count;
        }
        EXPECT_LT(sum / count, bound) << limit;
    }
}
