#include "scene/scene_parts.h"

#include <algorithm>

namespace antumbra::scene {

namespace {

constexpr Range<float> kShare{0, 1};
constexpr Range<float> kRadiance{0, 1e9f};
constexpr int32_t kMostSphereVertices = 162, kMostSides = 48; // of a light: what shaders have room for

constexpr Words<LightShape, 6> kLightShapes{{{"quad", LightShape::Quad},
                                             {"disk", LightShape::Disk},
                                             {"sphere", LightShape::Sphere},
                                             {"cylinder", LightShape::Cylinder},
                                             {"polygon", LightShape::Polygon},
                                             {"mesh", LightShape::Mesh}}};
constexpr Words<LightShadow, 8> kLightShadows{{{"none", LightShadow::None},
                                               {"analytic", LightShadow::Analytic},
                                               {"triangles", LightShadow::Triangles},
                                               {"traced", LightShadow::Traced},
                                               {"ratio", LightShadow::Ratio},
                                               {"article", LightShadow::Article},
                                               {"two-sided", LightShadow::TwoSided},
                                               {"reference", LightShadow::Reference}}};
constexpr Words<bool, 2> kHullsBy{{{"joint", false}, {"piece", true}}};
constexpr Words<OccluderShape, 2> kOccluderShapes{{{"hulls", OccluderShape::Hulls}, {"triangles", OccluderShape::Triangles}}};
constexpr Words<SDFShape, 9> kSDFShapes{{{"sphere", SDFShape::Sphere},
                                         {"box", SDFShape::Box},
                                         {"rounded_box", SDFShape::RoundedBox},
                                         {"torus", SDFShape::Torus},
                                         {"capsule", SDFShape::Capsule},
                                         {"cylinder", SDFShape::Cylinder},
                                         {"cone", SDFShape::Cone},
                                         {"plane", SDFShape::Plane},
                                         {"bones", SDFShape::Bones}}};
constexpr Words<SDFOperation, 4> kSDFOperations{{{"union", SDFOperation::Union},
                                                 {"subtract", SDFOperation::Subtract},
                                                 {"intersect", SDFOperation::Intersect},
                                                 {"smooth_union", SDFOperation::SmoothUnion}}};

quat readRotation(const JsonObject& part)
{
    if (part.has("rotation") && part.has("rotate_deg"))
        part.refuse("", "has both \"rotation\" and \"rotate_deg\"");
    if (part.has("rotation")) {
        const vec4 xyzw = part.vector("rotation", vec4(0, 0, 0, 1), kAnyLength);
        if (glm::length(xyzw) < 1e-6f)
            part.refuse("rotation", "a quaternion has a length");
        return glm::normalize(quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z));
    }
    const vec3 radians = glm::radians(part.vector("rotate_deg", vec3(0), kAnyDegrees));
    return glm::angleAxis(radians.z, vec3(0, 0, 1)) * glm::angleAxis(radians.y, vec3(0, 1, 0)) * glm::angleAxis(radians.x, vec3(1, 0, 0));
}

/// Convex: every corner lies on one side of every edge's line, or on it. Corners may repeat and edges be collinear.
bool isConvex(const std::vector<vec2>& outline)
{
    bool hasLeft = false;
    bool hasRight = false;
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 start = outline[i];
        const vec2 edge = outline[(i + 1) % outline.size()] - start;
        for (const vec2 corner : outline) {
            const vec2 toCorner = corner - start;
            const float turn = edge.x * toCorner.y - edge.y * toCorner.x;
            const float rounding = 1e-6f * glm::length(edge) * glm::length(toCorner);
            hasLeft = hasLeft || turn > rounding;
            hasRight = hasRight || turn < -rounding;
        }
    }
    return hasLeft != hasRight;
}

void readOutline(const JsonObject& part, AreaLight& light)
{
    const std::vector<vec2> outline = part.points("vertices", kAnyLength);
    if (outline.size() < 3 || outline.size() > AreaLight::kGreatestOutline)
        part.refuse("vertices", "expected 3 to " + std::to_string(AreaLight::kGreatestOutline) + " points");
    if (!isConvex(outline))
        part.refuse("vertices", "expected a convex polygon with an area");
    light.outlineCount = static_cast<uint32_t>(outline.size());
    std::ranges::copy(outline, light.outline.begin());
}

void readSegments(const JsonObject& part, AreaLight& light, int32_t most)
{
    light.segments = static_cast<uint32_t>(part.integer("segments", static_cast<int32_t>(light.segments), {4, most}));
}

void readLightShape(const JsonObject& part, AreaLight& light)
{
    const auto allow = [&](std::initializer_list<std::string_view> keys) {
        part.allowOnly({"shape", "radiance", "two_sided", "self_shadow", "shadow"}, keys);
    };
    switch (light.shape) {
    case LightShape::Quad:
        allow({"size"});
        light.size = part.vector("size", light.size, kPositiveLength);
        break;
    case LightShape::Disk:
        allow({"radius", "segments"});
        light.radii = part.vectorOrNumber("radius", light.radii, kPositiveLength);
        readSegments(part, light, kMostSides);
        break;
    case LightShape::Sphere:
        allow({"radius", "segments"});
        light.radii = vec2(part.number("radius", light.radii.x, kPositiveLength));
        readSegments(part, light, kMostSphereVertices);
        break;
    case LightShape::Cylinder:
        allow({"radius", "length", "segments"});
        light.radii = vec2(part.number("radius", light.radii.x, kPositiveLength));
        light.length = part.number("length", light.length, kPositiveLength);
        readSegments(part, light, kMostSides);
        break;
    case LightShape::Polygon:
        allow({"vertices"});
        readOutline(part, light);
        break;
    case LightShape::Mesh: allow({}); break;
    }
}

/// Parameters are called as in ../shared/golden/README.md; cylinders and cones are centred, and a cone narrows along its axis.
void readSDFShape(const JsonObject& part, SDFPrimitive& primitive)
{
    const auto allow = [&](std::initializer_list<std::string_view> keys) {
        part.allowOnly({"shape", "operation", "k", "order", "field"}, keys);
    };
    const auto readRadius = [&](std::string_view key) { primitive.radius = part.number(key, primitive.radius, kPositiveLength); };
    const auto readCentre = [&](std::string_view key) { primitive.centre = part.vector(key, primitive.centre, kAnyLength); };
    switch (primitive.shape) {
    case SDFShape::Sphere:
        allow({"center", "radius"});
        readCentre("center");
        readRadius("radius");
        break;
    case SDFShape::Box:
        allow({"center", "half"});
        readCentre("center");
        primitive.halfExtent = part.vector("half", primitive.halfExtent, kPositiveLength);
        break;
    case SDFShape::RoundedBox:
        allow({"center", "half", "radius"});
        readCentre("center");
        primitive.halfExtent = part.vector("half", primitive.halfExtent, kPositiveLength);
        readRadius("radius");
        break;
    case SDFShape::Torus:
        allow({"center", "axis", "major", "minor"});
        readCentre("center");
        primitive.direction = part.direction("axis", primitive.direction);
        readRadius("major");
        primitive.minorRadius = part.number("minor", primitive.minorRadius, kPositiveLength);
        break;
    case SDFShape::Capsule:
        allow({"a", "b", "radius"});
        readCentre("a");
        primitive.end = part.vector("b", primitive.end, kAnyLength);
        readRadius("radius");
        break;
    case SDFShape::Cylinder:
        allow({"center", "axis", "radius", "height"});
        readCentre("center");
        primitive.direction = part.direction("axis", primitive.direction);
        readRadius("radius");
        primitive.height = part.number("height", primitive.height, kPositiveLength);
        break;
    case SDFShape::Cone:
        allow({"center", "axis", "radius", "top_radius", "height"});
        readCentre("center");
        primitive.direction = part.direction("axis", primitive.direction);
        readRadius("radius");
        primitive.minorRadius = part.number("top_radius", 0, {0, kPositiveLength.greatest});
        primitive.height = part.number("height", primitive.height, kPositiveLength);
        break;
    case SDFShape::Plane:
        allow({"normal", "offset"});
        primitive.direction = part.direction("normal", primitive.direction);
        primitive.offset = part.number("offset", primitive.offset, kAnyLength);
        break;
    case SDFShape::Bones:
        part.allowOnly({"shape", "operation", "k"});
        if (primitive.operation != SDFOperation::Union && primitive.operation != SDFOperation::SmoothUnion)
            part.refuse("operation", "of bones is union or smooth_union");
        break;
    }
}

} // namespace

Transform readTransform(const JsonObject& part)
{
    part.allowOnly({"position", "rotation", "rotate_deg", "scale"});
    Transform transform;
    transform.position = part.vector("position", transform.position, kAnyLength);
    transform.rotation = readRotation(part);
    transform.scale = part.vectorOrNumber("scale", transform.scale, kAnyLength);
    if (glm::abs(transform.scale.x * transform.scale.y * transform.scale.z) < 1e-18f)
        part.refuse("scale", "must not be zero");
    return transform;
}

Material readMaterial(const JsonObject& part)
{
    part.allowOnly({"albedo", "roughness", "metallic", "specular", "emission", "two_sided"});
    Material material;
    material.albedo = part.vector("albedo", material.albedo, kShare);
    material.roughness = part.number("roughness", material.roughness, kShare);
    material.metallic = part.number("metallic", material.metallic, kShare);
    material.specular = part.number("specular", material.specular, kShare);
    material.emission = part.vector("emission", material.emission, kRadiance);
    material.twoSided = part.flag("two_sided", material.twoSided);
    return material;
}

SceneAnimation readAnimation(const JsonObject& part)
{
    part.allowOnly({"clip", "speed", "offset"});
    return {
        .clip = part.text("clip", ""), .speed = part.number("speed", 1, {-100, 100}), .offsetSeconds = part.number("offset", 0, {0, 1e5f})};
}

Orbit readOrbit(const JsonObject& part)
{
    part.allowOnly({"radius", "period", "phase_deg"});
    return {.radius = part.number("radius", 0.5f, kPositiveLength),
            .radiansPerSecond = 2 * kPi / part.number("period", 8, {0.1f, 1e5f}),
            .radians = glm::radians(part.number("phase_deg", 0, kAnyDegrees))};
}

AreaLight readAreaLight(const JsonObject& part)
{
    AreaLight light;
    light.shape = part.choice<LightShape>("shape", std::nullopt, kLightShapes);
    readLightShape(part, light);
    light.radiance = part.vector("radiance", light.radiance, kRadiance);
    light.isTwoSided = part.flag("two_sided", light.isTwoSided);
    light.shadowsItself = part.flag("self_shadow", light.shadowsItself);
    if (part.has("shadow"))
        light.shadow = part.choice<LightShadow>("shadow", std::nullopt, kLightShadows);
    return light;
}

Occluder readOccluder(const JsonObject& part)
{
    Occluder occluder;
    occluder.shape = part.choice<OccluderShape>("shape", occluder.shape, kOccluderShapes);
    if (occluder.shape == OccluderShape::Hulls)
        part.allowOnly({"shape", "max_vertices", "hulls_by"});
    else
        part.allowOnly({"shape"});
    occluder.greatestVertices =
        static_cast<uint32_t>(part.integer("max_vertices", static_cast<int32_t>(occluder.greatestVertices), {4, 4096}));
    occluder.isByPiece = part.choice<bool>("hulls_by", occluder.isByPiece, kHullsBy);
    return occluder;
}

SDFPrimitive readSDFPrimitive(const JsonObject& part, std::vector<std::string>& fields)
{
    SDFPrimitive primitive;
    primitive.shape = part.choice<SDFShape>("shape", std::nullopt, kSDFShapes);
    primitive.operation = part.choice<SDFOperation>("operation", primitive.operation, kSDFOperations);
    readSDFShape(part, primitive);
    if (primitive.operation == SDFOperation::SmoothUnion)
        primitive.blend = part.number("k", 0.1f, kPositiveLength);
    else if (part.has("k"))
        part.refuse("k", "is only for smooth_union");
    primitive.order = part.integer("order", 0, {-1'000'000, 1'000'000});

    const std::string field = part.text("field", "");
    primitive.field = static_cast<uint32_t>(std::ranges::find(fields, field) - fields.begin());
    if (primitive.field == fields.size())
        fields.push_back(field);
    return primitive;
}

} // namespace antumbra::scene
