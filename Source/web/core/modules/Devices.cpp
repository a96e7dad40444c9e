// The module of game controllers and phones: what plays a clip on them.

#include "web/core/Call.h"

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr NamedHandler all[]{{"reports", listReports}, {"rumble", planRumble}, {"touch", planTouch}};
    return all;
}

} // namespace pacini::web
