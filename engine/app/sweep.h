// A sweep of the lab as its JSON file describes it, checked value by value: which scenes with which knobs are measured how often.
// Measures nothing and loads no scene.
#pragma once

#include "base/file.h"
#include "base/math.h"
#include "render/knobs.h"

#include <optional>
#include <string>
#include <vector>

namespace antumbra::app {

/// What a point is measured by.
enum class Measure { Frames, Bakes };

/// What baked light is held against: the light as its bands tell it, or the whole map.
enum class BakeTruth { Bands, Map };

/// One row of the results.
struct SweepPoint
{
    std::string name;  // unique in the sweep
    std::string scene; // as the commands take it
    uvec2 size{640, 360};
    float seconds = 0;             // of the clips
    uint32_t frames = 4;           // measured a round
    bool animates = true;          // every frame has a new pose, about `seconds`
    bool turnsLight = false;       // every frame has another light
    bool hasCharacters = true;     // else only what stands still is drawn
    uint32_t referenceSamples = 0; // that the error is measured against, of a bake: paths a point of the surface; 0: it is not
    BakeTruth truth = BakeTruth::Bands;
    render::Settings settings; // over the device's defaults and the scene's own
};

/// What the medians of a time are held against, over all points: a sum of medians of counters.
struct SweepFit
{
    std::string time;
    std::vector<std::string> counters;
};

struct Sweep
{
    std::string name;
    Measure measure = Measure::Frames;
    uint32_t repeats = 5; // rounds, each over all points
    uint32_t warmUp = 3;  // frames a point that do not count
    std::optional<SweepFit> fit;
    std::vector<SweepPoint> points;
};

/// {"name", "measure":"frames"|"bakes", "repeats", "warmup", "fit":{"time", "counters":[...]}, "grid", "points":[{"name", "scene",
/// "size":[w,h], "time", "frames", "animate", "turn", "characters", "reference", "settings":{KNOB:VALUE}, "grid":{KNOB:[VALUE...]}}]}: a
/// point stands for every combination of its grid, or of the sweep's where it has none of its own. A point that is a bake has
/// "truth":"bands"|"map" in place of all that frames have, and knobs of baking alone. Throws Error of one line for unknown keys, with the
/// nearest known, wrong types and values out of range.
Sweep loadSweep(const Path& file);

/// Throws Error where the results, NAME.json in `folder`, would take the place of the file the sweep was read from.
void checkKept(const Path& file, const Sweep& sweep, const Path& folder);

} // namespace antumbra::app
