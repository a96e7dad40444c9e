#pragma once

// Static compression curve: maps the amplitudes of a clip to the range of an actuator above the touch
// threshold.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

/// Parameters of the compression curve. Levels are clamped to 1 to 200 dB, the peak to 1e-6 to 1e6.
struct DynamicRangeParams
{
    Decibels actuatorRange{60.0}; ///< between full drive and the weakest drive that is felt
    Decibels clipRange{60.0};     ///< between the clip's peak and its floor, below which nothing needs to be felt
    double clipPeak = 1.0;        ///< the clip's largest amplitude, 1 = full drive
    bool operator==(const DynamicRangeParams&) const = default;
};

/// Compression curve. Maps amplitudes, 1 = full drive. If the clip's floor is felt anyway the map is the identity.
/// Otherwise
///
/// - from floor to peak it is a straight line in dB that raises the floor to the threshold and keeps the peak,
/// - above the peak it is the identity (of a clip that is below the threshold as a whole: the threshold, until that is
///   exceeded),
/// - below the floor it falls smoothly to 0, which it reaches 6 dB under the floor.
///
/// Continuous, never falling, 0 for 0, negative amplitudes and NaN. Real-time safe; costs one power.
class DynamicRangeMap
{
public:
    DynamicRangeMap() = default;

    explicit DynamicRangeMap(const DynamicRangeParams& params) noexcept
    {
        const double peakLevel = Decibels::fromGain(clampTo(params.clipPeak, 1e-6, 1e6)).value;
        const double thresholdLevel = -clampTo(params.actuatorRange.value, 1.0, 200.0);
        const double range = clampTo(params.clipRange.value, 1.0, 200.0);
        unchanged = peakLevel - range >= thresholdLevel;
        peak = portable::exp10(peakLevel / 20.0);
        floor = portable::exp10((peakLevel - range) / 20.0);
        threshold = portable::exp10(thresholdLevel / 20.0);
        slope = std::max(0.0, peakLevel - thresholdLevel) / range;
    }

    /// Whether every amplitude stays as it is.
    [[nodiscard]] bool isIdentity() const noexcept { return unchanged; }

    [[nodiscard]] double operator()(double amplitude) const noexcept
    {
        if (!(amplitude > 0.0))
            return 0.0;
        if (unchanged)
            return amplitude;
        if (amplitude >= peak)
            return std::max(amplitude, threshold);
        if (amplitude >= floor)
            return threshold * portable::pow(amplitude / floor, slope);
        const double part = std::max(0.0, 2.0 * amplitude / floor - 1.0);
        return threshold * part * part * (3.0 - 2.0 * part);
    }

private:
    bool unchanged = true;
    double peak = 1.0;
    double floor = 0.0;
    double threshold = 0.0;
    double slope = 1.0;
};

} // namespace pacini
