// What truth tests share: a scene before the renderer, its pictures as numbers, and scenes of a few shapes.
#pragma once

#include "app/stage.h"
#include "gpu/device_fixture.h"
#include "render/renderer.h"

namespace antumbra::truth {

/// A scene, a renderer and the knobs it is drawn with: at first full resolution, 128 samples, no filter, no tolerance, every pose built at
/// once.
class Shown
{
public:
    static constexpr uvec2 kExtent{96, 54};

    Shown(gpu::Device& device, const scene::SceneFile& scene, uvec2 extent = kExtent, float seconds = 0,
          app::Gameplay gameplay = app::noGameplay);

    void set(std::string_view key, std::string_view value) { render::set(view_.knobs, key, value); }
    void advance(float seconds);
    render::FrameView& view() { return view_; }
    [[nodiscard]] const app::Stage& stage() const { return stage_; }
    render::Renderer& renderer() { return renderer_; }
    [[nodiscard]] const scene::Assets& assets() const { return stage_.assets(); }

    void draw(uint32_t frames = 1);
    /// Of a frame that is drawn for it.
    scene::ImageF capture(render::Aov aov);
    /// The occluded irradiance of the reference, accumulated further where the view has not changed.
    scene::ImageF reference(uint32_t samples);
    shader::CounterBlock counters();

private:
    app::Stage stage_;
    render::Renderer renderer_;
    render::FrameView view_;
};

/// occlusion.backend, by name.
struct Backend
{
    std::string_view name;
    render::RayBackend backend;

    friend void PrintTo(const Backend& backend, std::ostream* out) { *out << backend.name; }
};

inline constexpr Backend kRayQuery{"ray-query", render::RayBackend::RayQuery};
inline constexpr Backend kComputeBvh{"compute-bvh", render::RayBackend::ComputeBvh};

/// For what holds whatever traces the rays. `Param` is a Backend, or a tuple with one. Skipped where the device lacks it.
template <class Param>
class BackendTest : public DeviceTest, public testing::WithParamInterface<Param>
{
protected:
    void SetUp() override
    {
        DeviceTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure() && render::backendFor(backend().backend, device().info().rayQuery) != backend().backend)
            GTEST_SKIP() << "the device has no " << backend().name;
    }

    [[nodiscard]] static const Backend& backend()
    {
        if constexpr (std::is_same_v<Param, Backend>)
            return BackendTest::GetParam();
        else
            return testing::get<Backend>(BackendTest::GetParam());
    }
};

/// As in "RayQuery" for GoogleTest, which takes no dashes.
std::string backendName(const testing::TestParamInfo<Backend>& test);

/// Where the surface of a pixel is; view depth in metres, as Aov::Depth has it.
vec3 positionAt(const render::CameraView& camera, uvec2 extent, uvec2 pixel, float depthView);

/// The passes of the newest frame, in order.
std::vector<std::string> stepsOf(Shown& shown);
/// Device bytes in use once all that was given up is freed.
uint64_t settledBytes(gpu::Device& device);

/// The pixels that show a surface.
std::vector<size_t> surfaceOf(const scene::ImageF& depth);
/// Those that show a point of this height, metres.
std::vector<size_t> pixelsAtHeight(Shown& shown, float height);
vec3 pixelOf(const scene::ImageF& image, size_t pixel);
double meanOf(const scene::ImageF& image, const std::vector<size_t>& pixels);
/// Between two pictures, over all channels.
double rmse(const scene::ImageF& a, const scene::ImageF& b, const std::vector<size_t>& pixels);

scene::SceneFile namedScene(const std::string& name, const scene::Settings& overrides = {});

/// A camera that looks down at the origin, under uniform light of 1 W/(m^2 sr).
scene::SceneFile emptyScene();
scene::SceneEntity staticShape(scene::MeshKind kind, vec3 position, vec3 scale);
scene::SceneEntity movingShape(scene::MeshKind kind, vec3 position, vec3 scale);
/// A solid given by its distance field.
scene::SceneEntity fieldBall(vec3 position, float radius);
scene::SceneEntity walker(vec3 position, const std::string& clip);
/// A floor, seen by the same camera, and no environment.
scene::SceneFile darkScene();
/// A square lamp of 0.4 m that shines down.
scene::SceneEntity lampAt(vec3 position, vec3 radiance = vec3(10));
/// A cube that hides light of area lights.
scene::SceneEntity blocker(vec3 position, vec3 scale);

} // namespace antumbra::truth
