// Distance fields as GLSL of their own: which shapes, put together how, in which order. What is moved, sized or coloured stays in buffers,
// so that only another structure is compiled anew. Compiles nothing itself.
#pragma once

#include "render/shader_structs.h"

#include <span>
#include <string>

namespace antumbra::render {

/// Equal for steps that the same GLSL evaluates. Keeps the memory of `key`.
void writeStructure(std::span<const shader::FieldStepBlock> steps, std::string& key);

/// The body of fieldDistance() in shaders/lib/field.glsl for steps of that structure.
std::string fieldShader(const std::string& key);

} // namespace antumbra::render
