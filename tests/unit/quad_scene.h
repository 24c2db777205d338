// Static scenes of rectangles, for tests of light transport: each with a square of the page to itself.
#pragma once

#include "bake/static_scene.h"

namespace antumbra::bake {

class QuadScene
{
public:
    /// Every quad has `side` x `side` texels; the material of index 0 has `albedo`.
    explicit QuadScene(uint32_t side, float albedo = 0.5f) : side_(side) { addMaterial({.albedo = vec3{albedo}}); }

    uint32_t addMaterial(const scene::Material& material)
    {
        scene_.materials.push_back(material);
        return static_cast<uint32_t>(scene_.materials.size() - 1);
    }

    /// The side of cross(u, v) is the outer one.
    void addQuad(vec3 corner, vec3 u, vec3 v, uint32_t material = 0)
    {
        const auto first = static_cast<uint32_t>(scene_.positions.size());
        const uint32_t quad = first / 4;
        const vec2 place(kGutter, static_cast<float>(quad * pitch()) + kGutter);
        for (const vec2 at : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)}) {
            scene_.positions.push_back(corner + at.x * u + at.y * v);
            scene_.normals.push_back(glm::normalize(glm::cross(u, v)));
            scene_.uvs.push_back(at);
            scene_.bakeUvs.push_back(place + at * static_cast<float>(side_));
        }
        for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u})
            scene_.indices.push_back(first + k);
        scene_.triangleMaterials.insert(scene_.triangleMaterials.end(), 2, material);
    }

    /// The six sides of a box, seen from outside or from inside; without its top where `isOpen`.
    void addBox(vec3 lowest, vec3 highest, bool isInside, bool isOpen = false)
    {
        const vec3 e = highest - lowest, x(e.x, 0, 0), y(0, e.y, 0), z(0, 0, e.z);
        const auto side = [&](vec3 corner, vec3 u, vec3 v) { isInside ? addQuad(corner, v, u) : addQuad(corner, u, v); };
        side(lowest, x, z);
        side(lowest, y, x);
        side(lowest, z, y);
        side(highest, -y, -z);
        side(highest, -x, -y);
        if (!isOpen)
            side(highest, -z, -x);
    }

    [[nodiscard]] StaticScene finished() const
    {
        StaticScene scene = scene_;
        scene.atlasExtent = {pitch(), pitch() * static_cast<uint32_t>(scene.positions.size() / 4)};
        for (vec2& uv : scene.bakeUvs)
            uv /= vec2(scene.atlasExtent);
        return scene;
    }

private:
    static constexpr uint32_t kGutter = 1;

    [[nodiscard]] uint32_t pitch() const { return side_ + 2 * kGutter; }

    uint32_t side_;
    StaticScene scene_;
};

} // namespace antumbra::bake
