#include "phone/QrText.h"

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

} // namespace pacini::phone
