// The command line of the fit, read and checked into plain data.
#pragma once

#include "base/file.h"

#include <optional>

namespace antumbra::fit {

struct Options
{
    Path folder;  // of the tables
    Path compare; // another table of matrices; empty: none
    uint32_t size = 64;
    uint32_t threads = 0; // 0: all of the machine
    bool isCheck = false;
};

/// Nothing where help was asked for and given. Throws Error of one line that names the option.
std::optional<Options> parse(int argc, char** argv);

} // namespace antumbra::fit
