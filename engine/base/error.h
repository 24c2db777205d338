// Bad files, bad options, missing devices: thrown where they are found, caught once in main, shown as one line.
#pragma once

#include <stdexcept>
#include <string>

namespace antumbra {

/// The exit codes of every command.
enum class ExitCode : int { Done = 0, CheckFailed = 1, BadInput = 2, NoDevice = 3 };

/// What went wrong with which file, option or device; `code` is what the command exits with.
struct Error : std::runtime_error
{
    Error(const std::string& reason, std::string subject, ExitCode exitCode = ExitCode::BadInput)
        : std::runtime_error(subject.empty() ? reason : subject + ": " + reason), which(std::move(subject)), code(exitCode)
    {
    }

    std::string which;
    ExitCode code;
};

} // namespace antumbra
