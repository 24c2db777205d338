#include "bake/ltc.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace antumbra::bake {

namespace {

using glm::dmat3;
using glm::dvec3;
using glm::dvec4;

constexpr double kPiExact = std::numbers::pi;

dvec4 mixed(const std::vector<vec4>& texels, uint32_t size, double column, double row)
{
    const auto left = std::min(static_cast<uint32_t>(column), size - 2), top = std::min(static_cast<uint32_t>(row), size - 2);
    const auto texelAt = [&](uint32_t x, uint32_t y) { return dvec4(texels[size_t{y} * size + x]); };
    const double across = column - left, down = row - top;
    return glm::mix(glm::mix(texelAt(left, top), texelAt(left + 1, top), across),
                    glm::mix(texelAt(left, top + 1), texelAt(left + 1, top + 1), across), down);
}

} // namespace

// Written so that a narrow lobe keeps its digits: 1 - z^2 (1 - alpha^2) would cancel.
double ggxNormals(const dvec3& half, double alpha)
{
    if (half.z <= 0)
        return 0;
    const double stretched = (half.x * half.x + half.y * half.y) / (alpha * alpha) + half.z * half.z;
    return 1 / (kPiExact * alpha * alpha * stretched * stretched);
}

double ggxLambda(double cosine, double alpha)
{
    if (cosine <= 0)
        return std::numeric_limits<double>::infinity();
    const double tangentSquared = std::max(1 - cosine * cosine, 0.0) / (cosine * cosine);
    const double stretched = alpha * alpha * tangentSquared;
    return 0.5 * stretched / (std::sqrt(1 + stretched) + 1);
}

double ggxReflection(const dvec3& view, const dvec3& light, double alpha)
{
    if (view.z <= 0 || light.z <= 0)
        return 0;
    const double shadowing = 1 / (1 + ggxLambda(view.z, alpha) + ggxLambda(light.z, alpha));
    return ggxNormals(glm::normalize(view + light), alpha) * shadowing / (4 * view.z * light.z);
}

Ltc::Ltc(const dmat3& inverse) : inverse_(inverse), determinant_(std::abs(glm::determinant(inverse)))
{
    check(determinant_ > 0, "a matrix that has an inverse");
}

Ltc::Ltc(const dvec4& stored) : Ltc(dmat3(stored.x, 0, stored.y, 0, 1, 0, stored.z, 0, stored.w)) {}

double Ltc::density(const dvec3& direction) const
{
    const dvec3 before = inverse_ * direction;
    const double squared = glm::dot(before, before);
    return std::max(before.z, 0.0) / kPiExact * determinant_ / (squared * squared);
}

double alphaOfColumn(double column, uint32_t size)
{
    const double roughness = column / (size - 1);
    return std::max(roughness * roughness, kLeastAlpha);
}

double cosViewOfRow(double row, uint32_t size)
{
    const double share = row / (size - 1);
    return std::max(1 - share * share, kLeastCosView);
}

LtcTexel lookUp(const LtcTables& tables, double roughness, double cosView)
{
    check(tables.size >= 2, "tables with nodes to mix");
    const double last = tables.size - 1;
    const double column = std::clamp(roughness, 0.0, 1.0) * last;
    const double row = std::sqrt(1 - std::clamp(cosView, 0.0, 1.0)) * last;
    return {mixed(tables.matrix, tables.size, column, row), mixed(tables.amplitude, tables.size, column, row)};
}

} // namespace antumbra::bake
