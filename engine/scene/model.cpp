#include "scene/model.h"

namespace antumbra::scene {

Model rigidModel(std::string name, Mesh mesh, const Material& material)
{
    Model model;
    model.name = name;
    model.nodes.push_back({.name = std::move(name), .parent = kNoIndex, .rest = {}});
    model.joints.push_back({});
    model.materials.push_back(material);
    model.mesh = std::move(mesh);
    model.mesh.influences.assign(model.mesh.positions.size(), Influence{});
    return model;
}

} // namespace antumbra::scene
