// Ctrl-C as a question that loops ask: what is under way is finished and written before the program ends.
#pragma once

namespace antumbra::app {

/// While one lives, SIGINT and SIGTERM only set the flag; the second signal ends the program as usual.
class InterruptGuard
{
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] bool isInterrupted() const;
};

} // namespace antumbra::app
