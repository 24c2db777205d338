// The structure of distance fields as GLSL: which step has which shape and operation and is in which group, without what may change from
// frame to frame. What evaluates fields works it off in a row then, and need not look at every step what that is (shaders/lib/field.glsl,
// FIELD_STRUCTURE).
#pragma once

#include "render/shader_structs.h"

#include <span>
#include <string>

namespace antumbra::render {

/// More steps are walked through: of these, most do not matter at a point, and the time to compile them grows with their number.
inline constexpr size_t kMostWrittenSteps = 64;

/// One line, to `text`, whose memory is kept; empty for more than kMostWrittenSteps. `groups` are those of `steps`, or some of them in a
/// row; both are counted from the first of these.
void writeStructure(std::span<const shader::FieldStepBlock> steps, std::span<const shader::FieldGroupBlock> groups, std::string& text);

} // namespace antumbra::render
