// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ClapEventLoop.h"

#include "plugin/clap/ClapPlugin.h"

#if JUCE_LINUX || JUCE_BSD
// JUCE's own, which its wrappers declare likewise.
namespace juce
{
#if JUCE_VERSION >= 0x70006
namespace detail
{
bool dispatchNextMessageOnSystemQueue(bool returnIfNoPendingMessages);
}
using detail::dispatchNextMessageOnSystemQueue;
#else
bool dispatchNextMessageOnSystemQueue(bool returnIfNoPendingMessages);
#endif
} // namespace juce
#endif

namespace pacini::plugin
{

#if JUCE_LINUX || JUCE_BSD
namespace
{
constexpr std::uint32_t periodMs = 16; // as often as a screen is drawn

void deliverAll()
{
    while (juce::dispatchNextMessageOnSystemQueue(true))
        ;
}

void takeOver()
{
    auto& manager = *juce::MessageManager::getInstance();
    if (!manager.isThisTheMessageThread())
        manager.setCurrentThreadAsMessageThread();
}
} // namespace

struct ClapEventLoop::Thread final : private juce::Thread
{
    Thread() : juce::Thread("Pacini messages")
    {
        startThread();
        ready.wait();
    }
    ~Thread() override
    {
        stopThread(-1);
        takeOver(); // what is left to destroy
    }

    void run() override
    {
        takeOver();
        ready.signal();
        while (!threadShouldExit())
        {
            deliverAll();
            wait(static_cast<int>(periodMs) / 4);
        }
    }

    juce::WaitableEvent ready;
};

ClapEventLoop::ClapEventLoop(const clap_host_t& wanted) : host(wanted)
{
    const auto* timers = extensionOf<clap_host_timer_support_t>(host, CLAP_EXT_TIMER_SUPPORT);
    if (timers != nullptr && timers->register_timer(&host, periodMs, &timer))
        takeOver();
    else
        thread = std::make_unique<juce::SharedResourcePointer<Thread>>();
}

ClapEventLoop::~ClapEventLoop()
{
    if (thread != nullptr)
        return;
    if (const auto* timers = extensionOf<clap_host_timer_support_t>(host, CLAP_EXT_TIMER_SUPPORT))
        timers->unregister_timer(&host, timer);
}

void ClapEventLoop::onTimer(clap_id id)
{
    if (thread != nullptr || id != timer)
        return;
    takeOver();
    deliverAll();
}
#else
struct ClapEventLoop::Thread
{
};
ClapEventLoop::ClapEventLoop(const clap_host_t& wanted) : host(wanted) {}
ClapEventLoop::~ClapEventLoop() = default;
void ClapEventLoop::onTimer(clap_id) {}
#endif

const clap_plugin_timer_support_t& timerExtension() noexcept
{
    static constexpr clap_plugin_timer_support_t extension{[](const clap_plugin_t* plugin, clap_id id)
                                                           {
                                                               ClapPlugin::of(plugin).onTimer(id);
                                                           }};
    return extension;
}

} // namespace pacini::plugin
