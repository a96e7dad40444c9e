#include "devices/HidList.h"

#if defined(__linux__) && !defined(PACINI_AS_OTHER_SYSTEMS)
#include "devices/HidrawList.h"
#else
#include "devices/HidapiList.h"
#endif

namespace pacini::devices
{

Result<std::vector<Controller>> connectedControllers()
{
#if defined(__linux__) && !defined(PACINI_AS_OTHER_SYSTEMS)
    return hidrawControllers();
#else
    return controllersByHidapi();
#endif
}

} // namespace pacini::devices
