// One line a message, to stderr; standard output belongs to the commands' results.
#pragma once

#include <fmt/core.h>
#include <string_view>

namespace antumbra {

enum class LogLevel { Debug, Info, Warning, Error };

void setLogLevel(LogLevel least);
void writeLog(LogLevel level, std::string_view line);

template <class... Args>
void logDebug(fmt::format_string<Args...> format, Args&&... args)
{
    writeLog(LogLevel::Debug, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void logInfo(fmt::format_string<Args...> format, Args&&... args)
{
    writeLog(LogLevel::Info, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void logWarning(fmt::format_string<Args...> format, Args&&... args)
{
    writeLog(LogLevel::Warning, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void logError(fmt::format_string<Args...> format, Args&&... args)
{
    writeLog(LogLevel::Error, fmt::format(format, std::forward<Args>(args)...));
}

} // namespace antumbra
