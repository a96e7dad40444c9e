// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/PhoneOutput.h"

#include <utility>

namespace pacini::app
{

namespace
{
constexpr int followInterval = 30;      // ms
constexpr juce::uint32 showDelay = 200; // ms after the last edit
} // namespace

PhoneOutput::PhoneOutput(const editor::EditorModel& project, const editor::Transport& playing)
    : edited(project), transport(playing)
{
    subscriptions.on({&transport.changed},
                     [this]
                     {
                         if (running)
                             follow();
                     });
    subscriptions.on({&edited.versionChanged, &edited.contentChanged},
                     [this]
                     {
                         if (running)
                             showAt = juce::Time::getMillisecondCounter() + showDelay;
                     });
}

Result<void> PhoneOutput::start()
{
    if (running)
        return {};
    auto started = phone::PhoneServer::start();
    if (!started)
        return started.error();
    running = std::move(started).value();
    show();
    startTimer(followInterval);
    return {};
}

void PhoneOutput::end()
{
    stopTimer();
    running.reset();
}

void PhoneOutput::show()
{
    showAt = 0;
    if (const auto clip = edited.clip())
        running->show(*clip);
    follow();
}

void PhoneOutput::follow()
{
    lastPlayhead = transport.playhead();
    // Whatever the monitor lets through here: who holds the phone has asked to feel it.
    if (transport.isPlaying() && edited.clip())
        running->play(Seconds(lastPlayhead));
    else
        running->stop();
}

void PhoneOutput::timerCallback()
{
    const double here = transport.playhead();
    const bool jumpedBack = transport.isPlaying() && here < lastPlayhead;
    if (showAt != 0 && juce::Time::getMillisecondCounter() >= showAt)
        show();
    else if (jumpedBack)
        follow();
    else
        lastPlayhead = here;
}

} // namespace pacini::app
