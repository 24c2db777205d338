#include "tests/unit/allocation_counter.h"

#include <cstdlib>
#include <new>

namespace {

thread_local uint64_t allocations = 0;

void* allocate(std::size_t bytes)
{
    ++allocations;
    return std::malloc(bytes > 0 ? bytes : 1);
}

void* allocateAligned(std::size_t bytes, std::align_val_t alignment)
{
    ++allocations;
    const auto boundary = static_cast<std::size_t>(alignment);
    const std::size_t rounded = (bytes + boundary - 1) / boundary * boundary;
    return std::aligned_alloc(boundary, rounded > 0 ? rounded : boundary);
}

void* orThrow(void* memory) { return memory != nullptr ? memory : throw std::bad_alloc{}; }

} // namespace

// The array forms of the standard library call these. So would its nothrow forms, but AddressSanitizer has its own of them, which do not.
void* operator new(std::size_t bytes) { return orThrow(allocate(bytes)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes); }
void* operator new(std::size_t bytes, std::align_val_t alignment) { return orThrow(allocateAligned(bytes, alignment)); }
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept
{
    return allocateAligned(bytes, alignment);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace antumbra::test {

uint64_t allocationCount() { return allocations; }

} // namespace antumbra::test
