#pragma once

// Enumeration of haptic devices by hidapi, on macOS and Windows.

#include "devices/HidList.h"

namespace pacini::devices
{

/// See connectedControllers(). Outside of Linux a device has to be opened to be looked into, which is done only with
/// those that are haptic as a whole, and needs hidapi 0.14. Errors: `io` in a build without hidapi. [worker]
[[nodiscard]] Result<std::vector<Controller>> controllersByHidapi();

} // namespace pacini::devices
