#include "cli/measure/RigInput.h"

#include "cli/ProfileInput.h"

#include <utility>

namespace pacini::cli
{

std::optional<RigInput> openRig(Console& console, const std::string& profile, const std::string& drive)
{
    const auto failed = [&console](const std::string& file, const Error& error)
    {
        (void)console.fail(file, error);
        return std::nullopt;
    };
    auto actuator = openProfile(console, profile);
    if (!actuator)
        return std::nullopt;
    if (!actuator->body)
        return failed(profile, {ErrorCode::invalidData, "body", "is missing; choose a profile with a body model"});
    if (actuator->technology == Technology::erm)
        return failed(profile, {ErrorCode::invalidData, "technology", "is a motor, which plays no waveform"});
    AudioReadOptions options;
    options.lowestSampleRate = limits::lowestWrittenRate;
    auto sound = readAudio(drive, options);
    if (!sound)
        return failed(drive, sound.error());
    console.warnings(drive, sound->warnings);
    if (sound->channels != 1)
        return failed(drive, {ErrorCode::invalidData, "", "must have one channel"});
    return RigInput{std::move(*actuator), std::move(*sound)};
}

} // namespace pacini::cli
