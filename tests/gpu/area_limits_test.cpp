// The ends of the area lights' method on the device: what is wholly hidden, what is left to samples, and what does not fit.
#include "gpu/area_runner.h"
#include "gpu/area_scenes.h"
#include "gpu/area_twin.h"
#include "gpu/device_fixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace antumbra {
namespace {

using app::AreaProblem;
using glm::dvec3;
using shader::AreaAnswer;

class AreaLimits : public DeviceTest
{
};

/// Six thin boxes around [-1, 1]^3, which overlap along its edges.
std::vector<scene::ConvexBody> slabsAround(const Placement& place)
{
    std::vector<scene::ConvexBody> slabs;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            dvec3 centre(0), half(1.05);
            centre[axis] = side;
            half[axis] = 0.05;
            slabs.push_back(placed(boxShape(), [&](const dvec3& v) { return place(centre + half * v); }));
        }
    return slabs;
}

// In narrow lobes, which enlarge rounding, sums of many pieces may leave a millionth: 1 of 3000 do.
TEST_F(AreaLimits, ALightInAClosedBoxGivesNothingOutside)
{
    const auto isNarrow = [](uint32_t index) { return index % 4 == 0; };
    const uint32_t count = std::getenv("ANTUMBRA_LONG") != nullptr ? 100000 : 4000;
    RandomInputs random(12);
    std::vector<AreaProblem> problems;
    for (uint32_t i = 0; i < count; ++i) {
        AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
        if (!isNarrow(i))
            setLobe(scene, random, 0.2);
        const double size = std::min(2 * scene.lightSize, 0.5 * glm::distance(scene.point, scene.lightCentre));
        scene.problem.light =
            lightBody(random, static_cast<LightKind>(random.index(kLightKinds)), scene.lightCentre, scene.point, 0.4 * size);
        scene.problem.isTwoSided = scene.problem.light.isPlanar;
        const Placement place{randomTurn(random, random.direction()), dvec3(size), scene.lightCentre};
        if (i % 3 == 0)
            for (scene::ConvexBody& slab : slabsAround(place))
                scene.add(std::move(slab));
        else if (i % 3 == 1)
            scene.addTriangles(placed(boxShape(), place), i % 2 == 0);
        else
            scene.add(placed(boxShape(), place));
        problems.push_back(scene.problem);
    }
    AreaRunner runner(device());
    uint32_t lit = 0;
    for (uint32_t first = 0; first < count; first += 1000) {
        const std::vector<AreaAnswer> found = runner.run(std::span(problems).subspan(first, 1000));
        for (uint32_t i = 0; i < found.size(); ++i) {
            EXPECT_LE(found[i].shadowed, isNarrow(first + i) ? 2e-6f : 0.0f) << first + i;
            lit += found[i].unoccluded > 0.01f ? 1 : 0;
        }
    }
    EXPECT_GT(lit, count / 4) << "boxes hide little";
}

// With few pieces the rest is left to eight points a triangle of what is left: coarse for one point, right in the mean. Measured, of 1, 4
// and 16 pieces and up to 8 occluders, as shares of the light: mean -0.0016, -0.0012, -0.0004; root mean square 0.036, 0.021, 0.0098; the
// worst 0.43, 0.49, 0.14.
TEST_F(AreaLimits, SampledPiecesStayInRangeAndAreRightInTheMean)
{
    struct Bound
    {
        uint32_t pieces;
        double mean, rms, worst;
    };
    constexpr Bound kBounds[] = {{1, 4e-3, 0.06, 0.6}, {4, 4e-3, 0.04, 0.6}, {16, 1e-3, 0.015, 0.25}};
    constexpr uint32_t kCount = 4000;
    RandomInputs random(13);
    std::vector<AreaProblem> problems;
    for (uint32_t i = 0; i < kCount; ++i)
        problems.push_back(commonAreaProblem(random, 8));
    AreaRunner runner(device());
    const std::vector<AreaAnswer> exact = runner.run(problems);
    uint32_t sampledBefore = kCount;
    for (const Bound& bound : kBounds) {
        const std::vector<AreaAnswer> found = runner.run(problems, bound.pieces);
        double sum = 0, squares = 0, worst = 0;
        uint32_t sampled = 0;
        for (uint32_t i = 0; i < kCount; ++i) {
            EXPECT_EQ(found[i].unoccluded, exact[i].unoccluded) << i;
            EXPECT_GE(found[i].shadowed, 0) << i;
            EXPECT_LE(found[i].shadowed, found[i].unoccluded) << i;
            EXPECT_TRUE(found[i].fallbacks > 0 || found[i].shadowed == exact[i].shadowed) << i;
            sampled += found[i].fallbacks > 0 ? 1 : 0;
            const double off = (found[i].shadowed - exact[i].shadowed) / std::max(exact[i].unoccluded, 1e-3f);
            sum += off;
            squares += off * off;
            worst = std::max(worst, std::abs(off));
        }
        EXPECT_LT(sampled, sampledBefore) << "more pieces leave less to samples";
        EXPECT_GT(sampled, 0u);
        EXPECT_NEAR(sum / kCount, 0, bound.mean) << bound.pieces;
        EXPECT_LT(std::sqrt(squares / kCount), bound.rms) << bound.pieces;
        EXPECT_LT(worst, bound.worst) << bound.pieces;
        RecordProperty(fmt::format("of_{}_pieces", bound.pieces), fmt::format("mean {:.1e} rms {:.1e} worst {:.1e} sampled {}",
                                                                              sum / kCount, std::sqrt(squares / kCount), worst, sampled));
        sampledBefore = sampled;
    }
}

/// A square of 2 m by 2 m, 1 m over the point.
AreaScene squareScene()
{
    AreaScene scene;
    scene.lightCentre = {0, 0, 1};
    scene.problem.lobe = {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)};
    scene.problem.light = quad({-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1});
    return scene;
}

/// A box whose face at +Z is of three triangles, and of one without area between them, along a diagonal.
scene::ConvexBody boxWithEmptyFace()
{
    std::vector<vec3> vertices = boxShape().vertices; // the face is 4 5 7 6
    vertices.emplace_back(0, 0, 1);
    const std::vector<scene::Loop> faces{{4, 7, 8},    {4, 5, 7},    {4, 8, 6},    {8, 7, 6},   {0, 2, 3, 1},
                                         {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return scene::makeBody(vertices, faces);
}

// Such a face is neither seen nor not: the silhouette runs around it as well.
TEST_F(AreaLimits, FacesWithoutAreaChangeNothing)
{
    RandomInputs random(14);
    std::vector<AreaProblem> plain, empty;
    for (uint32_t i = 0; i < 2000; ++i) {
        AreaScene scene = openScene(random, LightKind::Box);
        const bool isLight = i % 2 == 0;
        const Placement place{randomTurn(random, scene.point - scene.lightCentre + random.direction()), dvec3(0.3),
                              isLight ? scene.lightCentre : scene.onTheWay(0.6)};
        for (const scene::ConvexBody& box : {boxShape(), boxWithEmptyFace()}) {
            AreaScene made = scene;
            if (isLight)
                made.problem.light = placed(box, place);
            else
                made.add(placed(box, place));
            (box.faces.size() == 6 ? plain : empty).push_back(made.problem);
        }
    }
    AreaRunner runner(device());
    const std::vector<AreaAnswer> expected = runner.run(plain), found = runner.run(empty);
    for (uint32_t i = 0; i < plain.size(); ++i) {
        EXPECT_NEAR(found[i].unoccluded, expected[i].unoccluded, kTolerance) << i;
        EXPECT_NEAR(found[i].shadowed, expected[i].shadowed, kTolerance) << i;
    }
}

TEST_F(AreaLimits, OccludersWithoutRoomAreTold)
{
    AreaRunner runner(device());
    AreaScene round = squareScene(); // its silhouette has more edges than one body may have
    round.add(placed(prismShape(150), Placement{.scale = dvec3(0.2, 0.2, 0.01), .position = dvec3(0, 0, 0.5)}));
    EXPECT_GT(runner.run(round.problem).fallbacks, 0u);

    AreaScene many = squareScene(); // more cards than there are places, each over a bit of the light
    for (int x = 0; x < 21; ++x)
        for (int y = 0; y < 21; ++y) {
            const Placement place{.scale = dvec3(0.01), .position = dvec3(0.04 * (x - 10), 0.04 * (y - 10), 0.5)};
            many.add(placed(squareShape(), place));
        }
    const AreaAnswer lost = runner.run(many.problem);
    EXPECT_GT(lost.fallbacks, 0u);
    EXPECT_LE(lost.shadowed, lost.unoccluded);
    many.problem.occluders.resize(60);
    const AreaAnswer fits = runner.run(many.problem);
    EXPECT_EQ(fits.fallbacks, 0u);
    EXPECT_NEAR(fits.shadowed, areaTwin<double>(many.problem).visible, kTolerance);

    AreaScene edges = squareScene(); // all edges are taken when the last comes: it has none left at all
    for (int i = 0; i < 17; ++i)
        edges.add(placed(polygonShape(99), Placement{.scale = dvec3(0.01), .position = dvec3(0.04 * (i - 8), 0, 0.5)}));
    EXPECT_GT(runner.run(edges.problem).fallbacks, 0u);
}

// The hidden part has a corner for each of the occluder's: more than a polygon's place has. Its light is left to samples, which see it.
TEST_F(AreaLimits, HiddenPartsWithoutRoomAreSampled)
{
    AreaScene scene = squareScene();
    scene.add(placed(polygonShape(100), Placement{.scale = dvec3(0.3), .position = dvec3(0, 0, 0.5)}));
    const AreaAnswer found = AreaRunner(device()).run(scene.problem);
    const AreaShares exact = areaTwin<double>(scene.problem);
    EXPECT_GT(found.fallbacks, 0u);
    EXPECT_NEAR(found.unoccluded, exact.unoccluded, kTolerance);
    EXPECT_NEAR(found.shadowed, exact.visible, 0.15 * exact.unoccluded);
    EXPECT_LT(found.shadowed, found.unoccluded);
}

TEST_F(AreaLimits, LightsWithoutRoomAreTold)
{
    AreaRunner runner(device());
    AreaScene scene = squareScene();
    const glm::dmat3 down(dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(0, 0, -1));
    scene.problem.light = placed(polygonShape(100), Placement{down, dvec3(1), dvec3(0, 0, 1)});
    const AreaAnswer flat = runner.run(scene.problem);
    EXPECT_GT(flat.fallbacks, 0u);
    EXPECT_NEAR(flat.unoccluded, areaTwin<double>(scene.problem).unoccluded, 2e-3) << "of 62 corners all around";
    EXPECT_EQ(flat.shadowed, flat.unoccluded);

    scene.problem.light = placed(globeShape(), Placement{.scale = dvec3(0.5), .position = dvec3(0, 0, 1)});
    const AreaAnswer solid = runner.run(scene.problem);
    EXPECT_GT(solid.fallbacks, 0u);
    EXPECT_EQ(solid.unoccluded, 0);
}

} // namespace
} // namespace antumbra
