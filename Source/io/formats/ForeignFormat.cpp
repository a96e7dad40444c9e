#include "io/formats/ForeignFormat.h"

#include <algorithm>

namespace pacini
{

std::span<const ForeignFormat> foreignFormats()
{
    return {};
}

const ForeignFormat* foreignFormatNamed(std::string_view name)
{
    const auto formats = foreignFormats();
    const auto found =
        std::find_if(formats.begin(), formats.end(), [&](const ForeignFormat& format) { return format.name == name; });
    return found == formats.end() ? nullptr : &*found;
}

} // namespace pacini
