// From a field to a closed triangle mesh that is even, fitted to its detail, and cut cleanly where the cloth changes.
#pragma once

#include "tools/make_character/body.h"

#include <vector>

namespace antumbra::character {

/// Closed and manifold; triangles are counter-clockwise seen from outside.
struct Surface
{
    std::vector<dvec3> positions;
    std::vector<glm::uvec3> triangles;
};

/// The body as a grid of that spacing in metres shows it: near the surface, many poor triangles.
Surface polygonise(double cell);

/// Collapses, flips and relaxes until edges are as long as detailAt asks, every vertex on the body, then moves vertices
/// onto the borders between cloths, so that each triangle is of one cloth.
Surface remesh(Surface fine);

/// One weight a joint for every vertex: the nearest limb's, spread over the surface by diffusion.
std::vector<std::array<double, kJointCount>> skinWeights(const Surface& surface);

/// Whether every edge has exactly two triangles, which pass it in opposite directions.
bool isClosed(const Surface& surface);

} // namespace antumbra::character
