// Area light from one frame to the next: how much more the picture changes than the truth does, as a whole; and where it changes otherwise,
// which counts shadows that move as smoothly but are of another shape too. `traced` takes as long as the closed form here or longer, and
// its noise stands still on the screen: it changes as things move under it.
#include "truth/shown.h"

#include <cmath>

namespace antumbra::truth {
namespace {

using render::Aov;

class AreaStability : public DeviceTest
{
protected:
    static constexpr int kChanges = 2;

    /// W/m^2, RMS over the floor and the changes.
    struct Change
    {
        double own = 0;
        double otherwise = 0; // less the truth's
    };

    struct Changes
    {
        Change truth, analytic, traced;
    };

    static scene::ImageF irradianceBy(Shown& shown, const char* shadow)
    {
        shown.set("area.shadow", shadow);
        return shown.capture(Aov::Irradiance);
    }

    static scene::ImageF truthOf(Shown& shown, uint32_t samples)
    {
        shown.set("area.shadow", "reference");
        shown.set("reference.samples", std::to_string(samples));
        do
            shown.draw();
        while (shown.renderer().referenceSamples().value() < samples);
        return shown.capture(Aov::Irradiance);
    }

    static scene::ImageF difference(scene::ImageF a, const scene::ImageF& b)
    {
        for (size_t i = 0; i < a.values.size(); ++i)
            a.values[i] -= b.values[i];
        return a;
    }

    /// Level surface that stays where it is.
    static std::vector<size_t> floorOf(Shown& shown, const scene::ImageF& depthBefore)
    {
        const scene::ImageF depth = shown.capture(Aov::Depth), normals = shown.capture(Aov::Normal);
        std::vector<size_t> level;
        for (const size_t pixel : surfaceOf(depth))
            if (pixelOf(normals, pixel).y > 0.999f && std::abs(depth.values[pixel] - depthBefore.values[pixel]) < 1e-3f)
                level.push_back(pixel);
        return level;
    }

    static void add(Change& squares, const scene::ImageF& change, const scene::ImageF& truth, const std::vector<size_t>& level)
    {
        const scene::ImageF none = difference(change, change);
        squares.own += std::pow(rmse(change, none, level), 2) / kChanges;
        squares.otherwise += std::pow(rmse(change, truth, level), 2) / kChanges;
    }

    /// Clips go on and lights move, as in frames of a sixtieth of a second.
    Changes changesIn(const scene::SceneFile& scene, uint32_t samples)
    {
        Shown shown(device(), scene, {128, 72});
        shown.set("area.scale", "1");
        shown.set("area.pieces", "64");
        shown.set("area.rays", "16");
        scene::ImageF depth, truth, analytic, traced;
        Changes changes;
        for (int frame = 0; frame <= kChanges; ++frame) {
            shown.advance(1.0f / 60);
            for (render::AreaLightDraw& light : shown.view().areaLights)
                light.world[3] += vec4(0.006f, 0, 0.003f, 0) * static_cast<float>(frame);
            const scene::ImageF truthNow = truthOf(shown, samples), analyticNow = irradianceBy(shown, "analytic"),
                                tracedNow = irradianceBy(shown, "traced");
            if (frame > 0) {
                const std::vector<size_t> level = floorOf(shown, depth);
                const scene::ImageF change = difference(truthNow, truth);
                add(changes.truth, change, change, level);
                add(changes.analytic, difference(analyticNow, analytic), change, level);
                add(changes.traced, difference(tracedNow, traced), change, level);
            }
            depth = shown.capture(Aov::Depth);
            truth = truthNow;
            analytic = analyticNow;
            traced = tracedNow;
        }
        for (Change* change : {&changes.truth, &changes.analytic, &changes.traced})
            *change = {std::sqrt(change->own), std::sqrt(change->otherwise)};
        return changes;
    }

    void expectStable(const scene::SceneFile& scene, uint32_t samples, double shareMore, double shareOtherwise)
    {
        const auto [truth, analytic, traced] = changesIn(scene, samples);
        std::printf("change: truth %.5f, analytic %.5f, traced %.5f; otherwise: analytic %.5f, traced %.5f\n", truth.own, analytic.own,
                    traced.own, analytic.otherwise, traced.otherwise);
        EXPECT_LE(analytic.own - truth.own, shareMore * (traced.own - truth.own));
        EXPECT_LE(analytic.otherwise, shareOtherwise * traced.otherwise);
        EXPECT_GT(analytic.otherwise, 0) << "nothing moved";
    }
};

TEST_F(AreaStability, BodiesThatAreWhatTheyStandForFlickerByATenthOfWhatRaysDo)
{
    for (const char* name : {"dining", "gallery"}) {
        SCOPED_TRACE(name);
        expectStable(namedScene(name), 4096, 0.1, 0.1);
    }
}

// A hull's shadow is another than the character's, and moves along.
TEST_F(AreaStability, CharactersFlickerByATenthOfWhatRaysDo)
{
    scene::SceneFile coarse = namedScene("stage"), fine = coarse;
    for (scene::SceneEntity& entity : fine.entities)
        if (entity.occluder)
            entity.occluder->greatestVertices = 32;
    expectStable(coarse, 512, 0.1, 0.6);
    expectStable(fine, 512, 0.1, 0.4);
}

TEST_F(AreaStability, CapsulesFlickerLessThanRays)
{
    scene::SceneFile scene = namedScene("stage");
    for (scene::SceneEntity& entity : scene.entities)
        if (entity.occluder) {
            entity.occluder.reset();
            entity.sdfPrimitive = scene::SDFPrimitive{.shape = scene::SDFShape::Bones};
        }
    expectStable(scene, 512, 0.5, 0.9);
}

} // namespace
} // namespace antumbra::truth
