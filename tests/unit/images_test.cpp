#include "scene/images.h"

#include "base/error.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

Path temporary(const std::string& name)
{
    static const TestFolder folder;
    return folder / name;
}

Image8 checkered(uint32_t width, uint32_t height)
{
    Image8 image{width, height, {}};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (const uint32_t value : {x * 20, y * 30, (x + y) * 10, 255 - x * 15})
                image.rgba.push_back(static_cast<uint8_t>(value));
    return image;
}

ImageF ramp(uint32_t channels)
{
    ImageF image{5, 3, channels, {}};
    for (uint32_t i = 0; i < 15 * channels; ++i)
        image.values.push_back(0.37f * static_cast<float>(i));
    return image;
}

std::vector<std::byte> pngOf(const Image8& image)
{
    const Path path = temporary("bytes.png");
    savePng(path, image);
    return readFile(path);
}

uint32_t crcOf(std::span<const std::byte> bytes)
{
    uint32_t crc = ~0u;
    for (const std::byte byte : bytes) {
        crc ^= std::to_integer<uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

void putBigEndian(std::span<std::byte> to, uint32_t value)
{
    for (size_t i = 0; i < 4; ++i)
        to[i] = static_cast<std::byte>(value >> (24 - 8 * i) & 0xff);
}

std::string complaintOf(auto&& action)
{
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(Images, PngKeepsEveryByte)
{
    const Image8 image = checkered(7, 5);
    const Image8 decoded = decodeImage8(pngOf(image), "memory");
    EXPECT_EQ(decoded.width, 7u);
    EXPECT_EQ(decoded.height, 5u);
    EXPECT_EQ(decoded.rgba, image.rgba);
}

TEST(Images, ExrKeepsEveryFloat)
{
    for (const uint32_t channels : {1u, 3u, 4u}) {
        ImageF image = ramp(channels);
        image.values[1] = 1e30f;
        image.values[2] = -2.5f;
        saveExr(temporary("float.exr"), image);
        const ImageF loaded = loadImageF(temporary("float.exr"));
        EXPECT_EQ(loaded.channels, channels);
        EXPECT_EQ(loaded.values, image.values);
    }
}

TEST(Images, RadianceIsScrubbed)
{
    ImageF image = ramp(4);
    image.values[0] = std::numeric_limits<float>::quiet_NaN();
    image.values[5] = std::numeric_limits<float>::infinity();
    image.values[10] = -1;
    saveExr(temporary("broken.exr"), image);
    const ImageF radiance = loadRadiance(temporary("broken.exr"));
    ASSERT_EQ(radiance.channels, 3u);
    ASSERT_EQ(radiance.values.size(), 45u);
    EXPECT_EQ(radiance.values[0], 0);
    EXPECT_EQ(radiance.values[3], image.values[4]);
    EXPECT_EQ(radiance.values[4], 0);
    EXPECT_EQ(radiance.values[8], 0);
    EXPECT_EQ(radiance.values[44], image.values[58]);
}

TEST(Images, RadianceRefusesOtherFormats)
{
    savePng(temporary("plain.png"), checkered(2, 2));
    EXPECT_NE(complaintOf([] { loadRadiance(temporary("plain.png")); }).find("must be .hdr or .exr"), std::string::npos);
    saveExr(temporary("grey.exr"), ramp(1));
    EXPECT_NE(complaintOf([] { loadRadiance(temporary("grey.exr")); }).find("three channels"), std::string::npos);
    EXPECT_NE(complaintOf([] { loadRadiance(temporary("absent.exr")); }).find("no such file"), std::string::npos);
    EXPECT_NE(complaintOf([] { loadRadiance("/dev/zero"); }).find("not a regular file"), std::string::npos);
    writeText(temporary("empty.hdr"), "");
    EXPECT_FALSE(complaintOf([] { loadRadiance(temporary("empty.hdr")); }).empty());
}

TEST(Images, HugePicturesAreRefusedFromTheirHeader)
{
    std::vector<std::byte> png = pngOf(checkered(2, 2));
    const auto expectRefused = [&](uint32_t width, uint32_t height, const std::string& reason) {
        putBigEndian(std::span(png).subspan(16, 4), width);
        putBigEndian(std::span(png).subspan(20, 4), height);
        putBigEndian(std::span(png).subspan(29, 4), crcOf(std::span(png).subspan(12, 17)));
        const std::string complaint = complaintOf([&] { decodeImage8(png, "huge"); });
        EXPECT_NE(complaint.find(reason), std::string::npos) << complaint;
    };
    expectRefused(17000, 2, "16384 pixels");
    expectRefused(2, 17000, "16384 pixels");
    expectRefused(16000, 16000, "512 MiB");
}

TEST(Images, BrokenPicturesEndInOneLine)
{
    const std::vector<std::byte> whole = pngOf(checkered(32, 32));
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        std::vector<std::byte> broken = whole;
        if (round % 3 == 0)
            broken.resize(random() % whole.size());
        for (int i = 0; i < 4 && !broken.empty(); ++i)
            broken[random() % broken.size()] = static_cast<std::byte>(random());
        const std::string complaint = complaintOf([&] { decodeImage8(broken, "broken"); });
        EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
    }
    EXPECT_FALSE(complaintOf([&] { decodeImage8(std::span(whole).first(whole.size() / 2), "half"); }).empty());
    EXPECT_FALSE(complaintOf([] { decodeImage8({}, "nothing"); }).empty());
}

TEST(Images, EnvironmentsOfTheFieldLoad)
{
    const Path folder = Path(ANTUMBRA_SHARED_DIR) / "assets/environments";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "no " << folder;
    int loaded = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".hdr" && extension != ".exr")
            continue;
        const ImageF radiance = loadRadiance(entry.path());
        EXPECT_EQ(radiance.width, 2 * radiance.height) << entry.path();
        EXPECT_GT(*std::max_element(radiance.values.begin(), radiance.values.end()), 0.1f) << entry.path();
        ++loaded;
    }
    EXPECT_GT(loaded, 0);
}

TEST(Images, TruncatedRadianceIsRefused)
{
    const Path source = Path(ANTUMBRA_SHARED_DIR) / "assets/environments/blender_studio.hdr";
    if (!std::filesystem::exists(source))
        GTEST_SKIP() << "no " << source;
    std::vector<std::byte> bytes = readFile(source);
    bytes.resize(bytes.size() / 2);
    writeFile(temporary("half.hdr"), bytes);
    EXPECT_FALSE(complaintOf([] { loadRadiance(temporary("half.hdr")); }).empty());
}
