// Convex bodies as they lie in buffers.
#ifndef LIB_BODIES_GLSL
#define LIB_BODIES_GLSL

#include "shared/area.h"

layout(buffer_reference, scalar) readonly buffer Bodies { BodyBlock body[]; };
layout(buffer_reference, scalar) readonly buffer BodyVertices { vec3 position[]; };
layout(buffer_reference, scalar) readonly buffer BodyFaces { FaceBlock face[]; };
layout(buffer_reference, scalar) readonly buffer BodyCorners { uint vertex[]; };
layout(buffer_reference, scalar) readonly buffer BodyEdges { EdgeBlock edge[]; };

vec3 bodyVertex(BodyArrays arrays, BodyBlock body, uint index) { return BodyVertices(arrays.vertices).position[body.firstVertex + index]; }

FaceBlock bodyFace(BodyArrays arrays, BodyBlock body, uint index) { return BodyFaces(arrays.faces).face[body.firstFace + index]; }

uint faceCorner(BodyArrays arrays, FaceBlock face, uint index) { return BodyCorners(arrays.corners).vertex[face.firstCorner + index]; }

// How far the point is in front of the face's plane, metres.
float heightOver(BodyArrays arrays, BodyBlock body, FaceBlock face, vec3 point)
{
    return dot(face.normal, point - bodyVertex(arrays, body, faceCorner(arrays, face, 0u)));
}

// A side of the light counts as seen only from a ten-millionth of the distance on.
bool seesFace(BodyArrays arrays, BodyBlock light, FaceBlock face, vec3 point, float side)
{
    vec3 from = point - bodyVertex(arrays, light, faceCorner(arrays, face, 0u));
    return side * dot(face.normal, from) > 1.0e-7 * length(from);
}

#endif
