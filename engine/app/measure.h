// What the lab measures, as numbers: the spread of times, and the distance of a picture to the truth. Knows no device and no file.
#pragma once

#include "scene/images.h"

#include <span>
#include <vector>

namespace antumbra::app {

struct Quartiles
{
    double lower = 0;
    double median = 0;
    double upper = 0;
};

/// Interpolates linearly between the two nearest values; `values` are finite, in any order, at least one.
Quartiles quartilesOf(std::span<const double> values);

/// Least squares: a value as a constant and so much of each of some quantities.
struct LinearFit
{
    std::vector<double> weights; // the constant first
    double rSquared = 0;         // share of the values' variance that it explains
};

/// `quantities`: as many each as there are `values`, which are more than weights, and do not all follow from the others. Throws Error
/// where they do.
LinearFit fitLinear(std::span<const std::vector<double>> quantities, std::span<const double> values);

/// Pictures of one view and one size, as the renderer captures them.
struct Truth
{
    scene::ImageF irradiance; // of the reference, W/m^2
    scene::ImageF unshadowed; // W/m^2
    scene::ImageF depth;      // metres; 0 where there is no surface
};

/// Over the pixels that show a surface, and their three channels.
struct ImageError
{
    double rmse = 0;         // W/m^2
    double relativeRmse = 0; // as a share of the mean unshadowed irradiance
    double mae = 0;          // W/m^2
    double ssim = 1;         // of luminance, in Gaussian windows of 11 x 11 pixels (Wang et al. 2004)
    double percentile99 = 0; // of the absolute error, W/m^2
};

/// Throws Error where no pixel shows a lit surface. A value that is not finite makes every figure NaN.
ImageError errorOf(const scene::ImageF& irradiance, const Truth& truth);

} // namespace antumbra::app
