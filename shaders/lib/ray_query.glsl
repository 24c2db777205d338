// "Which dynamic surface is hit first, and is a static one in front?": by ray query on the scene's acceleration structure.
#ifndef LIB_RAY_QUERY_GLSL
#define LIB_RAY_QUERY_GLSL

#extension GL_EXT_ray_query : require

const float kRayFar = 1.0e30;

// The distance of the closest hit among `mask`, or a negative number.
float closestHit(uint64_t scene, uint mask, uint flags, vec3 origin, vec3 direction, float far)
{
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(scene), gl_RayFlagsOpaqueEXT | flags, mask, origin, 0.0, direction, far);
    while (rayQueryProceedEXT(query)) {
    }
    // Reading a hit that is not there is undefined.
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT)
        return -1.0;
    return rayQueryGetIntersectionTEXT(query, true);
}

// How far off something among `mask` is that is hit before `far`: the nearest, or any where any will do. Negative where there is nothing.
float distanceToBlocker(uint64_t scene, uint mask, vec3 origin, vec3 direction, float far, bool anyWillDo)
{
    uint flags = anyWillDo ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
    return closestHit(scene, mask, flags, origin, direction, far);
}

// How far off a dynamic surface is that the ray hits, if the first it hits is one; negative if not. One that is no triangle may be `known` to
// be hit so far off; negative: none. Any dynamic hit will do where nothing static lies before it; only else must the closest one be known.
// One loop with one query in it: CPU devices run the code of every branch, so the query must stand in the program once.
float dynamicHitFirst(uint64_t scene, vec3 origin, vec3 direction, float far, float known)
{
    const uint kAnyDynamic = 0u, kStaticBefore = 1u, kClosestDynamic = 2u, kStaticBeforeClosest = 3u, kDone = 4u;
    uint asked = kAnyDynamic;
    float hit = -1.0;
    bool isKnown = known >= 0.0;
    far = isKnown ? known : far;
    while (asked != kDone) {
        bool isDynamic = asked == kAnyDynamic || asked == kClosestDynamic;
        uint flags = asked == kClosestDynamic ? gl_RayFlagsNoneEXT : gl_RayFlagsTerminateOnFirstHitEXT;
        float at = closestHit(scene, isDynamic ? kMaskDynamic : kMaskStatic, flags, origin, direction, far);
        hit = isDynamic ? -1.0 : at < 0.0 ? far : -1.0;
        far = isDynamic && at >= 0.0 ? at : far;
        bool goesOn = asked == kAnyDynamic ? at >= 0.0 || isKnown : asked == kStaticBefore ? at >= 0.0 : asked == kClosestDynamic;
        asked = goesOn ? asked + 1u : kDone;
    }
    return hit;
}

// The same by one ray through everything: what a renderer without culling does. Instances carry their mask as custom index.
float dynamicHitFirstOfAll(uint64_t scene, vec3 origin, vec3 direction, float known)
{
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(scene), gl_RayFlagsOpaqueEXT, kMaskAll, origin, 0.0, direction,
                          known >= 0.0 ? known : kRayFar);
    while (rayQueryProceedEXT(query)) {
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT)
        return known;
    return uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true)) == kMaskDynamic ? rayQueryGetIntersectionTEXT(query, true) : -1.0;
}

#endif
