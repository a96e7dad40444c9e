// The call `encode`: a sound to a clip, or to a drive signal by methods that make no clip.

#include "io/ClipSeal.h"
#include "io/SoundEncoder.h"
#include "io/formats/ClipFormat.h"
#include "web/core/Call.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/clip/PackedClip.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pacini::web
{

namespace
{
SoundEncoderParams paramsOf(Call& call, const MethodInfo& info)
{
    SoundEncoderParams params;
    params.method = info.method;
    EncoderParams& own = params.params;
    const auto choice = [&](const char* name, double low, double high)
    {
        const auto value = call.optionalNumber(name, low, high);
        if (value && !hasOption(info, name))
            call.reader.fail(name, fmt::format("is no option of the method {}; leave it out", info.name),
                             ErrorCode::invalidArgument);
        return value;
    };
    const auto bands = choice("bands", 1.0, 32.0);
    params.choices.breakpoints = choice("breakpoints", 0.5, 1000.0);
    const auto quantise = choice("quantise", 4.0, 16.0);
    params.choices.lowFrequency = choice("low", 1.0, 1700.0);
    params.choices.highFrequency = choice("high", 2.0, 1800.0);
    if (bands)
        params.choices.bands = static_cast<std::size_t>(*bands);
    if (quantise)
        params.choices.quantise = static_cast<int>(*quantise);
    own.bands = static_cast<int>(bands.value_or(own.bands));
    own.breakpoints = params.choices.breakpoints.value_or(own.breakpoints);
    own.quantise = static_cast<int>(quantise.value_or(own.quantise));
    own.lowFrequency = params.choices.lowFrequency.value_or(own.lowFrequency);
    own.highFrequency = params.choices.highFrequency.value_or(own.highFrequency);
    own.audible = choice("audible", 0.0, 1.0).value_or(own.audible);
    own.onsets.sensitivity = choice("sensitivity", 0.25, 4.0).value_or(own.onsets.sensitivity);
    own.normalise = !call.truth("keepLevel", !own.normalise);
    const std::string spacing = call.word("spacing", "log");
    if (spacing != "log" && spacing != "linear")
        call.reader.fail("spacing", "must be log or linear", ErrorCode::invalidArgument);
    own.spacing = spacing == "log" ? BandSpacing::logarithmic : BandSpacing::linear;
    return params;
}
} // namespace

Result<void> tellDefaults(Call& call)
{
    const EncoderParams usual;
    call.value = {{"bands", usual.bands},
                  {"breakpoints", usual.breakpoints},
                  {"sensitivity", usual.onsets.sensitivity},
                  {"strength", standardStrength}};
    return {};
}

Result<void> encodeSound(Call& call)
{
    const std::string methodName = call.word("method", "a2vt");
    const auto method = methodNamed(methodName);
    if (!method)
        return Error{ErrorCode::invalidArgument, "method", fmt::format("'{}' is not known", methodName)};
    const MethodInfo& info = methodInfo(*method);
    const SoundEncoderParams params = paramsOf(call, info);
    const auto rate =
        static_cast<int>(call.number("sampleRate", 0.0, limits::lowestSampleRate, limits::highestSampleRate));
    const auto channels = static_cast<int>(call.number("channels", 1.0, 1.0, limits::channels));
    const auto frames = static_cast<std::uint64_t>(call.number("frames", 0.0, 0.0, 1e12));
    std::string name = call.word("name", ""), source = call.word("source", "");
    const std::string formatName = call.word("format", "json");
    const ClipFormat* format = clipFormatNamed(formatName);
    if (format == nullptr || !format->isOwn())
        return Error{ErrorCode::invalidArgument, "format", "must be json or packed"};
    if (call.reader.error)
        return {};
    if (rate == 0)
        return Error{ErrorCode::invalidArgument, "sampleRate", "is missing"};
    if (auto valid = validate(params.params); !valid)
        return valid;
    std::vector<float> buffer(soundPartLength(static_cast<std::size_t>(channels)));
    std::uint64_t done = 0;
    const auto next = [&]() -> SoundPart
    {
        const std::size_t got = call.pullSound(buffer);
        const auto samples = std::span<const float>(buffer).first(got * static_cast<std::size_t>(channels));
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (!std::isfinite(samples[i]))
                return Error{ErrorCode::notFinite,
                             fmt::format("frame {}, channel {}", done + i / static_cast<std::size_t>(channels),
                                         i % static_cast<std::size_t>(channels)),
                             "is no finite number"};
        done += got;
        return samples;
    };
    SoundEncoder encoder(params);
    Stopwatch work;
    const SoundFormat sound{rate, channels, frames, std::nullopt};
    if (info.output == MethodOutput::signal)
    {
        const auto signal = encoder.signalOf(sound, next, work);
        if (!signal)
            return signal.error();
        call.value["signal"] = true;
        call.put(std::span<const float>(*signal));
        return {};
    }
    auto clip = encoder.clipOf(sound, next, work);
    if (!clip)
        return clip.error();
    clip->name = wellFormedUtf8(std::move(name));
    clip->source.file = wellFormedUtf8(std::move(source));
    Clip finished = onGrids(std::move(*clip));
    sealClip(finished);
    const auto written = format->write(finished);
    if (!written)
        return written.error();
    call.put(written->files.front().bytes);
    return {};
}

} // namespace pacini::web
