// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/PadOutput.h"

#include "devices/HidList.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace pacini::plugin
{

namespace
{
constexpr std::size_t queueFrames = 65000;      // a block of 8192 at any rate, and what waits for a packet of 50 ms
constexpr std::chrono::milliseconds glance(20); // from one look at the controller to the next
constexpr int glancesToList = 50;               // from one list to the next
constexpr const char* missing = "is not connected; it plays as soon as it is";
} // namespace

std::string nameOf(const devices::Controller& controller)
{
    return controller.name.empty() ? controller.path : controller.name;
}

PadAccess connectedPads()
{
    return {devices::connectedControllers, [](const devices::Controller& controller)
            {
                return live::openToPlay(controller, live::DualSenseWay::samples);
            }};
}

PadOutput::PadOutput(PadAccess wantedAccess) : access(std::move(wantedAccess)) {}

PadOutput::~PadOutput()
{
    listening.store(nullptr, std::memory_order_release);
    {
        const std::lock_guard lock(mutex);
        ending = true;
    }
    changed.notify_all();
    if (thread.joinable())
        thread.join();
}

void PadOutput::choose(const std::string& name, const std::string& path)
{
    const std::lock_guard lock(mutex);
    if (name == choice.name && (path.empty() || path == choice.path))
        return;
    choice.name = name;
    choice.path = path;
    now = Status{};
    now.name = name;
    if (!name.empty() && !queue)
        queue = std::make_unique<live::LiveDrive>(queueFrames);
    listening.store(name.empty() ? nullptr : queue.get(), std::memory_order_release);
    if (!name.empty() && !thread.joinable())
        thread = std::thread([this] { work(); });
    changed.notify_all();
}

void PadOutput::prepare(double sampleRate)
{
    const std::lock_guard lock(mutex);
    choice.fs = sampleRate;
    changed.notify_all();
}

bool PadOutput::isChosen(const devices::Controller& controller) const
{
    const std::lock_guard lock(mutex);
    const std::string& path = now.path.empty() ? choice.path : now.path;
    return nameOf(controller) == choice.name && (path.empty() || path == controller.path);
}

PadOutput::Status PadOutput::status() const
{
    const std::lock_guard lock(mutex);
    return now;
}

/// A node of the system has another path when it comes back, and perhaps the path of another one.
Result<devices::Controller> PadOutput::find(const Wanted& meant)
{
    const auto connected = access.list();
    if (!connected)
        return connected.error();
    const devices::Controller* found = nullptr;
    for (const devices::Controller& each : *connected)
        if (nameOf(each) == meant.name && (found == nullptr || each.path == meant.path))
            found = &each;
    if (found == nullptr)
        return Error{ErrorCode::io, "", missing};
    const std::lock_guard lock(mutex);
    if (choice == meant)
        now.path = found->path;
    return *found;
}

std::unique_ptr<live::LivePad> PadOutput::padFor(const Wanted& meant)
{
    if (meant.name.empty())
        return nullptr;
    live::PadDoor door;
    door.find = [this, meant]
    {
        return find(meant);
    };
    door.open = access.open;
    door.stopsOnCrash = stopsOnCrash;
    return std::make_unique<live::LivePad>(std::move(door), *queue, meant.fs, nullptr);
}

/// One that plays silence is sent nothing, and so it does not refuse anything when it is unplugged.
bool PadOutput::isStillThere(const Wanted& meant)
{
    const auto connected = access.list();
    const std::lock_guard lock(mutex);
    if (!connected || choice != meant ||
        std::any_of(connected->begin(), connected->end(), [&](const auto& each) { return each.path == now.path; }))
        return true;
    now.plays = false;
    now.lesser.clear();
    now.trouble = missing;
    return false;
}

/// What is slow, such as opening a device, happens while nobody waits for the lock.
void PadOutput::work()
{
    std::unique_ptr<live::LivePad> pad;
    Wanted served;
    int glances = 0;
    std::unique_lock lock(mutex);
    while (!ending)
    {
        if (choice != served)
        {
            served = choice;
            lock.unlock();
            pad.reset(); // it falls silent
            pad = padFor(served);
            lock.lock();
            continue;
        }
        if (!pad)
        {
            changed.wait(lock);
            continue;
        }
        lock.unlock();
        if (++glances % glancesToList == 0 && pad->isConnected() && !isStillThere(served))
        {
            pad.reset(); // only one at a time takes from the queue
            pad = padFor(served);
        }
        const live::PadNews news = pad->look();
        lock.lock();
        if (choice == served)
            note(served, *pad, news);
        if (!ending && choice == served)
            changed.wait_for(lock, glance);
    }
    lock.unlock();
    pad.reset();
}

void PadOutput::note(const Wanted& of, const live::LivePad& pad, const live::PadNews& news)
{
    now.name = of.name;
    now.plays = pad.isConnected();
    if (now.plays)
        now.trouble.clear();
    else
        now.lesser.clear();
    if (!news.lesser.empty())
        now.lesser = news.lesser;
    for (const auto& why : {news.stopped, news.notFound})
        if (why)
            now.trouble = why->message;
}

} // namespace pacini::plugin
