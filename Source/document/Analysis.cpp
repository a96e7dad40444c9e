#include "document/Analysis.h"

#include "io/ClipSeal.h"
#include "io/FinishedClip.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/clip/PackedClip.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
// The curves are fitted when all samples have been read, which takes about as long as a tenth of them.
constexpr double shareOfReading = 0.9;
} // namespace

Result<Clip> analyse(const StoredAudio& audio, const EncoderParams& params, const AudioReference& reference,
                     const GoOn& goOn)
{
    if (auto valid = validate(params); !valid)
        return valid.error();
    if (audio.channels() < 1 || audio.rate() < limits::lowestSampleRate)
        return Error{ErrorCode::invalidData, "", "is not a sound that can be analysed"};
    Encoder encoder(params);
    const auto channels = static_cast<std::size_t>(audio.channels());
    std::vector<float> part(soundPartLength(channels));
    std::size_t done = 0; // frames
    const auto next = [&]() -> SoundPart
    {
        const auto all = static_cast<double>(std::max<std::size_t>(1, audio.frames()));
        if (goOn && !goOn(shareOfReading * static_cast<double>(done) / all))
            return wasCancelled();
        const std::size_t frames = std::min(part.size() / channels, audio.frames() - done);
        const auto filled = std::span(part).first(frames * channels);
        audio.read(done, filled);
        done += frames;
        return std::span<const float>(filled);
    };
    auto clip = encodeSound(encoder, {audio.rate(), audio.channels()}, next);
    if (!clip)
        return clip;
    Clip finished = finishClip(std::move(*clip), clipNamesOf(reference.path));
    if (audio.markers().empty())
        return finished;
    for (const Marker& marker : audio.markers())
        if (marker.time <= finished.duration)
            finished.markers.push_back(marker);
    finished = onGrids(std::move(finished));
    sealClip(finished);
    return finished;
}

} // namespace pacini
