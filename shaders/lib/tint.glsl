// Colours as the sum of their channels, and the shares of red and green in it.
#ifndef LIB_TINT_GLSL
#define LIB_TINT_GLSL

float sumOf(vec3 colour) { return colour.r + colour.g + colour.b; }

vec2 tintOf(vec3 colour) { return colour.rg / max(sumOf(colour), 1.0e-30); }

vec3 coloured(float sum, vec2 tint) { return sum * vec3(tint, 1.0 - tint.x - tint.y); }

#endif
