// Bodies as the triangles that face a point, each a silhouette by itself. Needs what lib/silhouette.glsl needs.
#ifndef LIB_TRIANGLES_GLSL
#define LIB_TRIANGLES_GLSL

// After hidingOf(). Seen edge-on it hides nothing.
bool hidesByFace(BodyBlock body, FaceBlock face, uint index)
{
    bool isSeen = (body.flags & kBodyPlanar) != 0u || isFront(index);
    return isSeen && !isLevel(index) && dot(face.normal, face.normal) > 0.0;
}

// The edges of the triangle of the face's corners 0, k + 1 and k + 2, or of what of it is in front of the cut.
void addTriangle(int first, BodyArrays arrays, BodyBlock body, vec3 point, FaceBlock face, uint index, uint k, bool isCut, CutPlane plane)
{
    vec3 corners[3];
    for (uint i = 0u; i < 3u; ++i) {
        uint corner = i == 0u ? 0u : isFront(index) ? k + 3u - i : k + i; // what is hidden is in front of planes: the loop runs back
        corners[i] = bodyVertex(arrays, body, faceCorner(arrays, face, corner)) - point;
    }
    vec3 leaving = vec3(0.0), entering = vec3(0.0);
    bool isCrossed = false;
    beginSilhouette();
    for (int i = 0; i < 3; ++i) {
        vec3 start = corners[i], span = corners[i < 2 ? i + 1 : 0] - start;
        addEdgeInFront(first, start, span, vec4(planeThrough(start, span), 0.0), isCut, plane);
        float startHeight = dot(plane.normal, start) + plane.offset, rise = dot(plane.normal, span), endHeight = startHeight + rise;
        if (isCut && (startHeight > 0.0) != (endHeight > 0.0)) {
            vec3 at = start - span * (startHeight / rise);
            leaving = startHeight > 0.0 ? at : leaving;
            entering = startHeight > 0.0 ? entering : at;
            isCrossed = true;
        }
    }
    if (isCrossed)
        addEdge(first, leaving, entering - leaving, vec4(planeThrough(leaving, entering - leaving), 0.0));
    dropFalsePlanes(first);
}

#endif
