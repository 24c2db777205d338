#include "scene/gltf_uri.h"

#include "base/error.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sys/stat.h>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

std::string textOf(const std::vector<std::byte>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// A folder with one file in it, and a secret beside the folder.
class GltfUri : public testing::Test
{
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(root_ / "home/deep");
        writeText(root_ / "secret.bin", "secret");
        writeText(root_ / "home/a b#1.bin", "mine");
        writeText(root_ / "home/deep/c.bin", "deep");
        std::filesystem::create_symlink(root_ / "secret.bin", root_ / "home/link.bin");
        std::filesystem::create_directory_symlink(root_.path(), root_ / "home/up");
        std::filesystem::create_symlink(root_ / "home/deep/c.bin", root_ / "home/inside.bin");
        mkfifo((root_ / "home/pipe").c_str(), 0600);
    }

    std::string read(const std::string& uri) const { return textOf(readRelativeUri(root_ / "home", uri, 100)); }
    std::string refusalOf(const std::string& uri) const
    {
        try {
            read(uri);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    TestFolder root_;
};

} // namespace

TEST_F(GltfUri, ReadsWhatLiesInTheFolder)
{
    EXPECT_EQ(read("a%20b%231.bin"), "mine");
    EXPECT_EQ(read("deep/c.bin"), "deep");
    EXPECT_EQ(read("./deep/c.bin"), "deep");
    EXPECT_EQ(read("inside.bin"), "deep");
}

TEST_F(GltfUri, RefusesWhatLeadsOut)
{
    EXPECT_NE(refusalOf("../secret.bin").find("leaves"), std::string::npos);
    EXPECT_NE(refusalOf("%2e%2e/secret.bin").find("leaves"), std::string::npos);
    EXPECT_NE(refusalOf("%2e%2e%2fsecret.bin").find("leaves"), std::string::npos);
    EXPECT_NE(refusalOf("deep/../../secret.bin").find("leaves"), std::string::npos);
    EXPECT_NE(refusalOf((root_ / "secret.bin").string()).find("absolute"), std::string::npos);
    EXPECT_NE(refusalOf("%2Fetc/passwd").find("absolute"), std::string::npos);
    EXPECT_NE(refusalOf("..%5Csecret.bin").find("character"), std::string::npos);
    EXPECT_NE(refusalOf("link.bin").find("leads out"), std::string::npos);
    EXPECT_NE(refusalOf("up/secret.bin").find("leads out"), std::string::npos);
}

TEST_F(GltfUri, RefusesWhatIsNoFile)
{
    for (const char* uri : {"", ".", "deep", "pipe", "absent.bin", "%", "%2", "%zz", "a%00b", "http://127.0.0.1:9/x.bin",
                            "file:///etc/passwd", "FILE:a", ":", "C:/x.bin"})
        EXPECT_NE(refusalOf(uri), "") << uri;
    writeText(root_ / "home/long.bin", std::string(101, 'x'));
    EXPECT_NE(refusalOf("long.bin").find("larger than the limit"), std::string::npos);
}

TEST(GltfDataUri, DecodesBase64)
{
    EXPECT_EQ(textOf(decodeDataUri("data:application/octet-stream;base64,TWFu").bytes), "Man");
    EXPECT_EQ(textOf(decodeDataUri("data:;base64,TWE=").bytes), "Ma");
    EXPECT_EQ(textOf(decodeDataUri("data:;base64,TQ==").bytes), "M");
    EXPECT_EQ(decodeDataUri("data:image/png;charset=x;base64,").mediaType, "image/png");
    EXPECT_TRUE(decodeDataUri("data:;base64,").bytes.empty());
    EXPECT_EQ(decodeDataUri("data:;base64,//+/").bytes[0], std::byte{0xff});
}

TEST(GltfDataUri, RefusesBrokenData)
{
    for (const char* uri : {"data:", "data:text/plain,abc", "data:;base64,AAA", "data:;base64,@@@@",
                            "data:;base64,====", "data:;base64,A=AA", "data:;base64,AAA\n", "data:;base64,TQ==TQ=="})
        EXPECT_THROW(decodeDataUri(uri), Error) << uri;
}
