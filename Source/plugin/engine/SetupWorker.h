// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Background thread for all instances in a process, for work that the audio thread must not do.

#include <juce_core/juce_core.h>

#include <algorithm>
#include <vector>

namespace pacini::plugin
{

/// Asks its clients again and again whether something was changed by automation. Polling: to wake a thread the audio
/// thread would need a system call.
class SetupWorker : private juce::Thread
{
public:
    class Client
    {
    public:
        virtual ~Client() = default;
        /// [worker]
        virtual void catchUp() = 0;
    };

    SetupWorker() : juce::Thread("Pacini set-up") { startThread(); }
    ~SetupWorker() override { stopThread(10000); }

    void add(Client& client)
    {
        const juce::ScopedLock lock(guard);
        clients.push_back(&client);
    }

    /// Afterwards the client is not called any more.
    void remove(Client& client)
    {
        const juce::ScopedLock lock(guard);
        std::erase(clients, &client);
    }

private:
    static constexpr int pollMilliseconds = 20;

    void run() override
    {
        while (!threadShouldExit())
        {
            {
                const juce::ScopedLock lock(guard);
                for (Client* client : clients)
                    client->catchUp();
            }
            wait(pollMilliseconds);
        }
    }

    juce::CriticalSection guard;
    std::vector<Client*> clients;
};

} // namespace pacini::plugin
