// The structs that C++ and GLSL share, in namespace shader; shaders/shared is their only definition.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace antumbra::shader {

using uint = uint32_t;

#include "shaders/shared/frame.h"

#include "shaders/shared/scene.h"

#include "shaders/shared/skinning.h"

#include "shaders/shared/occlusion.h"

#include "shaders/shared/bvh.h"

#include "shaders/shared/composite.h"

#include "shaders/shared/overlay.h"

#include "shaders/shared/prt.h"

#include "shaders/shared/area.h"

#include "shaders/shared/light_share.h"

#include "shaders/shared/probe.h"

#include "shaders/shared/field.h"

#include "shaders/shared/eval.h"

} // namespace antumbra::shader
