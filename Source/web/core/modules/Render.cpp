// The module of clips in Pacini's own formats, and of rendering them for actuators.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"defaults", tellDefaults},   NamedHandler{"formats", listFormats},
        NamedHandler{"read", readClipBytes},      NamedHandler{"write", writeClipBytes},
        NamedHandler{"lint", lintClip},           NamedHandler{"render", renderClipOrScene},
        NamedHandler{"profile", describeProfile},
    };
    return all;
}

} // namespace pacini::web
