// Hard area problems: what coincides seen from the point. Corners, edges, whole outlines, occluders with each other and with the light.
#include "gpu/area_scenes.h"

namespace antumbra {

namespace {

using app::AreaProblem;
using glm::dvec3;

constexpr double kShares[] = {0.5, 0.25, 0.75};

double someShare(RandomInputs& random) { return kShares[random.index(3)]; }

/// Of the card's plane.
dvec3 inPlane(RandomInputs& random, double size) { return {dyadic(random, -size, size), dyadic(random, -size, size), 0}; }

AreaProblem coincidentCorners(RandomInputs& random)
{
    FlatScene scene = flatScene(random);
    const uint32_t first = random.index(4);
    const double share = someShare(random);
    const dvec3 a = scene.corner(first, share), b = scene.corner(first + 1 + random.index(3), share);
    scene.add(triangle(a, a + inPlane(random, 0.4), b + inPlane(random, 0.1)));
    scene.add(triangle(a, a + inPlane(random, 0.4), b));
    if (random.index(2) == 0) { // a corner of a box on the way to a corner of the light, another on that to a triangle's
        const double size = a.z * 0.125 * someShare(random); // which keeps it above the point
        scene.add(placed(boxShape(), Placement{.scale = dvec3(size), .position = a * 0.5 + dvec3(size, size, -size)}));
    }
    return maybeTurned(random, scene.problem);
}

AreaProblem coincidentEdges(RandomInputs& random)
{
    FlatScene scene = flatScene(random);
    const uint32_t first = random.index(4);
    const auto corner = [&](uint32_t i) { return scene.corner(first + i, 0.5); };
    const double part = dyadic(random, 0.1, 0.9);
    const dvec3 across = (corner(3) - corner(0)) * part;
    switch (random.index(3)) {
    case 0:
        scene.add(quad(corner(0), corner(1), corner(1) + across, corner(0) + across));
        scene.add(quad(corner(0) + across, corner(1) + across, corner(1) + across * 1.25, corner(0) + across * 1.25));
        break;
    case 1:
        scene.add(triangle(corner(0), corner(1), corner(2)));
        scene.add(triangle(corner(0), corner(2), corner(0) + across));
        break;
    default: // a box whose near edges lie on the way to the light's
        const dvec3 low = scene.corner(0, 0.5), high = scene.corner(2, 0.5);
        scene.add(placed(boxShape(), [&](const dvec3& v) {
            return dvec3(v.x < 0 ? low.x : low.x + (high.x - low.x) * part, v.y < 0 ? low.y : high.y, low.z + (v.z < 0 ? 0 : 0.125));
        }));
        break;
    }
    return maybeTurned(random, scene.problem);
}

AreaProblem sharedEdges(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kPlanarKinds)));
    const dvec3 middle = scene.onTheWay(random.uniform(0.3, 0.7)) + random.direction() * 0.2 * scene.lightSize;
    const double size = random.uniform(0.15, 0.4) * scene.lightSize;
    if (random.index(2) == 0) {
        const scene::ConvexBody* const kShapes[] = {&boxShape(), &ballShape(0), &prismShape(6)};
        const bool isFrontOnly = random.index(2) == 0; // else from both sides, so that all is hidden twice
        scene.addTriangles(turnedBody(random, *kShapes[random.index(3)], middle, size), isFrontOnly);
        return scene.problem;
    }
    // A fan of cards around one corner, not flat.
    const uint32_t count = 5 + random.index(11);
    const glm::dmat3 turn = randomTurn(random, scene.point - middle);
    std::vector<dvec3> rim;
    for (uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        rim.push_back(middle + turn * dvec3(size * std::cos(angle), size * std::sin(angle), random.uniform(-0.3, 0.3) * size));
    }
    for (uint32_t i = 0; i < count; ++i)
        scene.add(triangle(middle, rim[i], rim[(i + 1) % count]));
    return scene.problem;
}

/// Its near face is the light's outline, its far one keeps within.
scene::ConvexBody coveringBox(const FlatScene& scene, double nearShare, double farShare)
{
    const dvec3 low = scene.corner(0, nearShare), high = scene.corner(2, nearShare);
    return placed(boxShape(), [&](const dvec3& v) {
        return dvec3(v.x < 0 ? low.x : high.x, v.y < 0 ? low.y : high.y, v.z < 0 ? low.z : scene.corner(0, farShare).z);
    });
}

AreaProblem exactCover(RandomInputs& random)
{
    FlatScene scene = flatScene(random);
    const double share = someShare(random);
    const auto corner = [&](uint32_t i) { return scene.corner(i, share); };
    const dvec3 middle = glm::mix(corner(0), corner(2), 0.5);
    switch (random.index(5)) {
    case 0: scene.add(scene.card(share)); break;
    case 1:
        scene.add(triangle(corner(0), corner(1), corner(2)));
        scene.add(triangle(corner(0), corner(2), corner(3)));
        break;
    case 2: scene.add(coveringBox(scene, 0.5, 0.75)); break;
    case 3: // four quarters, one of them at another distance
        for (uint32_t i = 0; i < 4; ++i) {
            const dvec3 before = glm::mix(corner(i), corner(i + 3), 0.5), after = glm::mix(corner(i), corner(i + 1), 0.5);
            const double nearer = i == 2 ? 0.5 : 1;
            scene.add(quad(corner(i) * nearer, after * nearer, middle * nearer, before * nearer));
        }
        break;
    default: // twice over, and what is before it makes no difference
        scene.add(scene.card(0.5));
        scene.add(scene.card(0.25));
        scene.add(triangle(corner(0), corner(2), middle + dvec3(0.25, 0.125, 0)));
        break;
    }
    return maybeTurned(random, scene.problem);
}

AreaProblem sameOccluders(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    addCommonOccluder(scene, random, 0.5);
    const app::AreaOccluder first = scene.problem.occluders[0];
    for (uint32_t i = 1 + random.index(4); i > 0; --i)
        scene.problem.occluders.push_back(first);
    return scene.problem;
}

AreaProblem sameAsLight(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    const scene::ConvexBody light = scene.problem.light;
    if (light.isPlanar && random.index(2) == 0)
        scene.addTriangles(light, false);
    else
        scene.add(light);
    if (random.index(2) == 0)
        addCommonOccluder(scene, random);
    return scene.problem;
}

} // namespace

std::vector<AreaCategory> coincidentCategories()
{
    return {{"CoincidentCorners", coincidentCorners},
            {"CoincidentEdges", coincidentEdges},
            {"SharedEdges", sharedEdges},
            {"ExactCover", exactCover},
            {"SameOccluders", sameOccluders},
            {"SameAsLight", sameAsLight, "the occluder comes before the light, in part or whole"}};
}

} // namespace antumbra
