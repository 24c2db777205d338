#include "gpu/area_twin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace antumbra {

namespace {

template <class Real>
using Vec = glm::vec<3, Real>;
template <class Real>
using Planes = std::vector<Vec<Real>>; // through the point; what counts is in front

/// What rounding leaves of zero. In double these are as small as its own; the input's rounding to float is then part of the input.
template <class Real>
struct Tolerance
{
    static constexpr Real kUnit = std::numeric_limits<Real>::epsilon();
    static constexpr Real kOnPlane = 2 * kUnit; // of unit vectors
    static constexpr Real kLevel = 4 * kUnit;   // of the reach of the body whose plane it is
    static constexpr Real kSeen = kUnit;        // of the distance
};

template <class Real>
Vec<Real> unitOrNone(const Vec<Real>& v)
{
    const Real length = glm::length(v);
    return length > 0 ? v / length : Vec<Real>(0);
}

template <class Real>
struct Corner
{
    Vec<Real> direction;
    Real planeZ; // of the inward normal of the arc to the next corner
};
template <class Real>
using Polygon = std::vector<Corner<Real>>;

/// theta / sin theta - 1 by the square of the chord: every term is the one before times s (2k + 2) / (2k + 3).
template <class Real>
Real curvature(Real chord2)
{
    const Real s = chord2 / 4;
    Real term = 1, sum = 0;
    for (int k = 0; k < 60 && term > std::numeric_limits<Real>::epsilon() * sum; ++k) {
        term *= s * (2 * k + 2) / (2 * k + 3);
        sum += term;
    }
    return sum;
}

template <class Real>
Real formFactor(const Polygon<Real>& polygon)
{
    Real sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec<Real> a = polygon[i].direction, b = polygon[(i + 1) % polygon.size()].direction, chord = b - a;
        const Vec<Real> p = a - polygon[0].direction, q = b - polygon[0].direction;
        const Real chord2 = glm::dot(chord, chord), crossZ = a.x * chord.y - a.y * chord.x;
        const Real angle = 2 * std::atan2(glm::length(a - b), glm::length(a + b));
        sum += p.x * q.y - p.y * q.x;
        if (chord2 < Real(0.3))
            sum += curvature(chord2) * crossZ;
        else if (chord2 < Real(3.8))
            sum += (angle / glm::length(glm::cross(a, chord)) - 1) * crossZ;
        else
            sum += angle * polygon[i].planeZ - crossZ;
    }
    return sum / (2 * std::numbers::pi_v<Real>);
}

/// On which sides of a plane a polygon has corners.
template <class Real>
struct Sides
{
    std::vector<Real> heights;
    bool hasFront = false, hasBehind = false;

    Sides(const Polygon<Real>& polygon, const Vec<Real>& plane)
    {
        for (const Corner<Real>& corner : polygon) {
            const Real height = glm::dot(plane, corner.direction);
            heights.push_back(std::abs(height) <= Tolerance<Real>::kOnPlane ? 0 : height);
            hasFront = hasFront || heights.back() > 0;
            hasBehind = hasBehind || heights.back() < 0;
        }
    }

    /// Guard 1: the weaker side is none where there are more than two changes.
    void heal()
    {
        std::vector<Real> nonzero;
        std::ranges::copy_if(heights, std::back_inserter(nonzero), [](Real height) { return height != 0; });
        size_t changes = 0;
        for (size_t i = 0; i < nonzero.size(); ++i)
            changes += (nonzero[i] > 0) != (nonzero[(i + 1) % nonzero.size()] > 0) ? 1 : 0;
        if (changes <= 2)
            return;
        const bool keepsFront = *std::ranges::max_element(nonzero) >= -*std::ranges::min_element(nonzero);
        for (Real& height : heights)
            height = (height > 0) == keepsFront ? height : 0;
    }
};

/// The part in front of the plane.
template <class Real>
Polygon<Real> partInFront(const Polygon<Real>& polygon, const std::vector<Real>& heights, const Vec<Real>& plane)
{
    Polygon<Real> part;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const size_t next = (i + 1) % polygon.size();
        const Real here = heights[i], there = heights[next];
        if (here >= 0)
            part.push_back({polygon[i].direction, here > 0 || there >= 0 ? polygon[i].planeZ : plane.z});
        if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
            const Vec<Real> front = polygon[here > 0 ? i : next].direction, behind = polygon[here > 0 ? next : i].direction;
            const Real high = std::max(here, there), low = std::min(here, there);
            part.push_back({unitOrNone(front * -low + behind * high), here > 0 ? plane.z : polygon[i].planeZ});
        }
    }
    return part.size() >= 3 ? part : Polygon<Real>{};
}

template <class Real>
struct Halves
{
    Polygon<Real> front, behind;
};

template <class Real>
Halves<Real> split(const Polygon<Real>& polygon, const Vec<Real>& plane)
{
    Sides<Real> sides(polygon, plane);
    if (!sides.hasBehind)
        return {sides.hasFront ? polygon : Polygon<Real>{}, {}};
    if (!sides.hasFront)
        return {{}, polygon};
    sides.heal();
    Halves<Real> halves{partInFront(polygon, sides.heights, plane), {}};
    for (Real& height : sides.heights)
        height = -height;
    halves.behind = partInFront(polygon, sides.heights, -plane);
    return halves;
}

template <class Real>
Polygon<Real> clipped(Polygon<Real> polygon, const Planes<Real>& planes)
{
    for (const Vec<Real>& plane : planes) {
        if (polygon.empty())
            break;
        polygon = split(polygon, plane).front;
    }
    return polygon;
}

template <class Real>
bool mayMeet(const Polygon<Real>& polygon, const Planes<Real>& occluder)
{
    return !occluder.empty() && std::ranges::all_of(occluder, [&](const Vec<Real>& plane) { return Sides<Real>(polygon, plane).hasFront; });
}

template <class Real>
bool covers(const Planes<Real>& occluder, const Polygon<Real>& polygon)
{
    return std::ranges::none_of(occluder, [&](const Vec<Real>& plane) { return Sides<Real>(polygon, plane).hasBehind; });
}

/// `visible` of the method's page.
template <class Real>
Real visibleOf(const Polygon<Real>& polygon, const std::vector<const Planes<Real>*>& occluders)
{
    std::vector<const Planes<Real>*> live;
    for (const Planes<Real>* occluder : occluders) {
        if (!mayMeet(polygon, *occluder))
            continue;
        if (covers(*occluder, polygon))
            return 0;
        live.push_back(occluder);
    }
    for (size_t i = 0; i < live.size(); ++i) {
        const Polygon<Real> hidden = clipped(polygon, *live[i]);
        if (hidden.empty())
            continue;
        const std::vector<const Planes<Real>*> rest(live.begin() + static_cast<std::ptrdiff_t>(i) + 1, live.end());
        if (rest.size() < 2)
            return visibleOf(polygon, rest) - visibleOf(hidden, rest);
        Real sum = 0;
        Polygon<Real> inside = polygon;
        for (const Vec<Real>& plane : *live[i]) {
            Halves<Real> halves = split(inside, plane);
            if (!halves.behind.empty())
                sum += visibleOf(halves.behind, rest);
            inside = std::move(halves.front);
            if (inside.empty())
                break;
        }
        return sum;
    }
    return formFactor(polygon);
}

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
            const Real sign = isFlipped ? -1 : 1, unoccluded = formFactor(polygon);
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
                if (-lowest <= std::max(Real(1e-6), std::min(length / 2, Real(3e-5))))
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
