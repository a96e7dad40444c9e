// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/TapInput.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#if JUCE_LINUX
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#endif

namespace pacini::app
{

namespace
{
constexpr int devicePoll = 2000; // ms between looks for what has been connected

#if JUCE_LINUX
/// What the kernel's joystick interface sends (Documentation/input/joydev/joystick-api.rst).
struct JoystickEvent
{
    std::uint32_t time;
    std::int16_t value;
    std::uint8_t type;
    std::uint8_t number;
};
static_assert(sizeof(JoystickEvent) == 8);
constexpr std::uint8_t buttonEvent = 1; // with 0x80: the state at the start

/// Open joysticks, by their names.
class Joysticks
{
public:
    explicit Joysticks(const std::filesystem::path& wanted) : folder(wanted) {}
    ~Joysticks()
    {
        for (const auto& [name, file] : files)
            close(file);
    }
    Joysticks(const Joysticks&) = delete;
    Joysticks& operator=(const Joysticks&) = delete;

    void look()
    {
        std::error_code error;
        for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error))
            if (const std::string name = entry->path().filename().string();
                name.starts_with("js") && !files.contains(name))
                if (const int file = open(entry->path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); file >= 0)
                    files[name] = file;
    }

    /// Buttons that are pressed within `milliseconds`.
    [[nodiscard]] int pressed(int milliseconds)
    {
        std::vector<pollfd> waits;
        std::vector<std::string> names;
        for (const auto& [name, file] : files)
        {
            waits.push_back({file, POLLIN, 0});
            names.push_back(name);
        }
        int count = 0;
        if (poll(waits.data(), static_cast<nfds_t>(waits.size()), milliseconds) <= 0)
            return 0;
        for (std::size_t i = 0; i < waits.size(); ++i)
        {
            if (waits[i].revents == 0)
                continue;
            std::array<JoystickEvent, 64> events;
            const auto got = read(waits[i].fd, events.data(), sizeof(events));
            if (got <= 0) // unplugged
            {
                close(waits[i].fd);
                files.erase(names[i]);
                continue;
            }
            const auto end = events.begin() + got / static_cast<std::ptrdiff_t>(sizeof(JoystickEvent));
            count += static_cast<int>(std::count_if(events.begin(), end,
                                                    [](const JoystickEvent& event)
                                                    { return event.type == buttonEvent && event.value == 1; }));
        }
        return count;
    }

private:
    const std::filesystem::path& folder;
    std::map<std::string, int> files;
};
#endif
} // namespace

TapInput::TapInput(editor::Tapping& wanted, const editor::Transport& playing, std::filesystem::path joysticks)
    : juce::Thread("Pacini taps"), tapping(wanted), transport(playing), folder(std::move(joysticks))
{
#if JUCE_LINUX
    startThread();
#endif
    startTimer(devicePoll);
}

TapInput::~TapInput()
{
    stopTimer();
    inputs.clear();
    stopThread(-1);
    cancelPendingUpdate();
}

void TapInput::tap(double level)
{
    {
        const std::lock_guard lock(mutex);
        waiting.push_back(level);
    }
    triggerAsyncUpdate();
}

void TapInput::handleAsyncUpdate()
{
    std::vector<double> levels;
    {
        const std::lock_guard lock(mutex);
        levels.swap(waiting);
    }
    if (!transport.isPlaying() || !(inBackground || juce::Process::isForegroundProcess()))
        return;
    for (const double level : levels)
        tapping.tap(level);
}

void TapInput::handleIncomingMidiMessage(juce::MidiInput*, const juce::MidiMessage& message)
{
    if (message.isNoteOn())
        tap(std::max(1.0 / 127.0, static_cast<double>(message.getFloatVelocity())));
}

/// Opens what is new, and closes what is gone.
void TapInput::timerCallback()
{
#if JUCE_LINUX
    if (std::error_code error; !std::filesystem::exists("/dev/snd/seq", error))
        return; // the system's library would say so again and again
#endif
    const auto devices = juce::MidiInput::getAvailableDevices();
    std::erase_if(inputs, [&](const auto& input) { return !devices.contains(input->getDeviceInfo()); });
    for (const auto& device : devices)
        if (std::none_of(inputs.begin(), inputs.end(),
                         [&](const auto& input) { return input->getDeviceInfo() == device; }))
            if (auto input = juce::MidiInput::openDevice(device.identifier, this))
            {
                input->start();
                inputs.push_back(std::move(input));
            }
}

void TapInput::run()
{
#if JUCE_LINUX
    constexpr int patience = 200; // ms, of the end of the program
    Joysticks joysticks(folder);
    auto looked = juce::Time::getMillisecondCounter();
    joysticks.look();
    while (!threadShouldExit())
    {
        if (juce::Time::getMillisecondCounter() - looked > devicePoll)
        {
            joysticks.look();
            looked = juce::Time::getMillisecondCounter();
        }
        for (int i = joysticks.pressed(patience); i > 0; --i)
            tap(editor::usualEvent.amplitude);
    }
#endif
}

} // namespace pacini::app
