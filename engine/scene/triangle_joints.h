// Which joint a triangle belongs to where it may belong to one alone: capsules and hulls of bones are made from that.
#pragma once

#include "scene/mesh.h"

#include <map>

namespace antumbra::scene {

/// A triangle belongs to the joint with the greatest share in its corners. The corners of each joint's triangles, each once and in
/// order; joints without triangles are left out.
std::map<uint32_t, std::vector<uint32_t>> verticesByJoint(const Mesh& mesh);

} // namespace antumbra::scene
