#include "game/locomotion.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace antumbra::game {

namespace {

using scene::kNoIndex;

// At scale 1, in metres, seconds and radians; the speeds are those of the walker's clips, so that its feet do not slide.
constexpr float kWalkSpeed = 1.4f;
constexpr float kRunSpeed = 3.3f;
constexpr float kStandingSpeed = 0.2f; // below it, a character stands
constexpr float kAcceleration = 6;
constexpr float kBraking = 9;
constexpr float kTurnRate = 7;
constexpr float kTurnRateOnSpot = 5;
constexpr float kTurnsOnSpotFrom = 1.2f;
constexpr float kTurnsOnSpotUntil = 0.15f;
constexpr float kFadeSeconds = 0.2f;
constexpr float kPersonHeight = 1.75f;

uint32_t findClip(const scene::Model& model, std::string_view name)
{
    const auto sameLetter = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    const auto found =
        std::ranges::find_if(model.clips, [&](const scene::Clip& clip) { return std::ranges::equal(clip.name, name, sameLetter); });
    return found != model.clips.end() ? static_cast<uint32_t>(found - model.clips.begin()) : kNoIndex;
}

float approach(float value, float target, float greatestChange)
{
    return value + std::clamp(target - value, -greatestChange, greatestChange);
}

void steer(Character& character, const Intent& intent, float seconds)
{
    const float wish = glm::length(intent.walk);
    const bool walks = wish > 0.05f;
    const float wanted = walks ? facingOf(intent.walk) : intent.facing.value_or(character.facing);
    const bool stands = character.speed < kStandingSpeed * character.scale;
    const float away = std::abs(angleBetween(character.facing, wanted));
    character.isTurning = stands && away > (character.isTurning ? kTurnsOnSpotUntil : walks ? kTurnsOnSpotFrom : kTurnsOnSpotUntil);

    const float rate = stands ? kTurnRateOnSpot : kTurnRate;
    const float turned = character.facing + std::clamp(angleBetween(character.facing, wanted), -rate * seconds, rate * seconds);
    character.facing = std::remainder(turned, 2 * kPi);

    // Who must turn sharply slows down for it.
    const float ahead = std::max(0.0f, std::cos(angleBetween(character.facing, wanted)));
    const float fullSpeed = (intent.isRunning ? kRunSpeed : kWalkSpeed) * character.scale;
    const float targetSpeed = walks && !character.isTurning ? std::min(wish, 1.0f) * ahead * fullSpeed : 0;
    const float change = (targetSpeed > character.speed ? kAcceleration : kBraking) * character.scale * seconds;
    character.speed = approach(character.speed, targetSpeed, change);
}

void advance(Character& character, scene::Transform& transform, const Ground& ground, float seconds)
{
    const vec2 before{transform.position.x, transform.position.z};
    const vec2 way = character.speed * seconds * vec2(std::sin(character.facing), std::cos(character.facing));
    const vec2 after = glm::clamp(before + way, glm::min(ground.lowest, before), glm::max(ground.highest, before));
    transform.position.x = after.x;
    transform.position.z = after.y;
    transform.rotation = glm::angleAxis(character.facing, vec3(0, 1, 0)) * character.upright;
    // The edge of the ground takes away the speed that it does not let through.
    if (after != before + way)
        character.speed = glm::length(after - before) / seconds;
}

struct Playing
{
    uint32_t clip = kNoIndex;
    float speed = 1;
};

Playing chooseClip(const Character& character)
{
    const Gaits& gaits = character.gaits;
    const float speed = character.speed / character.scale;
    if (speed > (kWalkSpeed + kRunSpeed) / 2 && gaits.run != kNoIndex)
        return {gaits.run, speed / kRunSpeed};
    if (speed > kStandingSpeed && gaits.walk != kNoIndex)
        return {gaits.walk, std::max(speed / kWalkSpeed, 0.5f)};
    if (character.isTurning && gaits.turn != kNoIndex)
        return {gaits.turn, 1};
    return {character.waveSecondsLeft > 0 ? gaits.wave : gaits.idle, 1};
}

void wave(Character& character, const Intent& intent, float seconds)
{
    const bool stands = character.speed < kStandingSpeed * character.scale && !character.isTurning;
    if (!stands || character.gaits.wave == kNoIndex)
        character.waveSecondsLeft = 0;
    else if (intent.waves && character.waveSecondsLeft <= 0)
        character.waveSecondsLeft = character.gaits.waveSeconds - kFadeSeconds;
    else
        character.waveSecondsLeft -= seconds;
}

} // namespace

float facingOf(vec2 directionXZ) { return std::atan2(directionXZ.x, directionXZ.y); }

float angleBetween(float from, float to) { return std::remainder(to - from, 2 * kPi); }

Gaits gaitsOf(const scene::Model& model)
{
    Gaits gaits{.idle = findClip(model, "idle"),
                .walk = findClip(model, "walk"),
                .run = findClip(model, "run"),
                .wave = findClip(model, "wave"),
                .turn = findClip(model, "turn")};
    // Who has no clip for standing plays the first.
    if (gaits.idle == kNoIndex && !model.clips.empty())
        gaits.idle = 0;
    if (gaits.wave != kNoIndex)
        gaits.waveSeconds = model.clips[gaits.wave].duration;
    return gaits;
}

Character makeCharacter(const scene::Model& model, const scene::Transform& transform)
{
    Character character{.gaits = gaitsOf(model)};
    const float height = model.mesh.bounds().extent().y * transform.scale.y;
    character.scale = std::max(height / kPersonHeight, 1e-3f);
    const vec3 ahead = transform.rotation * vec3(0, 0, 1);
    character.facing = facingOf({ahead.x, ahead.z});
    character.upright = glm::angleAxis(-character.facing, vec3(0, 1, 0)) * transform.rotation;
    return character;
}

void moveCharacters(ecs::Each<Character, scene::Transform, const Intent, ecs::Maybe<scene::Animator>> characters, const Ground& ground,
                    ecs::Seconds step)
{
    if (step.value <= 0)
        return;
    for (auto [character, transform, intent, animator] : characters) {
        steer(character, intent, step.value);
        advance(character, transform, ground, step.value);
        wave(character, intent, step.value);
        if (animator == nullptr)
            continue;
        const Playing playing = chooseClip(character);
        scene::play(*animator, playing.clip, kFadeSeconds);
        animator->speed = playing.speed;
    }
}

} // namespace antumbra::game
