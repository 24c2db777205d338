// How wide shadows are soft (methods/penumbra.md).
#ifndef LIB_PENUMBRA_GLSL
#define LIB_PENUMBRA_GLSL

// Metres across the way to a light, from the border of the hard shadow to either end of the penumbra: of a disk of that radius so far away,
// behind something so far away. More than 0, finite: what touches the light hides it as if a thousandth nearer.
float halfPenumbra(float radius, float away, float blocker)
{
    return max(radius * blocker / max(away - blocker, 1.0e-3 * away + 1.0e-20), 1.0e-6);
}

// Share of a disk that a straight border leaves which passes so many radii from its middle: -1 hides all of it, 1 nothing.
float diskPast(float border)
{
    float b = clamp(border, -1.0, 1.0);
    return clamp(1.0 - (acos(b) - b * sqrt(max(1.0 - b * b, 0.0))) / 3.14159265, 0.0, 1.0);
}

#endif
