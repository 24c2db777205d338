// The clock of a person's steps: sixty a second whatever the pictures do, and no rush after a long one.
#include "app/main_loop.h"

#include <gtest/gtest.h>

namespace antumbra::app {
namespace {

uint32_t stepsOver(double seconds, double picturesASecond)
{
    StepClock clock;
    uint32_t steps = 0;
    for (int picture = 0; picture < seconds * picturesASecond; ++picture)
        steps += clock.advance(1 / picturesASecond);
    return steps;
}

TEST(StepClock, KeepsSixtyStepsASecondAtAnyRateOfPictures)
{
    for (const double rate : {20.0, 30.0, 47.0, 60.0, 144.0})
        EXPECT_NEAR(stepsOver(10, rate), 600, 1) << rate << " pictures a second";
}

TEST(StepClock, DropsWhatASlowMachineCannotMakeUpFor)
{
    StepClock clock;
    EXPECT_EQ(clock.advance(10), 4u);
    EXPECT_EQ(clock.advance(0), 0u);
    EXPECT_LT(stepsOver(10, 5), 300u);
}

} // namespace
} // namespace antumbra::app
