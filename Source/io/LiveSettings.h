#pragma once

// Live parameters from settings files.

#include "io/Settings.h"

namespace pacini
{

/// The live parameters of `settings`. Errors: invalidData at `live` where there are none.
[[nodiscard]] inline Result<TranslatorParams> liveParamsOf(const Settings& settings)
{
    if (!settings.playback.live)
        return Error{ErrorCode::invalidData, "live", "is missing: these are no settings of live parameters"};
    return *settings.playback.live;
}

} // namespace pacini
