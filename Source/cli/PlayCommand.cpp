// Subcommand that plays clips on haptic devices.

#include "cli/Command.h"
#include "cli/ControllerInput.h"
#include "cli/Interruption.h"
#include "cli/LossText.h"
#include "cli/Manifest.h"
#include "cli/Options.h"
#include "cli/PlayLosses.h"
#include "cli/ProfileInput.h"
#include "devices/ClipDrive.h"
#include "devices/ClipRumble.h"
#include "devices/HidList.h"
#include "devices/InstantClock.h"
#include "devices/OpenController.h"
#include "devices/RumblePlayback.h"
#include "devices/RumblePlayer.h"
#include "devices/SteadyClock.h"
#include "io/ClipFile.h"

#include <pacini/synthesis/Transparency.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr double shortestLoop = 0.1; // s

/// Stores the packets instead of sending them.
class PacketList : public devices::ReportSink
{
public:
    struct Packet
    {
        Seconds time;
        devices::Report report;
    };

    explicit PacketList(const devices::SendClock& clockToRead) : clock(clockToRead) {}

    void prepare(const devices::StopReports&) override {}

    Result<void> send(const devices::Report& report) override
    {
        packets.push_back({clock.now(), report});
        return {};
    }

    std::vector<Packet> packets;

private:
    const devices::SendClock& clock;
};

std::string hexText(const devices::Report& report)
{
    std::string text;
    for (const std::byte byte : report.content())
        text += fmt::format("{}{:02x}", text.empty() ? "" : " ", std::to_integer<unsigned>(byte));
    return text;
}

/// A clip without events would not be felt, and nobody would know why.
void warnOfSilence(Console& console, const std::string& clip, const devices::ControllerModel& model)
{
    if (model.haptics == devices::ControllerHaptics::waveforms && !model.trigger.lasts())
        console.warning(clip, "only the events are played, as the device has no continuous waveform");
}

/// `pacini play`: a clip on a game controller or another haptic device.
class PlayCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    /// What --dry-run and --explain are for.
    [[nodiscard]] Result<devices::ControllerModel> listedModel() const;

    [[nodiscard]] live::DualSenseWay way() const
    {
        return dualSense.empty() ? live::DualSenseWay::samples : *valueOf(dualSense, dualSenseWays);
    }

    [[nodiscard]] const Profile* actuator() const { return profile ? &*profile : nullptr; }

    /// What is wrong with the options.
    [[nodiscard]] std::optional<Error> usageError() const;

    /// The part of the clip that is played.
    [[nodiscard]] Result<devices::PlayRange> rangeIn(const Clip& clip) const;

    /// Makes the clip feel on the profile as on that of --designed-for, and tells what cannot be. Returns false on an
    /// error, which the console has said.
    [[nodiscard]] bool makeAlike(Console& console, Clip& clip) const;

    /// The controller that is meant, waited for if wanted; nothing when the user ended that.
    [[nodiscard]] Result<std::optional<live::OpenedController>> openDevice(Console& console,
                                                                           Interruption& interruption) const;

    /// Says so where not these packets but samples by a sound device are played.
    void tellOfSound(Console& console, const devices::ControllerModel& model) const;

    Exit explain(Console& console, const Clip& clip, const devices::PlayRange& range) const;
    Exit list(Console& console, const Clip& clip, const devices::PlayRange& range) const;
    Exit playSound(Console& console, const Clip& clip, const devices::PlayRange& range, live::OpenedController& opened,
                   Interruption& interruption) const;
    Exit play(Console& console, const Clip& clip, const devices::PlayRange& range) const;

    std::string input;
    std::string device;
    std::string like;
    std::string dualSense;
    std::string profileName;
    std::string designedFor;
    std::optional<Profile> profile;
    double intensity = 0.0; ///< dB
    double from = 0.0;      ///< s
    double to = -1.0;       ///< s; negative: the end
    bool loop = false;
    bool wait = false;
    bool dryRun = false;
    bool explaining = false;
};
} // namespace

CLI::App* PlayCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("play", "Play a clip on a game controller or another haptic device");
    addOption(*command, "input", input, "A clip of any format", "CLIP");
    addOption(
        *command, "--device", device,
        "Device to play on: its number in 'pacini devices', its path, or part of its name [the only game controller]",
        "N|NAME");
    auto* adapted = addOption(
        *command, "--profile", profileName,
        "Actuator profile that the drive is made for: a file, such as a personal one of 'pacini study profile', or a "
        "shipped profile [none: the drive as it is]",
        "PROFILE");
    addOption(*command, "--designed-for", designedFor,
              "Actuator profile on which the clip was designed: it feels alike on that of --profile", "PROFILE")
        ->needs(adapted);
    addPreset(*command, "--intensity", intensity, "Gain of the playback, dB", numberFrom(-60.0, 40.0));
    addPreset(*command, "--from", from, "Start of the part to play, s", numberFrom(0.0, limits::duration, "24 h"), "S");
    addOption(*command, "--to", to, "End of the part to play, s [the end]", numberFrom(0.0, limits::duration, "24 h"),
              "S");
    command->add_flag("--loop", loop, "Repeat until Ctrl-C");
    command->add_flag("--wait", wait, "Wait until the controller is connected");
    command->add_flag("--dry-run", dryRun, "Print the packets (seconds and bytes) and send nothing");
    command->add_flag("--explain", explaining,
                      "List what the controller cannot show of the clip, as 'lint' does, and play nothing");
    addOption(*command, "--like", like, "With --dry-run or --explain: for this kind of controller",
              oneOf(modelNames()));
    addOption(*command, "--dualsense", dualSense, dualSenseHelp, oneOf(dualSenseWays));
    command->footer("The motors stop when the clip ends, on Ctrl-C, and when the program fails.\n"
                    "Examples:\n  pacini play door.json --device 1\n"
                    "  pacini play door.haptic --device pro --loop --intensity -6\n"
                    "  pacini play door.json --profile quest-controller --device 1\n"
                    "  pacini play door.json --dry-run --like switch\n"
                    "  pacini play door.json --explain --like dualshock4");
    return command;
}

std::optional<Error> PlayCommand::usageError() const
{
    const auto wrong = [](std::string message)
    {
        return Error{ErrorCode::invalidArgument, "play", std::move(message)};
    };
    if (input.empty())
        return wrong("the input file is missing; try 'pacini play --help'");
    const bool playsNothing = dryRun || explaining;
    if (dryRun && explaining)
        return wrong("--dry-run and --explain exclude each other; leave one of them out");
    if (playsNothing && loop)
        return wrong(fmt::format("--loop has no end; leave it out, or {}", dryRun ? "--dry-run" : "--explain"));
    if (!like.empty() && !playsNothing)
        return wrong("--like needs --dry-run or --explain");
    if (!like.empty() && !device.empty())
        return wrong("--like and --device exclude each other; leave one of them out");
    if (playsNothing && wait)
        return wrong(
            fmt::format("--wait and {} exclude each other; leave one of them out", dryRun ? "--dry-run" : "--explain"));
    return std::nullopt;
}

Result<devices::PlayRange> PlayCommand::rangeIn(const Clip& clip) const
{
    const double end = to < 0.0 ? clip.duration : std::min(to, clip.duration);
    if (!(from < end))
        return Error{ErrorCode::invalidArgument, "",
                     fmt::format("has nothing between {} and {} s; it is {} s long", from, end, clip.duration)};
    if (loop && end - from < shortestLoop)
        return Error{ErrorCode::invalidArgument, "", fmt::format("is looped from {} s on", shortestLoop)};
    return devices::PlayRange{Seconds(from), Seconds(end), loop};
}

Result<std::optional<live::OpenedController>> PlayCommand::openDevice(Console& console,
                                                                      Interruption& interruption) const
{
    // Right after it is connected, a controller may not be opened yet: the system still gives it to the user.
    constexpr int patience = 10;
    constexpr Seconds pause{0.2};
    int refused = 0;
    for (bool told = false;; told = true)
    {
        const auto found = findController(device);
        if (!found)
            return found.error();
        if (found->controller)
        {
            auto opened = openedController(*found->controller, way());
            if (opened)
                return std::optional(std::move(opened).value());
            if (!wait || ++refused > patience)
                return opened.error();
        }
        else if (!wait)
            return found->missing;
        if (!told)
            console.note("Waiting for a controller ...");
        if (interruption.wait(pause))
            return std::optional<live::OpenedController>();
    }
}

Exit PlayCommand::run(Console& console)
{
    if (const auto wrong = usageError())
        return console.fail("", *wrong, Exit::usage);
    auto read = readClip(input, console.isStrict());
    if (!read)
        return console.fail(input, read.error());
    console.warnings(input, read->warnings);
    const auto range = rangeIn(read->clip);
    if (!range)
        return console.fail(input, range.error());
    if (!profileName.empty())
    {
        profile = openProfile(console, profileName);
        if (!profile)
            return Exit::failed;
        if (profile->technology == Technology::erm)
            return console.fail(profileName,
                                {ErrorCode::invalidArgument, "--profile",
                                 "is a motor, whose drive is a voltage; leave it out: motors of controllers "
                                 "have their own curves"},
                                Exit::usage);
    }
    if (!designedFor.empty())
        if (!makeAlike(console, read->clip))
            return Exit::failed;
    if (explaining)
        return explain(console, read->clip, *range);
    return dryRun ? list(console, read->clip, *range) : play(console, read->clip, *range);
}

bool PlayCommand::makeAlike(Console& console, Clip& clip) const
{
    const auto designed = openProfile(console, designedFor);
    if (!designed)
        return false;
    auto made = transparentClip(std::move(clip), *designed, *profile);
    if (!made)
    {
        console.error(input, ofProfileOption(made.error()));
        return false;
    }
    console.warnings(input, made->lost);
    clip = std::move(made->clip);
    return true;
}

Result<devices::ControllerModel> PlayCommand::listedModel() const
{
    if (!like.empty())
        return live::playedIn(modelNamed(like), way());
    const auto found = findController(device);
    if (!found)
        return found.error();
    const auto& controller = found->controller;
    if (!controller)
        return Error{ErrorCode::io, "", "no such controller is connected; choose a kind with --like"};
    if (!controller->waveforms && controller->haptics != devices::ControllerHaptics::dualSense)
        return devices::usualModel(controller->haptics, controller->transport);
    const auto opened = openedController(*controller, way()); // only it can tell its waveforms, or its firmware
    if (!opened)
        return opened.error();
    return opened->model;
}

void PlayCommand::tellOfSound(Console& console, const devices::ControllerModel& model) const
{
    if (model.haptics != devices::ControllerHaptics::dualSense || model.transport == devices::Transport::bluetooth ||
        way() == live::DualSenseWay::rumble)
        return;
    console.warning(input, fmt::format("a DualSense on a cable plays samples by its sound device, which sends no "
                                       "packets and loses only what is beyond full drive; {} its rumble, which plays "
                                       "where that device is missing",
                                       dryRun ? "these are the packets of" : "this is lost by"));
}

Exit PlayCommand::explain(Console& console, const Clip& clip, const devices::PlayRange& range) const
{
    const auto model = listedModel();
    if (!model)
        return console.fail("", model.error());
    tellOfSound(console, *model);
    Json losses = Json::array();
    for (const FormatLoss& loss : playLosses(clip, range, Decibels(intensity), *model, actuator()))
    {
        losses.push_back(toJson(loss));
        console.print(lossLine(input, loss));
    }
    if (losses.empty())
        console.note(fmt::format("{}: loses nothing", printable(input)));
    console.addToReport({{"input", input},
                         {"haptics", hapticsName(model->haptics)},
                         {"transport", transportName(model->transport)},
                         {"losses", losses}});
    return Exit::ok;
}

Exit PlayCommand::list(Console& console, const Clip& clip, const devices::PlayRange& range) const
{
    const auto model = listedModel();
    if (!model)
        return console.fail("", model.error());
    tellOfSound(console, *model);
    warnOfSilence(console, input, *model);
    devices::InstantClock clock;
    PacketList sink(clock);
    devices::ClipRumble rumble(clip, range, Decibels(intensity), *model, actuator());
    devices::RumblePlayback playback(*model, rumble, sink, clock);
    static_cast<void>(playback.run());
    Json packets = Json::array();
    for (const auto& [time, report] : sink.packets)
    {
        packets.push_back({{"time", time.value}, {"bytes", hexText(report)}});
        console.print(fmt::format("{:9.4f}  {}", time.value, hexText(report)));
    }
    console.addToReport({{"input", input}, {"packets", packets}});
    return Exit::ok;
}

Exit PlayCommand::play(Console& console, const Clip& clip, const devices::PlayRange& range) const
{
    Interruption interruption;
    auto opened = openDevice(console, interruption);
    if (!opened)
    {
        console.error("", opened.error());
        return opened.error().code == ErrorCode::invalidArgument ? Exit::usage : Exit::failed;
    }
    if (!*opened)
        return Exit::failed; // the signal ends the program
    live::OpenedController& all = **opened;
    const auto& controller = all.controller;
    const auto& target = all.device;
    const auto& model = all.model;
    if (!all.lesser.empty())
        console.note(fmt::format("{} plays by rumble: it {}", shownName(controller), all.lesser));
    if (all.sound)
        return playSound(console, clip, range, all, interruption);
    warnOfSilence(console, input, model);
    devices::SteadyClock clock;
    devices::RumblePlayer player(model, devices::ClipRumble(clip, range, Decibels(intensity), model, actuator()),
                                 *target, clock);
    const double length = range.to.value - range.from.value;
    bool ended = false;
    while (!ended && player.isPlaying())
    {
        const double position = player.position().value;
        console.progress(loop ? 1.0 : position / length,
                         fmt::format("{}  {}", durationText(position), shownName(controller)));
        ended = interruption.wait(Seconds(0.02));
    }
    player.stop();
    console.endProgress();
    const auto result = player.finish();
    if (!result)
    {
        Error error = result.error();
        error.where = shownName(controller);
        return console.fail(input, error);
    }
    if (ended)
        return Exit::failed; // the signal ends the program
    console.addToReport({{"input", input},
                         {"controller", controller.name},
                         {"path", controller.path},
                         {"seconds", length},
                         {"packets", result->sent},
                         {"leftOut", result->leftOut},
                         {"latest", result->latest.value}});
    console.note(fmt::format("{} played on {}: {}, {} packets, at most {:.1f} ms late{}", printable(input),
                             shownName(controller), durationText(length), result->sent, 1e3 * result->latest.value,
                             result->leftOut > 0 ? fmt::format(", {} left out", result->leftOut) : ""));
    return Exit::ok;
}

Exit PlayCommand::playSound(Console& console, const Clip& clip, const devices::PlayRange& range,
                            live::OpenedController& opened, Interruption& interruption) const
{
    constexpr double fading = 0.15; // s, in which the last sound fades out
    const double fs = opened.sound->sampleRate();
    const double length = range.to.value - range.from.value;
    std::atomic<std::int64_t> made{0};
    const auto started = opened.sound->play(
        [&made, render = devices::clipDrive(clip, range, Decibels(intensity), fs, actuator())](std::span<float> frames)
        {
            for (std::size_t i = 0; i < frames.size(); i += devices::DriveRumble::blockFrames)
                render(std::array<std::span<float>, 1>{
                    frames.subspan(i, std::min(devices::DriveRumble::blockFrames, frames.size() - i))});
            made.fetch_add(static_cast<std::int64_t>(frames.size()));
        });
    const std::string name = shownName(opened.controller);
    const auto failed = [&](Error error)
    {
        error.where = name;
        return console.fail(input, error);
    };
    if (!started)
        return failed(started.error());
    bool ended = false;
    double position = 0.0;
    while (!ended && opened.sound->isRunning() && opened.isThere() && (loop || position < length + fading))
    {
        console.progress(loop ? 1.0 : std::min(position / length, 1.0),
                         fmt::format("{}  {}", durationText(position), name));
        ended = interruption.wait(Seconds(0.02));
        position = static_cast<double>(made.load()) / fs;
    }
    const bool isThere = opened.sound->isRunning() && opened.isThere();
    opened.sound->stop();
    console.endProgress();
    if (ended)
        return Exit::failed; // the signal ends the program
    if (!isThere)
        return failed({ErrorCode::io, "", "does not answer any more; was it unplugged or switched off?"});
    console.addToReport({{"input", input},
                         {"controller", opened.controller.name},
                         {"path", opened.controller.path},
                         {"seconds", length},
                         {"samples", made.load()}});
    console.note(fmt::format("{} played on {}: {}, as samples by its sound device", printable(input), name,
                             durationText(length)));
    return Exit::ok;
}

std::unique_ptr<Command> playCommand()
{
    return std::make_unique<PlayCommand>();
}

} // namespace pacini::cli
