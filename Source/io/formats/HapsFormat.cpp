#include "io/formats/HapsFormat.h"

#include "io/FieldsReader.h"
#include "io/formats/ForeignText.h"
#include "io/formats/LossList.h"
#include "io/formats/PlayedClip.h"

#include <pacini/clip/BandPriority.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pacini
{

namespace
{
constexpr std::size_t mostElements = 5'000'000;
constexpr double transientLength = 0.022; // s, what Interhaptics' own files state
constexpr int timeDigits = 5, levelDigits = 5, frequencyDigits = 2;
constexpr double usualAmplitudePoints = 60.0, usualFrequencyPoints = 20.0;
constexpr double motorFrequency = 150.0; // Hz, of notes without frequency

struct Keyframe
{
    double time = 0.0, value = 0.0;
};

struct HapticEffect
{
    std::optional<double> type;
    std::vector<Keyframe> amplitude, frequency;
};

struct Note
{
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
    double gain = 1.0;
    std::vector<Melody> melodies;
};

void readModulation(FieldsReader& reader, const char* name, std::vector<Keyframe>& keyframes)
{
    reader.object(name, keyframes, Need::optional,
                  [&](std::vector<Keyframe>& points)
                  {
                      reader.list("m_keyframes", points, mostElements, "keyframes",
                                  [&](Keyframe& keyframe)
                                  {
                                      reader.number("m_time", keyframe.time, Need::required);
                                      reader.number("m_value", keyframe.value, Need::required);
                                  });
                  });
}

void readVibration(FieldsReader& reader, Vibration& vibration)
{
    reader.number("m_gain", vibration.gain, Need::optional);
    reader.list("m_melodies", vibration.melodies, 100'000, "melodies",
                [&](Melody& melody)
                {
                    reader.number("m_gain", melody.gain, Need::optional);
                    reader.number("m_mute", melody.mute, Need::optional);
                    reader.list("m_notes", melody.notes, mostElements, "notes",
                                [&](Note& note)
                                {
                                    reader.number("m_startingPoint", note.start, Need::required);
                                    reader.number("m_length", note.length, Need::optional);
                                    reader.number("m_gain", note.gain, Need::optional);
                                    reader.object("m_hapticEffect", note.effect, Need::required,
                                                  [&](HapticEffect& effect)
                                                  {
                                                      reader.optionalNumber("m_type", effect.type);
                                                      readModulation(reader, "m_amplitudeModulation", effect.amplitude);
                                                      readModulation(reader, "m_frequencyModulation", effect.frequency);
                                                  });
                                });
                });
}

class Importer
{
public:
    explicit Importer(std::vector<std::string>& warningsToFill) : warnings(warningsToFill) {}

    std::optional<Error> error;
    Clip clip;

    void add(const Vibration& vibration, double fileGain)
    {
        for (std::size_t m = 0; m < vibration.melodies.size() && !error; ++m)
        {
            const Melody& melody = vibration.melodies[m];
            const std::string where = fmt::format("m_vibration.m_melodies[{}]", m);
            if (melody.mute != 0.0)
            {
                warn(where, "is muted and left out");
                continue;
            }
            std::vector<Band> lanes;
            std::vector<double> ends;
            for (std::size_t n = 0; n < melody.notes.size() && !error; ++n)
                addNote(melody.notes[n], fileGain * vibration.gain * melody.gain, lanes, ends,
                        fmt::format("{}.m_notes[{}]", where, n));
            for (Band& lane : lanes)
                finishBand(lane);
        }
        std::stable_sort(clip.transients.begin(), clip.transients.end(),
                         [](const Transient& a, const Transient& b) { return a.time < b.time; });
        std::vector<double> energies;
        for (const Band& band : clip.bands)
            energies.push_back(curveEnergy(band.amplitude, clip.duration));
        const auto priorities = prioritiesByEnergy(energies);
        for (std::size_t i = 0; i < clip.bands.size(); ++i)
            clip.bands[i].priority = priorities[i];
    }

private:
    void warn(const std::string& where, std::string_view message)
    {
        constexpr std::size_t most = 50;
        if (warnings.size() < most)
            warnings.push_back(fmt::format("{}: {}", where, message));
    }

    void fail(std::string where, std::string message, ErrorCode code = ErrorCode::invalidData)
    {
        if (!error)
            error = Error{code, std::move(where), std::move(message)};
    }

    void addNote(const Note& note, double outerGain, std::vector<Band>& lanes, std::vector<double>& ends,
                 const std::string& where)
    {
        if (!(note.start >= 0.0 && note.start <= limits::duration))
            return fail(where + ".m_startingPoint", "must be 0 to 24 hours");
        if (!(note.length >= 0.0 && note.start + note.length <= limits::duration))
            return fail(where + ".m_length", "must be 0 to 24 hours");
        const double gain = outerGain * note.gain;
        if (!(gain >= 0.0 && gain <= limits::amplitude))
            return fail(where + ".m_gain", "makes a gain outside 0 to 1000");
        if (note.effect.amplitude.empty())
        {
            if (!note.effect.type)
                warn(where, "has neither a type nor an amplitude; taken for a transient");
            constexpr double plain = 0.5;
            clip.transients.push_back({note.start, gain, plain});
            clip.duration = std::max(clip.duration, note.start + note.length);
            return;
        }
        Curve amplitude, pitch;
        double end = note.start;
        const auto read = [&](const std::vector<Keyframe>& keyframes, const char* name, double low, double high,
                              double scale, Curve& curve)
        {
            double before = 0.0;
            for (std::size_t i = 0; i < keyframes.size(); ++i)
            {
                const std::string place = fmt::format("{}.m_hapticEffect.{}.m_keyframes[{}]", where, name, i);
                const double time = note.start + keyframes[i].time;
                if (!(keyframes[i].time >= before && time <= limits::duration))
                    return fail(place + ".m_time", keyframes[i].time >= before ? "is later than 24 hours"
                                                   : keyframes[i].time < 0.0
                                                       ? "is negative"
                                                       : "is earlier than the keyframe before it");
                before = keyframes[i].time;
                double value = keyframes[i].value;
                if (!(value >= low && value <= high))
                {
                    warn(place + ".m_value", fmt::format("is outside {} to {} and moved there", low, high));
                    value = std::clamp(value, low, high);
                }
                curve.push_back({time, value * scale});
            }
        };
        read(note.effect.amplitude, "m_amplitudeModulation", 0.0, 1.0, gain, amplitude);
        read(note.effect.frequency, "m_frequencyModulation", 1.0, 20000.0, 1.0, pitch);
        if (error)
            return;
        end = std::max(end, amplitude.back().time);
        const double stated = note.start + note.length;
        if (end > stated + 1e-3)
            warn(where + ".m_length", "ends before the keyframes; they are kept");
        else if (end < stated)
            amplitude.push_back({end = stated, amplitude.back().value});

        std::size_t lane = 0;
        while (lane < lanes.size() && ends[lane] > note.start)
            ++lane;
        if (lane == lanes.size())
        {
            if (clip.bands.size() + lanes.size() >= limits::bands)
                return fail(where, "sounds together with 256 others", ErrorCode::tooLarge);
            lanes.emplace_back();
            ends.push_back(0.0);
        }
        Band& band = lanes[lane];
        if (note.start > 0.0 && amplitude.front().value > 0.0)
            band.amplitude.push_back({note.start, 0.0});
        if (note.start < amplitude.front().time)
            amplitude.insert(amplitude.begin(), {note.start, amplitude.front().value});
        band.amplitude.insert(band.amplitude.end(), amplitude.begin(), amplitude.end());
        if (amplitude.back().value > 0.0)
            band.amplitude.push_back({end, 0.0});
        ends[lane] = end;
        clip.duration = std::max(clip.duration, end);
        if (pitch.empty())
            pitch = {{note.start, motorFrequency}};
        for (Breakpoint& point : pitch)
            if (band.pitch.empty() || band.pitch.back().time <= point.time)
                band.pitch.push_back({std::min(point.time, end), point.value});
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

    std::vector<std::string>& warnings;
};

std::string keyframes(const Curve& curve, int digits)
{
    std::string text;
    for (const Breakpoint& point : curve)
        text += fmt::format("{}\n                  {{\"m_time\": {}, \"m_value\": {}}}", text.empty() ? "" : ",",
                            decimal(point.time, timeDigits), decimal(point.value, digits));
    return text;
}

std::string perception(const char* name, const std::string& melodies)
{
    return fmt::format(R"(  "{}": {{
    "m_loop": 0,
    "m_maximum": 1,
    "m_gain": 1,
    "m_signalEvaluationMethod": 3,
    "m_melodies": [{}]
  }})",
                       name, melodies);
}

std::string melody(const std::string& notes)
{
    return fmt::format(
        "\n      {{\n        \"m_mute\": 0,\n        \"m_gain\": 1,\n        \"m_notes\": [{}]\n      }}", notes);
}

bool isHaps(std::string_view bytes)
{
    return bytes.find("\"m_vibration\"") != std::string_view::npos;
}
} // namespace

Result<ImportedClip> readHaps(std::string_view bytes)
{
    ImportedClip result;
    const auto tree = readForeignTree(bytes, result.warnings);
    if (!tree)
        return tree.error();
    FieldsReader reader(*tree);
    const auto version = tree->find("m_version");
    const std::string stated = version == tree->end() ? ""
                               : version->is_string()
                                   ? version->get<std::string>()
                                   : version->dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (stated.empty())
        reader.fail("m_version", "is missing");
    else if (stated != "5" && !stated.starts_with("5."))
        reader.fail("m_version", fmt::format("is '{}'; this program reads version 5", shownText(stated)),
                    ErrorCode::unsupportedVersion);
    std::string description;
    double gain = 1.0;
    Vibration vibration;
    reader.optionalText("m_description", description);
    reader.number("m_gain", gain, Need::optional);
    reader.object("m_vibration", vibration, Need::required, [&](Vibration& inner) { readVibration(reader, inner); });
    if (reader.error)
        return *reader.error;
    for (const char* name : {"m_texture", "m_stiffness"})
    {
        const auto other = tree->find(name);
        if (other == tree->end() || !other->is_object())
            continue;
        const auto melodies = other->find("m_melodies");
        if (melodies != other->end() && melodies->is_array() && !melodies->empty())
            result.warnings.push_back(fmt::format("{}: is not read", name));
    }
    Importer importer(result.warnings);
    importer.add(vibration, gain);
    if (importer.error)
        return *importer.error;
    result.clip = std::move(importer.clip);
    result.clip.name = description.substr(0, limits::text / 2);
    if (result.clip.bands.empty() && result.clip.transients.empty())
        result.warnings.emplace_back("m_vibration: nothing sounds");
    if (auto valid = validate(result.clip); !valid)
        return valid.error();
    return result;
}

Result<ExportedClip> writeHaps(const Clip& clip, const ExportParams& params)
{
    SingleVoice voice = oneVoice(clip, params.profile, motorFrequency);
    LossList losses;
    losses.addOneVoice(clip, voice, true);
    if (!isSingleVoice(clip) || params.amplitudePoints)
    {
        const Curve before = voice.amplitude;
        voice.amplitude = thinned(before, params.amplitudePoints.value_or(usualAmplitudePoints), voice.duration);
        losses.addThinned(before, voice.amplitude, voice.duration);
    }
    if (!isSingleVoice(clip) || params.frequencyPoints)
        voice.frequency =
            thinned(voice.frequency, params.frequencyPoints.value_or(usualFrequencyPoints), voice.duration);
    losses.addAbove(voice.amplitude, 1.0);
    for (Breakpoint& point : voice.amplitude)
        point.value = std::min(point.value, 1.0);

    std::string transients;
    for (const Transient& event : voice.events)
    {
        losses.add(LossKind::event, event.time, 0.0, 0.0, "events have no sharpness");
        transients += fmt::format(R"({}
          {{"m_startingPoint": {}, "m_length": {}, "m_priority": 0, "m_gain": {}, "m_hapticEffect": {{"m_type": 0}}}})",
                                  transients.empty() ? "" : ",", decimal(event.time, timeDigits), transientLength,
                                  decimal(event.amplitude, levelDigits));
    }
    const std::string note = fmt::format(R"(
          {{
            "m_startingPoint": 0, "m_length": {}, "m_priority": 1, "m_gain": 1,
            "m_hapticEffect": {{
              "m_amplitudeModulation": {{
                "m_extrapolationStrategy": 0,
                "m_keyframes": [{}
                ]
              }},
              "m_frequencyModulation": {{
                "m_extrapolationStrategy": 0,
                "m_keyframes": [{}
                ]
              }}
            }}
          }}
        )",
                                         decimal(voice.duration, timeDigits), keyframes(voice.amplitude, levelDigits),
                                         keyframes(voice.frequency, frequencyDigits));
    const std::string melodies = melody(transients) + "," + melody(note) + "\n    ";
    ExportedClip result;
    result.files.push_back(
        {"", fmt::format(R"({{
  "m_version": "5",
  "m_description": {},
  "m_HDFlag": 0,
  "m_time_unit": 0,
  "m_length_unit": 7,
  "m_gain": 1,
{},
{},
{}
}}
)",
                         inQuotes(nameOfClip(clip, params.name)), perception("m_vibration", melodies),
                         perception("m_texture", ""), perception("m_stiffness", ""))});
    result.losses = std::move(losses).sorted();
    return result;
}

const ForeignFormat& hapsFormat()
{
    static constexpr ForeignFormat format{"haps", "Interhaptics, version 5", ".haps", isHaps, readHaps, writeHaps};
    return format;
}

} // namespace pacini
