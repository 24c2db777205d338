// Nelder and Mead, A Simplex Method for Function Minimization, The Computer Journal 7(4), 1965. Knows no bounds and no gradients.
#pragma once

#include <algorithm>
#include <array>
#include <span>

namespace antumbra::fit {

template <size_t kMost>
class Simplex
{
public:
    using Point = std::array<double, kMost>;
    struct Corner
    {
        Point at;
        double value;
    };

    /// `dimensions`, 1..kMost, is how many of the first coordinates move; `step` is how far apart the corners begin.
    template <class Function>
    Simplex(const Function& function, const Point& start, size_t dimensions, double step) : dimensions_(dimensions)
    {
        for (size_t i = 0; i <= dimensions_; ++i) {
            Point at = start;
            if (i > 0)
                at[i - 1] += step;
            corners_[i] = {at, function(at)};
        }
        sort();
    }

    /// Until the corners' values are nearer than `tolerance` times the least, or after `mostSteps`.
    template <class Function>
    void shrink(const Function& function, double tolerance, int mostSteps)
    {
        for (int step = 0; step < mostSteps && worst().value - best().value > tolerance * best().value; ++step) {
            move(function);
            sort();
        }
    }

    [[nodiscard]] const Corner& best() const { return corners_[0]; }

private:
    [[nodiscard]] std::span<Corner> corners() { return std::span(corners_).first(dimensions_ + 1); }
    [[nodiscard]] const Corner& worst() const { return corners_[dimensions_]; }
    void sort() { std::ranges::stable_sort(corners(), {}, &Corner::value); }

    /// The point of the line through the worst corner (1) and the middle of the others (0).
    [[nodiscard]] Point onLine(double place) const
    {
        Point at = worst().at;
        for (size_t i = 0; i < dimensions_; ++i) {
            double middle = 0;
            for (size_t corner = 0; corner < dimensions_; ++corner)
                middle += corners_[corner].at[i] / static_cast<double>(dimensions_);
            at[i] = middle + place * (at[i] - middle);
        }
        return at;
    }

    template <class Function>
    void move(const Function& function)
    {
        const auto tried = [&](double place) {
            const Point at = onLine(place);
            return Corner{at, function(at)};
        };
        const Corner reflected = tried(-1);
        Corner next = reflected;
        if (reflected.value < best().value) {
            const Corner expanded = tried(-2);
            next = expanded.value < reflected.value ? expanded : reflected;
        } else if (reflected.value >= corners_[dimensions_ - 1].value) {
            next = tried(reflected.value < worst().value ? -0.5 : 0.5);
            if (next.value >= std::min(reflected.value, worst().value))
                return contract(function);
        }
        corners_[dimensions_] = next;
    }

    template <class Function>
    void contract(const Function& function)
    {
        for (Corner& corner : corners().subspan(1)) {
            for (size_t i = 0; i < dimensions_; ++i)
                corner.at[i] = 0.5 * (corner.at[i] + best().at[i]);
            corner.value = function(corner.at);
        }
    }

    size_t dimensions_;
    std::array<Corner, kMost + 1> corners_{};
};

} // namespace antumbra::fit
