// The shadow on the ground below what moves, as light that the ground does not send up: on a ball, against the integral over the ground.
#include "truth/baked.h"

#include <gmock/gmock.h>

namespace antumbra::truth {
namespace {

using glm::dvec3;
using render::Aov;
using scene::MeshKind;
using testing::Contains;
using testing::Not;

constexpr std::string_view kPass = "ground shadow";
constexpr graph::AbsentPass kWithoutBounces{.name = kPass, .reason = "no light bounces in the bake", .unread = {}};
using Absent = std::span<const graph::AbsentPass>;
constexpr double kPiExact = std::numbers::pi;
constexpr double kAlbedo = 0.6; // of the ground
constexpr double kRadius = 0.4; // of the ball

/// Light of an open plane under a sky of 1 W/(m^2 sr): it comes from above, and what the ground sends up of it from below.
bake::Bake planeBake(uint32_t bounces)
{
    const auto cell = [](uint32_t j, uint32_t i) {
        const double mean = (1 + kAlbedo) / 2, difference = (1 - kAlbedo) / 2;
        return i != 0 ? 0 : j == 0 ? mean : j == 1 ? difference * std::sqrt(3.0) / 2 : 0;
    };
    bake::Bake bake = bakeOf(3, {[](uint32_t i) { return i == 0 ? openTexel(0) : 0; }, cell});
    bake.settings.bounces = bounces;
    return bake;
}

/// A black ball, so that it sends nothing to the ground.
scene::SceneFile ballAt(vec3 centre)
{
    scene::SceneFile scene = emptyScene();
    scene.camera = {.position = centre + vec3(1.6f, -0.25f, 0.8f), .target = centre};
    scene.camera.position.y = std::max(scene.camera.position.y, 0.2f);
    scene.environment = scene::SceneEnvironment{.sky = vec3(1)};
    scene.entities = {ground(), movingShape(MeshKind::Sphere, centre, vec3(static_cast<float>(2 * kRadius)))};
    scene.entities.back().material = scene::Material{.albedo = vec4(0, 0, 0, 1)};
    return scene;
}

/// Irradiance that the ground does not send to a point of the ball, W/m^2. A ball wholly over the horizon hides its form factor.
double missedBy(const dvec3& position, const dvec3& normal, double height)
{
    constexpr int kRings = 160, kSpokes = 64;
    constexpr double kFar = 40;
    double sum = 0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double inner = kFar * std::pow(ring / double{kRings}, 3), outer = kFar * std::pow((ring + 1) / double{kRings}, 3);
        const double radius = (inner + outer) / 2, area = kPiExact * (outer * outer - inner * inner) / kSpokes;
        const double hidden = kRadius * kRadius * height / std::pow(height * height + radius * radius, 1.5);
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const double turn = 2 * kPiExact * spoke / kSpokes;
            const dvec3 to = dvec3(radius * std::cos(turn), 0, radius * std::sin(turn)) - position;
            const double distance2 = glm::dot(to, to);
            sum += kAlbedo * hidden * std::max(glm::dot(to, normal), 0.0) * -to.y / (distance2 * distance2) * area;
        }
    }
    return sum;
}

/// What the ball is found to lack for the ground, and what it should; the place of contact, where the integral is not finite, left out.
struct BallPixel
{
    double found, expected;
};

class GroundShadow : public BackendTest<Backend>
{
protected:
    /// A ball in the open hides next to nothing from itself, whatever the light: the difference is the ground's.
    std::vector<BallPixel> ballAndGround(vec3 centre)
    {
        const scene::ImageF lacks = occluded(bounced_, centre), hides = occluded(direct_, centre);
        ShownGround shown(device(), &bounced_, ballAt(centre));
        const scene::ImageF depth = shown.capture(Aov::Depth);
        std::vector<BallPixel> pixels;
        for (const size_t pixel : surfaceOf(depth)) {
            const uvec2 place(pixel % Shown::kExtent.x, pixel / Shown::kExtent.x);
            const dvec3 position(positionAt(shown.view().camera, Shown::kExtent, place, depth.values[pixel]));
            const dvec3 radial = position - dvec3(centre);
            if (glm::length(radial) < 1.02 * kRadius && position.y > 0.1)
                pixels.push_back({double{lacks.values[3 * pixel]} - double{hides.values[3 * pixel]},
                                  missedBy(position, glm::normalize(radial), double{centre.y})});
        }
        EXPECT_GT(pixels.size(), 400u) << "the ball is in view";
        return pixels;
    }

    /// Checks that the pass runs where light bounces, and no other time.
    scene::ImageF occluded(const bake::Bake& bake, vec3 centre)
    {
        ShownGround shown(device(), &bake, ballAt(centre));
        shown.set("occlusion.backend", backend().name);
        scene::ImageF image = shown.capture(Aov::Occluded);
        const bool bounces = bake.settings.bounces > 0;
        EXPECT_EQ(std::ranges::count(stepsOf(shown), kPass), bounces ? 1 : 0);
        EXPECT_THAT(shown.renderer().report().absent,
                    bounces ? Not(Contains(kWithoutBounces)) : testing::Matcher<Absent>(Contains(kWithoutBounces)));
        return image;
    }

private:
    const bake::Bake bounced_ = planeBake(2), direct_ = planeBake(0);
};

TEST_P(GroundShadow, IsMissedByTheBallThatCastsIt)
{
    for (const float height : {0.4f, 0.45f, 0.6f, 1.0f}) {
        double squares = 0, expected2 = 0;
        for (const BallPixel& pixel : ballAndGround({0, height, 0})) {
            squares += (pixel.found - pixel.expected) * (pixel.found - pixel.expected);
            expected2 += pixel.expected * pixel.expected;
        }
        EXPECT_LT(std::sqrt(squares / expected2), 0.3) << height;
    }
}

TEST_P(GroundShadow, IsNotThereWhereThereIsNoGround)
{
    for (const BallPixel& pixel : ballAndGround({4.5f, 0.5f, 0}))
        ASSERT_EQ(pixel.found, 0);
}

INSTANTIATE_TEST_SUITE_P(Truth, GroundShadow, testing::Values(kRayQuery, kComputeBvh), backendName);

} // namespace
} // namespace antumbra::truth
