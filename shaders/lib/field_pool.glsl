// Many rays through distance fields by one group of threads: who is done with a ray takes the next, so that nobody waits for the longest way.
// Needs lib/field_ray.glsl and, behind it, pooledRay and addPooledGroups.
#ifndef LIB_FIELD_POOL_GLSL
#define LIB_FIELD_POOL_GLSL

const uint kPoolThreads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
const uint kPoolRays = 2u * kPoolThreads; // at most at once

FieldRay pooledRay(uint i); // the i-th, which meets nothing yet
void addPooledGroups(FieldsBlock fields, uint i, inout FieldRay ray); // that it may meet

shared uint poolNext;
shared uvec2 poolGroups[kPoolRays]; // as in FieldRay,
shared vec2 poolWays[kPoolRays]; // until a ray is through; then how far off it meets a field, negative where it meets none

// How far off the i-th of the rays from `first` on meets a field; negative where it meets none.
float pooledHit(uint first, uint i) { return poolWays[i - first].x; }

// The next that may meet anything; `end` and more where there is none.
uint takePooledRay(uint first, uint end)
{
    uint i;
    do
        i = atomicAdd(poolNext, 1u);
    while (i < end && poolWays[i - first].y < 0.0);
    return i;
}

// Takes rays [first, end) as far as they go. For all threads together.
void traceThroughFields(FieldsBlock fields, uint first, uint end)
{
    barrier(); // nobody asks for hits of earlier rays any more
    poolNext = first;
    for (uint i = first + gl_LocalInvocationIndex; i < end; i += kPoolThreads) {
        FieldRay ray = pooledRay(i);
        addPooledGroups(fields, i, ray);
        poolGroups[i - first] = ray.groups;
        poolWays[i - first] = isOnItsWay(ray) ? ray.way : vec2(-1.0);
    }
    barrier();
    FieldRay ray = fieldRay(vec3(0.0), vec3(0.0, 1.0, 0.0));
    for (uint i = takePooledRay(first, end); i < end;) {
        if (ray.looks == 0u) {
            ray = pooledRay(i);
            ray.groups = poolGroups[i - first];
            ray.way = poolWays[i - first];
        }
        bool isMet = isInField(fields, ray);
        if (isMet || !isOnItsWay(ray)) {
            poolWays[i - first].x = isMet ? ray.way.x : -1.0;
            i = takePooledRay(first, end);
            ray.looks = 0u;
        }
    }
    barrier();
}

#endif
