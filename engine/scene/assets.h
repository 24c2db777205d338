// What a scene is made of, loaded once: components name its parts by index.
#pragma once

#include "scene/images.h"
#include "scene/model.h"

#include <vector>

namespace antumbra::scene {

struct Assets
{
    std::vector<Model> models;
    std::vector<ImageF> environments; // equirectangular, W/(m^2 sr)
};

} // namespace antumbra::scene
