// Hard area problems: occluders behind lights, in their planes and in their bodies, and lights across the horizon.
#include "gpu/area_scenes.h"

namespace antumbra {

namespace {

using app::AreaProblem;
using glm::dvec3;

dvec3 someVertex(RandomInputs& random, const scene::ConvexBody& body)
{
    return dvec3(body.vertices[random.index(static_cast<uint32_t>(body.vertices.size()))]);
}

AreaProblem behindLight(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    scene.add(randomBody(random, scene.onTheWay(random.uniform(2.2, 3)), random.uniform(0.3, 0.6)));
    if (random.index(2) == 0)
        addCommonOccluder(scene, random);
    return scene.problem;
}

AreaProblem acrossLightsPlane(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kPlanarKinds)));
    for (uint32_t i = 1 + random.index(3); i > 0; --i) {
        const dvec3 a = someVertex(random, scene.problem.light), b = someVertex(random, scene.problem.light);
        const dvec3 middle = glm::mix(a, b, random.uniform(0, 1)) + random.direction() * 0.15;
        if (random.index(4) == 0)
            scene.add(turnedBody(random, squareShape(), middle, random.uniform(0.3, 0.8)));
        else
            scene.add(randomBody(random, middle, random.uniform(0.2, 0.8)));
    }
    return scene.problem;
}

AreaProblem acrossLightBodies(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(kPlanarKinds + random.index(kLightKinds - kPlanarKinds)));
    for (uint32_t i = 1 + random.index(3); i > 0; --i) {
        const dvec3 middle = someVertex(random, scene.problem.light) + random.direction() * 0.25;
        scene.add(randomBody(random, middle, random.uniform(0.1, 0.4)));
    }
    return scene.problem;
}

AreaProblem acrossHorizon(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    addCommonOccluder(scene, random);
    const dvec3 towards = glm::normalize(scene.lightCentre - scene.point);
    setFrame(scene, random, glm::normalize(random.perpendicularTo(towards) + towards * random.uniform(-0.25, 0.25)));
    return scene.problem;
}

/// A torus or an L as front faces of a closed mesh.
AreaProblem notConvex(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kPlanarKinds)));
    const glm::dmat3 turn = randomTurn(random, random.direction());
    const dvec3 middle = scene.onTheWay(0.55);
    constexpr uint32_t kAround = 8, kTube = 5;
    const auto at = [&](uint32_t i, uint32_t k) {
        const double around = 2 * std::numbers::pi * (i % kAround) / kAround, tube = 2 * std::numbers::pi * (k % kTube) / kTube;
        const double radius = 0.3 + 0.12 * std::cos(tube);
        return middle + turn * dvec3(radius * std::cos(around), radius * std::sin(around), 0.12 * std::sin(tube));
    };
    for (uint32_t i = 0; i < kAround; ++i)
        for (uint32_t k = 0; k < kTube; ++k) {
            scene.add(triangle(at(i, k), at(i + 1, k), at(i + 1, k + 1)), true);
            scene.add(triangle(at(i, k), at(i + 1, k + 1), at(i, k + 1)), true);
        }
    if (random.index(2) == 0)
        addCommonOccluder(scene, random);
    return scene.problem;
}

} // namespace

std::vector<AreaCategory> depthCategories()
{
    return {{"BehindLight", behindLight},
            {"AcrossLightsPlane", acrossLightsPlane},
            {"AcrossLightBodies", acrossLightBodies},
            {"AcrossHorizon", acrossHorizon},
            {"NotConvex", notConvex}};
}

} // namespace antumbra
