#include "devices/HidapiList.h"

#if defined(PACINI_HAS_HIDAPI)
#include <hidapi.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#if defined(__APPLE__)
#include <hidapi_darwin.h>
#elif defined(__linux__)
#include <fstream>
#include <iterator>
#endif
#endif

namespace pacini::devices
{

#if defined(PACINI_HAS_HIDAPI)

namespace
{
std::string utf8(const wchar_t* text)
{
    std::string bytes;
    for (; text != nullptr && *text != L'\0'; ++text)
    {
        const std::uint32_t code = std::char_traits<wchar_t>::to_int_type(*text);
        const auto add = [&](std::uint32_t byte)
        {
            bytes += static_cast<char>(static_cast<unsigned char>(byte));
        };
        const auto addRest = [&](int shift)
        {
            add(0x80u | (code >> shift & 0x3Fu));
        };
        if (code < 0x80u)
            add(code);
        else if (code < 0x800u)
        {
            add(0xC0u | code >> 6);
            addRest(0);
        }
        else if (code < 0xD800u || (code > 0xDFFFu && code < 0x10000u))
        {
            add(0xE0u | code >> 12);
            addRest(6);
            addRest(0);
        }
        else
            add('?'); // no controller has such a name
    }
    return bytes;
}

Transport transportOf([[maybe_unused]] const hid_device_info& info)
{
#if defined(HID_API_MAKE_VERSION) && HID_API_VERSION >= HID_API_MAKE_VERSION(0, 13, 0)
    if (info.bus_type == HID_API_BUS_USB)
        return Transport::usb;
    if (info.bus_type == HID_API_BUS_BLUETOOTH)
        return Transport::bluetooth;
#endif
    return Transport::unknown;
}

/// The report descriptor, nothing when it is not to be had.
#if defined(__linux__) // where this is only tested

std::vector<std::byte> hidDescriptor(const hid_device_info& info)
{
    const std::string path = info.path;
    std::ifstream file("/sys/class/hidraw" + path.substr(path.rfind('/')) + "/device/report_descriptor",
                       std::ios::binary);
    std::vector<std::byte> descriptor;
    for (std::istreambuf_iterator<char> byte(file), end; byte != end; ++byte)
        descriptor.push_back(static_cast<std::byte>(*byte));
    return descriptor;
}

#elif defined(HID_API_MAKE_VERSION) && HID_API_VERSION >= HID_API_MAKE_VERSION(0, 14, 0)

std::vector<std::byte> hidDescriptor(const hid_device_info& info)
{
    constexpr unsigned short hapticPage = 0x0E;
    if (info.usage_page != hapticPage)
        return {};
#if defined(__APPLE__)
    const int exclusive = hid_darwin_get_open_exclusive();
    hid_darwin_set_open_exclusive(0); // a mouse goes on moving while it is looked into
#endif
    const std::unique_ptr<hid_device, decltype(&hid_close)> device(hid_open_path(info.path), &hid_close);
#if defined(__APPLE__)
    hid_darwin_set_open_exclusive(exclusive);
#endif
    std::array<unsigned char, HID_API_MAX_REPORT_DESCRIPTOR_SIZE> bytes{};
    const int length = device ? hid_get_report_descriptor(device.get(), bytes.data(), bytes.size()) : 0;
    std::vector<std::byte> descriptor;
    for (int i = 0; i < length; ++i)
        descriptor.push_back(static_cast<std::byte>(bytes[static_cast<std::size_t>(i)]));
    return descriptor;
}

#else

std::vector<std::byte> hidDescriptor(const hid_device_info&)
{
    return {};
}

#endif

std::optional<WaveformDevice> waveformsOf(const hid_device_info& info)
{
    const auto device = waveformDevice(hidDescriptor(info));
    return device ? *device : std::nullopt;
}
} // namespace

Result<std::vector<Controller>> controllersByHidapi()
{
    if (hid_init() != 0)
        return Error{ErrorCode::io, "", "the system does not list its HID devices"};
    const std::unique_ptr<hid_device_info, decltype(&hid_free_enumeration)> first(hid_enumerate(0, 0),
                                                                                  &hid_free_enumeration);
    std::vector<Controller> controllers;
    for (const hid_device_info* info = first.get(); info != nullptr; info = info->next)
    {
        if (info->path == nullptr)
            continue;
        Controller controller{utf8(info->product_string), ControllerHaptics::waveforms, transportOf(*info), info->path};
        if (const auto haptics = controllerHaptics(info->vendor_id, info->product_id))
        {
            controller.haptics = *haptics;
            controller.product = info->product_id;
            controller.transport = transportByProduct(*haptics, info->product_id).value_or(controller.transport);
            if (hasMakersPage(*haptics) && info->usage_page < 0xFF00)
                continue;
        }
        else if (!(controller.waveforms = waveformsOf(*info)))
            continue;
        controllers.push_back(std::move(controller));
    }
    // A device with several uses is listed once for each.
    std::sort(controllers.begin(), controllers.end(),
              [](const Controller& a, const Controller& b) { return a.path < b.path; });
    const auto samePath = [](const Controller& a, const Controller& b)
    {
        return a.path == b.path;
    };
    controllers.erase(std::unique(controllers.begin(), controllers.end(), samePath), controllers.end());
    return controllers;
}

#else

Result<std::vector<Controller>> controllersByHidapi()
{
    return Error{ErrorCode::io, "", "this pacini was built without hidapi, which finds game controllers"};
}

#endif

} // namespace pacini::devices
