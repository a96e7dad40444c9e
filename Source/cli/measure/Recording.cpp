#include "cli/measure/Recording.h"

#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/measure/SweepNames.h"
#include "io/AudioReader.h"
#include "io/FileExtension.h"
#include "io/Overwrite.h"

#include <pacini/foundation/ParseNumber.h>
#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepAnalysis.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
std::optional<double> number(std::string_view text)
{
    const auto value = parseNumber(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

/// m/s^2 from a number of them, or of g.
std::optional<double> acceleration(std::string_view text)
{
    const bool inGravity = text.ends_with('g') || text.ends_with('G');
    if (inGravity)
        text.remove_suffix(1);
    const auto value = number(text);
    return value ? std::optional(*value * (inGravity ? standardGravity : 1.0)) : std::nullopt;
}

/// A number such as 0.1, or a fraction such as 1/12.
std::optional<double> fraction(std::string_view text)
{
    const auto slash = text.find('/');
    const auto upper = number(text.substr(0, slash));
    const auto lower = slash == std::string_view::npos ? std::optional(1.0) : number(text.substr(slash + 1));
    return upper && lower && *lower > 0.0 ? std::optional(*upper / *lower) : std::nullopt;
}

/// The channels of a file that are asked for, each on its own.
struct Channels
{
    int sampleRate = 0;
    std::vector<std::vector<float>> samples;
    std::vector<std::string> warnings; ///< of the file
};

Result<Channels> readChannels(const std::string& file, const std::vector<int>& wanted)
{
    AudioReadOptions options;
    options.lowestSampleRate = limits::lowestWrittenRate;
    const auto audio = readAudio(file, options, 4ull * 3600 * 48000);
    if (!audio)
        return audio.error();
    std::vector<int> chosen = wanted;
    if (chosen.empty())
        for (int c = 1; c <= audio->channels; ++c)
            chosen.push_back(c);
    if (chosen.size() > 3)
        return Error{
            ErrorCode::invalidArgument, "--channels",
            fmt::format("must name one to three of the {} channels: the axes of the accelerometer, or the microphone",
                        audio->channels)};
    Channels channels{audio->sampleRate, {}, audio->warnings};
    const auto width = static_cast<std::size_t>(audio->channels);
    for (const int c : chosen)
    {
        if (c < 1 || c > audio->channels)
            return Error{ErrorCode::invalidArgument, "--channels",
                         fmt::format("has {}, but the recording has {} channel{}", c, audio->channels,
                                     audio->channels == 1 ? "" : "s")};
        std::vector<float>& samples = channels.samples.emplace_back(audio->samples.size() / width);
        for (std::size_t i = 0; i < samples.size(); ++i)
            samples[i] = audio->samples[i * width + static_cast<std::size_t>(c - 1)];
    }
    return channels;
}

/// The warnings of many recordings: each text once, and of ranges that drown in the noise, which differ by a little
/// from one recording to the next, the first at either end.
class WarningList
{
public:
    void add(const std::string& file, const SweepMeasurement& measured, const std::vector<int>& channels)
    {
        for (const MeasurementWarning& warning : measured.warnings)
        {
            const std::string text = channelName(warning.where, channels) + ": " + warning.message;
            const std::string kind =
                warning.code == MeasurementDefect::lowSnr ? warning.where.substr(0, warning.where.find(' ')) : text;
            const auto known =
                std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.kind == kind; });
            if (known == entries.end())
                entries.push_back({file, file, kind, text, 0});
            else
                known->add(file);
        }
    }

    void print(Console& console) const
    {
        for (const Entry& entry : entries)
            console.warning(entry.more == 0 ? entry.file : fmt::format("{} and {} more", entry.file, entry.more),
                            entry.text);
    }

private:
    struct Entry
    {
        std::string file; ///< the first
        std::string last;
        std::string kind;
        std::string text;
        int more = 0; ///< files

        void add(const std::string& another)
        {
            more += another != last ? 1 : 0;
            last = another;
        }
    };

    /// `channels[1]` is the second of those chosen; people count the channels of the recording from 1.
    static std::string channelName(const std::string& where, const std::vector<int>& chosen)
    {
        constexpr std::string_view start = "channels[";
        std::size_t index = 0;
        if (!where.starts_with(start) ||
            std::from_chars(where.data() + start.size(), where.data() + where.size(), index).ec != std::errc())
            return where;
        return fmt::format("channel {}", index < chosen.size() ? chosen[index] : static_cast<int>(index) + 1);
    }

    std::vector<Entry> entries;
};

/// The description of the sweep; of a sound, the one beside it.
std::filesystem::path sweepPath(const std::string& named)
{
    const auto extension = lowerExtension(named);
    const auto& sounds = audioExtensions();
    return std::find(sounds.begin(), sounds.end(), extension) == sounds.end() ? std::filesystem::path(named)
                                                                              : sweepFileBeside(named);
}
} // namespace

void RecordingOptions::declare(CLI::App& command)
{
    const auto check = [](auto parse, const char* message)
    {
        return CLI::Validator([=](const std::string& text)
                              { return parse(text) ? std::string() : fmt::format("{} {}", text, message); },
                              "", "value");
    };
    addOption(command, "recordings", recordings,
              "Recordings of the sweep: of one actuator, attached again or on other people", "RECORDING")
        ->required();
    addOption(command, "--sweep", sweep,
              "Description of the sweep: the .json written by 'pacini measure sweep', or the sound beside it", "SWEEP")
        ->required();
    addOption(command, "--channels", channels, "Channels of the recording to use, one to three, counted from 1 [all]",
              "N,...")
        ->delimiter(',');
    addOption(command, "--full-scale", fullScale,
              "Acceleration at full scale, in m/s^2 or in g such as 5g; one value for all channels or one for each. "
              "Without it levels are relative",
              check(acceleration, "is not an acceleration such as 49.03 or 5g"), "A,...")
        ->delimiter(',');
    addPreset(command, "--smoothing", smoothing, "Bandwidth of the power average, octaves",
              check(fraction, "is not a number of octaves such as 1/12"), "OCT");
    addPreset(command, "--points", points, "Number of points of the response, evenly spaced in octaves",
              wholeNumberFrom(8, 4096), "N");
}

double RecordingOptions::smoothingOctaves() const
{
    return *fraction(smoothing);
}

std::optional<std::pair<std::string, Error>> overwrittenInput(const RecordingOptions& options,
                                                              const std::vector<std::string>& results)
{
    std::vector<std::pair<fs::path, const char*>> inputs{
        {fs::path(options.sweep).replace_extension(".json"), "is the description of the sweep; name another output"},
        {fs::path(options.sweep).replace_extension(".wav"), "is the sound of the sweep; name another output"},
        {options.sweep, "is the sweep; name another output"}};
    for (const std::string& recording : options.recordings)
        inputs.emplace_back(recording, "is a recording to be analysed; name another output");
    for (const std::string& result : results)
        for (const auto& [input, what] : inputs)
            if (!result.empty() && isSameFile(result, input))
                return std::pair(result, Error{ErrorCode::invalidArgument, "", what});
    return std::nullopt;
}

std::optional<AnalysedRecordings> analyseRecordings(Console& console, const RecordingOptions& options)
{
    const std::string description = sweepPath(options.sweep).string();
    auto sweep = readSweepFile(description);
    if (!sweep)
    {
        console.error(description, sweep.error());
        return std::nullopt;
    }
    AnalysedRecordings result{std::move(*sweep), {}, {}};
    MeasurementParams params;
    params.smoothing = options.smoothingOctaves();
    params.points = static_cast<std::size_t>(options.points);
    params.equalized = !result.sweep.equalizedFor.empty();
    if (options.isCalibrated())
        params.fullScale.clear();
    for (const std::string& value : options.fullScale)
        params.fullScale.push_back(*acceleration(value));

    bool failed = false;
    WarningList warnings;
    for (std::size_t i = 0; i < options.recordings.size(); ++i)
    {
        const std::string& file = options.recordings[i];
        console.progress(static_cast<double>(i) / static_cast<double>(options.recordings.size()), file);
        auto channels = readChannels(file, options.channels);
        if (channels)
            console.warnings(file, channels->warnings);
        auto measured = channels ? analyseSweeps(channels->samples, channels->sampleRate, result.sweep.sweep, params)
                                 : Result<SweepMeasurement>(channels.error());
        if (!measured)
        {
            Error error = measured.error();
            error.where = optionFor(error.where);
            console.error(file, error);
            failed = true;
            continue;
        }
        warnings.add(file, *measured, options.channels);
        takeOut(*measured, result.sweep.gain);
        result.recordings.push_back({file, std::move(*measured)});
    }
    console.endProgress();
    warnings.print(console);
    if (failed)
        return std::nullopt;
    std::vector<FrequencyResponse> responses;
    for (const AnalysedRecording& recording : result.recordings)
        responses.push_back(recording.measurement.response());
    auto average = averagePlacements(responses);
    if (!average)
    {
        console.error("", average.error());
        return std::nullopt;
    }
    result.average = std::move(*average);
    for (const PlacementOutlier& outlier : result.average.outliers)
        console.warning(options.recordings[outlier.index],
                        fmt::format("is an outlier and left out of the average: {} dB, shape {:.1f} dB off",
                                    signedText(outlier.offset, 1), outlier.shape));
    return result;
}

} // namespace pacini::cli
