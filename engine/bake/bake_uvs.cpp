#include "bake/atlas.h"
#include "bake/overlap.h"

#include <cmath>

namespace antumbra::bake {

namespace {

constexpr float kLeastTwiceArea = 1.0e-12f; // of the unit square

bool isInside(vec2 uv) { return uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1; } // NaN is not

} // namespace

const char* faultOfBakeUvs(const scene::Mesh& mesh)
{
    if (mesh.bakeUvs.empty())
        return "there are no coordinates";
    FlatTriangles taken(vec2(0), vec2(1), mesh.indices.size() / 3);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const FlatTriangle triangle{mesh.bakeUvs[mesh.indices[i]], mesh.bakeUvs[mesh.indices[i + 1]], mesh.bakeUvs[mesh.indices[i + 2]]};
        for (const vec2 uv : triangle)
            if (!isInside(uv))
                return "coordinates lie outside 0..1";
        if (!(std::abs(twiceArea(triangle)) > kLeastTwiceArea))
            return "triangles have no area";
        if (!taken.add(triangle))
            return "triangles overlap";
    }
    return nullptr;
}

} // namespace antumbra::bake
