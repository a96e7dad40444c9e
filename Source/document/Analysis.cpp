#include "document/Analysis.h"

#include <pacini/clip/PackedClip.h>

#include <algorithm>
#include <cstddef>
#include <span>

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
        return Error{ErrorCode::invalidData, "", "is no sound that can be analysed"};
    Encoder encoder(params);
    encoder.start(audio.sampleRate, audio.channels);
    const auto channels = static_cast<std::size_t>(audio.channels);
    const std::size_t piece = channels * std::max<std::size_t>(1, 65536 / channels);
    const std::span<const float> samples(audio.samples);
    const Error stopped{ErrorCode::invalidData, "", "was stopped before its end"};
    for (std::size_t done = 0; done < samples.size(); done += piece)
    {
        if (goOn && !goOn(shareOfReading * static_cast<double>(done) / static_cast<double>(samples.size())))
            return stopped;
        encoder.push(samples.subspan(done, std::min(piece, samples.size() - done)));
    }
    if (goOn && !goOn(shareOfReading))
        return stopped;
    Clip clip = encoder.finish();
    clip.source.file = reference.path.filename().string();
    clip.name = reference.path.stem().string();
    return unpackClip(packClip(clip, packParamsFor(clip)));
}

} // namespace pacini
