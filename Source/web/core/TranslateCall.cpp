// The call `translate`: a sound to a clip, or to a drive signal, by the methods that Pacini's own is compared with.

#include "web/core/Call.h"
#include "web/core/SoundInput.h"
#include "web/core/TranslationInput.h"

#include <pacini/analysis/MonoMix.h>
#include <pacini/analysis/methods/Method.h>
#include <pacini/clip/PackedClip.h>

#include <cstddef>
#include <span>
#include <vector>

namespace pacini::web
{

Result<void> translateSound(Call& call)
{
    const auto translation = readTranslation(call);
    SoundInput sound(call);
    if (auto known = call.finishOptions(); !known)
        return known;
    if (!translation)
        return translation.error();
    const MethodInfo& info = methodInfo(translation->method);
    const SoundFormat format = sound.sound();
    std::vector<float> samples;
    if (auto read =
            forEachPart(format, sound,
                        [&](std::span<const float> part) { samples.insert(samples.end(), part.begin(), part.end()); });
        !read)
        return read;
    samples = monoMix(samples, static_cast<std::size_t>(format.channels));
    if (info.output == MethodOutput::clip)
        return sound.put(onGrids(translateToClip(info.method, samples, format.sampleRate, translation->choices)));
    call.value["signal"] = true;
    call.put(std::span<const float>(translateToSignal(info.method, samples, format.sampleRate)));
    return {};
}

} // namespace pacini::web
