// The scenes that methods/sdf-cones.md measures on, as steps; the points that their cameras see; and what is seen from them of a light, by
// rays on the CPU in double.
#pragma once

#include "gpu/random_fields.h"
#include "scene/images.h"

#include <functional>
#include <string>

namespace antumbra::truth {

struct FieldScene
{
    std::string name;
    FieldSteps steps;
    vec3 light; // centre
    float radius;
    vec3 eye;
    vec3 target;
};

/// prims: apart; csg: cut and melted; thin: rods, rings and a plate; slabs: sheets and a hole.
std::vector<FieldScene> fieldScenes();

/// A point just off a surface.
struct FieldReceiver
{
    size_t pixel;
    glm::dvec3 position;
    glm::dvec3 normal;
};

/// Of the pixels that show a surface, through an upright camera of 0.9 rad.
std::vector<FieldReceiver> receiversOf(const FieldScene& scene, uvec2 extent);

/// A parallelogram that shines to both sides.
struct FieldQuad
{
    glm::dvec3 corner;
    glm::dvec3 a; // its edges
    glm::dvec3 b;
};

/// About the place of the sphere light, 2 m by 1 m, facing the camera's target.
FieldQuad quadOf(const FieldScene& scene);

/// The share of a sphere's solid angle that is seen, by side^2 stratified rays.
double sphereSeen(const FieldSteps& steps, const glm::dvec3& from, const glm::dvec3& centre, double radius, int side, uint32_t seed);

/// What is seen of a quad's cosine-weighted solid angle, by side^2 stratified rays.
struct QuadSeen
{
    double share = 1;
    double whole = 0;         // of the hemisphere's
    uint64_t evaluations = 0; // of the field
};
QuadSeen quadSeen(const FieldSteps& steps, const FieldReceiver& at, const FieldQuad& quad, int side, uint32_t seed);

/// One value a receiver, on all processors.
std::vector<double> eachOf(const std::vector<FieldReceiver>& receivers, const std::function<double(const FieldReceiver&, uint32_t)>& value);

} // namespace antumbra::truth
