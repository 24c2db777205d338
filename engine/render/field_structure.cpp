#include "render/field_structure.h"

#include "base/check.h"

#include <fmt/format.h>

#include <iterator>

namespace antumbra::render {

namespace {

constexpr std::string_view kShapes = "sbtcp"; // as shader::kField... number them
constexpr std::string_view kOperations = "usim";
constexpr char kBegins = '|';

std::string_view shapeCall(char shape)
{
    switch (shape) {
    case 's': return "segmentDistance(fieldLocal({0}, p), {0}.size.x, {0}.size.y)";
    case 'b': return "boxDistance(fieldLocal({0}, p), {0}.size.xyz, {0}.size.w)";
    case 't': return "torusDistance(fieldLocal({0}, p), {0}.size.x, {0}.size.y)";
    case 'c': return "coneDistance(fieldLocal({0}, p), {0}.size.x, {0}.size.y, {0}.size.z)";
    case 'p': return "(dot({0}.localFromWorld[1].xyz, p) + {0}.localFromWorld[1].w)";
    default: check(false, "a shape of the key"); return "";
    }
}

std::string_view operationLine(char operation)
{
    switch (operation) {
    case 'u': return "    so = min(so, own);\n";
    case 's': return "    so = max(so, -own);\n";
    case 'i': return "    so = max(so, own);\n";
    case 'm': return "    so = smoothUnion(so, own, {0}.blend);\n";
    default: check(false, "an operation of the key"); return "";
    }
}

} // namespace

void writeStructure(std::span<const shader::FieldStepBlock> steps, std::string& key)
{
    key.clear();
    for (const shader::FieldStepBlock& step : steps) {
        if ((step.flags & shader::kFieldBegins) != 0)
            key += kBegins;
        key += kShapes[step.shape];
        key += kOperations[step.operation];
    }
}

std::string fieldShader(const std::string& key)
{
    std::string text = "    float own;\n";
    size_t index = 0;
    for (auto at = key.begin(); at != key.end(); at += 2, ++index) {
        if (*at == kBegins) {
            text += "    whole = min(whole, so);\n    so = kFieldFar;\n";
            ++at;
        }
        const std::string step = fmt::format("steps.step[{}]", index);
        text += fmt::format("    own = {}.scale * ", step) + fmt::format(fmt::runtime(shapeCall(*at)), step) + ";\n";
        text += fmt::format(fmt::runtime(operationLine(*std::next(at))), step);
    }
    return text;
}

} // namespace antumbra::render
