#pragma once

// Clip building that all translation methods share.

#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/clip/BandPriority.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// A clip of the sound's duration without bands, with the method and its curve parameters on record (times in seconds).
/// Name, source file, rate and channels are left to the caller.
[[nodiscard]] inline Clip startMethodClip(std::string_view method, const MethodSound& sound,
                                          const MethodCurveParams& params)
{
    const auto time = [](Seconds value)
    {
        return clampTo(value.value, 0.0, 3600.0); // as the follower clamps it
    };
    Clip clip;
    clip.duration = sound.duration.value;
    clip.encoder = {{"method", std::string(method)},
                    {"breakpoints", clampedBreakpoints(params)},
                    {"attack", time(params.follower.attack)},
                    {"hold", time(params.follower.hold)},
                    {"release", time(params.follower.release)},
                    {"gain", sound.gain}};
    return clip;
}

} // namespace pacini
