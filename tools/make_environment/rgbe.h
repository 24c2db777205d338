// Radiance pictures (.hdr) as bytes: shared-exponent texels, run-length coded, the same bytes for the same picture.
#pragma once

#include "scene/images.h"

#include <cstddef>
#include <vector>

namespace antumbra::environment {

/// Three channels, none negative; 8 to 32767 texels wide, as the format's run-length coding asks.
std::vector<std::byte> toRgbe(const scene::ImageF& image);

} // namespace antumbra::environment
