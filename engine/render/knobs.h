// Every knob of the renderer in one table: --set, scene files, the overlay and the lab share its dotted keys and its ranges.
// Holds settings only, never state; a method brings its own line when it comes. Cameras and scenes are not knobs.
#pragma once

#include "bake/bake.h"
#include "scene/shadow_components.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace antumbra::render {

enum class RayBackend { Auto, RayQuery, ComputeBvh };
enum class Culling { None, Direction, Length, Bones };
enum class ViewMode { Final, Unshadowed, Occluded, Difference, Cones, Normals, Reference };

/// Edge length of a traced pixel, in pixels of the frame.
enum class Scale : uint32_t { Full = 1, Half = 2, Quarter = 4 };

struct OcclusionKnobs
{
    RayBackend backend = RayBackend::Auto;
    Culling culling = Culling::Bones;
    uint32_t samples = 128;
    Scale scale = Scale::Full;
    uint32_t filter = 5;
    float tolerance = 0.002f;
    uint32_t builds = 16;
};

struct PrtKnobs
{
    bake::BakeSettings settings; // of a bake that is made; one that is there has its own
    bool isShown = true;
    float window = 0;
};

struct AreaKnobs
{
    scene::LightShadow shadow = scene::LightShadow::Analytic; // of lights that say nothing themselves
    Scale scale = Scale::Full;
    uint32_t planes = 64;
    uint32_t pieces = 64;
    uint32_t rays = 16;
    bool isProbed = false;
};

enum class FieldShadow { None, Quilez, Aaltonen, Cone, SubCones, Traced, Reference };

struct SdfKnobs
{
    FieldShadow shadow = FieldShadow::SubCones;
    float epsilon = 0.1f;
    uint32_t cones = 7;
    uint32_t cells = 8;
};

struct ReferenceKnobs
{
    uint32_t samples = 0;
};

struct CrowdKnobs
{
    uint32_t count = 10;
};

enum class GalleryLight { Plane, Cylinder, Cone, Sphere12, Sphere42, Sphere162 }; // spheres of so many vertices
enum class GalleryOccluder { Cube, Icosphere, Ellipsoid };

struct GalleryKnobs
{
    GalleryLight light = GalleryLight::Plane;
    GalleryOccluder occluder = GalleryOccluder::Cube;
    uint32_t lights = 1;
    uint32_t occluders = 1;
};

/// Units and ranges stand in the table.
struct Knobs
{
    OcclusionKnobs occlusion;
    PrtKnobs prt;
    AreaKnobs area;
    SdfKnobs sdf;
    ReferenceKnobs reference;
    CrowdKnobs crowd;
    GalleryKnobs gallery;
    ViewMode view = ViewMode::Final;
};

/// A value that goes by a name.
struct KnobChoice
{
    std::string_view name;
    double value;
};

/// `least`, `least` + `step` ... `greatest`; a step of 0 allows every number between.
struct KnobRange
{
    double least;
    double greatest;
    double step;
};

/// Every knob is a number underneath: one of `choices` where there are any, else one in `range`. `write` does not check it.
struct KnobDescription
{
    std::string_view key;
    std::string_view doc;
    std::span<const KnobChoice> choices;
    KnobRange range;
    double (*read)(const Knobs&);
    void (*write)(Knobs&, double);
    bool isLive = true; // else a scene asks for it when it is loaded
};

/// What traces where `wanted` is asked for: ray queries only where the device has them, compute-bvh everywhere. Never Auto.
RayBackend backendFor(RayBackend wanted, bool hasRayQuery);

std::span<const KnobDescription> knobTable();

/// As in "one of none direction length bones" and "32 to 1024, in steps of 32".
std::string allowedValues(const KnobDescription& knob);

enum class DeviceClass { Cpu, Gpu };
Knobs defaultKnobs(DeviceClass device);

/// Throws Error with the nearest known key, or with the values that are allowed; `knobs` is then unchanged.
/// Numbers may be written as fractions: "1/2" is "0.5".
void set(Knobs& knobs, std::string_view key, std::string_view value);

/// The value as set() reads it. Throws Error for an unknown key.
std::string get(const Knobs& knobs, std::string_view key);

/// Keys and values in the order they were given; a later one wins.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Every knob, as get() writes it.
Settings valuesOf(const Knobs& knobs);

/// The defaults of the device, then the scene file's settings, then the command line's. Throws as set() does.
Knobs resolveKnobs(DeviceClass device, const Settings& sceneFile, const Settings& commandLine);

} // namespace antumbra::render
