#include "truth/baked.h"

#include "bake/statics.h"

#include <glm/gtc/packing.hpp>

namespace antumbra::truth {

namespace {

using scene::MeshKind;

constexpr float kGroundMetres = 6;
const uvec2 kPage{16, 12};

/// Of -0.5..0.5, with a texel of the page left free all around, as charts leave it.
vec2 onPage(vec2 place) { return (1.0f + (place + 0.5f) * vec2(kPage - 2u)) / vec2(kPage); }

void chart(ecs::World& world, ecs::Schedule&)
{
    auto& assets = world.resource<scene::Assets>();
    const bake::Statics statics = bake::staticsOf(world, assets);
    bake::Atlas atlas;
    for (const bake::AtlasObject& object : statics.objects) {
        scene::Mesh& mesh = atlas.meshes.emplace_back(object.model->mesh);
        for (const vec3& position : mesh.positions)
            mesh.bakeUvs.push_back(onPage(vec2(position.x, position.z)));
    }
    bake::drawCharted(world, assets, statics, std::move(atlas));
}

bake::Bake emptyBake(uint32_t bands)
{
    bake::Bake bake{.settings = {.bands = bands, .bounces = 0}};
    const size_t coefficients = bake.settings.coefficientCount();
    bake.atlas.extent = kPage;
    bake.atlas.planes.resize(coefficients * 3 * kPage.x * kPage.y);
    bake.volume.grid = {.origin = {-3.4f, -0.3f, -3.6f}, .spacing = {1.7f, 0.9f, 1.4f}, .count = {5, 4, 6}};
    const size_t cells = bake.volume.grid.cellCount();
    bake.volume.planes.resize(bake::kLocalCoefficients * coefficients * 3 * cells);
    bake.volume.isOpen.resize(cells, 1);
    return bake;
}

scene::SceneFile bakedGround()
{
    scene::SceneFile scene = emptyScene();
    scene.camera.target = {0, 0.6f, 0};
    scene.environment =
        scene::SceneEnvironment{.file = projectPath("assets") / "environments/low_sun.hdr", .rotationRadians = 2, .intensity = 1.3f};
    scene.entities = {ground(), walker({-0.5f, 0, 0.2f}, "walk"), movingShape(MeshKind::Sphere, {0.6f, 0.6f, 0}, vec3(0.8f))};
    return scene;
}

} // namespace

ShownGround::ShownGround(gpu::Device& device, const bake::Bake* bake) : ShownGround(device, bake, bakedGround()) {}

ShownGround::ShownGround(gpu::Device& device, const bake::Bake* bake, const scene::SceneFile& scene)
    : Shown(device, scene, Shown::kExtent, 0.3f, chart), bake_(bake)
{
    view().bake = bake;
}

void ShownGround::advance(float seconds)
{
    Shown::advance(seconds);
    view().bake = bake_;
}

scene::SceneEntity ground() { return staticShape(MeshKind::Plane, {0, 0, 0}, {kGroundMetres, 1, kGroundMetres}); }

vec2 groundUv(vec3 position) { return onPage(vec2(position.x, position.z) / kGroundMetres); }

bake::Bake bakeOf(uint32_t bands, const Transport& transport)
{
    bake::Bake bake = emptyBake(bands);
    const uint32_t coefficients = bake.settings.coefficientCount();
    const auto fill = [](std::vector<uint16_t>& planes, size_t plane, size_t size, double value) {
        std::fill_n(planes.begin() + static_cast<std::ptrdiff_t>(plane * size), size, glm::packHalf1x16(static_cast<float>(value)));
    };
    for (uint32_t i = 0; i < coefficients; ++i)
        for (uint32_t c = 0; c < 3; ++c) {
            fill(bake.atlas.planes, size_t{3} * i + c, size_t{bake.atlas.extent.x} * bake.atlas.extent.y, transport.texel(i));
            for (uint32_t j = 0; j < bake::kLocalCoefficients; ++j)
                fill(bake.volume.planes, (size_t{j} * coefficients + i) * 3 + c, bake.volume.grid.cellCount(), transport.cell(j, i));
        }
    return bake;
}

double openTexel(uint32_t i)
{
    bake::ShFunction one{.bands = bake::kMostBands};
    one.coefficients[i] = glm::dvec3(1);
    return bake::irradianceOf(one)({0, 1, 0}).x;
}

double openCell(uint32_t j, uint32_t i) { return i == j ? 1 : 0; }

bake::Bake openBake(uint32_t bands) { return bakeOf(bands, {openTexel, openCell}); }

bake::Bake randomBake(uint32_t bands, uint32_t seed)
{
    bake::Bake bake = emptyBake(bands);
    RandomInputs random(seed);
    for (std::vector<uint16_t>* planes : {&bake.atlas.planes, &bake.volume.planes})
        for (uint16_t& value : *planes)
            value = glm::packHalf1x16(static_cast<float>(random.uniform(-1, 1)));
    // Light as there can be: its mean is above nothing, whatever its bands.
    const size_t cells = bake.volume.grid.cellCount(), columns = size_t{3} * bake.settings.coefficientCount();
    for (size_t i = 0; i < columns * cells; ++i)
        bake.volume.planes[i] = glm::packHalf1x16(static_cast<float>(i < 3 * cells ? random.uniform(0.5, 1) : random.uniform(-0.05, 0.05)));
    for (uint8_t& isOpen : bake.volume.isOpen)
        isOpen = random.index(3) != 0 ? 1 : 0;
    return bake;
}

bake::ShFunction environmentLight(Shown& shown, uint32_t bands)
{
    const render::EnvironmentView& environment = shown.view().environment;
    bake::ShFunction light =
        bake::rotatedAboutY(bake::project(shown.assets().environments[environment.image], bands), environment.rotationRadians);
    for (glm::dvec3& coefficient : light.coefficients)
        coefficient *= environment.intensity;
    return bake::windowed(light, shown.view().knobs.prt.window);
}

} // namespace antumbra::truth
