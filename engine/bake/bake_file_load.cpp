#include "bake/bake_file.h"

#include "bake/bake_file_layout.h"
#include "bake/settings.h"
#include "base/error.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>

namespace antumbra::bake {

namespace {

constexpr uint64_t kGreatestPart = uint64_t{1} << 30; // bytes, decoded
constexpr uint32_t kGreatestSide = 16384;             // pixels

bool isFinite(uint16_t half) { return (half & 0x7c00) != 0x7c00; }

/// A bake's file while it is read; every complaint names it.
class BakeReader
{
public:
    explicit BakeReader(const Path& path);

    Bake read();

private:
    [[noreturn]] void refuse(const std::string& reason) const { throw Error(reason, path_.string()); }
    [[noreturn]] void refuseUnreadable() const;

    template <class T>
    T attribute(const std::string& name, const OIIO::TypeDesc& type) const;
    uint64_t hashAttribute(const char* name) const;
    BakeSettings readSettings() const;
    Grid readGrid() const;
    void openPart(int index, std::string_view name, size_t channelCount);
    [[nodiscard]] uvec2 extent() const { return {spec_.width, spec_.height}; }
    std::vector<size_t> placesOf(const std::vector<std::string>& channels) const;
    std::vector<uint16_t> readPlanes(const std::vector<std::string>& channels);

    Path path_;
    OIIO::ImageInput::unique_ptr input_ = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec_; // of the part that is read
};

BakeReader::BakeReader(const Path& path) : path_(path)
{
    if (!std::filesystem::is_regular_file(path))
        refuse(std::filesystem::exists(path) ? "not a regular file" : "no such file");
    char signature[4]{};
    std::ifstream(path, std::ios::binary).read(signature, sizeof signature);
    if (std::string_view(signature, sizeof signature) != "\x76\x2f\x31\x01")
        refuse("not an OpenEXR file");
    if (!input_)
        refuse("this build of OpenImageIO reads no OpenEXR");
    if (!input_->open(path.string(), spec_))
        refuseUnreadable();
}

void BakeReader::refuseUnreadable() const
{
    const std::string message = input_->geterror();
    refuse("cut short or damaged: " + message.substr(0, message.find('\n')));
}

template <class T>
T BakeReader::attribute(const std::string& name, const OIIO::TypeDesc& type) const
{
    T value;
    if (!spec_.getattribute(name, type, &value))
        refuse(fmt::format("no attribute {}", name));
    return value;
}

uint64_t BakeReader::hashAttribute(const char* name) const
{
    const std::string text(spec_.get_string_attribute(name));
    uint64_t hash = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
    if (text.empty() || failure != std::errc{} || end != text.data() + text.size())
        refuse(fmt::format("attribute {} is not a hash", name));
    return hash;
}

BakeSettings BakeReader::readSettings() const
{
    BakeSettings settings;
    for (const BakeSetting& setting : kBakeSettings) {
        const std::string name = settingAttribute(setting.key);
        const auto value = attribute<float>(name, OIIO::TypeFloat);
        if (!setting.allows(value))
            refuse(fmt::format("attribute {} is {} and out of range", name, value));
        setting.write(settings, value);
    }
    return settings;
}

Grid BakeReader::readGrid() const
{
    const Grid grid{.origin = attribute<vec3>(kOriginAttribute, OIIO::TypeVector),
                    .spacing = attribute<vec3>(kSpacingAttribute, OIIO::TypeVector),
                    .count = attribute<glm::uvec3>(kCountAttribute, OIIO::TypeDesc(OIIO::TypeDesc::INT, OIIO::TypeDesc::VEC3))};
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(grid.origin[axis]) || !std::isfinite(grid.spacing[axis]) || !(grid.spacing[axis] > 0) || grid.count[axis] < 1 ||
            grid.count[axis] > kGreatestSide)
            refuse("its grid of cells makes no sense");
    return grid;
}

void BakeReader::openPart(int index, std::string_view name, size_t channelCount)
{
    if (!input_->seek_subimage(index, 0, spec_))
        refuse(fmt::format("no part \"{}\"", name));
    if (std::string(spec_.get_string_attribute("oiio:subimagename")) != name || spec_.format != OIIO::TypeDesc::HALF ||
        !spec_.channelformats.empty())
        refuse(fmt::format("its part {} is not \"{}\" in half floats", index, name));
    const bool isFlat = spec_.width > 0 && spec_.height > 0 && spec_.depth <= 1 && spec_.tile_width == 0 && !spec_.deep;
    if (!isFlat || extent().x > kGreatestSide || extent().y > kGreatestSide || spec_.x != 0 || spec_.y != 0)
        refuse(fmt::format("part \"{}\" has no sane size", name));
    if (static_cast<size_t>(spec_.nchannels) != channelCount)
        refuse(fmt::format("part \"{}\" has {} channels and not {}", name, spec_.nchannels, channelCount));
    if (uint64_t{extent().x} * extent().y * channelCount * sizeof(uint16_t) > kGreatestPart)
        refuse(fmt::format("part \"{}\" takes more than a GiB", name));
}

std::vector<size_t> BakeReader::placesOf(const std::vector<std::string>& channels) const
{
    std::vector<size_t> places;
    for (const std::string& channel : channels) {
        const auto found = std::ranges::find(spec_.channelnames, channel);
        if (found == spec_.channelnames.end())
            refuse(fmt::format("no channel {}", channel));
        places.push_back(static_cast<size_t>(found - spec_.channelnames.begin()));
    }
    return places;
}

std::vector<uint16_t> BakeReader::readPlanes(const std::vector<std::string>& channels)
{
    const std::vector<size_t> places = placesOf(channels);
    const size_t pixels = size_t{extent().x} * extent().y;
    std::vector<uint16_t> planes(pixels * places.size());
    std::vector<uint16_t> rows(size_t{kRowsAtOnce} * extent().x * places.size());
    for (uint32_t top = 0; top < extent().y; top += kRowsAtOnce) {
        const uint32_t bottom = std::min(top + kRowsAtOnce, extent().y);
        if (!input_->read_scanlines(input_->current_subimage(), 0, static_cast<int>(top), static_cast<int>(bottom), 0, 0, spec_.nchannels,
                                    OIIO::TypeDesc::HALF, rows.data()))
            refuseUnreadable();
        for (size_t channel = 0; channel < places.size(); ++channel)
            for (size_t pixel = 0; pixel < size_t{bottom - top} * extent().x; ++pixel)
                planes[channel * pixels + size_t{top} * extent().x + pixel] = rows[pixel * places.size() + places[channel]];
    }
    if (!std::ranges::all_of(planes, isFinite))
        refuse("holds values that are not finite");
    return planes;
}

Bake BakeReader::read()
{
    if (spec_.find_attribute(kVersionAttribute) == nullptr)
        refuse("an OpenEXR picture, but no bake");
    if (const int version = spec_.get_int_attribute(kVersionAttribute); version != kBakeFileVersion)
        refuse(fmt::format("a bake of version {}, and this program reads version {}", version, kBakeFileVersion));
    Bake bake{.settings = readSettings(), .sceneHash = hashAttribute(kSceneAttribute), .atlas = {}, .volume = {}};
    bake.volume.grid = readGrid();
    const uint64_t checksum = hashAttribute(kChecksumAttribute);

    std::vector<std::string> channels = transferChannels(bake.settings.coefficientCount());
    openPart(0, kTransferPart, channels.size());
    bake.atlas.extent = extent();
    bake.atlas.planes = readPlanes(channels);

    channels = volumeChannels(bake.settings.coefficientCount());
    openPart(1, kVolumePart, channels.size());
    if (extent() != volumeExtent(bake.volume.grid))
        refuse("its volume is not of the size that its grid says");
    bake.volume.planes = readPlanes(channels);
    const auto open = bake.volume.planes.end() - bake.volume.grid.cellCount();
    std::ranges::transform(open, bake.volume.planes.end(), std::back_inserter(bake.volume.isOpen),
                           [](uint16_t half) { return static_cast<uint8_t>(half != 0); });
    bake.volume.planes.erase(open, bake.volume.planes.end());

    if (checksumOf(bake) != checksum)
        refuse("damaged: its checksum is wrong");
    return bake;
}

} // namespace

Bake loadBake(const Path& path) { return BakeReader(path).read(); }

} // namespace antumbra::bake
