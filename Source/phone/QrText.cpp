#include "phone/QrText.h"

#include <fmt/format.h>

#if PACINI_HAS_QRCODEGEN
#include <qrcodegen/qrcodegen.hpp>
#endif

namespace pacini::phone
{

#if PACINI_HAS_QRCODEGEN
QrModules qrModules(const std::string& text)
{
    const auto code = qrcodegen::QrCode::encodeText(text.c_str(), qrcodegen::QrCode::Ecc::MEDIUM);
    const auto size = static_cast<std::size_t>(code.getSize());
    QrModules modules(size, std::vector<bool>(size));
    for (std::size_t y = 0; y < size; ++y)
        for (std::size_t x = 0; x < size; ++x)
            modules[y][x] = code.getModule(static_cast<int>(x), static_cast<int>(y));
    return modules;
}
#else
QrModules qrModules(const std::string&)
{
    return {};
}
#endif

std::string qrText(const QrModules& modules, bool inverted)
{
    constexpr std::ptrdiff_t border = 4;
    const auto size = static_cast<std::ptrdiff_t>(modules.size());
    // What is drawn is light: terminals are dark.
    const auto isLit = [&](std::ptrdiff_t x, std::ptrdiff_t y)
    {
        const bool inside = x >= 0 && y >= 0 && x < size && y < size;
        const bool dark = inside && modules[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
        return dark == inverted && y < size + border;
    };
    std::string text;
    for (std::ptrdiff_t y = -border; y < size + border; y += 2)
    {
        for (std::ptrdiff_t x = -border; x < size + border; ++x)
        {
            const bool upper = isLit(x, y), lower = isLit(x, y + 1);
            text += upper && lower ? "\u2588" : upper ? "\u2580" : lower ? "\u2584" : " ";
        }
        text += "\n";
    }
    return text;
}

std::string qrSvg(const QrModules& modules)
{
    constexpr std::size_t border = 4;
    if (modules.empty())
        return {};
    const std::size_t side = modules.size() + 2 * border;
    std::string svg =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {0}\" "
                    "shape-rendering=\"crispEdges\"><path fill=\"#fff\" d=\"M0 0h{0}v{0}H0z\"/><path d=\"",
                    side);
    for (std::size_t y = 0; y < modules.size(); ++y)
        for (std::size_t x = 0; x < modules.size(); ++x)
            if (modules[y][x])
                svg += fmt::format("M{} {}h1v1h-1z", x + border, y + border);
    return svg + "\"/></svg>";
}

} // namespace pacini::phone
