#include "scene/animation.h"

#include "scene/gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

Model modelOfNodes(size_t count)
{
    Model model;
    for (size_t i = 0; i < count; ++i) {
        Node node;
        node.parent = i == 0 ? kNoIndex : static_cast<uint32_t>(i - 1);
        model.nodes.push_back(node);
        model.joints.push_back({static_cast<uint32_t>(i), mat4{1}});
    }
    return model;
}

Clip clipOf(Channel channel, uint32_t width, Interpolation interpolation, std::vector<float> times, std::vector<float> values)
{
    Clip clip;
    clip.duration = times.back();
    clip.tracks.push_back({channel, 0, width, interpolation, std::move(times), std::move(values)});
    return clip;
}

vec3 translationAt(const Clip& clip, float seconds)
{
    LocalPose pose;
    setRest(pose, modelOfNodes(1));
    sample(pose, clip, seconds);
    return pose.nodes[0].translation;
}

quat rotationAt(const Clip& clip, float seconds)
{
    LocalPose pose;
    setRest(pose, modelOfNodes(1));
    sample(pose, clip, seconds);
    return pose.nodes[0].rotation;
}

std::vector<float> xyzw(float angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }

std::vector<float> joined(std::vector<float> a, const std::vector<float>& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

float angleOf(quat rotation) { return 2 * std::atan2(rotation.z, rotation.w); }

void expectNear(vec3 actual, vec3 expected, float tolerance = 1e-5f)
{
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

bool isFinite(const mat4& matrix)
{
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(matrix[i / 4][i % 4]))
            return false;
    return true;
}

Path asset(const std::string& name) { return Path(ANTUMBRA_SHARED_DIR) / "assets/characters" / name; }

} // namespace

TEST(Animation, LinearStepAndEnds)
{
    const Clip linear = clipOf(Channel::Translation, 3, Interpolation::Linear, {1, 3}, {0, 2, -4, 10, 4, 4});
    expectNear(translationAt(linear, 2), {5, 3, 0});
    expectNear(translationAt(linear, 1.5f), {2.5f, 2.5f, -2});
    expectNear(translationAt(linear, 0), {0, 2, -4});
    expectNear(translationAt(linear, 99), {10, 4, 4});
    const Clip step = clipOf(Channel::Translation, 3, Interpolation::Step, {1, 3}, {0, 2, -4, 10, 4, 4});
    expectNear(translationAt(step, 2.999f), {0, 2, -4});
    expectNear(translationAt(step, 3), {10, 4, 4});
}

TEST(Animation, CubicFollowsTheHermiteSpline)
{
    // A cubic is its own Hermite spline: f(t) = t^3 - 2t + 1 from 1 to 4 s, tangents f'(t) = 3t^2 - 2 a second.
    const auto f = [](float t) { return t * t * t - 2 * t + 1; };
    const auto slope = [](float t) { return 3 * t * t - 2; };
    std::vector<float> values;
    for (const float t : {1.0f, 4.0f})
        for (const float value : {slope(t), f(t), slope(t)})
            values.insert(values.end(), 3, value);
    const Clip cubic = clipOf(Channel::Translation, 3, Interpolation::Cubic, {1, 4}, values);
    for (const float t : {1.0f, 1.3f, 2.0f, 2.5f, 3.9f, 4.0f})
        expectNear(translationAt(cubic, t), vec3(f(t)), 2e-4f);
    expectNear(translationAt(cubic, -1), vec3(f(1)));
    expectNear(translationAt(cubic, 7), vec3(f(4)));
}

TEST(Animation, RotationsTakeTheShorterArc)
{
    const Clip linear = clipOf(Channel::Rotation, 4, Interpolation::Linear, {0, 1}, joined(xyzw(0), xyzw(1.2f)));
    EXPECT_NEAR(angleOf(rotationAt(linear, 0.25f)), 0.3f, 1e-5);
    // The same rotation with the opposite sign must not take the long way round.
    std::vector<float> opposite = joined(xyzw(0), xyzw(1.2f));
    for (size_t i = 4; i < 8; ++i)
        opposite[i] = -opposite[i];
    const quat quarter = rotationAt(clipOf(Channel::Rotation, 4, Interpolation::Linear, {0, 1}, opposite), 0.25f);
    EXPECT_NEAR(std::abs(angleOf(quarter)), 0.3f, 1e-5);
}

TEST(Animation, CubicRotationsAreUnit)
{
    const std::vector<float> zero(4, 0.0f);
    std::vector<float> values = joined(joined(joined(zero, xyzw(0)), zero), joined(joined(zero, xyzw(2)), zero));
    const quat half = rotationAt(clipOf(Channel::Rotation, 4, Interpolation::Cubic, {0, 2}, values), 1);
    EXPECT_NEAR(glm::length(half), 1, 1e-6);
    EXPECT_NEAR(angleOf(half), 1, 1e-5);
}

TEST(Animation, MorphWeightsMoveTogether)
{
    LocalPose pose;
    pose.nodes.resize(1);
    pose.morphWeights = {9, 0, 0};
    Clip clip = clipOf(Channel::MorphWeights, 2, Interpolation::Linear, {0, 1}, {0, 1, 1, 0});
    clip.tracks[0].target = 1;
    sample(pose, clip, 0.25f);
    EXPECT_EQ(pose.morphWeights, (std::vector<float>{9, 0.25f, 0.75f}));
}

TEST(Animation, EqualAndSingleKeysStayFinite)
{
    const Clip equal = clipOf(Channel::Translation, 3, Interpolation::Linear, {1, 1, 1}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
    for (const float t : {0.0f, 1.0f, 2.0f})
        EXPECT_TRUE(std::isfinite(translationAt(equal, t).x));
    const Clip single = clipOf(Channel::Translation, 3, Interpolation::Cubic, {1}, {7, 7, 7, 1, 2, 3, 7, 7, 7});
    expectNear(translationAt(single, 1), {1, 2, 3});
}

TEST(Animation, BlendIsACrossFade)
{
    Model model = modelOfNodes(1);
    model.restMorphWeights = {0.5f};
    LocalPose from;
    setRest(from, model);
    LocalPose to = from;
    to.nodes[0] = {{4, 0, 0}, glm::angleAxis(1.0f, vec3{0, 0, 1}), vec3{3}};
    to.morphWeights = {1.5f};
    LocalPose pose = from;
    blend(pose, to, 0.25f);
    expectNear(pose.nodes[0].translation, {1, 0, 0});
    expectNear(pose.nodes[0].scale, vec3{1.5f});
    EXPECT_NEAR(angleOf(pose.nodes[0].rotation), 0.25f, 1e-5);
    EXPECT_FLOAT_EQ(pose.morphWeights[0], 0.75f);
    pose = from;
    blend(pose, to, 0);
    expectNear(pose.nodes[0].translation, from.nodes[0].translation);
    blend(pose, to, 1);
    expectNear(pose.nodes[0].translation, to.nodes[0].translation);
}

TEST(Animation, ResolveWalksDownTheTree)
{
    Model model = modelOfNodes(2);
    model.joints[1].inverseBind = glm::translate(mat4{1}, vec3{0, -1, 0});
    LocalPose pose;
    setRest(pose, model);
    pose.nodes[0].rotation = glm::angleAxis(kPi / 2, vec3{0, 0, 1});
    pose.nodes[1].translation = {0, 2, 0};
    pose.nodes[1].scale = vec3{2};
    std::vector<mat4> joints(2);
    std::vector<mat4> scratch;
    resolve(joints, scratch, pose, model);
    expectNear(vec3(joints[0] * vec4(1, 0, 0, 1)), {0, 1, 0});
    // (1, 1, 0) -> bind (1, 0, 0) -> scaled (2, 0, 0) -> moved (2, 2, 0) -> turned (-2, 2, 0)
    expectNear(vec3(joints[1] * vec4(1, 1, 0, 1)), {-2, 2, 0});
}

TEST(Animation, AnyFinitePoseResolvesToFiniteMatrices)
{
    const Model model = modelOfNodes(3);
    const float greatest = std::numeric_limits<float>::max();
    for (const NodePose& extreme :
         {NodePose{vec3{greatest}, {0, 0, 0, 0}, vec3{greatest}}, NodePose{vec3{0}, {greatest, greatest, -greatest, 1}, vec3{0}},
          NodePose{{}, {1e-38f, 0, 0, 0}, vec3{-1}}})
    {
        LocalPose pose;
        pose.nodes.assign(3, extreme);
        std::vector<mat4> joints(3);
        std::vector<mat4> scratch;
        resolve(joints, scratch, pose, model);
        for (const mat4& joint : joints)
            EXPECT_TRUE(isFinite(joint));
    }
}

TEST(Animation, MirroredSurfacesKeepFacingOutwards)
{
    Model model = rigidModel("plane", makePlane(), {});
    const std::vector<mat4> mirror{glm::scale(mat4{1}, vec3{-1, 2, 1})};
    for (const vec3& normal : posedMesh(model, mirror, {}).normals)
        expectNear(normal, {0, 1, 0});
    const std::vector<mat4> shear{glm::scale(glm::rotate(mat4{1}, 0.5f, vec3{0, 0, 1}), vec3{1, 0, 1})};
    for (const vec3& normal : posedMesh(model, shear, {}).normals)
        EXPECT_NEAR(glm::length(normal), 1, 1e-5);
}

TEST(Animation, SimpleSkinBendsAsComputedByHand)
{
    if (!std::filesystem::exists(asset("SimpleSkin.gltf")))
        GTEST_SKIP() << "no " << asset("SimpleSkin.gltf");
    const Model model = loadGltf(asset("SimpleSkin.gltf"));
    LocalPose pose;
    setRest(pose, model);
    sample(pose, model.clips.at(0), 1); // a quarter turn of the upper joint
    std::vector<mat4> joints(model.joints.size());
    std::vector<mat4> scratch;
    resolve(joints, scratch, pose, model);
    const Mesh posed = posedMesh(model, joints, pose.morphWeights);
    ASSERT_EQ(posed.positions.size(), model.mesh.positions.size());
    for (size_t i = 0; i < posed.positions.size(); ++i) {
        // Both joints move bind space by (-0.5, -1, 0) and back up by one; the upper one turns in between. Its share grows from
        // height 0 at the bottom to all at the top, in steps of a quarter a row of half a metre.
        const vec3 bind = model.mesh.positions[i];
        const float upper = std::clamp(bind.y * 0.5f, 0.0f, 1.0f);
        const vec3 still{bind.x - 0.5f, bind.y, 0};
        const vec3 turned{-(bind.y - 1), bind.x - 0.5f + 1, 0};
        expectNear(posed.positions[i], glm::mix(still, turned, upper), 1e-4f);
    }
}

TEST(Animation, SimpleMorphIsTheWeightedSum)
{
    const Path path = asset("SimpleMorph/SimpleMorph.gltf");
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << "no " << path;
    const Model model = loadGltf(path);
    ASSERT_EQ(model.mesh.morphTargets.size(), 2u);
    EXPECT_EQ(model.restMorphWeights, (std::vector<float>{0.5f, 0.5f}));
    const std::vector<mat4> still{mat4{1}};
    const std::vector<float> weights{0.25f, 2};
    const Mesh posed = posedMesh(model, still, weights);
    for (size_t i = 0; i < posed.positions.size(); ++i) {
        const vec3 expected =
            model.mesh.positions[i] + 0.25f * model.mesh.morphTargets[0].positions[i] + 2.0f * model.mesh.morphTargets[1].positions[i];
        expectNear(posed.positions[i], expected);
    }
}

TEST(Animation, EveryClipOfTheCharactersStaysFinite)
{
    constexpr const char* kCharacters[] = {"CesiumMan.glb", "Fox.glb", "RiggedFigure.glb", "QuaterniusBunny.gltf", "raylib_robot.glb"};
    if (!std::filesystem::exists(asset(kCharacters[0])))
        GTEST_SKIP() << "no " << asset(kCharacters[0]);
    for (const char* name : kCharacters) {
        const Model model = loadGltf(asset(name));
        EXPECT_FALSE(model.clips.empty()) << name;
        std::vector<mat4> joints(model.joints.size());
        std::vector<mat4> scratch;
        LocalPose pose;
        for (const Clip& clip : model.clips) {
            EXPECT_GT(clip.duration, 0) << name << " " << clip.name;
            bool moves = false;
            setRest(pose, model);
            sample(pose, clip, 0);
            const LocalPose start = pose;
            for (int frame = 0; frame <= 30; ++frame) {
                sample(pose, clip, clip.duration * static_cast<float>(frame) / 30);
                resolve(joints, scratch, pose, model);
                for (const mat4& joint : joints)
                    ASSERT_TRUE(isFinite(joint)) << name << " " << clip.name << " frame " << frame;
                for (size_t i = 0; i < pose.nodes.size(); ++i)
                    moves |= pose.nodes[i].rotation != start.nodes[i].rotation;
            }
            EXPECT_TRUE(moves) << name << " " << clip.name;
        }
    }
}
