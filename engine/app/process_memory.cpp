#include "app/process_memory.h"

#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

namespace antumbra::app {

uint64_t residentBytes()
{
    std::ifstream pages("/proc/self/statm");
    uint64_t all = 0, resident = 0;
    pages >> all >> resident;
    return resident * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

uint64_t peakBytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

} // namespace antumbra::app
