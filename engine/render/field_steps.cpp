#include "render/field_steps.h"

#include "base/bounds.h"
#include "base/check.h"
#include "render/field_structure.h"

#include <algorithm>
#include <cmath>

namespace antumbra::render {

namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;
using scene::SDFOperation;
using scene::SDFPrimitive;
using scene::SDFShape;
using shader::FieldGroupBlock;
using shader::FieldStepBlock;

/// A shape's own space: where its centre is, and where +Y goes.
struct Frame
{
    vec3 centre{0};
    vec3 axis{0, 1, 0};
};

void setShape(FieldStepBlock& step, Frame& frame, const SDFPrimitive& p)
{
    frame.centre = p.centre;
    switch (p.shape) {
    case SDFShape::Sphere:
        step.shape = shader::kFieldSegment;
        step.size = {0, p.radius, 0, 0};
        return;
    case SDFShape::Capsule: {
        const vec3 along = p.end - p.centre;
        const float length = glm::length(along);
        step.shape = shader::kFieldSegment;
        step.size = {0.5f * length, p.radius, 0, 0};
        frame = {.centre = 0.5f * (p.centre + p.end), .axis = length > 0 ? along / length : vec3(0, 1, 0)};
        return;
    }
    case SDFShape::Box:
        step.shape = shader::kFieldBox;
        step.size = {p.halfExtent, 0};
        return;
    case SDFShape::RoundedBox:
        step.shape = shader::kFieldBox;
        step.size = {p.halfExtent, p.radius};
        return;
    case SDFShape::Torus:
        step.shape = shader::kFieldTorus;
        step.size = {p.radius, p.minorRadius, 0, 0};
        frame.axis = p.direction;
        return;
    case SDFShape::Cylinder:
    case SDFShape::Cone:
        step.shape = shader::kFieldCone;
        step.size = {p.radius, p.shape == SDFShape::Cone ? p.minorRadius : p.radius, 0.5f * p.height, 0};
        frame.axis = p.direction;
        return;
    case SDFShape::Plane:
        step.shape = shader::kFieldPlane;
        frame = {.centre = p.direction * p.offset, .axis = p.direction};
        return;
    case SDFShape::Bones: break; // many steps, each a capsule
    }
    check(false, "a shape");
}

uint32_t operationOf(SDFOperation operation)
{
    switch (operation) {
    case SDFOperation::Union: return shader::kFieldUnion;
    case SDFOperation::Subtract: return shader::kFieldSubtract;
    case SDFOperation::Intersect: return shader::kFieldIntersect;
    case SDFOperation::SmoothUnion: return shader::kFieldSmoothUnion;
    }
    check(false, "an operation");
    return 0;
}

/// Turns +Y to `axis`, of unit length.
mat3 turnedTo(vec3 axis)
{
    // Without a branch but at the one axis where it has no answer (Duff et al. 2017, with Y for Z).
    const float s = axis.y >= 0 ? 1.0f : -1.0f, a = -1 / (s + axis.y), b = axis.x * axis.z * a;
    return {vec3(1 + s * axis.x * axis.x * a, -s * axis.x, s * b), axis, vec3(b, -axis.z, s + axis.z * axis.z * a)};
}

bool isFinite(const mat4& m)
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row]))
                return false;
    return true;
}

bool isFinite(const SDFPrimitive& p)
{
    for (const float value : {p.centre.x, p.centre.y, p.centre.z, p.end.x, p.end.y, p.end.z, p.halfExtent.x, p.halfExtent.y, p.halfExtent.z,
                              p.direction.x, p.direction.y, p.direction.z, p.radius, p.minorRadius, p.height, p.offset, p.blend})
        if (!std::isfinite(value))
            return false;
    return true;
}

/// By how much the matrix stretches at least and at most: exact where its columns stay square to each other, else by Frobenius's norm.
struct Stretch
{
    float least;
    float most;
};

Stretch stretchOf(const mat3& m)
{
    const vec3 lengths{glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
    const float skew =
        std::max({std::abs(glm::dot(m[0], m[1])) / (lengths.x * lengths.y), std::abs(glm::dot(m[1], m[2])) / (lengths.y * lengths.z),
                  std::abs(glm::dot(m[2], m[0])) / (lengths.z * lengths.x)});
    if (skew < 1e-4f)
        return {std::min({lengths.x, lengths.y, lengths.z}) * (1 - skew), std::max({lengths.x, lengths.y, lengths.z}) * (1 + skew)};
    const mat3 back = glm::inverse(m);
    const auto norm = [](const mat3& a) { return std::sqrt(glm::dot(a[0], a[0]) + glm::dot(a[1], a[1]) + glm::dot(a[2], a[2])); };
    return {1 / norm(back), norm(m)};
}

mat3 linearOf(const FieldStepBlock& step) // of local from world
{
    return glm::transpose(mat3(vec3(step.localFromWorld[0]), vec3(step.localFromWorld[1]), vec3(step.localFromWorld[2])));
}

double segmentDistance(dvec3 p, double halfLength, double radius)
{
    p.y -= std::clamp(p.y, -halfLength, halfLength);
    return glm::length(p) - radius;
}

double boxDistance(const dvec3& p, const dvec3& halfEdges, double rounding)
{
    const dvec3 over = glm::abs(p) - halfEdges;
    return glm::length(glm::max(over, 0.0)) + std::min(std::max({over.x, over.y, over.z}), 0.0) - rounding;
}

double coneDistance(const dvec3& p, double below, double above, double halfHeight)
{
    const dvec2 at{glm::length(dvec2(p.x, p.z)), p.y}, side{above - below, 2 * halfHeight}, fromBelow = at - dvec2(below, -halfHeight);
    const dvec2 toSide = fromBelow - side * std::clamp(glm::dot(fromBelow, side) / std::max(glm::dot(side, side), 1e-30), 0.0, 1.0);
    const dvec2 toLid{std::max(at.x - (at.y < 0 ? below : above), 0.0), std::abs(at.y) - halfHeight};
    const bool isInside = toLid.y < 0 && fromBelow.x * side.y < side.x * fromBelow.y;
    const double distance = std::sqrt(std::min(glm::dot(toSide, toSide), glm::dot(toLid, toLid)));
    return isInside ? -distance : distance;
}

double shapeDistance(const FieldStepBlock& step, const dvec3& point)
{
    dvec3 p;
    for (int row = 0; row < 3; ++row)
        p[row] = glm::dot(dvec3(step.localFromWorld[row]), point) + double{step.localFromWorld[row].w};
    const glm::dvec4 size{step.size};
    switch (step.shape) {
    case shader::kFieldSegment: return segmentDistance(p, size.x, size.y);
    case shader::kFieldBox: return boxDistance(p, dvec3(size), size.w);
    case shader::kFieldTorus: return glm::length(dvec2(glm::length(dvec2(p.x, p.z)) - size.x, p.y)) - size.y;
    case shader::kFieldCone: return coneDistance(p, size.x, size.y, size.z);
    default: return p.y;
    }
}

double combined(const FieldStepBlock& step, double before, double own)
{
    switch (step.operation) {
    case shader::kFieldUnion: return std::min(before, own);
    case shader::kFieldSubtract: return std::max(before, -own);
    case shader::kFieldIntersect: return std::max(before, own);
    default: {
        const double blend = std::max(double{step.blend}, 1e-9), h = std::max(blend - std::abs(before - own), 0.0);
        return std::min(before, own) - h * h / (4 * blend);
    }
    }
}

/// About the centre, in the shape's own space.
float localRadius(const FieldStepBlock& step)
{
    switch (step.shape) {
    case shader::kFieldSegment:
    case shader::kFieldTorus: return step.size.x + step.size.y;
    case shader::kFieldBox: return glm::length(vec3(step.size)) + step.size.w;
    case shader::kFieldCone: return glm::length(vec2(std::max(step.size.x, step.size.y), step.size.z));
    default: return kFieldUnbounded;
    }
}

/// It matters wherever one is: what has no end, and what takes away all beyond it.
bool isEverywhere(const FieldStepBlock& step) { return step.shape == shader::kFieldPlane || step.operation == shader::kFieldIntersect; }

bool takesAway(const FieldStepBlock& step) { return step.operation == shader::kFieldSubtract || step.operation == shader::kFieldIntersect; }

bool isUnion(const FieldStepBlock& step) { return step.operation == shader::kFieldUnion; }

/// About the shape, in its own space: half of the edges.
vec3 localHalfEdges(const FieldStepBlock& step)
{
    const vec4& size = step.size;
    switch (step.shape) {
    case shader::kFieldSegment: return {size.y, size.x + size.y, size.y};
    case shader::kFieldBox: return vec3(size) + size.w;
    case shader::kFieldTorus: return {size.x + size.y, size.y, size.x + size.y};
    case shader::kFieldCone: return {std::max(size.x, size.y), size.z, std::max(size.x, size.y)};
    default: return vec3(kFieldUnbounded);
    }
}

/// In the world, along its axes.
Aabb boxOf(const FieldStepBlock& step)
{
    const mat3 worldFromLocal = glm::inverse(linearOf(step));
    const vec3 half = localHalfEdges(step), centre = boundOf(step).centre;
    const vec3 reach = glm::abs(worldFromLocal[0]) * half.x + glm::abs(worldFromLocal[1]) * half.y + glm::abs(worldFromLocal[2]) * half.z;
    return {centre - reach, centre + reach};
}

// A step's distance is `scale` times the local one, and that is at least the way to the centre, which its transform stretches by no more
// than `most`, less the local radius; outside of its box at least the way there.
void boundGroup(FieldGroupBlock& group, std::span<const FieldStepBlock> steps)
{
    group.slope = 1;
    if (isEverywhere(steps.front())) {
        group.halfEdges = vec3(2 * kFieldUnbounded);
        group.reach = 2 * kFieldUnbounded;
        return;
    }
    Aabb box;
    for (const FieldStepBlock& step : steps) {
        box.add(boxOf(step));
        group.slope = std::min(group.slope, step.scale / stretchOf(glm::inverse(linearOf(step))).most);
    }
    group.centre = box.centre();
    for (const FieldStepBlock& step : steps)
        group.reach = std::max(group.reach, group.slope * glm::distance(group.centre, boundOf(step).centre) +
                                                step.scale * localRadius(step) + step.blend);
    const vec3 rounding = 1e-6f * (glm::abs(group.centre) + 1.0f);
    group.halfEdges = 0.50001f * box.extent() + rounding;
    group.reach = group.reach * 1.00001f + 1e-6f;
}

} // namespace

std::optional<FieldStepBlock> fieldStep(const SDFPrimitive& primitive, const mat4& world)
{
    FieldStepBlock step{};
    Frame frame;
    setShape(step, frame, primitive);
    mat4 worldFromLocal = world * mat4(turnedTo(frame.axis));
    worldFromLocal[3] = world * vec4(frame.centre, 1);
    const mat4 localFromWorld = glm::affineInverse(worldFromLocal);
    if (!isFinite(primitive) || !isFinite(localFromWorld) || !isFinite(worldFromLocal))
        return std::nullopt;
    const mat4 rows = glm::transpose(localFromWorld);
    for (int row = 0; row < 3; ++row)
        step.localFromWorld[row] = rows[row];
    step.scale = stretchOf(mat3(worldFromLocal)).least;
    step.blend = primitive.blend;
    step.operation = operationOf(primitive.operation);
    return step;
}

double fieldDistance(std::span<const FieldStepBlock> steps, const dvec3& point)
{
    double whole = kFieldUnbounded, so = kFieldUnbounded;
    for (const FieldStepBlock& step : steps) {
        if ((step.flags & shader::kFieldBegins) != 0) {
            whole = std::min(whole, so);
            so = kFieldUnbounded;
        }
        so = combined(step, so, double{step.scale} * shapeDistance(step, point));
    }
    return std::min(whole, so);
}

FieldBound boundOf(const FieldStepBlock& step)
{
    const mat3 worldFromLocal = glm::inverse(linearOf(step));
    const vec3 origin{step.localFromWorld[0].w, step.localFromWorld[1].w, step.localFromWorld[2].w};
    return {-(worldFromLocal * origin), std::min(localRadius(step) * stretchOf(worldFromLocal).most, kFieldUnbounded)};
}

uint32_t mostInGroup(size_t count) { return count <= kMostWrittenSteps ? 2 : 4; }

void writeGroups(std::span<const FieldStepBlock> steps, std::vector<FieldGroupBlock>& groups)
{
    groups.clear();
    const uint32_t most = mostInGroup(steps.size());
    const auto begins = [&](uint32_t i) { return (steps[i].flags & shader::kFieldBegins) != 0; };
    uint32_t field = 0;
    for (uint32_t i = 0; i < steps.size(); ++i) {
        field += i > 0 && begins(i) ? 1 : 0;
        // What a field begins with keeps its place and stands alone, so that groups are those that FieldOrder puts together.
        const bool isOpen = !groups.empty() && !isEverywhere(steps[i]) && !isEverywhere(steps[i - 1]) && !begins(i) && !begins(i - 1) &&
                            isUnion(steps[i]) == isUnion(steps[i - 1]) && groups.back().endStep - groups.back().firstStep < most;
        if (!isOpen)
            groups.push_back({.firstStep = i, .endStep = i, .field = field});
        groups.back().endStep = i + 1;
        groups.back().takesAway |= takesAway(steps[i]) ? 1u : 0u;
    }
    float melt = 0;
    for (size_t g = groups.size(); g-- > 0;) { // what melts later counts for those before it
        FieldGroupBlock& group = groups[g];
        const std::span<const FieldStepBlock> own = steps.subspan(group.firstStep, group.endStep - group.firstStep);
        for (const FieldStepBlock& step : own)
            melt = std::max(melt, step.blend);
        boundGroup(group, own);
        group.melt = melt;
        melt = begins(group.firstStep) ? 0 : melt;
    }
}

uint32_t takesAway(std::span<const FieldGroupBlock> groups)
{
    return std::ranges::any_of(groups, [](const FieldGroupBlock& group) { return group.takesAway != 0; }) ? 1 : 0;
}

void writeParts(std::span<const FieldStepBlock> steps, std::span<const FieldGroupBlock> groups, std::vector<FieldPart>& parts)
{
    parts.clear();
    for (uint32_t g = 0; g < groups.size(); ++g) {
        const FieldStepBlock& step = steps[groups[g].firstStep]; // as all of its group: a union, or none
        const bool begins = (step.flags & shader::kFieldBegins) != 0;
        // What is no union works on all of its field so far.
        while (!begins && !isUnion(step) && (steps[groups[parts.back().firstGroup].firstStep].flags & shader::kFieldBegins) == 0)
            parts.pop_back();
        if (begins || isUnion(step))
            parts.push_back({g, g});
        parts.back().endGroup = g + 1;
    }
}

} // namespace antumbra::render
