// The calls `encode`, from a sound to a clip by Pacini's own method, and `parameters`, its settings.

#include "web/core/Call.h"
#include "web/core/SoundInput.h"
#include "web/core/TranslationInput.h"

#include <pacini/analysis/Encoder.h>

#include <utility>

namespace pacini::web
{

Result<void> encodeSound(Call& call)
{
    const auto translation = readTranslation(call);
    SoundInput sound(call);
    if (auto known = call.finishOptions(); !known)
        return known;
    if (!translation)
        return translation.error();
    Encoder encoder(translation->params);
    auto clip = pacini::encodeSound(encoder, sound.sound(), sound);
    if (!clip)
        return clip.error();
    return sound.put(std::move(*clip));
}

Result<void> describeParameters(Call& call)
{
    call.value["parameters"] = translationDescriptionsJson();
    return {};
}

} // namespace pacini::web
