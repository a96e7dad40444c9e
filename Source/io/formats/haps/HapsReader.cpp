#include "io/FieldsReader.h"
#include "io/formats/ForeignText.h"
#include "io/formats/ImportReport.h"
#include "io/formats/haps/HapsFormat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t maxElements = 5'000'000;

/// Numbers that some writer leaves out are told from 0.
struct Keyframe
{
    std::optional<double> time, value;
};

struct HapticEffect
{
    std::optional<double> type;
    std::vector<Keyframe> amplitude, frequency;
};

struct Note
{
    std::optional<double> statedStart, statedLength;
    double start = 0.0, length = 0.0, gain = 1.0;
    HapticEffect effect;
};

struct Melody
{
    double gain = 1.0, mute = 0.0;
    std::vector<Note> notes;
};

struct Vibration
{
    double gain = 1.0, maximum = 1.0, loop = 0.0;
    std::vector<Melody> melodies;
};

void readModulation(FieldsReader& reader, const char* name, std::vector<Keyframe>& keyframes)
{
    reader.object(name, keyframes, Need::optional,
                  [&](std::vector<Keyframe>& points)
                  {
                      reader.list("m_keyframes", points, maxElements, "keyframes",
                                  [&](Keyframe& keyframe)
                                  {
                                      reader.optionalNumber("m_time", keyframe.time);
                                      reader.optionalNumber("m_value", keyframe.value);
                                  });
                  });
}

void readVibration(FieldsReader& reader, Vibration& vibration)
{
    reader.number("m_gain", vibration.gain, Need::optional);
    reader.number("m_maximum", vibration.maximum, Need::optional);
    reader.number("m_loop", vibration.loop, Need::optional);
    reader.list("m_melodies", vibration.melodies, 100'000, "melodies",
                [&](Melody& melody)
                {
                    reader.number("m_gain", melody.gain, Need::optional);
                    reader.number("m_mute", melody.mute, Need::optional);
                    reader.list("m_notes", melody.notes, maxElements, "notes",
                                [&](Note& note)
                                {
                                    reader.optionalNumber("m_startingPoint", note.statedStart);
                                    note.start = note.statedStart.value_or(0.0);
                                    reader.optionalNumber("m_length", note.statedLength);
                                    note.length = note.statedLength.value_or(0.0);
                                    reader.number("m_gain", note.gain, Need::optional);
                                    reader.object("m_hapticEffect", note.effect, Need::optional,
                                                  [&](HapticEffect& effect)
                                                  {
                                                      reader.optionalNumber("m_type", effect.type);
                                                      readModulation(reader, "m_amplitudeModulation", effect.amplitude);
                                                      readModulation(reader, "m_frequencyModulation", effect.frequency);
                                                  });
                                });
                });
}

class HapsImporter
{
public:
    explicit HapsImporter(std::vector<std::string>& warnings) : report(warnings) {}

    ImportReport report;
    Clip clip;

    void add(const Vibration& vibration, double fileGain)
    {
        for (std::size_t m = 0; m < vibration.melodies.size() && !report.error; ++m)
        {
            const Melody& melody = vibration.melodies[m];
            const std::string where = fmt::format("m_vibration.m_melodies[{}]", m);
            if (melody.mute != 0.0)
            {
                report.warn(where, "is muted and left out");
                continue;
            }
            ImportLanes lanes;
            for (std::size_t n = 0; n < melody.notes.size() && !report.error; ++n)
                addNote(melody.notes[n], fileGain * vibration.gain * melody.gain, lanes,
                        fmt::format("{}.m_notes[{}]", where, n));
            for (Band& lane : lanes.bands)
                finishBand(lane);
        }
        finishImported(clip);
    }

private:
    void addNote(const Note& note, double outerGain, ImportLanes& lanes, const std::string& where)
    {
        if (!note.statedStart)
            report.warn(where + ".m_startingPoint", "is missing; the note is read as starting at 0");
        if (!(note.start >= 0.0 && note.start <= limits::duration))
            return report.fail(where + ".m_startingPoint", "must be 0 to 24 hours");
        if (!(note.length >= 0.0 && note.start + note.length <= limits::duration))
            return report.fail(where + ".m_length", "must be 0 to 24 hours");
        const double gain = outerGain * note.gain;
        if (!(gain >= 0.0 && gain <= limits::amplitude))
            return report.fail(where + ".m_gain", "makes a gain outside 0 to 1000");
        if (note.effect.amplitude.empty())
            addTransient(note, gain, where);
        else
            addWave(note, gain, lanes, where);
    }

    void addTransient(const Note& note, double gain, const std::string& where)
    {
        if (!note.effect.type)
            report.warn(where, "has neither a type nor an amplitude and is read as a transient");
        constexpr double plain = 0.5;
        clip.transients.push_back({note.start, gain, plain});
        const double end = note.start + std::max(note.length, hapsTransientLength); // players know one length only
        clip.duration = std::max(clip.duration, std::min(end, limits::duration));
    }

    /// The keyframes of a note in the time of the clip, moved into `low` to `high` and scaled.
    Curve curveOf(const Note& note, const std::vector<Keyframe>& keyframes, double low, double high, double scale,
                  const std::string& where)
    {
        Curve curve;
        for (std::size_t i = 0; i < keyframes.size(); ++i)
        {
            const std::string place = fmt::format("{}.m_keyframes[{}]", where, i);
            for (const auto& [name, number] :
                 {std::pair(".m_time", keyframes[i].time), std::pair(".m_value", keyframes[i].value)})
                if (!number)
                    report.warn(place + name, "is missing and read as 0");
            const double offset = keyframes[i].time.value_or(0.0);
            const double time = note.start + offset;
            if (!(offset >= 0.0 && time <= limits::duration))
            {
                report.fail(place + ".m_time", offset < 0.0 ? "is negative" : "is later than 24 hours");
                return curve;
            }
            double value = keyframes[i].value.value_or(0.0);
            if (!(value >= low && value <= high))
            {
                report.warn(place + ".m_value",
                            fmt::format("is outside of {} to {} and is limited to this range", low, high));
                value = std::clamp(value, low, high);
            }
            curve.push_back({time, value * scale});
        }
        const auto earlier = [](const Breakpoint& a, const Breakpoint& b)
        {
            return a.time < b.time;
        };
        if (!std::is_sorted(curve.begin(), curve.end(), earlier))
        {
            report.warn(where + ".m_keyframes", "are not in order of time and are sorted");
            std::stable_sort(curve.begin(), curve.end(), earlier);
        }
        return curve;
    }

    /// Some writers keep the frequencies of a .haptic, 0 to 1, which nobody would feel as Hz.
    Curve pitchOf(const Note& note, const std::string& where)
    {
        std::vector<Keyframe> keyframes = note.effect.frequency;
        const auto isAtMost = [](double most)
        {
            return [most](const Keyframe& keyframe)
            {
                return std::abs(keyframe.value.value_or(0.0)) <= most;
            };
        };
        if (keyframes.empty() || !std::all_of(keyframes.begin(), keyframes.end(), isAtMost(1.0)))
            return curveOf(note, keyframes, 1.0, 20000.0, 1.0, where);
        if (std::all_of(keyframes.begin(), keyframes.end(), isAtMost(0.0)))
        {
            report.warn(where, fmt::format("is 0 throughout; the note plays at {} Hz", hapsMotorFrequency));
            return {};
        }
        report.warn(where, fmt::format("has no value above 1 Hz; they are read as fractions of {} to {} Hz",
                                       hapsLowestFraction, hapsHighestFraction));
        for (Keyframe& keyframe : keyframes)
            keyframe.value =
                std::lerp(hapsLowestFraction, hapsHighestFraction, std::max(keyframe.value.value_or(0.0), 0.0));
        return curveOf(note, keyframes, 1.0, 20000.0, 1.0, where);
    }

    void addWave(const Note& note, double gain, ImportLanes& lanes, const std::string& where)
    {
        Curve amplitude =
            curveOf(note, note.effect.amplitude, 0.0, 1.0, gain, where + ".m_hapticEffect.m_amplitudeModulation");
        Curve pitch = pitchOf(note, where + ".m_hapticEffect.m_frequencyModulation");
        if (report.error)
            return;
        double end = std::max(note.start, amplitude.back().time);
        const double stated = note.start + note.length;
        if (!note.statedLength)
            report.warn(where + ".m_length", "is missing; the note lasts until its last keyframe");
        else if (end > stated + 1e-3)
            report.warn(where + ".m_length", "ends before its keyframes; they are kept");
        else if (end < stated)
            amplitude.push_back({end = stated, amplitude.back().value});

        Band* band = lanes.take(note.start, end, limits::bands - std::min(clip.bands.size(), limits::bands));
        if (band == nullptr)
            return report.fail(where, "plays at the same time as 256 others", ErrorCode::tooLarge);
        if (note.start > 0.0 && amplitude.front().value > 0.0)
            band->amplitude.push_back({note.start, 0.0});
        if (note.start < amplitude.front().time)
            amplitude.insert(amplitude.begin(), {note.start, amplitude.front().value});
        band->amplitude.insert(band->amplitude.end(), amplitude.begin(), amplitude.end());
        if (amplitude.back().value > 0.0)
            band->amplitude.push_back({end, 0.0});
        clip.duration = std::max(clip.duration, end);
        if (pitch.empty())
            pitch = {{note.start, hapsMotorFrequency}};
        for (Breakpoint& point : pitch)
            if (band->pitch.empty() || band->pitch.back().time <= point.time)
                band->pitch.push_back({std::min(point.time, end), point.value});
    }

    void finishBand(Band& band)
    {
        // What ends with the clip needs no step to silence.
        const std::size_t n = band.amplitude.size();
        if (n > 1 && band.amplitude[n - 1].time >= clip.duration &&
            band.amplitude[n - 2].time == band.amplitude[n - 1].time)
            band.amplitude.pop_back();
        const auto lower = [](const Breakpoint& a, const Breakpoint& b)
        {
            return a.value < b.value;
        };
        const auto [low, high] = std::minmax_element(band.pitch.begin(), band.pitch.end(), lower);
        band.lowFrequency = low->value;
        band.highFrequency = high->value;
        band.centreFrequency = std::clamp(std::sqrt(low->value * high->value), band.lowFrequency, band.highFrequency);
        if (band.lowFrequency == band.highFrequency)
            band.pitch.clear();
        clip.bands.push_back(std::move(band));
    }
};

/// Whether a perception, or one of a list of them, has melodies.
bool hasMelodies(const nlohmann::json& perception)
{
    if (perception.is_array())
        return std::any_of(perception.begin(), perception.end(), hasMelodies);
    const auto melodies = perception.find("m_melodies"); // nothing in what is no object
    return melodies != perception.end() && melodies->is_array() && !melodies->empty();
}

std::optional<Error> readHapsEffect(const nlohmann::json& tree, ImportedClip& imported)
{
    FieldsReader reader(tree);
    const auto version = tree.find("m_version");
    const std::string stated = version == tree.end() ? ""
                               : version->is_string()
                                   ? version->get<std::string>()
                                   : version->dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (stated.empty())
        reader.fail("m_version", "is missing");
    else if (stated != "5" && !stated.starts_with("5."))
        reader.fail("m_version", fmt::format("is '{}'; this program reads version 5", shownText(stated)),
                    ErrorCode::unsupportedVersion);
    std::string description;
    double gain = 1.0, timeUnit = 0.0;
    Vibration vibration;
    reader.optionalText("m_description", description);
    reader.number("m_gain", gain, Need::optional);
    reader.number("m_time_unit", timeUnit, Need::optional);
    reader.object("m_vibration", vibration, Need::required, [&](Vibration& inner) { readVibration(reader, inner); });
    if (reader.error)
        return reader.error;
    for (const char* name : {"m_texture", "m_stiffness"})
    {
        if (const auto other = tree.find(name); other != tree.end() && hasMelodies(*other))
            imported.warnings.push_back(fmt::format("{}: is not read", name));
    }
    // No public text says what other numbers mean; all files that are known have these.
    HapsImporter importer(imported.warnings);
    if (timeUnit != 0.0)
        importer.report.warn("m_time_unit", fmt::format("is {}; only 0 is known, and the times are read as seconds; "
                                                        "compare the length of the clip",
                                                        timeUnit));
    if (vibration.loop != 0.0)
        importer.report.warn("m_vibration.m_loop",
                             "says that the effect is repeated, which a clip does not; it is read "
                             "once; repeat it in a scene");
    if (vibration.maximum != 1.0)
        importer.report.warn(
            "m_vibration.m_maximum",
            fmt::format("is {}; only 1 is known, and the levels are read as they are", vibration.maximum));
    importer.add(vibration, gain);
    if (importer.report.error)
        return importer.report.error;
    imported.clip = std::move(importer.clip);
    imported.clip.name = importedName(description);
    if (imported.clip.bands.empty() && imported.clip.transients.empty())
        imported.warnings.emplace_back("m_vibration: nothing is played");
    return {};
}
} // namespace

bool isHaps(std::string_view bytes)
{
    return bytes.find("\"m_vibration\"") != std::string_view::npos;
}

Result<ImportedClip> readHaps(std::string_view bytes)
{
    return importForeign(bytes, readHapsEffect);
}

} // namespace pacini
