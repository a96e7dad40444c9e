#include "io/formats/ForeignText.h"
#include "io/formats/LossList.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/haps/HapsFormat.h"

#include <pacini/foundation/NumberText.h>

#include <fmt/format.h>

#include <algorithm>

namespace pacini
{

namespace
{
constexpr int timeDigits = 5, levelDigits = 5, frequencyDigits = 2;
constexpr double usualAmplitudePoints = 60.0, usualFrequencyPoints = 20.0;

std::string keyframes(const Curve& curve, int digits)
{
    std::string text;
    for (const Breakpoint& point : curve)
        text += fmt::format("{}\n                  {{\"m_time\": {}, \"m_value\": {}}}", text.empty() ? "" : ",",
                            shortDecimalText(point.time, timeDigits), shortDecimalText(point.value, digits));
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
} // namespace

Result<ExportedClip> writeHaps(const Clip& clip, const ExportParams& params)
{
    auto [voice, losses] = reducedVoice(clip, params, hapsMotorFrequency); // players take gains of notes above 1
    if (!isSingleVoice(clip) || params.amplitudePoints)
    {
        const Curve before = voice.amplitude;
        voice.amplitude = thinned(before, params.amplitudePoints.value_or(usualAmplitudePoints), voice.duration);
        losses.addThinned(before, voice.amplitude);
    }
    if (!isSingleVoice(clip) || params.frequencyPoints)
        voice.frequency =
            thinned(voice.frequency, params.frequencyPoints.value_or(usualFrequencyPoints), voice.duration);
    std::string transients;
    for (const Transient& event : voice.events)
    {
        losses.add(LossKind::event, event.time, 0.0, 0.0, "events have no sharpness");
        transients += fmt::format(R"({}
          {{"m_startingPoint": {}, "m_length": {}, "m_priority": 0, "m_gain": {}, "m_hapticEffect": {{"m_type": 0}}}})",
                                  transients.empty() ? "" : ",", shortDecimalText(event.time, timeDigits),
                                  hapsTransientLength, shortDecimalText(event.amplitude, levelDigits));
    }
    const std::string note =
        fmt::format(R"(
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
                    shortDecimalText(voice.duration, timeDigits), keyframes(voice.amplitude, levelDigits),
                    keyframes(voice.frequency, frequencyDigits));
    const std::string melodies = melody(transients) + "," + melody(note) + "\n    ";
    return oneFile(fmt::format(R"({{
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
                               perception("m_texture", ""), perception("m_stiffness", "")),
                   std::move(losses));
}

} // namespace pacini
