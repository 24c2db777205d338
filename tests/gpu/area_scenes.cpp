#include "gpu/area_scenes.h"

#include "base/bounds.h"

namespace antumbra {

using glm::dmat3;
using glm::dvec3;
using scene::ConvexBody;

double dyadic(RandomInputs& random, double least, double greatest) { return std::round(random.uniform(least, greatest) * 1024) / 1024; }

void AreaScene::addTriangles(const ConvexBody& body, bool isFrontOnly)
{
    for (ConvexBody& each : trianglesOf(body))
        add(std::move(each), isFrontOnly);
}

void setLobe(AreaScene& scene, RandomInputs& random, double leastWidth)
{
    dmat3 lobe(1);
    if (random.index(2) == 0) {
        const double lean = random.uniform(0, 1.35), width = random.logUniform(leastWidth, 1);
        const double across = std::clamp(width * random.uniform(0.7, 1.4), leastWidth, 1.0);
        const dmat3 lean3(dvec3(std::cos(lean), 0, -std::sin(lean)), dvec3(0, 1, 0), dvec3(std::sin(lean), 0, std::cos(lean)));
        const dmat3 shear(dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(random.uniform(-0.2, 0.2), 0, 1));
        const dmat3 spread(dvec3(width, 0, 0), dvec3(0, across, 0), dvec3(0, 0, 1));
        lobe = glm::inverse(lean3 * shear * spread) * random.logUniform(0.1, 10); // of any scale
    }
    const dmat3 rows = glm::transpose(lobe);
    for (int row = 0; row < 3; ++row)
        scene.problem.lobe[static_cast<size_t>(row)] = vec3(rows[row]);
}

void setFrame(AreaScene& scene, RandomInputs& random, const dvec3& normal)
{
    scene.problem.normal = vec3(normal);
    const dvec3 towards = scene.lightCentre - scene.point, flat = towards - normal * glm::dot(towards, normal);
    const dvec3 leaning = glm::length(flat) > 1e-3 ? glm::normalize(flat) + 0.3 * random.direction() : random.direction();
    const dvec3 tangent = leaning - normal * glm::dot(leaning, normal);
    scene.problem.tangent = vec3(glm::normalize(glm::length(tangent) > 1e-3 ? tangent : random.perpendicularTo(normal)));
}

ConvexBody lightBody(RandomInputs& random, LightKind kind, const dvec3& position, const dvec3& towards, double size)
{
    Placement place{randomTurn(random, glm::normalize(towards - position) + 0.6 * random.direction()), dvec3(size), position};
    switch (kind) {
    case LightKind::Square: place.scale.y *= random.uniform(0.4, 1); return placed(squareShape(), place);
    case LightKind::Disc: return placed(polygonShape(20), place);
    case LightKind::Ball: place.scale = dvec3(0.6 * size); return placed(ballShape(1), place);
    case LightKind::Prism: place.scale = dvec3(0.35, 0.35, 1) * size; return placed(prismShape(10), place);
    default: place.scale = dvec3(0.5, random.uniform(0.1, 0.6), 0.7) * size; return placed(boxShape(), place);
    }
}

AreaScene openScene(RandomInputs& random, LightKind kind)
{
    AreaScene scene;
    scene.problem.position = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    scene.point = dvec3(scene.problem.position);
    const dvec3 normal = random.direction();
    dvec3 towards = random.direction();
    if (glm::dot(towards, normal) < 0)
        towards = -towards;
    scene.lightCentre = scene.point + glm::normalize(towards + 0.15 * normal) * random.uniform(1.5, 4);
    scene.lightSize = random.uniform(0.3, 1.1);
    setFrame(scene, random, normal);
    setLobe(scene, random);
    scene.problem.light = lightBody(random, kind, scene.lightCentre, scene.point, scene.lightSize);
    scene.problem.isTwoSided = scene.problem.light.isPlanar;
    return scene;
}

ConvexBody turnedBody(RandomInputs& random, const ConvexBody& shape, const dvec3& position, double size)
{
    const dvec3 scale(random.uniform(0.6, 1), random.uniform(0.6, 1), random.uniform(0.6, 1));
    return placed(shape, Placement{randomTurn(random, random.direction()), scale * size, position});
}

ConvexBody randomBody(RandomInputs& random, const dvec3& position, double size)
{
    const ConvexBody* const kShapes[] = {&boxShape(), &ballShape(0), &ballShape(1), &globeShape(), &prismShape(6), &prismShape(13)};
    return turnedBody(random, *kShapes[random.index(std::size(kShapes))], position, size);
}

void addCommonOccluder(AreaScene& scene, RandomInputs& random, double spread)
{
    const double share = random.uniform(0.25, 0.7);
    const dvec3 aim = scene.lightCentre + random.direction() * scene.lightSize * spread;
    scene.add(randomBody(random, scene.point + (aim - scene.point) * share, random.uniform(0.1, 0.4) * scene.lightSize));
}

FlatScene flatScene(RandomInputs& random, double leastWidth)
{
    FlatScene scene;
    const double a = dyadic(random, 0.3, 1), b = dyadic(random, 0.3, 1), x = dyadic(random, -0.5, 0.5), y = dyadic(random, -0.5, 0.5),
                 height = dyadic(random, 1, 2);
    scene.corners = {dvec3(x - a, y - b, height), dvec3(x - a, y + b, height), dvec3(x + a, y + b, height), dvec3(x + a, y - b, height)};
    scene.lightCentre = {x, y, height};
    scene.lightSize = a;
    scene.problem.light = scene.card(1);
    scene.problem.isTwoSided = random.index(2) == 0;
    setLobe(scene, random, leastWidth);
    return scene;
}

app::AreaProblem maybeTurned(RandomInputs& random, const app::AreaProblem& problem)
{
    if (random.index(2) == 0)
        return problem;
    return moved(problem, randomTurn(random, random.direction()), random.direction() * random.uniform(0, 3));
}

app::AreaProblem commonAreaProblem(RandomInputs& random, uint32_t mostOccluders)
{
    AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
    for (uint32_t i = random.index(mostOccluders + 1); i > 0; --i)
        addCommonOccluder(scene, random);
    return scene.problem;
}

double sizeOf(const app::AreaProblem& problem)
{
    Aabb box;
    box.add(problem.position);
    const auto addAll = [&](const ConvexBody& body) {
        for (const vec3& vertex : body.vertices)
            box.add(vertex);
    };
    addAll(problem.light);
    for (const app::AreaOccluder& occluder : problem.occluders)
        addAll(occluder.body);
    const vec3 extent = box.extent();
    return std::max({extent.x, extent.y, extent.z});
}

app::AreaProblem jittered(const app::AreaProblem& problem, RandomInputs& random, double metres, Jitter kind)
{
    app::AreaProblem result = problem;
    const auto step = [&] {
        return dvec3(random.uniform(-metres, metres), random.uniform(-metres, metres), random.uniform(-metres, metres));
    };
    const auto move = [&](ConvexBody& body) {
        const dvec3 common = step();
        for (vec3& vertex : body.vertices)
            vertex = vec3(dvec3(vertex) + (kind == Jitter::Bodies ? common : step()));
    };
    result.position = vec3(dvec3(result.position) + step());
    move(result.light);
    for (app::AreaOccluder& occluder : result.occluders)
        move(occluder.body);
    return result;
}

app::AreaProblem inTriangles(const app::AreaProblem& problem)
{
    app::AreaProblem result = problem;
    result.occluders.clear();
    for (const app::AreaOccluder& occluder : problem.occluders)
        for (ConvexBody& each : trianglesOf(occluder.body))
            result.occluders.push_back({std::move(each), false});
    return result;
}

app::AreaProblem moved(const app::AreaProblem& problem, const dmat3& linear, const dvec3& offset)
{
    app::AreaProblem result = problem;
    const bool isMirrored = glm::determinant(linear) < 0;
    const auto move = [&](ConvexBody& body) {
        if (isMirrored) // turns the loops
            body = scene::transformed(body, mat4(-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1));
        for (vec3& vertex : body.vertices)
            vertex = vec3(linear * (isMirrored ? -dvec3(vertex) : dvec3(vertex)) + offset);
    };
    result.position = vec3(linear * dvec3(problem.position) + offset);
    result.normal = vec3(glm::normalize(linear * dvec3(problem.normal)));
    result.tangent = vec3(glm::normalize(linear * dvec3(problem.tangent)));
    // The bitangent comes from the other two: it is on the other side now.
    for (size_t row = 0; isMirrored && row < 3; ++row)
        result.lobe[row] *= row == 1 ? vec3(-1, 1, -1) : vec3(1, -1, 1);
    move(result.light);
    for (app::AreaOccluder& occluder : result.occluders)
        move(occluder.body);
    return result;
}

std::span<const AreaCategory> areaCategories()
{
    static const std::vector<AreaCategory> kCategories = [] {
        std::vector<AreaCategory> all;
        for (const auto& part : {coincidentCategories(), contactCategories(), degenerateCategories(), depthCategories(), largeCategories()})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }();
    return kCategories;
}

} // namespace antumbra
