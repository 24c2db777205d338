#include "tools/fit_ltc/rounds.h"

#include <thread>
#include <vector>

namespace antumbra::fit {

Rounds::Rounds(uint32_t threads, double workAll, std::function<void(double)> report, std::function<bool()> isInterrupted)
    : threads_(threads), workAll_(workAll), report_(std::move(report)), isInterrupted_(std::move(isInterrupted))
{
}

bool Rounds::finish(uint32_t units, double workOfUnit, const std::function<void(uint32_t)>& work)
{
    std::atomic<uint32_t> next{0};
    const auto workNext = [&] {
        const uint32_t unit = next.fetch_add(1);
        if (unit < units)
            work(unit);
        return unit < units;
    };
    {
        std::vector<std::jthread> others;
        for (uint32_t i = 1; i < threads_; ++i)
            others.emplace_back([&] {
                while (!isOver_ && workNext()) {
                }
            });
        do {
            isOver_ = isOver_ || (isInterrupted_ && isInterrupted_());
            if (report_)
                report_((workDone_ + std::min(next.load(), units) * workOfUnit) / workAll_);
        } while (!isOver_ && workNext());
    }
    workDone_ += units * workOfUnit;
    return !isOver_;
}

} // namespace antumbra::fit
