// Area lights and what stands before them, as convex bodies.
#ifndef SHARED_AREA_H
#define SHARED_AREA_H

const uint kNoFace = 0xffffu;

const uint kBodyPlanar = 1u; // one polygon, no inside
const uint kBodyTwoSided = 2u; // a planar light shines to both sides; what blocks does so from both
const uint kBodyFrontOnly = 4u; // a triangle of a closed mesh: the side that is seen blocks
const uint kBodyHollow = 8u; // stands for a surface that lies in it, or up to `margin` outside: hides nothing from there
const uint kBodySphere = 16u; // stands for the sphere around it
const uint kBodySkin = 32u; // what it stands for moves: hollow to nothing else

// A convex polyhedron or polygon. What is counted from its first is indexed relative to it.
struct BodyBlock
{
    vec3 centre; // of a sphere around it
    float radius;
    uint firstVertex;
    uint vertexCount;
    uint firstFace;
    uint faceCount;
    uint firstEdge;
    uint edgeCount;
    uint flags;
    float margin; // metres
};

struct FaceBlock
{
    vec3 normal; // outward, unit; zero where the face has no area
    uint firstCorner; // of its loop, counter-clockwise seen from outside
    uint cornerCount;
};

// From a to b as in the loop of the face `left`; `right` is kNoFace where there is none.
struct EdgeBlock
{
    uint vertices; // a, b << 16
    uint faces; // left, right << 16
};

// Where bodies lie.
struct BodyArrays
{
    uint64_t bodies; // BodyBlock[]
    uint64_t vertices; // vec3[], world
    uint64_t faces; // FaceBlock[]
    uint64_t corners; // uint[], into the body's vertices
    uint64_t edges; // EdgeBlock[]
};

const uint kAreaUnshadowed = 0u;
const uint kAreaAnalytic = 1u;
const uint kAreaTraced = 2u;

struct AreaLightBlock
{
    vec3 radiance; // W/(m^2 sr)
    uint body;
    uint light; // that it is a part of, as `owners` count them
};

// Pixels of a group: narrow, so that the lanes of a CPU device, eight, are close together.
const uint kAreaGroupWidth = 4u;
const uint kAreaGroupHeight = 8u;

// Tiles are squares of pixels.
const uint kAreaTileSize = 16u;
const uint kAreaTileOccluders = 31u;

// The occluders that can matter for a light in a tile.
struct AreaTileBlock
{
    uint count; // more than kAreaTileOccluders: any may matter
    uint occluders[kAreaTileOccluders]; // into the bodies
};

// The area lights of a frame and all that stands before them.
struct AreaBlock
{
    BodyArrays arrays;
    uint64_t fields; // FieldsBlock: what shadow rays meet too; null: nothing
    uint64_t lights; // AreaLightBlock[lightCount]
    uint64_t owners; // uint[occluderCount]: the light that the occluder is the body of, or any other number
    uint firstOccluder; // into the bodies
    uint occluderCount;
    uint lightCount;
    uint tilesAcross;
};

const uint kNothingBefore = 0xffffffffu;

struct AreaTiles
{
    uint64_t area; // AreaBlock
    uint64_t tiles; // AreaTileBlock[lightCount], tile by tile, written
    uint frame; // slot of a FrameBlock
    uint depth;
    uint tileCount;
    uint padding;
};

struct AreaShade
{
    uint64_t area; // AreaBlock
    uint64_t tiles; // AreaTileBlock[lightCount], tile by tile
    uint64_t counters; // CounterBlock
    uint64_t scene; // what rays are traced through
    uint64_t shares; // vec2[endLight - firstLight][pixels]: shares of lights that are seen; null: as the shader finds itself
    uint64_t seenPastFields; // float[lightCount][pixels]: shares of lights that distance fields leave; null: all
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint albedo;
    uint material;
    uint ltcMatrix;
    uint ltcAmplitude;
    uint diffuse; // written: W/m^2, cosine-weighted
    uint specular; // written: W/(m^2 sr)
    uint diffuseBefore; // what these are added to, or the reference's means so far; kNothingBefore: nothing
    uint specularBefore;
    uint firstLight;
    uint endLight;
    uint mostPieces;
    int mostPlanes; // of an occluder
    uint rays; // a light; the reference: 0 keeps the means
    uint frameIndex; // of the reference's accumulation
    int pixelScale; // of the images that are written to the G-buffer: 1, 2, 4
};

struct AreaUpsample
{
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint diffuseLit; // as AreaShade writes them
    uint specularLit;
    uint diffuse; // written
    uint specular;
    int pixelScale;
};

#endif
