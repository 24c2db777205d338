// Another program, started and ended by a test. It never outlives the object.
#pragma once

#include "base/file.h"

#include <optional>
#include <sys/types.h>

namespace antumbra::test {

/// $PATH has a program of that name.
bool isInstalled(const std::string& program);

class Process
{
public:
    struct Variable
    {
        std::string name;
        std::string value;
    };

    /// Found through $PATH where `command[0]` has no slash. What it prints, to stdout and stderr, goes to the file `output`.
    Process(const std::vector<std::string>& command, const std::vector<Variable>& environment, const Path& output);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// The exit code, -1 for a program that was killed; nothing where it still runs after `seconds`.
    std::optional<int> wait(double seconds);

private:
    pid_t id_ = 0;
};

} // namespace antumbra::test
