// The call `translate`: a sound to a clip, or to a drive signal, by the methods that Pacini's own is compared with.

#include "web/core/Call.h"
#include "web/core/SoundInput.h"

#include <pacini/analysis/MonoMix.h>
#include <pacini/analysis/methods/Method.h>
#include <pacini/clip/PackedClip.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pacini::web
{

namespace
{
MethodChoices choicesOf(Call& call, const MethodInfo& info)
{
    const auto choice = [&](const char* name, double low, double high)
    {
        const auto value = call.optionalNumber(name, low, high);
        if (value && !hasOption(info, name))
            call.reader.fail(name, fmt::format("is no option of the method {}; leave it out", info.name),
                             ErrorCode::invalidArgument);
        return value;
    };
    MethodChoices choices;
    if (const auto bands = choice("bands", 1.0, 32.0))
        choices.bands = static_cast<std::size_t>(*bands);
    if (const auto quantise = choice("quantise", 4.0, 16.0))
        choices.quantise = static_cast<int>(*quantise);
    choices.breakpoints = choice("breakpoints", 0.5, 1000.0);
    choices.lowFrequency = choice("low", 1.0, 1700.0);
    choices.highFrequency = choice("high", 2.0, 1800.0);
    choice("audible", 0.0, 1.0);
    choice("sensitivity", 0.25, 4.0);
    return choices;
}
} // namespace

Result<void> translateSound(Call& call)
{
    const std::string name = call.word("method", "");
    const auto method = methodNamed(name);
    if (!method || *method == Method::a2vt)
        return Error{ErrorCode::invalidArgument, "method", fmt::format("'{}' is not known", name)};
    const MethodInfo& info = methodInfo(*method);
    const MethodChoices choices = choicesOf(call, info);
    SoundInput sound(call);
    if (call.reader.error)
        return {};
    const SoundFormat format = sound.sound();
    std::vector<float> samples;
    if (auto read =
            forEachPart(format, sound,
                        [&](std::span<const float> part) { samples.insert(samples.end(), part.begin(), part.end()); });
        !read)
        return read;
    samples = monoMix(samples, static_cast<std::size_t>(format.channels));
    if (info.output == MethodOutput::clip)
        return sound.put(onGrids(translateToClip(*method, samples, format.sampleRate, choices)));
    call.value["signal"] = true;
    call.put(std::span<const float>(translateToSignal(*method, samples, format.sampleRate)));
    return {};
}

} // namespace pacini::web
