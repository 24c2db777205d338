// A traced pixel and the surface it belongs to in one texel of four words: CPU devices pay for every fetch. Needs lib/surface.glsl.
#ifndef LIB_TRACED_GLSL
#define LIB_TRACED_GLSL

struct TracedPixel
{
    vec3 occluded; // W/m^2
    float cones;
    float depthView; // metres; 0: no surface
    vec2 normal; // shading, octahedral
};

uvec4 packTraced(TracedPixel t)
{
    return uvec4(packHalf2x16(t.occluded.rg), packHalf2x16(vec2(t.occluded.b, t.cones)), floatBitsToUint(t.depthView), packSnorm2x16(t.normal));
}

TracedPixel unpackTraced(uvec4 words)
{
    vec2 blueCones = unpackHalf2x16(words.y);
    return TracedPixel(vec3(unpackHalf2x16(words.x), blueCones.x), blueCones.y, uintBitsToFloat(words.z), unpackSnorm2x16(words.w));
}

// 1 for a traced neighbour of the plane's own surface, towards 0 for another's; `offset` in pixels of the G-buffer.
float likeness(PixelPlane plane, vec2 offset, TracedPixel there)
{
    return there.depthView > 0.0 ? samePlane(plane, offset, there.depthView) * sameFacing(plane, unitFromOctahedral(there.normal)) : 0.0;
}

#endif
