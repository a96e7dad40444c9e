// The module of the formats of other programs.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"read", readClipBytes},
        NamedHandler{"write", writeClipBytes},
        NamedHandler{"lint", lintClip},
        NamedHandler{"exportParameters", describeExports},
    };
    return all;
}

} // namespace pacini::web
