#include "io/FieldsReader.h"
#include "io/formats/ForeignText.h"
#include "io/formats/HjifFormat.h"

#include <pacini/clip/BandPriority.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace pacini
{

namespace
{
constexpr std::size_t mostElements = 5'000'000;

struct Keyframe
{
    double position = 0.0; ///< ticks
    std::optional<double> amplitude;
    std::optional<double> frequency;
};

struct Effect
{
    std::string type;
    double position = 0.0; ///< ticks
    std::optional<double> id, phase;
    std::string baseSignal = "Sine";
    std::vector<Keyframe> keyframes;
};

struct ForeignBand
{
    std::string type;
    double low = 0.0, high = 0.0; ///< Hz
    std::vector<Effect> effects;
};

struct Channel
{
    double gain = 1.0;
    std::optional<double> rate, samples;
    std::vector<ForeignBand> bands;
};

struct Perception
{
    std::string modality;
    double unitExponent = 0.0;
    std::vector<Effect> library;
    std::vector<Channel> channels;
};

void readEffects(FieldsReader& reader, const char* name, std::vector<Effect>& effects)
{
    reader.list(name, effects, mostElements, "effects",
                [&](Effect& effect)
                {
                    reader.text("effect_type", effect.type);
                    reader.number("position", effect.position, Need::required);
                    reader.optionalNumber("id", effect.id);
                    reader.optionalNumber("phase", effect.phase);
                    reader.optionalText("base_signal", effect.baseSignal);
                    reader.list("keyframes", effect.keyframes, mostElements, "keyframes",
                                [&](Keyframe& keyframe)
                                {
                                    reader.number("relative_position", keyframe.position, Need::optional);
                                    reader.optionalNumber("amplitude_modulation", keyframe.amplitude);
                                    reader.optionalNumber("frequency_modulation", keyframe.frequency);
                                });
                });
}

void readPerception(FieldsReader& reader, Perception& perception)
{
    reader.text("perception_modality", perception.modality);
    reader.number("perception_unit_exponent", perception.unitExponent, Need::optional);
    readEffects(reader, "effect_library", perception.library);
    reader.list("channels", perception.channels, 65535, "channels",
                [&](Channel& channel)
                {
                    reader.number("gain", channel.gain, Need::required);
                    reader.optionalNumber("frequency_sampling", channel.rate);
                    reader.optionalNumber("sample_count", channel.samples);
                    reader.list("bands", channel.bands, 65535, "bands",
                                [&](ForeignBand& band)
                                {
                                    reader.text("band_type", band.type);
                                    reader.number("lower_frequency_limit", band.low, Need::required);
                                    reader.number("upper_frequency_limit", band.high, Need::required);
                                    readEffects(reader, "effects", band.effects);
                                });
                });
}

/// Year and amendment, `2023` or `2023-1`.
std::optional<Error> checkVersion(const std::string& version, std::vector<std::string>& warnings)
{
    constexpr int firstYear = 2023, knownYear = 2025;
    const bool wellFormed = version.size() >= 4 && std::all_of(version.begin(), version.begin() + 4,
                                                               [](char c) { return c >= '0' && c <= '9'; });
    const int year = wellFormed ? std::stoi(version.substr(0, 4)) : 0;
    if (year < firstYear || (version.size() > 4 && version[4] != '-'))
        return Error{ErrorCode::invalidData, "version", "must be a year from 2023, such as \"2023\" or \"2023-1\""};
    if (year > knownYear)
        warnings.push_back(fmt::format("version: {} is newer than what this program knows", shownText(version)));
    return {};
}

bool vibrates(std::string_view modality)
{
    constexpr std::array<std::string_view, 9> known{"Other",     "Pressure", "Acceleration",
                                                    "Velocity",  "Position", "Vibrotactile",
                                                    "Vibration", "Force",    "Kinesthetic"};
    return std::find(known.begin(), known.end(), modality) != known.end();
}

/// Amplitude of a base signal's first harmonic; none for unknown signals.
std::optional<double> fundamentalOf(std::string_view signal)
{
    constexpr double pi = std::numbers::pi;
    if (signal == "Sine")
        return 1.0;
    if (signal == "Square")
        return 4.0 / pi;
    if (signal == "Triangle")
        return 8.0 / (pi * pi);
    if (signal == "SawToothUp" || signal == "SawToothDown")
        return 2.0 / pi;
    return {};
}

/// Turns the parts of a file into one clip.
class Importer
{
public:
    Importer(double tickRate, std::vector<std::string>& warningsToFill) : ticks(tickRate), warnings(warningsToFill) {}

    std::optional<Error> error;
    Clip clip;

    void add(const std::vector<Perception>& perceptions)
    {
        std::size_t channels = 0;
        for (const Perception& perception : perceptions)
            if (vibrates(perception.modality))
                channels += perception.channels.size();
        if (channels > 1)
            warnings.push_back(
                fmt::format("perceptions: {} channels are merged into one clip, each at 1 / {}", channels, channels));
        for (std::size_t i = 0; i < perceptions.size(); ++i)
        {
            const Perception& perception = perceptions[i];
            const std::string where = fmt::format("perceptions[{}]", i);
            if (!vibrates(perception.modality))
            {
                warn(where + ".perception_modality",
                     fmt::format("'{}' is no vibration in time; left out", shownText(perception.modality)));
                continue;
            }
            library = &perception.library;
            for (std::size_t c = 0; c < perception.channels.size(); ++c)
                addChannel(perception.channels[c], perception.unitExponent, 1.0 / static_cast<double>(channels),
                           fmt::format("{}.channels[{}]", where, c));
        }
        finish();
    }

private:
    void warn(const std::string& where, std::string_view message)
    {
        constexpr std::size_t most = 50; // of a hostile file
        if (warnings.size() < most)
            warnings.push_back(fmt::format("{}: {}", where, message));
    }

    void fail(std::string where, std::string message, ErrorCode code = ErrorCode::invalidData)
    {
        if (!error)
            error = Error{code, std::move(where), std::move(message)};
    }

    void addChannel(const Channel& channel, double exponent, double share, const std::string& where)
    {
        if (!(std::abs(exponent) <= 12.0))
            return fail(where.substr(0, where.find('.')) + ".perception_unit_exponent", "must be -12 to 12");
        if (!(channel.gain >= -1e6 && channel.gain <= 1e6))
            return fail(where + ".gain", "must be -1000000 to 1000000");
        scale = std::abs(channel.gain) * std::pow(10.0, exponent) * share;
        if (channel.rate && channel.samples && *channel.rate > 0.0 && *channel.samples >= 0.0)
            wantedDuration = std::max(wantedDuration, *channel.samples / *channel.rate);
        for (std::size_t i = 0; i < channel.bands.size() && !error; ++i)
        {
            const ForeignBand& band = channel.bands[i];
            const std::string place = fmt::format("{}.bands[{}]", where, i);
            if (!(band.low >= 0.0 && band.low <= band.high && band.high <= limits::frequency))
                return fail(place, "needs 0 <= lower_frequency_limit <= upper_frequency_limit <= 400000");
            if (band.type == "VectorialWave" || band.type == "Curve" || band.type == "Transient")
                addBand(band, place);
            else if (band.type == "WaveletWave")
                warn(place, "WaveletWave bands are not read; left out");
            else
                return fail(place + ".band_type", fmt::format("must be Transient, Curve, VectorialWave or WaveletWave, "
                                                              "not '{}'",
                                                              shownText(band.type)));
        }
    }

    void addBand(const ForeignBand& band, const std::string& where)
    {
        std::vector<Band> lanes; // effects that overlap sound side by side
        std::vector<double> ends;
        std::vector<std::pair<const Effect*, double>> effects;
        for (std::size_t i = 0; i < band.effects.size(); ++i)
        {
            const std::string place = fmt::format("{}.effects[{}]", where, i);
            const Effect& effect = band.effects[i];
            const Effect* basis = resolve(effect, place);
            if (basis == nullptr)
                continue;
            if (!checkTimes(effect.position, *basis, place))
                return;
            if (band.type == "Transient")
                addEvents(*basis, effect.position, place);
            else if (band.type == "Curve" || !addPulse(*basis, effect.position))
                effects.emplace_back(basis, effect.position);
        }
        std::stable_sort(effects.begin(), effects.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
        for (const auto& [effect, position] : effects)
        {
            if (effect->keyframes.empty())
                continue;
            const auto [first, last] =
                std::minmax_element(effect->keyframes.begin(), effect->keyframes.end(),
                                    [](const Keyframe& a, const Keyframe& b) { return a.position < b.position; });
            const double end = position + last->position;
            std::size_t lane = 0;
            while (lane < lanes.size() && ends[lane] > position)
                ++lane;
            if (lane == lanes.size())
            {
                if (clip.bands.size() + lanes.size() >= limits::bands)
                    return fail(where, "has more than 256 waves that sound together", ErrorCode::tooLarge);
                lanes.emplace_back();
                ends.push_back(0.0);
            }
            ends[lane] = end;
            if (band.type == "Curve")
                addCurve(*effect, position, lanes[lane]);
            else
                addWave(*effect, position, band, lanes[lane], where);
            duration = std::max(duration, end / ticks);
        }
        for (Band& lane : lanes)
            finishBand(lane, band);
    }

    const Effect* resolve(const Effect& effect, const std::string& where)
    {
        if (effect.type == "Basis")
            return &effect;
        if (effect.type == "Reference" && effect.id)
        {
            const auto found = std::find_if(library->begin(), library->end(),
                                            [&](const Effect& e) { return e.id == effect.id && e.type == "Basis"; });
            if (found != library->end())
                return &*found;
            warn(where, fmt::format("effect {} is not in the library; left out", *effect.id));
        }
        else if (effect.type == "Reference")
            fail(where + ".id", "is missing");
        else if (effect.type == "Composite")
            warn(where, "composite effects are not read; left out");
        else
            fail(where + ".effect_type",
                 fmt::format("must be Basis, Reference or Composite, not '{}'", shownText(effect.type)));
        return nullptr;
    }

    bool checkTimes(double position, const Effect& effect, const std::string& where)
    {
        const double most = limits::duration * ticks;
        if (!(position >= 0.0 && position <= most))
            fail(where + ".position", "must be 0 to 24 hours");
        double before = 0.0;
        for (std::size_t i = 0; i < effect.keyframes.size() && !error; ++i)
        {
            const Keyframe& keyframe = effect.keyframes[i];
            const std::string place = fmt::format("{}.keyframes[{}]", where, i);
            if (!(keyframe.position >= 0.0 && position + keyframe.position <= most))
                fail(place + ".relative_position", "must be 0 to 24 hours");
            else if (keyframe.position < before)
                fail(place + ".relative_position", "is earlier than the keyframe before it");
            // Rounded decimals may pass the limit by a little; what is kept does not.
            if (keyframe.amplitude && std::abs(*keyframe.amplitude) * scale > 1.001 * limits::amplitude)
                fail(place + ".amplitude_modulation", "is more than a thousand times full drive");
            before = keyframe.position;
        }
        return !error;
    }

    void addEvents(const Effect& effect, double position, const std::string& where)
    {
        constexpr double pulseLength = 0.022; // s, in the reference player
        for (const Keyframe& keyframe : effect.keyframes)
        {
            if (!keyframe.amplitude)
            {
                warn(where, "a transient without amplitude is left out");
                continue;
            }
            const double frequency = keyframe.frequency.value_or(0.5 * (hjifDullFrequency + hjifSharpFrequency));
            const double sharpness = (frequency - hjifDullFrequency) / (hjifSharpFrequency - hjifDullFrequency);
            const double time = (position + keyframe.position) / ticks;
            clip.transients.push_back(
                {time, std::min(std::abs(*keyframe.amplitude) * scale / hjifTransientLevel, limits::amplitude),
                 std::clamp(sharpness, 0.0, 1.0)});
            latestEvent = std::max(latestEvent, time + pulseLength);
        }
    }

    /// A short wave of one frequency that rises from 0 and falls back to it is an event; returns whether this is one.
    /// Its sharpness is the one that the decoder plays with this frequency: pulses in fast trains have more periods.
    bool addPulse(const Effect& effect, double position)
    {
        constexpr double longest = 0.030; // s
        const auto& keyframes = effect.keyframes;
        if (keyframes.size() < 3 || effect.baseSignal != "Sine" || !keyframes.front().frequency)
            return false;
        const double length = (keyframes.back().position - keyframes.front().position) / ticks;
        bool falls = false;
        double peak = 0.0, before = 0.0;
        for (std::size_t i = 0; i < keyframes.size(); ++i)
        {
            if (!keyframes[i].amplitude || (i > 0 && keyframes[i].frequency))
                return false;
            const double value = *keyframes[i].amplitude;
            const bool isEnd = i == 0 || i + 1 == keyframes.size();
            falls = falls || value < before;
            if (isEnd != (value == 0.0) || (falls && value > before))
                return false;
            peak = std::max(peak, value);
            before = value;
        }
        // Between two ticks lies the peak of a window of an odd number of them.
        const std::size_t steps = keyframes.size() - 1;
        if (steps % 2 == 1 && std::lround(length * ticks) == static_cast<long>(steps))
            peak /= hannAt(static_cast<double>(steps / 2) / static_cast<double>(steps));
        const double frequency = *keyframes.front().frequency;
        if (!(length > 0.0 && length <= longest && frequency >= 1.0))
            return false;
        const bool alone = frequency * length < 2.5; // periods
        const double sharpness = alone ? std::log(frequency / 100.0) / std::log(2.8)
                                       : std::log(frequency / 150.0) / std::log(2500.0 / 150.0);
        const double time = (position + keyframes.front().position) / ticks;
        clip.transients.push_back({time, std::min(peak * scale, limits::amplitude), std::clamp(sharpness, 0.0, 1.0)});
        latestEvent = std::max(latestEvent, time + length);
        return true;
    }

    void addWave(const Effect& effect, double position, const ForeignBand& band, Band& lane, const std::string& where)
    {
        const auto fundamental = fundamentalOf(effect.baseSignal);
        if (effect.baseSignal != "Sine")
            warn(where, fmt::format("the base signal '{}' becomes a sine", shownText(effect.baseSignal)));
        const double level = scale * fundamental.value_or(1.0);
        // Only audible where effects meet: waves start at phase 0.
        Curve amplitude;
        bool inverted = false, clamped = false;
        for (const Keyframe& keyframe : effect.keyframes)
        {
            const double time = (position + keyframe.position) / ticks;
            if (keyframe.amplitude)
            {
                amplitude.push_back({time, std::min(std::abs(*keyframe.amplitude) * level, limits::amplitude)});
                inverted = inverted || *keyframe.amplitude < 0.0;
            }
            if (keyframe.frequency)
            {
                const double f = std::clamp(*keyframe.frequency, std::max(band.low, 1.0), std::max(band.high, 1.0));
                clamped = clamped || f != *keyframe.frequency;
                lane.pitch.push_back({time, f});
            }
        }
        if (inverted)
            warn(where, "negative amplitudes are read without sign");
        if (clamped)
            warn(where, "frequencies outside of the band are moved to its limits");
        if (amplitude.empty())
            return;
        const double start = position / ticks;
        const double end = (position + effect.keyframes.back().position) / ticks;
        if (start < amplitude.front().time)
            amplitude.insert(amplitude.begin(), {start, amplitude.front().value});
        if (end > amplitude.back().time)
            amplitude.push_back({end, amplitude.back().value});
        append(lane.amplitude, amplitude);
    }

    /// A waveform drawn through its extrema: between two of them lies half a period.
    void addCurve(const Effect& effect, double position, Band& lane)
    {
        std::vector<Breakpoint> extrema;
        for (const Keyframe& keyframe : effect.keyframes)
        {
            const Breakpoint point{(position + keyframe.position) / ticks, keyframe.amplitude.value_or(0.0) * scale};
            const std::size_t n = extrema.size();
            if (n > 0 && (extrema[n - 1].value == point.value || extrema[n - 1].time == point.time))
                continue;
            if (n > 1 && (extrema[n - 1].value - extrema[n - 2].value) * (point.value - extrema[n - 1].value) > 0.0)
                extrema.pop_back(); // the curve goes on in its direction
            extrema.push_back(point);
        }
        Curve amplitude;
        for (std::size_t i = 1; i < extrema.size(); ++i)
        {
            const double middle = 0.5 * (extrema[i - 1].time + extrema[i].time);
            const double half = extrema[i].time - extrema[i - 1].time;
            const double height = 0.5 * std::abs(extrema[i].value - extrema[i - 1].value);
            amplitude.push_back({middle, std::min(height, limits::amplitude)});
            lane.pitch.push_back({middle, std::clamp(0.5 / half, 1.0, limits::frequency)});
        }
        append(lane.amplitude, amplitude);
    }

    /// Between effects there is silence.
    static void append(Curve& curve, const Curve& next)
    {
        if (next.empty())
            return;
        if (!curve.empty() && curve.back().value > 0.0 && next.front().time > curve.back().time)
            curve.push_back({curve.back().time, 0.0});
        const double before = curve.empty() ? 0.0 : curve.back().value;
        if (next.front().time > 0.0 && before == 0.0 && next.front().value > 0.0)
            curve.push_back({next.front().time, 0.0});
        curve.insert(curve.end(), next.begin(), next.end());
    }

    void finishBand(Band& lane, const ForeignBand& band)
    {
        if (lane.amplitude.empty())
            return;
        lane.lowFrequency = band.low;
        lane.highFrequency = band.high;
        for (const Breakpoint& point : lane.pitch)
        {
            lane.lowFrequency = std::min(lane.lowFrequency, point.value);
            lane.highFrequency = std::max(lane.highFrequency, point.value);
        }
        double centre = std::sqrt(std::max(band.low, 1.0) * std::max(band.high, 1.0));
        if (!lane.pitch.empty())
        {
            double octaves = 0.0;
            for (const Breakpoint& point : lane.pitch)
                octaves += std::log2(point.value) / static_cast<double>(lane.pitch.size());
            centre = std::exp2(octaves);
            const bool stands =
                std::all_of(lane.pitch.begin(), lane.pitch.end(),
                            [&](const Breakpoint& point) { return std::abs(point.value - centre) < 1e-6 * centre; });
            if (stands)
            {
                centre = lane.pitch.front().value;
                lane.pitch.clear();
            }
        }
        lane.centreFrequency = std::clamp(centre, lane.lowFrequency, lane.highFrequency);
        clip.bands.push_back(std::move(lane));
    }

    void finish()
    {
        double lastEvent = 0.0;
        for (const Transient& event : clip.transients)
            lastEvent = std::max(lastEvent, event.time);
        // A stated length may cut the pulse of the last event, but nothing else.
        clip.duration =
            wantedDuration > 0.0 ? std::max({wantedDuration, duration, lastEvent}) : std::max(duration, latestEvent);
        for (Band& band : clip.bands)
            if (band.amplitude.back().value > 0.0 && band.amplitude.back().time < clip.duration - 1e-9)
                band.amplitude.push_back({band.amplitude.back().time, 0.0});
        std::stable_sort(clip.transients.begin(), clip.transients.end(),
                         [](const Transient& a, const Transient& b) { return a.time < b.time; });
        std::vector<double> energies;
        for (const Band& band : clip.bands)
            energies.push_back(curveEnergy(band.amplitude, clip.duration));
        const auto priorities = prioritiesByEnergy(energies);
        for (std::size_t i = 0; i < clip.bands.size(); ++i)
            clip.bands[i].priority = priorities[i];
    }

    double ticks; ///< per second
    std::vector<std::string>& warnings;
    const std::vector<Effect>* library = nullptr;
    double scale = 1.0; ///< of the channel being read
    double duration = 0.0, latestEvent = 0.0, wantedDuration = 0.0;
};
} // namespace

bool isHjif(std::string_view bytes)
{
    constexpr auto none = std::string_view::npos;
    return bytes.find("\"perceptions\"") != none && bytes.find("\"avatars\"") != none;
}

const ForeignFormat& hjifFormat()
{
    static constexpr ForeignFormat format{
        "hjif", "MPEG haptics interchange (ISO/IEC 23090-31)", ".hjif", isHjif, readHjif, writeHjif};
    return format;
}

Result<ImportedClip> readHjif(std::string_view bytes)
{
    ImportedClip result;
    const auto tree = readForeignTree(bytes, result.warnings);
    if (!tree)
        return tree.error();
    FieldsReader reader(*tree);
    std::string version, profile, description;
    double ticks = 1000.0;
    std::vector<Perception> perceptions;
    reader.text("version", version);
    reader.optionalText("profile", profile);
    reader.optionalText("description", description);
    reader.number("timescale", ticks, Need::optional);
    if (!(ticks >= 1.0 && ticks <= 1e9))
        reader.fail("timescale", "must be 1 to 1000000000 ticks per second");
    if (!tree->contains("perceptions"))
        reader.fail("perceptions", "is missing");
    reader.list("perceptions", perceptions, 65535, "perceptions",
                [&](Perception& perception) { readPerception(reader, perception); });
    if (reader.error)
        return *reader.error;
    if (auto error = checkVersion(version, result.warnings))
        return *error;
    for (const char* name : {"profile", "level", "date", "avatars", "syncs"})
        if (!tree->contains(name))
            result.warnings.push_back(fmt::format("{}: is missing; other players refuse the file", name));

    Importer importer(ticks, result.warnings);
    importer.add(perceptions);
    if (importer.error)
        return *importer.error;
    result.clip = std::move(importer.clip);
    result.clip.name = description.substr(0, limits::text / 2);
    if (result.clip.bands.empty() && result.clip.transients.empty())
    {
        const bool hadMore = std::any_of(perceptions.begin(), perceptions.end(),
                                         [](const Perception& p) {
                                             return std::any_of(p.channels.begin(), p.channels.end(),
                                                                [](const Channel& c) { return !c.bands.empty(); });
                                         });
        if (hadMore)
            return Error{ErrorCode::invalidData, "perceptions", "hold nothing that can be read as vibration in time"};
        result.warnings.push_back("perceptions: nothing sounds");
    }
    if (auto valid = validate(result.clip); !valid)
        return valid.error();
    return result;
}

} // namespace pacini
