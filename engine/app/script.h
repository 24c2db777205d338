// Input as text, to be recorded and replayed exactly: JSON lines, one for each change, anchored to the number of the step.
//   {"script": 1, "seed": 7, "frames": 120}                        the first line: format, seed of the simulation, number of steps
//   {"frame": 0, "move": [0, 1], "run": true}                      move, run and rotate_environment hold until they change
//   {"frame": 30, "look": [0.02, 0], "zoom": 1, "press": ["wave"]} look, zoom and press belong to their step alone
//   {"frame": 40, "set": ["occlusion.samples=64"], "split": 320}   knobs and the column of the split view
#pragma once

#include "app/input_frame.h"
#include "base/file.h"
#include "render/knobs.h"

#include <optional>
#include <string>

namespace antumbra::app {

/// One step: what the simulation is asked, and what changes in how it is shown.
struct ScriptStep
{
    InputFrame input;
    render::Settings settings;           // applied before the step's picture
    std::optional<uint32_t> splitColumn; // pixels

    friend bool operator==(const ScriptStep&, const ScriptStep&) = default;
};

struct Script
{
    uint64_t seed = 0;
    std::vector<ScriptStep> steps;

    friend bool operator==(const Script&, const Script&) = default;
};

inline constexpr uint32_t kGreatestScriptFrames = 1000000;

/// Throws Error that names file and line for what is not such a script: bad JSON, unknown keys, actions and knobs, values out of
/// range, frames that go back or beyond the number of steps.
Script parseScript(std::string_view text, const std::string& file);
Script loadScript(const Path& file);

/// What parseScript reads back as an equal script.
std::string scriptText(const Script& script);

/// As in a script: "toggle overlay".
std::string_view nameOf(Action action);

} // namespace antumbra::app
