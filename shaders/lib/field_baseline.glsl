// Ways to a soft shadow from one march through a signed distance field, for comparison: Quilez 2010 with signed distances and Aaltonen's
// improvement (2018), which take the occluder for one straight edge; and the minimal tangent cone of Ban, Balint, Valasek 2020 (Algorithm 2,
// as corrected in methods/sdf-cones.md), which looks around where it is narrowest. Needs lib/field_cone.glsl.
#ifndef LIB_FIELD_BASELINE_GLSL
#define LIB_FIELD_BASELINE_GLSL

// Share of a disc on one side of a line, nearly; `m` from -1 to 1.
float smoothShare(float m)
{
    float x = 0.5 * clamp(m, -1.0, 1.0) + 0.5;
    return x * x * (3.0 - 2.0 * x);
}

// The least angle, as a share of the light's, under which the field leaves the axis clear; into solids too, as distances have a sign.
float quilezVisibility(FieldsBlock fields, vec3 p, vec3 centre, float radius)
{
    FieldReceiver at = fieldReceiver(fields, p, centre, radius);
    if (at.settled >= 0.0)
        return at.settled;
    float tangent = radius * inversesqrt(max(at.distanceLight * at.distanceLight - radius * radius, 1.0e-9));
    float least = 1.0, t = 1.0e-3, f = at.distance, step = t, end = at.distanceLight - radius;
    for (uint i = 0u; i < kFieldMarchSteps && t < end && least > -1.0; ++i) {
        f = fieldDistance(fields, p + at.axis * t, f + step);
        least = min(least, f / max(tangent * t, 1.0e-7));
        step = clamp(abs(f), 0.002 * at.distanceLight, 0.1 * at.distanceLight);
        t += step;
    }
    return smoothShare(least);
}

// The same from outside only, so that half the penumbra is missing; the nearest point is guessed between two steps.
float aaltonenVisibility(FieldsBlock fields, vec3 p, vec3 centre, float radius)
{
    FieldReceiver at = fieldReceiver(fields, p, centre, radius);
    if (at.settled >= 0.0)
        return at.settled;
    float cotangent = sqrt(max(at.distanceLight * at.distanceLight - radius * radius, 1.0e-9)) / max(radius, 1.0e-7);
    float least = 1.0, t = 1.0e-3, before = 1.0e20, most = at.distance + t, end = at.distanceLight - radius;
    for (uint i = 0u; i < kFieldMarchSteps && t < end; ++i) {
        float f = fieldDistance(fields, p + at.axis * t, most);
        if (f < 1.0e-4)
            return 0.0;
        float back = f * f / (2.0 * before), aside = sqrt(max(f * f - back * back, 0.0));
        least = min(least, cotangent * aside / max(t - back, 1.0e-6));
        before = f;
        most = 2.0 * f;
        t += f;
    }
    return smoothShare(2.0 * clamp(least, 0.0, 1.0) - 1.0);
}

// A cone that shrinks to what is clear as it goes; no step goes past more than `tolerance` of its width.
float coneVisibility(FieldsBlock fields, vec3 p, vec3 centre, float radius, float tolerance)
{
    FieldReceiver at = fieldReceiver(fields, p, centre, radius);
    if (at.settled >= 0.0)
        return at.settled;
    FieldCone cone = coneToSphere(p, at.axis, at.distanceLight, radius, 0.0);
    Narrowest where = Narrowest(p, at.distance, radiusAt(cone, 0.0), tangentFrame(at.axis));
    float least = 1.0, share = 1.0, t = 0.0, f = at.distance, step = 0.0, end = at.distanceLight - radius;
    for (uint i = 0u; i < kFieldMarchSteps && t < end && least > -1.0; ++i) {
        f = i > 0u ? fieldDistance(fields, p + at.axis * t, f + step) : f;
        float whole = radiusAt(cone, t);
        if (f < least * whole) {
            least = f / whole;
            where.point = p + at.axis * t;
            where.distance = f;
            where.radius = whole;
        }
        share = min(share, max(f / whole - tolerance, -1.0));
        step = max((f - share * whole) / (1.0 + share * cone.slope), 1.0e-5 + 1.0e-4 * t);
        t += step;
    }
    return least >= 1.0 ? 1.0 : least <= -1.0 ? 0.0 : seenPastRectangle(fields, where, least);
}

#endif
