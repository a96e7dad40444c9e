// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Delivery of JUCE's messages in a CLAP host.

#include "plugin/clap/Clap.h"

#include <juce_events/juce_events.h>

#include <memory>

namespace pacini::plugin
{

/// On Linux a timer of the host delivers them on its main thread; where the host has none, a thread of our own, for
/// all instances. (File descriptors would serve nothing else: all instances share one queue, and a host would watch it
/// once for each.) On Windows and macOS the system delivers them. Exists as long as anything of JUCE's.
class ClapEventLoop
{
public:
    /// [main]
    explicit ClapEventLoop(const clap_host_t& wanted);
    ClapEventLoop(const ClapEventLoop&) = delete;
    ClapEventLoop& operator=(const ClapEventLoop&) = delete;
    ~ClapEventLoop();

    /// [main]
    void onTimer(clap_id id);

private:
    juce::ScopedJuceInitialiser_GUI juceInUse;
    const clap_host_t& host;
    clap_id timer = CLAP_INVALID_ID;
    struct Thread;
    std::unique_ptr<juce::SharedResourcePointer<Thread>> thread; ///< null: the host delivers
};

/// The extension `clap.timer-support`.
[[nodiscard]] const clap_plugin_timer_support_t& timerExtension() noexcept;

} // namespace pacini::plugin
