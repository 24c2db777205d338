#include "scene/gltf_resources.h"

#include "scene/gltf_uri.h"

namespace antumbra::scene {

namespace {

constexpr uint64_t kGreatestTotal = uint64_t{512} << 20; // bytes in all buffers and images of a file
constexpr int kIndexTarget = 34963;

using Bytes = std::vector<std::byte>;

uint64_t unsignedOr(const Json& object, const char* name, uint64_t fallback) { return object.value(name, fallback); }

/// One document's buffers and images on their way from uris to names.
class Taking
{
public:
    Taking(GltfDocument& document, const Path& folder) : document_(document), folder_(folder) {}

    GltfResources all() &&
    {
        Json& root = document_.root;
        forEach("buffers", [this](Json& buffer, size_t i) { takeBuffer(buffer, i); });
        forEach("bufferViews", [&root](Json& view, size_t i) { checkView(view, root["buffers"], i); });
        forEach("images", [this](Json& image, size_t i) { takeImage(image, i); });
        return std::move(resources_);
    }

private:
    template <class Visit>
    void forEach(const char* array, Visit visit)
    {
        const auto found = document_.root.find(array);
        if (found == document_.root.end())
            return;
        for (size_t i = 0; i < found->size(); ++i)
            visit((*found)[i], i);
    }

    static std::string bufferName(size_t i) { return "buffer-" + std::to_string(i); }

    void takeBuffer(Json& buffer, size_t i)
    {
        const auto length = buffer["byteLength"].get<uint64_t>();
        Bytes bytes = bufferBytes(buffer, i);
        const bool isPlaceholder = bytes.empty();
        if (isPlaceholder)
            spend(length, fmt::format("buffers[{}]", i));
        require(isPlaceholder || bytes.size() >= length, "buffers[{}] is {} bytes long, but its data only {}", i, length, bytes.size());
        bytes.resize(length);
        keep(buffer, bufferName(i), std::move(bytes));
        resources_.isPlaceholder.push_back(isPlaceholder);
    }

    // Empty where the file gives the buffer no data, which glTF allows.
    Bytes bufferBytes(const Json& buffer, size_t i)
    {
        const auto uri = buffer.find("uri");
        if (uri != buffer.end())
            return fetch(uri->get<std::string>(), fmt::format("buffers[{}]", i), "application/octet-stream application/gltf-buffer");
        const bool isBinaryChunk = document_.isGlb && i == 0;
        require(!isBinaryChunk || !document_.binary.empty(), "buffers[0] has no uri, and the GLB no BIN chunk");
        return isBinaryChunk ? std::move(document_.binary) : Bytes{};
    }

    static void checkView(const Json& view, const Json& buffers, size_t i)
    {
        const uint64_t offset = unsignedOr(view, "byteOffset", 0);
        const auto length = view["byteLength"].get<uint64_t>();
        const auto available = buffers[view["buffer"].get<size_t>()]["byteLength"].get<uint64_t>();
        require(offset + length <= available, "bufferViews[{}] reaches to byte {} of a buffer of {}", i, offset + length, available);
        const uint64_t stride = unsignedOr(view, "byteStride", 0);
        require(stride % 4 == 0, "bufferViews[{}].byteStride of {} is not a multiple of 4", i, stride);
        require(stride <= length, "bufferViews[{}].byteStride of {} is greater than its byteLength", i, stride);
        require(stride == 0 || view.value("target", 0) != kIndexTarget, "bufferViews[{}] holds indices and has a byteStride", i);
    }

    void takeImage(Json& image, size_t i)
    {
        const std::string where = fmt::format("images[{}]", i);
        Bytes bytes;
        if (const auto uri = image.find("uri"); uri != image.end()) {
            bytes = fetch(uri->get<std::string>(), where, "image/png image/jpeg image/webp image/ktx2 image/vnd-ms.dds");
        } else {
            require(image.contains("bufferView"), "{} has neither uri nor bufferView", where);
            const Json& view = document_.root["bufferViews"][image["bufferView"].get<size_t>()];
            const Bytes& buffer = resources_.bytes.at(bufferName(view["buffer"].get<size_t>()));
            const auto first = buffer.begin() + static_cast<std::ptrdiff_t>(unsignedOr(view, "byteOffset", 0));
            bytes.assign(first, first + view["byteLength"].get<std::ptrdiff_t>());
            spend(bytes.size(), where);
        }
        require(!bytes.empty(), "{} is empty", where);
        image.erase("bufferView");
        keep(image, "image-" + std::to_string(i), std::move(bytes));
    }

    Bytes fetch(const std::string& uri, const std::string& where, std::string_view mediaTypes)
    {
        try {
            if (!isDataUri(uri)) {
                Bytes bytes = readRelativeUri(folder_, uri, left_);
                spend(bytes.size(), where);
                return bytes;
            }
            DataUri data = decodeDataUri(uri);
            require(mediaTypes.find(data.mediaType) != std::string_view::npos, "a data uri is of the type \"{}\"", data.mediaType);
            spend(data.bytes.size(), where);
            return std::move(data.bytes);
        } catch (const Error& error) {
            throw Error(fmt::format("{}: {}", where, error.what()), "");
        }
    }

    void spend(uint64_t bytes, const std::string& where)
    {
        require(bytes <= left_, "{} is too long: a file may have {} MiB of data", where, kGreatestTotal >> 20);
        left_ -= bytes;
    }

    void keep(Json& object, std::string name, Bytes bytes)
    {
        object["uri"] = name;
        resources_.bytes.emplace(std::move(name), std::move(bytes));
    }

    GltfDocument& document_;
    const Path& folder_;
    uint64_t left_ = kGreatestTotal;
    GltfResources resources_;
};

} // namespace

GltfResources takeResources(GltfDocument& document, const Path& folder) { return Taking(document, folder).all(); }

} // namespace antumbra::scene
