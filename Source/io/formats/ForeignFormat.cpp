#include "io/formats/ForeignFormat.h"

#include "io/formats/ahap/AhapFormat.h"
#include "io/formats/android/AndroidFormat.h"
#include "io/formats/csv/CsvFormat.h"
#include "io/formats/haps/HapsFormat.h"
#include "io/formats/haptic/HapticFormat.h"
#include "io/formats/hasp/HaspFormat.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/samples/PcmFormat.h"
#include "io/formats/tact/TactFormat.h"
#include "io/formats/vij/VijFormat.h"

#include <algorithm>
#include <array>

namespace pacini
{

std::span<const ForeignFormat> foreignFormats()
{
    static const std::array formats{
        hapticFormat(),       vijFormat(),         haspFormat(),       ahapFormat(),          hjifFormat(),
        hapsFormat(),         androidJsonFormat(), androidXmlFormat(), androidKotlinFormat(), androidJavaFormat(),
        openXrHeaderFormat(), openXrJsonFormat(),  tactFormat(),       csvFormat(),           wav8Format(),
        wav16Format(),        raw8Format(),        raw16Format(),      cArrayFormat()};
    return formats;
}

const ForeignFormat* foreignFormatOf(std::string_view extension, std::string_view bytes)
{
    const ForeignFormat* found = nullptr;
    const ForeignFormat* byName = nullptr;
    for (const ForeignFormat& format : foreignFormats())
    {
        if (format.read == nullptr)
            continue;
        const bool named = format.extension == extension;
        const bool recognised = format.recognises != nullptr && format.recognises(bytes);
        if (recognised && named)
            return &format;
        if (recognised && found == nullptr)
            found = &format;
        if (named && byName == nullptr)
            byName = &format;
    }
    if (found == nullptr && extension != ".json")
        found = byName;
    return found;
}

const ForeignFormat* foreignFormatNamed(std::string_view name)
{
    const auto formats = foreignFormats();
    const auto found =
        std::find_if(formats.begin(), formats.end(), [&](const ForeignFormat& format) { return format.name == name; });
    return found == formats.end() ? nullptr : &*found;
}

std::string_view lossName(LossKind kind)
{
    constexpr std::array<std::string_view, 11> names{"bands",    "points",    "length",   "frequency",
                                                     "timeStep", "amplitude", "crowding", "event",
                                                     "noise",    "empty",     "text"};
    return names[static_cast<std::size_t>(kind)];
}

} // namespace pacini
