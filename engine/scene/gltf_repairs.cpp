#include "scene/gltf_repairs.h"

#include <fmt/core.h>

#include <algorithm>

namespace antumbra::scene {

void Repairs::note(std::string_view place, std::string_view remedy)
{
    const auto known = std::ranges::find(repairs_, remedy, &Repair::remedy);
    if (known == repairs_.end())
        repairs_.push_back({std::string(place), std::string(remedy)});
    else
        ++known->morePlaces;
}

std::vector<std::string> Repairs::lines() const
{
    std::vector<std::string> lines;
    for (const Repair& repair : repairs_) {
        const std::string more = repair.morePlaces > 0 ? fmt::format(" and {} more", repair.morePlaces) : "";
        lines.push_back(fmt::format("{}{}: {}", repair.place, more, repair.remedy));
    }
    return lines;
}

} // namespace antumbra::scene
