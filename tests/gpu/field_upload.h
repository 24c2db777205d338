// Distance fields on the device, for kernels whose inputs hold a FieldsBlock.
#pragma once

#include "gpu/dispatch.h"
#include "gpu/random_fields.h"

namespace antumbra {

class FieldUpload
{
public:
    /// Inputs may use the blocks as long as this lives.
    FieldUpload(gpu::Device& device, const std::vector<FieldSteps>& fields)
    {
        std::vector<shader::FieldStepBlock> steps;
        std::vector<shader::FieldGroupBlock> groups, own;
        for (const FieldSteps& field : fields) {
            render::writeGroups(field, own);
            blocks_.push_back({.groups = groups.size() * sizeof(shader::FieldGroupBlock),
                               .groupCount = static_cast<uint32_t>(own.size()),
                               .takesAway = render::takesAway(own)});
            for (shader::FieldGroupBlock group : own) {
                group.firstStep += static_cast<uint32_t>(steps.size());
                group.endStep += static_cast<uint32_t>(steps.size());
                groups.push_back(group);
            }
            steps.insert(steps.end(), field.begin(), field.end());
        }
        steps_ = gpu::uploadedBuffer(device, "field steps", std::span<const shader::FieldStepBlock>(steps));
        groups_ = gpu::uploadedBuffer(device, "field groups", std::span<const shader::FieldGroupBlock>(groups));
        for (shader::FieldsBlock& block : blocks_) {
            block.steps = steps_.address();
            block.groups += groups_.address();
        }
    }

    [[nodiscard]] const shader::FieldsBlock& operator[](size_t field) const { return blocks_[field]; }

private:
    std::vector<shader::FieldsBlock> blocks_;
    gpu::Buffer steps_;
    gpu::Buffer groups_;
};

/// What shaders/lib asks of a field, by the defines of tests/gpu/field_functions.comp.
struct FieldAsk
{
    vec3 position;
    vec3 centre; // of the light
    float radius;
    uint32_t cones;
    shader::FieldsBlock fields;
};
/// A parallelogram in `cells` parts, for a surface point.
struct CellsAsk
{
    vec3 position;
    vec3 normal;
    vec3 corner;
    vec3 edgeA;
    vec3 edgeB;
    uint32_t cells;
    shader::FieldsBlock fields;
};
struct FieldSaid
{
    float value;
    uint32_t evaluations;
};

inline constexpr std::string_view kFieldKernel = "field_functions.comp";

} // namespace antumbra
