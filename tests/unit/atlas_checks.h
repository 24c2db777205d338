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

/// Texels a square metre of the world over those asked for, triangle by triangle, sorted.
std::vector<float> densities(const Atlas& atlas, const scene::Mesh& mesh, const mat4& world = mat4(1));

/// Fails where a triangle's density is not right within what a chart's cone of normals allows.
void expectEvenDensity(const Atlas& atlas, const scene::Mesh& mesh, const mat4& world = mat4(1));

} // namespace antumbra::bake
