// The processes of a bake that mpirun started, through MPI. A program that was started by itself never touches it.
#pragma once

#include "bake/peers.h"

#include <functional>

namespace antumbra::baking {

class Processes
{
public:
    /// Joins the others where mpirun started this one; else it is alone.
    Processes();
    /// All must come here, unless abort() was called.
    ~Processes();
    Processes(const Processes&) = delete;
    Processes& operator=(const Processes&) = delete;

    [[nodiscard]] uint32_t rank() const { return rank_; }
    [[nodiscard]] uint32_t count() const { return count_; }
    /// How many of them share this machine.
    [[nodiscard]] uint32_t countHere() const { return countHere_; }

    /// `isInterrupted` is asked while the others are awaited: who is told to end and hears nothing from them any more throws Error.
    [[nodiscard]] bake::Peers peers(std::function<bool()> isInterrupted) const;

    /// Ends all of them with this exit code.
    [[noreturn]] void abort(int exitCode) const;

private:
    bool isJoined_;
    uint32_t rank_ = 0;
    uint32_t count_ = 1;
    uint32_t countHere_ = 1;
};

} // namespace antumbra::baking
