// What is looked up on the two sides of a seam.
#include "bake/seams.h"
#include "unit/quad_scene.h"

#include <gtest/gtest.h>

#include <random>

namespace antumbra::bake {
namespace {

constexpr uint32_t kSide = 6; // texels

/// Two squares of a metre side by side, the second one turned up by `radians` about the edge they share.
StaticScene hinge(float radians)
{
    QuadScene scene(kSide);
    scene.addQuad({-1, 0, 0}, {0, 0, 1}, {1, 0, 0});
    scene.addQuad({0, 0, 0}, {0, 0, 1}, {std::cos(radians), std::sin(radians), 0});
    return scene.finished();
}

class Seams : public testing::Test
{
protected:
    Seams()
    {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> value(0.5f, 1.5f);
        transfers_.isValid.assign(map_.texelCount(), 1);
        for (vec3& transfer : transfers_.values)
            transfer = {value(random), value(random), value(random)};
        sources_ = dilated(map_, transfers_.isValid, 2);
        for (const uint32_t source : sources_)
            page_.push_back(source != kNoTexel ? transfers_.values[size_t{source} * transfers_.coefficientCount].x : 0);
    }

    /// Of the first coefficient's first channel, bilinear.
    static float lookedUp(const std::vector<float>& page, uvec2 extent, vec2 bakeUv)
    {
        const vec2 place = bakeUv * vec2(extent) - 0.5f, corner = glm::floor(place), part = place - corner;
        const auto at = [&](int x, int y) {
            return page[static_cast<size_t>(corner.y + static_cast<float>(y)) * extent.x +
                        static_cast<size_t>(corner.x + static_cast<float>(x))];
        };
        return glm::mix(glm::mix(at(0, 0), at(1, 0), part.x), glm::mix(at(0, 1), at(1, 1), part.x), part.y);
    }

    [[nodiscard]] std::vector<float> stitchedPage() const
    {
        std::vector<float> page = page_;
        const auto [places, values] = stitched(seamPoints(scene_), map_, sources_, transfers_);
        for (size_t i = 0; i < places.size(); ++i)
            page[places[i]] = values[i * 3 * transfers_.coefficientCount];
        return page;
    }

    [[nodiscard]] float greatestStep(const std::vector<float>& page) const
    {
        float greatest = 0;
        for (const auto& [a, b] : seamPoints(scene_))
            greatest = std::max(greatest, std::abs(lookedUp(page, map_.extent, a) - lookedUp(page, map_.extent, b)));
        return greatest;
    }

    StaticScene scene_ = hinge(0);
    TexelMap map_ = mapTexels(scene_, 4);
    Transfers transfers_ = noTransfers(map_, {.bands = 2});
    std::vector<uint32_t> sources_;
    std::vector<float> page_; // of the first coefficient's first channel
};

TEST_F(Seams, AreFoundWhereTheSurfaceGoesOnSmoothly)
{
    const std::vector<SeamPoint> points = seamPoints(scene_);
    EXPECT_GE(points.size(), 2 * kSide);
    for (const auto& [a, b] : points)
        EXPECT_GE(glm::length((a - b) * vec2(map_.extent)), 1.9f) << "they lie apart on the page";
    EXPECT_TRUE(seamPoints(hinge(0.5f)).empty()) << "light does not go on over an edge";
    EXPECT_FALSE(seamPoints(hinge(0.02f)).empty());
}

TEST_F(Seams, BothSidesAgreeAfterwards)
{
    EXPECT_GT(greatestStep(page_), 0.3f);
    EXPECT_LT(greatestStep(stitchedPage()), 0.02f);
}

TEST_F(Seams, WhatNoSeamReadsStaysAndTheRestStaysNear)
{
    const std::vector<float> page = stitchedPage();
    size_t moved = 0;
    for (size_t i = 0; i < page.size(); ++i) {
        moved += page[i] != page_[i];
        EXPECT_LT(std::abs(page[i] - page_[i]), 1.0f);
    }
    EXPECT_GT(moved, 0u);
    EXPECT_LE(moved, 2 * 2 * (kSide + 2)) << "two columns of texels on each side";
}

TEST_F(Seams, WhatAgreesAlreadyStays)
{
    std::ranges::fill(transfers_.values, vec3(2));
    std::ranges::fill(page_, 2.0f);
    for (const float value : stitchedPage())
        EXPECT_EQ(value, 2.0f);
}

} // namespace
} // namespace antumbra::bake
