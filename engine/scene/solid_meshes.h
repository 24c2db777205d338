// Meshes with few flat faces, so that what blocks a light and what is drawn are the same. Centred; flat normals.
#pragma once

#include "scene/mesh.h"

namespace antumbra::scene {

Mesh makeDisk();      // a polygon of 24 corners, of the area of a disk of 1 m diameter, in XZ, normal +Y
Mesh makeIcosphere(); // 42 vertices, of the surface of a sphere of 1 m diameter
Mesh makeFrustum();   // 12 sides; circles of 1 m and 0.5 m diameter about Y, the greater below, 1 m apart

} // namespace antumbra::scene
