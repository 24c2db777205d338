#include "body_checks.h"
#include "scene/light_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

constexpr double kPiDouble = std::numbers::pi;

ConvexBody bodyOf(const AreaLight& light, uint32_t segments = 24)
{
    const std::optional<ConvexBody> body = lightBody(light, nullptr, segments);
    EXPECT_TRUE(body);
    return body.value_or(ConvexBody{});
}

AreaLight polygonLight(std::initializer_list<vec2> corners)
{
    AreaLight light{.shape = LightShape::Polygon};
    for (const vec2 corner : corners)
        light.outline.at(light.outlineCount++) = corner;
    return light;
}

void expectFacesUp(const ConvexBody& body)
{
    expectPlanarConvex(body);
    EXPECT_NEAR(faceNormals(body)[0].y, 1, 1e-12);
    for (const vec3& vertex : body.vertices)
        EXPECT_EQ(vertex.y, 0);
}

} // namespace

TEST(LightBody, AQuadSpansItsSizeAndFacesUp)
{
    const ConvexBody body = bodyOf({.shape = LightShape::Quad, .size = {3, 0.5f}});
    expectFacesUp(body);
    Aabb box;
    for (const vec3& vertex : body.vertices)
        box.add(vertex);
    EXPECT_EQ(box.extent(), vec3(3, 0, 0.5f));
    EXPECT_EQ(box.centre(), vec3(0));
}

TEST(LightBody, ADiskHasItsArea)
{
    for (const uint32_t segments : {3u, 4u, 7u, 24u, 128u})
        for (const vec2 radii : {vec2{0.5f}, vec2{2, 0.1f}}) {
            const ConvexBody body = bodyOf({.shape = LightShape::Disk, .radii = radii}, segments);
            expectFacesUp(body);
            EXPECT_EQ(body.vertices.size(), segments);
            EXPECT_NEAR(surfaceArea(body) / (kPiDouble * radii.x * radii.y), 1, 1e-6);
        }
    const ConvexBody ellipse = bodyOf({.shape = LightShape::Disk, .radii = {2, 0.1f}}, 64);
    EXPECT_NEAR(greatestExtent(ellipse.vertices), 4, 0.01);
}

TEST(LightBody, ASphereHasItsSurfaceAndAboutTheVerticesWanted)
{
    const std::pair<uint32_t, size_t> cases[]{{3, 12},  {12, 12},   {24, 32},   {32, 32},  {40, 42},
                                              {92, 92}, {120, 122}, {256, 252}, {272, 272}};
    for (const auto& [wanted, got] : cases) {
        const ConvexBody body = bodyOf({.shape = LightShape::Sphere, .radii = vec2{0.7f}}, wanted);
        expectClosedConvex(body);
        EXPECT_EQ(body.vertices.size(), got);
        EXPECT_EQ(body.faces.size(), 2 * got - 4);
        EXPECT_NEAR(surfaceArea(body) / (4 * kPiDouble * 0.49), 1, 1e-6);
        EXPECT_NEAR(glm::length(body.vertices[0]), glm::length(body.vertices.back()), 1e-6);
    }
}

TEST(LightBody, ASpheresTrianglesAreOfOneKind)
{
    for (const uint32_t vertices : {12u, 32u, 42u, 92u, 122u, 162u, 272u}) {
        const ConvexBody body = bodyOf({.shape = LightShape::Sphere}, vertices);
        double shortest = std::numeric_limits<double>::max();
        double longest = 0;
        for (const ConvexBody::Edge& edge : body.edges) {
            const double length = glm::distance(body.vertices[edge.a], body.vertices[edge.b]);
            shortest = std::min(shortest, length);
            longest = std::max(longest, length);
        }
        EXPECT_LT(longest / shortest, 1.35) << vertices;
    }
}

TEST(LightBody, ACylinderHasItsSurfaceAndLength)
{
    for (const uint32_t segments : {3u, 8u, 24u})
        for (const float length : {0.01f, 1.0f, 40.0f}) {
            const ConvexBody body = bodyOf({.shape = LightShape::Cylinder, .radii = vec2{0.5f}, .length = length}, segments);
            expectClosedConvex(body);
            EXPECT_EQ(body.vertices.size(), 2 * segments);
            EXPECT_EQ(body.faces.size(), segments + 2);
            EXPECT_NEAR(surfaceArea(body) / (2 * kPiDouble * 0.5 * (0.5 + length)), 1, 1e-6);
            for (const vec3& vertex : body.vertices)
                EXPECT_EQ(std::abs(vertex.y), 0.5f * length);
        }
}

TEST(LightBody, ACylindersSurfaceIsSharedAsTheHeaderSays)
{
    const ConvexBody body = bodyOf({.shape = LightShape::Cylinder, .radii = vec2{0.5f}, .length = 1}, 8);
    const double cap = volumeOf(body); // over a length of one
    EXPECT_NEAR(cap / (kPiDouble * 0.25), 1 - 0.027, 1e-3);
    EXPECT_NEAR((surfaceArea(body) - 2 * cap) / kPiDouble, 1 + 0.013, 1e-3);
}

TEST(LightBody, APolygonFacesUpInWhicheverSenseItIsGiven)
{
    for (const AreaLight& light : {polygonLight({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), polygonLight({{0, 1}, {2, 1}, {2, 0}, {0, 0}})}) {
        const ConvexBody body = bodyOf(light);
        expectFacesUp(body);
        EXPECT_EQ(body.vertices.size(), 4u);
        EXPECT_NEAR(surfaceArea(body), 2, 1e-6);
        for (const vec3& vertex : body.vertices)
            EXPECT_TRUE((vertex.x == 0 || vertex.x == 2) && (vertex.z == 0 || vertex.z == 1));
    }
}

TEST(LightBody, RepeatedAndCollinearCornersAreHarmless)
{
    const AreaLight light =
        polygonLight({{0, 0}, {0, 0}, {0.1f, 0.03f}, {0.7f, 0.21f}, {2, 0.6f}, {2, 0.6f}, {1, 3}, {0.5f, 1.5f}, {0, 0}});
    const ConvexBody body = bodyOf(light);
    expectFacesUp(body);
    EXPECT_EQ(body.vertices.size(), 3u);
    EXPECT_NEAR(surfaceArea(body), 2.7, 1e-6);
}

TEST(LightBody, APolygonWithoutAreaIsNone)
{
    EXPECT_FALSE(lightBody(polygonLight({}), nullptr, 8));
    EXPECT_FALSE(lightBody(polygonLight({{1, 1}, {1, 1}, {1, 1}}), nullptr, 8));
    EXPECT_FALSE(lightBody(polygonLight({{0, 0}, {1, 0.3f}, {2, 0.6f}}), nullptr, 8));
}

TEST(LightBody, AMeshIsTakenWhereItIsClosedAndConvex)
{
    const AreaLight light{.shape = LightShape::Mesh};
    const Mesh cube = makeCube();
    const std::optional<ConvexBody> body = lightBody(light, &cube, 8);
    ASSERT_TRUE(body);
    expectClosedConvex(*body);
    const Mesh plane = makePlane();
    EXPECT_FALSE(lightBody(light, &plane, 8));
    EXPECT_DEATH(lightBody(light, nullptr, 8), "has a mesh");
}

TEST(LightBody, RefusesSizesThatAreNone)
{
    EXPECT_DEATH(lightBody({.shape = LightShape::Quad, .size = {1, NAN}}, nullptr, 8), "positive and finite");
    EXPECT_DEATH(lightBody({.shape = LightShape::Sphere, .radii = vec2{0}}, nullptr, 8), "positive and finite");
    EXPECT_DEATH(lightBody({.shape = LightShape::Cylinder, .length = INFINITY}, nullptr, 8), "positive and finite");
    EXPECT_DEATH(lightBody({.shape = LightShape::Disk}, nullptr, 2), "segments");
    EXPECT_DEATH(lightBody(polygonLight({{0, 0}, {1, 0}, {0, NAN}}), nullptr, 8), "finite");
}

TEST(LightBody, HoldsAtVerySmallAndLargeSizes)
{
    for (const float size : {1e-6f, 1e6f}) {
        expectClosedConvex(bodyOf({.shape = LightShape::Sphere, .radii = vec2{size}}, 92));
        expectClosedConvex(bodyOf({.shape = LightShape::Cylinder, .radii = vec2{size}, .length = size}, 12));
        expectFacesUp(bodyOf({.shape = LightShape::Disk, .radii = vec2{size}}, 12));
    }
}
