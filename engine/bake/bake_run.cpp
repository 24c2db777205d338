#include "bake/bake_run.h"

#include "base/check.h"
#include "base/error.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace antumbra::bake {

namespace {

// Some ten milliseconds of a thread: so long may an interruption take.
constexpr uint32_t kRaysPerTile = 1 << 16;
constexpr uint32_t kMostUnitsPerTile = 1024;
// Processes wait for the slowest at the end of a round, and what they did in it is lost where one dies. Towards the end of a pass, where
// what is left may be dealt unevenly for the speeds of processes, each round is half of what is left.
constexpr std::chrono::duration<double> kLongestRound{2}, kShortestRound{0.05};
constexpr std::chrono::milliseconds kReportInterval{250};

constexpr std::byte kGoesOn{0};
constexpr std::byte kInterrupted{1};

uint32_t unitsPerTile(const Pass& pass) { return std::clamp(kRaysPerTile / pass.raysPerUnit, 1u, kMostUnitsPerTile); }

/// What a tile's units have in `values`.
template <class Value>
std::span<Value> partOf(std::vector<Value>& values, Range range, uint32_t units)
{
    const size_t perUnit = values.size() / units;
    return std::span(values).subspan(range.first * perUnit, range.count * perUnit);
}

uint64_t raysOf(const Pass& pass, uint32_t tile) { return uint64_t{pass.rangeOf(tile).count} * pass.raysPerUnit; }

} // namespace

uint32_t Pass::tileCount() const { return (units + unitsPerTile(*this) - 1) / unitsPerTile(*this); }

Range Pass::rangeOf(uint32_t tile) const
{
    const uint32_t first = tile * unitsPerTile(*this);
    return {first, std::min(unitsPerTile(*this), units - first)};
}

BakeRun::BakeRun(const BakeJob& job, uint64_t sceneHash, const BakeSettings& settings, uint64_t raysAll)
    : job_(job), threads_(job.threads != 0 ? job.threads : std::max(std::thread::hardware_concurrency(), 1u)), raysAll_(raysAll)
{
    if (job.peers.rank == 0 && !job.partial.empty())
        partial_ =
            job.isResumed ? PartialFile::resumed(job.partial, sceneHash, settings) : PartialFile::started(job.partial, sceneHash, settings);
}

bool BakeRun::finish(const Pass& pass)
{
    isDone_.assign(pass.tileCount(), 0);
    if (job_.isResumed)
        restore(pass);
    while (std::ranges::count(isDone_, 0) > 0) {
        const std::vector<uint32_t> share = shareOf(pass);
        const size_t finished = gather(pass, share);
        if (!exchange(pass, std::span(share).first(finished)))
            return false;
    }
    ++index_;
    return true;
}

/// What the first process kept of the pass goes to all of them.
void BakeRun::restore(const Pass& pass)
{
    for (bool isMore = true; isMore;) {
        const std::vector<Bytes> told = job_.peers.exchange(partial_ ? partial_->next(index_) : Bytes{});
        isMore = !told.front().empty();
        apply(pass, told.front());
    }
    for (uint32_t tile = 0; tile < isDone_.size(); ++tile)
        raysRestored_ += isDone_[tile] ? raysOf(pass, tile) : 0;
}

void BakeRun::apply(const Pass& pass, std::span<const std::byte> records)
{
    const std::string subject = job_.partial.string();
    while (!records.empty()) {
        const std::optional<TakenRecord> taken = takeRecord(records, subject);
        check(taken.has_value(), "whole records");
        const TileRecord& record = taken->record;
        if (record.pass != index_ || record.tile >= isDone_.size())
            throw Error("damaged: a record of a tile that the bake does not have", subject);
        const Range range = pass.rangeOf(record.tile);
        const std::span values = std::as_writable_bytes(partOf(*pass.values, range, pass.units));
        const std::span flags = std::as_writable_bytes(partOf(*pass.flags, range, pass.units));
        if (record.values.size() != values.size() || record.flags.size() != flags.size())
            throw Error("damaged: a record of another size than its tile", subject);
        std::ranges::copy(record.values, values.begin());
        std::ranges::copy(record.flags, flags.begin());
        raysDone_ += isDone_[record.tile] ? 0 : raysOf(pass, record.tile);
        isDone_[record.tile] = 1;
        records = records.subspan(taken->size);
    }
}

/// Every process knows what all have done, so that nobody needs to be told who does what next.
std::vector<uint32_t> BakeRun::shareOf(const Pass& pass) const
{
    std::vector<uint32_t> share;
    uint32_t next = 0;
    for (uint32_t tile = 0; tile < pass.tileCount(); ++tile)
        if (!isDone_[tile] && next++ % job_.peers.count == job_.peers.rank)
            share.push_back(tile);
    return share;
}

/// Returns how many of `tiles`, from the first on, are done when the round is over.
size_t BakeRun::gather(const Pass& pass, std::span<const uint32_t> tiles)
{
    std::atomic<size_t> next{0};
    std::atomic<bool> isOver{false};
    const auto gatherNext = [&] {
        const size_t i = next.fetch_add(1);
        if (i < tiles.size())
            pass.gather(pass.rangeOf(tiles[i]));
        return i < tiles.size();
    };
    roundEnd_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(roundOf(pass));
    {
        std::vector<std::jthread> others;
        for (uint32_t i = 1; i < std::min<size_t>(threads_, tiles.size()); ++i)
            others.emplace_back([&] {
                while (!isOver && gatherNext()) {
                }
            });
        do {
            isOver = isRoundOver();
            report(pass, std::min(next.load(), tiles.size()) * raysOf(pass, 0));
        } while (!isOver && gatherNext());
    }
    return std::min(next.load(), tiles.size());
}

BakeRun::Seconds BakeRun::roundOf(const Pass& pass) const
{
    const double rate = raysPerSecond(raysDone_);
    if (job_.peers.count == 1 || rate == 0)
        return kLongestRound;
    uint64_t raysLeft = 0;
    for (uint32_t tile = 0; tile < pass.tileCount(); ++tile)
        raysLeft += isDone_[tile] ? 0 : raysOf(pass, tile);
    return std::clamp(Seconds(static_cast<double>(raysLeft) / rate / 2), kShortestRound, kLongestRound);
}

double BakeRun::raysPerSecond(uint64_t raysDone) const
{
    return static_cast<double>(raysDone - raysRestored_) / Seconds(Clock::now() - started_).count();
}

bool BakeRun::isRoundOver()
{
    isInterrupted_ = isInterrupted_ || (job_.isInterrupted && job_.isInterrupted());
    return isInterrupted_ || Clock::now() >= roundEnd_;
}

/// Everyone tells what they finished; false where somebody was interrupted.
bool BakeRun::exchange(const Pass& pass, std::span<const uint32_t> finished)
{
    Bytes mine{isInterrupted_ ? kInterrupted : kGoesOn};
    for (const uint32_t tile : finished) {
        const Range range = pass.rangeOf(tile);
        appendRecord(mine, {.pass = index_,
                            .tile = tile,
                            .values = std::as_bytes(partOf(*pass.values, range, pass.units)),
                            .flags = std::as_bytes(partOf(*pass.flags, range, pass.units))});
    }
    const std::vector<Bytes> told = job_.peers.exchange(std::move(mine));
    for (const Bytes& bytes : told) {
        const auto records = std::span(bytes).subspan(1);
        if (partial_)
            partial_->append(records);
        apply(pass, records);
    }
    return std::ranges::none_of(told, [](const Bytes& bytes) { return bytes.front() == kInterrupted; });
}

void BakeRun::report(const Pass& pass, uint64_t raysOfRound)
{
    const auto now = Clock::now();
    if (!job_.report || job_.peers.rank != 0 || now - reported_ < kReportInterval)
        return;
    reported_ = now;
    // The others are about as far as this one.
    const uint64_t raysDone = std::min(raysDone_ + raysOfRound * job_.peers.count, raysAll_);
    const double rate = raysPerSecond(raysDone);
    job_.report({.stage = pass.stage,
                 .raysDone = raysDone,
                 .raysAll = raysAll_,
                 .raysPerSecond = rate,
                 .secondsLeft = rate > 0 ? static_cast<double>(raysAll_ - raysDone) / rate : 0});
}

} // namespace antumbra::bake
