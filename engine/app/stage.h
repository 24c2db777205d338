// A scene that is being played: its World, its assets, the systems that move it, and the seed that makes it repeatable.
// Draws nothing; the same seed and the same input frames always give the same state.
#pragma once

#include "app/baked_light.h"
#include "app/input_frame.h"
#include "app/random.h"
#include "ecs/schedule.h"
#include "render/frame_view.h"
#include "scene/assets.h"
#include "scene/scene_file.h"

#include <string>

namespace antumbra::app {

/// Adds a game's components, resources and systems. Systems may use the resources InputFrame, Random, scene::Assets (to read) and
/// ecs::Seconds: the simulated time of the step, which a system of the game may change for those after it.
using Gameplay = void (*)(ecs::World& world, ecs::Schedule& schedule);
/// The scene only plays its clips.
void noGameplay(ecs::World& world, ecs::Schedule& schedule);

/// `scene` is a name under assets/scenes, a scene file, or a .glb or .gltf, as the commands take it; `overrides` can size a crowd.
/// Throws Error for a scene that is not there, with the known names, and for one that does not load.
scene::SceneFile findScene(const std::string& scene, const scene::Settings& overrides);

class Stage
{
public:
    /// Loads everything; `overrides` can ask for another bake than the scene's settings do. Throws Error as loadScene() and populate() do.
    Stage(const scene::SceneFile& scene, uint64_t seed, Gameplay gameplay, const render::Settings& overrides = {});

    /// One step of kStepSeconds.
    void step(const InputFrame& input);
    /// Clips alone advance by `seconds`.
    void advanceClips(float seconds);

    [[nodiscard]] uint64_t stepCount() const { return stepCount_; }
    /// FNV-1a over the state that steps change, in a fixed order.
    [[nodiscard]] uint64_t stateHash() const;
    /// Camera, light, bake and what is drawn; knobs, exposure and split stay the caller's. The stage must outlive the frames that show it.
    void extract(render::FrameView& view) const;

    [[nodiscard]] const scene::Assets& assets() const { return world_.resource<scene::Assets>(); }
    /// The scene file's knobs.
    [[nodiscard]] const render::Settings& settings() const { return settings_; }
    [[nodiscard]] const ecs::World& world() const { return world_; }
    [[nodiscard]] const BakedLight& bakedLight() const { return bakedLight_; }

private:
    ecs::World world_;
    ecs::Schedule gameplay_; // of the game
    ecs::Schedule motion_;   // after it: from clips and transforms to poses and matrices
    render::Settings settings_;
    BakedLight bakedLight_;
    uint64_t stepCount_ = 0;
};

} // namespace antumbra::app
