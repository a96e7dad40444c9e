#include "io/FieldsReader.h"
#include "io/formats/ForeignText.h"
#include "io/formats/android/AndroidEffects.h"
#include "io/formats/android/AndroidFormat.h"

#include <fmt/format.h>

#include <cmath>

namespace pacini
{

namespace
{
constexpr std::size_t maxPoints = 5'000'000;
constexpr double longestMs = limits::duration * 1000.0;

class AndroidReader
{
public:
    FieldsReader reader;
    std::vector<std::string>& warnings;

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
                reader.numbers("timings", timings, maxPoints);
                reader.numbers("amplitudes", amplitudes, maxPoints);
                reader.integer("repeat", repeat, "must be a whole number");
                if (timings.size() != amplitudes.size())
                    reader.fail("amplitudes",
                                fmt::format("has {} numbers, but {} timings", amplitudes.size(), timings.size()));
                if (repeat >= 0)
                    warnings.emplace_back("waveform.repeat: the effect is read without its repetition");
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
                          reader.list("controlPoints", envelope.points, maxPoints, "control points",
                                      [&](AndroidPoint& point) { readPoint(point, isBasic, sum); });
                          if (!reader.error && envelope.points.empty())
                              reader.fail("controlPoints", "has no control point");
                          if (!reader.error && envelope.points.back().amplitude != 0.0)
                              warnings.emplace_back(
                                  "controlPoints: the last amplitude is not 0; Android rejects such effects");
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
};

std::optional<Error> readEffect(const nlohmann::json& tree, ImportedClip& imported)
{
    AndroidReader reader{FieldsReader(tree), imported.warnings};
    reader.reader.optionalText("name", imported.clip.name);
    std::string name = importedName(imported.clip.name);
    const auto has = [&](const char* kind)
    {
        const auto entry = tree.find(kind);
        return entry != tree.end() && !entry->is_null();
    };
    if (has("waveformEnvelope"))
        imported.clip = reader.envelope(false);
    else if (has("basicEnvelope"))
        imported.clip = reader.envelope(true);
    else if (has("waveform"))
        imported.clip = reader.waveform();
    else
        reader.reader.fail("waveformEnvelope", "is missing, and so are basicEnvelope and waveform");
    imported.clip.name = std::move(name);
    return reader.reader.error;
}
} // namespace

bool isAndroidJson(std::string_view bytes)
{
    constexpr auto none = std::string_view::npos;
    return (bytes.find("\"timings\"") != none && bytes.find("\"amplitudes\"") != none) ||
           bytes.find("\"controlPoints\"") != none;
}

Result<ImportedClip> readAndroidJson(std::string_view bytes)
{
    return importForeign(bytes, readEffect);
}

} // namespace pacini
