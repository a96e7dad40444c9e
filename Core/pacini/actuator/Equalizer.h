#pragma once

// Equalizer of an actuator: the sections that flatten its response, as data and as a filter.

#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/foundation/Result.h>

#include <string>
#include <utility>

namespace pacini
{

enum class EqualizerType
{
    peak,
    lowShelf,
    highShelf,
    highpass ///< Butterworth of any order
};

/// One section of an equalizer; gain and q count for peak and shelves, order for the high-pass.
struct EqualizerSection
{
    EqualizerType type = EqualizerType::peak;
    double frequency = 100.0; ///< Hz
    double gain = 0.0;        ///< dB
    double q = 0.7071067811865476;
    int order = 2;
    bool operator==(const EqualizerSection&) const = default;
};

/// An equalizer's sections in series.
using EqualizerSections = FixedVector<EqualizerSection, 16>;

/// Checks an equalizer's ranges: frequencies 1-20000 Hz, gains within +-40 dB, q 0.01-100, order 1-8, together at most
/// 32 second-order sections. `where` names the list in the error.
[[nodiscard]] inline Result<void> validate(const EqualizerSections& sections, const std::string& where)
{
    const auto wrong = [](std::string at, const char* message) -> Result<void>
    {
        return Error{ErrorCode::invalidData, std::move(at), message};
    };
    const auto within = [](double value, double low, double high)
    {
        return value >= low && value <= high;
    };
    std::size_t biquads = 0;
    for (std::size_t i = 0; i < sections.size(); ++i)
    {
        const EqualizerSection& section = sections[i];
        const auto at = where + "[" + std::to_string(i) + "]";
        if (!within(section.frequency, 1.0, 20000.0))
            return wrong(at + ".frequency", "must be 1 to 20000 Hz");
        if (!within(section.gain, -40.0, 40.0))
            return wrong(at + ".gain", "must be -40 to 40 dB");
        if (!within(section.q, 0.01, 100.0))
            return wrong(at + ".q", "must be 0.01 to 100");
        if (section.order < 1 || section.order > 8)
            return wrong(at + ".order", "must be 1 to 8");
        biquads += section.type == EqualizerType::highpass ? static_cast<std::size_t>(section.order + 1) / 2 : 1;
        if (biquads > maxBiquadSections)
            return wrong(at, "is too high: high-passes count with half their order, at most 32 together");
    }
    return {};
}

/// The equalizer of a valid profile as a filter at `fs` Hz. Sections at or above 0.49 fs are left out, because their
/// responses would be wrong there. Cookbook sections (see Biquad.h) and Butterworth high-passes.
[[nodiscard]] inline BiquadCascadeCoefficients designEqualizer(const EqualizerSections& sections, double fs) noexcept
{
    BiquadCascadeCoefficients cascade;
    for (const EqualizerSection& section : sections)
    {
        if (section.frequency >= 0.49 * fs)
            continue;
        if (section.type == EqualizerType::highpass)
        {
            const auto highpass =
                designButterworth({ButterworthType::highpass, section.order, Hertz(section.frequency), Hertz(0.0)}, fs);
            for (const StateVariableCoefficients& part : highpass.sections)
                cascade.sections.pushBack(part);
            continue;
        }
        BiquadParams params;
        params.type = section.type == EqualizerType::peak       ? BiquadType::peak
                      : section.type == EqualizerType::lowShelf ? BiquadType::lowShelf
                                                                : BiquadType::highShelf;
        params.frequency = Hertz(section.frequency);
        params.gain = Decibels(section.gain);
        params.q = section.q;
        cascade.sections.pushBack(designStateVariable(params, fs));
    }
    return cascade;
}

/// A profile's equalizer as a streaming filter.
using Equalizer = DesignedCascade<EqualizerSections, designEqualizer>;

static_assert(DspBlock<Equalizer>);

} // namespace pacini
