// How much of an area light, whatever its body, is seen past a signed distance field. Needs lib/field_cells.glsl and
// lib/area_occluders.glsl, with POLYGON_CORNERS at least OUTLINE_CORNERS + 6.
#ifndef LIB_FIELD_LIGHT_GLSL
#define LIB_FIELD_LIGHT_GLSL

// Where cones towards the light end, as lib/field_cells.glsl has it: a planar one's own plane, else that through the middle of the body.
vec4 cellPlane(BodyArrays arrays, BodyBlock light, vec3 p)
{
    vec3 to = light.centre - p;
    if ((light.flags & kBodyPlanar) == 0u)
        return vec4(unitOrZero(to), length(to));
    vec3 normal = bodyFace(arrays, light, 0u).normal;
    float height = dot(normal, outline[0]);
    return height < 0.0 ? vec4(-normal, -height) : vec4(normal, height);
}

// 1 where the light does not shine on the point at all. `normal` is the surface's.
float lightVisibility(FieldsBlock fields, BodyArrays arrays, BodyBlock light, vec3 p, vec3 normal, uint cells)
{
    if (!beginLight(arrays, light, p))
        return 1.0;
    mat3 frame = tangentFrame(normal);
    int count = 0;
    for (int i = 0; i < outlineCount; ++i)
        addCellCorner(frame, count, outline[i], outline[i + 1 < outlineCount ? i + 1 : 0]);
    cornerCounts[kCellLight + 1] = count;
    return cellVisibility(fields, p, frame, cellPlane(arrays, light, p), cells);
}

#endif
