// The command line of the baker, read and checked into plain data.
#pragma once

#include "base/file.h"
#include "scene/scene_file.h"

#include <optional>
#include <string>

namespace antumbra::baking {

struct Options
{
    std::string scene;
    Path output;
    scene::Settings settings;          // knobs, over the scene file's
    uint32_t threads = 0;              // of each process; 0: all of the machine
    std::optional<uint64_t> mostBytes; // of memory
    bool isResumed = false;
};

/// Nothing where help was asked for and given. Throws Error of one line that names the option.
std::optional<Options> parse(int argc, char** argv);

} // namespace antumbra::baking
