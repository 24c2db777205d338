#include "bake/ltc.h"

#include "base/check.h"
#include "base/error.h"
#include "scene/images.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace antumbra::bake {

namespace {

constexpr uint32_t kLeastSize = 2, kGreatestSize = 1024; // texels a side
constexpr float kGreatestAmplitude = 1.01f;              // a fit may be a little off one
constexpr uint32_t kChannels = 4;

std::vector<vec4> loadTable(const Path& path, uint32_t& size)
{
    const scene::ImageF picture = scene::loadImageF(path);
    if (picture.channels != kChannels)
        throw Error(fmt::format("a table of {} channels, not {}", picture.channels, kChannels), path.string());
    if (picture.width != picture.height || picture.width < kLeastSize || picture.width > kGreatestSize)
        throw Error(fmt::format("a table of {} x {} texels; they are square, of {} to {} a side", picture.width, picture.height, kLeastSize,
                                kGreatestSize),
                    path.string());
    if (!std::ranges::all_of(picture.values, [](float value) { return std::isfinite(value); }))
        throw Error("a table with values that are not finite", path.string());

    size = picture.width;
    std::vector<vec4> texels(size_t{size} * size);
    for (size_t i = 0; i < texels.size(); ++i)
        texels[i] = {picture.values[kChannels * i], picture.values[kChannels * i + 1], picture.values[kChannels * i + 2],
                     picture.values[kChannels * i + 3]};
    return texels;
}

bool turnsNothingOver(const vec4& matrix) { return double{matrix.x} * matrix.w - double{matrix.y} * matrix.z > 0; }

bool isShare(const vec4& amplitude)
{
    return amplitude.x >= 0 && amplitude.x <= kGreatestAmplitude && amplitude.y >= 0 && amplitude.y <= kGreatestAmplitude;
}

void saveTable(const Path& path, const std::vector<vec4>& texels, uint32_t size)
{
    check(texels.size() == size_t{size} * size, "a table with all its texels");
    scene::ImageF picture{.width = size, .height = size, .channels = kChannels, .values = {}};
    for (const vec4& texel : texels)
        picture.values.insert(picture.values.end(), {texel.x, texel.y, texel.z, texel.w});
    scene::saveExr(path, picture);
}

} // namespace

LtcTables loadLtcTables(const Path& folder) { return loadLtcTables(folder / kLtcMatrixFile, folder / kLtcAmplitudeFile); }

LtcTables loadLtcTables(const Path& matrix, const Path& amplitude)
{
    LtcTables tables;
    uint32_t amplitudeSize = 0;
    tables.matrix = loadTable(matrix, tables.size);
    tables.amplitude = loadTable(amplitude, amplitudeSize);
    if (amplitudeSize != tables.size)
        throw Error(fmt::format("a table of {} texels a side, its matrices of {}", amplitudeSize, tables.size), amplitude.string());
    if (!std::ranges::all_of(tables.matrix, turnsNothingOver))
        throw Error("not a table of linearly transformed cosines: a matrix of no positive determinant", matrix.string());
    if (!std::ranges::all_of(tables.amplitude, isShare))
        throw Error("not a table of what is reflected: a share that is not 0 to 1", amplitude.string());
    return tables;
}

void saveLtcTables(const Path& folder, const LtcTables& tables)
{
    saveTable(folder / kLtcAmplitudeFile, tables.amplitude, tables.size);
    saveTable(folder / kLtcMatrixFile, tables.matrix, tables.size);
}

} // namespace antumbra::bake
