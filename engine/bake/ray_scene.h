// What baking rays meet, through Embree. Knows neither texels nor light.
#pragma once

#include "bake/directions.h"
#include "bake/static_scene.h"

#include <array>
#include <memory>

namespace antumbra::bake {

/// What the lanes of a packet met; `points` says where, in the lanes of `hits`.
struct HitPacket
{
    LaneMask hits = 0;
    LaneMask backs = 0; // of the hits: on a triangle seen from its inside
    std::array<SurfacePoint, kLanes> points;
};

/// Rays go through cut-out surfaces where they are holes. Of a two-sided surface, whose triangles stand there a second time turned over,
/// they meet the one that faces them. Any number of threads may trace.
class RayScene
{
public:
    /// `scene` must outlive it.
    explicit RayScene(const StaticScene& scene);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    struct Hit
    {
        SurfacePoint point;
        float distance = 0;  // metres
        bool isBack = false; // of a triangle seen from its inside
    };
    /// True where something is hit; the nearest.
    bool intersect(vec3 origin, vec3 direction, Hit& hit) const;
    /// The nearest hits of rays from one origin; only lanes of `traced` are.
    void intersect(vec3 origin, const DirectionPacket& directions, LaneMask traced, HitPacket& result) const;

    [[nodiscard]] const StaticScene& surfaces() const { return *surfaces_; }
    /// Bytes that the acceleration structure took.
    [[nodiscard]] uint64_t bytes() const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
    const StaticScene* surfaces_;
};

/// Where rays leave the surface at `position` on its outer side, past every rounding: of coordinates as large as `magnitude` (metres).
vec3 rayOrigin(vec3 position, vec3 geometricNormal, float magnitude);
/// The same of a point on a triangle.
vec3 rayOrigin(const StaticScene& scene, const SurfacePoint& point);

} // namespace antumbra::bake
