// The call `defaults`: default settings of encoding and rendering, for showing in knobs.

#include "web/core/Call.h"

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/analysis/Encoder.h>

namespace pacini::web
{

Result<void> tellDefaults(Call& call)
{
    const EncoderParams usual;
    call.value = {{"bands", usual.bands},
                  {"breakpoints", usual.breakpoints},
                  {"sensitivity", usual.onsets.sensitivity},
                  {"strength", standardStrength}};
    return {};
}

} // namespace pacini::web
