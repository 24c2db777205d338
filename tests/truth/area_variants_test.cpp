// What area lights' closed form can be asked to do otherwise: triangle by triangle, and with fewer planes an occluder.
#include "truth/shown.h"

#include <algorithm>

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

} // namespace
} // namespace antumbra::truth
