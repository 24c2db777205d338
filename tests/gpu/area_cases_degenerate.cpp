// Hard area problems: shapes without area or almost so, repeated and collinear corners.
#include "gpu/area_scenes.h"

namespace antumbra {

namespace {

using app::AreaProblem;
using glm::dvec3;

AreaProblem tinyLight(RandomInputs& random)
{
    AreaScene scene = openScene(random, LightKind::Square);
    setLobe(scene, random, 0.2);
    const double distance = random.uniform(20, 100), share = random.logUniform(3e-5, 1e-3); // 1e-9 to 1e-6 sr
    const dvec3 towards = glm::normalize(scene.lightCentre - scene.point);
    scene.lightCentre = scene.point + towards * distance;
    scene.lightSize = distance * share;
    scene.problem.light =
        lightBody(random, static_cast<LightKind>(random.index(kLightKinds)), scene.lightCentre, scene.point, scene.lightSize);
    scene.problem.isTwoSided = true;
    // A large card or box whose edge goes through the light.
    const glm::dmat3 turn = randomTurn(random, towards);
    const dvec3 past = turn[0] * (1 + random.uniform(-0.6, 0.6) * 0.1 * scene.lightSize);
    const Placement place{turn, dvec3(1, 1, 0.05), scene.onTheWay(0.1) + past};
    scene.add(placed(random.index(2) == 0 ? squareShape() : boxShape(), place));
    return scene.problem;
}

AreaProblem slivers(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    const dvec3 towards = glm::normalize(scene.lightCentre - scene.point);
    for (uint32_t i = 2 + random.index(3); i > 0; --i) {
        const dvec3 middle = scene.onTheWay(random.uniform(0.3, 0.6)) + random.direction() * 0.1, along = random.direction();
        const double width = random.logUniform(1e-7, 0.1);
        const dvec3 across = glm::cross(along, towards) * width;
        if (random.index(3) > 0)
            scene.add(triangle(middle - along * 0.4, middle + along * 0.4, middle + along * 0.1 + across));
        else // a thin rod
            scene.add(placed(boxShape(), Placement{randomTurn(random, along), dvec3(width, width, 0.5), middle}));
    }
    return scene.problem;
}

/// Flattened in one of the first `kinds` ways: the first two along one axis, the next two along two, the last to one place.
scene::ConvexBody flattened(RandomInputs& random, const dvec3& position, double size, uint32_t kinds = 5)
{
    const scene::ConvexBody* const kShapes[] = {&boxShape(),      &ballShape(0),     &prismShape(6), &squareShape(),
                                                &polygonShape(3), &polygonShape(11), &ballShape(1)};
    const dvec3 kScales[] = {{1, 1, 0}, {0, 1, 1}, {1, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    const dvec3 scale = kScales[random.index(kinds)] * size;
    const bool isTurned = random.index(2) == 0;
    return placed(*kShapes[random.index(std::size(kShapes))],
                  Placement{isTurned ? randomTurn(random, random.direction()) : glm::dmat3(1), scale, position});
}

AreaProblem lightsWithoutArea(RandomInputs& random)
{
    AreaScene scene = openScene(random, LightKind::Square);
    scene.problem.light = flattened(random, scene.lightCentre, scene.lightSize);
    scene.problem.isTwoSided = random.index(2) == 0;
    addCommonOccluder(scene, random);
    return scene.problem;
}

AreaProblem occludersWithoutArea(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    for (uint32_t i = 1 + random.index(3); i > 0; --i)
        scene.add(flattened(random, scene.onTheWay(random.uniform(0.3, 0.7)) + random.direction() * 0.1, random.uniform(0.1, 0.4)));
    if (random.index(4) == 0)
        scene.add(flattened(random, scene.point, random.uniform(0, 0.2), 1)); // through the point
    addCommonOccluder(scene, random);
    return scene.problem;
}

/// A polygon with repeated corners, short edges and middles of edges among its corners.
scene::ConvexBody crowdedOutline(RandomInputs& random, const std::array<dvec3, 4>& corners)
{
    const double step = std::ldexp(1.0, -static_cast<int>(8 + random.index(14)));
    std::vector<vec3> vertices;
    scene::Loop loop;
    const auto put = [&](const dvec3& v) {
        loop.push_back(static_cast<uint32_t>(vertices.size()));
        vertices.emplace_back(v);
    };
    for (size_t i = 0; i < 4; ++i) {
        const dvec3 corner = corners[i], edge = corners[(i + 1) % 4] - corner;
        for (uint32_t k = random.index(3); k > 0; --k)
            put(corner);
        put(corner);
        put(corner + glm::normalize(edge) * step);
        if (random.index(2) == 0)
            put(corner + edge * 0.5);
    }
    return scene::makeBody(vertices, {&loop, 1});
}

AreaProblem crowdedOutlines(RandomInputs& random)
{
    FlatScene scene = flatScene(random);
    scene.problem.light = crowdedOutline(random, scene.corners);
    std::array<dvec3, 4> halfway;
    const dvec3 aside(random.index(2) == 0 ? 0 : dyadic(random, -0.2, 0.2), 0, 0);
    for (uint32_t i = 0; i < 4; ++i)
        halfway[i] = scene.corner(i, 0.5) + aside;
    scene.add(crowdedOutline(random, halfway));
    scene.add(randomBody(random, scene.onTheWay(0.5), random.uniform(0.1, 0.3)));
    return maybeTurned(random, scene.problem);
}

} // namespace

std::vector<AreaCategory> degenerateCategories()
{
    return {{"TinyLight", tinyLight},
            {"Slivers", slivers},
            {"LightsWithoutArea", lightsWithoutArea, "", kTolerance, 1e-6, Jitter::Bodies},
            {"OccludersWithoutArea", occludersWithoutArea, "a flat body goes through the point", kContactTolerance, 1e-6, Jitter::Bodies},
            {"CrowdedOutlines", crowdedOutlines, "", kShortEdgeTolerance}};
}

} // namespace antumbra
