#include "tests/unit/allocation_counter.h"

#include <cstdlib>
#include <new>

namespace {

thread_local uint64_t allocations = 0;

void* allocate(std::size_t bytes)
{
    ++allocations;
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1))
        return memory;
    throw std::bad_alloc{};
}

void* allocateAligned(std::size_t bytes, std::align_val_t alignment)
{
    ++allocations;
    const auto boundary = static_cast<std::size_t>(alignment);
    const std::size_t rounded = (bytes + boundary - 1) / boundary * boundary;
    if (void* memory = std::aligned_alloc(boundary, rounded > 0 ? rounded : boundary))
        return memory;
    throw std::bad_alloc{};
}

} // namespace

// The array and nothrow forms of the standard library call these.
void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new(std::size_t bytes, std::align_val_t alignment) { return allocateAligned(bytes, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace antumbra::test {

uint64_t allocationCount() { return allocations; }

} // namespace antumbra::test
