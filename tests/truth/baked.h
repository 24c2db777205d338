// Bakes made by hand, for which the right picture is known, and scenes whose ground is lit by them.
#pragma once

#include "bake/sh.h"
#include "tests/gpu/random_inputs.h"
#include "truth/shown.h"

#include <functional>

namespace antumbra::truth {

/// A walker and a sphere on a ground that is StaticPRT, 6 m wide about the origin, under a low sun. The ground covers the page but for a
/// texel all around, x along u and z along v.
class ShownGround : public Shown
{
public:
    /// `bake` must outlive it; null: nothing is baked.
    ShownGround(gpu::Device& device, const bake::Bake* bake);
    /// With a ground as above, under whatever else.
    ShownGround(gpu::Device& device, const bake::Bake* bake, const scene::SceneFile& scene);

    void advance(float seconds);

private:
    const bake::Bake* bake_;
};

/// That ground alone, and where a place on it lies on the page.
scene::SceneEntity ground();
vec2 groundUv(vec3 position);

/// The same transfer at every texel and cell, by coefficient and by row and column.
struct Transport
{
    std::function<double(uint32_t i)> texel;
    std::function<double(uint32_t j, uint32_t i)> cell;
};
/// An atlas of 16 x 12 texels, and 5 x 4 x 6 cells that reach a little past the scene, all open.
bake::Bake bakeOf(uint32_t bands, const Transport& transport);

/// Of an open plane that faces up, where nothing but the environment shines.
double openTexel(uint32_t i);
double openCell(uint32_t j, uint32_t i);
bake::Bake openBake(uint32_t bands);

/// Every texel and cell its own, a third of the cells closed.
bake::Bake randomBake(uint32_t bands, uint32_t seed);

/// The environment of the view as `bands` bands, turned, scaled and windowed.
bake::ShFunction environmentLight(Shown& shown, uint32_t bands);

} // namespace antumbra::truth
