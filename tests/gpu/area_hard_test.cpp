// The area lights' method on the device over random instances of each hard category: its range, its continuity, and its distance to the
// twin in double, which takes each occluder as triangles. The long run, of a million a category, is for the environment variable
// ANTUMBRA_LONG; it takes about half an hour, and is best run from this program itself, without the test driver's limits of time.
#include "gpu/area_cases.h"
#include "gpu/area_runner.h"
#include "gpu/area_twin.h"
#include "gpu/device_fixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace antumbra {
namespace {

constexpr uint32_t kOrdinaryCount = 6000, kMillion = 1000000; // 30 categories of 6000, each twice, take a minute on two cores
constexpr uint32_t kBatch = 8192;                             // problems in memory at one time

// A jitter of a millionth turns directions by some millionths; the narrowest lobes enlarge that to 1e-4.
constexpr double kMostChange = 1e-3;
// Planes that the point lies in are known to half a millionth of the body's reach (Guard 4): within it, sides are a matter of choice.
constexpr double kUndecided = 1e-6;
constexpr double kSlack = 1e-2;     // past the neighbours that were tried; what is 1e-6 away has two digits in floats
constexpr double kMostLost = 0.005; // share of instances that do not fit (AreaAnswer::fallbacks)

struct Tally
{
    uint32_t outOfRange = 0, jumps = 0, undecided = 0, lost = 0;
    double worstOff = 0, worstChange = 0;
};

double distanceOf(const shader::AreaAnswer& found, const AreaShares& expected)
{
    return std::max(std::abs(found.unoccluded - expected.unoccluded), std::abs(found.shadowed - expected.visible));
}

double distanceOf(const shader::AreaAnswer& a, const shader::AreaAnswer& b) { return distanceOf(a, AreaShares{b.unoccluded, b.shadowed}); }

bool isInRange(const shader::AreaAnswer& found)
{
    return std::isfinite(found.unoccluded) && std::isfinite(found.shadowed) && found.unoccluded <= 1 + 1e-6f && found.shadowed >= -1e-6f &&
           found.shadowed <= found.unoccluded + 1e-6f;
}

class AreaHard : public DeviceTest, public testing::WithParamInterface<AreaCategory>
{
protected:
    /// Of `count` instances, `twinned` are compared with the twin, and so are as many of those that jump.
    void examine(uint32_t count, uint32_t twinned);

private:
    void examineOne(uint32_t index, const app::AreaProblem& problem, const app::AreaProblem& shaken, const shader::AreaAnswer& found,
                    const shader::AreaAnswer& foundShaken);
    bool isBetweenNeighbours(const app::AreaProblem& problem, const shader::AreaAnswer& found);
    void compareWithTwin(uint32_t index, const app::AreaProblem& problem, const shader::AreaAnswer& found);

    Tally tally_;
    uint32_t twinEvery_ = 1, jumpsCompared_ = 0, mostJumpsCompared_ = 0;
    RandomInputs around_{3};
};

/// Whether the planes of all its faces hold the point: then a body neither shines nor blocks.
bool isEdgeOn(const scene::ConvexBody& body, const app::AreaProblem& problem)
{
    bool isLevel = true;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const glm::dvec3 from = glm::dvec3(problem.position) - glm::dvec3(body.vertices[body.loop(face)[0]]);
        isLevel = isLevel && std::abs(glm::dot(scene::faceNormal(body, face, body.vertices), from)) < kUndecided * sizeOf(problem);
    }
    return isLevel;
}

/// Whether a body holds the point: it hides all of a light then, also what of the light it holds, which its triangles do not.
bool isHeld(const app::AreaProblem& problem)
{
    return std::ranges::any_of(problem.occluders, [&](const app::AreaOccluder& occluder) {
        bool holds = !occluder.body.isPlanar;
        for (uint32_t face = 0; face < occluder.body.faces.size(); ++face) {
            const glm::dvec3 from = glm::dvec3(problem.position) - glm::dvec3(occluder.body.vertices[occluder.body.loop(face)[0]]);
            holds = holds && glm::dot(scene::faceNormal(occluder.body, face, occluder.body.vertices), from) < 0;
        }
        return holds;
    });
}

AreaShares sharesWithoutEdgeOn(app::AreaProblem problem)
{
    std::erase_if(problem.occluders, [&](const app::AreaOccluder& each) { return isEdgeOn(each.body, problem); });
    return isEdgeOn(problem.light, problem) ? AreaShares{} : areaTwin<double>(inTriangles(problem));
}

/// Whether the answer is between those of problems around it, as the twin has them.
bool AreaHard::isBetweenNeighbours(const app::AreaProblem& problem, const shader::AreaAnswer& found)
{
    constexpr int kMostNeighbours = 256;
    AreaShares least = areaTwin<double>(problem), most = least, shares = sharesWithoutEdgeOn(problem);
    for (int i = 0; i < kMostNeighbours; ++i) {
        least = {std::min(least.unoccluded, shares.unoccluded), std::min(least.visible, shares.visible)};
        most = {std::max(most.unoccluded, shares.unoccluded), std::max(most.visible, shares.visible)};
        const auto isBetween = [](double value, double low, double high) { return value >= low - kSlack && value <= high + kSlack; };
        if (isBetween(found.unoccluded, least.unoccluded, most.unoccluded) && isBetween(found.shadowed, least.visible, most.visible))
            return true;
        // Bodies that go through each other, or over the point, do so as a whole; what is flat is so to the jitter, and its triangles less.
        const Jitter kind = i % 2 == 0 ? Jitter::Bodies : GetParam().jitterKind;
        const app::AreaProblem neighbour = jittered(problem, around_, kUndecided * sizeOf(problem), kind);
        shares = areaTwin<double>(i % 4 < 2 ? neighbour : inTriangles(neighbour));
    }
    return false;
}

void AreaHard::compareWithTwin(uint32_t index, const app::AreaProblem& problem, const shader::AreaAnswer& found)
{
    const AreaShares expected = areaTwin<double>(inTriangles(problem));
    double off = distanceOf(found, expected);
    if (!GetParam().jump.empty() || isHeld(problem)) // there, triangles are as undecided as bodies
        off = std::min(off, distanceOf(found, areaTwin<double>(problem)));
    if (off <= GetParam().tolerance)
        tally_.worstOff = std::max(tally_.worstOff, off);
    else if (!GetParam().jump.empty() && isBetweenNeighbours(problem, found))
        ++tally_.undecided;
    else
        ADD_FAILURE() << fmt::format("{}: {} of {}, where the twin has {} of {}", index, found.shadowed, found.unoccluded, expected.visible,
                                     expected.unoccluded);
}

void AreaHard::examineOne(uint32_t index, const app::AreaProblem& problem, const app::AreaProblem& shaken, const shader::AreaAnswer& found,
                          const shader::AreaAnswer& foundShaken)
{
    for (const shader::AreaAnswer& each : {found, foundShaken})
        if (!isInRange(each)) {
            ++tally_.outOfRange;
            ADD_FAILURE() << fmt::format("{}: {} of {}", index, each.shadowed, each.unoccluded);
        }
    if (found.fallbacks + foundShaken.fallbacks > 0) {
        ++tally_.lost;
        return;
    }
    if (index % twinEvery_ == 0)
        compareWithTwin(index, problem, found);
    const double change = distanceOf(found, foundShaken);
    if (change <= kMostChange) {
        tally_.worstChange = std::max(tally_.worstChange, change);
        return;
    }
    ++tally_.jumps;
    if (GetParam().jump.empty())
        ADD_FAILURE() << fmt::format("{}: a jitter changes {} of {} to {} of {}", index, found.shadowed, found.unoccluded,
                                     foundShaken.shadowed, foundShaken.unoccluded);
    else if (jumpsCompared_++ < mostJumpsCompared_)
        compareWithTwin(index, shaken, foundShaken);
}

void AreaHard::examine(uint32_t count, uint32_t twinned)
{
    const AreaCategory& category = GetParam();
    twinEvery_ = count / twinned;
    mostJumpsCompared_ = twinned;
    RandomInputs random(1), shake(2);
    AreaRunner runner(device());
    std::vector<app::AreaProblem> problems, shaken;
    for (uint32_t first = 0; first < count && !HasFailure(); first += kBatch) {
        problems.clear();
        shaken.clear();
        for (uint32_t i = first; i < std::min(first + kBatch, count); ++i) {
            problems.push_back(category.make(random));
            shaken.push_back(jittered(problems.back(), shake, category.jitter * sizeOf(problems.back()), category.jitterKind));
        }
        const std::vector<shader::AreaAnswer> found = runner.run(problems), foundShaken = runner.run(shaken);
        for (uint32_t i = 0; i < problems.size(); ++i)
            examineOne(first + i, problems[i], shaken[i], found[i], foundShaken[i]);
    }
    EXPECT_LE(tally_.lost, kMostLost * count) << "do not fit";
    fmt::print("{}: {} instances, off by {:.1e} at most, changed by {:.1e}; {} jumps, {} undecided, {} do not fit\n", category.name, count,
               tally_.worstOff, tally_.worstChange, tally_.jumps, tally_.undecided, tally_.lost);
}

TEST_P(AreaHard, Holds) { examine(kOrdinaryCount, 200); }

TEST_P(AreaHard, HoldsAMillionTimes)
{
    if (std::getenv("ANTUMBRA_LONG") == nullptr)
        GTEST_SKIP() << "a long test: ANTUMBRA_LONG is not set";
    examine(kMillion, 10000);
}

INSTANTIATE_TEST_SUITE_P(Categories, AreaHard, testing::ValuesIn(areaCategories().begin(), areaCategories().end()),
                         [](const auto& each) { return std::string(each.param.name); });

} // namespace
} // namespace antumbra
