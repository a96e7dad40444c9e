#include "devices/EmergencyStop.h"

#include "devices/HidrawController.h"
#include "devices/OpenController.h"
#include "devices/SwitchReports.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#if !defined(_WIN32)

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
StopReports numberedStops()
{
    StopReports stops;
    for (unsigned i = 0; i < stops.size(); ++i)
        stops[i].report = switchRumbleReport(i, {});
    return stops;
}

/// A process that has sent 18 reports to `file` and is ended by `signal`.
[[noreturn]] void dieBy(int signal, int file)
{
    for (const int number : {SIGSEGV, SIGABRT, SIGTERM, SIGINT})
        ::signal(number, SIG_DFL); // the test framework's own handlers would report a failure
    EmergencyStop emergency(file);
    emergency.arm(numberedStops());
    for (int i = 0; i < 18; ++i)
        emergency.count();
    ::raise(signal);
    ::_exit(0);
}

std::vector<std::byte> everythingIn(int file)
{
    std::vector<std::byte> all;
    std::array<std::byte, 256> some{};
    for (::ssize_t got = 0; (got = ::read(file, some.data(), some.size())) > 0;)
        all.insert(all.end(), some.begin(), some.begin() + got);
    return all;
}
} // namespace

TEST_CASE("A program that is ended by a signal has written the silent packets that were due", "[devices]")
{
    for (const int signal : {SIGSEGV, SIGABRT, SIGTERM, SIGINT})
    {
        CAPTURE(signal);
        int ends[2] = {};
        REQUIRE(::pipe(ends) == 0);
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0)
            dieBy(signal, ends[1]);
        ::close(ends[1]);
        const auto written = everythingIn(ends[0]);
        ::close(ends[0]);
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        CHECK((WIFSIGNALED(status) || WEXITSTATUS(status) != 0)); // sanitizers exit by themselves

        std::vector<std::byte> expected;
        for (const unsigned counter : {2u, 3u})
        {
            for (const std::byte each : switchRumbleReport(counter, {}))
                expected.push_back(each);
        }
        CHECK(written == expected);
    }
}

TEST_CASE("A controller that takes two reports to be silenced is sent both, twice", "[devices]")
{
    int ends[2] = {};
    REQUIRE(::pipe(ends) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0)
    {
        ::signal(SIGTERM, SIG_DFL);
        EmergencyStop emergency(ends[1]);
        emergency.arm(stopReports({ControllerHaptics::steamController, Transport::receiver}));
        emergency.count(); // whatever was sent before
        ::raise(SIGTERM);
        ::_exit(0);
    }
    ::close(ends[1]);
    const auto written = everythingIn(ends[0]);
    ::close(ends[0]);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    std::vector<int> bytes;
    for (const std::byte each : written)
        bytes.push_back(std::to_integer<int>(each));
    CHECK(bytes == std::vector<int>{0x86, 1, 2, 8, 0x86, 1, 5, 8, 0x86, 1, 2, 8, 0x86, 1, 5, 8});
}

#if defined(__linux__)
TEST_CASE("A controller that is open for one program is refused to another, and one that is not there is told",
          "[devices]")
{
    const test::TempFolder folder;
    const std::string path = (folder / "hidraw0").string();
    CHECK(OpenController::open(path).error().message.find("unplugged") != std::string::npos);
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    {
        const auto first = OpenController::open(path);
        REQUIRE(first);
        const auto second = OpenController::open(path);
        REQUIRE_FALSE(second);
        CHECK(second.error().message.find("in use") != std::string::npos);
    }
    CHECK(OpenController::open(path));
    CHECK(controllerError(EACCES).message.find("70-pacini.rules") != std::string::npos);
}
#endif

#endif
