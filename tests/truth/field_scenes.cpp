#include "truth/field_scenes.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace antumbra::truth {

namespace {

using glm::dvec3;
using scene::SDFOperation;
using scene::SDFPrimitive;
using scene::SDFShape;

const SDFPrimitive kFloor{.shape = SDFShape::Plane};

SDFPrimitive ball(vec3 centre, float radius) { return {.shape = SDFShape::Sphere, .centre = centre, .radius = radius}; }
SDFPrimitive box(vec3 centre, vec3 half) { return {.shape = SDFShape::Box, .centre = centre, .halfExtent = half}; }
SDFPrimitive rod(vec3 a, vec3 b, float radius) { return {.shape = SDFShape::Capsule, .centre = a, .end = b, .radius = radius}; }
SDFPrimitive ring(vec3 centre, vec3 axis, float major, float minor)
{
    return {.shape = SDFShape::Torus, .centre = centre, .direction = glm::normalize(axis), .radius = major, .minorRadius = minor};
}

SDFPrimitive without(SDFPrimitive primitive)
{
    primitive.operation = SDFOperation::Subtract;
    return primitive;
}

SDFPrimitive melted(SDFPrimitive primitive, float blend)
{
    primitive.operation = SDFOperation::SmoothUnion;
    primitive.blend = blend;
    return primitive;
}

/// Whether balls of the field's radius along the axis fill the cone towards the sphere: then all of it is seen.
bool isConeClear(const FieldSteps& steps, const dvec3& from, const dvec3& axis, double distance, double radius)
{
    const double widening = radius / std::sqrt(distance * distance - radius * radius);
    double t = 0;
    for (int i = 0; i < 300 && t < distance; ++i) {
        const double f = render::fieldDistance(steps, from + t * axis), wide = t * widening;
        if (f <= wide)
            return false;
        // The farthest place that the ball still covers from side to side.
        const double square = 1 + widening * widening;
        t += (std::sqrt(f * f * square - wide * wide) - wide * widening) / square;
    }
    return t >= distance;
}

/// Whether the way of `distance` metres along the unit direction is free of solids.
bool isClear(const FieldSteps& steps, const dvec3& from, const dvec3& direction, double distance, uint64_t* evaluations = nullptr)
{
    double t = 0;
    for (int i = 0; i < 2000 && t < distance; ++i) {
        const double f = render::fieldDistance(steps, from + t * direction);
        if (evaluations != nullptr)
            ++*evaluations;
        if (f < 1e-6)
            return false;
        t += std::max(f, 1e-5);
    }
    return true;
}

} // namespace

std::vector<FieldScene> fieldScenes()
{
    SDFPrimitive rounded = box({2.4f, 0.4f, -1.5f}, {0.4f, 0.3f, 0.4f});
    rounded.shape = SDFShape::RoundedBox;
    rounded.radius = 0.1f;
    return {
        {"prims",
         fieldOf({kFloor, ball({-1.6f, 0.7f, 0.2f}, 0.7f), box({0.1f, 0.6f, -0.6f}, {0.5f, 0.6f, 0.4f}),
                  ring({1.6f, 0.75f, 0.2f}, {0.3f, 0.2f, 1}, 0.55f, 0.2f), rod({-0.6f, 0.25f, 1.2f}, {0.5f, 0.5f, 1.5f}, 0.25f), rounded}),
         {3.2f, 5, 2.6f},
         0.8f,
         {0.3f, 3.2f, 6.2f},
         {0.2f, 0.3f, 0}},
        {"csg",
         fieldOf({box({-1.2f, 0.9f, 0}, {0.8f, 0.9f, 0.8f}), without(ball({-1, 1.2f, 0.5f}, 0.85f)), ball({1.3f, 0.6f, 0}, 0.6f),
                  melted(ball({1.9f, 1.3f, 0.1f}, 0.45f), 0.5f), melted(rod({1.3f, 0.4f, 0}, {2.6f, 0.3f, 0.9f}, 0.22f), 0.4f),
                  melted(ring({0.2f, 0.3f, 1.6f}, {0, 1, 0}, 0.6f, 0.18f), 0.2f), kFloor, box({0, 1.5f, -2.6f}, {4, 1.5f, 0.2f}),
                  without(box({0.6f, 1.6f, -2.6f}, {0.7f, 0.7f, 0.5f}))}),
         {-2.6f, 5.5f, 3.4f},
         1,
         {0.6f, 2.8f, 6.6f},
         {0.3f, 0.6f, 0}},
        {"thin",
         fieldOf({kFloor, ring({-1.7f, 1.1f, 0.4f}, {0.2f, 0.9f, 0.5f}, 0.7f, 0.07f), rod({0.2f, 0, -0.4f}, {0.2f, 2, -0.4f}, 0.05f),
                  rod({0.8f, 0, -0.4f}, {0.8f, 2, -0.4f}, 0.05f), rod({1.4f, 0, -0.4f}, {1.4f, 2, -0.4f}, 0.05f),
                  rod({0, 2, -0.4f}, {1.6f, 2, -0.4f}, 0.08f), box({2.5f, 0.9f, 0.2f}, {0.05f, 0.9f, 0.5f}),
                  ball({-0.5f, 0.3f, 1.3f}, 0.3f), rod({-2.8f, 0.1f, 1.6f}, {-1.2f, 0.1f, 2}, 0.1f)}),
         {2.2f, 5.2f, -3.8f},
         0.9f,
         {0.1f, 3.4f, 6},
         {0, 0.3f, 0.6f}},
        {"slabs",
         fieldOf({box({-1.3f, 1.2f, -0.3f}, {0.9f, 0.9f, 0.03f}), without(ball({-1.3f, 1.2f, -0.3f}, 0.45f)),
                  box({1.2f, 1.4f, -0.2f}, {0.8f, 0.03f, 0.7f}), box({1.2f, 0.9f, -0.2f}, {0.8f, 0.03f, 0.7f}),
                  rod({0.4f, 0, -0.9f}, {0.4f, 2.2f, -0.9f}, 0.03f), rod({2, 0, -0.9f}, {2, 2.2f, -0.9f}, 0.03f),
                  box({-0.2f, 0.5f, 1}, {0.03f, 0.5f, 0.5f}), kFloor}),
         {-1, 5.4f, -3.6f},
         0.7f,
         {0.1f, 3.4f, 6},
         {0, 0.3f, 0.6f}},
    };
}

std::vector<FieldReceiver> receiversOf(const FieldScene& scene, uvec2 extent)
{
    const dvec3 eye(scene.eye), forward = glm::normalize(dvec3(scene.target) - eye), right = glm::normalize(glm::cross(forward, {0, 1, 0})),
                                up = glm::cross(right, forward);
    const double tangent = std::tan(0.45);
    const auto distanceAt = [&](const dvec3& p) { return render::fieldDistance(scene.steps, p); };
    std::vector<FieldReceiver> receivers;
    for (uint32_t row = 0; row < extent.y; ++row)
        for (uint32_t column = 0; column < extent.x; ++column) {
            const double x = (2 * column + 1.0 - extent.x) / extent.y * tangent, y = (1.0 - (2 * row + 1.0) / extent.y) * tangent;
            const dvec3 direction = glm::normalize(forward + x * right + y * up);
            double t = 0, f = 1;
            for (int i = 0; i < 500 && t < 40 && f > 1e-6; ++i) {
                f = distanceAt(eye + t * direction);
                t += f;
            }
            if (f > 1e-6)
                continue;
            const dvec3 surface = eye + t * direction;
            dvec3 normal(0);
            for (int axis = 0; axis < 3; ++axis) {
                dvec3 nudge(0);
                nudge[axis] = 1e-5;
                normal[axis] = distanceAt(surface + nudge) - distanceAt(surface - nudge);
            }
            normal = glm::normalize(normal);
            receivers.push_back({size_t{row} * extent.x + column, surface + 1e-3 * normal, normal});
        }
    return receivers;
}

FieldQuad quadOf(const FieldScene& scene)
{
    const dvec3 centre(scene.light), facing = glm::normalize(dvec3(scene.target) - centre),
                                     along = glm::normalize(glm::cross(facing, dvec3(0, 1, 0))), across = glm::cross(facing, along);
    return {centre - along - 0.5 * across, 2.0 * along, across};
}

QuadSeen quadSeen(const FieldSteps& steps, const FieldReceiver& at, const FieldQuad& quad, int side, uint32_t seed)
{
    RandomInputs random(seed);
    const dvec3 across = glm::cross(quad.a, quad.b);
    const double area = glm::length(across);
    QuadSeen seen;
    double sum = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double u = (i + random.uniform(0, 1)) / side, v = (j + random.uniform(0, 1)) / side;
            const dvec3 way = quad.corner + u * quad.a + v * quad.b - at.position;
            const double distance = glm::length(way),
                         facing = std::max(glm::dot(way, at.normal), 0.0) * std::abs(glm::dot(way, across) / area);
            const double weight = facing / std::pow(distance, 4) * area / (std::numbers::pi * side * side);
            seen.whole += weight;
            if (weight > 0)
                sum += isClear(steps, at.position, way / distance, distance, &seen.evaluations) ? weight : 0;
        }
    seen.share = seen.whole > 0 ? sum / seen.whole : 1;
    return seen;
}

double sphereSeen(const FieldSteps& steps, const dvec3& from, const dvec3& centre, double radius, int side, uint32_t seed)
{
    const double distance = glm::distance(from, centre);
    if (render::fieldDistance(steps, from) <= 0)
        return 0;
    if (distance <= radius)
        return 1;
    const dvec3 axis = (centre - from) / distance;
    if (isConeClear(steps, from, axis, distance, radius))
        return 1;
    RandomInputs random(seed);
    const dvec3 across = random.perpendicularTo(axis), other = glm::cross(axis, across);
    const double sine2 = radius * radius / (distance * distance), height = sine2 / (1 + std::sqrt(1 - sine2)); // of the cap
    int clear = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double down = (i + random.uniform(0, 1)) / side * height, turn = 2 * std::numbers::pi * (j + random.uniform(0, 1)) / side;
            const double cosine = 1 - down, sine = std::sqrt(down * (2 - down));
            const dvec3 direction = cosine * axis + sine * (std::cos(turn) * across + std::sin(turn) * other);
            const double reach = distance * cosine - std::sqrt(std::max(radius * radius - distance * distance * sine * sine, 0.0));
            clear += isClear(steps, from, direction, reach) ? 1 : 0;
        }
    return static_cast<double>(clear) / (side * side);
}

std::vector<double> eachOf(const std::vector<FieldReceiver>& receivers, const std::function<double(const FieldReceiver&, uint32_t)>& value)
{
    std::vector<double> values(receivers.size());
    std::atomic<size_t> next = 0;
    const auto work = [&] {
        for (size_t i = next++; i < receivers.size(); i = next++)
            values[i] = value(receivers[i], static_cast<uint32_t>(i));
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
        threads.emplace_back(work);
    threads.clear();
    return values;
}

} // namespace antumbra::truth
