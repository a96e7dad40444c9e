// A sound in memory gives back every sample, in as few bytes as that takes.

#include "io/StoredAudio.h"

#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace pacini;

namespace
{
constexpr std::size_t storedFrames = 100'000; // more than a piece, and no whole number of them

AudioData noiseOfSteps(int channels, double scale)
{
    Random random(3);
    AudioData audio{48000, channels, {}, 0, {}};
    for (std::size_t i = 0; i < storedFrames * static_cast<std::size_t>(channels); ++i)
        audio.samples.push_back(static_cast<float>(std::floor(random.uniform(-scale, scale)) / scale));
    audio.samples[0] = -1.0f;
    audio.samples[1] = static_cast<float>((scale - 1.0) / scale);
    return audio;
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b)
{
    if (a.size() != b.size())
        return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]))
            return false;
    return true;
}

std::vector<float> all(const StoredAudio& stored)
{
    std::vector<float> samples(stored.frames() * static_cast<std::size_t>(stored.channels()));
    stored.read(0, samples);
    return samples;
}
} // namespace

TEST_CASE("A sound in memory is as compact as its samples allow and loses none of them")
{
    for (const int channels : {1, 2, 7})
    {
        CAPTURE(channels);
        const auto values = storedFrames * static_cast<std::size_t>(channels);
        for (const auto& [scale, bytes] : {std::pair(32768.0, 2.0), {8388608.0, 3.0}})
        {
            const AudioData audio = noiseOfSteps(channels, scale);
            const StoredAudio stored(audio);
            CHECK(stored.frames() == storedFrames);
            CHECK(sameBits(all(stored), audio.samples));
            CHECK(static_cast<double>(stored.bytes()) == bytes * static_cast<double>(values));
        }
        AudioData any = noiseOfSteps(channels, 32768.0);
        for (float& sample : any.samples)
            sample /= 3.0f;
        any.samples[5] = -0.0f;
        any.samples[6] = std::numeric_limits<float>::denorm_min();
        any.samples[7] = 2.5f;
        CHECK(sameBits(all(StoredAudio(any)), any.samples));
        AudioData silent{48000, channels, std::vector<float>(values), 0, {}};
        CHECK(StoredAudio(silent).bytes() == 0);
        CHECK(sameBits(all(StoredAudio(silent)), silent.samples));
        silent.samples[1] = -0.0f;
        CHECK(sameBits(all(StoredAudio(silent)), silent.samples));
    }
}

TEST_CASE("Channels and their mean are read from anywhere, with silence around the sound")
{
    const AudioData audio = noiseOfSteps(3, 32768.0);
    const StoredAudio stored(audio);
    const auto end = static_cast<std::int64_t>(storedFrames);
    for (const std::int64_t first : {std::int64_t(-5000), std::int64_t(-10), std::int64_t(21'000), end - 100, end + 9})
    {
        CAPTURE(first);
        std::vector<float> channel(3000), mean(3000);
        stored.readChannel(2, first, channel);
        stored.readMean(first, mean);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < channel.size(); ++i)
        {
            const std::int64_t frame = first + static_cast<std::int64_t>(i);
            const bool inside = frame >= 0 && frame < end;
            const auto at = static_cast<std::size_t>(inside ? 3 * frame : 0);
            const float sum = audio.samples[at] + audio.samples[at + 1] + audio.samples[at + 2];
            wrong += channel[i] != (inside ? audio.samples[at + 2] : 0.0f) ? 1u : 0u;
            wrong += mean[i] != (inside ? sum / 3.0f : 0.0f) ? 1u : 0u;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("An empty sound has no frames and reads as silence")
{
    const StoredAudio stored(AudioData{48000, 2, {}, 0, {}});
    std::vector<float> out(10, 1.0f);
    stored.readMean(-3, out);
    CHECK(out == std::vector<float>(10, 0.0f));
    CHECK(stored.frames() == 0);
    CHECK(stored.duration() == 0.0);
}
