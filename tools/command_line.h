// What the command lines of the tools share.
#pragma once

#include "base/error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace antumbra::tools {

/// False where help was asked for, which is printed. Throws Error, with the tool's name, for what is not understood.
inline bool parse(CLI::App& arguments, int argc, char** argv)
{
    try {
        arguments.parse(argc, argv);
        return true;
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", arguments.help());
        return false;
    } catch (const CLI::ParseError& error) {
        throw Error(error.what(), arguments.get_name());
    }
}

} // namespace antumbra::tools
