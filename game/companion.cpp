#include "game/companion.h"

#include <cmath>

namespace antumbra::game {

namespace {

constexpr float kLooksFrom = 0.7f; // radians beside where it faces
constexpr float kLooksUntil = 0.1f;
constexpr float kLeastPause = 4; // seconds between two waves
constexpr float kGreatestPause = 9;

} // namespace

void accompany(ecs::Each<Companion, Intent, const Character, const scene::Transform> companions,
               ecs::Each<const scene::Transform, ecs::With<Player>> players, app::Random& random, ecs::Seconds step)
{
    for (auto [companion, intent, character, transform] : companions) {
        intent = {};
        for (auto [player] : players) {
            const vec3 way = player.position - transform.position;
            const float wanted = facingOf({way.x, way.z});
            const float away = std::abs(angleBetween(character.facing, wanted));
            companion.isTurning = away > (companion.isTurning ? kLooksUntil : kLooksFrom);
            if (companion.isTurning)
                intent.facing = wanted;
        }
        companion.secondsToWave -= step.value;
        if (companion.secondsToWave <= 0) {
            intent.waves = true;
            companion.secondsToWave = random.between(kLeastPause, kGreatestPause);
        }
    }
}

} // namespace antumbra::game
