// Whether the bytes of a PNG file are whole. Says nothing about the picture in them.
#pragma once

#include <cstddef>
#include <span>

namespace antumbra::scene {

/// True when every chunk from the signature to IEND is there and has the checksum it carries. libpng finds the same faults,
/// but reports them on standard error, which belongs to the program's own messages.
[[nodiscard]] bool isWholePng(std::span<const std::byte> file);

} // namespace antumbra::scene
