// Isotropic remeshing after Botsch and Kobbelt, A Remeshing Approach to Multiresolution Modeling, SGP 2004, from a mesh so
// fine that edges need only be collapsed, never split; flips follow the Delaunay criterion.
#include "tools/make_character/surface.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace antumbra::character {

namespace {

using Triangle = glm::uvec3;

struct Edge
{
    uint32_t a, b;
};

class Remesher
{
public:
    explicit Remesher(Surface surface)
        : positions_(std::move(surface.positions)), triangles_(std::move(surface.triangles)), around_(positions_.size()),
          isPinned_(positions_.size())
    {
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            for (int i = 0; i < 3; ++i)
                around_[triangles_[t][i]].push_back(t);
    }

    void collapseShortEdges();
    void flipToDelaunay();
    void relax();
    void pinClothBorders();
    [[nodiscard]] Surface surface() const;

private:
    [[nodiscard]] std::vector<Edge> edges() const;
    [[nodiscard]] std::vector<uint32_t> neighbours(uint32_t vertex) const;
    [[nodiscard]] std::vector<uint32_t> trianglesOf(Edge edge) const;
    [[nodiscard]] double relativeLength(Edge edge) const;
    [[nodiscard]] bool facesOutwards(const Triangle& triangle) const;
    [[nodiscard]] std::ptrdiff_t inwardCount(uint32_t vertex) const;
    [[nodiscard]] bool isBorder(Edge edge) const;
    [[nodiscard]] double angleAt(uint32_t apex, Edge opposite) const;
    bool tryMove(uint32_t vertex, const dvec3& to);
    void collapse(Edge edge);
    void flip(Edge edge);

    std::vector<dvec3> positions_;
    std::vector<Triangle> triangles_; // of one vertex three times: gone
    std::vector<std::vector<uint32_t>> around_;
    std::vector<bool> isPinned_;
};

bool isGone(const Triangle& t) { return t.x == t.y; }
bool holds(const Triangle& t, uint32_t vertex) { return t.x == vertex || t.y == vertex || t.z == vertex; }
uint32_t apexOf(const Triangle& t, Edge base) { return t.x ^ t.y ^ t.z ^ base.a ^ base.b; }

Triangle replaced(Triangle t, uint32_t old, uint32_t with)
{
    for (int i = 0; i < 3; ++i)
        if (t[i] == old)
            t[i] = with;
    return t;
}

std::vector<Edge> Remesher::edges() const
{
    std::vector<Edge> result;
    for (const Triangle& t : triangles_)
        for (int i = 0; i < 3; ++i)
            if (!isGone(t) && t[i] < t[(i + 1) % 3])
                result.push_back({t[i], t[(i + 1) % 3]});
    return result;
}

std::vector<uint32_t> Remesher::neighbours(uint32_t vertex) const
{
    std::set<uint32_t> found;
    for (const uint32_t t : around_[vertex])
        for (int i = 0; i < 3; ++i)
            found.insert(triangles_[t][i]);
    found.erase(vertex);
    return {found.begin(), found.end()};
}

std::vector<uint32_t> Remesher::trianglesOf(Edge edge) const
{
    std::vector<uint32_t> found;
    std::ranges::copy_if(around_[edge.a], std::back_inserter(found), [&](uint32_t t) { return holds(triangles_[t], edge.b); });
    return found;
}

double Remesher::relativeLength(Edge edge) const
{
    const dvec3 a = positions_[edge.a], b = positions_[edge.b];
    return glm::distance(a, b) / detailAt(0.5 * (a + b));
}

bool Remesher::facesOutwards(const Triangle& t) const
{
    constexpr double kLeastCosine = 0.5;
    const dvec3 a = positions_[t.x], b = positions_[t.y], c = positions_[t.z];
    const dvec3 face = glm::cross(b - a, c - a);
    const double area = glm::length(face);
    return area > 0 && glm::dot(face, normalOfBody((a + b + c) / 3.0)) > kLeastCosine * area;
}

bool Remesher::isBorder(Edge edge) const
{
    const auto clothOf = [&](uint32_t t) {
        return clothAt(ontoBody((positions_[triangles_[t].x] + positions_[triangles_[t].y] + positions_[triangles_[t].z]) / 3.0));
    };
    const std::vector<uint32_t> sides = trianglesOf(edge);
    return isPinned_[edge.a] && isPinned_[edge.b] && clothOf(sides[0]) != clothOf(sides[1]);
}

double Remesher::angleAt(uint32_t apex, Edge opposite) const
{
    const dvec3 a = glm::normalize(positions_[opposite.a] - positions_[apex]);
    const dvec3 b = glm::normalize(positions_[opposite.b] - positions_[apex]);
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// Triangles around the vertex that are turned over, or nearly.
std::ptrdiff_t Remesher::inwardCount(uint32_t vertex) const
{
    return std::ranges::count_if(around_[vertex], [&](uint32_t t) { return !facesOutwards(triangles_[t]); });
}

/// Moves the vertex, unless that would turn triangles over.
bool Remesher::tryMove(uint32_t vertex, const dvec3& to)
{
    const std::ptrdiff_t inwardBefore = inwardCount(vertex);
    const dvec3 before = std::exchange(positions_[vertex], to);
    if (inwardCount(vertex) <= inwardBefore)
        return true;
    positions_[vertex] = before;
    return false;
}

void Remesher::collapse(Edge edge)
{
    constexpr double kLongest = 4.0 / 3;
    const uint32_t keep = isPinned_[edge.b] ? edge.b : edge.a;
    const uint32_t drop = isPinned_[edge.b] ? edge.a : edge.b;
    const std::vector<uint32_t> aroundKeep = neighbours(keep), aroundDrop = neighbours(drop);
    std::vector<uint32_t> common;
    std::ranges::set_intersection(aroundKeep, aroundDrop, std::back_inserter(common));
    if (common.size() != 2 || (isPinned_[drop] && !isBorder(edge)))
        return;

    const std::ptrdiff_t inwardBefore = inwardCount(keep) + inwardCount(drop);
    const dvec3 keptBefore = positions_[keep], droppedBefore = positions_[drop];
    if (!isPinned_[keep])
        positions_[keep] = ontoBody(0.5 * (keptBefore + droppedBefore));
    positions_[drop] = positions_[keep];
    constexpr std::ptrdiff_t kClosing = 2 * 2; // the two triangles at the edge, counted from both ends
    const auto isShort = [&](uint32_t other) { return other == keep || other == drop || relativeLength({keep, other}) < kLongest; };
    if (inwardCount(keep) + inwardCount(drop) - kClosing > inwardBefore || !std::ranges::all_of(aroundKeep, isShort) ||
        !std::ranges::all_of(aroundDrop, isShort))
    {
        positions_[keep] = keptBefore;
        positions_[drop] = droppedBefore;
        return;
    }
    for (const uint32_t t : trianglesOf({keep, drop})) {
        for (int i = 0; i < 3; ++i)
            std::erase(around_[triangles_[t][i]], t);
        triangles_[t] = Triangle{0};
    }
    for (const uint32_t t : std::exchange(around_[drop], {})) {
        triangles_[t] = replaced(triangles_[t], drop, keep);
        around_[keep].push_back(t);
    }
}

void Remesher::collapseShortEdges()
{
    constexpr double kShortest = 0.8;
    constexpr double kPerMillion = 1e6; // whole numbers, so that equal lengths tie whatever their last bits
    std::vector<std::tuple<double, uint32_t, uint32_t>> shortFirst;
    for (const Edge& edge : edges())
        if (const double length = relativeLength(edge); length < kShortest)
            shortFirst.emplace_back(std::round(kPerMillion * length), edge.a, edge.b);
    std::ranges::sort(shortFirst);
    for (const auto& [rank, a, b] : shortFirst)
        if (trianglesOf({a, b}).size() == 2 && relativeLength({a, b}) < kShortest)
            collapse({a, b});
}

void Remesher::flip(Edge edge)
{
    const std::vector<uint32_t> sides = trianglesOf(edge);
    const uint32_t c = apexOf(triangles_[sides[0]], edge), d = apexOf(triangles_[sides[1]], edge);
    const Triangle first = replaced(triangles_[sides[0]], edge.b, d), second = replaced(triangles_[sides[1]], edge.a, c);
    if (!trianglesOf({c, d}).empty() || !facesOutwards(first) || !facesOutwards(second))
        return;
    triangles_[sides[0]] = first;
    triangles_[sides[1]] = second;
    std::erase(around_[edge.b], sides[0]);
    std::erase(around_[edge.a], sides[1]);
    around_[d].push_back(sides[0]);
    around_[c].push_back(sides[1]);
}

void Remesher::flipToDelaunay()
{
    for (const Edge& edge : edges()) {
        const std::vector<uint32_t> sides = trianglesOf(edge);
        if (sides.size() != 2 || isBorder(edge))
            continue;
        const double opposite = angleAt(apexOf(triangles_[sides[0]], edge), edge) + angleAt(apexOf(triangles_[sides[1]], edge), edge);
        if (opposite > std::numbers::pi + 1e-6)
            flip(edge);
    }
}

void Remesher::relax()
{
    for (uint32_t vertex = 0; vertex < positions_.size(); ++vertex) {
        if (around_[vertex].empty() || isPinned_[vertex])
            continue;
        const std::vector<uint32_t> others = neighbours(vertex);
        dvec3 centre{0};
        for (const uint32_t other : others)
            centre += positions_[other] / static_cast<double>(others.size());
        tryMove(vertex, ontoBody(glm::mix(positions_[vertex], centre, 0.6)));
    }
}

// Of an edge between two cloths, the end nearer to the border goes there; then no edge crosses it any more.
void Remesher::pinClothBorders()
{
    for (const Edge& edge : edges()) {
        if (isPinned_[edge.a] || isPinned_[edge.b] || clothAt(positions_[edge.a]) == clothAt(positions_[edge.b]))
            continue;
        const Cloth cloth = clothAt(positions_[edge.a]);
        double same = 0, other = 1;
        for (int i = 0; i < 30; ++i) {
            const double middle = 0.5 * (same + other);
            (clothAt(ontoBody(glm::mix(positions_[edge.a], positions_[edge.b], middle))) == cloth ? same : other) = middle;
        }
        const dvec3 border = ontoBody(glm::mix(positions_[edge.a], positions_[edge.b], same));
        const uint32_t nearer = same < 0.5 ? edge.a : edge.b;
        isPinned_[nearer] = tryMove(nearer, border);
    }
}

Surface Remesher::surface() const
{
    Surface result;
    std::vector<uint32_t> number(positions_.size());
    for (uint32_t vertex = 0; vertex < positions_.size(); ++vertex)
        if (!around_[vertex].empty()) {
            number[vertex] = static_cast<uint32_t>(result.positions.size());
            result.positions.push_back(positions_[vertex]);
        }
    for (const Triangle& t : triangles_)
        if (!isGone(t))
            result.triangles.emplace_back(number[t.x], number[t.y], number[t.z]);
    return result;
}

} // namespace

Surface remesh(Surface fine)
{
    constexpr int kRounds = 12, kPinningRounds = 6;
    Remesher remesher(std::move(fine));
    for (int round = 0; round < kRounds + kPinningRounds; ++round) {
        if (round >= kRounds)
            remesher.pinClothBorders();
        remesher.collapseShortEdges();
        remesher.flipToDelaunay();
        remesher.relax();
    }
    Surface result = remesher.surface();
    check(isClosed(result), "a closed surface after remeshing");
    return result;
}

} // namespace antumbra::character
