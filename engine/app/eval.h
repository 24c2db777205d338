// Cases with known answers (golden/README.md) through the very shader functions that the renderer uses, on the device.
// Judges nothing but the distance to the answers; a case without an answer is computed and not compared.
#pragma once

#include "app/options.h"
#include "gpu/device.h"

#include <string>

namespace antumbra::app {

/// How far results are from the answers.
class Comparison
{
public:
    /// `error` in the unit of the kind's tolerance; NaN is out of any.
    void add(const std::string& id, double error, double tolerance);

    [[nodiscard]] uint64_t count() const { return count_; }
    [[nodiscard]] uint64_t outOfTolerance() const { return outOfTolerance_; }
    /// 0 where nothing was compared.
    [[nodiscard]] double rmse() const;
    [[nodiscard]] double worst() const { return worst_; }
    [[nodiscard]] const std::string& worstId() const { return worstId_; }

private:
    uint64_t count_ = 0, outOfTolerance_ = 0;
    double squares_ = 0, worst_ = 0;
    std::string worstId_;
};

struct Evaluation
{
    uint64_t cases = 0;
    Comparison comparison;
    std::string results; // JSON: [{"id", ...}]
};

/// Axes, half angles, heights and merged lists are compared relatively, to 1e-4; another cone, member or traced probe is an error of 1.
/// Throws Error that names the file and the place in it for cases that are malformed or of another kind.
Evaluation evaluateCones(gpu::Device& device, const Path& cases);
/// By 4096 samples. The error is a share of max(unshadowed irradiance, 0.3), compared to 1 %, for constant light 0.5 %.
Evaluation evaluateIrradiance(gpu::Device& device, const Path& cases);
/// The error is that of the worse of both shares, compared to the case's own tolerance; 1 at least where a share leaves its range.
Evaluation evaluateArea(gpu::Device& device, const Path& cases);
/// By sdf.shadow and its knobs. The error is that of the visibility, compared to 0.12, and to 0.01 where nothing is left to guess: classes
/// empty, inside_light, inside_solid, full_umbra.
Evaluation evaluateSdf(gpu::Device& device, const Path& cases, const render::SdfKnobs& knobs);

} // namespace antumbra::app
