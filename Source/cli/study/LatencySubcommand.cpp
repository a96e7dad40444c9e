#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/study/OpenStudy.h"
#include "io/AudioReader.h"
#include "io/AudioWriter.h"
#include "io/Fingerprint.h"
#include "study/LatencyFile.h"
#include "study/SessionLog.h"
#include "study/Stimuli.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
/// `study latency`: the true delay between sound and touch.
struct LatencySubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    Exit writeProbe(Console& console, const OpenedStudy& opened);
    Exit measure(Console& console, const OpenedStudy& opened);

    /// Errors: those of the reader and of LatencyMeter::latency(), at the options.
    [[nodiscard]] Result<study::Latency> listen(Console& console, AudioReader& reader) const;
    void tell(Console& console, const study::Latency& latency) const;

    std::string named, recording, probeFile, profile;
    study::LatencyProbe probe;
    int sound = 1, touch = 2;
    bool dry = false;
    OverwriteOptions overwriting;
};
} // namespace

CLI::App* LatencySubcommand::declare(CLI::App& app)
{
    auto* command = addStudyCommand(app, "latency", "Measure the delay of the haptic output against the sound", named);
    auto* heard =
        addOption(*command, "recording", recording, "Recording of the probe; the result is stored", "RECORDING");
    addOption(*command, "--probe", probeFile,
              "Write the probe, a sound to play on the sound output and the haptic output", "OUT")
        ->excludes(heard);
    addPreset(*command, "--duration", probe.duration, "Length of the probe, s, with one burst each second", "S");
    addPreset(*command, "--frequency", probe.frequency,
              "Frequency of the bursts, Hz; must be the same for probe and recording", "HZ");
    addPreset(*command, "--level", probe.level, "Level of the bursts, dB re full scale", "DB");
    addPreset(*command, "--rate", probe.sampleRate, "Sample rate of the probe, Hz", wholeNumberFrom(8000, 384000),
              "HZ");
    addOption(*command, "--profile", profile,
              "Actuator profile with the limits for the probe: a file or a shipped profile [that of the study]",
              "PROFILE");
    addPreset(*command, "--sound", sound, "Channel of the recording with the sound", wholeNumberFrom(1, 64), "N");
    addPreset(*command, "--touch", touch,
              "Channel of the recording with the haptic signal: a cable or an accelerometer", wholeNumberFrom(1, 64),
              "N");
    command->add_flag("--dry-run", dry, "Measure without storing the result");
    overwriting.declare(*command);
    return command->footer(
        "Play the probe on both outputs and record both at once, from cables or from a sensor on "
        "the\nactuator. The result is stored in latency.json beside the study, and sessions compensate for "
        "it. The\neditor does the same: Tools, Run a study..., Measure the delay.\n\nExample:\n"
        "  pacini study latency lab --probe probe.wav\n"
        "  pacini study latency lab recorded.wav --sound 1 --touch 2");
}

Exit LatencySubcommand::run(Console& console)
{
    if (auto valid = study::validate(probe); !valid)
    {
        Error error = valid.error();
        error.where = error.where == "sampleRate" ? "--rate" : "--" + error.where;
        return console.fail("", error, Exit::usage);
    }
    if (recording.empty() && probeFile.empty())
        return console.fail(
            "", {ErrorCode::invalidArgument, "RECORDING", "is missing; record the sound that --probe OUT writes"},
            Exit::usage);
    const auto opened = openStudy(console, named);
    if (!opened)
        return Exit::failed;
    return probeFile.empty() ? measure(console, *opened) : writeProbe(console, *opened);
}

Exit LatencySubcommand::writeProbe(Console& console, const OpenedStudy& opened)
{
    if (overwriting.keeps(console, {probeFile}))
        return Exit::ok;
    std::vector<float> burst = study::latencyBurst(probe);
    const std::string actuator = actuatorOf(opened.study, opened.folder, profile);
    if (!actuator.empty())
    {
        const auto limits = openProfile(console, actuator);
        if (!limits)
            return Exit::failed;
        study::protectDrive(burst, *limits, probe.sampleRate);
    }
    AudioWriteParams writing;
    writing.sampleRate = probe.sampleRate;
    writing.channels = 2;
    writing.encoding = SampleEncoding::pcm24;
    const auto seconds = static_cast<int>(std::ceil(probe.duration));
    writing.expectedFrames = burst.size() * static_cast<std::uint64_t>(seconds);
    const auto existing =
        mayReplace(probeFile, originOf(opened.file, probeFile, Fingerprint().text()), overwriting.of(true));
    if (!existing)
        return console.fail("", existing.error());
    writing.existing = *existing;
    auto writer = AudioWriter::create(probeFile, writing);
    if (!writer)
        return console.fail(probeFile, writer.error());
    std::vector<float> both;
    for (const float sample : burst)
        both.insert(both.end(), {sample, sample});
    for (int second = 0; second < seconds; ++second)
        if (auto written = writer->write(both); !written)
            return console.fail(probeFile, written.error());
    if (const auto finished = writer->finish(); !finished)
        return console.fail(probeFile, finished.error());
    console.addToReport({{"output", probeFile}});
    console.wrote(probeFile, fmt::format("{} bursts of {} Hz on two channels, for the sound output and the haptic "
                                         "output; do not wear the actuator meanwhile",
                                         seconds, decimalText(probe.frequency, 0)));
    return Exit::ok;
}

Result<study::Latency> LatencySubcommand::listen(Console& console, AudioReader& reader) const
{
    study::LatencyMeter meter(probe);
    const auto channels = static_cast<std::size_t>(reader.channels());
    const double frames = static_cast<double>(reader.frames().value_or(0));
    double done = 0.0;
    std::vector<float> heard, felt;
    constexpr std::size_t blockFrames = 1 << 16;
    const auto read = reader.forEachBlock(blockFrames,
                                          [&](std::span<const float> block)
                                          {
                                              const std::size_t count = block.size() / channels;
                                              heard.resize(count);
                                              felt.resize(count);
                                              for (std::size_t n = 0; n < count; ++n)
                                              {
                                                  heard[n] = block[n * channels + static_cast<std::size_t>(sound) - 1];
                                                  felt[n] = block[n * channels + static_cast<std::size_t>(touch) - 1];
                                              }
                                              meter.push(heard, felt);
                                              done += static_cast<double>(count);
                                              if (frames > 0.0)
                                                  console.progress(std::min(1.0, done / frames), "listening");
                                              return true;
                                          });
    console.endProgress();
    if (!read)
        return read.error();
    auto latency = meter.latency();
    if (!latency)
        return Error{latency.error().code, "--" + latency.error().where, latency.error().message};
    return latency;
}

void LatencySubcommand::tell(Console& console, const study::Latency& latency) const
{
    console.print(fmt::format(
        "the haptic output comes {} ms {} the sound: {} bursts, SD {} ms, largest difference {} ms",
        decimalText(1000.0 * std::abs(latency.delay), 3), latency.delay < 0.0 ? "before" : "after", latency.bursts,
        decimalText(1000.0 * latency.deviation, 3), decimalText(1000.0 * latency.largest, 3)));
    console.print(fmt::format("drift {} ms in an hour; levels {} and {} dB re full scale",
                              decimalText(1000.0 * latency.drift, 3), decimalText(latency.soundLevel, 1),
                              decimalText(latency.touchLevel, 1)));
    if (latency.missed > 0)
        console.warning(recording, fmt::format("{} bursts were recorded on one channel only", latency.missed));
    console.addToReport({{"delay", latency.delay},
                         {"deviation", latency.deviation},
                         {"largest", latency.largest},
                         {"drift", latency.drift},
                         {"bursts", latency.bursts},
                         {"missed", latency.missed},
                         {"soundLevel", latency.soundLevel},
                         {"touchLevel", latency.touchLevel}});
}

Exit LatencySubcommand::measure(Console& console, const OpenedStudy& opened)
{
    auto reader = AudioReader::open(recording);
    if (!reader)
        return console.fail(recording, reader.error());
    for (const auto& [option, channel] : {std::pair("--sound", sound), std::pair("--touch", touch)})
        if (channel > reader->channels())
            return console.fail(
                recording,
                {ErrorCode::invalidArgument, option,
                 fmt::format("is {}, but there {}", channel,
                             reader->channels() == 1 ? "is only 1 channel"
                                                     : fmt::format("are only {} channels", reader->channels()))},
                Exit::usage);
    if (sound == touch)
        return console.fail(
            recording, {ErrorCode::invalidArgument, "--touch", "must differ from the channel of --sound"}, Exit::usage);
    probe.sampleRate = reader->sampleRate();
    const auto latency = listen(console, *reader);
    console.warnings(recording, reader->warnings());
    if (!latency)
        return console.fail(recording, latency.error());
    tell(console, *latency);
    if (dry)
        return Exit::ok;
    study::MeasuredLatency measured;
    measured.time = study::utcNow();
    measured.recording = std::filesystem::path(recording).filename().string();
    measured.sampleRate = probe.sampleRate;
    measured.latency = *latency;
    const std::string kept = (opened.folder / study::latencyFileName).string();
    if (const auto added = study::keepLatency(opened.folder, measured); !added)
        return console.fail(kept, added.error());
    console.wrote(kept, "sessions compensate for this delay from now on");
    return Exit::ok;
}

std::unique_ptr<Command> latencyStudySubcommand()
{
    return std::make_unique<LatencySubcommand>();
}

} // namespace pacini::cli
