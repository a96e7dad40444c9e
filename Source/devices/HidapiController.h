#pragma once

// Connection to a controller through hidapi, on macOS and Windows.

#include "devices/OpenController.h"

#include <pacini/foundation/Result.h>

#include <memory>
#include <string>

namespace pacini::devices
{

/// For macOS and Windows. What Linux does besides is not possible here: hidapi hides what a signal handler would need
/// to silence a controller while the program crashes, and other programs are kept away only on macOS, where the system
/// gives a device to one program at a time. Errors: `io`, with the system's own words; in a build without hidapi,
/// always. [worker]
[[nodiscard]] Result<std::unique_ptr<OpenController>> openByHidapi(const std::string& path);

} // namespace pacini::devices
