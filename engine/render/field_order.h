// The order of a field's steps in which groups of them are small in space: plain unions in a row give the same distance in any order.
#pragma once

#include "render/shader_structs.h"

#include <span>
#include <vector>

namespace antumbra::render {

class FieldOrder
{
public:
    /// Indices into `steps`. Valid until the next call; keeps its memory.
    std::span<const uint32_t> of(std::span<const shader::FieldStepBlock> steps);

private:
    void halve(std::span<uint32_t> indices);

    std::vector<uint32_t> order_;
    std::vector<vec3> centres_; // of steps
};

} // namespace antumbra::render
