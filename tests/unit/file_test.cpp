#include "base/file.h"

#include "base/error.h"
#include "unit/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sys/stat.h>

namespace antumbra {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class FileTest : public testing::Test
{
protected:
    [[nodiscard]] Path at(std::string_view name) const { return folder_ / name; }

    [[nodiscard]] size_t entryCount() const
    {
        return static_cast<size_t>(
            std::distance(std::filesystem::directory_iterator(folder_.path()), std::filesystem::directory_iterator{}));
    }

    TestFolder folder_;
};

std::string refusalOf(const Path& path, uint64_t greatestBytes = 1 << 20)
{
    try {
        readFile(path, greatestBytes);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::BadInput);
        EXPECT_EQ(error.which, path.string());
        EXPECT_THAT(error.what(), StartsWith(path.string()));
        return error.what();
    }
    return "accepted";
}

TEST_F(FileTest, ReadsBackWhatItWrote)
{
    std::vector<std::byte> bytes(100000);
    for (size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i * 31 + i / 256);
    writeFile(at("bytes"), bytes);
    EXPECT_EQ(readFile(at("bytes")), bytes);
}

TEST_F(FileTest, TextKeepsZerosAndLineEnds)
{
    const std::string text("one\r\n\0two\n", 10);
    writeText(at("text"), text);
    EXPECT_EQ(readText(at("text")), text);
}

TEST_F(FileTest, EmptyFileIsAFile)
{
    writeText(at("empty"), "");
    EXPECT_EQ(readText(at("empty")), "");
    EXPECT_TRUE(readFile(at("empty")).empty());
}

TEST_F(FileTest, WritingMakesMissingFolders)
{
    writeText(at("a/b/c.txt"), "deep");
    EXPECT_EQ(readText(at("a/b/c.txt")), "deep");
}

TEST_F(FileTest, WritingLeavesNothingBeside)
{
    writeText(at("once"), "first");
    writeText(at("once"), "second");
    EXPECT_EQ(entryCount(), 1u);
}

TEST_F(FileTest, AReaderOfTheOldFileKeepsItWhole)
{
    writeText(at("picture"), "old content");
    std::ifstream reader(at("picture"));
    writeText(at("picture"), "new");
    std::string seen;
    std::getline(reader, seen);
    EXPECT_EQ(seen, "old content");
    EXPECT_EQ(readText(at("picture")), "new");
}

TEST_F(FileTest, WritingOverAFolderFailsAndKeepsIt)
{
    writeText(at("folder/inside"), "kept");
    EXPECT_THROW(writeText(at("folder"), "text"), Error);
    EXPECT_EQ(readText(at("folder/inside")), "kept");
}

TEST_F(FileTest, WritingUnderAFileFailsAndKeepsIt)
{
    writeText(at("file"), "kept");
    EXPECT_THROW(writeText(at("file/inside"), "text"), Error);
    EXPECT_EQ(readText(at("file")), "kept");
}

TEST_F(FileTest, WritingRefusesWhatIsNoPlainFile)
{
    ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
    EXPECT_THROW(writeText(at("pipe"), "text"), Error);
    EXPECT_TRUE(std::filesystem::is_fifo(at("pipe")));
    EXPECT_EQ(entryCount(), 1u);
}

TEST_F(FileTest, WritingThatFailsLeavesNothingBeside)
{
    const Path tooLong = at(std::string(250, 'n') + ".part");
    EXPECT_THROW(writeText(tooLong, "text"), Error);
    EXPECT_EQ(entryCount(), 0u);
}

TEST_F(FileTest, ReadingRefusesWhatIsMissing)
{
    EXPECT_THAT(refusalOf(at("missing")), HasSubstr("no such file"));
    std::filesystem::create_symlink(at("missing"), at("dangling"));
    EXPECT_THAT(refusalOf(at("dangling")), HasSubstr("no such file"));
}

TEST_F(FileTest, ReadingRefusesAFolder) { EXPECT_THAT(refusalOf(folder_.path()), HasSubstr("not a regular file")); }

TEST_F(FileTest, ReadingRefusesADevice)
{
    EXPECT_THAT(refusalOf("/dev/zero"), HasSubstr("not a regular file"));
    std::filesystem::create_symlink("/dev/zero", at("zero"));
    EXPECT_THAT(refusalOf(at("zero")), HasSubstr("not a regular file"));
}

TEST_F(FileTest, ReadingRefusesAPipeInsteadOfWaitingForIt)
{
    ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
    EXPECT_THAT(refusalOf(at("pipe")), HasSubstr("not a regular file"));
}

TEST_F(FileTest, ReadingRefusesMoreThanTheLimit)
{
    writeText(at("ten"), "0123456789");
    EXPECT_THAT(refusalOf(at("ten"), 9), HasSubstr("larger than the limit"));
    EXPECT_EQ(readText(at("ten"), 10), "0123456789");
}

TEST(ProjectPath, FollowsTheEnvironment)
{
    const char* before = std::getenv("ANTUMBRA_ROOT");
    const std::string kept = before != nullptr ? before : "";
    setenv("ANTUMBRA_ROOT", "/elsewhere", 1);
    EXPECT_EQ(projectPath("shaders"), "/elsewhere/shaders");
    unsetenv("ANTUMBRA_ROOT");
    EXPECT_EQ(projectPath("shaders"), Path(ANTUMBRA_SOURCE_ROOT) / "shaders");
    if (before != nullptr)
        setenv("ANTUMBRA_ROOT", kept.c_str(), 1);
}

} // namespace
} // namespace antumbra
