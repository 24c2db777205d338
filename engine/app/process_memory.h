// What this process takes of the machine's memory, in bytes.
#pragma once

#include <cstdint>

namespace antumbra::app {

uint64_t residentBytes(); // now
uint64_t peakBytes();     // at most, since the start

} // namespace antumbra::app
