#pragma once

// Interface of sources of packets for a controller.

#include "devices/ControllerReports.h"

#include <cstdint>
#include <optional>

namespace pacini::devices
{

class RumbleSource
{
public:
    virtual ~RumbleSource() = default;

    /// What a packet plays, nothing after the end; packets only go forward, some may be left out. [worker]
    [[nodiscard]] virtual std::optional<RumbleState> at(std::int64_t packet) = 0;
};

} // namespace pacini::devices
