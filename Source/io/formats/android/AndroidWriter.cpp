#include "io/formats/ForeignText.h"
#include "io/formats/android/AndroidEffects.h"
#include "io/formats/android/AndroidFormat.h"
#include "io/formats/android/AndroidText.h"

#include <fmt/format.h>

namespace pacini
{

namespace
{
std::string jsonPoints(const std::vector<AndroidPoint>& points, const char* level, const char* frequency)
{
    std::string text;
    for (const AndroidPoint& point : points)
        text += fmt::format("{}\n      {{\"{}\": {}, \"{}\": {}, \"durationMs\": {}}}", text.empty() ? "" : ",", level,
                            decimal(point.amplitude, 4), frequency, decimal(point.frequency, 4), point.duration);
    return text;
}

std::string xmlDocument(const std::string& effect)
{
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<vibration-effect>\n{}</vibration-effect>\n",
                       effect);
}

std::string xmlEnvelope(const AndroidEnvelope& envelope, const char* tag, const char* initial, const char* level,
                        const char* frequency)
{
    std::string text = fmt::format("  <{} {}=\"{}\">\n", tag, initial, decimal(envelope.initialFrequency, 4));
    for (const AndroidPoint& point : envelope.points)
        text += fmt::format("    <control-point {}=\"{}\" {}=\"{}\" durationMs=\"{}\"/>\n", level,
                            decimal(point.amplitude, 4), frequency, decimal(point.frequency, 4), point.duration);
    return text + fmt::format("  </{}>\n", tag);
}
} // namespace

bool isAndroidJson(std::string_view bytes)
{
    constexpr auto none = std::string_view::npos;
    return (bytes.find("\"timings\"") != none && bytes.find("\"amplitudes\"") != none) ||
           bytes.find("\"controlPoints\"") != none;
}

bool isAndroidXml(std::string_view bytes)
{
    return bytes.find("<vibration-effect>") != std::string_view::npos;
}

Result<ExportedClip> writeAndroidJson(const Clip& clip, const ExportParams& params)
{
    AndroidExport made = androidEffectsOf(clip, params);
    const AndroidEffects& effects = made.effects;
    return oneFile(fmt::format(R"({{
  "name": {},
  "waveform": {{
    "timings": [{}
    ],
    "amplitudes": [{}
    ],
    "repeat": -1
  }},
  "basicEnvelope": {{
    "initialSharpness": {},
    "controlPoints": [{}
    ]
  }},
  "waveformEnvelope": {{
    "initialFrequencyHz": {},
    "controlPoints": [{}
    ]
  }}
}}
)",
                               inQuotes(nameOfClip(clip, params.name)), timingsOf(effects.waveform, "      "),
                               amplitudesOf(effects.waveform, "      "), decimal(effects.basic.initialFrequency, 4),
                               jsonPoints(effects.basic.points, "intensity", "sharpness"),
                               decimal(effects.envelope.initialFrequency, 4),
                               jsonPoints(effects.envelope.points, "amplitude", "frequencyHz")),
                   std::move(made.losses));
}

Result<ExportedClip> writeAndroidXml(const Clip& clip, const ExportParams& params)
{
    AndroidExport made = androidEffectsOf(clip, params);
    std::string waveform = "  <waveform-effect>\n";
    for (const AndroidStep& step : made.effects.waveform)
        waveform +=
            fmt::format("    <waveform-entry durationMs=\"{}\" amplitude=\"{}\"/>\n", step.duration, step.amplitude);
    waveform += "  </waveform-effect>\n";
    ExportedClip result = oneFile(xmlDocument(waveform), std::move(made.losses));
    if (params.split)
    {
        result.files.push_back(
            {"-basic-envelope", xmlDocument(xmlEnvelope(made.effects.basic, "basic-envelope-effect", "initialSharpness",
                                                        "intensity", "sharpness"))});
        result.files.push_back(
            {"-waveform-envelope", xmlDocument(xmlEnvelope(made.effects.envelope, "waveform-envelope-effect",
                                                           "initialFrequencyHz", "amplitude", "frequencyHz"))});
    }
    return result;
}

} // namespace pacini
