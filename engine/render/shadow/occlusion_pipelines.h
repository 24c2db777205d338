// The pipelines that trace light of the environment, each made when first asked for.
#pragma once

#include "render/fields.h"
#include "render/knobs.h"

#include <deque>

namespace antumbra::render {

class OcclusionPipelines
{
public:
    explicit OcclusionPipelines(gpu::Device& device) : device_(&device) {}

    struct Variant
    {
        RayBackend backend;
        Culling culling;
        bool isReference;
        bool isLocal; // light that comes in by the irradiance volume

        friend bool operator==(const Variant&, const Variant&) = default;
    };
    /// Where there are fields, of their structure. Stays for this frame as others are made.
    const gpu::Pipeline& of(const Variant& variant, const FieldFrame& fields);

private:
    struct Made
    {
        Variant variant;
        gpu::Pipeline pipeline;
    };

    gpu::Device* device_;
    std::deque<Made> made_; // without fields
};

} // namespace antumbra::render
