#include "bake/bake_file.h"

#include "bake/bake_file_layout.h"
#include "bake/settings.h"
#include "base/check.h"
#include "base/error.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <fmt/format.h>

namespace antumbra::bake {

namespace {

/// What a part of the file is made of: a plane a channel, rows from the top.
struct PartToWrite
{
    OIIO::ImageSpec spec;
    std::vector<const uint16_t*> planes;
};

PartToWrite partOf(const char* name, uvec2 extent, std::vector<std::string> channels, const std::vector<uint16_t>& planes)
{
    const size_t pixels = size_t{extent.x} * extent.y;
    check(planes.size() % pixels == 0, "whole planes");
    PartToWrite part{.spec = OIIO::ImageSpec(static_cast<int>(extent.x), static_cast<int>(extent.y), static_cast<int>(channels.size()),
                                             OIIO::TypeDesc::HALF),
                     .planes = {}};
    part.spec.channelnames = std::move(channels);
    part.spec["oiio:subimagename"] = name;
    for (size_t first = 0; first < planes.size(); first += pixels)
        part.planes.push_back(&planes[first]);
    return part;
}

void describe(OIIO::ImageSpec& spec, const Bake& bake, uint64_t checksum, uvec2 windowExtent)
{
    const Grid& grid = bake.volume.grid;
    spec["compression"] = "zip";
    spec["DateTime"] = "2000:01:01 00:00:00"; // the time of writing would make equal bakes differ
    // All parts of a file share the display window.
    spec.full_width = static_cast<int>(windowExtent.x);
    spec.full_height = static_cast<int>(windowExtent.y);
    spec[kVersionAttribute] = kBakeFileVersion;
    spec[kSceneAttribute] = hexadecimal(bake.sceneHash);
    spec[kChecksumAttribute] = hexadecimal(checksum);
    for (const BakeSetting& setting : kBakeSettings)
        spec[settingAttribute(setting.key)] = static_cast<float>(setting.read(bake.settings));
    const glm::ivec3 count(grid.count);
    spec.attribute(kOriginAttribute, OIIO::TypeVector, &grid.origin);
    spec.attribute(kSpacingAttribute, OIIO::TypeVector, &grid.spacing);
    spec.attribute(kCountAttribute, OIIO::TypeDesc(OIIO::TypeDesc::INT, OIIO::TypeDesc::VEC3), &count);
}

bool writePixels(OIIO::ImageOutput& output, const PartToWrite& part)
{
    const auto width = static_cast<uint32_t>(part.spec.width), height = static_cast<uint32_t>(part.spec.height);
    const size_t channels = part.planes.size();
    std::vector<uint16_t> rows;
    for (uint32_t top = 0; top < height; top += kRowsAtOnce) {
        const uint32_t bottom = std::min(top + kRowsAtOnce, height);
        rows.resize(size_t{bottom - top} * width * channels);
        for (size_t channel = 0; channel < channels; ++channel)
            for (size_t pixel = 0; pixel < size_t{bottom - top} * width; ++pixel)
                rows[pixel * channels + channel] = part.planes[channel][size_t{top} * width + pixel];
        if (!output.write_scanlines(static_cast<int>(top), static_cast<int>(bottom), 0, OIIO::TypeDesc::HALF, rows.data()))
            return false;
    }
    return true;
}

/// Parts of one file have to be written through its name; memory is for single ones.
void writeParts(const Path& path, std::span<const PartToWrite> parts, const Path& subject)
{
    const auto output = OIIO::ImageOutput::create("openexr");
    if (!output)
        throw Error("this build of OpenImageIO writes no OpenEXR", subject.string());
    std::vector<OIIO::ImageSpec> specs;
    for (const PartToWrite& part : parts)
        specs.push_back(part.spec);
    bool isWritten = output->open(path.string(), static_cast<int>(specs.size()), specs.data()) && writePixels(*output, parts.front());
    for (size_t i = 1; i < parts.size(); ++i)
        isWritten = isWritten && output->open(path.string(), specs[i], OIIO::ImageOutput::AppendSubimage) && writePixels(*output, parts[i]);
    if (!isWritten || !output->close()) {
        const std::string reason = output->geterror();
        throw Error(reason.substr(0, reason.find('\n')), subject.string());
    }
}

/// Removes the file unless it was renamed.
struct FileBeside
{
    explicit FileBeside(const Path& target) : path(target.string() + ".part") {}
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;
    ~FileBeside()
    {
        std::error_code failure;
        std::filesystem::remove(path, failure);
    }

    Path path;
};

} // namespace

void saveBake(const Path& path, const Bake& bake)
{
    const auto coefficients = bake.settings.coefficientCount();
    const uvec2 atlasExtent = bake.atlas.extent, cellsExtent = volumeExtent(bake.volume.grid);
    check(atlasExtent.x * atlasExtent.y > 0 && cellsExtent.x * cellsExtent.y > 0, "texels and cells");
    std::vector<uint16_t> open(bake.volume.isOpen.size());
    std::ranges::transform(bake.volume.isOpen, open.begin(), [](uint8_t isOpen) -> uint16_t { return isOpen ? kOpenHalf : 0; });
    std::vector<PartToWrite> parts{partOf(kTransferPart, atlasExtent, transferChannels(coefficients), bake.atlas.planes),
                                   partOf(kVolumePart, cellsExtent, volumeChannels(coefficients), bake.volume.planes)};
    parts[1].planes.push_back(open.data());
    const uint64_t checksum = checksumOf(bake);
    for (PartToWrite& part : parts) {
        check(part.planes.size() == part.spec.channelnames.size(), "a plane a channel");
        describe(part.spec, bake, checksum, glm::max(atlasExtent, cellsExtent));
    }

    std::error_code failure;
    if (path.has_parent_path())
        std::filesystem::create_directories(path.parent_path(), failure);
    const FileBeside beside(path);
    writeParts(beside.path, parts, path);
    // The library finishes the file where nobody sees its errors: a full disk is found by reading.
    loadBake(beside.path);
    std::filesystem::rename(beside.path, path, failure);
    if (failure)
        throw Error(failure.message(), path.string());
}

std::string staleness(const Bake& bake, uint64_t sceneHash, const BakeSettings& settings)
{
    if (bake.sceneHash != sceneHash)
        return "made of another scene";
    const std::string differing = difference(bake.settings, settings);
    return differing.empty() ? "" : "made with other settings: " + differing;
}

Path bakePathOf(const Path& scene)
{
    const Path scenes = projectPath("assets") / "scenes";
    std::error_code failure;
    const bool isName = scene == scene.filename() && !scene.has_extension();
    if (isName || (scene.extension() == ".json" && std::filesystem::equivalent(scene.parent_path(), scenes, failure)))
        return projectPath("assets") / "bakes" / (scene.stem().string() + ".exr");
    return Path(scene).replace_extension(".bake.exr");
}

} // namespace antumbra::bake
