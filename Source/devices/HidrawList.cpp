#if defined(__linux__)

#include "devices/HidrawList.h"

#include "devices/HidItem.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <utility>

namespace pacini::devices
{

namespace
{
constexpr const char* allNodes = "/sys/class/hidraw";

/// A file of the system, which are small.
std::string contentOf(const std::string& path)
{
    std::string content;
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return content;
    std::array<char, 4096> some{};
    for (::ssize_t got = 0; (got = ::read(file, some.data(), some.size())) > 0;)
        content.append(some.data(), static_cast<std::size_t>(got));
    ::close(file);
    return content;
}

/// The value of a line `key=value`.
std::string valueOf(const std::string& lines, const std::string& key)
{
    for (std::size_t at = 0; at < lines.size();)
    {
        const std::size_t end = std::min(lines.find('\n', at), lines.size());
        if (lines.compare(at, key.size(), key) == 0 && at + key.size() < end && lines[at + key.size()] == '=')
            return lines.substr(at + key.size() + 1, end - at - key.size() - 1);
        at = end + 1;
    }
    return {};
}

struct HidId
{
    unsigned long bus = 0, maker = 0, product = 0;
};

/// Of `0003:0000057E:00002009`.
HidId hidId(const std::string& text)
{
    HidId id;
    const char* at = text.c_str();
    for (unsigned long* const number : {&id.bus, &id.maker, &id.product})
    {
        char* end = nullptr;
        *number = std::strtoul(at, &end, 16);
        at = *end == ':' ? end + 1 : end;
    }
    return id;
}

Transport transportOf(unsigned long bus) noexcept
{
    // Source: Linux, input.h.
    return bus == 0x03 ? Transport::usb : bus == 0x05 ? Transport::bluetooth : Transport::unknown;
}

bool holdsMakersPage(std::span<const std::byte> descriptor) noexcept
{
    constexpr int usagePage = 0;
    for (std::size_t at = 0; at < descriptor.size();)
    {
        const auto item = nextHidItem(descriptor, at);
        if (!item)
            return false;
        if (item->type == HidItem::globalType && item->tag == usagePage && item->number >= 0xFF00u)
            return true;
    }
    return false;
}

/// What a node is called by its maker; the name of Linux has the maker before it.
std::string nameOf(const std::string& folder, const std::string& lines, Transport transport)
{
    std::string name = transport == Transport::usb ? contentOf(folder + "/../../product") : std::string();
    while (!name.empty() && (name.back() == '\n' || name.back() == '\0'))
        name.pop_back();
    return name.empty() ? valueOf(lines, "HID_NAME") : name;
}

/// The device of a node, if it is haptic.
std::optional<Controller> controllerOf(const std::string& node)
{
    const std::string folder = std::string(allNodes) + "/" + node + "/device";
    const std::string lines = contentOf(folder + "/uevent");
    const HidId id = hidId(valueOf(lines, "HID_ID"));
    const std::string descriptor = contentOf(folder + "/report_descriptor");
    const auto bytes = std::as_bytes(std::span(descriptor.data(), descriptor.size()));
    Controller controller{"", ControllerHaptics::waveforms, transportOf(id.bus), "/dev/" + node};
    const auto product = static_cast<std::uint16_t>(id.product);
    if (const auto haptics = controllerHaptics(static_cast<std::uint16_t>(id.maker), product))
    {
        if (hasMakersPage(*haptics) && !holdsMakersPage(bytes))
            return std::nullopt;
        controller.haptics = *haptics;
        controller.product = product;
        controller.transport = transportByProduct(*haptics, product).value_or(controller.transport);
    }
    else
    {
        const auto device = waveformDevice(bytes);
        if (!device || !*device)
            return std::nullopt;
        controller.waveforms = *device;
    }
    controller.name = nameOf(folder, lines, transportOf(id.bus));
    return controller;
}

/// The nodes by the names of their files, in order.
std::vector<std::string> nodes()
{
    std::vector<std::string> names;
    const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir(allNodes), &::closedir);
    if (!folder) // without any device, Linux may have no such folder
        return names;
    while (const dirent* const entry = ::readdir(folder.get()))
        if (entry->d_name[0] != '.')
            names.emplace_back(entry->d_name);
    std::sort(names.begin(), names.end());
    return names;
}
} // namespace

std::vector<std::string> sendingNodes(const std::vector<std::string>& nodes)
{
    constexpr int patience = 40; // ms: a controller sends every 4 ms, or on some connections every 16
    std::vector<pollfd> files;
    for (const std::string& node : nodes)
        files.push_back({::open(node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC), POLLIN, 0}); // below 0 is not asked
    ::usleep(1000 * patience);
    std::vector<std::string> sending;
    if (::poll(files.data(), files.size(), 0) > 0)
        for (std::size_t i = 0; i < files.size(); ++i)
            if ((files[i].revents & POLLIN) != 0)
                sending.push_back(nodes[i]);
    for (const pollfd& file : files)
        if (file.fd >= 0)
            ::close(file.fd);
    return sending.empty() ? nodes : sending;
}

Result<std::vector<Controller>> hidrawControllers()
{
    std::vector<Controller> controllers;
    std::vector<std::string> ofReceivers;
    for (const std::string& node : nodes())
        if (auto controller = controllerOf(node))
        {
            if (controller->transport == Transport::receiver)
                ofReceivers.push_back(controller->path);
            controllers.push_back(std::move(*controller));
        }
    if (ofReceivers.size() < 2)
        return controllers;
    const auto sending = sendingNodes(ofReceivers);
    const auto isUnused = [&](const Controller& controller)
    {
        return controller.transport == Transport::receiver &&
               std::find(sending.begin(), sending.end(), controller.path) == sending.end();
    };
    controllers.erase(std::remove_if(controllers.begin(), controllers.end(), isUnused), controllers.end());
    return controllers;
}

} // namespace pacini::devices

#endif
