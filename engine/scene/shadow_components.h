// The components that analytic and distance-field shadows are made from: what shines, what blocks. Facts only, as in components.h.
#pragma once

#include "base/math.h"

#include <array>
#include <cstdint>
#include <optional>

namespace antumbra::scene {

enum class LightShape { Quad, Disk, Sphere, Cylinder, Polygon, Mesh };
enum class LightShadow { None, Analytic, Triangles, Traced, Ratio, Article, TwoSided, Reference };

/// Flat shapes lie in the local XZ plane and shine along +Y; a cylinder lies along Y; Mesh is the entity's own.
struct AreaLight
{
    static constexpr uint32_t kGreatestOutline = 32;

    LightShape shape = LightShape::Quad;
    vec2 size{1};                                 // Quad: edges along X and Z
    vec2 radii{0.5f};                             // Disk: along X and Z; Sphere, Cylinder: x
    float length = 1;                             // Cylinder
    std::array<vec2, kGreatestOutline> outline{}; // Polygon: convex, x and z
    uint32_t outlineCount = 0;
    uint32_t segments = 16; // Disk, Sphere, Cylinder: flat ones that stand for the curved shape, as lightBody() has them
    vec3 radiance{1};       // W/(m^2 sr)
    bool isTwoSided = false;
    bool shadowsItself = false;        // where its own mesh blocks too
    std::optional<LightShadow> shadow; // none: as the knob area.shadow says
};

enum class OccluderShape { Hulls, Triangles };

/// Takes part in analytic shadows.
struct Occluder
{
    OccluderShape shape = OccluderShape::Hulls;
    uint32_t greatestVertices = 32; // of one hull
    bool isByPiece = false;         // a hull each piece of a joint's mesh that hangs together, in place of one a joint
};

/// The bodies of an AreaLight: a range of Assets::bodyParts, and what they are drawn with, in Assets::models.
struct LightBodies
{
    uint32_t first = 0;
    uint32_t count = 0;
    uint32_t model = 0;
};

/// The bodies of an Occluder: a range of Assets::bodyParts.
struct OccluderBodies
{
    uint32_t first = 0;
    uint32_t count = 0;
};

enum class SDFShape { Sphere, Box, RoundedBox, Torus, Capsule, Cylinder, Cone, Plane, Bones };
enum class SDFOperation { Union, Subtract, Intersect, SmoothUnion };

/// The steps that Bones stand for: a range of Assets::capsules.
struct FieldCapsules
{
    uint32_t first = 0;
    uint32_t count = 0;
};

/// One step in making the distance field `field`: steps run by `order`, equal ones as the scene lists them. Bones are a capsule a
/// bone of the entity's own skinned mesh, posed with it, and a field of their own: only area lights see it, in place of the mesh.
struct SDFPrimitive
{
    SDFShape shape = SDFShape::Sphere;
    vec3 centre{0};           // Capsule: one end
    vec3 end{0};              // Capsule: the other
    vec3 halfExtent{0.5f};    // Box, RoundedBox (without its rounding)
    vec3 direction{0, 1, 0};  // unit; Torus, Cylinder, Cone: axis, Plane: normal
    float radius = 0.5f;      // Sphere, Capsule, Cylinder, RoundedBox: rounding, Torus: major, Cone: where the axis comes from
    float minorRadius = 0.1f; // Torus; Cone: where the axis goes
    float height = 1;         // Cylinder, Cone: along the axis, centred
    float offset = 0;         // Plane: along the normal
    SDFOperation operation = SDFOperation::Union;
    float blend = 0; // SmoothUnion: k
    int32_t order = 0;
    uint32_t field = 0; // into SceneFile::fields
};

/// What light does on an SDFPrimitive's surface; melted ones mix theirs.
struct SDFMaterial
{
    vec3 albedo{0.8f}; // linear
    float roughness = 1;
    float metallic = 0;
    float specular = 1; // scale of the dielectric reflection; 0: pure Lambert
};

} // namespace antumbra::scene
