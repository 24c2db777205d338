#include "scene/mesh_pieces.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

namespace antumbra::scene {

namespace {

/// Sets that are joined, each known by its least member.
class Sets
{
public:
    explicit Sets(size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

    uint32_t find(uint32_t member)
    {
        while (parents_[member] != member)
            member = parents_[member] = parents_[parents_[member]];
        return member;
    }
    void join(uint32_t a, uint32_t b)
    {
        a = find(a);
        b = find(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<uint32_t> parents_;
};

void joinPlaces(Sets& sets, const std::vector<vec3>& positions)
{
    std::vector<uint32_t> byPlace(positions.size());
    std::iota(byPlace.begin(), byPlace.end(), 0u);
    const auto place = [&](uint32_t vertex) { // bits, which are in order whatever the numbers are; -0 is 0
        const vec3 p = positions[vertex] + 0.0f;
        return std::tuple(std::bit_cast<uint32_t>(p.x), std::bit_cast<uint32_t>(p.y), std::bit_cast<uint32_t>(p.z));
    };
    std::ranges::sort(byPlace, {}, place);
    for (size_t i = 1; i < byPlace.size(); ++i)
        if (place(byPlace[i - 1]) == place(byPlace[i]))
            sets.join(byPlace[i - 1], byPlace[i]);
}

} // namespace

std::vector<uint32_t> piecesOf(const Mesh& mesh)
{
    Sets sets(mesh.positions.size());
    joinPlaces(sets, mesh.positions);
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        sets.join(mesh.indices[i], mesh.indices[i + 1]);
        sets.join(mesh.indices[i], mesh.indices[i + 2]);
    }
    std::vector<uint32_t> pieces(mesh.positions.size());
    uint32_t count = 0;
    for (uint32_t vertex = 0; vertex < pieces.size(); ++vertex) {
        const uint32_t first = sets.find(vertex);
        pieces[vertex] = first == vertex ? count++ : pieces[first];
    }
    return pieces;
}

} // namespace antumbra::scene
