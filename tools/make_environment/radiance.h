// The light of the shipped environments as functions of direction: relative radiance, RGB, linear, never negative.
#pragma once

#include "base/math.h"

namespace antumbra::environment {

using glm::dvec3;

/// A closed cloud cover, three times as bright overhead as at the horizon.
dvec3 overcast(const dvec3& direction);
/// A clear evening: blue overhead, a warm disc of 2.5 degrees radius 20 degrees above the horizon, left of -Z.
dvec3 lowSun(const dvec3& direction);
/// A dim stone hall seen from its middle: tall bright windows along both sides and one at the far end.
dvec3 hall(const dvec3& direction);

} // namespace antumbra::environment
