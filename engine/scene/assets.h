// What a scene is made of, loaded once: components name its parts by index.
#pragma once

#include "scene/bone_capsules.h"
#include "scene/convex_body.h"
#include "scene/images.h"
#include "scene/model.h"

#include <vector>

namespace antumbra::scene {

/// What shines or blocks, or a part of it. `joint` moves it out of bind space; where that is kNoIndex it is in the entity's own.
struct BodyPart
{
    ConvexBody body;
    uint32_t joint = kNoIndex;
    bool isHollow = false; // stands for a surface that lies in it, or up to `margin` outside: hides nothing from there
    float margin = 0;      // metres, in the space of the body
};

struct Assets
{
    std::vector<Model> models;
    std::vector<ImageF> environments;  // equirectangular, W/(m^2 sr)
    std::vector<BodyPart> bodyParts;   // of area lights and their occluders
    std::vector<BoneCapsule> capsules; // of characters that are fields to area lights
};

} // namespace antumbra::scene
