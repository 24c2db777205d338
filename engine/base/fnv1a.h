// A 64-bit FNV-1a hash of bytes: tells states and files apart; no defence against who forges them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace antumbra {

class Fnv1a
{
public:
    /// A value without padding.
    template <class T>
    void add(const T& value)
    {
        add(std::span(&value, 1));
    }
    template <class T>
    void add(std::span<const T> values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        for (const std::byte byte : std::as_bytes(values))
            hash_ = (hash_ ^ static_cast<uint64_t>(byte)) * 0x100000001b3u;
    }
    [[nodiscard]] uint64_t value() const { return hash_; }

private:
    uint64_t hash_ = 0xcbf29ce484222325u;
};

} // namespace antumbra
