#include "scene/gltf_accessor.h"
#include "scene/gltf_rules.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace antumbra::scene {

namespace {

constexpr uint64_t kGreatestTotal = uint64_t{1} << 28;       // components in all accessors of a file
constexpr uint64_t kGreatestWithoutData = uint64_t{1} << 22; // elements that take no byte in the file
constexpr double kBoundTolerance = 1e-4;                     // of the greatest magnitude: exporters round the bounds they write

/// A run of elements in a buffer view.
struct Run
{
    int bufferView;
    uint64_t offset;
    uint64_t count;
    uint64_t extent; // of an element
    uint64_t componentSize;
    uint64_t stride;
};

void checkRun(const tinygltf::Model& file, const Run& run, const std::string& where)
{
    const tinygltf::BufferView& view = at(file.bufferViews, run.bufferView);
    const uint64_t end = run.offset + run.stride * (run.count - 1) + run.extent;
    require(end <= view.byteLength, "{}: reaches to byte {} of a buffer view of {}", where, end, view.byteLength);
    require((view.byteOffset + run.offset) % run.componentSize == 0 && run.stride % run.componentSize == 0,
            "{}: is not aligned to its components of {} bytes", where, run.componentSize);
}

void checkSparse(const tinygltf::Model& file, const tinygltf::Accessor& accessor, const std::string& where)
{
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<uint64_t>(sparse.count);
    require(count <= accessor.count, "{}.sparse: replaces more elements than there are", where);
    tinygltf::Accessor indices;
    indices.bufferView = sparse.indices.bufferView;
    indices.byteOffset = static_cast<size_t>(sparse.indices.byteOffset);
    indices.componentType = sparse.indices.componentType;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.count = count;
    const uint64_t indexSize = layoutOf(indices).size;
    checkRun(file, {indices.bufferView, indices.byteOffset, count, indexSize, indexSize, indexSize}, where + ".sparse.indices");
    const ElementLayout layout = layoutOf(accessor);
    checkRun(file,
             {sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset), count, layout.extent(), layout.componentSize,
              layout.size},
             where + ".sparse.values");
    if (!hasData(file, indices))
        return;
    const std::vector<uint32_t> elements = readIntegers(file, indices);
    require(elements.back() < accessor.count, "{}.sparse: index {} is out of range", where, elements.back());
    require(std::adjacent_find(elements.begin(), elements.end(), std::greater_equal<>()) == elements.end(),
            "{}.sparse: indices do not increase", where);
}

void checkPlace(const tinygltf::Model& file, const tinygltf::Accessor& accessor, const std::string& where)
{
    const ElementLayout layout = layoutOf(accessor);
    if (accessor.bufferView < 0) {
        require(accessor.count <= kGreatestWithoutData, "{}: {} elements without data are too many", where, accessor.count);
        return;
    }
    const uint64_t stride = strideOf(file, accessor);
    require(stride >= layout.size, "{}: elements of {} bytes do not fit into a byteStride of {}", where, layout.size, stride);
    checkRun(file, {accessor.bufferView, accessor.byteOffset, accessor.count, layout.extent(), layout.componentSize, stride}, where);
}

std::set<int> positionsOf(const tinygltf::Model& file)
{
    std::set<int> positions;
    for (const tinygltf::Mesh& mesh : file.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            if (const auto found = primitive.attributes.find("POSITION"); found != primitive.attributes.end())
                positions.insert(found->second);
    return positions;
}

struct Bounds
{
    std::vector<double> least;
    std::vector<double> greatest;
};

Bounds finiteBounds(const tinygltf::Model& file, const tinygltf::Accessor& accessor, const std::string& where)
{
    const std::vector<double> values = readRaw(file, accessor);
    const size_t components = layoutOf(accessor).components();
    std::vector<double> least(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components));
    std::vector<double> greatest = least;
    for (size_t i = 0; i < values.size(); ++i) {
        require(std::isfinite(values[i]), "{}: element {} is not finite", where, i / components);
        least[i % components] = std::min(least[i % components], values[i]);
        greatest[i % components] = std::max(greatest[i % components], values[i]);
    }
    return {std::move(least), std::move(greatest)};
}

bool agree(const std::vector<double>& declared, const std::vector<double>& actual, bool isFloat)
{
    return std::ranges::equal(declared, actual, [isFloat](double a, double b) {
        return std::abs(a - b) <= (isFloat ? kBoundTolerance * std::max(1.0, std::abs(b)) : 0);
    });
}

// Only positions and integers are held to the bounds that the file declares: where those disagree, the values are not the ones that
// were written. Other floats have theirs for nobody.
void checkBounds(const tinygltf::Accessor& accessor, const Bounds& actual, bool isPosition, const std::string& where, Repairs& repairs)
{
    const bool isFloat = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const auto& [least, greatest] = actual;
    for (const std::vector<double>* declared : {&accessor.minValues, &accessor.maxValues})
        require(declared->empty() || declared->size() == least.size(), "{}: bounds of {} values for {} components", where, declared->size(),
                least.size());
    const bool doAgree = (accessor.minValues.empty() || agree(accessor.minValues, least, isFloat)) &&
                         (accessor.maxValues.empty() || agree(accessor.maxValues, greatest, isFloat));
    require(doAgree || (isFloat && !isPosition), "{}: min and max are not those of its values", where);
    if (!doAgree)
        repairs.note(where, "bounds that are not those of the values are left aside");
}

} // namespace

void checkAccessors(const tinygltf::Model& file, Repairs& repairs)
{
    const std::set<int> positions = positionsOf(file);
    uint64_t total = 0;
    for (size_t i = 0; i < file.accessors.size(); ++i) {
        const tinygltf::Accessor& accessor = file.accessors[i];
        const std::string where = fmt::format("accessors[{}]", i);
        const bool isWide =
            accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        require(!accessor.normalized || !isWide, "{}: only integers of 8 and 16 bits can be normalized", where);
        checkPlace(file, accessor, where);
        total += accessor.count * layoutOf(accessor).components();
        require(total <= kGreatestTotal, "{}: the file's accessors have more than {} values", where, kGreatestTotal);
        if (accessor.sparse.isSparse)
            checkSparse(file, accessor, where);
        if (!hasData(file, accessor))
            continue;
        checkBounds(accessor, finiteBounds(file, accessor, where), positions.contains(static_cast<int>(i)), where, repairs);
    }
}

} // namespace antumbra::scene
