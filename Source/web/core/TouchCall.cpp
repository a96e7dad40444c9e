// The calls `rumble` and `touch`: what the two motors of a controller, and one that is only on or off, play of a clip.

#include "devices/ClipRumble.h"
#include "devices/TouchPlan.h"
#include "web/core/Call.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

namespace pacini::web
{

Result<void> planTouch(Call& call)
{
    auto clip = clipOf(call, 0);
    if (!clip)
        return clip.error();
    const devices::TouchPlan plan = devices::touchPlan(*clip);
    Json touches = Json::array();
    for (const devices::Touch& touch : plan.touches)
        touches.push_back({std::llround(1000.0 * touch.start), std::llround(1000.0 * touch.end)});
    call.value = {{"touches", std::move(touches)}, {"events", plan.events}, {"leftOut", plan.leftOut}};
    return {};
}

Result<void> planRumble(Call& call)
{
    auto clip = clipOf(call, 0);
    if (!clip)
        return clip.error();
    const devices::ControllerModel motors{devices::ControllerHaptics::xbox, devices::Transport::usb};
    const double end = std::min(clip->duration, devices::longestTouched.value);
    const auto& [strong, weak] = devices::motorCurves(motors); // of eccentric masses, as most are
    std::vector<float> levels;
    if (end > 0.0)
    {
        devices::ClipRumble rumble(*clip, {Seconds(0.0), Seconds(end)}, Decibels(0.0), motors);
        for (std::int64_t packet = 0; const auto state = rumble.at(packet); ++packet)
        {
            const auto& each = std::get<devices::MotorLevels>(*state);
            levels.push_back(static_cast<float>(strong.command(each.strong)));
            levels.push_back(static_cast<float>(weak.command(each.weak)));
        }
    }
    call.value["interval"] = devices::pacingOf(motors).interval.value;
    call.put(levels);
    return {};
}

} // namespace pacini::web
