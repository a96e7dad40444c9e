#pragma once

// A haptic clip: a vibration as a few named curves and events. A plain value; validate() states the rules.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/Result.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pacini
{

/// One frequency band. Amplitudes are linear with 1 = full drive; pitch is the carrier's frequency in Hz (empty:
/// centreFrequency).
struct Band
{
    double lowFrequency = 0.0;    ///< Hz
    double centreFrequency = 0.0; ///< Hz, low <= centre <= high
    double highFrequency = 0.0;   ///< Hz
    int priority = 0;             ///< 0 is kept longest when voices run out
    Curve amplitude;              ///< linear, 0 and above
    Curve pitch;                  ///< Hz, above 0
    double phase = 0.0;           ///< of the carrier at the start, cycles, 0 to 1: 0 is a sine, 0.25 a cosine
    bool operator==(const Band&) const = default;
};

/// A short event: its time, peak level (linear, 1 = full drive) and sharpness (0 dull, 1
/// crisp).
struct Transient
{
    double time = 0.0;
    double amplitude = 0.0;
    double sharpness = 0.0;
    bool operator==(const Transient&) const = default;
};

/// A band of residual noise, beside the sinusoids of the bands.
struct NoiseBand
{
    double lowFrequency = 0.0;
    double highFrequency = 0.0;
    Curve amplitude; ///< linear RMS
    bool operator==(const NoiseBand&) const = default;
};

/// A named point of time.
struct Marker
{
    double time = 0.0;
    std::string name;
    bool operator==(const Marker&) const = default;
};

/// The source sound of a clip.
struct ClipSource
{
    std::string file;        ///< file name without folders
    double sampleRate = 0.0; ///< Hz, 0 = unknown
    int channels = 0;        ///< 0 = unknown
    bool operator==(const ClipSource&) const = default;
};

/// A parameter of the encoder that made the clip, kept for the record.
struct EncoderParameter
{
    std::string name;
    std::variant<double, std::string, bool> value;
    bool operator==(const EncoderParameter&) const = default;
};

/// A haptic clip.
struct Clip
{
    std::string name;
    double duration = 0.0; ///< seconds
    ClipSource source;
    std::vector<EncoderParameter> encoder;
    Curve envelope; ///< total amplitude; where present, the sum of the bands is levelled to it
    Curve centroid; ///< Hz
    std::vector<Band> bands;
    std::vector<Transient> transients;
    std::vector<NoiseBand> noise;
    std::vector<Marker> markers;
    bool operator==(const Clip&) const = default;
};

/// The text value of an encoder parameter, or `otherwise` when it is missing or not text.
[[nodiscard]] inline std::string encoderText(const Clip& clip, std::string_view name, std::string_view otherwise)
{
    for (const auto& parameter : clip.encoder)
        if (parameter.name == name)
            if (const auto* text = std::get_if<std::string>(&parameter.value))
                return *text;
    return std::string(otherwise);
}

/// All breakpoints of a clip's curves (envelope, centroid, band amplitudes and pitches, noise); transients not counted.
[[nodiscard]] inline std::size_t breakpointCount(const Clip& clip) noexcept
{
    std::size_t count = clip.envelope.size() + clip.centroid.size();
    for (const Band& band : clip.bands)
        count += band.amplitude.size() + band.pitch.size();
    for (const NoiseBand& band : clip.noise)
        count += band.amplitude.size();
    return count;
}

namespace limits
{
inline constexpr double duration = 24.0 * 3600.0; ///< s
inline constexpr double amplitude = 1000.0;       ///< linear: +60 dB over full drive is a mistake, not a clip
inline constexpr double frequency = 400000.0;     ///< Hz
inline constexpr std::size_t bands = 256;
inline constexpr std::size_t points = 50'000'000;
inline constexpr std::size_t text = 250'000; ///< bytes of all names and parameters together
} // namespace limits

namespace detail
{
inline std::string indexed(std::string_view name, std::size_t i)
{
    return std::string(name) + "[" + std::to_string(i) + "]";
}

inline Error brokenRule(std::string where, std::string message, ErrorCode code = ErrorCode::invalidData)
{
    return {code, std::move(where), std::move(message)};
}

inline Result<void> checkNumber(double value, double low, double high, const std::string& where)
{
    if (!std::isfinite(value))
        return brokenRule(where, "is not a finite number", ErrorCode::notFinite);
    if (value < low || value > high)
        return brokenRule(where, "is outside " + shortDecimalText(low, 6) + " to " + shortDecimalText(high, 6));
    return {};
}

inline Result<void> checkCurve(const Curve& curve, std::string_view valueName, double duration, double lowest,
                               double highest, const std::string& where)
{
    double before = 0.0;
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        const auto time = curve[i].time;
        // The message is only put together when a rule is broken: curves are long.
        if (!std::isfinite(time) || time < 0.0)
            return brokenRule(where + indexed("", i) + ".time", "is not a finite time of 0 or later",
                              std::isfinite(time) ? ErrorCode::invalidData : ErrorCode::notFinite);
        if (time < before)
            return brokenRule(where + indexed("", i) + ".time", "is earlier than the point before it");
        if (time > duration + 1e-6)
            return brokenRule(where + indexed("", i) + ".time", "is later than the clip's duration");
        const auto value = curve[i].value;
        if (!std::isfinite(value) || value < lowest || value > highest)
            return checkNumber(value, lowest, highest, where + indexed("", i) + "." + std::string(valueName));
        before = time;
    }
    return {};
}
inline Result<void> checkAmplitude(const Curve& curve, double duration, const std::string& where)
{
    return checkCurve(curve, "amplitude", duration, 0.0, limits::amplitude, where);
}

/// The parameters of the encoder, and the size of all texts.
inline Result<void> checkTexts(const Clip& clip)
{
    std::size_t textBytes = clip.name.size() + clip.source.file.size();
    for (const Marker& marker : clip.markers)
        textBytes += marker.name.size();
    std::set<std::string_view> names;
    for (const auto& [name, value] : clip.encoder)
    {
        if (!names.insert(name).second)
            return brokenRule("encoder", "has two parameters of the same name");
        if (const auto* number = std::get_if<double>(&value); number != nullptr && !std::isfinite(*number))
            return brokenRule("encoder", "has a parameter that is not a finite number", ErrorCode::notFinite);
        constexpr std::size_t number = 32; // its digits and what separates parameters
        textBytes += name.size() + number;
        if (const auto* words = std::get_if<std::string>(&value))
            textBytes += words->size();
    }
    if (textBytes > limits::text)
        return brokenRule("", "has more than " + std::to_string(limits::text) + " bytes of names and parameters",
                          ErrorCode::tooLarge);
    return {};
}

inline Result<void> checkItem(const Band& band, double duration, const std::string& where)
{
    for (const auto& [value, field] :
         {std::pair(band.lowFrequency, ".lowFrequency"), std::pair(band.centreFrequency, ".centreFrequency"),
          std::pair(band.highFrequency, ".highFrequency")})
        if (auto r = checkNumber(value, 0.0, limits::frequency, where + field); !r)
            return r;
    if (!(band.lowFrequency <= band.centreFrequency && band.centreFrequency <= band.highFrequency))
        return brokenRule(where, "needs lowFrequency <= centreFrequency <= highFrequency");
    if (auto r = checkAmplitude(band.amplitude, duration, where + ".amplitude"); !r)
        return r;
    if (auto r = checkCurve(band.pitch, "frequency", duration, 1e-3, limits::frequency, where + ".pitch"); !r)
        return r;
    return checkNumber(band.phase, 0.0, 1.0, where + ".phase");
}

inline Result<void> checkItem(const NoiseBand& band, double duration, const std::string& where)
{
    if (auto r = checkNumber(band.lowFrequency, 0.0, limits::frequency, where + ".lowFrequency"); !r)
        return r;
    if (auto r = checkNumber(band.highFrequency, band.lowFrequency, limits::frequency, where + ".highFrequency"); !r)
        return r;
    return checkAmplitude(band.amplitude, duration, where + ".amplitude");
}

inline Result<void> checkItem(const Transient& transient, double, const std::string& where)
{
    if (auto r = checkNumber(transient.amplitude, 0.0, limits::amplitude, where + ".amplitude"); !r)
        return r;
    return checkNumber(transient.sharpness, 0.0, 1.0, where + ".sharpness");
}

inline Result<void> checkItem(const Marker&, double, const std::string&)
{
    return {};
}

/// Each item of a list `name`; of those that have a time, also that they are in order, each called `noun`.
template <typename Item>
Result<void> checkList(const std::vector<Item>& items, double duration, std::string_view name, std::string_view noun)
{
    [[maybe_unused]] double before = 0.0;
    for (std::size_t i = 0; i < items.size(); ++i)
    {
        const std::string where = indexed(name, i);
        if constexpr (requires { items[i].time; })
        {
            if (auto r = checkNumber(items[i].time, 0.0, duration + 1e-6, where + ".time"); !r)
                return r;
            if (items[i].time < before)
                return brokenRule(where + ".time", "is earlier than the " + std::string(noun) + " before it");
            before = items[i].time;
        }
        if (auto r = checkItem(items[i], duration, where); !r)
            return r;
    }
    return {};
}
} // namespace detail

/// Checks every invariant of a clip: finite numbers, times in order and within the duration, amplitudes from 0,
/// frequencies above 0, low <= centre <= high. Returns the first broken rule with its place.
[[nodiscard]] inline Result<void> validate(const Clip& clip)
{
    using namespace detail;
    if (auto r = checkNumber(clip.duration, 0.0, limits::duration, "duration"); !r)
        return r;
    if (auto r = checkNumber(clip.source.sampleRate, 0.0, 1e9, "source.sampleRate"); !r)
        return r;
    if (clip.source.channels < 0)
        return brokenRule("source.channels", "is negative");
    if (auto r = checkTexts(clip); !r)
        return r;
    if (auto r = checkAmplitude(clip.envelope, clip.duration, "envelope"); !r)
        return r;
    if (auto r = checkCurve(clip.centroid, "frequency", clip.duration, 0.0, limits::frequency, "centroid"); !r)
        return r;
    if (clip.bands.size() > limits::bands)
        return brokenRule("bands", "has more than 256 bands", ErrorCode::tooLarge);
    if (auto r = checkList(clip.bands, clip.duration, "bands", "band"); !r)
        return r;
    if (auto r = checkList(clip.transients, clip.duration, "transients", "transient"); !r)
        return r;
    if (auto r = checkList(clip.noise, clip.duration, "noise", "noise"); !r)
        return r;
    return checkList(clip.markers, clip.duration, "markers", "marker");
}

} // namespace pacini
