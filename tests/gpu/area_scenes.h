// What the categories of hard area problems are made from: a receiver with its lobe, a light, and places between them.
#pragma once

#include "gpu/area_cases.h"
#include "gpu/area_shapes.h"

namespace antumbra {

/// Multiples of 1/1024, which coincidences survive the rounding of.
double dyadic(RandomInputs& random, double least, double greatest);

/// A problem under way, in double.
struct AreaScene
{
    app::AreaProblem problem;
    glm::dvec3 point{0}, lightCentre{0};
    double lightSize = 1; // about half as wide

    void add(scene::ConvexBody body, bool isFrontOnly = false) { problem.occluders.push_back({std::move(body), isFrontOnly}); }
    void addTriangles(const scene::ConvexBody& body, bool isFrontOnly);
    /// On the way to the light, 0 at the point and 1 at the light's centre.
    [[nodiscard]] glm::dvec3 onTheWay(double share) const { return point + (lightCentre - point) * share; }
};

/// Half of them the clamped cosine, else like GGX: leaning, sheared, and from `leastWidth` to 1 as wide.
void setLobe(AreaScene& scene, RandomInputs& random, double leastWidth = 0.02);
/// The tangent, and so the lobe, leans to the light.
void setFrame(AreaScene& scene, RandomInputs& random, const glm::dvec3& normal);

enum class LightKind { Square, Disc, Ball, Prism, Box };
constexpr uint32_t kPlanarKinds = 2, kLightKinds = 5;

/// Planar ones shine to both sides.
scene::ConvexBody lightBody(RandomInputs& random, LightKind kind, const glm::dvec3& position, const glm::dvec3& towards, double size);

/// A point anywhere in [-1, 1]^3 and a light 1.5 to 4 away over its horizon. No occluders.
AreaScene openScene(RandomInputs& random, LightKind kind);

/// Convex, turned at random, of unlike extents: box, 12, 42 and 154 vertices, prism.
scene::ConvexBody randomBody(RandomInputs& random, const glm::dvec3& position, double size);
scene::ConvexBody turnedBody(RandomInputs& random, const scene::ConvexBody& shape, const glm::dvec3& position, double size);
/// Between the point and the light, of a size to hide part of it.
void addCommonOccluder(AreaScene& scene, RandomInputs& random, double spread = 1);

/// The point in the origin below a rectangle that faces it; all is a multiple of 1/1024.
struct FlatScene : AreaScene
{
    std::array<glm::dvec3, 4> corners;

    [[nodiscard]] glm::dvec3 corner(uint32_t i, double share) const { return corners[i % 4] * share; }
    [[nodiscard]] scene::ConvexBody card(double share) const
    {
        return quad(corner(0, share), corner(1, share), corner(2, share), corner(3, share));
    }
};
FlatScene flatScene(RandomInputs& random, double leastWidth = 0.02);

/// As it is, or, every other time, turned and rounded, so that what coincides does so to rounding only.
app::AreaProblem maybeTurned(RandomInputs& random, const app::AreaProblem& problem);

// The categories, by file.
std::vector<AreaCategory> coincidentCategories();
std::vector<AreaCategory> contactCategories();
std::vector<AreaCategory> degenerateCategories();
std::vector<AreaCategory> depthCategories();
std::vector<AreaCategory> largeCategories();

} // namespace antumbra
