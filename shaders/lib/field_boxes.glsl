// Which groups of distance fields a ray through the scene may meet. The boxes about them are procedural geometry of the acceleration structure
// (render/field_boxes.h); what melts or is cut is no sum of its groups, so that a ray then goes through all that it may meet at once. With
// COMPUTE_BVH each group is asked. Needs lib/field_ray.glsl, shared/occlusion.h and, without COMPUTE_BVH, lib/ray_query.glsl.
#ifndef LIB_FIELD_BOXES_GLSL
#define LIB_FIELD_BOXES_GLSL

// Adds those that the ray meets before `far`, metres.
void addGroups(uint64_t scene, FieldsBlock fields, float far, inout FieldRay ray)
{
#ifdef COMPUTE_BVH
    addGroups(fields, far, ray);
#else
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(scene), gl_RayFlagsNoOpaqueEXT, kMaskFields, ray.origin, 0.0, ray.direction, far);
    while (rayQueryProceedEXT(query)) // a box, which it may meet if only by rounding
        addGroup(fields, uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)), far, ray);
#endif
}

#endif
