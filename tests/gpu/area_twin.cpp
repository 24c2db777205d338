#include "gpu/area_twin.h"

#include "gpu/area_twin_polygon.h"

#include <optional>
#include <set>

namespace antumbra {

namespace {

using namespace twin;

/// The half-space before a face of the light: dot(normal, v - point) + offset > 0.
template <class Real>
struct HalfSpace
{
    Vec<Real> normal;
    Real offset;

    Real heightOf(const Vec<Real>& v) const { return glm::dot(normal, v) + offset; }
};

/// A body relative to the point.
template <class Real>
struct SeenBody
{
    std::vector<Vec<Real>> vertices;
    std::vector<std::vector<uint32_t>> loops;
    std::vector<Vec<Real>> normals;
    std::vector<Real> heights; // of the point over the faces' planes
    Real reach = 0;

    SeenBody(const scene::ConvexBody& body, const vec3& point)
    {
        for (const vec3& vertex : body.vertices) {
            vertices.push_back(Vec<Real>(vertex) - Vec<Real>(point));
            reach = std::max(reach, glm::length(vertices.back()));
        }
        for (uint32_t face = 0; face < body.faces.size(); ++face) {
            const auto loop = body.loop(face);
            loops.emplace_back(loop.begin(), loop.end());
            glm::dvec3 twiceArea(0); // in double for both: the device gets such normals too
            for (size_t i = 1; i + 1 < loop.size(); ++i)
                twiceArea += glm::cross(glm::dvec3(body.vertices[loop[i]]) - glm::dvec3(body.vertices[loop[0]]),
                                        glm::dvec3(body.vertices[loop[i + 1]]) - glm::dvec3(body.vertices[loop[0]]));
            normals.push_back(Vec<Real>(unitOrNone(twiceArea)));
            heights.push_back(-glm::dot(normals.back(), vertices[loop[0]]));
        }
    }
};

template <class Real>
class Receiver
{
public:
    explicit Receiver(const app::AreaProblem& problem) : problem_(problem)
    {
        const Vec<Real> normal(problem.normal), tangent(problem.tangent), bitangent = glm::cross(normal, tangent);
        const glm::mat<3, 3, Real> frame = glm::transpose(glm::mat<3, 3, Real>(tangent, bitangent, normal));
        lobe_ = glm::transpose(glm::mat<3, 3, Real>(Vec<Real>(problem.lobe[0]), Vec<Real>(problem.lobe[1]), Vec<Real>(problem.lobe[2]))) *
                frame;
        lobeOfPlanes_ = glm::transpose(glm::inverse(lobe_));
        horizons_ = {{0, 0, 1}, unitOrNone(lobeOfPlanes_ * normal)};
    }

    AreaShares shares() const
    {
        const SeenBody<Real> light(problem_.light, problem_.position);
        AreaShares sum;
        for (size_t face = 0; face < light.loops.size(); ++face) {
            const Real least = Tolerance<Real>::kSeen * glm::length(light.vertices[light.loops[face][0]]);
            const bool isFlipped = problem_.light.isPlanar && problem_.isTwoSided && light.heights[face] < -least;
            if (light.heights[face] <= least && !isFlipped)
                continue;
            const Polygon<Real> polygon = seenFace(light, face, isFlipped);
            const Real sign = isFlipped ? -1 : 1,
                       unoccluded = std::max(formFactor(polygon), Real(0)); // corners off its plane turn it around
            sum.unoccluded += unoccluded;
            sum.visible += visibleShare(polygon, unoccluded, {light.normals[face] * sign, light.heights[face] * sign});
        }
        return sum;
    }

private:
    Vec<Real> planeThrough(const Vec<Real>& start, const Vec<Real>& end) const
    {
        return unitOrNone(glm::cross(lobe_ * start, unitOrNone(lobe_ * (end - start))));
    }

    /// In the lobe's space, above both horizons.
    Polygon<Real> seenFace(const SeenBody<Real>& light, size_t face, bool isFlipped) const
    {
        std::vector<uint32_t> loop = light.loops[face];
        if (!isFlipped) // counter-clockwise from outside the sphere of directions
            std::ranges::reverse(loop);
        Polygon<Real> polygon;
        for (size_t i = 0; i < loop.size(); ++i) {
            const Vec<Real>&start = light.vertices[loop[i]], &end = light.vertices[loop[(i + 1) % loop.size()]];
            polygon.push_back({unitOrNone(lobe_ * start), planeThrough(start, end).z});
        }
        return clipped(std::move(polygon), horizons_);
    }

    double visibleShare(const Polygon<Real>& polygon, Real unoccluded, const HalfSpace<Real>& before) const
    {
        if (polygon.empty())
            return 0;
        std::vector<Planes<Real>> occluders;
        for (const app::AreaOccluder& occluder : problem_.occluders) {
            std::optional<Planes<Real>> planes = hiddenCone(occluder, before);
            if (!planes)
                return 0;
            occluders.push_back(*std::move(planes));
        }
        std::vector<const Planes<Real>*> list;
        for (const Planes<Real>& each : occluders)
            list.push_back(&each);
        return std::clamp(visibleOf(polygon, list), Real(0), unoccluded);
    }

    struct Outline
    {
        Planes<Real> planes;                               // in the lobe's space
        Planes<Real> worldPlanes;                          // the same
        std::vector<std::pair<Vec<Real>, Vec<Real>>> arcs; // a plane's ends, unit

        void add(const Vec<Real>& plane, const Vec<Real>& worldPlane, const Vec<Real>& start, const Vec<Real>& end)
        {
            if (glm::dot(plane, plane) == 0)
                return;
            planes.push_back(plane);
            worldPlanes.push_back(worldPlane);
            arcs.emplace_back(unitOrNone(start), unitOrNone(end));
        }

        /// Guard 3: planes that cut into the outline, by more than the rounding of the vertices tilts them.
        void dropFalsePlanes()
        {
            Planes<Real> kept;
            for (size_t i = 0; i < planes.size(); ++i) {
                const Real length = glm::distance(arcs[i].first, arcs[i].second);
                Real lowest = 0;
                for (const auto& [start, end] : arcs)
                    lowest = std::min({lowest, glm::dot(worldPlanes[i], start), glm::dot(worldPlanes[i], end)});
                const Real most = length < Real(0.02) ? std::min(length / 2, Real(3e-5)) : Real(3e-4);
                if (-lowest <= std::max(Real(1e-6), most))
                    kept.push_back(planes[i]);
            }
            planes = kept;
        }
    };

    /// What the body hides, of what of it lies before the light: no planes where that is nothing, none at all where it holds the point.
    std::optional<Planes<Real>> hiddenCone(const app::AreaOccluder& occluder, const HalfSpace<Real>& before) const
    {
        const SeenBody<Real> body(occluder.body, problem_.position);
        const auto isBefore = [&](const Vec<Real>& v) { return before.heightOf(v) > Tolerance<Real>::kOnPlane * body.reach; };
        if (std::ranges::none_of(body.vertices, isBefore))
            return Planes<Real>{};
        const Real level = Tolerance<Real>::kLevel * body.reach;
        const auto hasArea = [&](size_t face) { return body.normals[face] != Vec<Real>(0); };
        const auto isFront = [&](size_t face) { return hasArea(face) && body.heights[face] >= -level; };
        const auto isLevel = [&](size_t face) { return hasArea(face) && std::abs(body.heights[face]) <= level; };
        bool hasFaces = false;
        for (size_t face = 0; face < body.loops.size(); ++face)
            hasFaces = hasFaces || hasArea(face);
        if (!hasFaces)
            return Planes<Real>{};
        if (occluder.body.isPlanar && (isLevel(0) || (occluder.isFrontOnly && !isFront(0))))
            return Planes<Real>{};
        const bool isTurned = occluder.body.isPlanar && !isFront(0);
        std::set<std::pair<uint32_t, uint32_t>> fronts; // edges as front faces run through them
        bool hasFront = isTurned;
        for (size_t face = 0; face < body.loops.size(); ++face)
            for (size_t i = 0; isFront(face) && i < body.loops[face].size(); ++i) {
                fronts.insert({body.loops[face][i], body.loops[face][(i + 1) % body.loops[face].size()]});
                hasFront = true;
            }
        if (!hasFront)
            return std::nullopt;
        Outline outline;
        for (size_t face = 0; face < body.loops.size(); ++face)
            if (isTurned || isFront(face))
                addFace(outline, body, face, isLevel(face), isTurned, fronts, before);
        outline.dropFalsePlanes();
        return outline.planes;
    }

    /// The silhouette's edges of a front face, and where it goes through the plane of the light.
    void addFace(Outline& outline, const SeenBody<Real>& body, size_t face, bool isLevel, bool isTurned,
                 const std::set<std::pair<uint32_t, uint32_t>>& fronts, const HalfSpace<Real>& before) const
    {
        std::vector<uint32_t> loop = body.loops[face];
        if (!isTurned)
            std::ranges::reverse(loop);
        // The planes of the edges of a face that is level with the point say nothing; its own does (guard 4).
        const auto add = [&](const Vec<Real>& a, const Vec<Real>& b, const Vec<Real>& start, const Vec<Real>& end) {
            const Vec<Real> worldPlane = isLevel ? -body.normals[face] : unitOrNone(glm::cross(a, b - a));
            outline.add(isLevel ? unitOrNone(lobeOfPlanes_ * worldPlane) : planeThrough(a, b), worldPlane, start, end);
        };
        std::optional<Vec<Real>> leaving, entering;
        for (size_t i = 0; i < loop.size(); ++i) {
            const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
            Vec<Real> start = body.vertices[a], end = body.vertices[b];
            const Real startHeight = before.heightOf(start), endHeight = before.heightOf(end);
            if (startHeight > 0 && endHeight <= 0)
                leaving = end = glm::mix(start, end, startHeight / (startHeight - endHeight));
            else if (startHeight <= 0 && endHeight > 0)
                entering = start = glm::mix(end, start, endHeight / (endHeight - startHeight));
            if ((startHeight <= 0 && endHeight <= 0) || (!isTurned && fronts.contains({a, b})))
                continue;
            add(body.vertices[a], body.vertices[b], start, end);
        }
        if (leaving && entering)
            add(*leaving, *entering, *leaving, *entering);
    }

    const app::AreaProblem& problem_;
    glm::mat<3, 3, Real> lobe_, lobeOfPlanes_;
    Planes<Real> horizons_; // of the lobe and of the surface
};

} // namespace

template <class Real>
AreaShares areaTwin(const app::AreaProblem& problem)
{
    return Receiver<Real>(problem).shares();
}

template AreaShares areaTwin<float>(const app::AreaProblem&);
template AreaShares areaTwin<double>(const app::AreaProblem&);

} // namespace antumbra
