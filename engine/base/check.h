// Programmer's mistakes: check() stops the program, in release builds too. Bad input is not its business: see error.h.
#pragma once

#include <string_view>

namespace antumbra {

[[noreturn]] void checkFailed(std::string_view expected, const char* file, int line);

/// Stops the program with `expected` and the caller's place unless `holds`.
inline void check(bool holds, std::string_view expected, const char* file = __builtin_FILE(), int line = __builtin_LINE())
{
    if (!holds) [[unlikely]]
        checkFailed(expected, file, line);
}

} // namespace antumbra
