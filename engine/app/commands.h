// The commands of the program (DESIGN.md, Commands): each does all of its work and returns the exit code. Errors are thrown.
#pragma once

#include "app/options.h"
#include "app/stage.h"
#include "base/error.h"

namespace antumbra::app {

/// In a window; without a display it says so and plays headless: a scripted walk unless there is a script, with pictures and statistics
/// written to the project's folder out, and a short table of passes on standard output.
ExitCode runPlay(const PlayOptions& options, Gameplay gameplay);
/// One moment of a scene to files. Ctrl-C ends what is accumulated, and what there is is written.
ExitCode runRender(const RenderOptions& options);
/// The cases of a file through the shader functions; CheckFailed where one is out of tolerance.
ExitCode runEval(const EvalOptions& options);
/// The device, what it can do, and what is chosen for each effect, on standard output.
ExitCode runInfo();
ExitCode runInspect(const InspectOptions& options);
/// The plan of the scene's first frame, to a file.
ExitCode runGraph(const GraphOptions& options);

} // namespace antumbra::app
