#pragma once

// Exposure of hand and arm to vibration (ISO 5349-1:2001).

#include <span>

namespace pacini::study
{

/// A(8), m/s2: the constant acceleration that would bring about in eight hours what `dose` (m2/s4 s: weighted
/// acceleration, squared, over time) did.
[[nodiscard]] double dailyExposure(double dose) noexcept;

/// The dose of an acceleration in m/s2 at a sample rate in Hz, weighted by Wh (annex A); m2/s4 s. One axis: a
/// wristband's actuator has one.
[[nodiscard]] double doseOf(std::span<const float> acceleration, double sampleRate);

} // namespace pacini::study
