#pragma once

// Results of the steps of a measurement, and the functions that compute them. Each of these takes up to some seconds
// and touches nothing shared.

#include "document/measure/MeasureSettings.h"

#include <pacini/actuator/Profile.h>
#include <pacini/linearize/EqualizerCost.h>
#include <pacini/linearize/EqualizerFitParams.h>
#include <pacini/linearize/MeasurementFindings.h>
#include <pacini/linearize/PlacementAverage.h>
#include <pacini/linearize/SweepMeasurement.h>
#include <pacini/linearize/Verification.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// Recording of a sweep.
struct RecordedSweep
{
    std::vector<std::vector<float>> channels;
    std::vector<std::string> inputs; ///< their names
    double sampleRate = 48000.0;     ///< Hz of the recording
    SweepParams sweep;               ///< as it was played
    bool oneClock = false;           ///< one device has played and recorded
    double gain = 0.0;               ///< dB by which it was played louder than `sweep` says
    bool equalized = false;          ///< it went through the equaliser
};

/// One recording of the actuator: on one wearer, attached once.
struct Placement
{
    std::string name;
    SweepMeasurement measurement;
    double level = 0.0;             ///< dB re full scale, of the sweep
    std::vector<std::string> notes; ///< in plain words
    bool spoiled = false;           ///< samples were cut off or lost: it is to be swept again
};

using Placements = std::vector<std::shared_ptr<const Placement>>;

/// Analyses a recording. The error is in plain words, without a place. Errors beside those of analyseSweeps():
/// invalidData when no channel shows the movement of anything.
[[nodiscard]] Result<Placement> analysePlacement(const std::string& name, const RecordedSweep& recorded,
                                                 const MeasureSettings& settings);

struct MeasuredResponse
{
    PlacementAverage average;
    MeasurementFindings findings;
    std::vector<std::string> notes; ///< outliers, and what was noted of the placements
};

[[nodiscard]] Result<MeasuredResponse> summarisePlacements(const Placements& placements);

/// Requirements of an equaliser.
struct EqualizerRequest
{
    std::optional<int> sections; ///< 1 to 8; none: as few as do
    double maxBoost = 12.0;      ///< dB, 0 to 24
    double lowFrequency = 0.0;   ///< Hz; 0: that of the range that is felt
    double highFrequency = 0.0;  ///< Hz, likewise
    bool operator==(const EqualizerRequest&) const = default;
};

struct FittedEqualizer
{
    EqualizerFit fit;
    double lowFrequency = 0.0;   ///< Hz, the range that it flattens
    double highFrequency = 0.0;  ///< Hz
    FrequencyResponse predicted; ///< dB, the response through it
    Linearity predictedLinearity;
    EqualizerCost cost;
};

/// `base`: where the limits of the drive are known from; `rate`: at which the equaliser will run, Hz.
[[nodiscard]] Result<FittedEqualizer> fitFor(const MeasuredResponse& response, const EqualizerRequest& request,
                                             const Profile& base, double rate);

struct VerifiedResponse
{
    FrequencyResponse after;
    Linearity linearity;
    Linearity before;               ///< the same judgement without the equaliser
    std::vector<std::string> notes; ///< in plain words
};

/// `swept` through the equaliser. Deviations beyond `tolerance`, dB, do not pass.
[[nodiscard]] Result<VerifiedResponse> verifyResponse(const Placements& swept, const MeasuredResponse& response,
                                                      const FittedEqualizer& equalizer, double tolerance);

/// The sweep through an equaliser, at the level asked for or as much below it as the equaliser raises it over full
/// scale. `raised`: the sweep is scaled to the requested peak, since an equaliser that lowers nearly everything would
/// let it drown in the noise.
struct VerifyingSweep
{
    std::vector<float> signal;
    SweepParams sweep;
    double gain = 0.0; ///< dB by which the signal is louder than the sweep says
};
[[nodiscard]] Result<VerifyingSweep> verifyingSweep(const MeasureSettings& settings, const EqualizerSections& sections,
                                                    double sampleRate, bool raised = false);

} // namespace pacini
