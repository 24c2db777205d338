#include "tools/bake/processes.h"

#include "base/error.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <thread>

namespace antumbra::baking {

namespace {

using bake::Bytes;
using Clock = std::chrono::steady_clock;

// mpirun kills a second after it has told processes to end.
constexpr std::chrono::milliseconds kPatience{600};

const std::string kGone = "another process is gone, and the others end; --resume goes on from what is kept: ";

void demand(int result)
{
    if (result == MPI_SUCCESS)
        return;
    char reason[MPI_MAX_ERROR_STRING];
    int length = 0;
    MPI_Error_string(result, reason, &length);
    throw Error(kGone + std::string(reason, static_cast<size_t>(length)), "mpirun", ExitCode::CheckFailed);
}

/// Sleeps between looks: MPI itself would spin, on cores that the others bake with.
void await(MPI_Request request, const std::function<bool()>& isInterrupted)
{
    std::optional<Clock::time_point> toldToEnd;
    for (int isDone = 0; !isDone;) {
        demand(MPI_Test(&request, &isDone, MPI_STATUS_IGNORE));
        if (isDone)
            return;
        if (isInterrupted() && !toldToEnd)
            toldToEnd = Clock::now();
        if (toldToEnd && Clock::now() - *toldToEnd > kPatience)
            throw Error(kGone + "it no longer answers", "mpirun", ExitCode::CheckFailed);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

std::vector<Bytes> exchangeAll(const Bytes& mine, int count, const std::function<bool()>& isInterrupted)
{
    if (mine.size() > static_cast<size_t>(std::numeric_limits<int>::max() / count))
        throw Error("more bytes at once than MPI sends", "mpirun");
    const int size = static_cast<int>(mine.size());
    std::vector<int> sizes(static_cast<size_t>(count)), starts(sizes.size());
    MPI_Request request;
    demand(MPI_Iallgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD, &request));
    await(request, isInterrupted);
    std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
    Bytes bytes(static_cast<size_t>(starts.back() + sizes.back()));
    demand(MPI_Iallgatherv(mine.data(), size, MPI_BYTE, bytes.data(), sizes.data(), starts.data(), MPI_BYTE, MPI_COMM_WORLD, &request));
    // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): await() asks until it is done, unseen by the checker
    await(request, isInterrupted);
    std::vector<Bytes> all;
    for (size_t i = 0; i < sizes.size(); ++i)
        all.emplace_back(bytes.begin() + starts[i], bytes.begin() + starts[i] + sizes[i]);
    return all;
}

uint32_t fromEnvironment(const char* name)
{
    const char* text = std::getenv(name);
    return text != nullptr ? static_cast<uint32_t>(std::max(std::atoi(text), 0)) : 0;
}

} // namespace

Processes::Processes() : isJoined_(fromEnvironment("OMPI_COMM_WORLD_SIZE") > 0)
{
    if (!isJoined_)
        return;
    int threads = 0, rank = 0, count = 1;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    rank_ = static_cast<uint32_t>(rank);
    count_ = static_cast<uint32_t>(count);
    countHere_ = std::max(fromEnvironment("OMPI_COMM_WORLD_LOCAL_SIZE"), 1u);
}

Processes::~Processes()
{
    if (isJoined_)
        MPI_Finalize();
}

bake::Peers Processes::peers(std::function<bool()> isInterrupted) const
{
    bake::Peers peers{.rank = rank_, .count = count_};
    if (count_ > 1)
        peers.exchange = [count = static_cast<int>(count_), isInterrupted = std::move(isInterrupted)](const Bytes& mine) {
            return exchangeAll(mine, count, isInterrupted);
        };
    return peers;
}

void Processes::abort(int exitCode) const
{
    if (isJoined_)
        MPI_Abort(MPI_COMM_WORLD, exitCode);
    std::_Exit(exitCode);
}

} // namespace antumbra::baking
