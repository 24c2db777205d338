#include "base/file.h"

#include "base/error.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace antumbra {

namespace {

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

uint64_t checkedSize(const Path& path, uint64_t greatestBytes)
{
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status))
        throw Error("no such file", path.string());
    if (!std::filesystem::is_regular_file(status))
        throw Error("not a regular file", path.string());
    const uint64_t size = std::filesystem::file_size(path, failure);
    if (failure)
        throw Error(failure.message(), path.string());
    if (size > greatestBytes)
        throw Error("file of " + std::to_string(size) + " bytes is larger than the limit of " + std::to_string(greatestBytes),
                    path.string());
    return size;
}

template <class Container>
Container readWhole(const Path& path, uint64_t greatestBytes)
{
    Container content;
    content.resize(checkedSize(path, greatestBytes));
    const OpenFile file(std::fopen(path.c_str(), "rb"));
    if (!file)
        throw Error(std::strerror(errno), path.string());
    if (std::fread(content.data(), 1, content.size(), file.get()) != content.size())
        throw Error("file ended early", path.string());
    return content;
}

// Returns whether every byte is in the file; errno tells why not.
bool writeWhole(const Path& path, std::span<const std::byte> bytes)
{
    const OpenFile file(std::fopen(path.c_str(), "wb"));
    return file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() && std::fflush(file.get()) == 0;
}

} // namespace

std::vector<std::byte> readFile(const Path& path, uint64_t greatestBytes) { return readWhole<std::vector<std::byte>>(path, greatestBytes); }

std::string readText(const Path& path, uint64_t greatestBytes) { return readWhole<std::string>(path, greatestBytes); }

void writeFile(const Path& path, std::span<const std::byte> bytes)
{
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    // Renaming onto a device or a pipe would put a plain file in its place.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw Error("not a regular file", path.string());
    if (path.has_parent_path())
        std::filesystem::create_directories(path.parent_path(), failure);
    const Path beside = path.string() + ".part";
    if (writeWhole(beside, bytes))
        std::filesystem::rename(beside, path, failure);
    else
        failure.assign(errno, std::generic_category());
    if (failure) {
        const std::string reason = failure.message();
        std::filesystem::remove(beside, failure);
        throw Error(reason, path.string());
    }
}

void writeText(const Path& path, std::string_view text) { writeFile(path, std::as_bytes(std::span(text))); }

Path projectPath(std::string_view name)
{
    const char* root = std::getenv("ANTUMBRA_ROOT");
    return Path(root != nullptr ? root : ANTUMBRA_SOURCE_ROOT) / name;
}

} // namespace antumbra
