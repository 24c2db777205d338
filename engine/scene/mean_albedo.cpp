#include "scene/mean_albedo.h"

#include "scene/animation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace antumbra::scene {

namespace {

vec3 meanOf(const Image8& image)
{
    std::array<float, 256> decoded;
    for (size_t i = 0; i < decoded.size(); ++i)
        decoded[i] = srgbDecoded(static_cast<float>(i) / 255);
    glm::dvec3 sum{0};
    for (size_t i = 0; i + 3 < image.rgba.size(); i += 4)
        sum += glm::dvec3(decoded[image.rgba[i]], decoded[image.rgba[i + 1]], decoded[image.rgba[i + 2]]);
    return vec3(sum / static_cast<double>(std::max<size_t>(image.rgba.size() / 4, 1)));
}

} // namespace

vec3 meanAlbedo(const Model& model)
{
    std::vector<vec3> albedos;
    for (const Material& material : model.materials) {
        const vec3 image = material.albedoImage != kNoIndex ? meanOf(model.images[material.albedoImage]) : vec3(1);
        albedos.push_back(glm::clamp(material.albedo * image, vec3(0), vec3(1)));
    }
    const Mesh rest = restMesh(model);
    glm::dvec3 sum{0};
    double areas = 0;
    for (size_t i = 0; i < rest.triangleMaterials.size(); ++i) {
        const uint32_t* corners = &rest.indices[3 * i];
        const vec3 a = rest.positions[corners[0]], b = rest.positions[corners[1]], c = rest.positions[corners[2]];
        const double area = static_cast<double>(glm::length(glm::cross(b - a, c - a)));
        if (!(area > 0) || !std::isfinite(area))
            continue;
        sum += area * glm::dvec3(albedos[rest.triangleMaterials[i]]);
        areas += area;
    }
    return areas > 0 ? vec3(sum / areas) : vec3(0);
}

} // namespace antumbra::scene
