// Reflections of area lights on metal, against the GGX reflection itself: by the reference on the device, and by sums over the light in
// double, where what linearly transformed cosines are off by is known alone.
#include "bake/ltc.h"
#include "truth/shown.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace antumbra::truth {
namespace {

using glm::dvec3;
using render::Aov;

constexpr double kMetal = 0.8; // albedo of the floor
const vec3 kLampAt{0, 1, 0};
constexpr double kLampSide = 0.4;
constexpr double kRadiance = 10;
const dvec3 kBlockAt{0.14, 0.5, 0.5}, kBlockHalf{0.1};

const bake::LtcTables& tables()
{
    static const bake::LtcTables loaded = bake::loadLtcTables(projectPath("assets") / "fits");
    return loaded;
}

bool isBlocked(const dvec3& from, const dvec3& to)
{
    const dvec3 way = to - from, a = (kBlockAt - kBlockHalf - from) / way, b = (kBlockAt + kBlockHalf - from) / way;
    const dvec3 enters = glm::min(a, b), leaves = glm::max(a, b);
    const double first = std::max({enters.x, enters.y, enters.z, 0.0}), last = std::min({leaves.x, leaves.y, leaves.z, 1.0});
    return first < last;
}

/// Radiance towards the eye: by the reflection itself, and by the cosine that stands for it.
struct Reflected
{
    double truth = 0, fitted = 0;
};

/// The sum over the light; the floor's normal is +Y.
Reflected reflected(const dvec3& point, const dvec3& eye, double roughness)
{
    constexpr int kSide = 96;
    const dvec3 up(0, 1, 0), toEye = glm::normalize(eye - point);
    const dvec3 across = glm::normalize(toEye - up * toEye.y), beside = glm::cross(up, across);
    const auto local = [&](const dvec3& v) { return dvec3(glm::dot(v, across), glm::dot(v, beside), v.y); };
    const dvec3 view = local(toEye);
    const bake::LtcTexel texel = bake::lookUp(tables(), roughness, view.z);
    const bake::Ltc cosine(texel.matrix);
    const double amplitude = kMetal * texel.amplitude.x + (1 - kMetal) * texel.amplitude.y;
    Reflected sum;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec2 share = (glm::dvec2(glm::ivec2(i % kSide, i / kSide)) + 0.5) / double{kSide} - 0.5;
        const dvec3 on = dvec3(kLampAt) + kLampSide * dvec3(share.x, 0, share.y), to = on - point;
        if (isBlocked(point, on))
            continue;
        const dvec3 direction = glm::normalize(to), light = local(direction);
        const double solidAngle = kLampSide * kLampSide / (kSide * kSide) * direction.y / glm::dot(to, to);
        const double grazing = std::pow(1 - glm::dot(view, glm::normalize(view + light)), 5.0);
        sum.truth += solidAngle * light.z * bake::ggxReflection(view, light, roughness * roughness) * (kMetal + (1 - kMetal) * grazing);
        sum.fitted += solidAngle * amplitude * cosine.density(light);
    }
    return {kRadiance * sum.truth, kRadiance * sum.fitted};
}

scene::SceneFile metalFloor(float roughness)
{
    scene::SceneFile scene = darkScene();
    scene.entities[0].material = scene::Material{.albedo = vec3(kMetal), .roughness = roughness, .metallic = 1};
    scene.entities.push_back(lampAt(kLampAt, vec3(kRadiance)));
    scene.entities.push_back(blocker(vec3(kBlockAt), vec3(2.0 * kBlockHalf)));
    return scene;
}

class AreaGlossy : public DeviceTest, public testing::WithParamInterface<float>
{
protected:
    static constexpr uint32_t kSamples = 8192;

    /// A place on the floor that is seen.
    struct Place
    {
        size_t pixel;
        dvec3 point;
    };
    /// The lamp is drawn over what lies behind it.
    static bool isBehindLamp(const vec3& eye, const vec3& point)
    {
        const vec3 level = glm::mix(point, eye, (kLampAt.y - point.y) / (eye.y - point.y)) - kLampAt;
        return std::max(std::abs(level.x), std::abs(level.z)) < 0.52 * kLampSide;
    }
    static std::vector<Place> someOf(const render::CameraView& camera, const scene::ImageF& depth)
    {
        std::vector<Place> some;
        for (size_t pixel = 0; pixel < depth.values.size(); pixel += 7) {
            const uvec2 at(pixel % depth.width, pixel / depth.width);
            const vec3 point = positionAt(camera, Shown::kExtent, at, depth.values[pixel]);
            if (depth.values[pixel] > 0 && std::abs(point.y) < 1e-3f && !isBehindLamp(camera.eye, point))
                some.push_back({pixel, dvec3(point)});
        }
        return some;
    }
};

double rootOfMean(double squares, size_t count) { return std::sqrt(squares / static_cast<double>(count)); }

TEST_P(AreaGlossy, ErrorsAgainstGgxAreThoseOfTheFit)
{
    const float roughness = GetParam();
    Shown shown(device(), metalFloor(roughness));
    const scene::ImageF depth = shown.capture(Aov::Depth);
    shown.set("area.shadow", "analytic");
    const scene::ImageF found = shown.capture(Aov::Color);
    shown.set("area.shadow", "reference");
    shown.set("reference.samples", std::to_string(kSamples));
    do
        shown.draw();
    while (shown.renderer().referenceSamples().value() < kSamples);
    const scene::ImageF truth = shown.capture(Aov::Color);

    const std::vector<Place> some = someOf(shown.view().camera, depth);
    ASSERT_GT(some.size(), 100u);
    double mean = 0, measured = 0, explained = 0, unexplained = 0, truths = 0;
    for (const auto& [pixel, point] : some) {
        const Reflected sum = reflected(point, dvec3(shown.view().camera.eye), roughness);
        const double shownTruth = pixelOf(truth, pixel).x, error = pixelOf(found, pixel).x - shownTruth, fit = sum.fitted - sum.truth;
        mean += shownTruth / static_cast<double>(some.size());
        measured += error * error;
        explained += fit * fit;
        unexplained += (error - fit) * (error - fit);
        truths += (shownTruth - sum.truth) * (shownTruth - sum.truth);
    }
    measured = rootOfMean(measured, some.size()) / mean;
    explained = rootOfMean(explained, some.size()) / mean;
    unexplained = rootOfMean(unexplained, some.size()) / mean;
    fmt::print("roughness {}: off by {:.2f} % of the mean, the fit by {:.2f} %, not explained {:.2f} %\n", roughness, 100 * measured,
               100 * explained, 100 * unexplained);
    EXPECT_LT(rootOfMean(truths, some.size()), 0.03 * mean) << "the device's truth is another";
    EXPECT_GT(measured, 1e-3);
    EXPECT_NEAR(measured / explained, 1, 0.2);
    EXPECT_LT(unexplained, 0.3 * explained);
}

INSTANTIATE_TEST_SUITE_P(Truth, AreaGlossy, testing::Values(0.2f, 0.4f, 0.6f, 0.8f, 1.0f),
                         [](const auto& test) { return "Roughness" + std::to_string(std::lround(10 * test.param)); });

} // namespace
} // namespace antumbra::truth
