#include "app/shadow_bodies.h"

#include "bake/hulls.h"
#include "base/error.h"
#include "base/log.h"
#include "ecs/each.h"
#include "scene/animation.h"
#include "scene/bone_capsules.h"
#include "scene/components.h"
#include "scene/light_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace antumbra::app {

namespace {

using scene::AreaLight;
using scene::Assets;
using scene::BodyPart;
using scene::ConvexBody;

constexpr uint32_t kMostLightVertices = 162; // of an icosahedron whose edges are halved twice
constexpr uint32_t kMostLightTriangles = 256;

/// The mesh that an entity shows when it stands at rest.
std::optional<scene::Mesh> ownMesh(const ecs::World& world, const Assets& assets, ecs::Entity entity)
{
    const scene::Drawable* drawable = world.find<scene::Drawable>(entity);
    return drawable != nullptr ? std::optional(scene::restMesh(assets.models[drawable->model])) : std::nullopt;
}

std::vector<ConvexBody> bodiesOf(const AreaLight& light, const std::optional<scene::Mesh>& mesh, const std::string& subject)
{
    if (light.shape == scene::LightShape::Mesh && !mesh)
        throw Error("an AreaLight of shape mesh has no mesh", subject);
    if (std::optional<ConvexBody> body = scene::lightBody(light, mesh ? &*mesh : nullptr, light.segments)) {
        if (body->vertices.size() <= kMostLightVertices)
            return {*std::move(body)};
        throw Error(fmt::format("an AreaLight's mesh has {} vertices, at most {} are allowed", body->vertices.size(), kMostLightVertices),
                    subject);
    }
    std::vector<ConvexBody> triangles = mesh ? scene::triangleBodies(*mesh) : std::vector<ConvexBody>{};
    if (triangles.empty() || triangles.size() > kMostLightTriangles)
        throw Error(fmt::format("an AreaLight shines by {} triangles, expected 1 to {}", triangles.size(), kMostLightTriangles), subject);
    return triangles;
}

/// All of the bodies in one mesh.
scene::Mesh meshOfAll(std::span<const ConvexBody> bodies)
{
    scene::Mesh all;
    for (const ConvexBody& body : bodies) {
        const scene::Mesh mesh = meshOf(body);
        const auto first = static_cast<uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
        all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
        all.uvs.insert(all.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
        all.triangleMaterials.insert(all.triangleMaterials.end(), mesh.triangleMaterials.begin(), mesh.triangleMaterials.end());
        for (const uint32_t index : mesh.indices)
            all.indices.push_back(first + index);
    }
    return all;
}

/// Where the first of them is.
uint32_t addParts(Assets& assets, std::vector<BodyPart> parts)
{
    const auto first = static_cast<uint32_t>(assets.bodyParts.size());
    std::ranges::move(parts, std::back_inserter(assets.bodyParts));
    return first;
}

void makeLights(ecs::World& world, Assets& assets, const std::string& subject)
{
    std::vector<std::pair<ecs::Entity, scene::LightBodies>> made;
    for (auto [entity, light] : ecs::Each<ecs::Entity, const AreaLight>(world)) {
        const std::vector<ConvexBody> bodies = bodiesOf(light, ownMesh(world, assets, entity), subject);
        std::vector<BodyPart> parts;
        for (const ConvexBody& body : bodies)
            parts.push_back({body});
        const auto count = static_cast<uint32_t>(parts.size()), model = static_cast<uint32_t>(assets.models.size());
        made.emplace_back(entity, scene::LightBodies{addParts(assets, std::move(parts)), count, model});
        scene::Mesh mesh = meshOfAll(bodies);
        orderTriangles(mesh, mesh.positions);
        assets.models.push_back(rigidModel("light", std::move(mesh), {}));
    }
    for (const auto& [entity, bodies] : made)
        world.add(entity, bodies);
}

/// How far outside the body the farthest of the points lies, metres.
float marginOf(const ConvexBody& body, const scene::Mesh& mesh, std::span<const uint32_t> vertices)
{
    const std::vector<glm::dvec3> normals = faceNormals(body);
    double margin = 0;
    for (const uint32_t vertex : vertices) {
        double height = -1e30;
        for (uint32_t face = 0; face < body.faces.size(); ++face)
            height = std::max(height, glm::dot(normals[face], glm::dvec3(mesh.positions[vertex] - body.vertices[body.loop(face)[0]])));
        margin = std::max(margin, height);
    }
    return static_cast<float>(margin);
}

/// Hulls of joints or of pieces, in bind space.
std::vector<BodyPart> hullParts(const scene::Model& model, const scene::Occluder& occluder)
{
    std::vector<BodyPart> parts;
    const bake::HullsBy by = occluder.isByPiece ? bake::HullsBy::Piece : bake::HullsBy::Joint;
    for (bake::Hull& hull : bake::hullsOfModel(model, occluder.greatestVertices, by)) {
        const bool isHollow = !hull.body.isPlanar; // a flat one has no inside
        const float margin = marginOf(hull.body, model.mesh, hull.vertices);
        parts.push_back({.body = std::move(hull.body), .joint = hull.joint, .isHollow = isHollow, .margin = margin});
    }
    // The largest first: what it hides of a light need not be asked about the others.
    std::ranges::sort(parts, std::greater{}, [](const BodyPart& part) { return surfaceArea(part.body); });
    return parts;
}

std::vector<mat4> restJoints(const scene::Model& model)
{
    scene::LocalPose pose;
    setRest(pose, model);
    std::vector<mat4> joints(model.joints.size()), nodes;
    resolve(joints, nodes, pose, model);
    return joints;
}

/// Of a model at rest: whole where it is convex, else by hulls or by its triangles.
std::vector<BodyPart> partsAtRest(const scene::Model& model, const scene::Occluder& occluder)
{
    const scene::Mesh rest = scene::restMesh(model);
    const std::optional<ConvexBody> whole = scene::meshBody(rest);
    if (whole && whole->vertices.size() <= occluder.greatestVertices && occluder.shape == scene::OccluderShape::Hulls)
        return {{*whole}};
    std::vector<BodyPart> parts;
    if (occluder.shape == scene::OccluderShape::Triangles) {
        for (ConvexBody& triangle : scene::triangleBodies(rest))
            parts.push_back({.body = std::move(triangle)});
        return parts;
    }
    const std::vector<mat4> joints = restJoints(model);
    for (BodyPart& part : hullParts(model, occluder)) {
        part.body = transformed(part.body, joints[part.joint]);
        part.joint = scene::kNoIndex;
        parts.push_back(std::move(part));
    }
    return parts;
}

std::vector<BodyPart> partsOf(const scene::Model& model, const scene::Occluder& occluder, bool isPosed, const std::string& subject)
{
    if (!isPosed)
        return partsAtRest(model, occluder);
    if (occluder.shape == scene::OccluderShape::Triangles)
        logWarning("{}: an Occluder that moves blocks by a hull a bone, not by its triangles", subject);
    return hullParts(model, occluder);
}

void makeOccluders(ecs::World& world, Assets& assets, const std::string& subject)
{
    std::vector<std::pair<ecs::Entity, scene::OccluderBodies>> made;
    for (auto [entity, occluder, drawable, dynamic] :
         ecs::Each<ecs::Entity, const scene::Occluder, const scene::Drawable, ecs::Maybe<const scene::DynamicSkinned>>(world))
    {
        std::vector<BodyPart> parts = partsOf(assets.models[drawable.model], occluder, dynamic != nullptr, subject);
        const auto count = static_cast<uint32_t>(parts.size());
        made.emplace_back(entity, scene::OccluderBodies{addParts(assets, std::move(parts)), count});
    }
    for (const auto& [entity, bodies] : made)
        world.add(entity, bodies);
}

void makeBones(ecs::World& world, Assets& assets, const std::string& subject)
{
    std::vector<std::pair<ecs::Entity, scene::FieldCapsules>> made;
    std::map<uint32_t, scene::FieldCapsules> ofModels;
    for (auto [entity, primitive, drawable, dynamic] :
         ecs::Each<ecs::Entity, const scene::SDFPrimitive, ecs::Maybe<const scene::Drawable>, ecs::Maybe<const scene::DynamicSkinned>>(
             world))
    {
        if (primitive.shape != scene::SDFShape::Bones)
            continue;
        if (drawable == nullptr || dynamic == nullptr)
            throw Error("an SDFPrimitive of shape bones is not DynamicSkinned with a mesh", subject);
        const auto [range, isNew] = ofModels.try_emplace(drawable->model);
        if (isNew) {
            const std::vector<scene::BoneCapsule> capsules = scene::boneCapsules(assets.models[drawable->model]);
            range->second = {static_cast<uint32_t>(assets.capsules.size()), static_cast<uint32_t>(capsules.size())};
            assets.capsules.insert(assets.capsules.end(), capsules.begin(), capsules.end());
        }
        made.emplace_back(entity, range->second);
    }
    for (const auto& [entity, capsules] : made)
        world.add(entity, capsules);
}

} // namespace

void makeShadowBodies(ecs::World& world, scene::Assets& assets, const std::string& subject)
{
    makeLights(world, assets, subject);
    makeOccluders(world, assets, subject);
    makeBones(world, assets, subject);
}

} // namespace antumbra::app
