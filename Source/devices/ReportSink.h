#pragma once

// Interface for receivers of output reports: a controller, or the list of a dry run.

#include "devices/Report.h"

#include <pacini/foundation/Result.h>

#include <array>

namespace pacini::devices
{

/// Reports that silence a controller: one, or two if it needs two.
struct StopReport
{
    Report report;
    Report also; ///< without content: none
};

/// One for each value of the four-bit counters in reports.
using StopReports = std::array<StopReport, 16>;

class ReportSink
{
public:
    virtual ~ReportSink() = default;

    /// Called before the first report: should the program crash after n reports, `stops[n % 16]` silences the
    /// controller. [worker]
    virtual void prepare(const StopReports& stops) = 0;

    /// Errors: `io`, with a message for people. [worker]
    [[nodiscard]] virtual Result<void> send(const Report& report) = 0;
};

} // namespace pacini::devices
