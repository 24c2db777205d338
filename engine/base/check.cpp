#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace antumbra {

void checkFailed(std::string_view expected, const char* file, int line)
{
    std::fprintf(stderr, "%s:%d: check failed: expected %.*s\n", file, line, static_cast<int>(expected.size()), expected.data());
    std::abort();
}

} // namespace antumbra
