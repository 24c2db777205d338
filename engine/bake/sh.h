// Real spherical harmonics of light: projection of an environment, rotation, cosine convolution, evaluation, all in double.
// Knows neither files nor devices; refuses more than five bands.
#pragma once

#include "base/math.h"
#include "scene/images.h"

#include <array>
#include <cstdint>

namespace antumbra::bake {

inline constexpr uint32_t kFewestBands = 2;
inline constexpr uint32_t kMostBands = 5;
inline constexpr uint32_t kMostCoefficients = kMostBands * kMostBands;

using ShBasis = std::array<double, kMostCoefficients>;

/// A function on the sphere, RGB: the sum of coefficients[i] Y_i over the first bands * bands.
/// Band by band, m from -l to l, polar axis z, all constants positive: 1, y, z, x, xy, yz, 3zz-1, xz, xx-yy, ...
struct ShFunction
{
    uint32_t bands = 3; // kFewestBands..kMostBands
    std::array<glm::dvec3, kMostCoefficients> coefficients{};

    [[nodiscard]] uint32_t coefficientCount() const { return bands * bands; }
    /// The value towards a unit vector; may be negative where few bands ring.
    glm::dvec3 operator()(const glm::dvec3& direction) const;
};

/// Y_i(direction) of all five bands; `direction` is a unit vector.
ShBasis shBasis(const glm::dvec3& direction);

/// The unit direction of a point of an equirectangular map: u and v 0..1 from the left and the top; the centre is -Z, the
/// right half +X, the top row +Y.
glm::dvec3 equirectangularDirection(double u, double v);

/// The texel of an equirectangular map towards a unit vector: what project() takes its light to be there.
glm::dvec3 texelTowards(const scene::ImageF& map, const glm::dvec3& direction);

/// Projects a map of at least three channels (the first three are RGB), every texel weighted by its exact solid angle.
/// The result has the map's unit: W/(m^2 sr) for radiance.
ShFunction project(const scene::ImageF& map, uint32_t bands);

/// The function turned with the world: counter-clockwise about +Y seen from above, so rotated(w) = function(R^-1 w).
ShFunction rotatedAboutY(const ShFunction& function, double radians);

/// Against ringing: band l weighs 1 / (1 + strength l^2 (l + 1)^2) (Sloan, Stupid Spherical Harmonics Tricks, 2008); strength >= 0.
ShFunction windowed(const ShFunction& function, double strength);

/// Radiance in, irradiance out: E(n) = integral of L(w) max(n.w, 0) dw, W/m^2, exact for the bands given.
ShFunction irradianceOf(const ShFunction& radiance);

} // namespace antumbra::bake
