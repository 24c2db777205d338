#include "scene/gltf.h"

#include "base/error.h"
#include "base/log.h"
#include "scene/gltf_build.h"
#include "scene/gltf_document.h"
#include "scene/gltf_resources.h"
#include "scene/gltf_rules.h"
#include "scene/gltf_schema.h"

#include <algorithm>

namespace antumbra::scene {

namespace {

constexpr uint64_t kGreatestFile = uint64_t{256} << 20; // bytes

// tinygltf joins names to its idea of a folder; the resources are keyed by the last part.
std::vector<std::byte>* findResource(const std::string& path, void* resources)
{
    auto& bytes = static_cast<GltfResources*>(resources)->bytes;
    const auto found = bytes.find(Path(path).filename().string());
    return found == bytes.end() ? nullptr : &found->second;
}

// All that the parser can reach are the resources: there is no way from here to a file.
tinygltf::FsCallbacks callbacksFor(GltfResources& resources)
{
    tinygltf::FsCallbacks callbacks{};
    callbacks.user_data = &resources;
    callbacks.FileExists = [](const std::string& path, void* user) { return findResource(path, user) != nullptr; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& path, void* user) {
        const std::vector<std::byte>& bytes = *findResource(path, user);
        const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
        out->assign(first, first + bytes.size());
        return true;
    };
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
    return callbacks;
}

// Images stay encoded until a material shows them.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size, void*)
{
    image->image.assign(bytes, bytes + size);
    return true;
}

tinygltf::Model parse(const Json& root, GltfResources& resources)
{
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(callbacksFor(resources));
    parser.SetImageLoader(keepEncoded, nullptr);
    tinygltf::Model file;
    std::string errors;
    std::string warnings;
    const std::string text = root.dump();
    const bool isParsed = parser.LoadASCIIFromString(&file, &errors, &warnings, text.c_str(), static_cast<unsigned>(text.size()), "");
    require(isParsed, "{}", errors.substr(0, errors.find('\n')));
    for (size_t i = 0; i < file.buffers.size(); ++i)
        if (resources.isPlaceholder[i])
            file.buffers[i].data.clear();
    return file;
}

tinygltf::Model readChecked(std::span<const std::byte> bytes, const Path& folder, Repairs& repairs)
{
    GltfDocument document = readDocument(bytes);
    checkGltfSchema(document.root);
    checkVersionAndExtensions(document.root);
    GltfResources resources = takeResources(document, folder);
    tinygltf::Model file = parse(document.root, resources);
    checkAccessors(file, repairs);
    checkNodes(file, repairs);
    checkCameras(file);
    checkMeshes(file, repairs);
    checkAnimations(file, repairs);
    return file;
}

Model build(const tinygltf::Model& file)
{
    Model model;
    Placement placement;
    addNodes(model, placement, file);
    addMaterials(model, file);
    addMeshes(model, placement, file);
    addClips(model, placement, file);
    return model;
}

// Names out of a broken file may hold anything.
std::string oneLine(std::string text)
{
    constexpr size_t kLongest = 300;
    text.resize(std::min(text.size(), kLongest));
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

// Only of files that loaded: one that is refused ends in one line.
void warn(const Model& model, const tinygltf::Model& file, const Repairs& repairs, const Path& path)
{
    for (const std::string& line : repairs.lines())
        logWarning("{}: {}", path.string(), line);
    if (model.mesh.indices.empty())
        logWarning("{}: nothing in it is made of triangles", path.string());
    for (size_t i = 0; i < file.buffers.size(); ++i)
        if (file.buffers[i].data.empty())
            logWarning("{}: buffers[{}] has no data and reads as zeros", path.string(), i);
}

} // namespace

Model loadGltf(const Path& path)
{
    const std::vector<std::byte> bytes = readFile(path, kGreatestFile);
    try {
        Repairs repairs;
        const tinygltf::Model file = readChecked(bytes, path.has_parent_path() ? path.parent_path() : Path("."), repairs);
        Model model = build(file);
        model.name = path.stem().string();
        warn(model, file, repairs, path);
        return model;
    } catch (const Error& error) {
        throw Error(oneLine(error.what()), path.string());
    }
}

} // namespace antumbra::scene
