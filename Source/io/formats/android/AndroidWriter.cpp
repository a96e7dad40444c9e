#include "io/formats/ForeignText.h"
#include "io/formats/android/AndroidEffects.h"
#include "io/formats/android/AndroidFormat.h"

#include <pacini/foundation/NumberText.h>

#include <fmt/format.h>

#include <utility>

namespace pacini
{

namespace
{
/// A number of each step, twelve to a line after `indent`.
std::string numbersOf(const std::vector<AndroidStep>& steps, const char* indent, auto AndroidStep::*number)
{
    constexpr std::size_t perLine = 12;
    return numbersInLines(
        steps, perLine, [&](const AndroidStep& step) { return fmt::format("{}", step.*number); }, indent);
}

std::string jsonPoints(const std::vector<AndroidPoint>& points, const char* level, const char* frequency)
{
    std::string text;
    for (const AndroidPoint& point : points)
        text += fmt::format("{}\n      {{\"{}\": {}, \"{}\": {}, \"durationMs\": {}}}", text.empty() ? "" : ",", level,
                            shortDecimalText(point.amplitude, 4), frequency, shortDecimalText(point.frequency, 4),
                            point.duration);
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
    std::string text = fmt::format("  <{} {}=\"{}\">\n", tag, initial, shortDecimalText(envelope.initialFrequency, 4));
    for (const AndroidPoint& point : envelope.points)
        text += fmt::format("    <control-point {}=\"{}\" {}=\"{}\" durationMs=\"{}\"/>\n", level,
                            shortDecimalText(point.amplitude, 4), frequency, shortDecimalText(point.frequency, 4),
                            point.duration);
    return text + fmt::format("  </{}>\n", tag);
}

/// A name in camel case, as functions of Kotlin and Java have it.
std::string functionName(const Clip& clip, const ExportParams& params)
{
    std::string name;
    bool upper = true;
    for (const char c : identifierOf(nameOfClip(clip, params.name)))
    {
        if (c == '_')
            upper = true;
        else
        {
            name += upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
            upper = false;
        }
    }
    return "vibrationOf" + name;
}

std::string builderCalls(const std::vector<AndroidPoint>& points)
{
    std::string text;
    for (const AndroidPoint& point : points)
        text += fmt::format("            .addControlPoint({}f, {}f, {})\n", shortDecimalText(point.amplitude, 4),
                            shortDecimalText(point.frequency, 4), point.duration);
    return text;
}

std::string waveformEnvelopeXml(const AndroidEnvelope& envelope)
{
    return xmlDocument(
        xmlEnvelope(envelope, "waveform-envelope-effect", "initialFrequencyHz", "amplitude", "frequencyHz"));
}

std::string basicEnvelopeXml(const AndroidEnvelope& envelope)
{
    return xmlDocument(xmlEnvelope(envelope, "basic-envelope-effect", "initialSharpness", "intensity", "sharpness"));
}
} // namespace

Result<ExportedClip> writeAndroidJson(const Clip& clip, const ExportParams& params)
{
    auto made = androidEffectsOf(clip, params);
    if (!made)
        return made.error();
    const AndroidEffects& effects = made->effects;
    return oneFile(fmt::format(
                       R"({{
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
                       inQuotes(nameOfClip(clip, params.name)),
                       numbersOf(effects.waveform, "      ", &AndroidStep::duration),
                       numbersOf(effects.waveform, "      ", &AndroidStep::amplitude),
                       shortDecimalText(effects.basic.initialFrequency, 4),
                       jsonPoints(effects.basic.points, "intensity", "sharpness"),
                       shortDecimalText(effects.envelope.initialFrequency, 4),
                       jsonPoints(effects.envelope.points, "amplitude", "frequencyHz")),
                   std::move(made->losses));
}

Result<ExportedClip> writeAndroidXml(const Clip& clip, const ExportParams& params)
{
    auto made = androidEffectsOf(clip, params);
    if (!made)
        return made.error();
    std::string waveform = "  <waveform-effect>\n";
    for (const AndroidStep& step : made->effects.waveform)
        waveform +=
            fmt::format("    <waveform-entry durationMs=\"{}\" amplitude=\"{}\"/>\n", step.duration, step.amplitude);
    waveform += "  </waveform-effect>\n";
    ExportedClip result = oneFile(xmlDocument(waveform), std::move(made->losses));
    if (params.split)
    {
        result.files.push_back({"-basic-envelope", basicEnvelopeXml(made->effects.basic)});
        result.files.push_back({"-waveform-envelope", waveformEnvelopeXml(made->effects.envelope)});
    }
    return result;
}

Result<ExportedClip> writeAndroidEnvelopeXml(const Clip& clip, const ExportParams& params)
{
    auto made = androidEnvelopeOf(clip, params, false);
    if (!made)
        return made.error();
    return oneFile(waveformEnvelopeXml(made->envelope), std::move(made->losses));
}

Result<ExportedClip> writeAndroidBasicXml(const Clip& clip, const ExportParams& params)
{
    auto made = androidEnvelopeOf(clip, params, true);
    if (!made)
        return made.error();
    return oneFile(basicEnvelopeXml(made->envelope), std::move(made->losses));
}

Result<ExportedClip> writeAndroidKotlin(const Clip& clip, const ExportParams& params)
{
    auto made = androidEffectsOf(clip, params);
    if (!made)
        return made.error();
    return oneFile(fmt::format(R"(import android.os.Build
import android.os.VibrationEffect
import android.os.Vibrator

fun {}(vibrator: Vibrator): VibrationEffect {{
    if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {{
        return VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz({}f)
{}            .build()
    }}
    return VibrationEffect.createWaveform(
        longArrayOf({}
        ),
        intArrayOf({}
        ),
        -1
    )
}}
)",
                               functionName(clip, params), shortDecimalText(made->effects.envelope.initialFrequency, 4),
                               builderCalls(made->effects.envelope.points),
                               numbersOf(made->effects.waveform, "            ", &AndroidStep::duration),
                               numbersOf(made->effects.waveform, "            ", &AndroidStep::amplitude)),
                   std::move(made->losses));
}

Result<ExportedClip> writeAndroidJava(const Clip& clip, const ExportParams& params)
{
    auto made = androidEffectsOf(clip, params);
    if (!made)
        return made.error();
    const std::string function = functionName(clip, params);
    std::string type = function;
    type[0] = 'V';
    return oneFile(fmt::format(R"(import android.os.Build;
import android.os.VibrationEffect;
import android.os.Vibrator;

public final class {} {{
    private {}() {{}}

    public static VibrationEffect {}(Vibrator vibrator) {{
        if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {{
            return new VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz({}f)
{}            .build();
        }}
        return VibrationEffect.createWaveform(
            new long[] {{{}
            }},
            new int[] {{{}
            }},
            -1);
    }}
}}
)",
                               type, type, function, shortDecimalText(made->effects.envelope.initialFrequency, 4),
                               builderCalls(made->effects.envelope.points),
                               numbersOf(made->effects.waveform, "                ", &AndroidStep::duration),
                               numbersOf(made->effects.waveform, "                ", &AndroidStep::amplitude)),
                   std::move(made->losses));
}

} // namespace pacini
