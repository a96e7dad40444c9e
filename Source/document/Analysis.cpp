#include "document/Analysis.h"

#include <pacini/analysis/EncodeSound.h>

#include <algorithm>
#include <cstddef>

namespace pacini
{

namespace
{
// The curves are fitted when all samples have been read, which takes about as long as a tenth of them.
constexpr double shareOfReading = 0.9;
} // namespace

Result<Clip> analyse(const AudioData& audio, const EncoderParams& params, const AudioReference& reference,
                     const GoOn& goOn)
{
    if (auto valid = validate(params); !valid)
        return valid.error();
    if (audio.channels < 1 || audio.sampleRate < limits::lowestSampleRate)
        return Error{ErrorCode::invalidData, "", "is not a sound that can be analysed"};
    Encoder encoder(params);
    SoundParts parts(audio.samples, audio.channels);
    const auto size = static_cast<double>(std::max<std::size_t>(1, audio.samples.size()));
    const auto next = [&]() -> SoundPart
    {
        if (goOn && !goOn(shareOfReading * (1.0 - static_cast<double>(parts.samplesLeft()) / size)))
            return Error{ErrorCode::invalidData, "", "was cancelled"};
        return parts();
    };
    auto clip = encodeSound(encoder, {audio.sampleRate, audio.channels}, next);
    if (clip)
    {
        clip->source.file = reference.path.filename().string();
        clip->name = reference.path.stem().string();
    }
    return clip;
}

} // namespace pacini
