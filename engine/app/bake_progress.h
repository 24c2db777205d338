// How far a bake is, on stderr: a bar that is drawn over itself in a terminal, a line every few seconds elsewhere.
#pragma once

#include "bake/baker.h"

#include <chrono>
#include <string>

namespace antumbra::app {

class ProgressBar
{
public:
    ProgressBar();
    /// Leaves the last bar on a line of its own.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(const bake::BakeProgress& progress);

private:
    bool isTerminal_;
    bool isOpen_ = false; // a bar stands in the line
    std::chrono::steady_clock::time_point shown_{};
};

/// As in "[=====     ]  52 %  bounce 1  3.1 Mrays/s  1:07 left".
std::string describe(const bake::BakeProgress& progress);

} // namespace antumbra::app
