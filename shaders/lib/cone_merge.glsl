// Merging: a cone that lies in another is absorbed and leaves it its height, so that rays meet fewer cones and still go far enough
// (Xu et al. 2022, algorithm 1; the wider absorbs first, so that the order of the list does not matter). Needs lib/cone.glsl.
#ifndef LIB_CONE_MERGE_GLSL
#define LIB_CONE_MERGE_GLSL

// The order in which cones absorb: all first, then the wider, then the earlier in the list.
bool precedes(Cone a, uint indexA, Cone b, uint indexB)
{
    if (a.all != b.all)
        return a.all;
    return a.halfAngle != b.halfAngle ? a.halfAngle > b.halfAngle : indexA < indexB;
}

// angle(d1, d2) + psi1 <= psi2, with the angle between the axes by its chord.
bool liesIn(Cone inner, Cone outer)
{
    if (outer.all)
        return true;
    float room = outer.halfAngle - inner.halfAngle;
    return !inner.all && room >= 0.0 && distance(inner.axis, outer.axis) <= 2.0 * sin(0.5 * room);
}

bool absorbs(Cone a, uint indexA, Cone b, uint indexB) { return precedes(a, indexA, b, indexB) && liesIn(b, a); }

#endif
