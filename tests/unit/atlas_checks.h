// What every atlas must be, checked texel by texel and triangle by triangle.
#pragma once

#include "bake/atlas.h"

#include <span>
#include <vector>

namespace antumbra::bake {

inline constexpr uint32_t kNoChart = ~0u;

/// Of one mesh: triangles that share corners on the page.
size_t chartCount(const scene::Mesh& mesh);

/// The chart at every texel of the page that one touches, else kNoChart; fails where two meet in one.
std::vector<uint32_t> paintCharts(const Atlas& atlas);

/// Fails unless pages, streams, gutters and charts are as they must be; gives the share of the page that is covered.
double expectSound(const Atlas& atlas, size_t objectCount, const AtlasSettings& settings);

/// Texels a square metre of the world over those asked for, triangle by triangle, sorted: of charts of more than four texels a side, and of
/// narrower ones, which get up to four times as many along each narrow side.
struct Densities
{
    std::vector<float> wide;
    std::vector<float> narrow;
};
Densities densities(const Atlas& atlas, const scene::Mesh& mesh, const mat4& world = mat4(1));

/// Fails where a triangle's density is not right within what a chart's cone of normals and its narrow sides allow.
void expectEvenDensity(const Atlas& atlas, const scene::Mesh& mesh, const mat4& world = mat4(1));

} // namespace antumbra::bake
