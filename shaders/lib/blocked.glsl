// Whether something convex stands between two points. For what closed forms have no room for. Needs lib/silhouette.glsl.
#ifndef LIB_BLOCKED_GLSL
#define LIB_BLOCKED_GLSL

// The way from the point to `to`, relative to it, goes through the face of a planar body.
bool passesFace(BodyArrays arrays, BodyBlock body, FaceBlock face, vec3 point, vec3 to)
{
    float height = heightOver(arrays, body, face, point), along = dot(face.normal, to);
    float at = along != 0.0 ? -height / along : -1.0;
    bool passes = at > 0.0 && at < 0.9999;
    for (uint i = 0u; i < face.cornerCount && passes; ++i) {
        vec3 a = bodyVertex(arrays, body, faceCorner(arrays, face, i)) - point;
        vec3 b = bodyVertex(arrays, body, faceCorner(arrays, face, i + 1u < face.cornerCount ? i + 1u : 0u)) - point;
        passes = dot(cross(b - a, to * at - a), face.normal) >= 0.0;
    }
    return passes;
}

// The same for any body.
bool blocksWay(BodyArrays arrays, BodyBlock body, vec3 point, vec3 to)
{
    if ((body.flags & kBodyPlanar) != 0u)
        return passesFace(arrays, body, bodyFace(arrays, body, 0u), point, to);
    float entry = 0.0, exit = 0.9999, highest = -1.0e30;
    bool isBeside = false;
    for (uint i = 0u; i < body.faceCount; ++i) {
        FaceBlock face = bodyFace(arrays, body, i);
        float height = heightOver(arrays, body, face, point), along = dot(face.normal, to);
        highest = max(highest, height);
        float at = along != 0.0 ? -height / along : 0.0;
        entry = along < 0.0 ? max(entry, at) : entry;
        exit = along > 0.0 ? min(exit, at) : exit;
        isBeside = isBeside || (along == 0.0 && height > 0.0);
    }
    bool isHollow = (body.flags & kBodyHollow) != 0u && highest <= body.margin;
    return !isBeside && !isHollow && entry < exit;
}

#endif
