// Bakes the light of a scene into a file, with a progress bar on stderr: what the tool does, and the player where it is asked to.
#pragma once

#include "app/interrupt.h"
#include "bake/bake.h"
#include "bake/peers.h"
#include "base/file.h"
#include "scene/scene_file.h"

#include <optional>

namespace antumbra::app {

struct BakeRequest
{
    scene::SceneFile scene;
    bake::BakeSettings settings;
    Path output;
    uint32_t threads = 0;              // of this process; 0: as many as the machine has
    std::optional<uint64_t> mostBytes; // of memory that this process may take
    bool isResumed = false;            // goes on from what an interrupted bake has kept
    bake::Peers peers;
};

/// The first of the peers writes the file and says on standard output what the bake took. False where somebody interrupted it: what is
/// done is kept beside the output. Throws Error for a scene without StaticPRT, too little memory (naming the density that fits), and as
/// populate() and bakeScene() do.
bool bakeToFile(const BakeRequest& request, const InterruptGuard& interrupt);

/// Where an interrupted bake keeps what is done.
Path partialOf(const Path& output);

} // namespace antumbra::app
