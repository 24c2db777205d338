// The frame's constants, as every pass that names their slot `pc.frame` reads them.
#ifndef LIB_FRAME_GLSL
#define LIB_FRAME_GLSL

#include "shared/frame.h"

layout(set = 0, binding = 3, scalar) readonly buffer FrameBuffer { FrameBlock block; } frameBuffers[];
#define frameBlock frameBuffers[pc.frame].block

#endif
