// The module of Pacini's own method: sounds to clips.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"encode", encodeSound},
    };
    return all;
}

} // namespace pacini::web
