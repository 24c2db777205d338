#include "bake/path_tracer.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>

namespace antumbra::bake {

namespace {

using glm::dvec3;

constexpr double kPiExact = std::numbers::pi;

/// Where a path leaves, and about what.
struct Start
{
    vec3 origin;
    vec3 shadingNormal;
    vec3 geometricNormal;
};

Start startAt(const StaticScene& surfaces, const SurfacePoint& point)
{
    return {rayOrigin(surfaces, point), shadingNormalAt(surfaces, point), geometricNormal(surfaces, point.triangle)};
}

/// As dense as the cosine, of two numbers in 0..1.
vec3 cosineDirection(vec3 normal, double share, double turn)
{
    const double radius = std::sqrt(share);
    const dvec3 local{radius * std::cos(2 * kPiExact * turn), radius * std::sin(2 * kPiExact * turn), std::sqrt(1 - share)};
    return vec3(glm::normalize(glm::dmat3(frameAbout(normal, 0)) * local));
}

class PathTracer
{
public:
    PathTracer(const RayScene& rays, const Radiance& radiance, uint32_t bounces, uint64_t seed)
        : rays_(rays), radiance_(radiance), bounces_(bounces), key_(scrambled(seed))
    {
    }

    /// The first directions are spread over the hemisphere, all others independent.
    dvec3 irradiance(const Start& start, uint32_t paths)
    {
        constexpr double kGoldenRatio = 0.61803398874989485;
        check(paths > 0, "a path at least");
        const double firstTurn = random();
        dvec3 sum{0};
        for (uint32_t path = 0; path < paths; ++path) {
            const double share = (path + random()) / paths;
            sum += incident(start, cosineDirection(start.shadingNormal, share, firstTurn + path * kGoldenRatio));
        }
        return kPiExact * sum / static_cast<double>(paths);
    }

private:
    /// One sample of the radiance that comes in from `direction`.
    dvec3 incident(Start from, vec3 direction)
    {
        dvec3 throughput{1};
        for (uint32_t bounce = 0;; ++bounce) {
            RayScene::Hit hit;
            if (glm::dot(direction, from.geometricNormal) <= 0)
                return dvec3{0};
            if (!rays_.intersect(from.origin, direction, hit))
                return throughput * radiance_(dvec3(direction));
            if (hit.isBack || bounce == bounces_)
                return dvec3{0};
            throughput *= dvec3(albedoAt(rays_.surfaces(), hit.point));
            from = startAt(rays_.surfaces(), hit.point);
            const double share = random();
            direction = cosineDirection(from.shadingNormal, share, random());
        }
    }

    /// 0 <= x < 1.
    double random() { return static_cast<double>(scrambled(key_++) >> 11) * 0x1p-53; }

    const RayScene& rays_;
    const Radiance& radiance_;
    uint32_t bounces_;
    uint64_t key_;
};

} // namespace

dvec3 tracedIrradiance(const RayScene& rays, const Radiance& radiance, uint32_t bounces, vec3 position, vec3 normal, uint32_t paths,
                       uint64_t seed)
{
    const Aabb bounds = rays.surfaces().bounds();
    const vec3 largest = glm::max(glm::abs(position), glm::max(glm::abs(bounds.lowest), glm::abs(bounds.highest)));
    const vec3 origin = rayOrigin(position, normal, std::max({largest.x, largest.y, largest.z}));
    return PathTracer(rays, radiance, bounces, seed).irradiance({origin, normal, normal}, paths);
}

dvec3 tracedIrradiance(const RayScene& rays, const Radiance& radiance, uint32_t bounces, const SurfacePoint& point, uint32_t paths,
                       uint64_t seed)
{
    return PathTracer(rays, radiance, bounces, seed).irradiance(startAt(rays.surfaces(), point), paths);
}

} // namespace antumbra::bake
