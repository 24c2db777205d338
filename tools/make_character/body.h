// The walker's shape as a signed distance field, and what each place on it belongs to. Knows no triangles.
#pragma once

#include "tools/make_character/skeleton.h"

namespace antumbra::character {

enum Cloth : uint32_t { Skin, Shirt, Trousers, Leather, kClothCount };

/// Metres to the surface, negative inside; exact at the surface to first order.
double distanceToBody(const dvec3& point);
/// Unit, outwards.
dvec3 normalOfBody(const dvec3& point);
/// On a lattice of 60 nanometres, where the last bits of another machine's mathematics die out: remeshing takes yes-or-no
/// decisions that they would steer.
dvec3 snapped(const dvec3& point);
/// The nearest point of the surface, snapped, for a point already near it.
dvec3 ontoBody(dvec3 point);

/// The joint whose limb is nearest.
Joint limbAt(const dvec3& point);
Cloth clothAt(const dvec3& point);
/// Edge length that shows the shape well here, metres.
double detailAt(const dvec3& point);

} // namespace antumbra::character
