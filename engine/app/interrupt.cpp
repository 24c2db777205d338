#include "app/interrupt.h"

#include <csignal>

namespace antumbra::app {

namespace {

volatile std::sig_atomic_t gIsInterrupted = 0; // a signal handler reaches nothing else

void onSignal(int signal)
{
    gIsInterrupted = 1;
    std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard()
{
    gIsInterrupted = 0;
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
}

InterruptGuard::~InterruptGuard()
{
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::isInterrupted() const { return gIsInterrupted != 0; }

} // namespace antumbra::app
