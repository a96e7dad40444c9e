#include "cli/PlayCommand.h"

#include "cli/Checks.h"
#include "cli/ControllerInput.h"
#include "io/AnyClip.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr double shortestLoop = 0.1; // s

/// Keeps what would be sent.
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

std::string shownName(const devices::Controller& controller)
{
    return printable(controller.name.empty() ? controller.path : controller.name);
}
} // namespace

CLI::App* PlayCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("play", "Play a clip on a game controller");
    command->add_option("input", input, "A clip of any format")->type_name("CLIP");
    command
        ->add_option("--device", device, "Its number in 'pacini devices', its path, or a part of its name [the only]")
        ->type_name("N|NAME");
    command->add_option("--intensity", intensity, "dB by which it is played stronger, or weaker")
        ->capture_default_str()
        ->check(numberFrom(-60.0, 40.0));
    command->add_option("--from", from, "Start here, s")->capture_default_str()->check(numberFrom(0.0, 1e6));
    command->add_option("--to", to, "End here, s [the clip's end]")->check(numberFrom(0.0, 1e6));
    command->add_flag("--loop", loop, "Play over and over until it is ended by Ctrl-C");
    command->add_flag("--wait", wait, "Wait until the controller is connected");
    command->add_flag("--dry-run", dryRun, "Only print what would be sent: seconds and bytes");
    command->add_option("--like", like, "With --dry-run: for this kind of controller, whatever is connected")
        ->check(CLI::IsMember(modelNames()));
    command->add_flag("--json", json, "Print one JSON object");
    command->footer("The controller stands still when the clip ends, on Ctrl-C, and when the program fails.\n"
                    "Examples:\n  pacini play door.json --device 1\n"
                    "  pacini play door.haptic --device pro --loop --intensity -6\n"
                    "  pacini play door.json --dry-run --like switch");
    return command;
}

std::optional<Error> PlayCommand::usageError() const
{
    const auto wrong = [](std::string message)
    {
        return Error{ErrorCode::invalidArgument, "play", std::move(message)};
    };
    if (input.empty())
        return wrong("a file to work on is missing; try 'pacini play --help'");
    if (dryRun && loop)
        return wrong("--loop has no end that --dry-run could print");
    if (!like.empty() && !dryRun)
        return wrong("--like is for --dry-run");
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

Result<std::optional<PlayCommand::Opened>> PlayCommand::openDevice(Console& console, Interruption& interruption) const
{
    // Right after it is connected, a controller may not be opened yet: the system still gives it to the user.
    constexpr int patience = 10;
    constexpr Seconds pause{0.2};
    int refused = 0;
    for (bool told = false;; told = true)
    {
        const auto connected = devices::connectedControllers();
        if (!connected)
            return connected.error();
        const auto chosen = chosenController(*connected, device);
        if (!chosen)
            return chosen.error();
        if (*chosen)
        {
            auto opened = devices::OpenController::open((*chosen)->path);
            if (opened)
                return std::optional(Opened{**chosen, std::move(opened).value()});
            if (!wait || ++refused > patience)
            {
                Error error = opened.error();
                error.where = shownName(**chosen);
                return error;
            }
        }
        else if (!wait)
            return Error{ErrorCode::io, "",
                         connected->empty() ? "no known game controller is connected; --wait waits for one"
                                            : "no such controller is connected; 'pacini devices' lists them"};
        if (!told)
            console.note("Waiting for a controller ...");
        if (interruption.wait(pause))
            return std::optional<Opened>();
    }
}

Exit PlayCommand::run(Console& console)
{
    if (const auto wrong = usageError())
    {
        console.error("", *wrong);
        return Exit::usage;
    }
    const auto read = readAnyClip(input);
    if (!read)
    {
        console.error(input, read.error());
        return Exit::failed;
    }
    for (const std::string& warning : read->warnings)
        console.warning(input, warning);
    const auto range = rangeIn(read->clip);
    if (!range)
    {
        console.error(input, range.error());
        return Exit::failed;
    }
    return dryRun ? list(console, read->clip, *range) : play(console, read->clip, *range);
}

Exit PlayCommand::list(Console& console, const Clip& clip, const devices::PlayRange& range) const
{
    devices::ControllerModel model = modelNamed(like);
    if (like.empty())
    {
        const auto connected = devices::connectedControllers();
        const auto chosen = connected ? chosenController(*connected, device)
                                      : Result<std::optional<devices::Controller>>(connected.error());
        if (!chosen || !*chosen)
        {
            console.error("", chosen ? Error{ErrorCode::io, "", "no such controller is connected; --like names a kind"}
                                     : chosen.error());
            return Exit::failed;
        }
        model = {(*chosen)->haptics, (*chosen)->transport};
    }
    devices::InstantClock clock;
    PacketList sink(clock);
    devices::RumblePlayer player(model, devices::ClipRumble(clip, range, Decibels(intensity), model.haptics), sink,
                                 clock);
    static_cast<void>(player.finish());
    Json packets = Json::array();
    for (const auto& [time, report] : sink.packets)
        if (json)
            packets.push_back({{"time", time.value}, {"bytes", hexText(report)}});
        else
            console.print(fmt::format("{:9.4f}  {}", time.value, hexText(report)));
    if (json)
        console.print(Json{{"input", input}, {"packets", packets}}.dump(2, ' ', false, Json::error_handler_t::replace));
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
    auto& [controller, target] = **opened;
    const devices::ControllerModel model{controller.haptics, controller.transport};
    devices::SteadyClock clock;
    devices::RumblePlayer player(model, devices::ClipRumble(clip, range, Decibels(intensity), model.haptics), *target,
                                 clock);
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
        console.error(input, error);
        return Exit::failed;
    }
    if (ended)
        return Exit::failed; // the signal ends the program
    if (json)
        console.print(Json{{"input", input},
                           {"controller", controller.name},
                           {"path", controller.path},
                           {"seconds", length},
                           {"packets", result->sent},
                           {"leftOut", result->leftOut},
                           {"latest", result->latest.value}}
                          .dump(2, ' ', false, Json::error_handler_t::replace));
    else
        console.note(fmt::format("{} played on {}: {}, {} packets, at most {:.1f} ms late{}", printable(input),
                                 shownName(controller), durationText(length), result->sent, 1e3 * result->latest.value,
                                 result->leftOut > 0 ? fmt::format(", {} left out", result->leftOut) : ""));
    return Exit::ok;
}

} // namespace pacini::cli
