#include "scene/gltf.h"

#include "base/error.h"
#include "scene/animation.h"
#include "scene/gltf_repairs.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

const Path kAssets = Path(ANTUMBRA_SHARED_DIR) / "assets";

/// Empty when the file loads.
std::string refusalOf(const Path& path)
{
    try {
        loadGltf(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::BadInput);
        EXPECT_EQ(error.which, path.string());
        return error.what();
    }
    return "";
}

std::vector<Path> modelsUnder(const Path& folder)
{
    std::vector<Path> models;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
            models.push_back(entry.path());
    std::sort(models.begin(), models.end());
    return models;
}

void expectSound(const Model& model, const Path& path)
{
    const Mesh& mesh = model.mesh;
    const size_t vertices = mesh.positions.size();
    EXPECT_EQ(mesh.normals.size(), vertices) << path;
    EXPECT_EQ(mesh.uvs.size(), vertices) << path;
    EXPECT_EQ(mesh.influences.size(), vertices) << path;
    EXPECT_TRUE(mesh.bakeUvs.empty() || mesh.bakeUvs.size() == vertices) << path;
    EXPECT_EQ(mesh.triangleMaterials.size() * 3, mesh.indices.size()) << path;
    EXPECT_TRUE(std::all_of(mesh.indices.begin(), mesh.indices.end(), [&](uint32_t index) { return index < vertices; })) << path;
    EXPECT_TRUE(std::all_of(mesh.triangleMaterials.begin(), mesh.triangleMaterials.end(), [&](uint32_t material) {
        return material < model.materials.size();
    })) << path;
    EXPECT_EQ(model.restMorphWeights.size(), mesh.morphTargets.size()) << path;
    EXPECT_FALSE(model.joints.empty()) << path;
    for (size_t i = 0; i < model.nodes.size(); ++i)
        EXPECT_TRUE(model.nodes[i].parent == kNoIndex || model.nodes[i].parent < i) << path;
    for (const Influence& influence : mesh.influences) {
        float sum = 0;
        for (size_t i = 0; i < 4; ++i) {
            ASSERT_LT(influence.joints[i], model.joints.size()) << path;
            sum += influence.weights[i];
        }
        ASSERT_NEAR(sum, 1, 1e-5) << path;
    }
    for (const vec3& position : restMesh(model).positions)
        ASSERT_TRUE(std::isfinite(position.x + position.y + position.z)) << path;
}

Model loadAsset(const std::string& name) { return loadGltf(kAssets / "characters" / name); }

// A document around one triangle; `more` goes into the root, `position` into the positions' accessor.
std::string triangleText(const std::string& more = "", const std::string& nodes = R"([{"mesh": 0}])")
{
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
           R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}], "bufferViews": [{"buffer": 0, "byteLength": 36}], )"
           R"("accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],)"
           R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": )" +
           nodes + more + "}";
}

Path temporary(const std::string& name)
{
    static const TestFolder folder;
    return folder / name;
}

Path temporary(const std::string& name, const std::string& text)
{
    Path path = temporary(name);
    writeText(path, text);
    return path;
}

} // namespace

TEST(Gltf, EveryCharacterAndSceneLoads)
{
    if (!std::filesystem::exists(kAssets))
        GTEST_SKIP() << "no " << kAssets;
    int loaded = 0;
    for (const char* folder : {"characters", "scenes"})
        for (const Path& path : modelsUnder(kAssets / folder)) {
            if (path.string().find("must-refuse") != std::string::npos)
                continue;
            try {
                expectSound(loadGltf(path), path);
                ++loaded;
            } catch (const Error& error) {
                ADD_FAILURE() << error.what();
            }
        }
    EXPECT_GT(loaded, 50);
}

TEST(Gltf, CompressedGeometryIsRefusedByName)
{
    const Path folder = kAssets / "characters/awkward-valid/must-refuse";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "no " << folder;
    for (const Path& path : modelsUnder(folder)) {
        const std::string refusal = refusalOf(path);
        const bool isNamed =
            refusal.find("KHR_draco_mesh_compression") != std::string::npos || refusal.find("EXT_meshopt_compression") != std::string::npos;
        EXPECT_TRUE(isNamed) << path << ": " << refusal;
    }
}

TEST(Gltf, TrianglesOfKnownCharacters)
{
    if (!std::filesystem::exists(kAssets))
        GTEST_SKIP() << "no " << kAssets;
    const Model man = loadAsset("CesiumMan.glb");
    EXPECT_EQ(man.mesh.indices.size(), 3u * 4672);
    EXPECT_EQ(man.mesh.positions.size(), 3273u);
    EXPECT_EQ(man.joints.size(), 19u);
    ASSERT_EQ(man.images.size(), 1u);
    EXPECT_EQ(man.materials.at(0).albedoImage, 0u);
    EXPECT_NEAR(man.clips.at(0).duration, 2, 1e-3);
    const Model modes = loadAsset("awkward-valid/own_all_modes_nonindexed.glb");
    EXPECT_EQ(modes.mesh.indices.size(), 3u * 22);
    const Model skins = loadAsset("awkward-valid/own_TwoSkins_recursive.gltf");
    EXPECT_EQ(skins.mesh.indices.size(), 3u * 16);
    EXPECT_EQ(skins.joints.size(), 4u);
    EXPECT_EQ(loadAsset("awkward-valid/own_NegativeScale.glb").mesh.indices.size(), 3u * 72);
}

TEST(Gltf, QuantizedCharactersStandLikeTheOriginals)
{
    if (!std::filesystem::exists(kAssets))
        GTEST_SKIP() << "no " << kAssets;
    for (const char* name : {"Fox", "RiggedFigure"}) {
        const Aabb original = restMesh(loadAsset(std::string(name) + ".glb")).bounds();
        const Aabb quantized = restMesh(loadAsset("awkward-valid/" + std::string(name) + "_quantized.glb")).bounds();
        const float tolerance = 0.01f * glm::length(original.extent());
        EXPECT_LT(glm::distance(original.lowest, quantized.lowest), tolerance) << name;
        EXPECT_LT(glm::distance(original.highest, quantized.highest), tolerance) << name;
    }
}

TEST(Gltf, MirroredPartsFaceOutwards)
{
    if (!std::filesystem::exists(kAssets))
        GTEST_SKIP() << "no " << kAssets;
    const Mesh posed = restMesh(loadAsset("awkward-valid/own_NegativeScale.glb"));
    for (size_t i = 0; i < posed.indices.size(); i += 3) {
        const vec3 a = posed.positions[posed.indices[i]];
        const vec3 face = glm::cross(posed.positions[posed.indices[i + 1]] - a, posed.positions[posed.indices[i + 2]] - a);
        EXPECT_GT(glm::dot(face, posed.normals[posed.indices[i]]), 0) << "triangle " << i / 3;
    }
}

TEST(Gltf, MissingNormalsAreFlat)
{
    const Model model = loadGltf(temporary("flat.gltf", triangleText()));
    ASSERT_EQ(model.mesh.normals.size(), 3u);
    for (const vec3& normal : model.mesh.normals)
        EXPECT_EQ(normal, vec3(0, 0, 1));
    EXPECT_EQ(model.materials.size(), 1u);
    EXPECT_EQ(model.materials[0].albedo, vec3(1));
}

TEST(Gltf, NodesBecomeRigidJoints)
{
    const Model model = loadGltf(temporary(
        "nodes.gltf",
        triangleText("", R"([{"mesh": 0, "translation": [0, 0, 5]}, {"children": [0], "translation": [1, 0, 0]}, {"mesh": 0}])")));
    EXPECT_EQ(model.nodes.size(), 3u);
    EXPECT_EQ(model.joints.size(), 2u);
    EXPECT_EQ(model.mesh.indices.size(), 6u);
    const Aabb bounds = restMesh(model).bounds();
    EXPECT_EQ(bounds.lowest, vec3(0));
    EXPECT_EQ(bounds.highest, vec3(2, 1, 5));
}

TEST(Gltf, MatricesBecomePoses)
{
    // Columns: y, -2x, z moved by (3, 4, 5): a quarter turn about z, the y axis twice as long.
    const Model model =
        loadGltf(temporary("matrix.gltf", triangleText("", R"([{"mesh": 0, "matrix": [0,1,0,0, -2,0,0,0, 0,0,1,0, 3,4,5,1]}])")));
    const NodePose& rest = model.nodes.at(0).rest;
    EXPECT_EQ(rest.translation, vec3(3, 4, 5));
    EXPECT_NEAR(glm::distance(rest.scale, vec3(1, 2, 1)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(rest.rotation * vec3(1, 0, 0), vec3(0, 1, 0)), 0, 1e-6);
}

TEST(Gltf, OnlyTheDefaultSceneIsBuilt)
{
    const std::string nodes = R"([{"mesh": 0}, {"mesh": 0, "translation": [9, 0, 0]}])";
    const std::string scenes = R"(, "scenes": [{"nodes": [0]}, {"nodes": [1]}], "scene": 1)";
    EXPECT_EQ(restMesh(loadGltf(temporary("scene.gltf", triangleText(scenes, nodes)))).bounds().lowest, vec3(9, 0, 0));
}

TEST(Gltf, RequiredExtensionsAreRefusedByName)
{
    const std::string extensions = R"(, "extensionsUsed": ["EXT_future"], "extensionsRequired": ["EXT_future"])";
    EXPECT_NE(refusalOf(temporary("future.gltf", triangleText(extensions))).find("EXT_future"), std::string::npos);
    EXPECT_EQ(refusalOf(temporary("optional.gltf", triangleText(R"(, "extensionsUsed": ["EXT_future"])"))), "");
}

TEST(Gltf, HostileSizesAreRefused)
{
    const auto refuses = [](const std::string& from, const std::string& to) {
        std::string text = triangleText();
        text.replace(text.find(from), from.size(), to);
        return !refusalOf(temporary("hostile.gltf", text)).empty();
    };
    EXPECT_FALSE(refuses(R"("count": 3)", R"("count": 3.0)"));
    EXPECT_TRUE(refuses(R"("bufferView": 0, "componentType": 5126, "count": 3)", R"("componentType": 5126, "count": 4294967295)"));
    EXPECT_TRUE(refuses(R"("byteLength": 36}], "accessors")", R"("byteOffset": 9007199254740992, "byteLength": 36}], "accessors")"));
    EXPECT_TRUE(refuses(R"("count": 3)", R"("count": 9007199254740992)"));
    EXPECT_TRUE(refuses(R"("byteLength": 36, "uri": "data)", R"("byteLength": 9007199254740992, "x": "data)"));
}

TEST(Gltf, ImagesMustDecodeWhereTheyAreShown)
{
    const std::string shown = R"(, "images": [{"uri": "data:image/png;base64,AAAA"}], "textures": [{"source": 0}])";
    EXPECT_EQ(refusalOf(temporary("unused.gltf", triangleText(shown))), "");
    std::string text = triangleText(shown + R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    EXPECT_NE(refusalOf(temporary("shown.gltf", text)).find("images[0]"), std::string::npos);
    const std::string missing = R"(, "images": [{"uri": "antumbra_absent.png"}])";
    EXPECT_NE(refusalOf(temporary("missing.gltf", triangleText(missing))).find("images[0]"), std::string::npos);
}

TEST(Gltf, TexturesWrapAsTheirSamplersSay)
{
    const std::string pixel = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4//8/AAX+Av4N70a4AAAAAElFTkSuQmCC";
    const std::string textures =
        R"(, "images": [{"uri": "data:image/png;base64,)" + pixel +
        R"("}], "samplers": [{"wrapS": 33071, "wrapT": 33648}, {}],)"
        R"( "textures": [{"source": 0, "sampler": 0}, {"source": 0, "sampler": 1}, {"source": 0}], "materials": [)"
        R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}}},)"
        R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}},)"
        R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}},)"
        R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}, {}])";
    const std::vector<Material> materials = loadGltf(temporary("wrap.gltf", triangleText(textures))).materials;
    for (const size_t wrapped : {0, 1}) {
        EXPECT_EQ(materials.at(wrapped).wrapU, Wrap::Clamp) << wrapped;
        EXPECT_EQ(materials.at(wrapped).wrapV, Wrap::Mirror) << wrapped;
    }
    for (const size_t plain : {2, 3, 4}) {
        EXPECT_EQ(materials.at(plain).wrapU, Wrap::Repeat) << plain;
        EXPECT_EQ(materials.at(plain).wrapV, Wrap::Repeat) << plain;
    }
}

TEST(Gltf, OnlyPositionsAreHeldToTheirBounds)
{
    const std::string end = R"("max": [1, 1, 0]})", position = R"("POSITION": 0)";
    std::string text = triangleText();
    text.replace(text.find(end), end.size(),
                 end + R"(, {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 0]})");
    EXPECT_EQ(refusalOf(temporary("unheld.gltf", text)), "");
    text.replace(text.find(position), position.size(), R"("POSITION": 1)");
    EXPECT_NE(refusalOf(temporary("held.gltf", text)).find("accessors[1]"), std::string::npos);
}

TEST(Gltf, ANodeMayBeTwoJoints)
{
    const std::string skins = R"(, "skins": [{"joints": [1, 1]}])";
    EXPECT_EQ(refusalOf(temporary("joints.gltf", triangleText(skins, R"([{"mesh": 0, "skin": 0}, {}])"))), "");
}

TEST(Gltf, RepairsAreToldOnceWithTheirFirstPlace)
{
    Repairs repairs;
    repairs.note("skins[1]", "a remedy");
    repairs.note("skins[2]", "another");
    repairs.note("skins[3]", "a remedy");
    repairs.note("skins[4]", "a remedy");
    EXPECT_EQ(repairs.lines(), (std::vector<std::string>{"skins[1] and 2 more: a remedy", "skins[2]: another"}));
    EXPECT_TRUE(Repairs{}.lines().empty());
}

TEST(Gltf, ARepairIsToldInTheLog)
{
    testing::internal::CaptureStderr();
    const Path path = temporary("told.gltf", triangleText(R"(, "skins": [{"joints": [1, 1]}])", R"([{"mesh": 0, "skin": 0}, {}])"));
    loadGltf(path);
    EXPECT_NE(testing::internal::GetCapturedStderr().find(path.string() + ": skins[0]: a node that is two joints"), std::string::npos);
}

TEST(Gltf, InspectTellsWhatIsThere)
{
    const std::string text = inspect(temporary("inspect.gltf", triangleText()));
    EXPECT_NE(text.find("triangles 1, vertices 3, morph targets 0"), std::string::npos) << text;
    EXPECT_NE(text.find("nodes 1, joints 1, materials 1, images 0"), std::string::npos) << text;
    EXPECT_THROW(inspect("/absent/file.glb"), Error);
    const Path picture = temporary("picture.exr");
    saveExr(picture, {2, 1, 3, {1, 2, 3, 3, 2, 1}});
    EXPECT_NE(inspect(picture).find("2x1, 3 channels"), std::string::npos);
    EXPECT_NE(inspect(picture).find("channel 0: min 1, mean 2, max 3"), std::string::npos) << inspect(picture);
}
