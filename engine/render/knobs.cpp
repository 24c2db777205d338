#include "render/knobs.h"

#include "bake/settings.h"
#include "base/error.h"
#include "base/nearest.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <optional>

namespace antumbra::render {

namespace {

template <class Enum>
constexpr KnobChoice choice(std::string_view name, Enum value)
{
    return {name, static_cast<double>(value)};
}

constexpr KnobChoice kBackends[] = {
    choice("auto", RayBackend::Auto),
    choice("ray-query", RayBackend::RayQuery),
    choice("compute-bvh", RayBackend::ComputeBvh),
};
constexpr KnobChoice kCullings[] = {
    choice("none", Culling::None),
    choice("direction", Culling::Direction),
    choice("length", Culling::Length),
    choice("bones", Culling::Bones),
};
constexpr KnobChoice kScales[] = {choice("1", Scale::Full), choice("1/2", Scale::Half), choice("1/4", Scale::Quarter)};
constexpr KnobChoice kSwitch[] = {{"on", 1}, {"off", 0}};
constexpr KnobChoice kExtra[] = {{"off", 0}, {"on", 1}};
constexpr KnobChoice kLightShadows[] = {
    choice("none", scene::LightShadow::None),           choice("analytic", scene::LightShadow::Analytic),
    choice("triangles", scene::LightShadow::Triangles), choice("traced", scene::LightShadow::Traced),
    choice("ratio", scene::LightShadow::Ratio),         choice("article", scene::LightShadow::Article),
    choice("two-sided", scene::LightShadow::TwoSided),  choice("reference", scene::LightShadow::Reference),
};
constexpr KnobChoice kFieldShadows[] = {
    choice("none", FieldShadow::None),           choice("quilez", FieldShadow::Quilez),      choice("aaltonen", FieldShadow::Aaltonen),
    choice("cone", FieldShadow::Cone),           choice("sub-cones", FieldShadow::SubCones), choice("traced", FieldShadow::Traced),
    choice("reference", FieldShadow::Reference),
};
constexpr KnobChoice kFieldCones[] = {{"1", 1}, {"4", 4}, {"7", 7}, {"16", 16}};
constexpr KnobChoice kGalleryLights[] = {choice("plane", GalleryLight::Plane),        choice("cylinder", GalleryLight::Cylinder),
                                         choice("cone", GalleryLight::Cone),          choice("sphere-12", GalleryLight::Sphere12),
                                         choice("sphere-42", GalleryLight::Sphere42), choice("sphere-162", GalleryLight::Sphere162)};
constexpr KnobChoice kGalleryOccluders[] = {choice("cube", GalleryOccluder::Cube), choice("icosphere", GalleryOccluder::Icosphere),
                                            choice("ellipsoid", GalleryOccluder::Ellipsoid)};
constexpr KnobChoice kFilters[] = {{"0", 0}, {"3", 3}, {"5", 5}, {"7", 7}, {"9", 9}};
constexpr KnobChoice kViews[] = {
    choice("final", ViewMode::Final),           choice("unshadowed", ViewMode::Unshadowed), choice("occluded", ViewMode::Occluded),
    choice("difference", ViewMode::Difference), choice("cones", ViewMode::Cones),           choice("normals", ViewMode::Normals),
    choice("reference", ViewMode::Reference),
};

template <class Field>
void assign(Field& field, double value)
{
    field = static_cast<Field>(value);
}

// Reaches knobs.A.B through the pointers to members A and B.
template <auto... Members>
constexpr auto& field(auto& knobs)
{
    return (knobs.*....*Members);
}

template <auto... Members>
constexpr KnobDescription knob(std::string_view key, std::span<const KnobChoice> choices, KnobRange range, std::string_view doc)
{
    return {
        .key = key,
        .doc = doc,
        .choices = choices,
        .range = range,
        .read = [](const Knobs& knobs) { return static_cast<double>(field<Members...>(knobs)); },
        .write = [](Knobs& knobs, double value) { assign(field<Members...>(knobs), value); },
    };
}

template <auto... Members>
constexpr KnobDescription knob(std::string_view key, std::span<const KnobChoice> choices, std::string_view doc)
{
    return knob<Members...>(key, choices, {}, doc);
}

template <auto... Members>
constexpr KnobDescription knob(std::string_view key, KnobRange range, std::string_view doc)
{
    return knob<Members...>(key, {}, range, doc);
}

// What a scene asks for when it is loaded.
constexpr KnobDescription atLoading(KnobDescription knob)
{
    knob.isLive = false;
    return knob;
}

// A setting of the baker.
template <size_t Index>
constexpr KnobDescription bakeKnob()
{
    constexpr const bake::BakeSetting& setting = bake::kBakeSettings[Index];
    return {
        .key = setting.key,
        .doc = setting.doc,
        .choices = {},
        .range = {setting.least, setting.greatest, setting.isWhole ? 1.0 : 0.0},
        .read = [](const Knobs& knobs) { return setting.read(knobs.prt.settings); },
        .write = [](Knobs& knobs, double value) { setting.write(knobs.prt.settings, value); },
        .isLive = false,
    };
}

using Occlusion = OcclusionKnobs;
using Area = AreaKnobs;
using Gallery = GalleryKnobs;
using Reference = ReferenceKnobs;
constexpr auto kOcclusion = &Knobs::occlusion;
constexpr auto kPrt = &Knobs::prt;
constexpr auto kArea = &Knobs::area;
constexpr auto kSdf = &Knobs::sdf;
constexpr auto kGallery = &Knobs::gallery;

constexpr KnobDescription kTable[] = {
    knob<kOcclusion, &Occlusion::backend>("occlusion.backend", kBackends,
                                          "what traces the rays; auto takes ray-query where the device has it"),
    knob<kOcclusion, &Occlusion::culling>("occlusion.culling", kCullings, "which rays are spared because no dynamic object can stop them"),
    knob<kOcclusion, &Occlusion::samples>("occlusion.samples", {32, 1024, 32}, "directions a traced pixel"),
    knob<kOcclusion, &Occlusion::scale>("occlusion.scale", kScales, "traced resolution along each axis, as a share of the frame's"),
    knob<kOcclusion, &Occlusion::filter>("occlusion.filter", kFilters, "width of the cross-bilateral kernel in traced pixels; 0 is off"),
    knob<kOcclusion, &Occlusion::tolerance>("occlusion.tolerance", {0, 0.1, 0}, "share of the unshadowed irradiance culling may lose"),
    knob<kOcclusion, &Occlusion::builds>("occlusion.builds", {1, 1000, 1}, "greatest number of BLAS builds a frame"),
    bakeKnob<0>(),
    bakeKnob<1>(),
    bakeKnob<2>(),
    bakeKnob<3>(),
    bakeKnob<4>(),
    bakeKnob<5>(),
    bakeKnob<6>(),
    knob<kPrt, &PrtKnobs::isShown>("prt.bake", kSwitch,
                                   "baked light where there is some; off: the environment's, as if nothing stood there"),
    knob<kPrt, &PrtKnobs::window>("prt.window", {0, 1, 0}, "against ringing of baked light: how much higher bands are damped; 0 is off"),
    knob<kArea, &Area::shadow>("area.shadow", kLightShadows, "how area lights are shadowed, but for those that say so themselves"),
    knob<kArea, &Area::scale>("area.scale", kScales, "resolution of area light along each axis, as a share of the frame's"),
    knob<kArea, &Area::planes>("area.planes", {4, 64, 1}, "silhouette planes an occluder; with fewer than it has its shadow grows"),
    knob<kArea, &Area::pieces>("area.pieces", {1, 4096, 1}, "polygons of light a pixel and light; the rest of its shadow is sampled"),
    knob<kArea, &Area::rays>("area.rays", {1, 4096, 1}, "shadow rays a pixel and light, where it is traced"),
    knob<kArea, &Area::isProbed>("area.probe", kExtra, "draws the lights, silhouettes and visible pieces of the pixel under the mouse"),
    knob<kSdf, &SdfKnobs::shadow>("sdf.shadow", kFieldShadows, "how distance fields shadow area lights"),
    knob<kSdf, &SdfKnobs::epsilon>("sdf.epsilon", {0.01, 1, 0}, "share of a cone's width that a step of sdf.shadow=cone may go past"),
    knob<kSdf, &SdfKnobs::cones>("sdf.cones", kFieldCones, "cones a sphere light of sdf.shadow=sub-cones"),
    knob<kSdf, &SdfKnobs::cells>("sdf.cells", {1, 64, 1}, "parts of a light of another shape, each with a cone of its own"),
    knob<&Knobs::reference, &Reference::samples>("reference.samples", {0, 1e6, 1}, "directions a pixel of the reference; 0 is off"),
    knob<&Knobs::crowd, &CrowdKnobs::count>("crowd.count", {1, 200, 1}, "characters in the crowd scene"),
    atLoading(
        knob<kGallery, &Gallery::light>("gallery.light", kGalleryLights, "what shines in the gallery; spheres are of so many vertices")),
    atLoading(knob<kGallery, &Gallery::occluder>("gallery.occluder", kGalleryOccluders, "what stands in the light of the gallery")),
    atLoading(knob<kGallery, &Gallery::lights>("gallery.lights", {1, 6, 1}, "lights in the gallery")),
    atLoading(knob<kGallery, &Gallery::occluders>("gallery.occluders", {0, 8, 1}, "occluders in the gallery")),
    knob<&Knobs::view>("view", kViews, "what the screen shows"),
};

const KnobDescription& describe(std::string_view key)
{
    if (const auto* found = std::ranges::find(kTable, key, &KnobDescription::key); found != std::end(kTable))
        return *found;
    std::vector<std::string_view> keys;
    std::ranges::transform(kTable, std::back_inserter(keys), &KnobDescription::key);
    throw Error(fmt::format("no such knob; the nearest is {}", nearestWord(key, keys)), std::string(key));
}

std::optional<double> parseDecimal(std::string_view text)
{
    double number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

std::optional<double> parseNumber(std::string_view text)
{
    const size_t slash = text.find('/');
    if (slash == std::string_view::npos)
        return parseDecimal(text);
    const auto dividend = parseDecimal(text.substr(0, slash));
    const auto divisor = parseDecimal(text.substr(slash + 1));
    if (!dividend || !divisor || *divisor == 0)
        return std::nullopt;
    return *dividend / *divisor;
}

bool names(const KnobChoice& choice, std::string_view text)
{
    const auto number = parseNumber(text);
    return choice.name == text || (number && number == parseNumber(choice.name));
}

std::optional<double> parseValue(const KnobDescription& knob, std::string_view text)
{
    if (!knob.choices.empty()) {
        const auto found = std::ranges::find_if(knob.choices, [text](const KnobChoice& choice) { return names(choice, text); });
        return found != knob.choices.end() ? std::optional(found->value) : std::nullopt;
    }
    const auto number = parseNumber(text);
    const auto& [least, greatest, step] = knob.range;
    if (!number || *number < least || *number > greatest)
        return std::nullopt;
    if (step > 0 && std::fmod(*number - least, step) != 0)
        return std::nullopt;
    return number;
}

} // namespace

RayBackend backendFor(RayBackend wanted, bool hasRayQuery)
{
    return wanted == RayBackend::ComputeBvh || !hasRayQuery ? RayBackend::ComputeBvh : RayBackend::RayQuery;
}

std::span<const KnobDescription> knobTable() { return kTable; }

std::string allowedValues(const KnobDescription& knob)
{
    if (!knob.choices.empty()) {
        std::string allowed = "one of";
        for (const KnobChoice& choice : knob.choices)
            allowed += fmt::format(" {}", choice.name);
        return allowed;
    }
    const auto& [least, greatest, step] = knob.range;
    const std::string steps = step == 0 ? "" : step == 1 ? ", a whole number" : fmt::format(", in steps of {:.6g}", step);
    return fmt::format("{:.7g} to {:.7g}{}", least, greatest, steps);
}

Knobs defaultKnobs(DeviceClass device)
{
    Knobs knobs;
    if (device == DeviceClass::Cpu) {
        knobs.occlusion.samples = 32;
        knobs.occlusion.scale = Scale::Quarter;
        knobs.area.scale = Scale::Quarter;
        knobs.area.pieces = 24;
        knobs.sdf.cones = 4;
        knobs.sdf.cells = 4;
    }
    return knobs;
}

void set(Knobs& knobs, std::string_view key, std::string_view value)
{
    const KnobDescription& knob = describe(key);
    const auto number = parseValue(knob, value);
    if (!number)
        throw Error(fmt::format("takes {}, not \"{}\"", allowedValues(knob), value), std::string(key));
    knob.write(knobs, *number);
}

std::string get(const Knobs& knobs, std::string_view key)
{
    const KnobDescription& knob = describe(key);
    const double number = knob.read(knobs);
    const auto named = std::ranges::find(knob.choices, number, &KnobChoice::value);
    // Fields are float or whole numbers that a float holds exactly; a float's shortest form reads back to the same value.
    return named != knob.choices.end() ? std::string(named->name) : fmt::format("{}", static_cast<float>(number));
}

Settings valuesOf(const Knobs& knobs)
{
    Settings values;
    for (const KnobDescription& knob : kTable)
        values.emplace_back(knob.key, get(knobs, knob.key));
    return values;
}

Knobs resolveKnobs(DeviceClass device, const Settings& sceneFile, const Settings& commandLine)
{
    Knobs knobs = defaultKnobs(device);
    for (const Settings* settings : {&sceneFile, &commandLine})
        for (const auto& [key, value] : *settings)
            set(knobs, key, value);
    return knobs;
}

} // namespace antumbra::render
