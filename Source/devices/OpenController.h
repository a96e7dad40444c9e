#pragma once

// Interface of a connection to a controller, open for writing reports.

#include "devices/ControllerReports.h"
#include "devices/HidList.h"
#include "devices/ReportSink.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pacini::devices
{

/// On Linux a HidrawController, elsewhere a HidapiController; on Linux also that one when this is compiled with
/// PACINI_AS_OTHER_SYSTEMS, by which it is tested.
class OpenController : public ReportSink
{
public:
    /// Opens `path` of connectedControllers(). Errors: `io`: no right (the message tells what to do), in use, gone, or
    /// not possible in this build. [worker]
    [[nodiscard]] static Result<std::unique_ptr<OpenController>> open(const std::string& path);

    /// Asks for a feature report: its bytes, at most `bytes` of them, the number first, 0 where reports have none.
    /// Errors: `io`. [worker]
    [[nodiscard]] virtual Result<std::vector<std::byte>> feature(std::uint8_t report, std::size_t bytes) = 0;
};

/// What a controller that is open understands; one that plays waveforms is asked for them, a DualSense for its
/// firmware, and on Bluetooth sent a silent block of samples: one whose link refuses it gets levels. Errors: those of
/// chosenWaveforms(). [worker]
[[nodiscard]] Result<ControllerModel> modelOf(const Controller& controller, OpenController& open);

} // namespace pacini::devices
