#pragma once

// Connection to a controller through hidraw, on Linux.

#include "devices/OpenController.h"

#include <pacini/foundation/Result.h>

#include <memory>
#include <string>

namespace pacini::devices
{

/// Opens a hidraw node and locks it against other programs that play by Pacini; others are not kept away. It is written
/// to itself instead of through hidapi, which adds nothing there and hides what is needed: the number of the open file,
/// for the last packet of a crash and for the lock, and the reason when something fails. Sending returns within
/// seconds, the time that Linux gives a controller to answer. Errors: `io`; other systems have no such nodes. [worker]
[[nodiscard]] Result<std::unique_ptr<OpenController>> openHidraw(const std::string& path);

/// Why a controller cannot be opened or written to, by the value of errno. [any]
[[nodiscard]] Error controllerError(int errnoValue);

} // namespace pacini::devices
