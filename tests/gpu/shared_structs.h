// The fixture of tests of structs in shaders/shared: the device echoes, member by member, what the host wrote.
#pragma once

#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "render/shader_structs.h"

#include <array>
#include <bit>
#include <cstring>

namespace antumbra {

using Words = std::vector<uint32_t>;

// The words of members in the order given, whatever lies between them.
template <class... Members>
Words wordsOf(const Members&... members)
{
    Words words;
    const auto append = [&words](const auto& member) {
        static_assert(sizeof(member) % 4 == 0);
        const size_t end = words.size();
        words.resize(end + sizeof(member) / 4);
        std::memcpy(&words[end], &member, sizeof(member));
    };
    (append(members), ...);
    return words;
}

class SharedStructs : public DeviceTest
{
protected:
    explicit SharedStructs(std::string_view kernel = "shared_structs.comp") : kernel_(kernel) {}

    // `members` lists a struct's words by name; the kernel's define lists them by name in GLSL.
    template <class Block, class Members>
    void expectSameLayout(std::string_view define, Members members)
    {
        static_assert(sizeof(Block) % 4 == 0);
        constexpr size_t kWords = sizeof(Block) / 4;
        std::array<uint32_t, 2 * kWords> distinct{};
        for (size_t i = 0; i < distinct.size(); ++i)
            distinct[i] = std::bit_cast<uint32_t>(1.0f) + static_cast<uint32_t>(i); // as float no NaN and not denormal either
        std::array<Block, 2> blocks;
        std::memcpy(blocks.data(), distinct.data(), sizeof(blocks));

        const Words expected = members(blocks[1]);
        const auto echoed = runKernel<std::array<uint32_t, kWords>>(device(), kernel_, define, std::vector{blocks});
        EXPECT_EQ(Words(echoed[0].begin(), echoed[0].begin() + static_cast<ptrdiff_t>(expected.size())), expected);
    }

private:
    std::string_view kernel_;
};

} // namespace antumbra
