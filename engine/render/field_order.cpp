#include "render/field_order.h"

#include "base/bounds.h"
#include "render/field_steps.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace antumbra::render {

namespace {

using shader::FieldStepBlock;

/// A step that changes places with others like it.
bool isFree(const FieldStepBlock& step)
{
    return step.operation == shader::kFieldUnion && (step.flags & shader::kFieldBegins) == 0 && step.shape != shader::kFieldPlane;
}

} // namespace

/// Until no half is larger than a group; halves are whole groups but for the last.
void FieldOrder::halve(std::span<uint32_t> indices, uint32_t inGroup)
{
    if (indices.size() <= inGroup) {
        // Groups of the same shapes have the same structure then.
        std::ranges::sort(indices, {}, [&](uint32_t index) { return std::pair(kinds_[index].shape, index); });
        return;
    }
    Aabb box;
    for (const uint32_t index : indices)
        box.add(centres_[index]);
    const vec3 extent = box.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::ranges::sort(indices, [&](uint32_t a, uint32_t b) {
        return centres_[a][axis] != centres_[b][axis] ? centres_[a][axis] < centres_[b][axis] : a < b;
    });
    const size_t groups = (indices.size() + inGroup - 1) / inGroup;
    const size_t first = (groups + 1) / 2 * inGroup;
    halve(indices.first(first), inGroup);
    halve(indices.subspan(first), inGroup);
}

void FieldOrder::find(std::span<const FieldStepBlock> steps)
{
    order_.resize(steps.size());
    std::iota(order_.begin(), order_.end(), 0u);
    centres_.clear();
    for (const FieldStepBlock& step : steps)
        centres_.push_back(boundOf(step).centre);
    for (size_t first = 0; first < steps.size();) {
        size_t end = first;
        while (end < steps.size() && isFree(steps[end]))
            ++end;
        halve(std::span(order_).subspan(first, end - first), mostInGroup(steps.size()));
        first = std::max(end, first + 1);
    }
}

std::span<const uint32_t> FieldOrder::of(std::span<const FieldStepBlock> steps)
{
    kindsNow_.clear();
    for (const FieldStepBlock& step : steps)
        kindsNow_.push_back({step.shape, step.operation, step.flags});
    if (kindsNow_ != kinds_) {
        kinds_ = kindsNow_;
        find(steps);
    }
    return order_;
}

} // namespace antumbra::render
