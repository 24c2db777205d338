// GLSL to SPIR-V through glslang's library. Sources live under shaders/; includes are looked up from there.
#pragma once

#include "base/file.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace antumbra::gpu {

/// `name` is defined as `value` before the first line, or as `text`, which is one line, where there is any.
struct ShaderDefine
{
    std::string_view name;
    int value = 1;
    std::string_view text = {};

    friend bool operator==(const ShaderDefine&, const ShaderDefine&) = default;
};

/// Compiles shaders/`file` (.comp, .vert, .frag) for Vulkan 1.3. Throws Error with glslang's first message, which names the line.
std::vector<uint32_t> compileShader(std::string_view file, std::span<const ShaderDefine> defines = {});

} // namespace antumbra::gpu
