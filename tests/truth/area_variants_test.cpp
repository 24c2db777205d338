// What area lights' closed form can be asked to do otherwise: triangle by triangle, and with fewer planes an occluder.
#include "truth/shown.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace antumbra::truth {
namespace {

using render::Aov;

class AreaVariants : public DeviceTest
{
protected:
    static constexpr const char* kAllPieces = "4096";

    static scene::ImageF irradiance(Shown& shown, std::string_view key, std::string_view value)
    {
        shown.set(key, value);
        return shown.capture(Aov::Irradiance);
    }
};

struct Gallery
{
    const char* name;
    scene::Settings settings;
};

void PrintTo(const Gallery& gallery, std::ostream* out) { *out << gallery.name; }

class AreaTriangles : public AreaVariants, public testing::WithParamInterface<Gallery>
{
};

// Triangles of one body meet along their edges, where the paper's set difference failed.
TEST_P(AreaTriangles, GiveThePictureOfTheirBodies)
{
    Shown shown(device(), namedScene("gallery", GetParam().settings));
    shown.set("area.pieces", kAllPieces);
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    const scene::ImageF unshadowed = irradiance(shown, "area.shadow", "none");
    const scene::ImageF whole = irradiance(shown, "area.shadow", "analytic");
    const scene::ImageF triangles = irradiance(shown, "area.shadow", "triangles");
    const double light = meanOf(unshadowed, surface);
    EXPECT_LT(rmse(triangles, whole, surface), 1e-4 * light);
    EXPECT_GT(rmse(unshadowed, whole, surface), 0.02 * light) << "there is next to no shadow to get wrong";
    const shader::CounterBlock counters = shown.counters();
    EXPECT_EQ(counters.nanPixels + counters.infPixels + counters.negativePixels, 0u);
    EXPECT_EQ(counters.fallbackPixels, 0u) << "nothing is left to samples";
}

INSTANTIATE_TEST_SUITE_P(Truth, AreaTriangles,
                         testing::Values(Gallery{"PlaneCube", {{"gallery.lights", "2"}, {"gallery.occluders", "3"}}},
                                         Gallery{
                                             "CylinderIcosphere",
                                             {{"gallery.light", "cylinder"}, {"gallery.occluder", "icosphere"}, {"gallery.lights", "2"}}},
                                         Gallery{"ConeCube", {{"gallery.light", "cone"}, {"gallery.occluders", "2"}}}),
                         [](const auto& test) { return std::string(test.param.name); });

// Whole bodies are hidden by what is before them; what a body holds is hidden from all sides by its triangles too.
TEST_F(AreaVariants, TrianglesOfAClosedBoxLetNothingOut)
{
    scene::SceneFile scene = darkScene();
    scene.entities.push_back(lampAt({0, 1, 0}));
    scene.entities.push_back(blocker({0, 1, 0}, vec3(0.8f)));
    Shown closed(device(), scene);
    closed.set("area.shadow", "triangles");
    const std::vector<size_t> surface = surfaceOf(closed.capture(Aov::Depth));
    EXPECT_LT(meanOf(closed.capture(Aov::Irradiance), surface), 1e-6);
}

TEST_F(AreaVariants, FewerPlanesMakeShadowsLargerBySoMuchLessTheMoreThereAre)
{
    Shown shown(device(), namedScene("gallery", {{"gallery.occluder", "ellipsoid"}, {"gallery.occluders", "2"}}));
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    shown.set("area.shadow", "analytic");
    const scene::ImageF all = shown.capture(Aov::Irradiance);
    const double light = meanOf(all, surface);
    double before = 1e30;
    for (const char* planes : {"4", "6", "8", "12"}) {
        const scene::ImageF fewer = irradiance(shown, "area.planes", planes);
        const double error = rmse(fewer, all, surface) / light;
        RecordProperty(std::string("planes") + planes, std::to_string(error));
        EXPECT_LT(error, before) << planes;
        before = error;
        for (const size_t pixel : surface)
            EXPECT_LE(pixelOf(fewer, pixel).x, pixelOf(all, pixel).x * 1.001f + 1e-5f) << planes << " planes brighten pixel " << pixel;
    }
    EXPECT_GT(before, 0);
    EXPECT_EQ(irradiance(shown, "area.planes", "64").values, all.values);
}

/// Cosine-weighted solid angle of a polygon's edges from `point`, by Lambert's formula; negative where they run the other way.
double formFactor(const vec3& point, const vec3& normal, std::span<const shader::ProbeLine> edges)
{
    double sum = 0;
    for (const shader::ProbeLine& edge : edges) {
        const glm::dvec3 a = glm::normalize(glm::dvec3(edge.start - point)), b = glm::normalize(glm::dvec3(edge.end - point));
        const glm::dvec3 across = glm::cross(a, b);
        const double sine = glm::length(across);
        if (sine > 1e-9)
            sum += std::atan2(sine, glm::dot(a, b)) / sine * glm::dot(across, glm::dvec3(normal));
    }
    return 0.5 * sum;
}

// Pieces do not overlap, so that their edges, all together, give what arrives.
TEST_F(AreaVariants, TheLinesOfAPixelGiveItsIrradiance)
{
    scene::SceneFile scene = darkScene();
    scene.entities.push_back(lampAt({0, 1.4f, 0}, vec3(1)));
    scene.entities.push_back(blocker({0.1f, 0.7f, 0.1f}, vec3(0.3f)));
    scene.entities.push_back(blocker({-0.15f, 0.8f, -0.1f}, vec3(0.2f)));
    Shown shown(device(), scene);
    const scene::ImageF depth = shown.capture(Aov::Depth), found = irradiance(shown, "area.shadow", "analytic");
    const scene::ImageF normal = shown.capture(Aov::Normal), unshadowed = irradiance(shown, "area.shadow", "none");
    uint32_t partly = 0;
    for (size_t pixel = 0; pixel < depth.values.size(); pixel += 5) {
        const uvec2 at(pixel % depth.width, pixel / depth.width);
        const vec3 point = positionAt(shown.view().camera, Shown::kExtent, at, depth.values[pixel]);
        const double share = pixelOf(found, pixel).x / pixelOf(unshadowed, pixel).x;
        if (!(depth.values[pixel] > 0) || point.y > 0.01f || share < 0.05 || share > 0.95)
            continue;
        shown.view().probedPixel = ivec2(at);
        shown.draw(1 + gpu::kFramesInFlight);
        std::vector<shader::ProbeLine> lights, pieces;
        for (const shader::ProbeLine& line : shown.renderer().probeLines())
            if (line.kind != shader::kProbeSilhouette)
                (line.kind == shader::kProbeLight ? lights : pieces).push_back(line);
        ASSERT_EQ(lights.size(), 4u);
        const vec3 up = pixelOf(normal, pixel);
        EXPECT_NEAR(formFactor(point, up, lights), pixelOf(unshadowed, pixel).x, 2e-3 * pixelOf(unshadowed, pixel).x);
        EXPECT_NEAR(formFactor(point, up, pieces), pixelOf(found, pixel).x, 2e-3 * pixelOf(unshadowed, pixel).x);
        ++partly;
    }
    EXPECT_GT(partly, 20u);
    shown.view().probedPixel.reset();
    shown.draw(1 + gpu::kFramesInFlight);
    EXPECT_TRUE(shown.renderer().probeLines().empty());
    EXPECT_EQ(std::ranges::count(stepsOf(shown), "area probe"), 0);
}

} // namespace
} // namespace antumbra::truth
