// What must hold for every convex body, whatever made it.
#pragma once

#include "scene/convex_body.h"

namespace antumbra {

/// A test failure for each promise that does not hold: loops and edges agree, every edge has two faces that run through it in
/// opposite directions, Euler's formula, and no vertex in front of a face by more than `tolerance` of the extent.
void expectClosedConvex(const scene::ConvexBody& body, double tolerance = 1e-6);

/// The same of a flat polygon: one face, no vertex outside an edge or off the plane.
void expectPlanarConvex(const scene::ConvexBody& body, double tolerance = 1e-6);

/// By the divergence theorem: positive when loops are counter-clockwise seen from outside.
double volumeOf(const scene::ConvexBody& body);

/// How far the point lies in front of the face farthest below it, in metres; negative inside.
double heightAbove(const scene::ConvexBody& body, vec3 point);

double greatestExtent(std::span<const vec3> points);

} // namespace antumbra
