// What is free in a cosine fitted to a lobe, in numbers that are near each other for neighbouring lobes however narrow.
#pragma once

#include "bake/ltc.h"

#include <array>

namespace antumbra::fit {

/// M = R(angle) (width_x, 0, lean width_x; 0, width_y, 0; 0, 0, 1): the paper's parametrisation, and the angle as a fourth parameter.
/// [0] and [1] are the logarithms of the widths, [2] the lean, [3] the angle beyond `angle` over width_x.
using Shape = std::array<double, 4>;

/// Isotropic ones are round about the normal: they have [0] alone.
constexpr size_t freedomOf(bool isIsotropic) { return isIsotropic ? 1 : std::tuple_size_v<Shape>; }

/// As tables hold it. `angle`: from the normal to the lobe's mean direction, radians, positive towards +x.
glm::dvec4 storedOf(const Shape& shape, double angle, bool isIsotropic);
/// The inverse of storedOf.
Shape shapeOf(const glm::dvec4& stored, double angle);

} // namespace antumbra::fit
