// One scene baked with one set of settings: what the lab takes the baker's figures from. Keeps none of them.
#pragma once

#include "app/interrupt.h"
#include "app/measure.h"
#include "app/surfaces.h"
#include "app/sweep.h"
#include "bake/baker.h"
#include "tools/lab/samples.h"

#include <optional>

namespace antumbra::lab {

class BakeBench
{
public:
    /// Throws Error for a scene that does not load or has nothing to bake.
    explicit BakeBench(const app::SweepPoint& point);

    /// Every knob as the point has it.
    [[nodiscard]] static render::Settings knobsOf(const app::SweepPoint& point);

    /// Bakes on all cores, and then some texels and cells again on one, in turn with Embree alone on the same rays. Nothing where it was
    /// interrupted.
    std::optional<Samples> measure(const app::InterruptGuard& interrupt);
    /// After measure(): of the light on the surface, turned five ways, against path tracing. No SSIM and no percentile: the noise of the
    /// truth would be in them.
    [[nodiscard]] app::ImageError error() const;

private:
    BakeBench(const app::SweepPoint& point, const scene::SceneFile& scene);
    void addShare(Samples& samples) const;

    app::SweepPoint point_;
    render::Knobs knobs_;
    double environmentRadians_;
    app::Surfaces surfaces_;
    std::optional<bake::Bake> bake_;
};

} // namespace antumbra::lab
