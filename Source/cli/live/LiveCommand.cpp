// Subcommand that translates a sound while it plays.

#include "cli/Command.h"
#include "cli/ControllerInput.h"
#include "cli/Counted.h"
#include "cli/DescribedOptions.h"
#include "cli/Interruption.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/live/LiveEngine.h"
#include "cli/live/LiveFile.h"
#include "cli/live/LiveFollow.h"
#include "cli/live/LiveInput.h"
#include "cli/live/SoundOutput.h"
#include "io/FileOrigin.h"
#include "io/Fingerprint.h"
#include "io/LiveSettings.h"
#include "io/PlaybackSettings.h"
#include "io/SettingsFile.h"
#include "live/LivePad.h"
#include "live/SoundPort.h"

#include <pacini/realtime/TranslatorPresets.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr std::array<Choice<RawSamples>, 4> rawFormats{
    {{"s16", RawSamples::s16}, {"s24", RawSamples::s24}, {"s32", RawSamples::s32}, {"f32", RawSamples::f32}}};
constexpr double fasterPipe = 1.01; // as quick as a pipe is read when something plays in real time

/// "games-and-effects" of "Games and effects".
std::string presetOption(std::string_view name)
{
    std::string text;
    for (const char c : name)
        text += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::vector<std::string> presetNames()
{
    std::vector<std::string> names;
    for (const TranslatorPreset& preset : translatorPresets())
        names.push_back(presetOption(preset.name));
    return names;
}

std::string presetList()
{
    std::string lines;
    for (const TranslatorPreset& preset : translatorPresets())
        lines += fmt::format("\n  {:<18} {}", presetOption(preset.name), preset.purpose);
    return lines;
}

/// "###---   -12 dB" for a largest magnitude.
std::string levelText(float peak)
{
    constexpr double lowest = -60.0; // dB
    constexpr int width = 16;
    const double level = std::max(Decibels::fromGain(static_cast<double>(peak)).value, lowest);
    const auto filled =
        static_cast<std::size_t>(std::lround(std::clamp(1.0 - level / lowest, 0.0, 1.0) * static_cast<double>(width)));
    return fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(width - filled, '-'),
                       level > lowest ? fmt::format("{:3.0f} dB", level) : "silent");
}

/// The door of the controller that the user names.
live::PadDoor doorOf(const std::string& named, live::DualSenseWay way)
{
    live::PadDoor door;
    door.find = [named]() -> Result<devices::Controller>
    {
        const auto found = findController(named);
        if (!found)
            return found.error();
        return found->controller ? *found->controller : Result<devices::Controller>(found->missing);
    };
    door.open = [way](const devices::Controller& controller)
    {
        return openedController(controller, way);
    };
    return door;
}

/// Who is not connected is looked for without a word.
void tellNews(Console& console, const std::string& name, const live::PadNews& news)
{
    if (news.isBack)
        console.note(fmt::format("{} is back", name));
    if (!news.lesser.empty())
        console.note(fmt::format("{} plays by rumble: it {}", name, news.lesser));
    if (news.stopped)
        console.warning(name, news.stopped->message + "; it plays again when it is back");
}

/// `pacini live`: what sounds now, as touch.
class LiveCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    /// All that plays, and the thread that hands it the sound.
    struct Session
    {
        [[nodiscard]] bool isRealTime() const { return !pads.empty() || !outputs.empty(); }

        std::unique_ptr<LiveInput> input; ///< or a port
        std::unique_ptr<LiveEngine> engine;
        std::vector<std::unique_ptr<live::LiveDrive>> drives;
        std::unique_ptr<live::LatencyProbe> probe;
        std::unique_ptr<LiveFollow> follow;
        std::vector<std::unique_ptr<live::LivePad>> pads;
        std::vector<std::unique_ptr<SoundOutput>> outputs;
        std::unique_ptr<live::SoundPort> port; ///< ends before all that it hands the sound to
        std::unique_ptr<LiveFile> file;
        live::LiveDrive* fileDrive = nullptr;
        std::atomic<bool> stop{false};
        std::atomic<bool> ended{false};
        Result<void> failure; ///< of the thread until it has ended
        std::thread thread;
    };

    [[nodiscard]] std::optional<Error> usageError() const;
    /// The parameters to begin with; none: why not is told.
    [[nodiscard]] std::optional<TranslatorParams> chosenParams(Console& console) const;
    [[nodiscard]] const std::string& soundName() const { return soundInput.empty() ? input : soundInput; }
    [[nodiscard]] Result<void> openInput(Session& session) const;
    [[nodiscard]] Exit openOutputs(Console& console, Session& session) const;
    [[nodiscard]] Exit openSoundOutput(Console& console, Session& session, const std::string& name) const;
    [[nodiscard]] Exit openFile(Console& console, Session& session) const;
    [[nodiscard]] Result<void> openFollow(Session& session, const TranslatorSetup& setup) const;
    [[nodiscard]] Json followReport(Console& console, const Session& session) const;
    [[nodiscard]] Result<void> start(Session& session) const;
    void feed(Session& session) const;
    [[nodiscard]] std::uint64_t mostFrames(const Session& session) const;

    /// Ends what a sound device hands in.
    static void endOf(Session& session);
    void watch(Console& console, Session& session, Interruption& interruption) const;
    [[nodiscard]] Exit finish(Console& console, Session& session) const;
    void tell(Console& console, Session& session, std::uint64_t written) const;

    CLI::App* command = nullptr;
    std::string input;
    std::string soundInput;
    std::vector<std::string> soundOutputs;
    std::string raw;
    double rate = 48000.0; ///< Hz
    std::size_t channels = 2;
    std::vector<std::string> controllers;
    bool wait = false;
    std::string dualSense;
    std::string output;
    std::string profile;
    std::string preset;
    std::string settingsFile;
    bool printSettings = false;
    DescribedOptions described;
    double duration = -1.0; ///< s; negative: until the sound ends
    bool measuring = false;
    std::optional<std::size_t> followInput; ///< channel from 1
    double followDelay = 20.0;              ///< ms
    double followTime = DynamicCompensationParams{}.time.value;
    double followLimit = DynamicCompensationParams{}.limit.value;
    OverwriteOptions overwriting;
};
} // namespace

CLI::App* LiveCommand::declare(CLI::App& app)
{
    command = app.add_subcommand("live", "Play a sound as touch while it sounds");
    addOption(*command, "input", input, "Sound file, pipe, or - for WAV on standard input", "SOUND");
    addOption(*command, "--sound-input", soundInput, "Sound device to take the sound from, instead of SOUND",
              "SYSTEM[:NAME]");
    auto* rawOption = addOption(*command, "--raw", raw, "The pipe has raw little-endian samples: s16, s24, s32 or f32",
                                oneOf(rawFormats));
    addPreset(*command, "--rate", rate, "Sample rate of raw samples, Hz", numberFrom(8000.0, 768000.0), "HZ")
        ->needs(rawOption);
    addPreset(*command, "--channels", channels, "Channels of raw samples",
              wholeNumberFrom<std::size_t>(std::size_t(1), std::size_t(64)), "N")
        ->needs(rawOption);
    addOption(*command, "--device", controllers,
              "Controller to play on: its number in 'pacini devices', its path, or part of its name; may be repeated "
              "[the only game controller, unless there is another output]",
              "N|NAME");
    command->add_flag("--wait", wait, "Also begin when no controller is connected yet");
    addOption(*command, "--dualsense", dualSense, dualSenseHelp, oneOf(dualSenseWays));
    addOption(*command, "--sound-output", soundOutputs, "Sound device to play the drive signal on; may be repeated",
              "SYSTEM[:NAME]");
    addOption(*command, "-o,--output", output, "Drive signal to write: a .wav, or - for WAV on standard output", "OUT");
    addOption(*command, "--profile", profile,
              "Actuator profile that the drive is made for: a file or a shipped profile", "PROFILE");
    addOption(*command, "--preset", preset, "Set of parameters to begin with [neutral]", oneOf(presetNames()));
    addOption(
        *command, "--settings", settingsFile,
        "Read the parameters to begin with from the part live of a JSON file, as the plugin saves presets; options "
        "on the command line override them",
        "FILE")
        ->excludes("--preset");
    command->add_flag("--print-settings", printSettings,
                      "Print all of these parameters in the form of that file, which the plugin takes as a preset, and "
                      "exit");
    described.declare(*command, infosOf(translatorParameters));
    addOption(*command, "--duration", duration, "End after this time, s [when the sound ends]",
              numberFrom(0.0, limits::duration, "24 h"), "S");
    command->add_flag("--measure-latency", measuring,
                      "Play impulses in place of the sound and print how long each takes to the controller's report");
    auto* follow = addOption(*command, "--follow-input", followInput,
                             "Channel of the sound with an accelerometer on the actuator, which is not mixed into the "
                             "sound: the level that is "
                             "felt stays that of the beginning, however the actuator is worn",
                             wholeNumberFrom<std::size_t>(std::size_t(1), std::size_t(64)), "CHANNEL");
    addPreset(*command, "--follow-delay", followDelay, "Delay from the drive to the accelerometer's channel, ms",
              numberFrom(0.0, 1000.0), "MS")
        ->needs(follow);
    addPreset(*command, "--follow-time", followTime, "Time constant of the correction, s", numberFrom(2.0, 600.0), "S")
        ->needs(follow);
    addPreset(*command, "--follow-limit", followLimit, "Largest gain of a band, up or down, dB", numberFrom(0.0, 24.0),
              "DB")
        ->needs(follow);
    overwriting.declare(*command);
    command->footer(
        "The channels of the sound are mixed to one. A pipe is played as it comes, a file at its rate, or "
        "at once when\nonly -o is given. The motors stop when the sound ends, on Ctrl-C, and when the "
        "program fails; a controller\nor sound device that goes away plays again when it is back.\nPresets:" +
        presetList() +
        "\nSYSTEM alone is its default device; jack then leaves its ports for you to connect. NAME is a "
        "part of a name,\nand of pulse the whole name of a source or a sink: pulse:@DEFAULT_MONITOR@ is "
        "what this machine plays.\nExamples:\n"
        "  pacini live --sound-input pulse:@DEFAULT_MONITOR@       what this machine plays\n"
        "  pacini live --sound-input jack --device pro\n"
        "  pacini live rain.wav --device pro --sound-output jack\n"
        "  pacini live --sound-input jack --sound-output jack --follow-input 2\n"
        "  pacini live - --preset music -o - < rain.wav");
    return command;
}

std::optional<Error> LiveCommand::usageError() const
{
    const auto wrong = [](std::string message)
    {
        return Error{ErrorCode::invalidArgument, "live", std::move(message)};
    };
    if (printSettings)
        return std::nullopt; // nothing is played
    if (input.empty() && soundInput.empty())
        return wrong("the sound is missing; name a file, - for standard input, or a device with --sound-input");
    if (!input.empty() && !soundInput.empty())
        return wrong("--sound-input takes the place of the file; leave one of them out");
    if (!output.empty() && output != "-" && sameFileKey(output) == sameFileKey(input))
        return Error{ErrorCode::invalidArgument, output, "is the sound itself; name another output"};
    if (measuring && controllers.empty() && !(output.empty() && soundOutputs.empty()))
        return wrong("--measure-latency needs a controller; name it with --device");
    if (followInput && soundOutputs.empty() && output.empty())
        return wrong("--follow-input needs a drive signal; name an output with --sound-output or -o");
    return std::nullopt;
}

Result<void> LiveCommand::openFollow(Session& session, const TranslatorSetup& setup) const
{
    constexpr std::size_t ofDevices = 2; // channels, at most
    const std::size_t there = session.port ? ofDevices : session.input->channels();
    if (there < 2)
        return Error{ErrorCode::invalidArgument, "--follow-input",
                     "needs a channel beside the sound; this has one channel"};
    if (*followInput > there)
        return Error{ErrorCode::invalidArgument, "--follow-input",
                     fmt::format("is {}, but there are {} channels", *followInput, there)};
    if (setup.profile && setup.profile->technology == Technology::erm)
        return Error{ErrorCode::invalidArgument, "--follow-input", "cannot be for a motor, whose drive is a voltage"};
    DynamicCompensationParams params;
    params.delay = Seconds(1e-3 * followDelay);
    params.time = Seconds(followTime);
    params.limit = Decibels(followLimit);
    session.follow = std::make_unique<LiveFollow>(session.engine->sampleRate(), LiveEngine::longestPiece,
                                                  *followInput - 1, params, setup.profile);
    session.engine->follow(*session.follow);
    return {};
}

Json LiveCommand::followReport(Console& console, const Session& session) const
{
    const LiveFollow& follow = *session.follow;
    const double held = static_cast<double>(follow.held()) / session.engine->sampleRate();
    Json bands = Json::array();
    double least = 0.0, most = 0.0;
    for (const LiveFollow::Band& band : follow.bands())
    {
        bands.push_back({{"frequency", band.frequency}, {"gain", band.gain}, {"held", band.held}});
        least = std::min(least, band.gain);
        most = std::max(most, band.gain);
    }
    console.note(fmt::format("accelerometer {}; gains {} to {} dB, held for {}", sensorText(follow.sensor()),
                             signedText(least, 1), signedText(most, 1), durationText(held)));
    if (follow.sensor() != SensorState::good && follow.sensor() != SensorState::waiting)
        console.warning(soundName(),
                        fmt::format("the accelerometer {}: gains stay as they were; check its cable, its channel "
                                    "(--follow-input) and its delay (--follow-delay)",
                                    sensorText(follow.sensor())));
    return {{"sensor", sensorText(follow.sensor())}, {"heldSeconds", held}, {"bands", std::move(bands)}};
}

Result<void> LiveCommand::openInput(Session& session) const
{
    if (!soundInput.empty())
    {
        auto opened = live::SoundPort::openInput(soundInput);
        if (!opened)
            return opened.error();
        session.port = std::move(*opened);
        return {};
    }
    std::optional<RawFormat> format;
    if (!raw.empty())
        format = RawFormat{*valueOf(raw, rawFormats), rate, channels};
    auto opened = LiveInput::open(input, format, session.stop);
    if (!opened)
        return opened.error();
    session.input = std::move(*opened);
    return {};
}

Exit LiveCommand::openFile(Console& console, Session& session) const
{
    const FileOrigin origin = originOf(input, output, Fingerprint().text());
    const auto existing = mayReplace(output, origin, overwriting.of(true));
    if (!existing)
        return console.fail("", existing.error());
    session.drives.push_back(std::make_unique<live::LiveDrive>(static_cast<std::size_t>(session.engine->sampleRate())));
    session.fileDrive = session.drives.back().get();
    auto created = LiveFile::create(output, *existing, *session.fileDrive, session.engine->sampleRate());
    if (!created)
        return console.fail(output, created.error());
    session.file = std::move(*created);
    session.engine->add(*session.fileDrive);
    return Exit::ok;
}

Exit LiveCommand::openSoundOutput(Console& console, Session& session, const std::string& name) const
{
    constexpr double pipeBlock = 0.020; // s, as programs write to pipes
    const double fs = session.engine->sampleRate();
    session.drives.push_back(std::make_unique<live::LiveDrive>(static_cast<std::size_t>(fs)));
    session.engine->add(*session.drives.back());
    session.outputs.push_back(std::make_unique<SoundOutput>(
        name, *session.drives.back(), fs,
        Seconds(session.port ? static_cast<double>(session.port->blockFrames()) / fs : pipeBlock)));
    const auto opened = session.outputs.back()->open();
    if (!opened)
        return console.fail(name, opened.error(),
                            opened.error().code == ErrorCode::invalidArgument ? Exit::usage : Exit::failed);
    return Exit::ok;
}

Exit LiveCommand::openOutputs(Console& console, Session& session) const
{
    const double fs = session.engine->sampleRate();
    auto named = controllers;
    const auto way = dualSense.empty() ? live::DualSenseWay::samples : *valueOf(dualSense, dualSenseWays);
    if (named.empty() && output.empty() && soundOutputs.empty())
        named.emplace_back();
    for (const std::string& name : named)
    {
        session.drives.push_back(std::make_unique<live::LiveDrive>(static_cast<std::size_t>(fs)));
        session.engine->add(*session.drives.back());
        live::LatencyProbe* probe = session.pads.empty() ? session.probe.get() : nullptr;
        session.pads.push_back(std::make_unique<live::LivePad>(doorOf(name, way), *session.drives.back(), fs, probe));
        const auto opened = session.pads.back()->open();
        if (opened)
            continue;
        const bool ambiguous = opened.error().code == ErrorCode::invalidArgument;
        if (ambiguous || !wait)
            return console.fail("", opened.error(), ambiguous ? Exit::usage : Exit::failed);
        console.note("Waiting for a controller ...");
    }
    for (const std::string& name : soundOutputs)
        if (const Exit opened = openSoundOutput(console, session, name); opened != Exit::ok)
            return opened;
    return output.empty() ? Exit::ok : openFile(console, session);
}

std::uint64_t LiveCommand::mostFrames(const Session& session) const
{
    return duration < 0.0 ? ~std::uint64_t{0}
                          : static_cast<std::uint64_t>(std::llround(duration * session.engine->sampleRate()));
}

Result<void> LiveCommand::start(Session& session) const
{
    if (!session.port)
    {
        session.thread = std::thread([&] { feed(session); });
        return {};
    }
    return session.port->take(
        [&engine = *session.engine, most = mostFrames(session)](std::span<const float> block, std::size_t perFrame)
        {
            const auto frames =
                static_cast<std::size_t>(std::min<std::uint64_t>(block.size() / perFrame, most - engine.frames()));
            engine.process(block.first(frames * perFrame), perFrame);
        });
}

void LiveCommand::feed(Session& session) const
{
    using Clock = std::chrono::steady_clock;
    constexpr std::size_t frames = 128;
    const auto stopsWaiting = [&]
    {
        return session.stop.load() || (session.file && session.file->hasFailed());
    };
    const std::size_t perFrame = session.input->channels();
    const double fs = session.engine->sampleRate();
    const double pace = session.input->isLive() ? fasterPipe : 1.0;
    const std::uint64_t most = mostFrames(session);
    std::vector<float> block(frames * perFrame);
    const auto start = Clock::now();
    while (!stopsWaiting() && session.engine->frames() < most)
    {
        const auto got = session.input->read(block);
        if (!got)
            session.failure = got.error();
        if (!got || *got == 0)
            break;
        const std::size_t n = static_cast<std::size_t>(std::min<std::uint64_t>(*got, most - session.engine->frames()));
        while (session.fileDrive && session.fileDrive->room() < n && !stopsWaiting())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (session.isRealTime())
        {
            const double due = static_cast<double>(session.engine->frames()) / (fs * pace);
            std::this_thread::sleep_until(
                start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due)));
        }
        session.engine->process(std::span<const float>(block).first(n * perFrame), perFrame);
    }
    session.engine->end();
    session.ended.store(true, std::memory_order_release);
}

void LiveCommand::endOf(Session& session)
{
    session.port->stop();
    session.engine->end();
    session.ended.store(true, std::memory_order_release);
}

void LiveCommand::watch(Console& console, Session& session, Interruption& interruption) const
{
    constexpr Seconds glance(0.02);
    const auto isDone = [&]
    {
        return session.ended.load(std::memory_order_acquire) &&
               std::all_of(session.pads.begin(), session.pads.end(), [](const auto& pad) { return pad->isDone(); }) &&
               std::all_of(session.outputs.begin(), session.outputs.end(),
                           [](const auto& out) { return out->isDone(); });
    };
    float heard = 0.0f, felt = 0.0f;
    while (!isDone())
    {
        if (interruption.wait(glance))
            break;
        for (const auto& pad : session.pads)
        {
            const live::PadNews news = pad->look();
            tellNews(console, pad->name(), news);
        }
        for (auto& out : session.outputs)
            out->look(console);
        if (session.port && !session.ended.load())
        {
            const bool runs = session.port->isRunning();
            if (!runs)
                session.failure = Error{ErrorCode::io, "", "does not answer any more"};
            if (!runs || session.engine->frames() >= mostFrames(session) || (session.file && session.file->hasFailed()))
                endOf(session);
        }
        // A level falls slowly enough to be seen.
        constexpr float kept = 0.9f;
        heard = std::max(session.engine->takeHeard(), kept * heard);
        felt = std::max(session.engine->takeFelt(), kept * felt);
        std::string followed;
        if (session.follow)
        {
            double most = 0.0;
            for (const LiveFollow::Band& band : session.follow->bands())
                most = std::abs(band.gain) > std::abs(most) ? band.gain : most;
            followed = fmt::format("  sensor {}, {} dB", sensorText(session.follow->sensor()), signedText(most, 1));
        }
        console.status(fmt::format(
            "sound {}  touch {}  {}{}", levelText(heard), levelText(felt),
            durationText(static_cast<double>(session.engine->frames()) / session.engine->sampleRate()), followed));
    }
    console.endProgress();
}

void LiveCommand::tell(Console& console, Session& session, std::uint64_t written) const
{
    const double seconds = static_cast<double>(session.engine->frames()) / session.engine->sampleRate();
    Json outputs = Json::array();
    for (const auto& pad : session.pads)
    {
        const live::LivePadReport& report = pad->close();
        outputs.push_back({{"controller", report.name},
                           {"packets", report.sent},
                           {"leftOut", report.leftOut},
                           {"latestMilliseconds", 1e3 * report.latest.value},
                           {"connections", report.connections}});
        if (report.connections > 0)
            console.note(fmt::format(
                "{} on {}: {} packets{}", durationText(seconds), report.name, report.sent,
                report.leftOut > 0 ? fmt::format(", {} left out as the machine was too slow", report.leftOut) : ""));
    }
    if (session.file)
    {
        outputs.push_back({{"output", output}, {"frames", written}});
        console.wrote(output, durationText(static_cast<double>(written) / session.engine->sampleRate()));
    }
    for (const auto& out : session.outputs)
        outputs.push_back({{"soundOutput", out->name()},
                           {"standstills", out->standstills()},
                           {"connections", out->connections()},
                           {"correctionPpm", 1e6 * (out->correction() - 1.0)}});
    Json report{{"input", soundName()},
                {"seconds", seconds},
                {"sampleRate", session.engine->sampleRate()},
                {"translatorMilliseconds",
                 1e3 * static_cast<double>(session.engine->latencyFrames()) / session.engine->sampleRate()},
                {"outputs", outputs}};
    if (session.follow)
        report["follow"] = followReport(console, session);
    if (session.port)
    {
        const std::uint64_t interruptions = session.port->interruptions();
        report["interruptions"] = interruptions;
        if (interruptions > 0)
            console.note(fmt::format("{} was interrupted {}, as the machine was too slow", soundInput,
                                     counted(static_cast<std::size_t>(interruptions), "time", "times")));
    }
    if (session.probe)
    {
        const auto times = session.probe->measured();
        if (times.empty())
            console.warning(soundName(), "no impulse reached the controller");
        else
        {
            const double median = 1e3 * times[times.size() / 2];
            report["latency"] = {{"impulses", times.size()},
                                 {"least", 1e3 * times.front()},
                                 {"median", median},
                                 {"p90", 1e3 * times[times.size() * 9 / 10]},
                                 {"largest", 1e3 * times.back()}};
            console.print(fmt::format("impulse to report: {:.1f} ms ({:.1f} to {:.1f} ms, {})", median,
                                      1e3 * times.front(), 1e3 * times.back(),
                                      counted(times.size(), "impulse", "impulses")));
        }
    }
    console.addToReport(report);
}

Exit LiveCommand::finish(Console& console, Session& session) const
{
    // First what can be felt.
    for (const auto& pad : session.pads)
        static_cast<void>(pad->close());
    session.stop.store(true);
    if (session.port && !session.ended.load())
        endOf(session);
    for (auto& out : session.outputs)
        out->stop();
    if (session.thread.joinable())
        session.thread.join();
    std::uint64_t written = 0;
    if (session.file)
    {
        const auto done = session.file->finish();
        if (!done)
            return console.fail(output, done.error());
        written = *done;
    }
    if (session.input)
        console.warnings(soundName(), session.input->losses());
    tell(console, session, written);
    if (session.file && !session.file->early())
        return console.fail(output, session.file->early().error());
    if (!session.failure)
        return console.fail(soundName(), session.failure.error());
    return Exit::ok;
}

std::optional<TranslatorParams> LiveCommand::chosenParams(Console& console) const
{
    TranslatorParams params;
    for (const TranslatorPreset& known : translatorPresets())
        if (presetOption(known.name) == preset)
            params = known.params;
    if (!settingsFile.empty())
    {
        ReadWarnings warnings(console.isStrict());
        const auto read = readSettingsFile(settingsFile, &warnings);
        const auto live = read ? liveParamsOf(*read) : Result<TranslatorParams>(read.error());
        if (!live)
        {
            console.error(settingsFile, live.error());
            return std::nullopt;
        }
        console.warnings(settingsFile, warnings.texts());
        params = *live;
    }
    described.apply(translatorParameters, params);
    return params;
}

Exit LiveCommand::run(Console& console)
{
    if (const auto wrong = usageError())
        return console.fail("", *wrong, Exit::usage);
    if (printSettings)
    {
        const auto params = chosenParams(console);
        if (!params)
            return Exit::failed;
        const auto document = playbackSettingsJson({{}, {}, *params});
        console.addToReport({{"settings", document}});
        console.print(document.dump(4));
        return Exit::ok;
    }
    if (output == "-")
        console.keepStdoutFree();
    TranslatorSetup setup;
    if (!profile.empty())
    {
        setup.profile = openProfile(console, profile);
        if (!setup.profile)
            return Exit::failed;
    }
    const auto params = chosenParams(console);
    if (!params)
        return Exit::failed;

    // It outlives the session, whose end it lets the signal follow. It begins before the first thread, one of a sound
    // server too; but a wait for a pipe's header may be ended by the signal itself.
    std::optional<Interruption> interruption;
    Session session;
    if (!soundInput.empty())
        interruption.emplace();
    if (const auto opened = openInput(session); !opened)
        return console.fail(soundName(), opened.error(),
                            opened.error().code == ErrorCode::invalidArgument ? Exit::usage : Exit::failed);
    if (!interruption)
        interruption.emplace();
    session.engine = std::make_unique<LiveEngine>(
        session.port ? session.port->sampleRate() : session.input->sampleRate(), setup, *params);
    if (followInput)
        if (const auto opened = openFollow(session, setup); !opened)
            return console.fail(soundName(), opened.error(), Exit::usage);
    if (measuring)
    {
        session.probe = std::make_unique<live::LatencyProbe>();
        session.engine->measure(*session.probe);
    }
    if (const Exit opened = openOutputs(console, session); opened != Exit::ok)
        return opened;
    if (const auto started = start(session); !started)
        return console.fail(soundName(), started.error());
    watch(console, session, *interruption);
    return finish(console, session);
}

std::unique_ptr<Command> liveCommand()
{
    return std::make_unique<LiveCommand>();
}

} // namespace pacini::cli
