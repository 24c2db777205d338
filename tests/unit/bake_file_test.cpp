#include "bake/bake_file.h"

#include "base/error.h"
#include "scene/images.h"
#include "unit/test_folder.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>

namespace antumbra::bake {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr uint16_t kNaN = 0x7e00, kInfinity = 0x7c00;

/// Finite half floats of all sizes and both signs.
std::vector<uint16_t> randomHalves(size_t count, uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<uint16_t> halves(count);
    for (uint16_t& half : halves)
        half = static_cast<uint16_t>(random() % 0x7c00 | (random() & 0x8000));
    return halves;
}

Bake randomBake()
{
    Bake bake{
        .settings = {.bands = 2, .bounces = 1, .raysPerTexel = 100, .texelsPerMetre = 3.1f, .cellMetres = 0.7f},
        .sceneHash = 0xfedcba9876543210u,
        .atlas = {.extent = {37, 70}, .planes = {}},
        .volume = {.grid = {.origin = {-1.5f, 0.1f, 7}, .spacing = {0.7f, 0.6f, 0.5f}, .count = {4, 3, 5}}, .planes = {}, .isOpen = {}}};
    const uint32_t coefficients = bake.settings.coefficientCount(), cells = bake.volume.grid.cellCount();
    bake.atlas.planes = randomHalves(size_t{37} * 70 * 3 * coefficients, 1);
    bake.volume.planes = randomHalves(size_t{cells} * kLocalCoefficients * 3 * coefficients, 2);
    for (uint32_t cell = 0; cell < cells; ++cell)
        bake.volume.isOpen.push_back(cell % 3 != 0);
    return bake;
}

void expectEqual(const Bake& a, const Bake& b)
{
    EXPECT_EQ(a.settings, b.settings);
    EXPECT_EQ(a.sceneHash, b.sceneHash);
    EXPECT_EQ(a.atlas.extent, b.atlas.extent);
    EXPECT_EQ(a.atlas.planes, b.atlas.planes);
    EXPECT_EQ(a.volume.grid.origin, b.volume.grid.origin);
    EXPECT_EQ(a.volume.grid.spacing, b.volume.grid.spacing);
    EXPECT_EQ(a.volume.grid.count, b.volume.grid.count);
    EXPECT_EQ(a.volume.planes, b.volume.planes);
    EXPECT_EQ(a.volume.isOpen, b.volume.isOpen);
}

class BakeFileTest : public testing::Test
{
protected:
    /// What loading says is wrong; empty where nothing is.
    std::string complaint() const
    {
        try {
            loadBake(file_);
            return "";
        } catch (const Error& error) {
            EXPECT_EQ(error.which, file_.string());
            EXPECT_EQ(error.code, ExitCode::BadInput);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
            return error.what();
        }
    }

    struct Part
    {
        OIIO::ImageSpec spec;
        std::vector<uint16_t> pixels;
    };

    /// Writes the file again, as any other program would, with its parts changed.
    void rewrite(const std::function<void(std::vector<Part>&)>& change) const
    {
        std::vector<Part> parts(2);
        const auto input = OIIO::ImageInput::open(file_.string());
        for (int i = 0; i < 2; ++i) {
            Part& part = parts[static_cast<size_t>(i)];
            part.spec = input->spec(i);
            part.pixels.resize(part.spec.image_pixels() * static_cast<size_t>(part.spec.nchannels));
            ASSERT_TRUE(input->read_image(i, 0, 0, part.spec.nchannels, OIIO::TypeDesc::HALF, part.pixels.data()));
        }
        change(parts);
        std::vector<OIIO::ImageSpec> specs;
        for (const Part& part : parts)
            specs.push_back(part.spec);
        const auto output = OIIO::ImageOutput::create("openexr");
        ASSERT_TRUE(output->open(file_.string(), static_cast<int>(specs.size()), specs.data())) << output->geterror();
        for (size_t i = 0; i < parts.size(); ++i) {
            ASSERT_TRUE(i == 0 || output->open(file_.string(), specs[i], OIIO::ImageOutput::AppendSubimage)) << output->geterror();
            ASSERT_TRUE(output->write_image(OIIO::TypeDesc::HALF, parts[i].pixels.data())) << output->geterror();
        }
    }

    TestFolder folder_;
    Path file_ = folder_ / "room.exr";
};

TEST_F(BakeFileTest, ComesBackToTheByte)
{
    const Bake bake = randomBake();
    saveBake(file_, bake);
    expectEqual(loadBake(file_), bake);
}

TEST_F(BakeFileTest, EqualBakesGiveEqualFilesAndNothingElse)
{
    saveBake(file_, randomBake());
    saveBake(folder_ / "again.exr", randomBake());
    EXPECT_EQ(readFile(file_), readFile(folder_ / "again.exr"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 2) << "what was written beside is gone";
}

TEST_F(BakeFileTest, AnyToolReadsItsChannels)
{
    const Bake bake = randomBake();
    saveBake(file_, bake);
    const auto input = OIIO::ImageInput::open(file_.string());
    ASSERT_TRUE(input);
    const OIIO::ImageSpec transfer = input->spec(0), volume = input->spec(1);
    EXPECT_EQ(transfer.channelnames[4], "T01.G");
    EXPECT_EQ(transfer.get_float_attribute("antumbra:prt.bounces"), 1);
    EXPECT_EQ(volume.width, 4);
    EXPECT_EQ(volume.height, 15);
    const auto place = std::ranges::find(volume.channelnames, "M24_03.B") - volume.channelnames.begin();
    ASSERT_LT(place, volume.nchannels);
    std::vector<uint16_t> pixels(volume.image_pixels());
    ASSERT_TRUE(input->read_image(1, 0, static_cast<int>(place), static_cast<int>(place) + 1, OIIO::TypeDesc::HALF, pixels.data()));
    EXPECT_EQ(pixels.back(), bake.volume.planes.back()) << "the last plane's last cell";
}

TEST_F(BakeFileTest, AMissingFileOrAFolderIsRefused)
{
    EXPECT_THAT(complaint(), HasSubstr("no such file"));
    std::filesystem::create_directory(file_);
    EXPECT_THAT(complaint(), HasSubstr("not a regular file"));
}

TEST_F(BakeFileTest, WhatIsNoBakeIsRefused)
{
    writeText(file_, "");
    EXPECT_THAT(complaint(), HasSubstr("not an OpenEXR file"));
    writeText(file_, "{\"bake\": true}");
    EXPECT_THAT(complaint(), HasSubstr("not an OpenEXR file"));
    scene::saveExr(file_, {.width = 4, .height = 4, .channels = 3, .values = std::vector<float>(48, 1.0f)});
    EXPECT_THAT(complaint(), HasSubstr("no bake"));
}

TEST_F(BakeFileTest, EveryTruncationIsRefused)
{
    saveBake(file_, randomBake());
    const std::vector<std::byte> whole = readFile(file_);
    for (size_t size = 0; size < whole.size(); size += size < 4096 ? 61 : 499) {
        writeFile(file_, std::span(whole).first(size));
        EXPECT_THAT(complaint(), AnyOf(HasSubstr("cut short"), HasSubstr("not an OpenEXR"), HasSubstr("damaged"))) << size;
    }
    writeFile(file_, std::span(whole).first(whole.size() - 1));
    EXPECT_NE(complaint(), "");
}

TEST_F(BakeFileTest, AFlippedByteIsRefusedOrChangesNothing)
{
    const Bake bake = randomBake();
    saveBake(file_, bake);
    const std::vector<std::byte> whole = readFile(file_);
    int refusals = 0, flips = 0;
    for (size_t place = 0; place < whole.size(); place += place < 3000 ? 13 : 499) {
        std::vector<std::byte> flipped = whole;
        flipped[place] ^= std::byte{0x10};
        writeFile(file_, flipped);
        ++flips;
        if (complaint().empty())
            expectEqual(loadBake(file_), bake);
        else
            ++refusals;
    }
    EXPECT_GT(refusals, flips / 2);
}

TEST_F(BakeFileTest, AnotherVersionIsRefused)
{
    saveBake(file_, randomBake());
    rewrite([](std::vector<Part>& parts) { parts[0].spec["antumbra:version"] = 2; });
    EXPECT_THAT(complaint(), HasSubstr("a bake of version 2, and this program reads version 3"));
}

TEST_F(BakeFileTest, ValuesThatAreNotFiniteAreRefused)
{
    for (const uint16_t value : {kNaN, kInfinity})
        for (const size_t part : {0u, 1u}) {
            saveBake(file_, randomBake());
            rewrite([value, part](std::vector<Part>& parts) { parts[part].pixels[17] = value; });
            EXPECT_THAT(complaint(), HasSubstr("not finite"));
        }
}

TEST_F(BakeFileTest, AChangedValueOrSettingIsRefused)
{
    saveBake(file_, randomBake());
    rewrite([](std::vector<Part>& parts) { parts[0].pixels[5] ^= 1; });
    EXPECT_THAT(complaint(), HasSubstr("checksum"));
    saveBake(file_, randomBake());
    rewrite([](std::vector<Part>& parts) { parts[0].spec["antumbra:prt.bounces"] = 3.0f; });
    EXPECT_THAT(complaint(), HasSubstr("checksum"));
}

TEST_F(BakeFileTest, PartsThatDoNotAgreeWithTheSettingsAreRefused)
{
    const auto complaintOf = [&](const char* attribute, auto value) {
        saveBake(file_, randomBake());
        rewrite([&](std::vector<Part>& parts) { parts[0].spec[attribute] = value; });
        return complaint();
    };
    EXPECT_THAT(complaintOf("antumbra:prt.bands", 3.0f), HasSubstr("12 channels and not 27"));
    EXPECT_THAT(complaintOf("antumbra:prt.bands", 6.0f), HasSubstr("out of range"));
    EXPECT_THAT(complaintOf("antumbra:prt.bands", 2.5f), HasSubstr("out of range"));
    EXPECT_THAT(complaintOf("antumbra:prt.density", std::nanf("")), HasSubstr("out of range"));
    EXPECT_THAT(complaintOf("antumbra:scene", "not hexadecimal"), HasSubstr("antumbra:scene"));

    const auto complaintOfCount = [&](glm::ivec3 count) {
        saveBake(file_, randomBake());
        rewrite([&](std::vector<Part>& parts) {
            parts[0].spec.attribute("antumbra:grid_count", OIIO::TypeDesc(OIIO::TypeDesc::INT, OIIO::TypeDesc::VEC3), &count);
        });
        return complaint();
    };
    EXPECT_THAT(complaintOfCount({4, 5, 4}), HasSubstr("not of the size"));
    EXPECT_THAT(complaintOfCount({4, 0, 5}), HasSubstr("makes no sense"));
    EXPECT_THAT(complaintOfCount({-4, 3, 5}), HasSubstr("makes no sense"));
}

TEST_F(BakeFileTest, AFileThatSaysToBeHugeTakesNoMemory)
{
    // A header is all that there is of it.
    std::vector<OIIO::ImageSpec> specs;
    {
        saveBake(file_, randomBake());
        const auto input = OIIO::ImageInput::open(file_.string());
        specs = {input->spec(0), input->spec(1)};
    }
    for (OIIO::ImageSpec& spec : specs)
        spec.full_width = spec.full_height = spec.width = spec.height = 16000;
    const auto output = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(output->open(file_.string(), 2, specs.data())) << output->geterror();
    output->close();
    EXPECT_THAT(complaint(), AnyOf(HasSubstr("more than a GiB"), HasSubstr("cut short")));
}

TEST_F(BakeFileTest, SavingReplacesAtOnceOrNotAtAll)
{
    saveBake(file_, randomBake());
    Bake broken = randomBake();
    broken.atlas.planes[3] = kNaN;
    EXPECT_THROW(saveBake(file_, broken), Error);
    expectEqual(loadBake(file_), randomBake());
    EXPECT_THROW(saveBake("/proc/no_such_folder/room.exr", randomBake()), Error);
}

TEST(Staleness, SaysWhatDiffers)
{
    const Bake bake = randomBake();
    EXPECT_THAT(staleness(bake, bake.sceneHash, bake.settings), IsEmpty());
    EXPECT_EQ(staleness(bake, 1, bake.settings), "made of another scene");
    BakeSettings wanted = bake.settings;
    wanted.bounces = 4;
    wanted.cellMetres = 0.5f;
    EXPECT_EQ(staleness(bake, bake.sceneHash, wanted), "made with other settings: prt.bounces is 1 and not 4, prt.cell is 0.7 and not 0.5");
}

TEST(BakePath, LiesUnderAssetsForItsScenesAndElseBesideTheScene)
{
    const Path assets = projectPath("assets");
    EXPECT_EQ(bakePathOf("plaza"), assets / "bakes/plaza.exr");
    EXPECT_EQ(bakePathOf(assets / "scenes/plaza.json"), assets / "bakes/plaza.exr");
    EXPECT_EQ(bakePathOf("/somewhere/room.json"), "/somewhere/room.bake.exr");
    EXPECT_EQ(bakePathOf("room.glb"), "room.bake.exr");
}

} // namespace
} // namespace antumbra::bake
