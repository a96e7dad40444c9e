// Subcommand that plays a clip on phones in the local network.

#include "cli/Command.h"
#include "cli/Interruption.h"
#include "cli/Options.h"
#include "io/ClipFile.h"
#include "phone/PhoneServer.h"
#include "phone/QrText.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#if !defined(_WIN32)
#include <poll.h>
#include <unistd.h>
#endif

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// Lines of standard input, looked for now and then: the Enter key.
class EnterKey
{
public:
    /// Waits at most for `time`; how often it was pressed. [message]
    [[nodiscard]] std::size_t pressed(Seconds time)
    {
#if defined(_WIN32)
        std::this_thread::sleep_for(std::chrono::duration<double>(time.value)); // phones begin by themselves
        return 0;
#else
        pollfd input{.fd = over ? -1 : STDIN_FILENO, .events = POLLIN, .revents = 0};
        if (poll(&input, 1, static_cast<int>(1000.0 * time.value)) <= 0)
            return 0;
        char buffer[256];
        const auto got = read(STDIN_FILENO, buffer, sizeof buffer);
        over = got <= 0;
        return got <= 0 ? 0 : static_cast<std::size_t>(std::count(buffer, buffer + got, '\n'));
#endif
    }

private:
    [[maybe_unused]] bool over = false;
};

/// ms since 1970, as browsers count.
double wallClock()
{
    return std::chrono::duration<double, std::milli>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// `pacini serve`: a clip on phones.
struct ServeCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    void showPicture(Console& console, const phone::PhoneServer& server) const;
    void serve(Console& console, phone::PhoneServer& server, Interruption& interruption) const;

    std::string input, address, film;
    int port = 0;
    bool inverted = false;
};
} // namespace

CLI::App* ServeCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("serve", "Play a clip on phones in the local network");
    addOption(*command, "input", input, "A clip of any format", "CLIP");
    addOption(*command, "--film", film,
              "Film that the page of the phone shows, in a format of its browser; the clip is felt in time with it",
              "FILE");
    addOption(*command, "--address", address, "Address to listen on [that of this machine in its network]", "IPV4");
    addOption(*command, "--port", port, "Port to listen on [a free port]", numberFrom(1.0, 65535.0), "N");
    command->add_flag("--inverted", inverted, "Invert the QR code, for terminals with a light background");
    return command->footer(
        "Scan the QR code with the phone. Each code works once; a new one appears for the next phone, up "
        "to 64. A browser on this machine that opens the address shows the codes too.\nEnter plays the clip on all "
        "connected phones, Ctrl-C ends. Browsers on Android vibrate, "
        "those on\niPhones and Firefox do not. The connection is not encrypted.\n"
        "Examples:\n  pacini serve door.json\n"
        "  pacini serve film.json --film film.mp4       the phone shows the film and vibrates with it");
}

void ServeCommand::showPicture(Console& console, const phone::PhoneServer& server) const
{
    const std::string url = server.url();
    console.print(phone::qrText(phone::qrModules(url), inverted) + url);
}

void ServeCommand::serve(Console& console, phone::PhoneServer& server, Interruption& interruption) const
{
    constexpr Seconds glance(0.05);
    std::string shown = server.url();
    std::vector<phone::ConnectedPhone> phones;
    std::pair<phone::Refusal, std::size_t> refusals[] = {
        {phone::Refusal::usedCode, 0}, {phone::Refusal::wrongCode, 0}, {phone::Refusal::full, 0}};
    EnterKey enter;
    Json plays = Json::array();
    while (!interruption.wait(Seconds(0.0)))
    {
        for (std::size_t i = enter.pressed(glance); i > 0; --i)
        {
            plays.push_back(wallClock());
            server.play(Seconds(0.0));
            console.note(fmt::format("played on {} phone{}", phones.size(), phones.size() == 1 ? "" : "s"));
        }
        for (auto& [reason, count] : refusals)
            if (const std::size_t now = server.refused(reason); now != std::exchange(count, now))
                console.note(fmt::format("a phone was refused: {}", phone::refusalText(reason)));
        if (auto now = server.connectedPhones(); now != phones)
        {
            phones = std::move(now);
            console.note(phone::phonesText(phones) + "; Enter plays");
        }
        if (const std::string url = server.url(); url != shown)
        {
            shown = url;
            if (!console.isJson())
                showPicture(console, server);
        }
    }
    console.addToReport({{"plays", plays}});
    console.endReport(true); // the signal ends the program when it is let go of
}

Exit ServeCommand::run(Console& console)
{
    if (input.empty())
        return console.fail(
            "", {ErrorCode::invalidArgument, "serve", "the input file is missing; try 'pacini serve --help'"},
            Exit::usage);
    const auto read = readClip(input, console.isStrict());
    if (!read)
        return console.fail(input, read.error());
    console.warnings(input, read->warnings);
    Interruption interruption; // before the thread of the server
    const auto server = phone::PhoneServer::start({address, static_cast<std::uint16_t>(port)});
    if (!server)
        return console.fail("", server.error());
    if (film.empty())
        (*server)->show(read->clip);
    else if (const auto shown = (*server)->show(read->clip, film); !shown)
        return console.fail("", shown.error());
    console.addToReport({{"input", input}, {"address", (*server)->url()}});
    if (console.isJson())
    {
        console.keepStdoutFree(); // of all but the report: whoever reads that needs the address before
        console.note((*server)->url());
    }
    else
        showPicture(console, **server);
    serve(console, **server, interruption);
    return Exit::ok;
}

std::unique_ptr<Command> serveCommand()
{
    return std::make_unique<ServeCommand>();
}

} // namespace pacini::cli
