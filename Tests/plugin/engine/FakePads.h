#pragma once

// Controllers that are not there, for the plugin: they note what they are sent, and can be unplugged.

#include "devices/ControllerReports.h"
#include "plugin/engine/PadOutput.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace pacini::test
{

/// One controller, as the system has it: who opens it keeps others out.
struct FakePad
{
    using Clock = std::chrono::steady_clock;
    struct Sent
    {
        Clock::time_point time;
        devices::Report report;
    };

    explicit FakePad(std::string named = "Wireless Controller", std::string at = "/dev/fake0",
                     devices::ControllerHaptics kind = devices::ControllerHaptics::dualShock4)
        : controller{std::move(named), kind, devices::Transport::usb, std::move(at)}
    {
    }

    [[nodiscard]] devices::ControllerModel model() const
    {
        return devices::usualModel(controller.haptics, controller.transport);
    }

    [[nodiscard]] bool isSilent(const devices::Report& report) const
    {
        return report == devices::reportOf(model(), devices::silentState(model()), 0);
    }

    [[nodiscard]] std::vector<Sent> sent() const
    {
        const std::lock_guard lock(mutex);
        return reports;
    }

    /// How many were not silent.
    [[nodiscard]] std::size_t felt() const
    {
        std::size_t count = 0;
        for (const Sent& each : sent())
            count += isSilent(each.report) ? 0u : 1u;
        return count;
    }

    void clear()
    {
        const std::lock_guard lock(mutex);
        reports.clear();
    }

    devices::Controller controller;
    std::atomic<bool> isPlugged{true}, isOpen{false}, isRefused{false};
    std::atomic<bool> isMute{false}; ///< it is listed and opens, and takes nothing
    std::atomic<int> armed{0};
    mutable std::mutex mutex;
    std::vector<Sent> reports;
    std::string lesser;
};

class OpenFakePad final : public devices::OpenController
{
public:
    explicit OpenFakePad(FakePad& of) : pad(of) {}
    ~OpenFakePad() override { pad.isOpen = false; }

    void prepare(const devices::StopReports&) override { ++pad.armed; }

    Result<void> send(const devices::Report& report) override
    {
        if (!pad.isPlugged || pad.isMute)
            return Error{ErrorCode::io, "", "does not answer any more; was it unplugged or switched off?"};
        const std::lock_guard lock(pad.mutex);
        pad.reports.push_back({FakePad::Clock::now(), report});
        return {};
    }

    Result<std::vector<std::byte>> feature(std::uint8_t, std::size_t) override
    {
        return Error{ErrorCode::io, "", "does not tell what it can play"};
    }

private:
    FakePad& pad;
};

/// Access to these alone.
inline plugin::PadAccess accessTo(std::vector<FakePad*> pads)
{
    plugin::PadAccess access;
    access.list = [pads]() -> Result<std::vector<devices::Controller>>
    {
        std::vector<devices::Controller> connected;
        for (const FakePad* pad : pads)
            if (pad->isPlugged)
                connected.push_back(pad->controller);
        return connected;
    };
    access.open = [pads](const devices::Controller& wanted) -> Result<live::OpenedController>
    {
        for (FakePad* pad : pads)
            if (pad->controller.path == wanted.path)
            {
                if (pad->isRefused || pad->isOpen.exchange(true))
                    return Error{ErrorCode::io, "", "is in use by another program; end that first"};
                live::OpenedController opened{wanted, std::make_unique<OpenFakePad>(*pad), pad->model()};
                opened.name = plugin::nameOf(wanted);
                opened.lesser = pad->lesser;
                return opened;
            }
        return Error{ErrorCode::io, "", "is gone"};
    };
    return access;
}

/// Whether something comes true within some seconds.
inline bool becomes(const std::function<bool()>& claim, double seconds = 10.0)
{
    const auto end = FakePad::Clock::now() + std::chrono::duration<double>(seconds);
    while (!claim())
    {
        if (FakePad::Clock::now() > end)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

} // namespace pacini::test
