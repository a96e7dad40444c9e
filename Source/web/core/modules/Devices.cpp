// The module of game controllers and phones: what plays a clip on them.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"reports", listReports},
        NamedHandler{"rumble", planRumble},
        NamedHandler{"touch", planTouch},
    };
    return all;
}

} // namespace pacini::web
