#pragma once

// Access to the report descriptor of a listed device. Only for files that are built with hidapi.

#include <hidapi.h>

#include <cstddef>
#include <vector>

namespace pacini::devices
{

/// The report descriptor, nothing when it is not to be had. Linux shows it to everybody. Elsewhere the device has to be
/// opened for it, which is done only with those that are haptic as a whole, and needs hidapi 0.14. [worker]
[[nodiscard]] std::vector<std::byte> hidDescriptor(const hid_device_info& info);

} // namespace pacini::devices
