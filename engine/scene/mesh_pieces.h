// Which vertices of a mesh hang together.
#pragma once

#include "scene/mesh.h"

namespace antumbra::scene {

/// The piece of each vertex: two of one piece are joined by edges of triangles, and by vertices at the same place, as seams leave them.
/// Pieces are numbered from 0 in the order of their first vertices. Linear but for a sort.
std::vector<uint32_t> piecesOf(const Mesh& mesh);

} // namespace antumbra::scene
