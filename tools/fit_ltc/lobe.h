// The reflection towards one viewer, integrated: what a cosine is fitted to, and how far a fitted one is from it.
#pragma once

#include "bake/ltc.h"

#include <span>
#include <vector>

namespace antumbra::fit {

/// Points of the unit square. Lobes are mirrored in y, so they are sampled on one side.
using Pattern = std::vector<glm::dvec2>;

/// Centres of side x side squares.
Pattern gridPattern(uint32_t side);
/// `count` points of Hammersley's, `seed` turning them so that no two seeds share any.
Pattern hammersleyPattern(uint32_t count, uint32_t seed);

/// Of a cosine against a lobe, as shares of the lobe's own norms.
struct Distance
{
    double l1 = 0; // integral |lobe - fitted| / integral lobe
    double l2 = 0; // sqrt(integral (lobe - fitted)^2 / integral lobe^2)
};

/// Integrals of a lobe.
struct LobeNorms
{
    double magnitude = 0;     // of f cos
    double fresnel = 0;       // of f cos (1 - v.h)^5
    glm::dvec3 mean{0, 0, 1}; // unit vector, y = 0
};
LobeNorms normsOf(double cosView, double alpha, const Pattern& pattern);

/// f cos, f of bake::ggxReflection, seen from one direction.
class Lobe
{
public:
    /// `pattern` must outlive it.
    Lobe(double cosView, double alpha, const Pattern& pattern);

    /// Of `amplitude` times the cosine. Integrated over the sphere: what leaks below the surface counts. Samples come from the
    /// lobe and from the cosine, weighed by the balance heuristic, as the paper's fit does it.
    [[nodiscard]] Distance distanceTo(const bake::Ltc& ltc, double amplitude) const;

private:
    struct Sample
    {
        glm::dvec3 direction;
        double value, density; // 1/sr
    };
    [[nodiscard]] Sample sampleOf(const glm::dvec3& direction) const;

    glm::dvec3 view_;
    double alpha_;
    double masking_;
    std::vector<Sample> samples_;
    std::vector<glm::dvec3> cosines_; // directions on the unit hemisphere, y >= 0
};

} // namespace antumbra::fit
