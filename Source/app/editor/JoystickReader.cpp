// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/JoystickReader.h"

#include <utility>

#if JUCE_LINUX
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>
#endif

namespace pacini::app
{

JoystickReader::JoystickReader(std::filesystem::path joysticks, std::function<void(const JoystickPress&)> pressed)
    : juce::Thread("Pacini joysticks"), folder(std::move(joysticks)), tell(std::move(pressed))
{
#if JUCE_LINUX
    startThread();
#endif
}

JoystickReader::~JoystickReader()
{
    stopThread(-1);
}

#if JUCE_LINUX
namespace
{
/// Event of the kernel's joystick interface (Documentation/input/joydev/joystick-api.rst).
struct JoystickEvent
{
    std::uint32_t time;
    std::int16_t value;
    std::uint8_t type;
    std::uint8_t number;
};
static_assert(sizeof(JoystickEvent) == 8);
constexpr std::uint8_t buttonEvent = 1, axisEvent = 2; // with 0x80: the state at the start
constexpr int moved = 20000, released = 10000;         // of 32767

/// Open joysticks, by their names.
class Joysticks
{
public:
    using Tell = std::function<void(const JoystickPress&)>;

    explicit Joysticks(const std::filesystem::path& wanted) : folder(wanted) {}
    ~Joysticks()
    {
        for (const auto& [name, one] : open)
            close(one.file);
    }
    Joysticks(const Joysticks&) = delete;
    Joysticks& operator=(const Joysticks&) = delete;

    void look()
    {
        std::error_code error;
        for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error))
            if (const std::string name = entry->path().filename().string();
                name.starts_with("js") && !open.contains(name))
                if (const int file = ::open(entry->path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); file >= 0)
                    open[name].file = file;
    }

    /// What is pressed within `milliseconds`.
    void wait(int milliseconds, const Tell& tell)
    {
        std::vector<pollfd> waits;
        std::vector<std::string> names;
        for (const auto& [name, one] : open)
        {
            waits.push_back({one.file, POLLIN, 0});
            names.push_back(name);
        }
        if (poll(waits.data(), static_cast<nfds_t>(waits.size()), milliseconds) <= 0)
            return;
        for (std::size_t i = 0; i < waits.size(); ++i)
        {
            if (waits[i].revents == 0)
                continue;
            std::array<JoystickEvent, 64> events;
            Joystick& one = open[names[i]];
            const auto got = read(one.file, events.data(), sizeof(events));
            if (got <= 0) // unplugged
            {
                close(one.file);
                open.erase(names[i]);
                continue;
            }
            for (std::size_t n = 0; n < static_cast<std::size_t>(got) / sizeof(JoystickEvent); ++n)
                take(one, events[n], tell);
        }
    }

    /// What is held at an end.
    void repeat(const Tell& tell) const
    {
        for (const auto& [name, one] : open)
            for (const auto& [axis, direction] : one.held)
                tell({-1, axis, direction});
    }
    [[nodiscard]] bool isHeld() const
    {
        for (const auto& [name, one] : open)
            if (!one.held.empty())
                return true;
        return false;
    }

private:
    struct Joystick
    {
        int file = -1;
        std::map<int, int> held; ///< direction of axes at an end
    };

    static void take(Joystick& one, const JoystickEvent& event, const Tell& tell)
    {
        if (event.type == buttonEvent && event.value == 1)
            tell({event.number, -1, 0});
        if (event.type != axisEvent)
            return;
        if (std::abs(event.value) < released)
            one.held.erase(event.number);
        else if (std::abs(event.value) > moved && !one.held.contains(event.number))
        {
            one.held[event.number] = event.value < 0 ? -1 : 1;
            tell({-1, event.number, one.held[event.number]});
        }
    }

    const std::filesystem::path& folder;
    std::map<std::string, Joystick> open;
};
} // namespace
#endif

void JoystickReader::run()
{
#if JUCE_LINUX
    constexpr int patience = 200;                        // ms, of the end of the program
    constexpr juce::uint32 devicePoll = 2000;            // ms between looks for what has been connected
    constexpr juce::uint32 firstRepeat = 400, next = 80; // ms
    Joysticks joysticks(folder);
    joysticks.look();
    auto looked = juce::Time::getMillisecondCounter(), due = looked;
    bool held = false;
    while (!threadShouldExit())
    {
        if (juce::Time::getMillisecondCounter() - looked > devicePoll)
        {
            joysticks.look();
            looked = juce::Time::getMillisecondCounter();
        }
        joysticks.wait(held ? static_cast<int>(next) / 2 : patience, tell);
        const auto now = juce::Time::getMillisecondCounter();
        if (!std::exchange(held, joysticks.isHeld()))
            due = now + firstRepeat;
        else if (held && static_cast<juce::int32>(now - due) >= 0)
        {
            joysticks.repeat(tell);
            due = now + next;
        }
    }
#endif
}

} // namespace pacini::app
