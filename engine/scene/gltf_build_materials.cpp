#include "scene/gltf_build.h"

#include "scene/gltf_rules.h"

namespace antumbra::scene {

namespace {

// A G-buffer keeps one surface a pixel: what blends is cut where it is half transparent.
constexpr float kBlendCutoff = 0.5f;

float emissiveStrengthOf(const tinygltf::Material& material)
{
    const auto found = material.extensions.find("KHR_materials_emissive_strength");
    if (found == material.extensions.end() || !found->second.Has("emissiveStrength"))
        return 1;
    return static_cast<float>(found->second.Get("emissiveStrength").GetNumberAsDouble());
}

/// Decodes an image at its first use.
class ImageUse
{
public:
    ImageUse(Model& model, const tinygltf::Model& file) : model_(model), file_(file), decoded_(file.images.size(), kNoIndex) {}

    uint32_t imageOf(const tinygltf::TextureInfo& info)
    {
        const int source = info.index < 0 ? -1 : at(file_.textures, info.index).source;
        if (source < 0)
            return kNoIndex;
        uint32_t& image = decoded_[static_cast<size_t>(source)];
        if (image == kNoIndex) {
            model_.images.push_back(
                decodeImage8(std::as_bytes(std::span(at(file_.images, source).image)), fmt::format("images[{}]", source)));
            image = static_cast<uint32_t>(model_.images.size() - 1);
        }
        return image;
    }

private:
    Model& model_;
    const tinygltf::Model& file_;
    std::vector<uint32_t> decoded_;
};

Wrap wrapOf(int mode)
{
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Wrap::Clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Wrap::Mirror;
    default: return Wrap::Repeat;
    }
}

// Both textures are read at the base colour's coordinates, so they wrap as it does.
void setWrap(Material& material, const tinygltf::PbrMetallicRoughness& surface, const tinygltf::Model& file)
{
    const int texture = surface.baseColorTexture.index >= 0 ? surface.baseColorTexture.index : surface.metallicRoughnessTexture.index;
    const int sampler = texture < 0 ? -1 : at(file.textures, texture).sampler;
    if (sampler < 0)
        return;
    material.wrapU = wrapOf(at(file.samplers, sampler).wrapS);
    material.wrapV = wrapOf(at(file.samplers, sampler).wrapT);
}

vec3 colourOf(const std::vector<double>& factor, vec3 fallback)
{
    return factor.empty() ? fallback : vec3(factor[0], factor[1], factor[2]);
}

Material materialOf(const tinygltf::Material& source, const tinygltf::Model& file, ImageUse& images)
{
    const tinygltf::PbrMetallicRoughness& surface = source.pbrMetallicRoughness;
    Material material;
    material.albedo = colourOf(surface.baseColorFactor, vec3{1});
    material.alpha = surface.baseColorFactor.empty() ? 1 : static_cast<float>(surface.baseColorFactor[3]);
    if (source.alphaMode == "MASK")
        material.alphaCutoff = static_cast<float>(source.alphaCutoff);
    if (source.alphaMode == "BLEND")
        material.alphaCutoff = kBlendCutoff;
    material.roughness = static_cast<float>(surface.roughnessFactor);
    material.metallic = static_cast<float>(surface.metallicFactor);
    material.emission = emissiveStrengthOf(source) * colourOf(source.emissiveFactor, vec3{0});
    material.twoSided = source.doubleSided;
    material.albedoImage = images.imageOf(surface.baseColorTexture);
    material.metallicRoughnessImage = images.imageOf(surface.metallicRoughnessTexture);
    setWrap(material, surface, file);
    return material;
}

} // namespace

void addMaterials(Model& model, const tinygltf::Model& file)
{
    ImageUse images(model, file);
    for (const tinygltf::Material& material : file.materials)
        model.materials.push_back(materialOf(material, file, images));
}

} // namespace antumbra::scene
