// glTF 2.0 in the language of gltf_schema.h, section by section of the specification's appendix "Properties Reference".
#include "scene/gltf_schema.h"

namespace antumbra::scene {

namespace {

constexpr Property kAsset[] = {
    {"version", text().required()},
    {"minVersion", text()},
    {"copyright", text()},
    {"generator", text()},
};

constexpr Property kBuffer[] = {
    {"uri", text()},
    {"byteLength", integer().from(1).required()},
};

constexpr Property kBufferView[] = {
    {"buffer", indexInto("/buffers").required()}, {"byteOffset", integer().from(0)},          {"byteLength", integer().from(1).required()},
    {"byteStride", integer().from(4).upTo(252)},  {"target", integer().among("34962 34963")},
};

// The parser keeps these in 32 bits.
constexpr Rule kSparseOffset = integer().from(0).upTo(2147483647);

constexpr Property kSparseIndices[] = {
    {"bufferView", indexInto("/bufferViews").required()},
    {"byteOffset", kSparseOffset},
    {"componentType", integer().among("5121 5123 5125").required()},
};

constexpr Property kSparseValues[] = {
    {"bufferView", indexInto("/bufferViews").required()},
    {"byteOffset", kSparseOffset},
};

constexpr Property kSparse[] = {
    {"count", integer().from(1).upTo(2147483647).required()},
    {"indices", object(kSparseIndices).required()},
    {"values", object(kSparseValues).required()},
};

constexpr Property kAccessor[] = {
    {"bufferView", indexInto("/bufferViews")},
    {"byteOffset", integer().from(0).needing("bufferView")},
    {"componentType", integer().among("5120 5121 5122 5123 5125 5126").required()},
    {"normalized", boolean()},
    {"count", integer().from(1).required()},
    {"type", text().among("SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4").required()},
    {"max", arrayOf(number(), 1, 16)},
    {"min", arrayOf(number(), 1, 16)},
    {"sparse", object(kSparse)},
};

constexpr Property kAnimationTarget[] = {
    {"node", indexInto("/nodes")},
    {"path", text().required()},
};

// `sampler` points into the animation itself; the rules of animations look at it.
constexpr Property kAnimationChannel[] = {
    {"sampler", integer().from(0).upTo(2147483647).required()},
    {"target", object(kAnimationTarget).required()},
};

constexpr Property kAnimationSampler[] = {
    {"input", indexInto("/accessors").required()},
    {"interpolation", text().among("LINEAR STEP CUBICSPLINE")},
    {"output", indexInto("/accessors").required()},
};

constexpr Property kAnimation[] = {
    {"channels", arrayOf(object(kAnimationChannel)).required()},
    {"samplers", arrayOf(object(kAnimationSampler)).required()},
};

constexpr Property kOrthographic[] = {
    {"xmag", number().required()},
    {"ymag", number().required()},
    {"zfar", number().above(0).required()},
    {"znear", number().from(0).required()},
};

constexpr Property kPerspective[] = {
    {"aspectRatio", number().above(0)},
    {"yfov", number().above(0).required()},
    {"zfar", number().above(0)},
    {"znear", number().above(0).required()},
};

constexpr Property kCamera[] = {
    {"type", text().among("orthographic perspective").selecting("orthographic perspective").required()},
    {"orthographic", object(kOrthographic).needing("type").excluding("perspective")},
    {"perspective", object(kPerspective)},
};

constexpr Property kImage[] = {
    {"uri", text().excluding("bufferView")},
    {"bufferView", indexInto("/bufferViews").needing("mimeType")},
    {"mimeType", text()},
};

constexpr Property kSampler[] = {
    {"magFilter", integer().among("9728 9729")},
    {"minFilter", integer().among("9728 9729 9984 9985 9986 9987")},
    {"wrapS", integer().among("33071 33648 10497")},
    {"wrapT", integer().among("33071 33648 10497")},
};

constexpr Property kTexture[] = {
    {"sampler", indexInto("/samplers")},
    {"source", indexInto("/images")},
};

constexpr Rule kTextureIndex = indexInto("/textures").required();
constexpr Rule kTexCoord = integer().from(0).upTo(255);
constexpr Property kTextureInfo[] = {{"index", kTextureIndex}, {"texCoord", kTexCoord}};
constexpr Property kNormalTextureInfo[] = {{"index", kTextureIndex}, {"texCoord", kTexCoord}, {"scale", number()}};
constexpr Property kOcclusionTextureInfo[] = {{"index", kTextureIndex}, {"texCoord", kTexCoord}, {"strength", number().from(0).upTo(1)}};

constexpr Rule kFactor = number().from(0).upTo(1);
constexpr Property kMetallicRoughness[] = {
    {"baseColorFactor", arrayOf(kFactor, 4, 4)},
    {"baseColorTexture", object(kTextureInfo)},
    {"metallicFactor", kFactor},
    {"roughnessFactor", kFactor},
    {"metallicRoughnessTexture", object(kTextureInfo)},
};

constexpr Property kMaterial[] = {
    {"pbrMetallicRoughness", object(kMetallicRoughness)},
    {"normalTexture", object(kNormalTextureInfo)},
    {"occlusionTexture", object(kOcclusionTextureInfo)},
    {"emissiveTexture", object(kTextureInfo)},
    {"emissiveFactor", arrayOf(kFactor, 3, 3)},
    {"alphaMode", text().among("OPAQUE MASK BLEND")},
    {"alphaCutoff", number().from(0)},
    {"doubleSided", boolean()},
};

constexpr Property kPrimitive[] = {
    {"attributes", mapOf(indexInto("/accessors")).required()},
    {"indices", indexInto("/accessors")},
    {"material", indexInto("/materials")},
    {"mode", integer().from(0).upTo(6)},
    {"targets", arrayOfMapsOf(indexInto("/accessors"))},
};

constexpr Property kMesh[] = {
    {"primitives", arrayOf(object(kPrimitive)).required()},
    {"weights", arrayOf(number())},
};

constexpr Property kNode[] = {
    {"camera", indexInto("/cameras")},
    {"children", arrayOf(indexInto("/nodes")).distinct()},
    {"skin", indexInto("/skins").needing("mesh")},
    {"matrix", arrayOf(number(), 16, 16).excluding("translation rotation scale")},
    {"mesh", indexInto("/meshes")},
    {"rotation", arrayOf(number().from(-1).upTo(1), 4, 4)},
    {"scale", arrayOf(number(), 3, 3)},
    {"translation", arrayOf(number(), 3, 3)},
    {"weights", arrayOf(number()).needing("mesh")},
};

constexpr Property kScene[] = {
    {"nodes", arrayOf(indexInto("/nodes")).distinct()},
};

constexpr Property kSkin[] = {
    {"inverseBindMatrices", indexInto("/accessors")},
    {"skeleton", indexInto("/nodes")},
    {"joints", arrayOf(indexInto("/nodes")).required()},
};

constexpr Property kRoot[] = {
    {"asset", object(kAsset).required()},
    {"extensionsUsed", arrayOf(text()).distinct()},
    {"extensionsRequired", arrayOf(text()).distinct().needing("extensionsUsed")},
    {"accessors", arrayOf(object(kAccessor))},
    {"animations", arrayOf(object(kAnimation))},
    {"buffers", arrayOf(object(kBuffer))},
    {"bufferViews", arrayOf(object(kBufferView))},
    {"cameras", arrayOf(object(kCamera))},
    {"images", arrayOf(object(kImage))},
    {"materials", arrayOf(object(kMaterial))},
    {"meshes", arrayOf(object(kMesh))},
    {"nodes", arrayOf(object(kNode))},
    {"samplers", arrayOf(object(kSampler))},
    {"scene", indexInto("/scenes")},
    {"scenes", arrayOf(object(kScene))},
    {"skins", arrayOf(object(kSkin))},
    {"textures", arrayOf(object(kTexture))},
};

constexpr Property kSpot[] = {{"innerConeAngle", number().from(0)}, {"outerConeAngle", number().above(0)}};
constexpr Property kLight[] = {
    {"type", text().selecting("spot").required()},
    {"color", arrayOf(kFactor, 3, 3)},
    {"intensity", number().from(0)},
    {"range", number().above(0)},
    {"spot", object(kSpot)},
};
constexpr Property kLights[] = {{"lights", arrayOf(object(kLight)).required()}};
constexpr Property kLightOfNode[] = {{"light", indexInto("/extensions/KHR_lights_punctual/lights").required()}};
constexpr Property kTextureTransform[] = {
    {"offset", arrayOf(number(), 2, 2)}, {"rotation", number()}, {"scale", arrayOf(number(), 2, 2)}, {"texCoord", kTexCoord}};
constexpr Property kEmissiveStrength[] = {{"emissiveStrength", number().from(0)}};

constexpr Extension kExtensions[] = {
    {"KHR_lights_punctual", kRoot, kLights},
    {"KHR_lights_punctual", kNode, kLightOfNode},
    {"KHR_texture_transform", kTextureInfo, kTextureTransform},
    {"KHR_texture_transform", kNormalTextureInfo, kTextureTransform},
    {"KHR_texture_transform", kOcclusionTextureInfo, kTextureTransform},
    {"KHR_materials_emissive_strength", kMaterial, kEmissiveStrength},
    {"KHR_materials_unlit", kMaterial, {}},
};

} // namespace

void checkGltfSchema(Json& root) { checkShape(root, kRoot, kExtensions); }

} // namespace antumbra::scene
