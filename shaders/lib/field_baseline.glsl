// Soft shadows from one march through a signed distance field, for comparison: Quilez 2010 with signed distances and Aaltonen's improvement
// (2018), which take the occluder for one straight edge; and the minimal tangent cone of Ban, Balint, Valasek 2020 (Algorithm 2, as corrected
// in methods/sdf-cones.md), which did, with looks to its sides. Needs lib/field_cone.glsl.
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
    float least = 1.0, t = 1.0e-3, end = at.distanceLight - radius;
    for (uint i = 0u; i < kFieldMarchSteps && t < end && least > -1.0; ++i) {
        float f = fieldDistance(fields, p + at.axis * t);
        least = min(least, f / max(tangent * t, 1.0e-7));
        t += clamp(abs(f), 0.002 * at.distanceLight, 0.1 * at.distanceLight);
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
    float least = 1.0, t = 1.0e-3, before = 1.0e20, end = at.distanceLight - radius;
    for (uint i = 0u; i < kFieldMarchSteps && t < end; ++i) {
        float f = fieldDistance(fields, p + at.axis * t);
        if (f < 1.0e-4)
            return 0.0;
        float back = f * f / (2.0 * before), aside = sqrt(max(f * f - back * back, 0.0));
        least = min(least, cotangent * aside / max(t - back, 1.0e-6));
        before = f;
        t += f;
    }
    return smoothShare(2.0 * clamp(least, 0.0, 1.0) - 1.0);
}

// Where a cone is clear the least, and where next: solids at two depths narrow it twice.
struct FieldNarrows
{
    vec2 at; // metres along the axis
    vec2 ratio; // of distance by radius there, the lesser first; 1 where nothing narrows it
};

void addNarrow(inout FieldNarrows narrows, float at, float ratio)
{
    bool isLeast = ratio < narrows.ratio.x, isNext = ratio < narrows.ratio.y;
    narrows.at.y = isLeast ? narrows.at.x : isNext ? at : narrows.at.y;
    narrows.ratio.y = isLeast ? narrows.ratio.x : isNext ? ratio : narrows.ratio.y;
    narrows.at.x = isLeast ? at : narrows.at.x;
    narrows.ratio.x = isLeast ? ratio : narrows.ratio.x;
}

// A cone that shrinks to what is clear as it goes; no step goes past more than `tolerance` of its width.
FieldNarrows narrowsOf(FieldsBlock fields, FieldCone cone, float distanceFrom, float end, float tolerance)
{
    FieldNarrows narrows = FieldNarrows(vec2(0.0), vec2(1.0));
    float share = 1.0, before = 1.0, t = 0.0, f = distanceFrom, last = 0.0;
    bool isFalling = false;
    for (uint i = 0u; i < kFieldMarchSteps && t < end && before > -1.0; ++i) {
        f = i > 0u ? fieldDistance(fields, cone.apex + cone.axis * t) : f;
        float whole = radiusAt(cone, t), ratio = f / whole;
        if (isFalling && ratio > before)
            addNarrow(narrows, last, before);
        isFalling = ratio < before || (isFalling && ratio == before);
        share = min(share, ratio - tolerance);
        before = ratio;
        last = t;
        t += max((f - share * whole) / (1.0 + share * cone.slope), 1.0e-5 + 1.0e-4 * t);
    }
    if (isFalling)
        addNarrow(narrows, last, before);
    return narrows;
}

// The minimal tangent cone, which takes what it meets for one straight edge, is off by corners, by what is narrower than the light and by
// solids on both its sides; so four parts of the light are looked at where the cone is narrowest, and where it is next.
float coneVisibility(FieldsBlock fields, vec3 p, vec3 centre, float radius, float tolerance)
{
    const uint kLooks = 4u;
    FieldReceiver at = fieldReceiver(fields, p, centre, radius);
    if (at.settled >= 0.0)
        return at.settled;
    FieldCone cone = coneToSphere(p, at.axis, at.distanceLight, radius, min(at.distance, 0.5 * radius));
    FieldNarrows narrows = narrowsOf(fields, cone, at.distance, at.distanceLight - radius, tolerance);
    if (narrows.ratio.x >= 1.0 || narrows.ratio.x <= -1.0)
        return narrows.ratio.x > 0.0 ? 1.0 : 0.0;
    mat3 frame = tangentFrame(at.axis);
    float sine = min(radius / at.distanceLight, 0.9999), seen = 0.0;
    for (uint k = 0u; k < kLooks; ++k) {
        vec3 place = subConePlace(k, kLooks), aside = frame[0] * place.x + frame[1] * place.y;
        float least = 1.0;
        for (int i = 0; i < 2; ++i) {
            float here = radiusAt(cone, narrows.at[i]);
            vec3 there = cone.apex + cone.axis * narrows.at[i] + aside * here;
            least = narrows.ratio[i] < 1.0 ? min(least, fieldDistance(fields, there) / (place.z * here)) : least;
        }
        seen += capCoverage(least, place.z * sine);
    }
    return seen / float(kLooks);
}

#endif
