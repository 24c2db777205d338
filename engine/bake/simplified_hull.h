// A convex body of few vertices that blocks nearly the light of one of many. Bounds nothing: it is neither inside nor outside.
//
// Vertices are chosen for the greatest volume (one by one, then exchanged while that gains), and the body is scaled about the middle
// of its surface until it covers, in the mean over all directions, as much as the full one. Measured over 200 directions: how much
// the area covered is off, and the area covered by one of the two alone, in percent of the full one's:
//   vertices                         8            12           16           32
//   19 bones of walker.glb, mean     4.0, 12.7    2.4,  7.2    1.4,  4.4    0.3, 0.7
//     worst direction of all bones  19,   26     17,   18     12,   13      3.0, 4.5
//   sphere, mean                     7.4, 18.5    2.2,  8.2    1.6,  6.7    0.6, 3.3
//     worst direction               30,   30      5.6, 11      6.7,  8.8    3.2, 4.3
// On the bones the area is off by 20 to 45 % more where vertices are chosen by distance or by the surface gained; where the body is
// not scaled it covers 18, 9, 5, 0.7 % too little.
#pragma once

#include "scene/convex_body.h"

namespace antumbra::bake {

/// At most `greatestVertices` (4 at least; 3 for a planar body) of a closed or planar body with more. More than 128 are never chosen.
scene::ConvexBody simplifiedHull(const scene::ConvexBody& full, uint32_t greatestVertices);

} // namespace antumbra::bake
