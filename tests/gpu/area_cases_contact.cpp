// Hard area problems: the point in contact. Occluders that it touches, that hold or surround it, lights that it nearly touches, planes that
// it lies in.
#include "gpu/area_scenes.h"

namespace antumbra {

namespace {

using app::AreaProblem;
using glm::dvec3;

// Near the point a jitter turns directions far: in narrow lobes that alone would move shares by more than is asked of them.
constexpr double kLeastWidth = 0.2;

AreaProblem touching(RandomInputs& random)
{
    FlatScene scene = flatScene(random, kLeastWidth);
    const double size = dyadic(random, 0.05, 0.5), gap = std::array{0.0, 0.0, 1e-5, 1e-3}[random.index(4)];
    const double aside = dyadic(random, -0.9, 0.9) * size;
    // What of a box of half this size touches the point: a face, an edge or a corner of it, or its top, with the point inside or on its
    // rim.
    const dvec3 kPlaces[] = {
        {size + gap, aside, 0.5 * size}, {size + gap, size, size},  {size + gap, size, 0}, {aside, aside, -size - gap},
        {aside, aside, size + gap},      {size + gap, aside, size}, {size, aside, -size},  {size + gap, size + gap, size}};
    scene.add(placed(boxShape(), Placement{.scale = dvec3(size), .position = kPlaces[random.index(std::size(kPlaces))]}));
    if (random.index(2) == 0)
        scene.add(triangle(scene.corner(0, 0.5), scene.corner(1, 0.5), scene.corner(2, 0.5)));
    if (random.index(3) == 0) { // a round body with a corner at the point
        scene::ConvexBody ball = turnedBody(random, ballShape(1), dvec3(0), 0.2);
        const dvec3 corner(ball.vertices[random.index(42)]);
        scene.add(placed(ball, [&](const dvec3& v) { return v - corner; }));
    }
    return maybeTurned(random, scene.problem);
}

AreaProblem holding(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    addCommonOccluder(scene, random);
    const double size = random.logUniform(1e-2, 0.3);
    scene.add(randomBody(random, scene.point + random.direction() * 0.3 * size, size));
    return scene.problem;
}

/// A ring of thin boxes or a torus of triangles about the point; or the point just before a wall that fills half of what it sees.
AreaProblem surrounding(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    setLobe(scene, random, kLeastWidth);
    if (random.index(2) == 0) {
        const dvec3 away = random.direction();
        const Placement wall{randomTurn(random, away), dvec3(2, 2, 0.25), scene.point + away * (0.25 + random.logUniform(1e-4, 0.1))};
        scene.add(placed(boxShape(), wall));
        return scene.problem;
    }
    const glm::dmat3 turn = randomTurn(random, random.direction());
    const uint32_t sides = 3 + random.index(6);
    const double height = random.uniform(0.1, 0.6);
    for (uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides, length = std::tan(std::numbers::pi / sides);
        const glm::dmat3 side =
            turn * glm::dmat3(dvec3(std::cos(angle), std::sin(angle), 0), dvec3(-std::sin(angle), std::cos(angle), 0), dvec3(0, 0, 1));
        scene.add(placed(boxShape(), Placement{side, dvec3(0.02, 0.5 * length, height), scene.point + side * dvec3(0.5, 0, 0)}));
    }
    return scene.problem;
}

AreaProblem nearlyHemisphericalLight(RandomInputs& random)
{
    FlatScene scene = flatScene(random, kLeastWidth);
    const double height = random.logUniform(2e-3, 0.1);
    const Placement place{glm::dmat3(dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(0, 0, -1)), dvec3(1),
                          dvec3(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), height)};
    scene.problem.light = placed(random.index(2) == 0 ? squareShape() : polygonShape(40), place);
    for (uint32_t i = random.index(4); i > 0; --i) {
        const dvec3 aside(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0.5);
        scene.add(randomBody(random, aside * height, random.uniform(0.1, 0.4) * height));
    }
    return maybeTurned(random, scene.problem);
}

AreaProblem pointInLightsPlane(RandomInputs& random)
{
    FlatScene scene = flatScene(random, kLeastWidth);
    const double start = std::array{0.25, 0.0, -0.25, -1.0}[random.index(4)], half = dyadic(random, 0.2, 0.6);
    // Upright or level, the point in its plane, outside or inside or on its rim.
    scene.problem.light = random.index(2) == 0 ? quad({0, -half, start}, {0, half, start}, {0, half, start + 1}, {0, -half, start + 1})
                                               : quad({start, -half, 0}, {start + 1, -half, 0}, {start + 1, half, 0}, {start, half, 0});
    scene.problem.isTwoSided = random.index(4) > 0;
    if (random.index(2) == 0) { // bodies with faces that the point is level with
        const double radius = dyadic(random, 0.1, 0.4);
        const Placement upright{.scale = dvec3(radius, radius, 0.5), .position = dvec3(radius, dyadic(random, -0.1, 0.1), 1)};
        scene.problem.light = placed(random.index(2) == 0 ? boxShape() : ballShape(0), upright);
    }
    scene.add(turnedBody(random, boxShape(), dvec3(0.1, 0.1, 0.4), 0.1));
    return maybeTurned(random, scene.problem);
}

AreaProblem edgeOn(RandomInputs& random)
{
    FlatScene scene = flatScene(random);
    const double side = dyadic(random, -0.5, 0.5), top = dyadic(random, 0.5, 0.75), bottom = dyadic(random, 0.1, 0.4);
    // A card in a plane through the point, a box with a level side, the same box as triangles.
    const dvec3 along(dyadic(random, 0.1, 0.6), dyadic(random, -0.5, 0.5), 0), up(0, 0, 1);
    scene.add(quad(along * side + up * bottom, along + up * bottom, along + up * top, along * side + up * top));
    const auto box = placed(boxShape(), Placement{.scale = dvec3(0.125, 0.25, 0.125), .position = dvec3(0.125, side, 0.5)});
    if (random.index(2) == 0)
        scene.add(box);
    else
        scene.addTriangles(box, random.index(2) == 0);
    return maybeTurned(random, scene.problem);
}

/// Faces of one plane, as triangles, that the point is almost level with: some of them count as front and some as back.
AreaProblem grazingFaces(RandomInputs& random)
{
    static const std::array kShapes{triangulated(boxShape()), triangulated(prismShape(9)), triangulated(prismShape(24))};
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    setLobe(scene, random, kLeastWidth);
    const dvec3 towards = glm::normalize(scene.lightCentre - scene.point), up = random.perpendicularTo(towards);
    const double size = random.uniform(0.1, 0.3), gap = random.logUniform(1e-9, 1e-3) * (random.index(2) == 0 ? 1 : -1);
    const Placement place{randomTurn(random, up), dvec3(size, size, 0.5 * size), scene.onTheWay(0.5) - up * (0.5 * size + gap)};
    scene.add(placed(kShapes[random.index(3)], place));
    return scene.problem;
}

} // namespace

std::vector<AreaCategory> contactCategories()
{
    constexpr double kOfTheLight = 1e-8; // what is before it is a hundredth of it and less
    return {{"Touching", touching, "the point goes into the occluder or out of it", kContactTolerance},
            {"Holding", holding},
            {"Surrounding", surrounding},
            {"NearlyHemisphericalLight", nearlyHemisphericalLight, "", kContactTolerance, kOfTheLight},
            {"PointInLightsPlane", pointInLightsPlane, "the point goes through the light's plane", kContactTolerance},
            {"EdgeOn", edgeOn},
            {"GrazingFaces", grazingFaces}};
}

} // namespace antumbra
