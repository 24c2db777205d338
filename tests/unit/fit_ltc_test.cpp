// The fit of linearly transformed cosines, from its parts to a table of three nodes a side.
#include "tools/fit_ltc/errors.h"
#include "tools/fit_ltc/fit.h"
#include "tools/fit_ltc/shape.h"
#include "tools/fit_ltc/simplex.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antumbra::fit {
namespace {

TEST(FitLtc, SimplexFindsTheEndOfABentValley)
{
    const auto valley = [](const std::array<double, 2>& at) {
        return std::pow(1 - at[0], 2) + 100 * std::pow(at[1] - at[0] * at[0], 2) + 1;
    };
    Simplex<2> simplex(valley, {-1.2, 1}, 2, 0.5);
    simplex.shrink(valley, 1e-14, 400);
    EXPECT_NEAR(simplex.best().at[0], 1, 1e-4);
    EXPECT_NEAR(simplex.best().at[1], 1, 1e-4);
    Simplex<2> held(valley, {0.5, 0.5}, 1, 0.1);
    held.shrink(valley, 1e-12, 200);
    EXPECT_EQ(held.best().at[1], 0.5);
    EXPECT_NEAR(held.best().at[0], 0.70857, 1e-4) << "least on the line y = 0.5";
}

TEST(FitLtc, ShapesAndTexelsAreTheSame)
{
    const Shape shape{-3.5, -4, 0.6, -0.3};
    const Shape back = shapeOf(storedOf(shape, -1.1, false), -1.1);
    for (size_t i = 0; i < shape.size(); ++i)
        EXPECT_NEAR(back[i], shape[i], 1e-9) << i;
    EXPECT_LT(glm::length(storedOf({-1, -1, 0, 0}, 0, false) - storedOf({-1, 5, 5, 5}, 0, true)), 1e-12);
}

TEST(FitLtc, DistanceDoesNotHangOnTheSamples)
{
    const Pattern grid = gridPattern(48), hammersley = hammersleyPattern(2000, 5);
    const bake::Ltc ltc(bake::lookUp(bake::loadLtcTables(projectPath("assets") / "fits"), 0.5, 0.6).matrix);
    const Distance a = Lobe(0.6, 0.25, grid).distanceTo(ltc, 0.8), b = Lobe(0.6, 0.25, hammersley).distanceTo(ltc, 0.8);
    EXPECT_NEAR(a.l1, b.l1, 0.03 * a.l1);
    EXPECT_NEAR(a.l2, b.l2, 0.03 * a.l2);
    const Distance nothing = Lobe(0.6, 0.25, grid).distanceTo(ltc, 0);
    EXPECT_NEAR(nothing.l1, 1, 1e-12);
    EXPECT_NEAR(nothing.l2, 1, 1e-12);
}

TEST(FitLtc, IsTheSameWithAnyNumberOfThreadsAndNearTheReflection)
{
    double told = 0;
    const auto one = fitTables({.size = 3, .threads = 1, .report = [&told](double share) { told = share; }});
    const auto three = fitTables({.size = 3, .threads = 3});
    ASSERT_TRUE(one && three);
    EXPECT_EQ(one->matrix, three->matrix);
    EXPECT_EQ(one->amplitude, three->amplitude);
    EXPECT_NEAR(told, 1, 1e-9);
    EXPECT_LT(errorsOf(*one, 40).bands.back().mean.l1, 0.2);
}

TEST(FitLtc, IsInterrupted)
{
    int asked = 0;
    EXPECT_FALSE(fitTables({.size = 3, .threads = 2, .isInterrupted = [&asked] { return ++asked > 1; }}));
    EXPECT_LE(asked, 4);
}

} // namespace
} // namespace antumbra::fit
