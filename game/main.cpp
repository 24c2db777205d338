// antumbra: one command a run. The only place that turns errors into a line and an exit code.
#include "app/commands.h"
#include "base/log.h"
#include "game/gameplay.h"

#include <fmt/format.h>

namespace {

using namespace antumbra;

/// A command for each alternative of app::Options.
struct Run
{
    ExitCode operator()(const app::Help& help) const
    {
        fmt::print("{}", help.text);
        return ExitCode::Done;
    }
    ExitCode operator()(const app::PlayOptions& options) const { return app::runPlay(options, game::addGameplay); }
    ExitCode operator()(const app::RenderOptions& options) const { return app::runRender(options); }
    ExitCode operator()(const app::EvalOptions& options) const { return app::runEval(options); }
    ExitCode operator()(const app::InfoOptions&) const { return app::runInfo(); }
    ExitCode operator()(const app::InspectOptions& options) const { return app::runInspect(options); }
    ExitCode operator()(const app::GraphOptions& options) const { return app::runGraph(options); }
};

} // namespace

int main(int argc, char** argv)
{
    try {
        return static_cast<int>(std::visit(Run{}, app::parse(argc, argv)));
    } catch (const Error& error) {
        logError("{}", error.what());
        return static_cast<int>(error.code);
    }
}
