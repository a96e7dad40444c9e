#if defined(PACINI_HAS_HIDAPI)

#include "devices/HidSource.h"

#if defined(__linux__)
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#else
#include <array>
#include <memory>
#if defined(__APPLE__)
#include <hidapi_darwin.h>
#endif
#endif

namespace pacini::devices
{

#if defined(__linux__)

std::vector<std::byte> hidDescriptor(const hid_device_info& info)
{
    const std::string node = std::filesystem::path(info.path).filename().string();
    std::ifstream file("/sys/class/hidraw/" + node + "/device/report_descriptor", std::ios::binary);
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

} // namespace pacini::devices

#endif
