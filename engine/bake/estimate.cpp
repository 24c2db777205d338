// What a bake takes of memory and rays, from the areas of the page and of space: texels are counted when they are laid out, and that
// takes memory itself.
#include "bake/baker.h"

#include "bake/gather.h"
#include "bake/settings.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace antumbra::bake {

namespace {

// Bytes, as measured at the peak of a stage.
constexpr double kPerTriangle = 130;        // Embree's tree and its copy of the mesh
constexpr double kPerPlace = 68;            // of the page, while texels are laid out
constexpr double kPerTexel = 84;            // of the map meanwhile, for it grows by doubling
constexpr double kPerTexelKept = 60;        // of the map afterwards
constexpr double kFixed = 24.0 * (1 << 20); // threads, and messages between processes

/// The page as far as memory goes, in texels; lengths grow with the density and areas with its square.
struct PageSize
{
    double places = 0;  // of the whole page
    double area = 0;    // of the charts
    double rim = 0;     // texels that charts take more than their area, for every texel that they touch counts
    double charted = 0; // m^2
};

vec2 onPage(const StaticScene& scene, uint32_t corner) { return scene.bakeUvs[scene.indices[corner]] * vec2(scene.atlasExtent); }

/// A convex outline touches as many more texels than its area as it is wide and high: half of its steps along both axes.
double rimOf(const StaticScene& scene)
{
    std::unordered_map<uint64_t, uint32_t> uses; // of edges between vertices, which are split where charts end
    const auto keyOf = [&scene](uint32_t corner) {
        const uint32_t a = scene.indices[corner], b = scene.indices[corner % 3 == 2 ? corner - 2 : corner + 1];
        return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    };
    const uint32_t corners = 3 * scene.triangleCount();
    for (uint32_t corner = 0; corner < corners; ++corner)
        ++uses[keyOf(corner)];
    double rim = 0;
    for (uint32_t corner = 0; corner < corners; ++corner) {
        if (uses[keyOf(corner)] > 1)
            continue;
        const vec2 step = glm::abs(onPage(scene, corner % 3 == 2 ? corner - 2 : corner + 1) - onPage(scene, corner));
        rim += 0.5 * static_cast<double>(step.x + step.y);
    }
    return rim;
}

PageSize measure(const StaticScene& scene)
{
    PageSize page{.places = static_cast<double>(scene.atlasExtent.x) * scene.atlasExtent.y, .rim = rimOf(scene)};
    for (uint32_t triangle = 0; triangle < scene.triangleCount(); ++triangle) {
        const uint32_t* corners = &scene.indices[size_t{3} * triangle];
        const vec3 a = scene.positions[corners[0]], b = scene.positions[corners[1]], c = scene.positions[corners[2]];
        const vec2 ab = onPage(scene, 3 * triangle + 1) - onPage(scene, 3 * triangle);
        const vec2 ac = onPage(scene, 3 * triangle + 2) - onPage(scene, 3 * triangle);
        page.area += 0.5 * static_cast<double>(std::abs(ab.x * ac.y - ab.y * ac.x));
        page.charted += 0.5 * static_cast<double>(glm::length(glm::cross(b - a, c - a)));
    }
    return page;
}

/// Of a page whose density is `scale` times what it was.
double texelsAt(const PageSize& page, double scale)
{
    return std::min(page.places * scale * scale, page.area * scale * scale + page.rim * scale);
}

double bytesAt(const StaticScene& scene, const BakeSettings& settings, const PageSize& page, double scale)
{
    const double texels = texelsAt(page, scale), places = page.places * scale * scale;
    const double vectorBytes = settings.coefficientCount() * static_cast<double>(sizeof(vec3));
    const double halfBytes = settings.coefficientCount() * 3.0 * sizeof(uint16_t);
    const double cells = gridOver(scene.bounds(), settings.cellMetres).cellCount();
    const double transfers = texels * vectorBytes;

    const double surfaces = kFixed + kPerTriangle * scene.triangleCount();
    const double mapping = kPerPlace * places + kPerTexel * texels;
    const double kept = surfaces + 4 * places + kPerTexelKept * texels;
    const double bouncing = kept + (settings.bounces > 0 ? 3 : 2) * transfers;
    const double inVolume = kept + 2 * transfers + cells * kLocalCoefficients * vectorBytes;
    const double packing = inVolume + places * (4 + halfBytes) + cells * kLocalCoefficients * halfBytes;
    return std::max({mapping, bouncing, packing});
}

} // namespace

BakeEstimate estimate(const StaticScene& scene, const BakeSettings& settings)
{
    const PageSize page = measure(scene);
    const uint64_t cells = gridOver(scene.bounds(), settings.cellMetres).cellCount();
    return {.bytes = static_cast<uint64_t>(bytesAt(scene, settings, page, 1)),
            .rays = rayCount(settings, static_cast<uint64_t>(texelsAt(page, 1)), cells)};
}

std::optional<float> densityWithin(const StaticScene& scene, const BakeSettings& settings, uint64_t mostBytes)
{
    const PageSize page = measure(scene);
    if (!(page.charted > 0))
        return std::nullopt;
    // The page may have had no room for the density that was asked.
    const double density = std::min(static_cast<double>(settings.texelsPerMetre), std::sqrt(page.area / page.charted));
    const auto fits = [&](double scale) { return bytesAt(scene, settings, page, scale) <= static_cast<double>(mostBytes); };
    if (fits(1))
        return static_cast<float>(density);
    constexpr double kLeastScale = 0.02; // coarser than that, nothing is left to see
    if (!fits(kLeastScale))
        return std::nullopt;
    double within = kLeastScale, beyond = 1;
    for (int step = 0; step < 20; ++step) {
        const double middle = 0.5 * (within + beyond);
        (fits(middle) ? within : beyond) = middle;
    }
    return static_cast<float>(density * within);
}

} // namespace antumbra::bake
