#include "bake/static_scene.h"

#include "base/check.h"
#include "base/fnv1a.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace antumbra::bake {

namespace {

float decoded(uint8_t encoded) { return scene::srgbDecoded(static_cast<float>(encoded) / 255.0f); }

float wrapped(float x, scene::Wrap wrap)
{
    switch (wrap) {
    case scene::Wrap::Repeat: return x - std::floor(x);
    case scene::Wrap::Mirror: return 1.0f - std::abs(x - 2.0f * std::floor(0.5f * x) - 1.0f);
    case scene::Wrap::Clamp: break;
    }
    return std::clamp(x, 0.0f, 1.0f);
}

uint32_t texelOf(float x, uint32_t size)
{
    const float place = std::floor(x * static_cast<float>(size));
    return place > 0 ? std::min(static_cast<uint32_t>(place), size - 1) : 0;
}

/// Nearest texel, linear; opaque white without an image.
vec4 imageAt(const StaticScene& scene, const scene::Material& material, const SurfacePoint& point)
{
    if (material.albedoImage == scene::kNoIndex)
        return vec4{1};
    const scene::Image8& image = *scene.images[material.albedoImage];
    const uint32_t* corners = &scene.indices[size_t{3} * point.triangle];
    const vec2 a = scene.uvs[corners[0]], b = scene.uvs[corners[1]], c = scene.uvs[corners[2]];
    const vec2 uv = a + point.barycentric.x * (b - a) + point.barycentric.y * (c - a);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
        return vec4{1};
    const uint32_t x = texelOf(wrapped(uv.x, material.wrapU), image.width), y = texelOf(wrapped(uv.y, material.wrapV), image.height);
    const uint8_t* texel = &image.rgba[size_t{4} * (size_t{y} * image.width + x)];
    return {decoded(texel[0]), decoded(texel[1]), decoded(texel[2]), static_cast<float>(texel[3]) / 255.0f};
}

float reflectance(float albedo) { return albedo > 0 ? std::min(albedo, 1.0f) : 0.0f; } // NaN counts as nothing

template <class Value>
Value interpolated(const std::vector<Value>& values, const StaticScene& scene, const SurfacePoint& point)
{
    const uint32_t* corners = &scene.indices[size_t{3} * point.triangle];
    const Value &a = values[corners[0]], &b = values[corners[1]], &c = values[corners[2]];
    return a + point.barycentric.x * (b - a) + point.barycentric.y * (c - a);
}

/// What is kept of an object's materials: their images come after those of the objects before.
void appendMaterials(StaticScene& scene, const scene::Model& model)
{
    const auto firstImage = static_cast<uint32_t>(scene.images.size());
    for (const scene::Image8& image : model.images)
        scene.images.push_back(&image);
    for (scene::Material material : model.materials) {
        if (material.albedoImage != scene::kNoIndex)
            material.albedoImage += firstImage;
        scene.materials.push_back(material);
    }
}

void appendMesh(StaticScene& scene, const scene::Mesh& mesh, const mat4& world, uint32_t firstMaterial)
{
    const auto firstVertex = static_cast<uint32_t>(scene.positions.size());
    const mat3 linear(world);
    const mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]), glm::cross(linear[0], linear[1]));
    const bool isMirrored = glm::determinant(linear) < 0;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        scene.positions.push_back(vec3(world * vec4(mesh.positions[i], 1)));
        const vec3 normal = cofactors * mesh.normals[i] * (isMirrored ? -1.0f : 1.0f);
        const float length = glm::length(normal);
        scene.normals.push_back(length > 0 ? normal / length : vec3{0});
    }
    scene.uvs.insert(scene.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    scene.bakeUvs.insert(scene.bakeUvs.end(), mesh.bakeUvs.begin(), mesh.bakeUvs.end());
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        // A mirrored triangle keeps its outside.
        const std::array<uint32_t, 3> corners{mesh.indices[i], mesh.indices[i + (isMirrored ? 2 : 1)],
                                              mesh.indices[i + (isMirrored ? 1 : 2)]};
        for (const uint32_t corner : corners)
            scene.indices.push_back(firstVertex + corner);
        scene.triangleMaterials.push_back(firstMaterial + mesh.triangleMaterials[i / 3]);
    }
}

} // namespace

Aabb StaticScene::bounds() const
{
    Aabb box;
    for (const vec3& position : positions)
        box.add(position);
    return box;
}

vec3 positionAt(const StaticScene& scene, const SurfacePoint& point) { return interpolated(scene.positions, scene, point); }

vec3 geometricNormal(const StaticScene& scene, uint32_t triangle)
{
    const uint32_t* corners = &scene.indices[size_t{3} * triangle];
    const vec3 a = scene.positions[corners[0]], b = scene.positions[corners[1]], c = scene.positions[corners[2]];
    return glm::normalize(glm::cross(b - a, c - a));
}

vec3 shadingNormalAt(const StaticScene& scene, const SurfacePoint& point)
{
    const vec3 geometric = geometricNormal(scene, point.triangle);
    const vec3 normal = interpolated(scene.normals, scene, point);
    const float length = glm::length(normal);
    if (!(length > 1.0e-6f))
        return geometric;
    // The side that is seen is the side that is lit.
    return glm::dot(normal, geometric) < 0 ? -normal / length : normal / length;
}

vec2 bakeUvAt(const StaticScene& scene, const SurfacePoint& point) { return interpolated(scene.bakeUvs, scene, point); }

vec3 albedoAt(const StaticScene& scene, const SurfacePoint& point)
{
    const scene::Material& material = scene.materials[scene.triangleMaterials[point.triangle]];
    const vec3 albedo = material.albedo * vec3(imageAt(scene, material, point));
    return {reflectance(albedo.x), reflectance(albedo.y), reflectance(albedo.z)};
}

bool isHole(const StaticScene& scene, const SurfacePoint& point)
{
    const scene::Material& material = scene.materials[scene.triangleMaterials[point.triangle]];
    return material.alphaCutoff > 0 && material.alpha * imageAt(scene, material, point).w < material.alphaCutoff;
}

StaticScene flatten(std::span<const AtlasObject> objects, const Atlas& atlas)
{
    check(objects.size() == atlas.meshes.size(), "one charted mesh an object");
    StaticScene scene;
    scene.atlasExtent = atlas.extent;
    for (size_t i = 0; i < objects.size(); ++i) {
        const auto firstMaterial = static_cast<uint32_t>(scene.materials.size());
        appendMaterials(scene, *objects[i].model);
        appendMesh(scene, atlas.meshes[i], objects[i].world, firstMaterial);
    }
    return scene;
}

uint64_t hashOf(const StaticScene& scene)
{
    Fnv1a hash;
    hash.add(scene.atlasExtent);
    hash.add(std::span(scene.positions));
    hash.add(std::span(scene.normals));
    hash.add(std::span(scene.uvs));
    hash.add(std::span(scene.bakeUvs));
    hash.add(std::span(scene.indices));
    hash.add(std::span(scene.triangleMaterials));
    for (const scene::Material& material : scene.materials) {
        hash.add(material.albedo);
        hash.add(material.alpha);
        hash.add(material.alphaCutoff);
        hash.add(material.albedoImage);
        hash.add(material.wrapU);
        hash.add(material.wrapV);
    }
    for (const scene::Image8* image : scene.images) {
        hash.add(image->width);
        hash.add(std::span(image->rgba));
    }
    return hash.value();
}

} // namespace antumbra::bake
