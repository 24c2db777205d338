// The time that something takes, by the host's clock.
#pragma once

#include <chrono>

namespace antumbra::lab {

template <class Work>
double millisecondsOf(Work&& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace antumbra::lab
