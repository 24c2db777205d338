// The rows of a picture as groups take them: each once, and any run of them all over the picture.
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"

#include <algorithm>

namespace antumbra {
namespace {

class LibSpread : public DeviceTest
{
protected:
    std::vector<uint32_t> spread(uint32_t rows)
    {
        struct In
        {
            uint32_t row, rows;
        };
        std::vector<In> inputs;
        for (uint32_t row = 0; row < rows; ++row)
            inputs.push_back({row, rows});
        return runKernel<uint32_t>(device(), "lib_functions.comp", "SPREAD_ROW", inputs);
    }
};

TEST_F(LibSpread, TakesEveryRowOnce)
{
    for (const uint32_t rows : {1u, 2u, 3u, 4u, 6u, 8u, 12u, 23u, 45u, 60u, 90u, 128u, 135u, 1024u}) {
        std::vector<uint32_t> taken = spread(rows);
        std::ranges::sort(taken);
        for (uint32_t row = 0; row < rows; ++row)
            ASSERT_EQ(taken[row], row) << "of " << rows;
    }
}

TEST_F(LibSpread, GivesEveryRunItsShareOfEveryPart)
{
    constexpr uint32_t kRows = 96;
    const std::vector<uint32_t> taken = spread(kRows);
    for (const uint32_t runs : {2u, 3u, 4u})
        for (uint32_t run = 0; run < runs; ++run) {
            const auto first = taken.begin() + run * kRows / runs;
            const auto upper = std::count_if(first, first + kRows / runs, [](uint32_t row) { return row < kRows / 2; });
            EXPECT_NEAR(static_cast<double>(upper), 0.5 * kRows / runs, 2) << run << " of " << runs;
        }
}

} // namespace
} // namespace antumbra
