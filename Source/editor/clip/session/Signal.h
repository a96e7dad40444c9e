// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Change notification: what an object tells those that follow it.

#include <functional>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace pacini::editor
{

/// Calls its followers in the order in which they came. [message]
class Signal
{
public:
    Signal() = default;
    Signal(const Signal&) = delete;
    Signal& operator=(const Signal&) = delete;

    /// Followers may come and go meanwhile.
    void emit() const
    {
        const auto now = followers;
        for (const auto& follower : now)
            if (const auto call = follower.lock())
                (*call)();
    }

private:
    friend class Subscriptions;
    mutable std::vector<std::weak_ptr<const std::function<void()>>> followers;
};

/// Subscriptions of an object to signals, as long as it lives: to be its last member. [message]
class Subscriptions
{
public:
    /// Also on a constant object: following changes nothing of it.
    void on(std::initializer_list<const Signal*> signals, std::function<void()> call)
    {
        calls.push_back(std::make_shared<const std::function<void()>>(std::move(call)));
        for (const Signal* signal : signals)
        {
            std::erase_if(signal->followers, [](const auto& follower) { return follower.expired(); });
            signal->followers.push_back(calls.back());
        }
    }

private:
    std::vector<std::shared_ptr<const std::function<void()>>> calls;
};

} // namespace pacini::editor
