#include "app/measure.h"

#include "base/check.h"
#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace antumbra::app {

namespace {

constexpr int kWindowRadius = 5; // pixels
constexpr double kWindowSigma = 1.5;
constexpr double kMeanStability = 0.01, kContrastStability = 0.03; // K1 and K2 of the SSIM paper

/// `share` of the sorted values lie below.
double quantile(std::span<const double> sorted, double share)
{
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<size_t>(place);
    const size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

/// Luminance (Rec. 709) of the surface, NaN elsewhere.
std::vector<double> surfaceLuminance(const scene::ImageF& image, const scene::ImageF& depth)
{
    std::vector<double> luminance;
    for (size_t pixel = 0; pixel < depth.values.size(); ++pixel) {
        const float* rgb = &image.values[3 * pixel];
        luminance.push_back(depth.values[pixel] > 0 ? 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
                                                    : std::numeric_limits<double>::quiet_NaN());
    }
    return luminance;
}

/// First and second moments of two pictures in one window.
struct Moments
{
    double weight = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

    void add(double w, double a, double b)
    {
        weight += w;
        x += w * a;
        y += w * b;
        xx += w * a * a;
        yy += w * b * b;
        xy += w * a * b;
    }
    [[nodiscard]] double similarity(double c1, double c2) const
    {
        const double meanX = x / weight, meanY = y / weight;
        const double varianceX = xx / weight - meanX * meanX, varianceY = yy / weight - meanY * meanY;
        const double covariance = xy / weight - meanX * meanY;
        return (2 * meanX * meanY + c1) * (2 * covariance + c2) / ((meanX * meanX + meanY * meanY + c1) * (varianceX + varianceY + c2));
    }
};

std::array<double, 2 * kWindowRadius + 1> windowWeights()
{
    std::array<double, 2 * kWindowRadius + 1> weights{};
    for (int i = -kWindowRadius; i <= kWindowRadius; ++i)
        weights[static_cast<size_t>(i + kWindowRadius)] = std::exp(-0.5 * i * i / (kWindowSigma * kWindowSigma));
    return weights;
}

/// The mean over windows about every surface pixel; what is no surface has no weight in them.
double similarity(const std::vector<double>& x, const std::vector<double>& y, int width, int height, double range)
{
    const double c1 = std::pow(kMeanStability * range, 2), c2 = std::pow(kContrastStability * range, 2);
    const auto weights = windowWeights();
    double sum = 0;
    size_t count = 0;
    const auto windowAt = [&](int column, int row) {
        Moments moments;
        for (int v = std::max(0, row - kWindowRadius); v <= std::min(height - 1, row + kWindowRadius); ++v)
            for (int u = std::max(0, column - kWindowRadius); u <= std::min(width - 1, column + kWindowRadius); ++u) {
                const size_t there = static_cast<size_t>(v) * static_cast<size_t>(width) + static_cast<size_t>(u);
                const double weight =
                    weights[static_cast<size_t>(u - column + kWindowRadius)] * weights[static_cast<size_t>(v - row + kWindowRadius)];
                if (!std::isnan(y[there]))
                    moments.add(weight, x[there], y[there]);
            }
        return moments.similarity(c1, c2);
    };
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            if (!std::isnan(y[static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column)])) {
                sum += windowAt(column, row);
                ++count;
            }
    return sum / static_cast<double>(count);
}

/// Absolute errors of the surface, and the sum of its unshadowed irradiance.
struct Differences
{
    std::vector<double> absolute;
    double unshadowed = 0;
    bool isFinite = true;
};

Differences differencesOf(const scene::ImageF& irradiance, const Truth& truth)
{
    Differences differences;
    for (size_t i = 0; i < irradiance.values.size(); ++i) {
        if (!(truth.depth.values[i / 3] > 0))
            continue;
        const double absolute = std::abs(double{irradiance.values[i]} - double{truth.irradiance.values[i]});
        differences.isFinite = differences.isFinite && std::isfinite(absolute);
        differences.absolute.push_back(absolute);
        differences.unshadowed += std::max(0.0f, truth.unshadowed.values[i]);
    }
    return differences;
}

/// To a diagonal (Gauss, Jordan). `sizes` are what the diagonal was before: next to nothing of one left is no equation.
void eliminate(std::vector<std::vector<double>>& equations, const std::vector<double>& sizes)
{
    for (size_t i = 0; i < sizes.size(); ++i) {
        if (!(equations[i][i] > 1e-12 * sizes[i]))
            throw Error("the quantities follow from each other, or are too few: nothing can be fitted", "fit");
        for (size_t row = 0; row < sizes.size(); ++row) {
            const double share = row == i ? 0 : equations[row][i] / equations[i][i];
            for (size_t column = i; column <= sizes.size(); ++column)
                equations[row][column] -= share * equations[i][column];
        }
    }
}

} // namespace

Quartiles quartilesOf(std::span<const double> values)
{
    check(!values.empty(), "at least one value");
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return {quantile(sorted, 0.25), quantile(sorted, 0.5), quantile(sorted, 0.75)};
}

LinearFit fitLinear(std::span<const std::vector<double>> quantities, std::span<const double> values)
{
    const size_t count = quantities.size() + 1;
    const auto quantity = [&](size_t i, size_t row) { return i == 0 ? 1.0 : quantities[i - 1].at(row); };
    // The normal equations, the right side in the last column.
    std::vector<std::vector<double>> equations(count, std::vector<double>(count + 1));
    for (size_t row = 0; row < values.size(); ++row)
        for (size_t i = 0; i < count; ++i)
            for (size_t j = 0; j <= count; ++j)
                equations[i][j] += quantity(i, row) * (j < count ? quantity(j, row) : values[row]);
    std::vector<double> sizes;
    for (size_t i = 0; i < count; ++i)
        sizes.push_back(equations[i][i]);
    eliminate(equations, sizes);

    LinearFit fit;
    for (size_t i = 0; i < count; ++i)
        fit.weights.push_back(equations[i][count] / equations[i][i]);
    double sum = 0, squares = 0, left = 0;
    for (size_t row = 0; row < values.size(); ++row) {
        double found = 0;
        for (size_t i = 0; i < count; ++i)
            found += fit.weights[i] * quantity(i, row);
        sum += values[row];
        squares += values[row] * values[row];
        left += (values[row] - found) * (values[row] - found);
    }
    fit.rSquared = 1 - left / (squares - sum * sum / static_cast<double>(values.size()));
    return fit;
}

ImageError errorOf(const scene::ImageF& irradiance, const Truth& truth)
{
    check(irradiance.channels == 3 && irradiance.values.size() == truth.irradiance.values.size() &&
              irradiance.values.size() == truth.unshadowed.values.size() && irradiance.values.size() == 3 * truth.depth.values.size(),
          "pictures of one size");
    Differences differences = differencesOf(irradiance, truth);
    if (!(differences.unshadowed > 0))
        throw Error("no lit surface in view: there is nothing to compare", "reference");
    if (!differences.isFinite) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        return {kNone, kNone, kNone, kNone, kNone};
    }
    std::ranges::sort(differences.absolute);
    double sum = 0, squares = 0;
    for (const double absolute : differences.absolute) {
        sum += absolute;
        squares += absolute * absolute;
    }
    const auto count = static_cast<double>(differences.absolute.size());
    const double rmse = std::sqrt(squares / count);

    const std::vector<double> shown = surfaceLuminance(irradiance, truth.depth);
    const std::vector<double> real = surfaceLuminance(truth.irradiance, truth.depth);
    double range = 0;
    for (const double luminance : surfaceLuminance(truth.unshadowed, truth.depth))
        range = std::fmax(range, luminance); // which passes over NaN
    return {.rmse = rmse,
            .relativeRmse = rmse / (differences.unshadowed / count),
            .mae = sum / count,
            .ssim = similarity(shown, real, static_cast<int>(irradiance.width), static_cast<int>(irradiance.height), range),
            .percentile99 = quantile(differences.absolute, 0.99)};
}

} // namespace antumbra::app
