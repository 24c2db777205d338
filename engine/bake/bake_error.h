// How far baked light is from the truth, by path tracing at points of the surface. Bakes nothing.
#pragma once

#include "bake/gather.h"
#include "bake/path_tracer.h"

#include <span>

namespace antumbra::bake {

/// Root of the mean squared difference, over all channels, between values and a truth that two independent estimates tell: the product of
/// both differences has no noise of theirs in it.
class ErrorAgainstTruth
{
public:
    void add(const glm::dvec3& value, const glm::dvec3& truthA, const glm::dvec3& truthB);
    void add(const ErrorAgainstTruth& other);
    [[nodiscard]] double mean() const;     // of the truth
    [[nodiscard]] double rmse() const;     // 0 where noise makes the mean square negative
    [[nodiscard]] double relative() const; // rmse as a share of the mean

private:
    double squares_ = 0, sum_ = 0;
    size_t count_ = 0;
};

/// Points spread evenly over the area of what can be seen, not those inside of something solid; the same for the same seed.
std::vector<SurfacePoint> seenPoints(const RayScene& rays, uint32_t count, uint64_t seed);

/// Of the atlas, at `points`, each traced twice by `paths` paths. `radiance` is the light as it is looked up, with the bake's bands, and
/// `truth` what it stands for.
ErrorAgainstTruth errorOf(const Bake& bake, const RayScene& rays, const ShFunction& radiance, const Radiance& truth,
                          std::span<const SurfacePoint> points, uint32_t paths);

} // namespace antumbra::bake
