#include "scene/animation.h"
#include "scene/gltf.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace antumbra::scene {

namespace {

std::string describe(const Model& model)
{
    const Mesh& mesh = model.mesh;
    const Aabb bounds = restMesh(model).bounds();
    std::string text = fmt::format("glTF \"{}\"\n", model.name);
    text += fmt::format("  triangles {}, vertices {}, morph targets {}\n", mesh.indices.size() / 3, mesh.positions.size(),
                        mesh.morphTargets.size());
    text += fmt::format("  nodes {}, joints {}, materials {}, images {}\n", model.nodes.size(), model.joints.size(), model.materials.size(),
                        model.images.size());
    if (!bounds.isEmpty())
        text += fmt::format("  at rest {:.4g} {:.4g} {:.4g} to {:.4g} {:.4g} {:.4g} m\n", bounds.lowest.x, bounds.lowest.y, bounds.lowest.z,
                            bounds.highest.x, bounds.highest.y, bounds.highest.z);
    for (const Image8& image : model.images)
        text += fmt::format("  image {}x{}\n", image.width, image.height);
    for (const Clip& clip : model.clips)
        text += fmt::format("  clip \"{}\" {:.3f} s, {} tracks\n", clip.name, clip.duration, clip.tracks.size());
    return text;
}

std::string describe(const Path& path, const ImageF& image)
{
    std::string text =
        fmt::format("image \"{}\" {}x{}, {} channels\n", path.filename().string(), image.width, image.height, image.channels);
    for (size_t channel = 0; channel < image.channels; ++channel) {
        float least = std::numeric_limits<float>::infinity();
        float greatest = -least;
        double sum = 0;
        size_t finite = 0;
        for (size_t i = channel; i < image.values.size(); i += image.channels) {
            const float value = image.values[i];
            if (!std::isfinite(value))
                continue;
            least = std::min(least, value);
            greatest = std::max(greatest, value);
            sum += value;
            ++finite;
        }
        const size_t pixels = image.values.size() / image.channels;
        text += fmt::format("  channel {}: min {:.6g}, mean {:.6g}, max {:.6g}, not finite {}\n", channel, least,
                            sum / static_cast<double>(std::max<size_t>(finite, 1)), greatest, pixels - finite);
    }
    return text;
}

} // namespace

std::string inspect(const Path& path)
{
    const std::string extension = path.extension().string();
    if (extension == ".glb" || extension == ".gltf")
        return describe(loadGltf(path));
    return describe(path, loadImageF(path));
}

} // namespace antumbra::scene
