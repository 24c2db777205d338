#include "bake/bake_error.h"

#include "bake/look_up.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace antumbra::bake {

namespace {

using Random = std::mt19937_64;

constexpr float kOffSurface = 1.0e-3f; // metres

float share(Random& random) { return std::uniform_real_distribution<float>(0.0f, 1.0f)(random); }

/// With the density of the cosine to `normal`.
vec3 cosineDirection(vec3 normal, Random& random)
{
    const float z = 2.0f * share(random) - 1.0f, angle = glm::two_pi<float>() * share(random), r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const vec3 sum = normal + vec3(r * std::cos(angle), r * std::sin(angle), z);
    return glm::dot(sum, sum) > 1.0e-8f ? glm::normalize(sum) : normal;
}

/// What lies inside of something solid looks at the back of its surface.
bool isSeen(const RayScene& rays, const SurfacePoint& point, Random& random)
{
    constexpr int kRays = 64, kMostBacks = 6;
    const vec3 normal = geometricNormal(rays.surfaces(), point.triangle);
    const vec3 origin = positionAt(rays.surfaces(), point) + kOffSurface * normal;
    int backs = 0;
    for (int i = 0; i < kRays; ++i) {
        RayScene::Hit hit;
        backs += rays.intersect(origin, cosineDirection(normal, random), hit) && hit.isBack ? 1 : 0;
    }
    return backs <= kMostBacks;
}

double areaOf(const StaticScene& scene, uint32_t triangle)
{
    const uint32_t* corners = &scene.indices[size_t{3} * triangle];
    const vec3 a = scene.positions[corners[0]], b = scene.positions[corners[1]], c = scene.positions[corners[2]];
    return 0.5 * static_cast<double>(glm::length(glm::cross(b - a, c - a)));
}

} // namespace

void ErrorAgainstTruth::add(const glm::dvec3& value, const glm::dvec3& truthA, const glm::dvec3& truthB)
{
    for (int c = 0; c < 3; ++c) {
        squares_ += (value[c] - truthA[c]) * (value[c] - truthB[c]);
        sum_ += 0.5 * (truthA[c] + truthB[c]);
    }
    count_ += 3;
}

void ErrorAgainstTruth::add(const ErrorAgainstTruth& other)
{
    squares_ += other.squares_;
    sum_ += other.sum_;
    count_ += other.count_;
}

double ErrorAgainstTruth::mean() const { return sum_ / static_cast<double>(count_); }

double ErrorAgainstTruth::rmse() const { return std::sqrt(std::max(squares_ / static_cast<double>(count_), 0.0)); }

double ErrorAgainstTruth::relative() const { return rmse() / mean(); }

std::vector<SurfacePoint> seenPoints(const RayScene& rays, uint32_t count, uint64_t seed)
{
    Random random(seed);
    std::vector<double> areas;
    for (uint32_t triangle = 0; triangle < rays.surfaces().triangleCount(); ++triangle)
        areas.push_back(areaOf(rays.surfaces(), triangle));
    std::discrete_distribution<uint32_t> triangles(areas.begin(), areas.end());
    std::vector<SurfacePoint> points;
    while (points.size() < count) {
        const float u = std::sqrt(share(random)), v = share(random);
        const SurfacePoint point{triangles(random), {u * (1 - v), u * v}};
        if (isSeen(rays, point, random))
            points.push_back(point);
    }
    return points;
}

ErrorAgainstTruth errorOf(const Bake& bake, const RayScene& rays, const ShFunction& radiance, const Radiance& truth,
                          std::span<const SurfacePoint> points, uint32_t paths)
{
    ErrorAgainstTruth error;
    const StaticScene& scene = rays.surfaces();
    uint64_t seed = 0;
    for (const SurfacePoint& point : points) {
        const auto traced = [&] { return tracedIrradiance(rays, truth, bake.settings.bounces, point, paths, seed++); };
        const glm::dvec3 truthA = traced(), truthB = traced();
        error.add(atlasIrradiance(bake, radiance, bakeUvAt(scene, point)), truthA, truthB);
    }
    return error;
}

} // namespace antumbra::bake
