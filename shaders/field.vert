#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "lib/surface.glsl"
#include "lib/field.glsl"
#include "lib/field_march.glsl"

// A square of pixels that may show a signed distance field, as two triangles; none where nothing reaches into the cone of its rays. What one
// march along the cone finds clear, the rays of its pixels need not march through.
layout(push_constant, scalar) uniform Push { FieldDraw pc; };

layout(location = 0) flat out vec2 outWay; // metres along any of the rays: between these something may be met
layout(location = 1) flat out uvec2 outSkipped; // groups, as in FieldsBlock

const uint kMarchSteps = 32u;

// About all rays through the square.
FieldCone coneOfRays(vec2 corner)
{
    vec3 axis = normalize(fromEye(frameBlock, corner + 0.5 * float(kFieldTileSize), 1.0));
    float cosine = 1.0;
    for (int i = 0; i < 4; ++i)
        cosine = min(cosine, dot(axis, normalize(fromEye(frameBlock, corner + float(kFieldTileSize) * vec2(i & 1, i >> 1), 1.0))));
    // Points of a ray are as far from the axis as those of a chord of the angle between: a little more than the sine.
    float sine = 1.01 * sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0)) + 1.0e-6;
    return FieldCone(frameBlock.eye, axis, 0.0, sine);
}

vec2 wayAmong(FieldsBlock fields, vec3 eye)
{
    vec2 way = vec2(kFieldFarthestSeen, 0.0);
    for (uint g = 0u; g < fields.groupCount; ++g) {
        FieldGroupBlock group = fieldGroup(fields, g);
        float away = distance(group.centre, eye), radius = groupRadius(group);
        way = isLookedAt(fields, g) ? vec2(min(way.x, away - radius), max(way.y, away + radius)) : way;
    }
    return vec2(max(way.x, frameBlock.near), min(way.y, kFieldFarthestSeen));
}

void main()
{
    holdSteps(pc.fields);
    uint tile = uint(gl_VertexIndex) / 6u, k = uint(gl_VertexIndex) % 6u;
    vec2 corner = vec2((pc.firstTile + uvec2(tile % pc.tilesAcross, tile / pc.tilesAcross)) * kFieldTileSize);
    FieldCone cone = coneOfRays(corner);
    FieldsBlock fields = fieldsInCone(pc.fields, cone, kFieldFarthestSeen);
    vec2 way = wayAmong(fields, cone.apex);
    float last = kFieldFar, step = 0.0;
    bool isClear = true;
    for (uint i = 0u; i < kMarchSteps && isClear && way.x < way.y; ++i) {
        last = fieldDistance(fields, cone.apex + cone.axis * way.x, last + step);
        float clear = last - radiusAt(cone, way.x);
        isClear = clear > 0.01 * radiusAt(cone, way.x);
        step = isClear ? clear / (1.0 + cone.slope) : 0.0;
        way.x += step;
    }
    outWay = way;
    outSkipped = fields.skipped;
    vec2 at = corner + float(kFieldTileSize) * vec2(k == 1u || k == 2u || k == 4u, k == 2u || k == 4u || k == 5u);
    gl_Position = way.x < way.y ? vec4(2.0 * at / vec2(pc.extent) - 1.0, 0.0, 1.0) : vec4(-2.0, -2.0, 0.0, 1.0);
}
