#pragma once

// The sound of a call, which JavaScript delivers piece by piece, and the clip made of it.

#include "io/AudioReader.h"
#include "io/FinishedClip.h"
#include "io/RateRaiser.h"
#include "io/SoundEncoder.h"
#include "io/formats/ClipFormat.h"
#include "web/core/Call.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/foundation/DspBlock.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::web
{

/// Options `sampleRate`, `channels`, `frames`, `name`, `source` and `format` of a call, and its sound: one that is
/// slower than what is encoded at a multiple of its rate, as files are read.
class SoundInput
{
public:
    explicit SoundInput(Call& ofSound)
        : call(ofSound),
          rate(static_cast<int>(call.number("sampleRate", 0.0, limits::slowestSound, limits::highestSampleRate))),
          channels(static_cast<int>(call.number("channels", 1.0, 1.0, limits::channels))),
          frames(static_cast<std::uint64_t>(call.number("frames", 0.0, 0.0, 1e12))),
          name(call.word("name", "")),
          source(call.word("source", "")),
          format(clipFormatNamed(call.word("format", "json"))),
          buffer(soundPartLength(static_cast<std::size_t>(channels)))
    {
        if (format == nullptr || !format->isOwn())
            call.reader.fail("format", "must be json or packed", ErrorCode::invalidArgument);
        if (rate == 0)
            call.reader.fail("sampleRate", "is missing", ErrorCode::invalidArgument);
        call.reader.list("markers", markers, limits::soundMarkers, "markers",
                         [this](Marker& marker)
                         {
                             call.reader.number("time", marker.time, Need::required);
                             call.reader.text("name", marker.name);
                         });
        if (const auto channel = call.optionalNumber("lowFrequency", 0.0, channels - 1.0))
            lowFrequency = static_cast<std::size_t>(*channel);
        if (call.reader.error || rate >= limits::lowestSampleRate)
            return;
        raiser.emplace(rate, limits::lowestSampleRate, static_cast<std::size_t>(channels));
        rate *= raiser->multiple();
        frames *= static_cast<std::uint64_t>(raiser->multiple());
    }

    [[nodiscard]] SoundFormat sound() const { return {rate, channels, frames, std::nullopt}; }

    /// The next part, empty at the end. Errors: notFinite, also beyond limits::sample.
    [[nodiscard]] SoundPart operator()()
    {
        const auto got =
            raiser ? raiser->read(buffer, [this](std::span<float> into) { return pull(into); }) : pull(buffer);
        if (!got)
            return got.error();
        return std::span<const float>(buffer).first(*got * static_cast<std::size_t>(channels));
    }

    /// Puts the clip that was made of it, on its grids, into the call's outputs.
    [[nodiscard]] Result<void> put(Clip clip) const
    {
        clip.source.sampleRate = rate;
        clip.source.channels = channels;
        if (const auto record = readingRecord({}, lowFrequency ? lowFrequencyEffectsGain : 1.0); !record.empty())
            clip.encoder.insert(clip.encoder.end(), record.begin(), record.end());
        for (const Marker& marker : markers)
            if (marker.time <= clip.duration)
                clip.markers.push_back(marker);
        if (!clip.markers.empty())
            clip = onGrids(std::move(clip));
        const auto written = format->write(finishClip(std::move(clip), {name, source}));
        if (!written)
            return written.error();
        call.put(written->files.front().bytes);
        return {};
    }

private:
    /// Frames of the sound as it comes. Errors: notFinite.
    [[nodiscard]] Result<std::size_t> pull(std::span<float> into)
    {
        const std::size_t got = call.pullSound(into);
        const auto width = static_cast<std::size_t>(channels);
        const auto samples = into.first(got * width);
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (!areWithinLimit(samples.subspan(i, 1)))
                return Error{ErrorCode::notFinite, fmt::format("frame {}, channel {}", done + i / width, i % width),
                             std::isfinite(samples[i]) ? "is far beyond full scale" : "is not a finite number"};
        if (lowFrequency)
            for (std::size_t i = *lowFrequency; i < samples.size(); i += width)
                samples[i] *= static_cast<float>(lowFrequencyEffectsGain);
        done += got;
        return got;
    }

    Call& call;
    int rate;
    int channels;
    std::uint64_t frames; ///< 0: not known before its end
    std::string name, source;
    const ClipFormat* format;
    std::vector<float> buffer;
    std::optional<RateRaiser> raiser;
    std::vector<Marker> markers;
    std::optional<std::size_t> lowFrequency; ///< channel
    std::uint64_t done = 0;                  ///< frames as they came
};

} // namespace pacini::web
