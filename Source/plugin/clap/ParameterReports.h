// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reports to a CLAP host of what the user does to parameters.

#include "plugin/clap/Clap.h"
#include "plugin/engine/PluginProcessor.h"

#include <array>
#include <atomic>
#include <functional>

namespace pacini::plugin
{

/// Collects changes and gestures in the window until the host fetches them. Several changes of one parameter become
/// one, with the last value; a gesture is never left open.
class ParameterReports final : private juce::AudioProcessorListener
{
public:
    /// What else is to be done. [message]
    struct Client
    {
        std::function<void()> onReport;    ///< there is something to fetch
        std::function<void()> onOtherEdit; ///< what is no parameter was changed
    };
    ParameterReports(PluginProcessor& watched, Client wanted);
    ~ParameterReports() override;

    /// Hands everything to the host; what it does not take stays for the next time. [audio]
    void send(const clap_output_events_t& events) noexcept;

    /// As long as one exists nothing is reported: the host changes the parameters itself. [message]
    class Pause
    {
    public:
        explicit Pause(ParameterReports& wanted) noexcept : reports(wanted) { ++reports.pauses; }
        Pause(const Pause&) = delete;
        Pause& operator=(const Pause&) = delete;
        ~Pause() { --reports.pauses; }

    private:
        ParameterReports& reports;
    };

private:
    struct Parameter
    {
        std::atomic<bool> changed{false}, begun{false}, held{false};
        bool toldHeld = false; ///< of the audio thread
    };

    void audioProcessorParameterChanged(juce::AudioProcessor*, int index, float) override;
    void audioProcessorChanged(juce::AudioProcessor*, const ChangeDetails& details) override;
    void audioProcessorParameterChangeGestureBegin(juce::AudioProcessor*, int index) override;
    void audioProcessorParameterChangeGestureEnd(juce::AudioProcessor*, int index) override;
    void announce();
    bool sendOne(std::size_t index, const clap_output_events_t& events) noexcept;

    PluginProcessor& processor;
    Client client;
    std::array<Parameter, parameterCount> parameters;
    std::atomic<bool> any{false};
    std::atomic<int> pauses{0};
};

} // namespace pacini::plugin
