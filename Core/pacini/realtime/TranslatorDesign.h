#pragma once

// Set-up of the translator for one actuator, designed before the audio thread gets it.

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/DynamicRangeMap.h>
#include <pacini/actuator/EqualizerPruning.h>
#include <pacini/actuator/FrequencyMap.h>
#include <pacini/actuator/MotorDrive.h>
#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/ProtectionParams.h>
#include <pacini/filters/BandLayout.h>
#include <pacini/realtime/BandMeter.h>
#include <pacini/realtime/CarrierVoice.h>
#include <pacini/realtime/DirectPath.h>
#include <pacini/realtime/HighBandVoice.h>
#include <pacini/realtime/TranslatorParams.h>
#include <pacini/realtime/TranslatorSetup.h>
#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// Report of culling: something that the translator does without.
struct TranslatorSaving
{
    std::string what;   ///< such as `bands[2].carrier`
    std::string reason; ///< in plain words
    bool operator==(const TranslatorSaving&) const = default;
};

/// Everything that the translator does without.
using TranslatorPlan = std::vector<TranslatorSaving>;

/// One source band of the translator.
struct TranslatorBand
{
    Hertz low, centre, high;
    bool rumble = false; ///< else texture
    bool shown = true;   ///< the actuator can play the band's own signal
};

/// Coefficients and choices of the translator. Immutable; made off the audio thread by designTranslator().
struct TranslatorDesign
{
    BandLayout layout;
    FixedVector<TranslatorBand, maxTranslatorBands> bands;
    double innerRate = 6000.0; ///< Hz
    BandMeter meter;           ///< copied, like the members below, so that the audio thread designs nothing
    DirectPath direct;
    bool anyDirect = false;
    double directLow = 1.0, directHigh = 1.0; ///< Hz, the range of the direct path
    std::array<BandListener, maxTranslatorBands> listeners;
    BandListener wide;                       ///< to the whole range
    std::optional<FrequencyMap> frequencies; ///< none: every frequency stays
    double lowest = 5.0;                     ///< Hz that carriers reach
    double highest = 2000.0;
    std::size_t voices = maxTranslatorBands;
    std::optional<MotorDriveParams> motor;
    double motorBurst = 0.0; ///< s that an event drives a motor
    DynamicRangeMap levels;
    PulseParams pulses;
    BiquadCascadeCoefficients filter; ///< equaliser and flattening at the inner rate
    double scale = 1.0;               ///< room for overdrive
    std::optional<ProtectionParams> protection;
    double brightFrequency = 0.0; ///< Hz at which sounds too high for the skin are felt; 0: there is no need
    bool playsHeard = true;       ///< the actuator has a voice for sound above the range of touch
    double feltRange = 60.0;      ///< dB between full drive and the weakest drive that is felt
    TranslatorPlan plan;
};

inline constexpr double highestInnerRate = 12000.0; // Hz

/// Returns the whole factor by which the translator reduces a sample rate: to 6 kHz or slightly more, which leaves room
/// for 1 kHz, and below highestInnerRate.
[[nodiscard]] inline std::size_t translatorFactor(double fs) noexcept
{
    return static_cast<std::size_t>(std::max(1.0, std::floor(clampTo(fs, 2000.0, 1e7) / 6000.0)));
}

namespace detail
{
/// Sets the pulses of events from the profile, if it describes them.
inline void choosePulses(TranslatorDesign& design, const ActuatorTransient& transient) noexcept
{
    if (transient.shape != TransientShape::adaptive)
        design.pulses = {transient.shape, transient.frequency, transient.cycles};
}

/// The frequencies that are played, and how many of them at a time.
inline void adoptRange(TranslatorDesign& design, const Profile& profile, const ActuatorFit& fit)
{
    Profile reached = profile;
    reached.range = fit.range;
    design.frequencies = FrequencyMap(reached);
    design.lowest = design.pulses.lowest = reached.range.lowFrequency;
    design.highest = design.pulses.highest = reached.range.highFrequency;
    design.voices = static_cast<std::size_t>(std::max(profile.polyphony, 1));
    if (profile.technology == Technology::erm)
    {
        design.motor = motorDriveParams(profile);
        design.motorBurst = std::max(0.012, profile.response.riseTime);
        design.voices = 1;
    }
    constexpr Decibels felt(35.0); // that a sound's loudest part stands above what is just felt beside it
    design.levels = DynamicRangeMap({Decibels(profile.range.dynamicRange), felt, 1.0});
}

/// The equaliser as far as it is felt, and the flattening.
inline void adoptFilter(TranslatorDesign& design, const Profile& profile, const ActuatorFit& fit)
{
    const auto pruned = pruneEqualizer(
        fit.equalizer, {Hertz(profile.range.lowFrequency), Hertz(profile.range.highFrequency), Decibels(0.1)},
        design.innerRate);
    if (!design.motor)
        design.filter = designOutputFilter({pruned.kept, fit.flattening}, design.innerRate);
    for (const DroppedSection& section : pruned.dropped)
        design.plan.push_back({"equalizer[" + std::to_string(section.index) + "]", "is flat in the actuator's range"});
    if (!fit.flattening)
        design.plan.push_back({"flattening", profile.technology == Technology::erm
                                                 ? "a motor has no resonance to flatten"
                                                 : "the equaliser flattens the actuator"});
}

/// The limits that have to be guarded behind the drive stage.
inline void adoptProtection(TranslatorDesign& design, const Profile& profile)
{
    ProtectionParams limits = protectionParams(profile, Seconds(0.0));
    if (design.motor) // it turns: nothing swings, and the mean of its voltage must stay
    {
        limits.boundsAlone = true;
        limits.excursion.reset();
    }
    if (limits.excursion || limits.heat)
        design.protection = limits;
}

inline void planSavings(TranslatorDesign& design, const std::optional<Profile>& profile, bool known)
{
    if (!known)
        design.plan.push_back({"adaptation", "no actuator is known"});
    if (!design.protection)
        design.plan.push_back(
            {"protection", profile ? protectionText(*profile, design.motor.has_value()) : "no actuator is known"});
    if (known && design.levels.isIdentity())
        design.plan.push_back({"dynamicRange", "the actuator covers the whole range of touch"});
}

/// Limits the range to frequencies that the inner rate can carry. An actuator of few voices plays them where they are
/// felt.
inline void limitRange(TranslatorDesign& design, bool anyWaveform) noexcept
{
    design.highest = std::min(design.highest, 0.4 * design.innerRate);
    design.lowest = std::min(design.lowest, design.highest);
    if (!anyWaveform)
        design.highest = clampTo(HighBandVoice::border.value, design.lowest, design.highest);
}

/// Decides for each band between a carrier and its own signal, and designs the direct path.
inline void designBands(TranslatorDesign& design, bool anyWaveform)
{
    design.meter.design(design.layout, design.innerRate);
    Hertz low(1.0), border(1.0), high(1.0);
    for (std::size_t k = 0; k < design.layout.bands(); ++k)
    {
        TranslatorBand band{design.layout.lowerEdge(k), design.layout.centres[k], design.layout.upperEdge(k)};
        band.rumble = band.centre.value < 100.0;
        band.shown = anyWaveform && band.centre.value >= design.lowest && band.centre.value <= design.highest;
        if (band.rumble)
            border = band.high;
        if (band.shown || design.motor) // whose strength is that of the whole range
        {
            low = design.anyDirect ? low : band.low;
            high = band.high;
            design.anyDirect = true;
        }
        design.bands.pushBack(band);
        design.listeners[k].design(band.low, band.high, design.innerRate);
        const std::string name = "bands[" + std::to_string(k) + "].";
        if (band.shown)
            design.plan.push_back({name + "carrier", "the actuator plays the band's own signal"});
        else
            design.plan.push_back({name + "direct", anyWaveform ? "lies outside the actuator's range"
                                                                : "the actuator has too few voices"});
    }
    design.wide.design(design.layout.lowerEdge(0), design.layout.upperEdge(design.layout.bands() - 1),
                       design.innerRate);
    design.directLow = low.value;
    design.directHigh = high.value;
    design.direct.design(low, border, high, design.innerRate);
}

/// Decides where sounds too high for the skin are felt. Bands that are moved into a narrower range are felt already.
inline void designBrightness(TranslatorDesign& design, bool anyWaveform)
{
    const bool showsAll = std::all_of(design.bands.begin(), design.bands.end(),
                                      [](const TranslatorBand& band)
                                      { return band.shown || band.high.value <= HighBandVoice::border.value; });
    if (anyWaveform && showsAll)
        design.brightFrequency = clampTo(HighBandVoice::frequency, design.lowest, design.highest);
    else
        design.plan.push_back({"brightness", "high bands are moved into the actuator's range"});
}
} // namespace detail

/// The set of one actuator for a host rate of `fs` Hz. A valid profile without polyphony to spare (fewer voices than
/// bands) gets carriers only; otherwise a band whose centre is played as it is fitted (see fitActuator) is played by
/// its own signal. [message]
[[nodiscard]] inline TranslatorDesign designTranslator(const TranslatorSetup& setup, double fs)
{
    TranslatorDesign design;
    design.innerRate = fs / static_cast<double>(translatorFactor(fs));
    BandLayoutParams bands = setup.bands;
    bands.bands = clampTo<std::size_t>(bands.bands, 1, maxTranslatorBands);
    design.layout = designBandLayout(bands);
    const bool known = setup.profile && setup.profile->technology != Technology::pcm;
    if (setup.profile)
    {
        const Profile& profile = *setup.profile;
        design.scale = 1.0 / profile.drive.overdrive;
        design.feltRange = profile.range.dynamicRange;
        detail::choosePulses(design, profile.transient);
        if (known)
        {
            const ActuatorFit fit = fitActuator(profile, {setup.maxBoost, setup.strength});
            detail::adoptRange(design, profile, fit);
            detail::adoptFilter(design, profile, fit);
        }
        detail::adoptProtection(design, profile);
    }
    detail::planSavings(design, setup.profile, known);
    const bool anyWaveform = design.voices >= design.layout.bands() && !design.motor;
    detail::limitRange(design, anyWaveform);
    detail::designBands(design, anyWaveform);
    detail::designBrightness(design, anyWaveform);
    design.playsHeard = anyWaveform || design.motor;
    if (!design.playsHeard)
        design.plan.push_back({"audible", "the actuator has too few voices"});
    return design;
}

/// The parts that the design leaves out, and those that a set of parameters leaves out. [message]
[[nodiscard]] inline TranslatorPlan translatorPlan(const TranslatorDesign& design, const TranslatorParams& params)
{
    TranslatorPlan plan = design.plan;
    if (params.rumble.muted)
        plan.push_back({"rumble", "is muted"});
    if (params.texture.muted)
        plan.push_back({"texture", "is muted"});
    if (!(params.brightness > lowestBrightness))
        plan.push_back({"brightness", "is off"});
    if (design.playsHeard && !(params.audible > 0.0))
        plan.push_back({"audible", "is off"});
    if (params.transients.muted)
        plan.push_back({"transients", "are muted"});
    return plan;
}

} // namespace pacini
