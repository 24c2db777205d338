// check() for expectations that name a pass or a resource: the text is put together only when it is needed.
#pragma once

#include "base/check.h"

#include <fmt/format.h>

namespace antumbra::graph {

template <class... Args>
void checkNamed(bool holds, fmt::format_string<Args...> expected, Args&&... args)
{
    if (!holds) [[unlikely]]
        checkFailed(fmt::format(expected, std::forward<Args>(args)...), __FILE__, __LINE__);
}

} // namespace antumbra::graph
