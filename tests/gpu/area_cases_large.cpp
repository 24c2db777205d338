// Hard area problems: many occluders, many corners, and very large and small scenes.
#include "gpu/area_scenes.h"

namespace antumbra {

namespace {

using app::AreaProblem;
using glm::dvec3;

AreaProblem common(RandomInputs& random) { return commonAreaProblem(random, 4); }

AreaProblem manyOccluders(RandomInputs& random)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    for (uint32_t i = 8 + random.index(9); i > 0; --i) {
        const dvec3 aim = scene.lightCentre + random.direction() * scene.lightSize;
        const scene::ConvexBody& shape = random.index(2) == 0 ? boxShape() : random.index(2) == 0 ? squareShape() : ballShape(0);
        scene.add(turnedBody(random, shape, scene.point + (aim - scene.point) * random.uniform(0.25, 0.7),
                             random.uniform(0.1, 0.3) * scene.lightSize));
    }
    return scene.problem;
}

AreaProblem hulls(RandomInputs& random, const scene::ConvexBody& shape)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    for (uint32_t i = 1 + random.index(3); i > 0; --i) {
        const dvec3 aim = scene.lightCentre + random.direction() * 0.7 * scene.lightSize;
        scene.add(turnedBody(random, shape, scene.point + (aim - scene.point) * random.uniform(0.3, 0.7),
                             random.uniform(0.2, 0.5) * scene.lightSize));
    }
    return scene.problem;
}

AreaProblem hulls42(RandomInputs& random) { return hulls(random, ballShape(1)); }
AreaProblem hulls154(RandomInputs& random) { return hulls(random, globeShape()); }

AreaProblem hugeAndTiny(RandomInputs& random)
{
    const double scale = random.logUniform(1e-6, 1e6);
    return moved(commonAreaProblem(random, 3), randomTurn(random, random.direction()) * scale, random.direction() * scale);
}

AreaProblem mirrored(RandomInputs& random)
{
    const glm::dmat3 mirror(dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1));
    return moved(commonAreaProblem(random, 3), randomTurn(random, random.direction()) * mirror, dvec3(0));
}

} // namespace

std::vector<AreaCategory> largeCategories()
{
    return {{"Common", common},     {"ManyOccluders", manyOccluders}, {"Hulls42", hulls42},
            {"Hulls154", hulls154}, {"HugeAndTiny", hugeAndTiny},     {"Mirrored", mirrored}};
}

} // namespace antumbra
