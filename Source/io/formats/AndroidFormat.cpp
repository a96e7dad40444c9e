#include "io/formats/AndroidFormat.h"

#include "io/FieldsReader.h"
#include "io/formats/AndroidEffects.h"
#include "io/formats/ForeignText.h"

#include <fmt/format.h>

#include <cmath>

namespace pacini
{

namespace
{
constexpr std::size_t mostPoints = 5'000'000;
constexpr double longestMs = limits::duration * 1000.0;

/// `values` in lines of twelve, each after `indent`.
template <typename List, typename Write>
std::string inLines(const List& values, const char* indent, Write write)
{
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        if (i % 12 == 0)
            text += fmt::format("\n{}", indent);
        text += write(values[i]);
        if (i + 1 < values.size())
            text += i % 12 == 11 ? "," : ", ";
    }
    return text;
}

std::string jsonPoints(const std::vector<AndroidPoint>& points, const char* level, const char* frequency)
{
    std::string text;
    for (const AndroidPoint& point : points)
        text += fmt::format("{}\n      {{\"{}\": {}, \"{}\": {}, \"durationMs\": {}}}", text.empty() ? "" : ",", level,
                            decimal(point.amplitude, 4), frequency, decimal(point.frequency, 4), point.duration);
    return text;
}

std::string timingsOf(const std::vector<AndroidStep>& steps, const char* indent)
{
    return inLines(steps, indent, [](const AndroidStep& step) { return fmt::format("{}", step.duration); });
}

std::string amplitudesOf(const std::vector<AndroidStep>& steps, const char* indent)
{
    return inLines(steps, indent, [](const AndroidStep& step) { return fmt::format("{}", step.amplitude); });
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
        text += fmt::format("            .addControlPoint({}f, {}f, {})\n", decimal(point.amplitude, 4),
                            decimal(point.frequency, 4), point.duration);
    return text;
}

class AndroidReader
{
public:
    AndroidReader(const nlohmann::json& tree, std::vector<std::string>& warningsToFill)
        : reader(tree), warnings(warningsToFill)
    {
    }

    FieldsReader reader;

    Clip waveform()
    {
        std::vector<AndroidStep> steps;
        int unused = 0;
        reader.object(
            "waveform", unused, Need::required,
            [&](int&)
            {
                std::vector<double> timings, amplitudes;
                int repeat = -1;
                reader.numbers("timings", timings, mostPoints);
                reader.numbers("amplitudes", amplitudes, mostPoints);
                reader.integer("repeat", repeat, "must be a whole number");
                if (timings.size() != amplitudes.size())
                    reader.fail("amplitudes",
                                fmt::format("has {} numbers beside {} timings", amplitudes.size(), timings.size()));
                if (repeat >= 0)
                    warnings.emplace_back("waveform.repeat: the effect is read once");
                double sum = 0.0;
                bool isDefault = false;
                for (std::size_t i = 0; i < timings.size() && !reader.error; ++i)
                {
                    checkDuration(fmt::format("timings[{}]", i), timings[i], 0.0, sum);
                    const double level = amplitudes[i];
                    if (!(level >= -1.0 && level <= 255.0 && level == std::floor(level)))
                        reader.fail(fmt::format("amplitudes[{}]", i), "must be a whole number, -1 to 255");
                    isDefault = isDefault || level < 0.0;
                    if (!reader.error && timings[i] > 0.0)
                        steps.push_back({std::llround(timings[i]), level < 0.0 ? 255 : static_cast<int>(level)});
                }
                if (isDefault)
                    warnings.emplace_back("waveform.amplitudes: the device's default of -1 becomes 255");
            });
        return reader.error ? Clip{} : clipOfWaveform(steps);
    }

    Clip envelope(bool isBasic)
    {
        AndroidEnvelope read;
        reader.object(isBasic ? "basicEnvelope" : "waveformEnvelope", read, Need::required,
                      [&](AndroidEnvelope& envelope)
                      {
                          std::optional<double> initial;
                          const char* start = isBasic ? "initialSharpness" : "initialFrequencyHz";
                          reader.optionalNumber(start, initial);
                          if (initial)
                              checkFrequency(start, *initial, isBasic);
                          double sum = 0.0;
                          reader.list("controlPoints", envelope.points, mostPoints, "control points",
                                      [&](AndroidPoint& point) { readPoint(point, isBasic, sum); });
                          if (!reader.error && envelope.points.empty())
                              reader.fail("controlPoints", "has no control point");
                          if (!reader.error && envelope.points.back().amplitude != 0.0)
                              warnings.emplace_back("controlPoints: the last amplitude is not 0; Android refuses this");
                          if (!reader.error)
                              envelope.initialFrequency = initial.value_or(envelope.points.front().frequency);
                      });
        return reader.error ? Clip{} : clipOfEnvelope(read, isBasic);
    }

private:
    void checkDuration(const std::string& name, double value, double least, double& sum)
    {
        sum += value;
        if (!(value >= least && value == std::floor(value)))
            reader.fail(name, fmt::format("must be a whole number of milliseconds from {} on", least));
        else if (!(sum <= longestMs))
            reader.fail(name, "ends later than 24 hours", ErrorCode::tooLarge);
    }

    void checkFrequency(const char* name, double value, bool isBasic)
    {
        if (isBasic && !(value >= 0.0 && value <= 1.0))
            reader.fail(name, "must be 0 to 1");
        if (!isBasic && !(value > 0.0 && value <= 20000.0))
            reader.fail(name, "must be above 0 and at most 20000 Hz");
    }

    void readPoint(AndroidPoint& point, bool isBasic, double& sum)
    {
        const char* level = isBasic ? "intensity" : "amplitude";
        const char* frequency = isBasic ? "sharpness" : "frequencyHz";
        double duration = 0.0;
        reader.number(level, point.amplitude, Need::required);
        reader.number(frequency, point.frequency, Need::required);
        reader.number("durationMs", duration, Need::required);
        if (reader.error)
            return;
        if (!(point.amplitude >= 0.0 && point.amplitude <= 1.0))
            reader.fail(level, "must be 0 to 1");
        checkFrequency(frequency, point.frequency, isBasic);
        checkDuration("durationMs", duration, 1.0, sum);
        if (!reader.error)
            point.duration = std::llround(duration);
    }

    std::vector<std::string>& warnings;
};

bool isAndroidJson(std::string_view bytes)
{
    constexpr auto none = std::string_view::npos;
    return (bytes.find("\"timings\"") != none && bytes.find("\"amplitudes\"") != none) ||
           bytes.find("\"controlPoints\"") != none;
}

ExportedClip exportOf(std::string text, std::vector<FormatLoss> losses)
{
    return {{{"", std::move(text)}}, std::move(losses)};
}
} // namespace

Result<ImportedClip> readAndroidJson(std::string_view bytes)
{
    ImportedClip result;
    const auto tree = readForeignTree(bytes, result.warnings);
    if (!tree)
        return tree.error();
    AndroidReader reader(*tree, result.warnings);
    reader.reader.optionalText("name", result.clip.name);
    std::string name = result.clip.name.substr(0, limits::text / 2);
    if (tree->contains("waveformEnvelope"))
        result.clip = reader.envelope(false);
    else if (tree->contains("basicEnvelope"))
        result.clip = reader.envelope(true);
    else if (tree->contains("waveform"))
        result.clip = reader.waveform();
    else
        reader.reader.fail("waveformEnvelope", "is missing, and so are basicEnvelope and waveform");
    if (reader.reader.error)
        return *reader.reader.error;
    result.clip.name = std::move(name);
    if (auto valid = validate(result.clip); !valid)
        return valid.error();
    return result;
}

Result<ExportedClip> writeAndroidJson(const Clip& clip, const ExportParams& params)
{
    AndroidExport made = androidEffectsOf(clip, params);
    const AndroidEffects& effects = made.effects;
    return exportOf(fmt::format(R"({{
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
    ExportedClip result = exportOf(xmlDocument(waveform), std::move(made.losses));
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

Result<ExportedClip> writeAndroidKotlin(const Clip& clip, const ExportParams& params)
{
    AndroidExport made = androidEffectsOf(clip, params);
    return exportOf(fmt::format(R"(import android.os.Build
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
                                functionName(clip, params), decimal(made.effects.envelope.initialFrequency, 4),
                                builderCalls(made.effects.envelope.points),
                                timingsOf(made.effects.waveform, "            "),
                                amplitudesOf(made.effects.waveform, "            ")),
                    std::move(made.losses));
}

Result<ExportedClip> writeAndroidJava(const Clip& clip, const ExportParams& params)
{
    AndroidExport made = androidEffectsOf(clip, params);
    const std::string function = functionName(clip, params);
    std::string type = function;
    type[0] = 'V';
    return exportOf(fmt::format(R"(import android.os.Build;
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
                                type, type, function, decimal(made.effects.envelope.initialFrequency, 4),
                                builderCalls(made.effects.envelope.points),
                                timingsOf(made.effects.waveform, "                "),
                                amplitudesOf(made.effects.waveform, "                ")),
                    std::move(made.losses));
}

const ForeignFormat& androidJsonFormat()
{
    static constexpr ForeignFormat format{
        "android", "Android vibration effects, JSON", ".json", isAndroidJson, readAndroidJson, writeAndroidJson};
    return format;
}

const ForeignFormat& androidXmlFormat()
{
    static constexpr ForeignFormat format{"android-xml", "Android vibration XML", ".xml", nullptr,
                                          nullptr,       writeAndroidXml};
    return format;
}

const ForeignFormat& androidKotlinFormat()
{
    static constexpr ForeignFormat format{
        "android-kotlin", "Android vibration effect, Kotlin", ".kt", nullptr, nullptr, writeAndroidKotlin};
    return format;
}

const ForeignFormat& androidJavaFormat()
{
    static constexpr ForeignFormat format{"android-java",  "Android vibration effect, Java", ".java", nullptr, nullptr,
                                          writeAndroidJava};
    return format;
}

} // namespace pacini
