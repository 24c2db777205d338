// Random area problems that are hard for the method, by category: exact coincidences, contact, degenerate shapes, extremes of size and
// of number (methods/area-shadows.md, Guards and Depth).
#pragma once

#include "app/area_problem.h"
#include "gpu/random_inputs.h"

#include <ostream>
#include <string_view>

namespace antumbra {

enum class Jitter { Vertices, Bodies }; // each vertex by itself; or bodies as they are, where single vertices would crumple them

// How far a share may be off. It is a sum of up to some hundred arcs of up to pi, over 2 pi, in floats of 6e-8: that rounds to 1e-6.
// Corners and planes are as exact as floats of the positions, relative to the point; narrow lobes enlarge that up to 50 times: 3e-6 of an
// angle.
constexpr double kTolerance = 1e-5;
// Near contact, positions that were rounded at the size of the scene are seen from a thousandth of it.
constexpr double kContactTolerance = 2e-5;
// A plane through a short edge is tilted by its rounding, and stays where it cuts off no more than 3e-5 of an angle (Guard 3); narrow lobes
// enlarge that. Seldom: 2e-5 is the worst of some thousands.
constexpr double kShortEdgeTolerance = 1e-3;

struct AreaCategory
{
    std::string_view name;
    app::AreaProblem (*make)(RandomInputs&);
    std::string_view jump{}; // what a jitter may cross there, so that a share jumps; empty: nothing
    double tolerance = kTolerance;
    double jitter = 1e-6; // of the problem's size
    Jitter jitterKind = Jitter::Vertices;
};

inline void PrintTo(const AreaCategory& category, std::ostream* to) { *to << category.name; }

std::span<const AreaCategory> areaCategories();

/// A light of any kind before up to `mostOccluders` convex bodies of any kind in front of it: what is common.
app::AreaProblem commonAreaProblem(RandomInputs& random, uint32_t mostOccluders);

/// Metres: across all that the problem holds, along the longest axis.
double sizeOf(const app::AreaProblem& problem);

/// The point, and every vertex or body, moved by up to `metres` along each axis.
app::AreaProblem jittered(const app::AreaProblem& problem, RandomInputs& random, double metres, Jitter kind);

/// Every occluder as triangles that block from both sides: the same where it is convex, and right where rounding left it not quite so.
app::AreaProblem inTriangles(const app::AreaProblem& problem);

/// Every vertex and the point moved by the map, the frame turned by its linear part, rounded once. Where it mirrors, loops and lobe are
/// turned around as well, so that the shares stay what they are.
app::AreaProblem moved(const app::AreaProblem& problem, const glm::dmat3& linear, const glm::dvec3& offset);

} // namespace antumbra
