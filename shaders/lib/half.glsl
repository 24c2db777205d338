// Numbers on their way into half floats, which know no more than 65504: light beyond is as bright as that, and never Inf.
#ifndef LIB_HALF_GLSL
#define LIB_HALF_GLSL

const float kLargestHalf = 65504.0;

vec3 withinHalf(vec3 value) { return clamp(value, vec3(-kLargestHalf), vec3(kLargestHalf)); }

#endif
