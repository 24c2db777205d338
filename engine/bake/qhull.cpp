#include "bake/qhull.h"

#include "bake/spread.h"
#include "base/error.h"
#include "scene/merged_body.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <type_traits>

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

namespace antumbra::bake {

namespace {

using scene::Loop;

struct Close
{
    void operator()(FILE* file) const { std::fclose(file); }
};

/// One run. Reads what Qhull has made through its lists alone: its functions would leave by longjmp where they find an error.
class Run
{
public:
    explicit Run(std::span<const glm::dvec3> points) : points_(points), coordinates_(3 * points.size())
    {
        for (size_t i = 0; i < points.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                coordinates_[3 * i + static_cast<size_t>(axis)] = points[i][axis];
        qh_zero(&qhull_, messages_.get());
        char command[] = "qhull Pp";
        status_ = qh_new_qhull(&qhull_, 3, static_cast<int>(points.size()), coordinates_.data(), False, command, nullptr, messages_.get());
    }
    ~Run()
    {
        int longBlocks = 0;
        int longBytes = 0;
        qh_freeqhull(&qhull_, !qh_ALL);
        qh_memfreeshort(&qhull_, &longBlocks, &longBytes);
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// 0, or the number of Qhull's error.
    [[nodiscard]] int status() const { return status_; }

    [[nodiscard]] std::vector<Loop> loops() const
    {
        std::vector<Loop> loops;
        for (const facetT* facet = qhull_.facet_list; facet && facet->next; facet = facet->next)
            loops.push_back(loopOf(*facet));
        return loops;
    }

private:
    [[nodiscard]] uint32_t indexOf(const vertexT* vertex) const { return static_cast<uint32_t>((vertex->point - coordinates_.data()) / 3); }

    [[nodiscard]] Loop loopOf(const facetT& facet) const
    {
        Loop loop = facet.simplicial ? cornersOf(facet) : alongRidges(facet);
        glm::dvec3 twiceArea(0);
        for (size_t i = 1; i + 1 < loop.size(); ++i)
            twiceArea += glm::cross(points_[loop[i]] - points_[loop[0]], points_[loop[i + 1]] - points_[loop[0]]);
        if (glm::dot(twiceArea, glm::dvec3(facet.normal[0], facet.normal[1], facet.normal[2])) < 0)
            std::ranges::reverse(loop);
        return loop;
    }

    [[nodiscard]] Loop cornersOf(const facetT& facet) const
    {
        Loop corners;
        for (void* const* element = &facet.vertices->e[0].p; *element; ++element)
            corners.push_back(indexOf(static_cast<const vertexT*>(*element)));
        return corners;
    }

    /// Corners in order: a ridge joins two of them.
    [[nodiscard]] Loop alongRidges(const facetT& facet) const
    {
        std::vector<std::pair<uint32_t, uint32_t>> ridges;
        for (void* const* element = &facet.ridges->e[0].p; *element; ++element) {
            const setT* ends = static_cast<const ridgeT*>(*element)->vertices;
            ridges.emplace_back(indexOf(static_cast<const vertexT*>(ends->e[0].p)), indexOf(static_cast<const vertexT*>(ends->e[1].p)));
        }
        Loop loop{ridges.front().first};
        for (auto rest = ridges.begin(); rest != ridges.end(); ++rest) {
            const auto next = std::find_if(rest, ridges.end(),
                                           [&](const auto& ridge) { return ridge.first == loop.back() || ridge.second == loop.back(); });
            if (next == ridges.end())
                throw Error("a facet of Qhull has no closed border", "convex hull");
            loop.push_back(next->first == loop.back() ? next->second : next->first);
            std::iter_swap(rest, next);
        }
        loop.pop_back();
        return loop;
    }

    std::span<const glm::dvec3> points_;
    std::vector<double> coordinates_;
    std::unique_ptr<FILE, Close> messages_{std::fopen("/dev/null", "w")}; // Qhull wants a place for them
    qhT qhull_{};
    int status_ = 0;
};

} // namespace

std::vector<Loop> hullLoops(std::span<const glm::dvec3> points)
{
    static_assert(std::is_same_v<coordT, double>);
    const Run run(points);
    if (run.status() != 0)
        throw Error("Qhull finds none (its error " + std::to_string(run.status()) + ")", "convex hull");
    return run.loops();
}

scene::ConvexBody solidHull(std::span<const vec3> points)
{
    std::optional<scene::ConvexBody> body = scene::mergedBody(points, hullLoops(atUnitExtent(points)), scene::Corners::Exact);
    if (!body)
        throw Error("that of Qhull does not close", "convex hull");
    return *std::move(body);
}

} // namespace antumbra::bake
