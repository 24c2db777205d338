// A folder for the files of a test: new and empty, and gone with this.
#pragma once

#include "base/check.h"
#include "base/file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace antumbra {

class TestFolder
{
public:
    TestFolder()
    {
        std::string name = testing::TempDir() + "antumbra_test_XXXXXX";
        check(mkdtemp(name.data()) != nullptr, "a folder for the test's files");
        path_ = name;
    }
    ~TestFolder() { std::filesystem::remove_all(path_); }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    [[nodiscard]] const Path& path() const { return path_; }
    [[nodiscard]] Path operator/(std::string_view name) const { return path_ / name; }

private:
    Path path_;
};

} // namespace antumbra
