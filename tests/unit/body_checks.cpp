#include "body_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace antumbra {

using scene::ConvexBody;

namespace {

using Step = std::pair<uint32_t, uint32_t>;

/// The steps from corner to corner of one face's loop.
std::set<Step> stepsOf(const ConvexBody& body, uint32_t face)
{
    std::set<Step> steps;
    const auto loop = body.loop(face);
    for (size_t i = 0; i < loop.size(); ++i)
        steps.insert({loop[i], loop[(i + 1) % loop.size()]});
    return steps;
}

void expectEdgesAsLoops(const ConvexBody& body)
{
    std::vector<std::set<Step>> steps;
    for (uint32_t face = 0; face < body.faces.size(); ++face)
        steps.push_back(stepsOf(body, face));
    size_t sides = 0;
    for (const ConvexBody::Edge& edge : body.edges) {
        ASSERT_LT(edge.left, body.faces.size());
        EXPECT_TRUE(steps[edge.left].contains({edge.a, edge.b}));
        ++sides;
        if (edge.right == ConvexBody::kNoFace)
            continue;
        ASSERT_LT(edge.right, body.faces.size());
        EXPECT_NE(edge.left, edge.right);
        EXPECT_TRUE(steps[edge.right].contains({edge.b, edge.a}));
        ++sides;
    }
    EXPECT_EQ(sides, body.corners.size());
}

} // namespace

void expectClosedConvex(const ConvexBody& body, double tolerance)
{
    EXPECT_FALSE(body.isPlanar);
    EXPECT_TRUE(scene::isClosed(body));
    EXPECT_EQ(body.vertices.size() + body.faces.size(), body.edges.size() + 2);
    expectEdgesAsLoops(body);
    EXPECT_GT(volumeOf(body), 0);
    const double extent = greatestExtent(body.vertices);
    for (const vec3& vertex : body.vertices)
        EXPECT_LE(heightAbove(body, vertex), tolerance * extent);
    EXPECT_EQ(std::set<uint32_t>(body.corners.begin(), body.corners.end()).size(), body.vertices.size());
}

void expectPlanarConvex(const ConvexBody& body, double tolerance)
{
    EXPECT_TRUE(body.isPlanar);
    ASSERT_EQ(body.faces.size(), 1u);
    EXPECT_EQ(body.edges.size(), body.vertices.size());
    EXPECT_EQ(body.corners.size(), body.vertices.size());
    expectEdgesAsLoops(body);
    const glm::dvec3 normal = scene::faceNormals(body)[0];
    EXPECT_NEAR(glm::length(normal), 1, 1e-12);
    const double extent = greatestExtent(body.vertices);
    for (const ConvexBody::Edge& edge : body.edges) {
        EXPECT_EQ(edge.right, ConvexBody::kNoFace);
        const glm::dvec3 a(body.vertices[edge.a]);
        const glm::dvec3 inwards = glm::normalize(glm::cross(normal, glm::dvec3(body.vertices[edge.b]) - a));
        for (const vec3& vertex : body.vertices) {
            EXPECT_GE(glm::dot(glm::dvec3(vertex) - a, inwards), -tolerance * extent);
            EXPECT_NEAR(glm::dot(glm::dvec3(vertex) - a, normal), 0, tolerance * extent);
        }
    }
}

double volumeOf(const ConvexBody& body)
{
    double sixfold = 0;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const auto loop = body.loop(face);
        const auto at = [&](size_t i) { return glm::dvec3(body.vertices[loop[i]]) - glm::dvec3(body.vertices[0]); };
        for (size_t i = 1; i + 1 < loop.size(); ++i)
            sixfold += glm::dot(at(0), glm::cross(at(i), at(i + 1)));
    }
    return sixfold / 6;
}

double heightAbove(const ConvexBody& body, vec3 point)
{
    const std::vector<glm::dvec3> normals = scene::faceNormals(body);
    double greatest = std::numeric_limits<double>::lowest();
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const glm::dvec3 corner(body.vertices[body.loop(face)[0]]);
        greatest = std::max(greatest, glm::dot(glm::dvec3(point) - corner, normals[face]));
    }
    return greatest;
}

double greatestExtent(std::span<const vec3> points)
{
    Aabb box;
    for (const vec3& point : points)
        box.add(point);
    const glm::dvec3 extent = glm::dvec3(box.highest) - glm::dvec3(box.lowest);
    return std::max({extent.x, extent.y, extent.z});
}

} // namespace antumbra
