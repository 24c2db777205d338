// The command line of every command, read and checked into plain data. Opens no file: what a file holds is its reader's business.
#pragma once

#include "base/file.h"
#include "base/math.h"
#include "render/knobs.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace antumbra::app {

/// Text for standard output; the command is then done.
struct Help
{
    std::string text;
};

struct PlayOptions
{
    std::string scene = "plaza";
    std::optional<uvec2> size;
    bool headless = false;
    std::optional<uint32_t> frames;
    std::optional<Path> script;
    std::optional<Path> record;
    std::optional<Path> screenshot;
    std::optional<double> targetMilliseconds;
    render::Settings settings;
};

/// An intermediate picture by its name, such as "normal" or "visibility:LIGHT".
struct AovOutput
{
    std::string name;
    Path file;
};

struct RenderOptions
{
    std::string scene;
    Path output;
    uvec2 size{640, 360};
    double seconds = 0;
    uint32_t frames = 1;
    std::vector<AovOutput> aovs;
    render::Settings settings;
    std::optional<Path> stats;
};

enum class EvalKind { Cones, Irradiance, Area, Sdf };

struct EvalOptions
{
    EvalKind kind = EvalKind::Cones;
    Path cases;
    Path output;
    render::Settings settings; // sdf.shadow, sdf.cones, sdf.epsilon of the kind sdf
};

struct InfoOptions
{
};

struct InspectOptions
{
    Path file;
};

struct GraphOptions
{
    std::string scene;
    Path output;
    render::Settings settings;
};

using Options = std::variant<Help, PlayOptions, RenderOptions, EvalOptions, InfoOptions, InspectOptions, GraphOptions>;

/// Sizes are 16x16 to 8192x8192, frames 1 to 1e6, times finite and not negative; each setting is known and in its range.
/// Throws Error of one line that names the command and the option.
Options parse(int argc, const char* const* argv);

} // namespace antumbra::app
