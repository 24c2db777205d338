// Set 0 as engine/gpu/bindless.h makes it. Images come by slot, buffers by address, or by slot (binding 3) where all threads read alike.
#ifndef LIB_BINDLESS_GLSL
#define LIB_BINDLESS_GLSL

#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_image_load_formatted : require
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2D sampledImages[];
layout(set = 0, binding = 0) uniform utexture2D sampledWordImages[];
layout(set = 0, binding = 1) uniform image2D storageImages[];
layout(set = 0, binding = 1) uniform uimage2D storageWordImages[];
layout(set = 0, binding = 2) uniform sampler samplers[4];

const uint kLinearClamp = 0u;
const uint kLinearRepeat = 1u;
const uint kNearestClamp = 2u;
const uint kLinearWrapU = 3u;

#endif
