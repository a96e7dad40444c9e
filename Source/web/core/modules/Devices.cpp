// The module of game controllers: the bytes that play a clip.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"reports", listReports},
    };
    return all;
}

} // namespace pacini::web
