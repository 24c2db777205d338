// Fragments by the two by two. Helper invocations take part, discarded ones may not.
#ifndef LIB_QUAD_GLSL
#define LIB_QUAD_GLSL

#extension GL_KHR_shader_subgroup_quad : require

void addOverQuad(inout float value)
{
    value += subgroupQuadSwapHorizontal(value);
    value += subgroupQuadSwapVertical(value);
}

void addOverQuad(inout vec3 value)
{
    value += subgroupQuadSwapHorizontal(value);
    value += subgroupQuadSwapVertical(value);
}

// Of the fragments on the triangle: helpers lie off it, anywhere on its plane.
vec3 meanOverQuad(vec3 value, bool isHelper)
{
    vec4 sum = isHelper ? vec4(0.0) : vec4(value, 1.0);
    sum += subgroupQuadSwapHorizontal(sum);
    sum += subgroupQuadSwapVertical(sum);
    return sum.xyz / max(sum.w, 1.0);
}

#endif
