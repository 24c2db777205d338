#include "scene/solid_meshes.h"

#include "scene/light_body.h"

namespace antumbra::scene {

namespace {

Mesh meshOfShape(const AreaLight& shape, uint32_t segments) { return meshOf(lightBody(shape, nullptr, segments).value()); }

} // namespace

Mesh makeDisk() { return meshOfShape({.shape = LightShape::Disk, .radii = vec2(0.5f)}, 24); }

Mesh makeIcosphere() { return meshOfShape({.shape = LightShape::Sphere, .radii = vec2(0.5f)}, 42); }

Mesh makeFrustum()
{
    constexpr uint32_t kSides = 12;
    std::vector<vec3> vertices;
    std::vector<Loop> loops;
    Loop lower, upper;
    for (uint32_t i = 0; i < kSides; ++i) {
        const float angle = 2 * kPi * static_cast<float>(i) / kSides;
        const vec3 out(std::cos(angle), 0, -std::sin(angle)); // counter-clockwise seen from above
        vertices.push_back(0.5f * out - vec3(0, 0.5f, 0));
        vertices.push_back(0.25f * out + vec3(0, 0.5f, 0));
        const uint32_t next = (i + 1) % kSides;
        loops.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
        lower.insert(lower.begin(), 2 * i);
        upper.push_back(2 * i + 1);
    }
    loops.push_back(lower);
    loops.push_back(upper);
    return meshOf(makeBody(std::move(vertices), loops));
}

} // namespace antumbra::scene
