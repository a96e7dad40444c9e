#include "devices/HidapiController.h"

#if defined(PACINI_HAS_HIDAPI)
#include <hidapi.h>

#include <cstddef>
#include <cstdint>
#include <vector>
#endif

namespace pacini::devices
{

#if defined(PACINI_HAS_HIDAPI)

namespace
{
#if defined(__APPLE__)
constexpr const char* whatHelps = "; allow this program under Privacy & Security, Input Monitoring, and end other "
                                  "programs that use the controller";
#elif defined(_WIN32)
constexpr const char* whatHelps = "; end other programs that use the controller, and connect it anew";
#else
constexpr const char* whatHelps = "; may this user open it?";
#endif

/// hidapi's words for what went wrong last with a device, or with opening one. They are English on all systems but
/// Windows, where letters beyond ASCII become question marks.
std::string hidapiWords(hid_device* device)
{
    std::string words;
    const wchar_t* text = hid_error(device);
    for (; text != nullptr && *text != L'\0'; ++text)
        words += *text == L'\n' || *text == L'\r' ? ' ' : *text < 0x80 ? static_cast<char>(*text) : '?';
    return words.empty() ? "the system does not say why" : words;
}

class HidapiController : public OpenController
{
public:
    explicit HidapiController(hid_device* openDevice) noexcept : device(openDevice, &hid_close) {}

    void prepare(const StopReports&) override {}

    Result<void> send(const Report& report) override
    {
        const auto bytes = report.content();
        const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
        const int sent = report.isFeature() ? hid_send_feature_report(device.get(), data, bytes.size())
                                            : hid_write(device.get(), data, bytes.size());
        if (sent < 0)
            return failure();
        return {};
    }

    Result<std::vector<std::byte>> feature(std::uint8_t report, std::size_t bytes) override
    {
        std::vector<unsigned char> answer(bytes);
        answer.at(0) = report;
        const int length = hid_get_feature_report(device.get(), answer.data(), answer.size());
        if (length < 0)
            return failure();
        std::vector<std::byte> content;
        for (std::size_t i = 0; i < bytes && i < static_cast<std::size_t>(length); ++i)
            content.push_back(static_cast<std::byte>(answer[i]));
        return content;
    }

private:
    [[nodiscard]] Error failure() const
    {
        return {ErrorCode::io, "",
                "does not answer any more (" + hidapiWords(device.get()) + "); was it unplugged or switched off?"};
    }

    std::unique_ptr<hid_device, decltype(&hid_close)> device;
};
} // namespace

Result<std::unique_ptr<OpenController>> openByHidapi(const std::string& path)
{
    hid_device* device = hid_init() == 0 ? hid_open_path(path.c_str()) : nullptr;
    if (device == nullptr)
        return Error{ErrorCode::io, "", "cannot be opened (" + hidapiWords(nullptr) + ")" + whatHelps};
    return std::unique_ptr<OpenController>(std::make_unique<HidapiController>(device));
}

#else

Result<std::unique_ptr<OpenController>> openByHidapi(const std::string&)
{
    return Error{ErrorCode::io, "", "cannot be opened, as this pacini was built without hidapi"};
}

#endif

} // namespace pacini::devices
