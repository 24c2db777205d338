// The plan for people and for other programs: a picture in Graphviz's DOT, and JSON. Both show the passes that do not run, and why.
#pragma once

#include "graph/plan.h"

#include <string>

namespace antumbra::graph {

/// Passes are boxes, each version of a resource an ellipse (doubled where it outlives the frame); what does not run is dashed and grey.
std::string toDot(const FrameGraph& graph, const Plan& plan);

/// {"passes": [{"name", "culled", "reason" | "reads", "writes"}], "resources": [{"label", "kind", "format", "extent", "origin", "bytes",
/// "first", "last", "memory"}], "memory": [{"kind", "bytes"}], "barriers": [{"before", "resource", "from", "to", "discard"}]}. Steps
/// count from 0; what a resource does not have reads null.
std::string toJson(const FrameGraph& graph, const Plan& plan);

} // namespace antumbra::graph
