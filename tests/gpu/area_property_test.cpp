// What holds for every right share of an area light, on the device: bounds, monotony, and that the way a scene is written down, where it
// lies and how large it is make no difference. A tenth of the long run's number where ANTUMBRA_LONG is not set.
#include "gpu/area_runner.h"
#include "gpu/area_scenes.h"
#include "gpu/device_fixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace antumbra {
namespace {

using app::AreaProblem;
using glm::dvec3;
using shader::AreaAnswer;

constexpr uint32_t kBatch = 1024;

uint32_t problemCount() { return std::getenv("ANTUMBRA_LONG") != nullptr ? 100000 : 10000; }

class AreaProperty : public DeviceTest
{
protected:
    using Make = std::function<AreaProblem(RandomInputs&)>;
    using Change = std::function<AreaProblem(RandomInputs&, const AreaProblem&)>;
    using Judge = std::function<void(uint32_t, const AreaAnswer&, const AreaAnswer&)>;

    /// Calls judge(index, answer, answer to the problem as changed), unless something does not fit.
    void compare(uint32_t count, const Make& make, const Change& change, const Judge& judge)
    {
        RandomInputs random(7);
        AreaRunner runner(device());
        std::vector<AreaProblem> problems, changed;
        uint32_t judged = 0;
        for (uint32_t first = 0; first < count && !HasFailure(); first += kBatch) {
            problems.clear();
            changed.clear();
            for (uint32_t i = first; i < std::min(first + kBatch, count); ++i) {
                problems.push_back(make(random));
                changed.push_back(change(random, problems.back()));
            }
            const std::vector<AreaAnswer> before = runner.run(problems), after = runner.run(changed);
            for (uint32_t i = 0; i < problems.size(); ++i)
                if (before[i].fallbacks + after[i].fallbacks == 0) {
                    ++judged;
                    judge(first + i, before[i], after[i]);
                }
        }
        EXPECT_GE(judged, count - count / 200) << "the rest does not fit";
    }

    void expectNoChange(uint32_t count, const Make& make, const Change& change)
    {
        double worst = 0;
        uint32_t shadowed = 0;
        compare(count, make, change, [&](uint32_t index, const AreaAnswer& before, const AreaAnswer& after) {
            EXPECT_NEAR(before.unoccluded, after.unoccluded, kTolerance) << index;
            EXPECT_NEAR(before.shadowed, after.shadowed, kTolerance) << index;
            worst = std::max(
                {worst, std::abs(double{before.unoccluded} - after.unoccluded), std::abs(double{before.shadowed} - after.shadowed)});
            shadowed += before.shadowed < before.unoccluded * 0.99f ? 1 : 0;
        });
        EXPECT_GT(shadowed, count / 10) << "there is little to change";
        RecordProperty("worst", fmt::format("{:.1e}", worst));
    }
};

AreaProblem common(RandomInputs& random) { return commonAreaProblem(random, 4); }

TEST_F(AreaProperty, AnotherOccluderNeverBrightens)
{
    uint32_t darker = 0;
    compare(
        problemCount(), common,
        [](RandomInputs& random, const AreaProblem& problem) {
            AreaProblem more = problem;
            const double share = random.uniform(0.2, 1.1);
            const dvec3 light(problem.light.vertices[0]), point(problem.position);
            more.occluders.push_back(
                {randomBody(random, glm::mix(point, light, share) + random.direction() * 0.2, random.uniform(0.02, 0.5))});
            return more;
        },
        [&](uint32_t index, const AreaAnswer& before, const AreaAnswer& after) {
            EXPECT_EQ(after.unoccluded, before.unoccluded) << index;
            EXPECT_LE(after.shadowed, before.shadowed + 2e-6f) << index; // two roundings of a sum
            darker += after.shadowed < before.shadowed ? 1 : 0;
        });
    EXPECT_GT(darker, problemCount() / 5);
}

TEST_F(AreaProperty, SplittingALightChangesNothing)
{
    const auto make = [](RandomInputs& random) {
        AreaScene scene = openScene(random, LightKind::Square);
        for (uint32_t i = 1 + random.index(3); i > 0; --i)
            addCommonOccluder(scene, random);
        return scene.problem;
    };
    const uint32_t count = problemCount();
    RandomInputs random(8);
    AreaRunner runner(device());
    for (uint32_t first = 0; first < count && !HasFailure(); first += kBatch) {
        std::vector<AreaProblem> wholes, parts;
        for (uint32_t i = first; i < std::min(first + kBatch, count); ++i) {
            wholes.push_back(make(random));
            const std::vector<vec3>& v = wholes.back().light.vertices;
            const float share = static_cast<float>(random.uniform(0.1, 0.9));
            const dvec3 low(glm::mix(v[0], v[1], share)), high(glm::mix(v[3], v[2], share));
            for (const scene::ConvexBody& part : {quad(dvec3(v[0]), low, high, dvec3(v[3])), quad(low, dvec3(v[1]), dvec3(v[2]), high)}) {
                parts.push_back(wholes.back());
                parts.back().light = part;
            }
        }
        const std::vector<AreaAnswer> whole = runner.run(wholes), part = runner.run(parts);
        for (uint32_t i = 0; i < wholes.size(); ++i) {
            EXPECT_NEAR(whole[i].unoccluded, part[2 * i].unoccluded + part[2 * i + 1].unoccluded, kTolerance) << first + i;
            EXPECT_NEAR(whole[i].shadowed, part[2 * i].shadowed + part[2 * i + 1].shadowed, kTolerance) << first + i;
        }
    }
}

TEST_F(AreaProperty, SplittingABoxChangesNothing)
{
    const auto make = [](RandomInputs& random) {
        AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
        const dvec3 aside = random.direction() * 0.5 * scene.lightSize;
        scene.add(turnedBody(random, boxShape(), scene.onTheWay(random.uniform(0.3, 0.8)) + aside, random.uniform(0.1, 0.4)));
        return scene.problem;
    };
    expectNoChange(problemCount(), make, [](RandomInputs& random, const AreaProblem& problem) {
        AreaProblem split = problem;
        const scene::ConvexBody box = problem.occluders[0].body;
        const auto share = static_cast<float>(random.uniform(0.1, 0.9));
        split.occluders.push_back({box});
        for (uint32_t i = 0; i < 8; i += 2) { // along X: from each corner to its neighbour
            const vec3 between = glm::mix(box.vertices[i], box.vertices[i + 1], share);
            split.occluders[0].body.vertices[i + 1] = between;
            split.occluders[1].body.vertices[i] = between;
        }
        return split;
    });
}

TEST_F(AreaProperty, BodiesAreTheirTriangles)
{
    const auto make = [](RandomInputs& random) {
        AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kPlanarKinds)));
        const dvec3 aside = random.direction() * 0.5 * scene.lightSize;
        scene.add(randomBody(random, scene.onTheWay(random.uniform(0.5, 0.8)) + aside, random.uniform(0.1, 0.4))); // not around the point
        return scene.problem;
    };
    expectNoChange(problemCount() / 4, make, [](RandomInputs& random, const AreaProblem& problem) {
        AreaProblem triangles = inTriangles(problem);
        const bool isFrontOnly = random.index(2) == 0; // of closed meshes both will do
        for (app::AreaOccluder& each : triangles.occluders)
            each.isFrontOnly = isFrontOnly;
        return triangles;
    });
}

TEST_F(AreaProperty, MotionScaleAndMirrorsChangeNothing)
{
    expectNoChange(problemCount(), common, [](RandomInputs& random, const AreaProblem& problem) {
        const double scale = random.logUniform(1e-3, 1e3);
        const glm::dmat3 mirror(dvec3(random.index(2) == 0 ? -1 : 1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1));
        return moved(problem, randomTurn(random, random.direction()) * mirror * scale, random.direction() * 2.0 * scale);
    });
}

// The device gets bodies before a mirror, and the mirror as their place in the world.
TEST_F(AreaProperty, MirroredPlacesChangeNothing)
{
    RandomInputs random(9);
    std::vector<AreaProblem> problems;
    for (uint32_t i = 0; i < 2000; ++i)
        problems.push_back(commonAreaProblem(random, 3));
    AreaRunner runner(device());
    const mat4 mirror(2, 0, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0, 0, 0, 0, 0, 1); // exact, as is its inverse
    ASSERT_LT(glm::determinant(glm::mat3(glm::inverse(mirror))), 0);
    const std::vector<AreaAnswer> plain = runner.run(problems), placed = runner.run(problems, kAllPieces, mirror);
    for (uint32_t i = 0; i < problems.size(); ++i) {
        EXPECT_NEAR(plain[i].unoccluded, placed[i].unoccluded, 2e-6) << i; // loops begin elsewhere
        EXPECT_NEAR(plain[i].shadowed, placed[i].shadowed, 2e-6) << i;
    }
}

TEST_F(AreaProperty, TheOrderOfOccludersDoesNotMatter)
{
    const auto make = [](RandomInputs& random) { return commonAreaProblem(random, 8); };
    expectNoChange(problemCount(), make, [](RandomInputs& random, const AreaProblem& problem) {
        AreaProblem shuffled = problem;
        for (uint32_t i = static_cast<uint32_t>(shuffled.occluders.size()); i > 1; --i)
            std::swap(shuffled.occluders[i - 1], shuffled.occluders[random.index(i)]);
        return shuffled;
    });
}

TEST_F(AreaProperty, ALightDoesNotHideItself)
{
    const auto make = [](RandomInputs& random) {
        AreaScene scene = openScene(random, static_cast<LightKind>(random.index(kLightKinds)));
        addCommonOccluder(scene, random);
        return scene.problem;
    };
    expectNoChange(problemCount(), make, [](RandomInputs& random, const AreaProblem& problem) {
        AreaProblem twice = problem;
        twice.occluders.insert(twice.occluders.begin() + random.index(2), {{problem.light}});
        return twice;
    });
}

} // namespace
} // namespace antumbra
