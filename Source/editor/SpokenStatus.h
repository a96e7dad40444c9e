// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Status messages spoken by speech-dispatcher, for systems whose screen readers do not see JUCE's windows.

#include <juce_events/juce_events.h>

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace pacini::editor
{

/// Hands texts to `spd-say`, a child process for each, on a thread of its own. Only the newest text waits, and
/// speech-dispatcher breaks off an older one of the same program: messages of the priority "text" do that to each
/// other. [message]
class SpokenStatus
{
public:
    static constexpr const char* program = "spd-say";
    static constexpr int longest = 500; ///< characters of a text; the rest is not spoken

    SpokenStatus() = default;
    ~SpokenStatus();
    SpokenStatus(const SpokenStatus&) = delete;
    SpokenStatus& operator=(const SpokenStatus&) = delete;

    /// Speaks, in the language of the windows; the same text again only when another came in between, or a second
    /// later. Never waits.
    void say(const juce::String& text);

    /// Called once when there is no such program.
    std::function<void()> onMissing;

private:
    struct Words
    {
        std::string text, language;
    };

    void run();

    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Words> waiting;
    bool ending = false;
    juce::String last;
    juce::uint32 lastTime = 0;                                  ///< ms
    std::shared_ptr<bool> told = std::make_shared<bool>(false); ///< that it is missing
    std::thread thread;                                         ///< since the first text
};

} // namespace pacini::editor
