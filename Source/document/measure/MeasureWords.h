#pragma once

// Messages for errors and warnings of a measurement, in plain words and with remedies.

#include <pacini/foundation/Result.h>
#include <pacini/linearize/SweepMeasurement.h>

#include <span>
#include <string>

namespace pacini
{

/// An error of analyseSweeps() as a sentence or two. `inputs` are the names of the channels recorded.
[[nodiscard]] std::string explain(const Error& error, std::span<const std::string> inputs);

/// A warning likewise.
[[nodiscard]] std::string explain(const MeasurementWarning& warning, std::span<const std::string> inputs);

} // namespace pacini
