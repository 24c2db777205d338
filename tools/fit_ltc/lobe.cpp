// Normals are drawn as the viewer sees them: Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018.
#include "tools/fit_ltc/lobe.h"

#include <cmath>
#include <numbers>

namespace antumbra::fit {

namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kPiExact = std::numbers::pi;

dvec3 viewOf(double cosView) { return {std::sqrt(1 - cosView * cosView), 0, cosView}; }

/// A disc's half y >= 0 when `point` is in the unit square: x and y are exchanged with the paper's t1 and t2.
dvec2 onHalfDisc(const dvec2& point)
{
    const double radius = std::sqrt(point.x), angle = kPiExact * point.y;
    return radius * dvec2(std::cos(angle), std::sin(angle));
}

dvec3 visibleNormal(const dvec3& view, double alpha, const dvec2& point)
{
    const dvec3 stretched = glm::normalize(dvec3(alpha * view.x, 0, view.z));
    const dvec3 upwards(-stretched.z, 0, stretched.x); // in the plane of the view, square to it
    dvec2 disc = onHalfDisc(point);
    const double share = 0.5 * (1 + stretched.z);
    disc.x = glm::mix(std::sqrt(std::max(1 - disc.y * disc.y, 0.0)), disc.x, share);
    const double along = std::sqrt(std::max(1 - glm::dot(disc, disc), 0.0));
    const dvec3 normal = disc.x * upwards + disc.y * dvec3(0, 1, 0) + along * stretched;
    return glm::normalize(dvec3(alpha * normal.x, alpha * normal.y, std::max(normal.z, 0.0)));
}

dvec3 mirrored(const dvec3& view, const dvec3& normal) { return 2 * glm::dot(view, normal) * normal - view; }

} // namespace

Pattern gridPattern(uint32_t side)
{
    Pattern pattern;
    for (uint32_t row = 0; row < side; ++row)
        for (uint32_t column = 0; column < side; ++column)
            pattern.emplace_back((column + 0.5) / side, (row + 0.5) / side);
    return pattern;
}

Pattern hammersleyPattern(uint32_t count, uint32_t seed)
{
    constexpr dvec2 kTurn{0.7548776662466927, 0.5698402909980532}; // the plastic number's inverse powers
    Pattern pattern;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t bits = i;
        double mirroredBits = 0;
        for (double digit = 0.5; bits != 0; bits >>= 1, digit /= 2)
            mirroredBits += (bits & 1) != 0 ? digit : 0;
        pattern.push_back(glm::fract(dvec2((i + 0.5) / count, mirroredBits) + (seed + 0.5) * kTurn));
    }
    return pattern;
}

// Far from the lobe's middle little is reflected, but from ever steeper normals: points lie denser there, by the cube.
LobeNorms normsOf(double cosView, double alpha, const Pattern& pattern)
{
    const dvec3 view = viewOf(cosView);
    const double lambdaView = bake::ggxLambda(cosView, alpha);
    LobeNorms norms;
    dvec3 sum{0};
    for (const dvec2& point : pattern) {
        const double left = 1 - point.x, density = 3 * left * left / static_cast<double>(pattern.size());
        const dvec3 normal = visibleNormal(view, alpha, {1 - left * left * left, point.y}), light = mirrored(view, normal);
        if (light.z <= 0)
            continue;
        // The lobe over the density of its samples: G2 / G1.
        const double weight = density * (1 + lambdaView) / (1 + lambdaView + bake::ggxLambda(light.z, alpha));
        norms.magnitude += weight;
        norms.fresnel += weight * std::pow(1 - std::min(glm::dot(view, normal), 1.0), 5);
        sum += weight * dvec3(light.x, 0, light.z);
    }
    norms.mean = glm::normalize(sum);
    return norms;
}

Lobe::Lobe(double cosView, double alpha, const Pattern& pattern)
    : view_(viewOf(cosView)), alpha_(alpha), masking_(1 / (1 + bake::ggxLambda(cosView, alpha)))
{
    samples_.reserve(pattern.size());
    cosines_.reserve(pattern.size());
    for (const dvec2& point : pattern) {
        samples_.push_back(sampleOf(mirrored(view_, visibleNormal(view_, alpha, point))));
        const dvec2 disc = onHalfDisc(point);
        cosines_.emplace_back(disc, std::sqrt(std::max(1 - glm::dot(disc, disc), 0.0)));
    }
}

Lobe::Sample Lobe::sampleOf(const dvec3& direction) const
{
    if (view_.z + direction.z <= 0)
        return {direction, 0, 0};
    const double visible = bake::ggxNormals(glm::normalize(view_ + direction), alpha_) / (4 * view_.z);
    if (direction.z <= 0)
        return {direction, 0, visible * masking_};
    const double shadowing = 1 / (1 / masking_ + bake::ggxLambda(direction.z, alpha_));
    return {direction, visible * shadowing, visible * masking_};
}

Distance Lobe::distanceTo(const bake::Ltc& ltc, double amplitude) const
{
    double absolute = 0, squared = 0, norm1 = 0, norm2 = 0;
    const auto add = [&](const Sample& sample) {
        const double density = ltc.density(sample.direction);
        const double difference = sample.value - amplitude * density, weight = 1 / (sample.density + density);
        absolute += std::abs(difference) * weight;
        squared += difference * difference * weight;
        norm1 += sample.value * weight;
        norm2 += sample.value * sample.value * weight;
    };
    for (const Sample& sample : samples_)
        add(sample);
    const glm::dmat3 matrix = glm::inverse(ltc.inverse());
    for (const dvec3& cosine : cosines_)
        add(sampleOf(glm::normalize(matrix * cosine)));
    return {absolute / norm1, std::sqrt(squared / norm2)};
}

} // namespace antumbra::fit
