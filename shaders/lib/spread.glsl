// Which pixels a group takes. CPU devices deal a dispatch out in runs of groups, one a core: in order, one would have the sky and another all
// that there is to do.
#ifndef LIB_SPREAD_GLSL
#define LIB_SPREAD_GLSL

// A permutation of the rows in which any run is spread over all of them: by steps of the golden section, as near as shares no divisor.
uint spreadRow(uint row, uint rows)
{
    uint stride = max(uint(0.618034 * float(rows)), 1u);
    for (uint divisor = 0u; divisor != 1u; ++stride) {
        uint a = rows, b = stride;
        while (b != 0u) {
            uint rest = a % b;
            a = b;
            b = rest;
        }
        divisor = a;
    }
    return row * (stride - 1u) % rows;
}

// In place of gl_GlobalInvocationID, for groups of that many rows.
uvec2 spreadInvocation(uint groupHeight)
{
    uint row = spreadRow(gl_WorkGroupID.y, gl_NumWorkGroups.y);
    return uvec2(gl_GlobalInvocationID.x, row * groupHeight + gl_LocalInvocationID.y);
}

#endif
