// How a kernel echoes a struct of shaders/shared, member by member.
#ifndef SHARED_STRUCTS_GLSL
#define SHARED_STRUCTS_GLSL

layout(buffer_reference, scalar) writeonly buffer Words { uint word[]; };
layout(push_constant, scalar) uniform Push
{
    uint64_t inputs;
    uint64_t outputs;
    uint count;
} pc;

layout(local_size_x = 1) in;

uint next = 0u;

void put(uint value) { Words(pc.outputs).word[next++] = value; }
void put(int value) { put(uint(value)); }
void put(float value) { put(floatBitsToUint(value)); }
void put(uint64_t value)
{
    uvec2 words = unpackUint2x32(value);
    put(words.x);
    put(words.y);
}
void put(vec2 value)
{
    for (int i = 0; i < 2; ++i)
        put(value[i]);
}
void put(vec3 value)
{
    for (int i = 0; i < 3; ++i)
        put(value[i]);
}
void put(ivec2 value)
{
    for (int i = 0; i < 2; ++i)
        put(uint(value[i]));
}
void put(uvec2 value)
{
    for (int i = 0; i < 2; ++i)
        put(value[i]);
}
void put(ivec3 value)
{
    for (int i = 0; i < 3; ++i)
        put(uint(value[i]));
}
void put(vec4 value)
{
    for (int i = 0; i < 4; ++i)
        put(value[i]);
}
void put(mat4 value)
{
    for (int i = 0; i < 4; ++i)
        put(value[i]);
}
void put(FieldsBlock value)
{
    put(value.steps);
    put(value.groups);
    put(value.surfaces);
    put(value.skipped);
    put(value.groupCount);
    put(value.takesAway);
}

void put(MaterialBlock value)
{
    put(value.albedo);
    put(value.alphaCutoff);
    put(value.alpha);
    put(value.roughness);
    put(value.metallic);
    put(value.specular);
    put(value.albedoImage);
    put(value.metallicRoughnessImage);
}

#endif
