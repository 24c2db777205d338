// What methods that tell how much of an area light is seen, apart from how much it sends, pass on. Pixels are those that are lit: one a
// square of AreaShade::pixelScale.
#ifndef SHARED_LIGHT_SHARE_H
#define SHARED_LIGHT_SHARE_H

const float kNoPenumbra = 1.0e30; // metres

// Light of points on a body, up to a factor that all share; x: reflected diffusely, y: by GGX.
struct RatioSample
{
    vec2 seen; // of the points that are
    vec2 whole; // of all
    float halfPenumbra; // metres across the way to the light, of what hides a point nearest; kNoPenumbra: nothing does
};

struct RatioTrace
{
    uint64_t area; // AreaBlock
    uint64_t scene; // what rays are traced through
    uint64_t samples; // RatioSample[endLight - firstLight][pixels], written
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint albedo;
    uint material;
    uint firstLight;
    uint endLight;
    uint rays; // a light
    int pixelScale;
};

struct RatioDenoise
{
    uint64_t samples; // RatioSample[lightCount][pixels]
    uint64_t denoised; // the same, written; at last vec2[lightCount][pixels]: shares seen
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint lightCount;
    int spacing; // pixels between those that are asked
    int pixelScale;
};

const float kLit = 0.0;
const float kFacesAway = -1.0;

// A pixel of the shadow buffer.
struct ShadowRay
{
    float halfPenumbra; // metres across the way to the light, more than 0 where hidden; kLit; kFacesAway
    float blocker; // metres to what hides it
};

struct PenumbraTrace
{
    uint64_t area; // AreaBlock
    uint64_t scene; // what rays are traced through
    uint64_t rays; // ShadowRay[endLight - firstLight][pixels], written
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint firstLight;
    uint endLight;
    int pixelScale;
};

struct PenumbraSearch
{
    uint64_t area; // AreaBlock
    uint64_t rays; // as PenumbraTrace writes them
    uint64_t shares; // vec2[endLight - firstLight][pixels], written
    uint frame; // slot of a FrameBlock
    uint depth;
    uint firstLight;
    uint endLight;
    int pixelScale;
};

#endif
