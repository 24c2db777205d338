#include "body_checks.h"
#include "scene/mesh_body.h"
#include "scene/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

ConvexBody tetrahedron()
{
    const std::vector<Loop> loops{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return makeBody({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, loops);
}

ConvexBody square()
{
    const std::vector<Loop> loops{{0, 1, 2, 3}};
    return makeBody({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, loops);
}

/// The triangles of a box, every side in `cells` x `cells` squares that are cut in two.
Mesh finelyCutBox(uint32_t cells, vec3 extent, const mat4& matrix)
{
    Mesh mesh;
    const ConvexBody cube = *meshBody(makeCube());
    for (uint32_t face = 0; face < cube.faces.size(); ++face) {
        const auto loop = cube.loop(face);
        const vec3 corner = cube.vertices[loop[0]];
        const vec3 u = (cube.vertices[loop[1]] - corner) / static_cast<float>(cells);
        const vec3 v = (cube.vertices[loop[3]] - corner) / static_cast<float>(cells);
        for (uint32_t i = 0; i < cells * cells; ++i)
            for (const vec2 step : {vec2{0, 0}, vec2{1, 0}, vec2{1, 1}, vec2{0, 0}, vec2{1, 1}, vec2{0, 1}}) {
                const vec2 place = vec2(i % cells, i / cells) + step;
                mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
                mesh.positions.emplace_back(matrix * vec4(extent * (corner + place.x * u + place.y * v), 1));
            }
    }
    mesh.triangleMaterials.resize(mesh.indices.size() / 3);
    return mesh;
}

mat4 someRotation() { return glm::rotate(glm::rotate(mat4(1), 0.7f, vec3(1, 2, 3) / std::sqrt(14.0f)), 1.1f, vec3(0, 1, 0)); }

void expectSameBodyUpToOrder(const ConvexBody& body, size_t vertices, size_t faces)
{
    expectClosedConvex(body, 4e-6);
    EXPECT_EQ(body.vertices.size(), vertices);
    EXPECT_EQ(body.faces.size(), faces);
}

} // namespace

TEST(ConvexBody, LinksATetrahedron)
{
    const ConvexBody body = tetrahedron();
    expectClosedConvex(body);
    EXPECT_EQ(body.edges.size(), 6u);
    EXPECT_NEAR(volumeOf(body), 1.0 / 6, 1e-12);
    EXPECT_NEAR(surfaceArea(body), 1.5 + std::sqrt(3.0) / 2, 1e-12);
    const std::vector<glm::dvec3> normals = faceNormals(body);
    EXPECT_EQ(normals[0], glm::dvec3(0, 0, -1));
    EXPECT_NEAR(glm::distance(normals[2], glm::dvec3(std::sqrt(1.0 / 3))), 0, 1e-12);
}

TEST(ConvexBody, APlanarBodyIsOneFaceWithoutNeighbours)
{
    const ConvexBody body = square();
    expectPlanarConvex(body);
    EXPECT_EQ(faceNormals(body)[0], glm::dvec3(0, 1, 0));
    EXPECT_FALSE(isClosed(body));
    EXPECT_DOUBLE_EQ(surfaceArea(body), 4);
}

TEST(ConvexBody, AnOpenBodyHasEdgesOfOneFace)
{
    const std::vector<Loop> loops{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    const ConvexBody body = makeBody(tetrahedron().vertices, loops);
    EXPECT_FALSE(body.isPlanar);
    EXPECT_FALSE(isClosed(body));
    EXPECT_EQ(std::ranges::count(body.edges, ConvexBody::kNoFace, &ConvexBody::Edge::right), 3);
}

TEST(ConvexBody, RefusesAnEdgeRunThroughTwiceInOneDirection)
{
    const std::vector<vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<Loop> sameSense{{0, 1, 2}, {0, 1, 3}};
    EXPECT_FALSE(linkedBody(vertices, sameSense));
    const std::vector<Loop> thereAndBack{{0, 1, 0, 2}, {0, 2, 3}};
    EXPECT_FALSE(linkedBody(vertices, thereAndBack));
    EXPECT_DEATH(makeBody(vertices, sameSense), "once in each direction");
}

TEST(ConvexBody, RefusesNaNAndCornersThatAreNone)
{
    const std::vector<Loop> loops{{0, 1, 2}};
    EXPECT_DEATH(makeBody({{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, loops), "finite");
    EXPECT_DEATH(makeBody({{0, 0, 0}, {1, 0, 0}}, loops), "corners are vertices");
    const std::vector<Loop> two{{0, 1}};
    EXPECT_DEATH(makeBody({{0, 0, 0}, {1, 0, 0}}, two), "three corners");
}

TEST(ConvexBody, NormalsFollowPosedVertices)
{
    const ConvexBody body = tetrahedron();
    std::vector<vec3> posed = body.vertices;
    for (vec3& vertex : posed)
        vertex = vec3(someRotation() * vec4(vertex, 1));
    const std::vector<glm::dvec3> normals = faceNormals(body, posed);
    for (size_t face = 0; face < normals.size(); ++face) {
        const glm::dvec3 turned = glm::dmat3(someRotation()) * faceNormals(body)[face];
        EXPECT_NEAR(glm::distance(normals[face], turned), 0, 1e-6);
    }
}

TEST(ConvexBody, NormalsAreUnitAtEverySizeAndZeroWithoutArea)
{
    for (const float scale : {1e-30f, 1e-10f, 1e10f, 1e37f})
        for (const glm::dvec3& normal : faceNormals(transformed(tetrahedron(), glm::scale(mat4(1), vec3(scale)))))
            EXPECT_NEAR(glm::length(normal), 1, 1e-12) << scale;
    const ConvexBody flat = transformed(square(), glm::scale(mat4(1), vec3(0, 1, 1)));
    EXPECT_EQ(faceNormals(flat)[0], glm::dvec3(0));
    EXPECT_EQ(surfaceArea(flat), 0);
    EXPECT_TRUE(meshOf(flat).indices.empty());
}

TEST(ConvexBody, MirroringKeepsLoopsCounterClockwise)
{
    for (const vec3 scale : {vec3{2, 3, 4}, vec3{-2, 3, 4}, vec3{2, -3, 4}, vec3{-2, -3, -4}}) {
        const mat4 matrix = glm::translate(mat4(1), vec3{1, 2, 3}) * someRotation() * glm::scale(mat4(1), scale);
        const ConvexBody body = transformed(tetrahedron(), matrix);
        expectClosedConvex(body);
        EXPECT_NEAR(volumeOf(body), 24.0 / 6, 1e-4);
    }
}

TEST(ConvexBody, AMirroredPlanarBodyShinesWhereItsSpaceIsTurned)
{
    const ConvexBody sideways = transformed(square(), glm::scale(mat4(1), vec3{-1, 1, 1}));
    expectPlanarConvex(sideways);
    EXPECT_EQ(faceNormals(sideways)[0], glm::dvec3(0, 1, 0));
    const ConvexBody down = transformed(square(), glm::scale(mat4(1), vec3{1, -1, 1}));
    expectPlanarConvex(down);
    EXPECT_EQ(faceNormals(down)[0], glm::dvec3(0, -1, 0));
}

TEST(ConvexBody, MeshShowsEveryFaceFlat)
{
    const ConvexBody cube = *meshBody(makeCube());
    const Mesh mesh = meshOf(cube);
    EXPECT_EQ(mesh.indices.size(), 36u);
    EXPECT_EQ(mesh.triangleMaterials.size(), 12u);
    EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const vec3 a = mesh.positions[mesh.indices[i]];
        const vec3 normal = glm::normalize(glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a));
        for (size_t corner = 0; corner < 3; ++corner)
            EXPECT_NEAR(glm::distance(mesh.normals[mesh.indices[i + corner]], normal), 0, 1e-6);
    }
    expectSameBodyUpToOrder(*meshBody(mesh), 8, 6);
}

TEST(MeshBody, ACubeOfSplitVerticesHasEightAndSixFaces)
{
    const std::optional<ConvexBody> body = meshBody(makeCube());
    ASSERT_TRUE(body);
    expectSameBodyUpToOrder(*body, 8, 6);
    EXPECT_NEAR(volumeOf(*body), 1, 1e-6);
}

TEST(MeshBody, MergesFinelyCutFacesAtEverySizeAndPlace)
{
    for (const float scale : {1e-20f, 1e-3f, 1.0f, 1e20f})
        for (const vec3 extent : {vec3{1}, vec3{1, 0.01f, 0.5f}}) {
            const mat4 matrix = glm::scale(mat4(1), vec3(scale)) * glm::translate(mat4(1), vec3{3, -2, 1}) * someRotation();
            const std::optional<ConvexBody> body = meshBody(finelyCutBox(7, extent, matrix));
            ASSERT_TRUE(body) << scale;
            expectSameBodyUpToOrder(*body, 8, 6);
        }
}

TEST(MeshBody, ASphereKeepsItsVertices)
{
    const std::optional<ConvexBody> body = meshBody(makeSphere());
    ASSERT_TRUE(body);
    // 23 rings of 48 and two poles; between the rings trapezoids, at the poles triangles.
    expectSameBodyUpToOrder(*body, 23 * 48 + 2, 24 * 48);
}

TEST(MeshBody, RefusesOpenDentedDoubledAndTurnedMeshes)
{
    EXPECT_FALSE(meshBody(Mesh{}));
    EXPECT_FALSE(meshBody(makePlane()));
    Mesh open = makeCube();
    open.indices.resize(33);
    EXPECT_FALSE(meshBody(open));
    Mesh dented = finelyCutBox(2, vec3{1}, mat4(1));
    for (vec3& position : dented.positions)
        if (position == vec3{0, 0.5f, 0})
            position.y = 0.499f;
    EXPECT_FALSE(meshBody(dented));
    Mesh turned = makeCube();
    for (size_t i = 0; i < turned.indices.size(); i += 3)
        std::swap(turned.indices[i], turned.indices[i + 1]);
    EXPECT_FALSE(meshBody(turned));
    Mesh two = makeCube();
    const Mesh cube = makeCube();
    for (const vec3& position : cube.positions)
        two.positions.push_back(position + vec3{2, 0, 0});
    for (const uint32_t index : cube.indices)
        two.indices.push_back(index + static_cast<uint32_t>(cube.positions.size()));
    EXPECT_FALSE(meshBody(two));
}

TEST(MeshBody, RefusesNaN)
{
    Mesh mesh = makeCube();
    mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_DEATH(meshBody(mesh), "finite");
}

TEST(MeshBody, TrianglesOneByOneWithoutDegenerateOnes)
{
    Mesh mesh = makePlane();
    mesh.indices.insert(mesh.indices.end(), {0, 0, 1, 2, 2, 2});
    mesh.positions.push_back(0.5f * (mesh.positions[0] + mesh.positions[1]));
    mesh.indices.insert(mesh.indices.end(), {0, 4, 1});
    const std::vector<ConvexBody> bodies = triangleBodies(mesh);
    ASSERT_EQ(bodies.size(), 2u);
    for (const ConvexBody& body : bodies) {
        expectPlanarConvex(body);
        EXPECT_NEAR(surfaceArea(body), 0.5, 1e-6);
        EXPECT_NEAR(faceNormals(body)[0].y, 1, 1e-6);
    }
    for (vec3& position : mesh.positions)
        position *= 1e-15f;
    EXPECT_EQ(triangleBodies(mesh).size(), 2u);
}

TEST(Outline, HoldsEveryPointAndTurnsLeftEverywhere)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 500; ++i)
        points.emplace_back(uniform(random), uniform(random));
    points.insert(points.end(), points.begin(), points.begin() + 100);
    const Loop outline = outlineOf(points);
    ASSERT_GE(outline.size(), 3u);
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = points[outline[i]];
        const glm::dvec2 edge = glm::normalize(points[outline[(i + 1) % outline.size()]] - a);
        for (const glm::dvec2& point : points)
            EXPECT_GE(edge.x * (point.y - a.y) - edge.y * (point.x - a.x), -2e-6);
    }
}

TEST(Outline, LeavesOutNoCornerBecauseOfNoiseBesideIt)
{
    // Points on the side x = 1, off by less than the tolerance, in an order that zigzags along it.
    std::vector<glm::dvec2> points{{0, 0}, {0, 1}};
    for (const double y : {0.5, 0.0, 1.0, 0.2, 0.9, 0.1})
        points.emplace_back(1 + 1e-9 * static_cast<double>(points.size()), y);
    EXPECT_EQ(outlineOf(points), (Loop{0, 3, 4, 1}));
}

TEST(Outline, OfPointsOnALineHasNoArea)
{
    EXPECT_TRUE(outlineOf({}).empty());
    const std::vector<glm::dvec2> same(5, glm::dvec2(1, 2));
    EXPECT_LT(outlineOf(same).size(), 3u);
    std::vector<glm::dvec2> line;
    for (int i = 0; i < 20; ++i)
        line.emplace_back(0.1 * i, 0.3 * i + (i % 3) * 1e-8);
    EXPECT_LT(outlineOf(line).size(), 3u);
}
