#pragma once

// Enumeration of haptic devices among the hidraw nodes, on Linux.

#include "devices/HidList.h"

namespace pacini::devices
{

/// See connectedControllers(). The system tells everybody of all nodes, and what their reports hold. Of the four nodes
/// of a receiver, only those are kept whose controllers send, as far as any does that may be read. [worker]
[[nodiscard]] Result<std::vector<Controller>> hidrawControllers();

/// The paths among `nodes` that have something to read within 40 ms; all of them when none has. [worker]
[[nodiscard]] std::vector<std::string> sendingNodes(const std::vector<std::string>& nodes);

} // namespace pacini::devices
