#include "scene/images.h"

#include "base/error.h"
#include "base/log.h"
#include "scene/png_check.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cmath>

namespace antumbra::scene {

namespace {

constexpr uint64_t kGreatestSide = 16384;                  // pixels
constexpr uint64_t kGreatestDecoded = uint64_t{512} << 20; // bytes
constexpr uint64_t kGreatestFile = uint64_t{512} << 20;    // bytes

/// A file format known by its first bytes; `name` is OpenImageIO's.
struct Format
{
    std::string_view signature;
    std::string_view name;
    bool isRadiance;
};
constexpr std::string_view kPng = "png";
constexpr Format kFormats[] = {
    {"\x89PNG\r\n\x1a\n", kPng, false},
    {"\xff\xd8\xff", "jpeg", false},
    {"\x76\x2f\x31\x01", "openexr", true},
    {"#?", "hdr", true},
};

const Format& formatOf(std::span<const std::byte> encoded, const std::string& name)
{
    const std::string_view head(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    for (const Format& format : kFormats)
        if (head.starts_with(format.signature))
            return format;
    throw Error("not a PNG, JPEG, OpenEXR or Radiance picture", name);
}

Error readingError(const OIIO::ImageInput* input, const std::string& name)
{
    const std::string message = input == nullptr ? "no reader for its format" : input->geterror();
    return {"the picture cannot be read: " + message.substr(0, message.find('\n')), name};
}

/// A picture whose header has been read and found sane, before anything is allocated for it.
class OpenPicture
{
public:
    /// Keeps a reference to `encoded`. `bytesPerChannel` is what the caller will decode to.
    OpenPicture(const Format& format, std::span<const std::byte> encoded, size_t bytesPerChannel, const std::string& name)
        // The reader takes a pointer to non-const and only reads.
        : memory_(const_cast<std::byte*>(encoded.data()), encoded.size()), input_(OIIO::ImageInput::create(std::string(format.name))),
          name_(name)
    {
        if (format.name == kPng && !isWholePng(encoded))
            throw Error("the picture cannot be read: the PNG is truncated or damaged", name_);
        OIIO::ImageSpec wishes;
        wishes["oiio:UnassociatedAlpha"] = 1;
        if (!input_ || !input_->set_ioproxy(&memory_) || !input_->open("memory." + std::string(format.name), spec_, wishes))
            throw readingError(input_.get(), name_);
        checkSize(bytesPerChannel);
    }

    template <class T>
    std::vector<T> read(OIIO::TypeDesc type)
    {
        std::vector<T> values(size_t{width()} * height() * channels());
        if (!input_->read_image(0, 0, 0, spec_.nchannels, type, values.data()))
            throw readingError(input_.get(), name_);
        return values;
    }

    [[nodiscard]] uint32_t width() const { return static_cast<uint32_t>(spec_.width); }
    [[nodiscard]] uint32_t height() const { return static_cast<uint32_t>(spec_.height); }
    [[nodiscard]] uint32_t channels() const { return static_cast<uint32_t>(spec_.nchannels); }

private:
    void checkSize(size_t bytesPerChannel) const
    {
        if (spec_.width <= 0 || spec_.height <= 0 || spec_.depth > 1 || spec_.nchannels <= 0)
            throw Error("the picture has no pixels or is not flat", name_);
        if (width() > kGreatestSide || height() > kGreatestSide)
            throw Error("the picture is larger than 16384 pixels a side", name_);
        if (uint64_t{width()} * height() * channels() * bytesPerChannel > kGreatestDecoded)
            throw Error("the picture takes more than 512 MiB", name_);
    }

    OIIO::Filesystem::IOMemReader memory_;
    OIIO::ImageInput::unique_ptr input_;
    OIIO::ImageSpec spec_;
    std::string name_;
};

ImageF decodeF(const Format& format, std::span<const std::byte> encoded, const std::string& name)
{
    OpenPicture picture(format, encoded, sizeof(float), name);
    return {picture.width(), picture.height(), picture.channels(), picture.read<float>(OIIO::TypeDesc::FLOAT)};
}

// Grey or colour, with or without alpha, to RGBA.
std::vector<uint8_t> widened(const std::vector<uint8_t>& values, uint32_t channels)
{
    const size_t pixels = values.size() / channels;
    const bool isGrey = channels < 3;
    const bool hasAlpha = channels == 2 || channels >= 4;
    std::vector<uint8_t> rgba(4 * pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const uint8_t* from = &values[i * channels];
        uint8_t* to = &rgba[4 * i];
        for (size_t c = 0; c < 3; ++c)
            to[c] = from[isGrey ? 0 : c];
        to[3] = hasAlpha ? from[isGrey ? 1 : 3] : 255;
    }
    return rgba;
}

void save(const Path& path, const char* format, OIIO::ImageSpec spec, const OIIO::TypeDesc& type, const void* pixels)
{
    std::vector<unsigned char> encoded;
    OIIO::Filesystem::IOVecOutput memory(encoded);
    const auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->set_ioproxy(&memory))
        throw Error(std::string("this build of OpenImageIO writes no ") + format, path.string());
    spec["oiio:UnassociatedAlpha"] = 1;
    if (!output->open(path.string(), spec) || !output->write_image(type, pixels) || !output->close())
        throw Error(output->geterror(), path.string());
    writeFile(path, std::as_bytes(std::span(encoded)));
}

} // namespace

ImageF loadImageF(const Path& path)
{
    const std::vector<std::byte> encoded = readFile(path, kGreatestFile);
    return decodeF(formatOf(encoded, path.string()), encoded, path.string());
}

ImageF loadRadiance(const Path& path)
{
    const std::vector<std::byte> encoded = readFile(path, kGreatestFile);
    const Format& format = formatOf(encoded, path.string());
    if (!format.isRadiance)
        throw Error("an environment must be .hdr or .exr", path.string());
    const ImageF picture = decodeF(format, encoded, path.string());
    if (picture.channels < 3)
        throw Error("an environment needs three channels", path.string());

    ImageF radiance{picture.width, picture.height, 3, {}};
    radiance.values.resize(3 * size_t{picture.width} * picture.height);
    size_t scrubbed = 0;
    for (size_t i = 0; i < radiance.values.size(); ++i) {
        const float value = picture.values[i / 3 * picture.channels + i % 3];
        const bool isSane = std::isfinite(value) && value >= 0;
        radiance.values[i] = isSane ? value : 0;
        scrubbed += isSane ? 0 : 1;
    }
    if (scrubbed != 0)
        logWarning("{}: {} values were negative or not finite and are set to zero", path.string(), scrubbed);
    return radiance;
}

Image8 decodeImage8(std::span<const std::byte> encoded, const std::string& name)
{
    const Format& format = formatOf(encoded, name);
    if (format.isRadiance)
        throw Error("not a PNG or JPEG picture", name);
    OpenPicture picture(format, encoded, 4, name);
    return {picture.width(), picture.height(), widened(picture.read<uint8_t>(OIIO::TypeDesc::UINT8), picture.channels())};
}

float srgbDecoded(float encoded) { return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f); }

void saveExr(const Path& path, const ImageF& image)
{
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), static_cast<int>(image.channels),
                         OIIO::TypeDesc::FLOAT);
    spec["compression"] = "zip";
    save(path, "openexr", spec, OIIO::TypeDesc::FLOAT, image.values.data());
}

void savePng(const Path& path, const Image8& image)
{
    const OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 4, OIIO::TypeDesc::UINT8);
    save(path, "png", spec, OIIO::TypeDesc::UINT8, image.rgba.data());
}

} // namespace antumbra::scene
