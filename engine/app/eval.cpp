#include "app/eval.h"

#include "app/commands.h"

#include <fmt/format.h>

#include <cmath>

namespace antumbra::app {

void Comparison::add(const std::string& id, double error, double tolerance)
{
    ++count_;
    squares_ += error * error;
    if (!(error <= tolerance))
        ++outOfTolerance_;
    if (worstId_.empty() || !(error <= worst_)) {
        worst_ = error;
        worstId_ = id;
    }
}

double Comparison::rmse() const { return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0; }

ExitCode runEval(const EvalOptions& options)
{
    gpu::Device device({});
    const bool isCones = options.kind == EvalKind::Cones;
    const Evaluation evaluation = isCones ? evaluateCones(device, options.cases) : evaluateIrradiance(device, options.cases);
    writeText(options.output, evaluation.results);
    const Comparison& comparison = evaluation.comparison;
    fmt::print("{}: {} cases, {} compared, RMSE {:.3g}, worst {:.3g}{}, {} out of tolerance ({})\n", isCones ? "cones" : "irradiance",
               evaluation.cases, comparison.count(), comparison.rmse(), comparison.worst(),
               comparison.count() > 0 ? fmt::format(" ({})", comparison.worstId()) : "", comparison.outOfTolerance(),
               isCones ? "1e-4, relative" : "1 % of max(E_unshadowed, 0.3), constant light 0.5 %");
    return comparison.outOfTolerance() == 0 ? ExitCode::Done : ExitCode::CheckFailed;
}

} // namespace antumbra::app
