// Points on the faces of a light's body that a point sees, evenly by area.
#ifndef LIB_LIGHT_POINTS_GLSL
#define LIB_LIGHT_POINTS_GLSL

#include "lib/bodies.glsl"

struct LightPoint
{
    vec3 position; // relative to the point that sees it
    vec3 normal; // towards it
};

bool isFaceLit(BodyArrays arrays, BodyBlock light, FaceBlock face, vec3 point)
{
    bool isTwoSided = (light.flags & kBodyTwoSided) != 0u;
    return seesFace(arrays, light, face, point, 1.0) || (isTwoSided && seesFace(arrays, light, face, point, -1.0));
}

// Twice the area of the triangle of the face's corners 0, k + 1 and k + 2.
float triangleArea2(BodyArrays arrays, BodyBlock light, FaceBlock face, uint k)
{
    vec3 a = bodyVertex(arrays, light, faceCorner(arrays, face, 0u));
    vec3 b = bodyVertex(arrays, light, faceCorner(arrays, face, k + 1u));
    vec3 c = bodyVertex(arrays, light, faceCorner(arrays, face, k + 2u));
    return length(cross(b - a, c - a));
}

// m^2 of the faces that shine on the point.
float litArea(BodyArrays arrays, BodyBlock light, vec3 point)
{
    float area2 = 0.0;
    for (uint i = 0u; i < light.faceCount; ++i) {
        FaceBlock face = bodyFace(arrays, light, i);
        if (isFaceLit(arrays, light, face, point))
            for (uint k = 0u; k + 2u < face.cornerCount; ++k)
                area2 += triangleArea2(arrays, light, face, k);
    }
    return 0.5 * area2;
}

// Metres: of the disk that shows as much area as the light does from there. `direction` is the way to its middle, unit.
float apparentRadius(BodyArrays arrays, BodyBlock light, vec3 point, vec3 direction)
{
    float area2 = 0.0;
    for (uint i = 0u; i < light.faceCount; ++i) {
        FaceBlock face = bodyFace(arrays, light, i);
        if (isFaceLit(arrays, light, face, point))
            for (uint k = 0u; k + 2u < face.cornerCount; ++k)
                area2 += triangleArea2(arrays, light, face, k) * abs(dot(face.normal, direction));
    }
    return sqrt(area2 / 6.2831853);
}

// `u` in [0, 1): a share of litArea, which is `area`, and two coordinates there.
LightPoint pointOnLight(BodyArrays arrays, BodyBlock light, vec3 point, float area, vec2 u)
{
    float left = u.x * 2.0 * area, share = 0.0;
    FaceBlock chosen = bodyFace(arrays, light, 0u);
    uint triangle = 0u;
    bool isChosen = false;
    for (uint i = 0u; i < light.faceCount; ++i) {
        FaceBlock face = bodyFace(arrays, light, i);
        if (isChosen || !isFaceLit(arrays, light, face, point))
            continue;
        for (uint k = 0u; k + 2u < face.cornerCount && !isChosen; ++k) {
            float area2 = triangleArea2(arrays, light, face, k);
            // The last one seen stands in where rounding leaves something over.
            chosen = face;
            triangle = k;
            share = area2 > 0.0 ? min(left / area2, 1.0) : 0.0;
            isChosen = left < area2;
            left -= area2;
        }
    }
    vec3 a = bodyVertex(arrays, light, faceCorner(arrays, chosen, 0u)) - point;
    vec3 b = bodyVertex(arrays, light, faceCorner(arrays, chosen, triangle + 1u)) - point;
    vec3 c = bodyVertex(arrays, light, faceCorner(arrays, chosen, triangle + 2u)) - point;
    float s = sqrt(share);
    vec3 normal = dot(chosen.normal, a) < 0.0 ? chosen.normal : -chosen.normal;
    return LightPoint(a * (1.0 - s) + b * (s * (1.0 - u.y)) + c * (s * u.y), normal);
}

#endif
