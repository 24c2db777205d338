// The method of methods/area-shadows.md on the host: recursive, of any size, in float or in double. It shares no text with shaders/lib,
// nor the links of edges that bodies carry, and it takes a light body face by face, where the device takes its outline.
// As the method says, a body that holds the point hides all.
#pragma once

#include "app/area_problem.h"

namespace antumbra {

struct AreaShares
{
    double unoccluded = 0;
    double visible = 0;
};

template <class Real>
AreaShares areaTwin(const app::AreaProblem& problem);

extern template AreaShares areaTwin<float>(const app::AreaProblem&);
extern template AreaShares areaTwin<double>(const app::AreaProblem&);

} // namespace antumbra
