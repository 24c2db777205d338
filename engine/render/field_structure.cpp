#include "render/field_structure.h"

#include <fmt/format.h>

#include <iterator>

namespace antumbra::render {

namespace {

std::string_view distanceOf(uint32_t shape)
{
    switch (shape) {
    case shader::kFieldSegment: return "segmentStep";
    case shader::kFieldBox: return "boxStep";
    case shader::kFieldTorus: return "torusStep";
    case shader::kFieldCone: return "coneStep";
    default: return "planeStep";
    }
}

/// What it makes of the distance, and whose surface shows.
std::string_view functionsOf(uint32_t operation)
{
    switch (operation) {
    case shader::kFieldUnion: return "unionOf, unionShare";
    case shader::kFieldSubtract: return "differenceOf, differenceShare";
    case shader::kFieldIntersect: return "intersectionOf, intersectionShare";
    default: return "smoothUnionOf, smoothUnionShare";
    }
}

} // namespace

void writeStructure(std::span<const shader::FieldStepBlock> steps, std::span<const shader::FieldGroupBlock> groups, std::string& text)
{
    text.clear();
    if (groups.empty() || groups.back().endStep - groups.front().firstStep > kMostWrittenSteps)
        return;
    for (size_t g = 0; g < groups.size(); ++g) {
        if ((steps[groups[g].firstStep].flags & shader::kFieldBegins) != 0)
            text += "FIELD_BEGINS ";
        fmt::format_to(std::back_inserter(text), "FIELD_GROUP({}) ", g);
        for (uint32_t i = groups[g].firstStep; i < groups[g].endStep; ++i)
            fmt::format_to(std::back_inserter(text), "FIELD_STEP({}, {}, {}) ", i - groups.front().firstStep,
                           functionsOf(steps[i].operation), distanceOf(steps[i].shape));
        text += "FIELD_ENDS ";
    }
}

} // namespace antumbra::render
