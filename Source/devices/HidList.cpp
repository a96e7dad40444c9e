#include "devices/HidList.h"

#if defined(__linux__) && !defined(PACINI_AS_OTHER_SYSTEMS)
#include "devices/HidrawList.h"
#else
#include "devices/HidapiList.h"
#endif

#include <algorithm>

namespace pacini::devices
{

Result<std::vector<Controller>> connectedControllers()
{
#if defined(__linux__) && !defined(PACINI_AS_OTHER_SYSTEMS)
    auto controllers = hidrawControllers();
#else
    auto controllers = controllersByHidapi();
#endif
    if (!controllers)
        return controllers;
    // A device with several uses may be listed once for each.
    auto& all = *controllers;
    std::sort(all.begin(), all.end(), [](const Controller& a, const Controller& b) { return a.path < b.path; });
    const auto samePath = [](const Controller& a, const Controller& b)
    {
        return a.path == b.path;
    };
    all.erase(std::unique(all.begin(), all.end(), samePath), all.end());
    return controllers;
}

} // namespace pacini::devices
