// The order of fields' steps in which groups of them are small in space: plain unions in a row give the same distance in any order.
#pragma once

#include "render/shader_structs.h"

#include <span>
#include <vector>

namespace antumbra::render {

class FieldOrder
{
public:
    /// Indices into `steps`. Found anew where their structure is another than before: as things move they keep their places, and what is
    /// compiled for these. Valid until the next call; keeps its memory.
    std::span<const uint32_t> of(std::span<const shader::FieldStepBlock> steps);

private:
    struct Kind
    {
        uint32_t shape, operation, flags;

        friend bool operator==(const Kind&, const Kind&) = default;
    };

    void find(std::span<const shader::FieldStepBlock> steps);
    void halve(std::span<uint32_t> indices, uint32_t inGroup);

    std::vector<uint32_t> order_;
    std::vector<Kind> kinds_, kindsNow_; // of steps, as the order was found for them
    std::vector<vec3> centres_;
};

} // namespace antumbra::render
