// Counts what the calling thread takes from the heap through operator new, for tests of code that must take nothing.
#pragma once

#include <cstdint>

namespace antumbra::test {

/// Calls of operator new by this thread so far.
uint64_t allocationCount();

} // namespace antumbra::test
