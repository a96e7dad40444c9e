#pragma once

// The message loop of tests: what is done in the background comes back.

#include "support/Catch.h"

#include <juce_events/juce_events.h>

#include <chrono>
#include <functional>
#include <thread>

namespace juce
{
bool dispatchNextMessageOnSystemQueue(bool returnIfNoPendingMessages);
}

namespace pacini::test
{

/// Delivers messages until the condition holds; false when it never does.
inline bool pumpUntil(const std::function<bool()>& condition, double seconds = 60.0)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition())
    {
        if (std::chrono::steady_clock::now() > end)
            return false;
        if (!juce::dispatchNextMessageOnSystemQueue(true))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

/// Delivers what is there, and timers, for a while.
inline void pumpFor(double seconds)
{
    (void)pumpUntil([] { return false; }, seconds);
}

} // namespace pacini::test
