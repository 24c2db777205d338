// Which pixels of the G-buffer are lit where one stands for a square of them.
#ifndef LIB_LIT_EXTENT_GLSL
#define LIB_LIT_EXTENT_GLSL

ivec2 litExtent(ivec2 extent, int pixelScale) { return (extent + pixelScale - 1) / pixelScale; }

// The one that stands for its square: in its middle.
ivec2 litAt(ivec2 litPixel, int pixelScale, ivec2 extent) { return min(litPixel * pixelScale + pixelScale / 2, extent - 1); }

#endif
