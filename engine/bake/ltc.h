// Linearly transformed cosines for the GGX reflection: the tables that are looked up, and in double what they stand for. Fits nothing
// (that is tools/fit_ltc), and integrates no polygons. Directions are local: z along the normal, x on the side of the viewer.
// Heitz, Dupuy, Hill, Neubelt, Real-Time Polygonal-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2016.
#pragma once

#include "base/file.h"
#include "base/math.h"

#include <cstdint>
#include <vector>

namespace antumbra::bake {

/// What the first column of a table stands for instead of a mirror, and the last row instead of a view along the surface.
inline constexpr double kLeastAlpha = 1e-5;
inline constexpr double kLeastCosView = 7.963267e-4; // of 1.57 radians

/// The isotropic GGX reflection without Fresnel's factor, 1/sr: D G2 / (4 cos cos), zero where either direction is below the surface.
/// `view` and `light` are unit vectors; alpha kLeastAlpha..1. Smith's masking and shadowing are correlated by height (Heitz,
/// Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014, eq. 72 and 99).
double ggxReflection(const glm::dvec3& view, const glm::dvec3& light, double alpha);

/// The density of normals, 1/sr, of a unit vector that need not be above the surface's plane.
double ggxNormals(const glm::dvec3& half, double alpha);
/// Smith's Lambda for a direction of this cosine, 0..1: infinite along the surface.
double ggxLambda(double cosine, double alpha);

/// A clamped cosine whose directions are transformed by a matrix M (eq. 1 of the paper).
class Ltc
{
public:
    /// M^-1 in any scale; it has an inverse.
    explicit Ltc(const glm::dmat3& inverse);
    /// M^-1 as a table holds it: columns (x, 0, y), (0, 1, 0), (z, 0, w).
    explicit Ltc(const glm::dvec4& stored);

    /// 1/sr, towards a unit vector; integrates to one over the sphere, and may be positive below the surface.
    [[nodiscard]] double density(const glm::dvec3& direction) const;
    [[nodiscard]] const glm::dmat3& inverse() const { return inverse_; }

private:
    glm::dmat3 inverse_;
    double determinant_;
};

/// Texels are nodes: the centre of the first texel of a row or column is at 0, that of the last at 1. So a shader looks up at
/// (uv (size - 1) + 0.5) / size. Along x: roughness, alpha = roughness^2. Along y: sqrt(1 - cosView).
/// matrix: M^-1 as above. amplitude: x, what of white light all around is reflected at F = 1, and y, the same weighed with
/// (1 - v.h)^5, so that a specular colour f0 reflects f0 x + (1 - f0) y; z and w are not used. The layout is that of the published
/// tables (github.com/selfshadow/ltc_code), so that either are read alike.
struct LtcTables
{
    uint32_t size = 0; // of either table, in both directions
    std::vector<vec4> matrix;
    std::vector<vec4> amplitude;
};

/// What a node or a look-up holds, in double.
struct LtcTexel
{
    glm::dvec4 matrix{1, 0, 0, 1};
    glm::dvec4 amplitude{0};
};

inline constexpr const char* kLtcMatrixFile = "ltc_matrix.exr";
inline constexpr const char* kLtcAmplitudeFile = "ltc_amplitude.exr";

/// Reads both tables from a folder. Throws Error that names the file: not there, no picture, not square, not of four channels, another
/// size than the other, fewer than 2 or more than 1024 texels a side, values that are not finite or that no reflection has.
LtcTables loadLtcTables(const Path& folder);
LtcTables loadLtcTables(const Path& matrix, const Path& amplitude);
/// Each file is replaced at once or not at all. Throws Error where they cannot be written.
void saveLtcTables(const Path& folder, const LtcTables& tables);

/// What a node stands for; `column` and `row` 0..size - 1.
double alphaOfColumn(double column, uint32_t size);
double cosViewOfRow(double row, uint32_t size);

/// Bilinear between the nodes, as a sampler does it; roughness and cosView 0..1.
LtcTexel lookUp(const LtcTables& tables, double roughness, double cosView);

} // namespace antumbra::bake
