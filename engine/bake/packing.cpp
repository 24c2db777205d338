// Skylines (stb_rect_pack) of several widths; the page that wastes least is kept.
#include "bake/packing.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#define STBRP_SORT(...) // rectangles come sorted: qsort may order equals as it likes, and a page must not depend on that
#include <stb/stb_rect_pack.h>
#pragma GCC diagnostic pop

namespace antumbra::bake {

namespace {

constexpr uint32_t kSideUnit = 4;
constexpr uint32_t kWidthSteps = 8;

uint32_t roundedDown(uint32_t side) { return side / kSideUnit * kSideUnit; }
uint32_t roundedUp(uint32_t side) { return (side + kSideUnit - 1) / kSideUnit * kSideUnit; }

double areaOf(std::span<const uvec2> rectangles)
{
    double area = 0;
    for (const uvec2 rectangle : rectangles)
        area += double{1} * rectangle.x * rectangle.y;
    return area;
}

/// The tallest first, as skylines like them; `id` tells which it was.
std::vector<stbrp_rect> sortedByHeight(std::span<const uvec2> rectangles)
{
    std::vector<stbrp_rect> sorted(rectangles.size());
    for (size_t i = 0; i < rectangles.size(); ++i)
        sorted[i] = {static_cast<int>(i), static_cast<int>(rectangles[i].x), static_cast<int>(rectangles[i].y), 0, 0, 0};
    std::ranges::sort(sorted, [](const stbrp_rect& a, const stbrp_rect& b) {
        return a.h != b.h ? a.h > b.h : a.w != b.w ? a.w > b.w : a.id < b.id;
    });
    return sorted;
}

/// The height taken on a page of that width; nothing where `mostHeight` does not do.
std::optional<uint32_t> place(std::vector<stbrp_rect>& sorted, uint32_t width, uint32_t mostHeight)
{
    std::vector<stbrp_node> nodes(width);
    stbrp_context context;
    stbrp_init_target(&context, static_cast<int>(width), static_cast<int>(mostHeight), nodes.data(), static_cast<int>(nodes.size()));
    stbrp_setup_heuristic(&context, STBRP_HEURISTIC_Skyline_BF_sortHeight);
    if (!stbrp_pack_rects(&context, sorted.data(), static_cast<int>(sorted.size())))
        return std::nullopt;
    int height = 0;
    for (const stbrp_rect& rectangle : sorted)
        height = std::max(height, rectangle.y + rectangle.h);
    return static_cast<uint32_t>(height);
}

/// From a square without waste to two to one, and at last the widest there is.
std::vector<uint32_t> widthsFor(std::span<const uvec2> rectangles, uint32_t mostSide)
{
    const double area = areaOf(rectangles);
    std::vector<uint32_t> widths;
    for (uint32_t i = 0; i <= kWidthSteps; ++i) {
        const double width = std::sqrt(area * (1 + double{1} * i / kWidthSteps));
        widths.push_back(roundedUp(static_cast<uint32_t>(std::clamp<double>(width, 1, mostSide))));
    }
    widths.push_back(mostSide);
    return widths;
}

} // namespace

std::optional<Packing> pack(std::span<const uvec2> rectangles, uint32_t mostTexels)
{
    check(mostTexels >= kSideUnit, "a page of at least 4 texels a side");
    const uint32_t mostSide = roundedDown(mostTexels);
    std::vector<stbrp_rect> sorted = sortedByHeight(rectangles);
    std::optional<Packing> best;
    for (const uint32_t width : widthsFor(rectangles, mostSide)) {
        if (best && width == mostSide)
            break;
        const std::optional<uint32_t> height = place(sorted, width, mostSide);
        if (!height)
            continue;
        const uvec2 page(width, roundedUp(std::max(*height, 1u)));
        if (best && uint64_t{page.x} * page.y >= uint64_t{best->page.x} * best->page.y)
            continue;
        best = Packing{page, std::vector<uvec2>(rectangles.size())};
        for (const stbrp_rect& rectangle : sorted)
            best->corners[static_cast<size_t>(rectangle.id)] = {rectangle.x, rectangle.y};
    }
    return best;
}

bool fits(std::span<const uvec2> rectangles, uint32_t mostTexels)
{
    const uint32_t mostSide = roundedDown(mostTexels);
    if (areaOf(rectangles) > double{1} * mostSide * mostSide)
        return false;
    std::vector<stbrp_rect> sorted = sortedByHeight(rectangles);
    return place(sorted, mostSide, mostSide).has_value();
}

} // namespace antumbra::bake
