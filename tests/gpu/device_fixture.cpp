#include "gpu/device_fixture.h"

#include "base/error.h"

#include <cstdlib>

namespace antumbra {

namespace {

// Owned by GoogleTest, which ends it before the program's statics go.
DeviceEnvironment* const kEnvironment = new DeviceEnvironment;
[[maybe_unused]] const testing::Environment* const kRegistered = testing::AddGlobalTestEnvironment(kEnvironment);

} // namespace

void DeviceEnvironment::SetUp()
{
    try {
        device_ = std::make_unique<gpu::Device>(gpu::DeviceOptions{.validation = true});
    } catch (const Error& error) {
        whyNot_ = error.what();
    }
}

void DeviceTest::SetUp()
{
    if (kEnvironment->device() != nullptr) {
        messagesBefore_ = device().validationMessages().size();
        return;
    }
    if (std::getenv("ANTUMBRA_REQUIRE_DEVICE") != nullptr)
        FAIL() << "a device is required: " << kEnvironment->whyNot();
    GTEST_SKIP() << kEnvironment->whyNot();
}

void DeviceTest::TearDown()
{
    if (kEnvironment->device() == nullptr)
        return;
    const std::vector<std::string>& messages = device().validationMessages();
    for (size_t i = messagesBefore_; i < messages.size(); ++i)
        ADD_FAILURE() << messages[i];
}

gpu::Device& DeviceTest::device() { return *kEnvironment->device(); }

} // namespace antumbra
