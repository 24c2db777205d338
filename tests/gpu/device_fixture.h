// One device with the validation layer for all tests of the program; a message of the layer fails the test that caused it.
// Without a device tests are skipped, with the reason; where the environment has ANTUMBRA_REQUIRE_DEVICE they fail.
#pragma once

#include "gpu/device.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace antumbra {

class DeviceEnvironment : public testing::Environment
{
public:
    void SetUp() override;
    void TearDown() override { device_.reset(); }

    [[nodiscard]] gpu::Device* device() { return device_.get(); }
    [[nodiscard]] const std::string& whyNot() const { return whyNot_; }

private:
    std::unique_ptr<gpu::Device> device_;
    std::string whyNot_;
};

class DeviceTest : public testing::Test
{
protected:
    void SetUp() override;
    void TearDown() override;

    [[nodiscard]] gpu::Device& device();

private:
    size_t messagesBefore_ = 0;
};

} // namespace antumbra
