// Ban, Balint, Valasek 2020, section 4.2, for comparison with lib/field_cells.glsl, which it needs: one edge before the whole light, asked by
// samples of it.
#ifndef LIB_FIELD_SAMPLES_GLSL
#define LIB_FIELD_SAMPLES_GLSL

// Share of the form factor of the polygon at kCellLight that is in front of the plane, by points on the flat triangles of its corners.
float sampledShareInFront(vec3 plane, uint samples)
{
    float front = 0.0, all = 1.0e-30; // never zero
    int base = kCellLight * POLYGON_CORNERS, triangles = cornerCounts[kCellLight] - 2;
    vec3 a = polygonCorners[base].xyz;
    for (uint k = 0u; k < samples; ++k) {
        int i = 1 + int(k) % triangles;
        vec3 b = polygonCorners[base + i].xyz, c = polygonCorners[base + i + 1].xyz;
        float u = sqrt((float(k) + 0.5) / float(samples)), v = radicalInverse2(k / uint(triangles));
        vec3 at = a * (1.0 - u) + b * (u * (1.0 - v)) + c * (u * v);
        float distance2 = dot(at, at), weight = abs(dot(a, cross(b - a, c - a))) * max(at.z, 0.0) / (distance2 * distance2);
        front += dot(plane, at) > 0.0 ? weight : 0.0;
        all += weight;
    }
    return clamp(front / all, 0.0, 1.0);
}

// As cellVisibility.
float edgeSampleVisibility(FieldsBlock fields, vec3 p, mat3 frame, vec4 plane, uint samples)
{
    cut(kCellLight + 1, crossingOf(kCellLight + 1, vec3(0.0, 0.0, 1.0)), kCellLight, kCell, false, true);
    float distanceHere = fieldDistance(fields, p), end;
    if (cornerCounts[kCellLight] < 3 || !(distanceHere > 0.0))
        return distanceHere > 0.0 ? 1.0 : 0.0;
    FieldCone cone = coneOfPolygon(CellLight(p, distanceHere, frame, plane), kCellLight, end);
    FieldMarch march = marchCone(fields, cone, vec2(0.0, end), distanceHere, farthestDistance(fields, p), 0.1);
    if (march.least >= 1.0 || march.least <= -1.0)
        return march.least > 0.0 ? 1.0 : 0.0;
    FieldSlope slope = slopeAcross(fields, cone.apex + cone.axis * march.at, tangentFrame(cone.axis), march.distance,
                                   0.02 * radiusAt(cone, march.at), false);
    return sampledShareInFront(edgePlane(cone, march, slope) * frame, samples);
}

#endif
