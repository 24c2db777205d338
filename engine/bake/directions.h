// Where rays go: even patterns of directions, packed so that neighbours are traced together, and rotations that depend on a key alone.
#pragma once

#include "bake/lanes.h"
#include "base/math.h"

#include <vector>

namespace antumbra::bake {

struct DirectionPacket
{
    Lanes x, y, z;
};

/// `packets` * kLanes unit vectors about +Z, as dense as the cosine: a sunflower on the disc below them.
std::vector<DirectionPacket> cosineDirections(uint32_t packets);

/// `packets` * kLanes unit vectors, even over the sphere: spherical Fibonacci points.
std::vector<DirectionPacket> sphereDirections(uint32_t packets);

/// To the frame whose axes are the columns.
void rotate(const mat3& frame, const DirectionPacket& local, DirectionPacket& result);

/// Bits that have nothing to do with those of any other key (splitmix64).
uint64_t scrambled(uint64_t key);

/// 0 <= x < 1, of the highest bits.
float unitFloat(uint64_t bits);

/// Columns tangent, bitangent, `normal` (unit), turned about it.
mat3 frameAbout(vec3 normal, float radians);

/// One of all rotations, evenly.
mat3 rotationOf(uint64_t key);

} // namespace antumbra::bake
