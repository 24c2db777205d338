// Dear ImGui's draw lists as the device reads them.
#ifndef SHARED_OVERLAY_H
#define SHARED_OVERLAY_H

// ImDrawVert, member for member.
struct OverlayVertex
{
    vec2 position; // pixels
    vec2 uv;
    uint color; // 8 bits a channel, red lowest; sRGB-encoded
};

struct OverlayDraw
{
    uint64_t vertices; // OverlayVertex[]
    uint64_t indices; // uint[]: two of 16 bits each
    vec2 extent; // pixels
    uint firstIndex;
    uint firstVertex;
    uint font;
};

#endif
