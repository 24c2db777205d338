// Chance that can be played again: a PCG32 generator (O'Neill 2014) as a resource of the world. Not for sampling in the renderer.
#pragma once

#include <cstdint>

namespace antumbra::app {

class Random
{
public:
    explicit Random(uint64_t seed) : state_(seed + kIncrement) { next(); }

    uint32_t next()
    {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005u + kIncrement;
        const auto xorShifted = static_cast<uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto rotation = static_cast<uint32_t>(old >> 59u);
        return xorShifted >> rotation | xorShifted << (-rotation & 31u);
    }
    /// `least` <= value < `greatest`.
    float between(float least, float greatest) { return least + (greatest - least) * static_cast<float>(next() >> 8) * 0x1p-24f; }

    [[nodiscard]] uint64_t state() const { return state_; }

private:
    static constexpr uint64_t kIncrement = 1442695040888963407u;

    uint64_t state_;
};

} // namespace antumbra::app
