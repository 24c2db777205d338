// A folder for the files of a test: new and empty, and gone with this.
#pragma once

#include "base/check.h"
#include "base/file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace antumbra {

class TestFolder
{
public:
    TestFolder()
    {
        std::string name = testing::TempDir() + "antumbra_test_" + std::string(6, 'X'); // letters for mkdtemp to replace
        check(mkdtemp(name.data()) != nullptr, "a folder for the test's files");
        path_ = name;
    }
    ~TestFolder()
    {
        std::error_code ignored; // what cannot be removed stays; a destructor does not throw
        std::filesystem::remove_all(path_, ignored);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    [[nodiscard]] const Path& path() const { return path_; }
    [[nodiscard]] Path operator/(std::string_view name) const { return path_ / name; }

private:
    Path path_;
};

} // namespace antumbra
