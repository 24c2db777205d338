#include "bake/seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace antumbra::bake {

namespace {

// As smooth as a surface must be for light to go on over an edge: cosines.
constexpr float kSmoothShading = 0.999f;
constexpr float kSmoothGeometry = 0.9f;
constexpr float kPointsPerTexelLength = 2;
constexpr uint32_t kMostPointsAnEdge = 64;

/// One side of an edge: its ends as one triangle has them.
struct Side
{
    uint32_t triangle;
    uint32_t first; // corner of the triangle; the next one is the other end
};

struct Before
{
    bool operator()(vec3 a, vec3 b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
};
using Ends = std::array<vec3, 2>; // the lower one first

struct EdgeBefore
{
    bool operator()(const Ends& a, const Ends& b) const
    {
        const Before before;
        return before(a[0], b[0]) || (!before(b[0], a[0]) && before(a[1], b[1]));
    }
};
using Edges = std::map<Ends, std::vector<Side>, EdgeBefore>;

uint32_t vertexOf(const StaticScene& scene, const Side& side, bool isSecond)
{
    return scene.indices[size_t{3} * side.triangle + (side.first + (isSecond ? 1 : 0)) % 3];
}

/// The end that is the edge's first is the side's second, where its triangle runs the other way round.
bool isTurned(const StaticScene& scene, const Side& side)
{
    return Before()(scene.positions[vertexOf(scene, side, true)], scene.positions[vertexOf(scene, side, false)]);
}

Edges edgesOf(const StaticScene& scene)
{
    Edges edges;
    for (uint32_t triangle = 0; triangle < scene.triangleCount(); ++triangle)
        for (uint32_t first = 0; first < 3; ++first) {
            const Side side{triangle, first};
            Ends ends{scene.positions[vertexOf(scene, side, false)], scene.positions[vertexOf(scene, side, true)]};
            if (isTurned(scene, side))
                std::swap(ends[0], ends[1]);
            edges[ends].push_back(side);
        }
    return edges;
}

/// The edge's end, lower or higher, as a side has it.
uint32_t endOf(const StaticScene& scene, const Side& side, bool isHigher)
{
    return vertexOf(scene, side, isHigher != isTurned(scene, side));
}

bool goesOnSmoothly(const StaticScene& scene, const Side& a, const Side& b)
{
    if (glm::dot(geometricNormal(scene, a.triangle), geometricNormal(scene, b.triangle)) < kSmoothGeometry)
        return false;
    for (const bool isHigher : {false, true}) {
        const vec3 normalA = scene.normals[endOf(scene, a, isHigher)], normalB = scene.normals[endOf(scene, b, isHigher)];
        if (glm::dot(normalA, normalB) < kSmoothShading)
            return false;
    }
    return true;
}

/// Nothing where both sides are one chart's, whose coordinates are the same.
void addPoints(const StaticScene& scene, const Side& a, const Side& b, std::vector<SeamPoint>& points)
{
    const vec2 extent(scene.atlasExtent);
    const vec2 fromA = scene.bakeUvs[endOf(scene, a, false)], toA = scene.bakeUvs[endOf(scene, a, true)];
    const vec2 fromB = scene.bakeUvs[endOf(scene, b, false)], toB = scene.bakeUvs[endOf(scene, b, true)];
    if (fromA == fromB && toA == toB)
        return;
    const float texels = std::max(glm::length((toA - fromA) * extent), glm::length((toB - fromB) * extent));
    const uint32_t count = 2 + std::min(static_cast<uint32_t>(kPointsPerTexelLength * texels), kMostPointsAnEdge);
    for (uint32_t i = 0; i < count; ++i) {
        const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        points.push_back({glm::mix(fromA, toA, share), glm::mix(fromB, toB, share)});
    }
}

/// One place in a difference that should be zero, and the other way round.
struct Term
{
    uint32_t index; // of the unknown, or of the difference
    float weight;
};

/// The differences at all points, and the unknown values that they are made of.
class Stitcher
{
public:
    Stitcher(const TexelMap& map, std::span<const uint32_t> sources, const Transfers& transfers)
        : map_(map), sources_(sources), transfers_(transfers), width_(3 * transfers.coefficientCount)
    {
    }

    void add(const SeamPoint& point)
    {
        std::vector<Term>& difference = differences_.emplace_back();
        addSide(difference, point[0], 1);
        addSide(difference, point[1], -1);
        const auto index = static_cast<uint32_t>(differences_.size() - 1);
        for (const Term& term : difference)
            uses_[term.index].push_back({index, term.weight});
    }

    /// One value after the other takes what is best as the others stand (Gauss and Seidel).
    Stitched solve()
    {
        constexpr int kRounds = 200;
        std::vector<float> residuals(differences_.size() * width_, 0.0f);
        for (size_t i = 0; i < differences_.size(); ++i)
            for (const Term& term : differences_[i])
                for (uint32_t k = 0; k < width_; ++k)
                    residuals[i * width_ + k] += term.weight * values_[size_t{term.index} * width_ + k];
        const std::vector<float> before = values_;
        for (int round = 0; round < kRounds; ++round)
            for (uint32_t i = 0; i < places_.size(); ++i)
                relax(i, before, residuals);
        return {std::move(places_), std::move(values_)};
    }

private:
    void addSide(std::vector<Term>& difference, vec2 bakeUv, float sign)
    {
        const vec2 place = bakeUv * vec2(map_.extent) - 0.5f, corner = glm::floor(place), part = place - corner;
        for (int k = 0; k < 4; ++k) {
            const ivec2 step(k & 1, k >> 1);
            const uvec2 at(glm::clamp(ivec2(corner) + step, ivec2(0), ivec2(map_.extent) - 1));
            const float weight = (step.x == 1 ? part.x : 1 - part.x) * (step.y == 1 ? part.y : 1 - part.y);
            if (const uint32_t page = at.y * map_.extent.x + at.x; weight > 0 && sources_[page] != kNoTexel)
                difference.push_back({unknownAt(page), sign * weight});
        }
    }

    uint32_t unknownAt(uint32_t place)
    {
        const auto [found, isNew] = unknowns_.try_emplace(place, static_cast<uint32_t>(places_.size()));
        if (isNew) {
            places_.push_back(place);
            uses_.emplace_back();
            const vec3* transfer = &transfers_.values[size_t{sources_[place]} * transfers_.coefficientCount];
            for (uint32_t k = 0; k < width_; ++k)
                values_.push_back(transfer[k / 3][static_cast<int>(k % 3)]);
        }
        return found->second;
    }

    void relax(uint32_t unknown, const std::vector<float>& before, std::vector<float>& residuals)
    {
        // Against the squares of bilinear weights, of some tenths: so soft that seams close, and that texels no seam reads much of stay.
        // What lies beyond its chart was made up, and gives way first.
        constexpr float kHold = 0.02f, kHoldBeyond = 0.002f;
        const bool isBeyond = map_.texels[places_[unknown]] != sources_[places_[unknown]];
        const float hold = isBeyond ? kHoldBeyond : kHold;
        float sum = hold;
        for (const Term& use : uses_[unknown])
            sum += use.weight * use.weight;
        for (uint32_t k = 0; k < width_; ++k) {
            float& value = values_[size_t{unknown} * width_ + k];
            float pull = hold * (before[size_t{unknown} * width_ + k] - value);
            for (const Term& use : uses_[unknown])
                pull -= use.weight * residuals[size_t{use.index} * width_ + k];
            const float step = pull / sum;
            value += step;
            for (const Term& use : uses_[unknown])
                residuals[size_t{use.index} * width_ + k] += use.weight * step;
        }
    }

    const TexelMap& map_;
    std::span<const uint32_t> sources_;
    const Transfers& transfers_;
    uint32_t width_;
    std::map<uint32_t, uint32_t> unknowns_; // by place
    std::vector<uint32_t> places_;
    std::vector<float> values_;
    std::vector<std::vector<Term>> differences_;
    std::vector<std::vector<Term>> uses_; // of every unknown
};

} // namespace

std::vector<SeamPoint> seamPoints(const StaticScene& scene)
{
    std::vector<SeamPoint> points;
    for (const auto& [ends, sides] : edgesOf(scene))
        for (size_t i = 0; i < sides.size(); ++i)
            for (size_t k = i + 1; k < sides.size(); ++k)
                if (goesOnSmoothly(scene, sides[i], sides[k]))
                    addPoints(scene, sides[i], sides[k], points);
    return points;
}

Stitched stitched(std::span<const SeamPoint> points, const TexelMap& map, std::span<const uint32_t> sources, const Transfers& transfers)
{
    Stitcher stitcher(map, sources, transfers);
    for (const SeamPoint& point : points)
        stitcher.add(point);
    return stitcher.solve();
}

} // namespace antumbra::bake
