#include "cli/plot/Canvas.h"

#include <cstddef>
#include <cstdint>

namespace pacini::plot
{

namespace
{
/// Bytes of the well-formed character (RFC 3629) at the start of `text`; 0 when there is none.
std::size_t characterLength(std::string_view text)
{
    const auto byte = [&](std::size_t i)
    {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
    };
    const std::uint32_t first = byte(0);
    if (first < 0x80)
        return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length)
        return 0;
    std::uint32_t code = first & (0xffu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i)
    {
        if ((byte(i) & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (byte(i) & 0x3f);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    const bool notForXml = code == 0xfffe || code == 0xffff;
    return overlong || surrogate || notForXml || code > 0x10ffff ? 0 : length;
}
} // namespace

std::string printable(std::string_view text)
{
    std::string result;
    while (!text.empty())
    {
        const std::size_t length = characterLength(text);
        const auto first = static_cast<unsigned char>(text.front());
        if (length == 0 || first < 0x20 || first == 0x7f)
            result += "\xef\xbf\xbd";
        else
            result += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return result;
}

std::string shortened(const Canvas& canvas, std::string_view text, const TextStyle& style, double width)
{
    std::string whole = printable(text);
    if (canvas.textWidth(whole, style) <= width)
        return whole;
    constexpr std::string_view ellipsis = "\xe2\x80\xa6";
    while (!whole.empty())
    {
        while (!whole.empty() && (static_cast<unsigned char>(whole.back()) & 0xc0) == 0x80)
            whole.pop_back();
        if (!whole.empty())
            whole.pop_back();
        if (canvas.textWidth(whole + std::string(ellipsis), style) <= width)
            break;
    }
    return whole + std::string(ellipsis);
}

} // namespace pacini::plot
