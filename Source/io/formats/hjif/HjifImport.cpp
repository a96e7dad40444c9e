#include "io/formats/hjif/HjifImport.h"

#include "io/JsonText.h"
#include "io/formats/ForeignText.h"
#include "io/formats/ImportReport.h"
#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifVoices.h"
#include "io/formats/hjif/HjifWaveform.h"
#include "io/formats/hjif/HjifWaves.h"

#include <pacini/filters/Resampler.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace pacini
{

namespace
{
bool vibrates(std::string_view modality)
{
    constexpr std::array<std::string_view, 9> known{"Other",     "Pressure", "Acceleration",
                                                    "Velocity",  "Position", "Vibrotactile",
                                                    "Vibration", "Force",    "Kinesthetic"};
    return std::find(known.begin(), known.end(), modality) != known.end();
}

bool isWavelet(const HjifBand& band)
{
    return band.type == "WaveletWave";
}

/// The rate at which waveforms are drawn: that of the fastest band, or the lowest that the encoder takes.
int waveformRate(const std::vector<HjifPerception>& perceptions)
{
    constexpr double lowest = 8000.0;
    double rate = lowest;
    for (const HjifPerception& perception : perceptions)
        for (const HjifChannel& channel : perception.channels)
            for (const HjifBand& band : channel.bands)
                if (vibrates(perception.modality) && isWavelet(band))
                    rate = std::max(rate, std::min(band.high, static_cast<double>(highestResamplerRate)));
    return static_cast<int>(rate);
}

/// Turns the parts of a file into one clip.
class HjifImporter
{
public:
    HjifImporter(const HjifFile& file, std::vector<std::string>& warnings)
        : report(warnings), waveform(waveformRate(file.perceptions))
    {
        scale.ticks = file.ticks;
    }

    ImportReport report;
    Clip clip;

    void add(const std::vector<HjifPerception>& perceptions)
    {
        const std::size_t channels = countChannels(perceptions);
        if (channels > 1)
            report.warn("perceptions",
                        fmt::format("{} channels are merged into one clip, each at 1 / {}", channels, channels));
        for (std::size_t i = 0; i < perceptions.size(); ++i)
        {
            const HjifPerception& perception = perceptions[i];
            const std::string where = fmt::format("perceptions[{}]", i);
            if (!vibrates(perception.modality))
            {
                report.warn(where + ".perception_modality",
                            fmt::format("'{}' is not a vibration over time; left out", shownText(perception.modality)));
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
    static std::size_t countChannels(const std::vector<HjifPerception>& perceptions)
    {
        std::size_t channels = 0;
        for (const HjifPerception& perception : perceptions)
            if (vibrates(perception.modality))
                channels += perception.channels.size();
        return channels;
    }

    void addChannel(const HjifChannel& channel, double exponent, double share, const std::string& where)
    {
        if (!(std::abs(exponent) <= 12.0))
            return report.fail(where.substr(0, where.find('.')) + ".perception_unit_exponent", "must be -12 to 12");
        if (!(channel.gain >= -1e6 && channel.gain <= 1e6))
            return report.fail(where + ".gain", "must be -1000000 to 1000000");
        scale.level = std::abs(channel.gain) * std::pow(10.0, exponent) * share;
        if (channel.rate && channel.samples && *channel.rate > 0.0)
            wantedDuration = std::max(wantedDuration, *channel.samples / *channel.rate);
        const std::size_t firstEvent = clip.transients.size();
        drawn = std::any_of(channel.bands.begin(), channel.bands.end(), isWavelet);
        if (drawn)
            waveform.addChannel();
        for (std::size_t i = 0; i < channel.bands.size() && !report.error; ++i)
        {
            const HjifBand& band = channel.bands[i];
            const std::string place = fmt::format("{}.bands[{}]", where, i);
            if (!(band.low >= 0.0 && band.low <= band.high && band.high <= limits::frequency))
                return report.fail(place, "needs 0 <= lower_frequency_limit <= upper_frequency_limit <= 400000");
            if (band.type == "VectorialWave" || band.type == "Curve" || band.type == "Transient" || isWavelet(band))
                addBand(band, place);
            else
                return report.fail(place + ".band_type",
                                   fmt::format("must be Transient, Curve, VectorialWave or WaveletWave, "
                                               "not '{}'",
                                               shownText(band.type)));
        }
        addPulses(firstEvent);
        if (drawn)
            waveform.scale(scale.level);
    }

    /// Short waves are events. One that begins with a Transient of the channel, whose events begin at `first`, is the
    /// rest of its energy.
    void addPulses(std::size_t first)
    {
        const double together = 0.5 / scale.ticks;
        const auto earlier = [](const Transient& a, const Transient& b)
        {
            return a.time < b.time;
        };
        sortByTime(std::span(clip.transients).subspan(first));
        const std::size_t taps = clip.transients.size();
        for (const Transient& pulse : pulses)
        {
            const auto from = clip.transients.begin() + static_cast<std::ptrdiff_t>(first);
            const auto to = clip.transients.begin() + static_cast<std::ptrdiff_t>(taps);
            const auto tap = std::lower_bound(from, to, Transient{pulse.time - together, 0.0, 0.0}, earlier);
            if (tap != to && tap->time < pulse.time + together)
                tap->amplitude = std::min(hjifTogether(*tap, pulse.amplitude), limits::amplitude);
            else
                clip.transients.push_back(pulse);
        }
        pulses.clear();
    }

    void addBand(const HjifBand& band, const std::string& where)
    {
        std::vector<HjifPlaced> waves;
        for (std::size_t i = 0; i < band.effects.size(); ++i)
        {
            const std::string place = fmt::format("{}.effects[{}]", where, i);
            const double position = band.effects[i].position;
            const HjifEffect* basis = resolve(band.effects[i], place);
            if (basis == nullptr)
                continue;
            if (!checkTimes(position, *basis, place))
                return;
            if (band.type == "Transient")
                addEvents(*basis, position, place);
            else if (isWavelet(band) ||
                     ((band.type == "Curve" || !addPulse(*basis, position)) && !basis->keyframes.empty()))
                waves.push_back({basis, position});
        }
        std::stable_sort(waves.begin(), waves.end(),
                         [](const HjifPlaced& a, const HjifPlaced& b) { return a.position < b.position; });
        if (isWavelet(band))
            waveform.addWavelet(band, waves, scale.ticks, report, where);
        else if (drawn && band.type == "Curve")
            waveform.addCurve(band, waves, scale.ticks, report, where);
        else
            return addWaves(waves, band, where);
        waveform.endBand();
    }

    void addWaves(const std::vector<HjifPlaced>& waves, const HjifBand& band, const std::string& where)
    {
        ImportLanes lanes;
        const std::size_t room = limits::bands - std::min(clip.bands.size(), limits::bands);
        for (const auto& [effect, position] : waves)
        {
            const double end = position + effect->keyframes.back().position;
            Band* lane = lanes.take(position, end, room);
            if (lane == nullptr)
                return report.fail(where, "has more than 256 waves at the same time", ErrorCode::tooLarge);
            if (band.type == "Curve")
                appendHjifCurve(*lane, *effect, position, scale);
            else
                appendHjifWave(*lane, *effect, position, band, scale, report, where);
            duration = std::max(duration, end / scale.ticks);
        }
        for (Band& lane : lanes.bands)
            if (!lane.amplitude.empty())
            {
                setHjifFrequencies(lane, band);
                clip.bands.push_back(std::move(lane));
            }
    }

    const HjifEffect* resolve(const HjifEffect& effect, const std::string& where)
    {
        if (effect.type == "Basis")
            return &effect;
        if (effect.type == "Reference" && effect.id)
        {
            const auto found =
                std::find_if(library->begin(), library->end(),
                             [&](const HjifEffect& e) { return e.id == effect.id && e.type == "Basis"; });
            if (found != library->end())
                return &*found;
            report.warn(where, fmt::format("effect {} is not in the library; left out", *effect.id));
        }
        else if (effect.type == "Reference")
            report.fail(where + ".id", "is missing");
        else if (effect.type == "Composite")
            report.warn(where, "composite effects are not read; left out");
        else
            report.fail(where + ".effect_type",
                        fmt::format("must be Basis, Reference or Composite, not '{}'", shownText(effect.type)));
        return nullptr;
    }

    bool checkTimes(double position, const HjifEffect& effect, const std::string& where)
    {
        const double most = limits::duration * scale.ticks;
        if (!(position >= 0.0 && position <= most))
            report.fail(where + ".position", "must be 0 to 24 hours");
        double before = 0.0;
        for (std::size_t i = 0; i < effect.keyframes.size() && !report.error; ++i)
        {
            const HjifKeyframe& keyframe = effect.keyframes[i];
            const std::string place = fmt::format("{}.keyframes[{}]", where, i);
            if (!(keyframe.position >= 0.0 && position + keyframe.position <= most))
                report.fail(place + ".relative_position", "must be 0 to 24 hours");
            else if (keyframe.position < before)
                report.fail(place + ".relative_position", "is earlier than the keyframe before it");
            // Rounded decimals may pass the limit by a little; what is kept does not.
            if (keyframe.amplitude && std::abs(*keyframe.amplitude) * scale.level > 1.001 * limits::amplitude)
                report.fail(place + ".amplitude_modulation", "is more than a thousand times full drive");
            before = keyframe.position;
        }
        return !report.error;
    }

    void addEvents(const HjifEffect& effect, double position, const std::string& where)
    {
        for (const HjifKeyframe& keyframe : effect.keyframes)
        {
            if (!keyframe.amplitude)
            {
                report.warn(where, "a transient without amplitude is left out");
                continue;
            }
            const double frequency = keyframe.frequency.value_or(0.5 * (hjifDullFrequency + hjifSharpFrequency));
            const double sharpness =
                std::clamp((frequency - hjifDullFrequency) / (hjifSharpFrequency - hjifDullFrequency), 0.0, 1.0);
            const double time = (position + keyframe.position) / scale.ticks;
            const double amplitude = std::abs(*keyframe.amplitude) * scale.level / hjifTransientLevel(sharpness);
            clip.transients.push_back({time, std::min(amplitude, limits::amplitude), sharpness});
            latestEvent = std::max(latestEvent, time + hjifTransientLength);
        }
    }

    bool addPulse(const HjifEffect& effect, double position)
    {
        const auto event = hjifPulse(effect, position, scale);
        if (!event)
            return false;
        pulses.push_back(*event);
        latestEvent = std::max(latestEvent, (position + effect.keyframes.back().position) / scale.ticks);
        return true;
    }

    /// What was drawn becomes part of the clip. Bands beside it are not levelled to its envelope.
    void addWaveform()
    {
        if (waveform.empty() || report.error)
            return;
#ifdef PACINI_READERS_ONLY
        report.error = {
            ErrorCode::invalidData, "",
            "has waveforms, which this library does not translate; run 'pacini convert' on it and load the result"};
#else
        Clip translated = waveform.translated(wantedDuration);
        duration = std::max(duration, translated.duration);
        if (clip.bands.empty() && clip.transients.empty())
        {
            clip = std::move(translated);
            return;
        }
        LossList losses;
        Clip played = hjifVoicesOf(translated, losses).clip;
        std::move(played.bands.begin(), played.bands.end(), std::back_inserter(clip.bands));
        clip.transients.insert(clip.transients.end(), played.transients.begin(), played.transients.end());
#endif
    }

    void finish()
    {
        addWaveform();
        double lastEvent = 0.0;
        for (const Transient& event : clip.transients)
            lastEvent = std::max(lastEvent, event.time);
        // A stated length may cut the pulse of the last event, but nothing else.
        clip.duration =
            wantedDuration > 0.0 ? std::max({wantedDuration, duration, lastEvent}) : std::max(duration, latestEvent);
        for (Band& band : clip.bands)
            if (!band.amplitude.empty() && band.amplitude.back().value > 0.0 &&
                band.amplitude.back().time < clip.duration - 1e-9)
                band.amplitude.push_back({band.amplitude.back().time, 0.0});
        finishImported(clip);
    }

    HjifScale scale;               ///< of the channel being read
    std::vector<Transient> pulses; ///< of its short waves
    HjifWaveform waveform;
    bool drawn = false; ///< the channel being read, as far as it has no parameters
    const std::vector<HjifEffect>* library = nullptr;
    double duration = 0.0, latestEvent = 0.0, wantedDuration = 0.0;
};
} // namespace

Result<Clip> clipOfHjif(const HjifFile& file, std::vector<std::string>& warnings)
{
    HjifImporter importer(file, warnings);
    importer.add(file.perceptions);
    if (importer.report.error)
        return *importer.report.error;
    return std::move(importer.clip);
}

std::optional<Error> importHjif(const HjifFile& file, ImportedClip& imported)
{
    auto clip = clipOfHjif(file, imported.warnings);
    if (!clip)
        return clip.error();
    imported.clip = std::move(clip).value();
    imported.clip.name = importedName(file.description);
    if (imported.clip.bands.empty() && imported.clip.transients.empty())
    {
        const bool hadMore = std::any_of(file.perceptions.begin(), file.perceptions.end(),
                                         [](const HjifPerception& p) {
                                             return std::any_of(p.channels.begin(), p.channels.end(),
                                                                [](const HjifChannel& c) { return !c.bands.empty(); });
                                         });
        if (hadMore)
            return Error{ErrorCode::invalidData, "perceptions", "contain no vibration over time"};
        imported.warnings.push_back("perceptions: nothing is played");
    }
    return {};
}

} // namespace pacini
