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

// How far off the dynamic surface is that the ray hits before any static one; negative where there is none. One loop with one query in it:
// CPU devices run the code of every branch, so the query must stand in the program once.
float dynamicHitFirst(uint64_t scene, vec3 origin, vec3 direction, float far)
{
    float hit = -1.0;
    bool isAskingForStatic = false;
    for (bool goesOn = true; goesOn;) {
        uint mask = isAskingForStatic ? kMaskStatic : kMaskDynamic;
        uint flags = isAskingForStatic ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
        float at = closestHit(scene, mask, flags, origin, direction, far);
        hit = !isAskingForStatic ? at : at < 0.0 ? hit : -1.0;
        goesOn = !isAskingForStatic && at >= 0.0;
        far = goesOn ? at : far;
        isAskingForStatic = true;
    }
    return hit;
}

// The same by one ray through everything: what a renderer without culling does. Instances carry their mask as custom index.
float dynamicHitFirstOfAll(uint64_t scene, vec3 origin, vec3 direction)
{
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(scene), gl_RayFlagsOpaqueEXT, kMaskStatic | kMaskDynamic, origin, 0.0, direction,
                          kRayFar);
    while (rayQueryProceedEXT(query)) {
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT)
        return -1.0;
    return uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true)) == kMaskDynamic ? rayQueryGetIntersectionTEXT(query, true) : -1.0;
}

#endif
