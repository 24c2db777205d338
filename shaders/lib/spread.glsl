// Which pixels a group takes. CPU devices deal a dispatch out in runs of groups, one a core: in order, one would have the sky and another all
// that there is to do.
#ifndef LIB_SPREAD_GLSL
#define LIB_SPREAD_GLSL

// A permutation of the rows in which any run is spread over all of them: by steps of the golden section, as near as shares no divisor. In
// floats, exact for fewer than 2^22 rows, as CPU devices divide integers a lane at a time.
uint spreadRow(uint row, uint rows)
{
    float stride = max(floor(0.618034 * float(rows)), 1.0);
    for (float divisor = 0.0; divisor != 1.0; ++stride) {
        float a = float(rows), b = stride;
        while (b != 0.0) {
            float rest = abs(a - b * floor(a / b)); // a device may have rounded the quotient up: what is short divides alike
            a = b;
            b = rest;
        }
        divisor = a;
    }
    return row * uint(stride - 1.0) % rows;
}

// In place of gl_GlobalInvocationID, for groups of that many rows.
uvec2 spreadInvocation(uint groupHeight)
{
    uint row = spreadRow(gl_WorkGroupID.y, gl_NumWorkGroups.y);
    return uvec2(gl_GlobalInvocationID.x, row * groupHeight + gl_LocalInvocationID.y);
}

#endif
