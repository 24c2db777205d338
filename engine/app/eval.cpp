#include "app/eval.h"

#include "app/commands.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

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
    const render::Knobs knobs = render::resolveKnobs(render::DeviceClass::Gpu, {}, options.settings);
    struct Kind
    {
        const char* name;
        std::function<Evaluation(gpu::Device&, const Path&)> evaluate;
        const char* tolerance;
    };
    const auto evaluateField = [&knobs](gpu::Device& device, const Path& cases) { return evaluateSdf(device, cases, knobs.sdf); };
    const Kind kinds[] = {{"cones", evaluateCones, "1e-4, relative"},
                          {"irradiance", evaluateIrradiance, "1 % of max(E_unshadowed, 0.3), constant light 0.5 %"},
                          {"area", evaluateArea, "each case's own"},
                          {"sdf", evaluateField, "0.12, 0.01 where nothing is to guess"}};
    const Kind& kind = kinds[static_cast<size_t>(options.kind)];
    gpu::Device device({});
    const Evaluation evaluation = kind.evaluate(device, options.cases);
    writeText(options.output, evaluation.results);
    const Comparison& comparison = evaluation.comparison;
    fmt::print("{}: {} cases, {} compared, RMSE {:.3g}, worst {:.3g}{}, {} out of tolerance ({})\n", kind.name, evaluation.cases,
               comparison.count(), comparison.rmse(), comparison.worst(),
               comparison.count() > 0 ? fmt::format(" ({})", comparison.worstId()) : "", comparison.outOfTolerance(), kind.tolerance);
    return comparison.outOfTolerance() == 0 ? ExitCode::Done : ExitCode::CheckFailed;
}

} // namespace antumbra::app
