#include "base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace antumbra {

namespace {

spdlog::logger& logger()
{
    static const std::shared_ptr<spdlog::logger> stderrLogger = [] {
        auto made = std::make_shared<spdlog::logger>("antumbra", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
        made->set_pattern("%^%l%$: %v");
        return made;
    }();
    return *stderrLogger;
}

spdlog::level::level_enum severity(LogLevel level)
{
    switch (level) {
    case LogLevel::Debug: return spdlog::level::debug;
    case LogLevel::Info: return spdlog::level::info;
    case LogLevel::Warning: return spdlog::level::warn;
    case LogLevel::Error: return spdlog::level::err;
    }
    return spdlog::level::err;
}

} // namespace

void setLogLevel(LogLevel least) { logger().set_level(severity(least)); }

void writeLog(LogLevel level, std::string_view line) { logger().log(severity(level), line); }

} // namespace antumbra
