// What is played and encoded beyond the counts that 32 bits hold, by the core alone: a line for each result, with a
// hash of all its bits. They must be the same on every machine.

#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/SoundSurvey.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/foundation/Random.h>
#include <pacini/foundation/SizeInMemory.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/PlayVoice.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <vector>

using namespace pacini;

namespace
{

/// FNV-1a (G. Fowler, L. Noll and P. Vo).
std::uint64_t hashOf(std::span<const std::byte> bytes)
{
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const std::byte byte : bytes)
        hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001B3u;
    return hash;
}

template <typename T>
void print(const char* name, const std::vector<T>& content)
{
    std::printf("%s: %llu of %016llx\n", name, static_cast<unsigned long long>(content.size()),
                static_cast<unsigned long long>(hashOf(std::as_bytes(std::span(content)))));
}

/// A sound of any length that costs nothing to make: eight seconds of decaying noise, again and again at other levels.
class Knocks
{
public:
    explicit Knocks(double rate) : loop(static_cast<std::size_t>(8.0 * rate))
    {
        Random random(7);
        for (std::size_t n = 0; n < loop.size(); ++n)
        {
            const double since = std::fmod(static_cast<double>(n) / rate, 1.0);
            loop[n] = static_cast<float>(std::exp(-20.0 * since) * random.uniform(-0.9, 0.9));
        }
    }

    /// Calls take(samples) for `count` samples.
    template <typename Take>
    void play(std::uint64_t count, Take&& take) const
    {
        const std::span<const float> all(loop);
        for (std::uint64_t done = 0; done < count;)
        {
            const auto at = static_cast<std::size_t>(done % all.size());
            const std::size_t n = std::min({all.size() - at, std::size_t{65536}, sizeInMemory(count - done)});
            take(all.subspan(at, n));
            done += n;
        }
    }

private:
    std::vector<float> loop;
};

/// The clip of a sound, known beforehand as long files are, or not.
void encode(const char* name, int rate, std::uint64_t frames, bool survey)
{
    const Knocks sound(rate);
    std::optional<SoundScale> scale;
    if (survey)
    {
        SoundSurvey whole{EncoderParams{}};
        whole.start(rate, 1);
        sound.play(frames, [&](std::span<const float> x) { whole.push(x); });
        scale = whole.finish();
    }
    Encoder encoder(EncoderParams{});
    encoder.start(rate, 1, frames, scale);
    sound.play(frames, [&](std::span<const float> x) { encoder.push(x); });
    const Clip clip = encoder.finish();
    std::printf("%.9f s, ", clip.duration);
    print(name, packClip(clip, packParamsFor(clip)));
}

/// A clip of a day that glides, with events near its end.
Clip dayLong()
{
    Clip clip;
    clip.duration = limits::duration;
    clip.bands = {{30.0, 60.0, 120.0, 0, {{0.0, 0.5}, {clip.duration, 0.8}}, {{0.0, 50.0}, {clip.duration, 90.0}}}};
    clip.envelope = {{0.0, 0.5}, {clip.duration, 0.8}};
    for (const double before : {50.0, 0.3, 0.02})
        clip.transients.push_back({clip.duration - before, 1.0, 0.5});
    return clip;
}

/// What a decoder plays of a hundred days: where a count of frames to its end begins anew in 32 bits, and its end.
void decode()
{
    const Clip clip = dayLong();
    DecoderParams params;
    params.sampleRate = limits::highestRate;
    params.stretch = 100.0;
    Decoder decoder(clip, params);
    std::printf("%lld frames\n", static_cast<long long>(decoder.totalFrames()));
    std::vector<float> out(40000);
    for (const std::int64_t left :
         {std::int64_t{1} << 37, (std::int64_t{1} << 32) + 300, (std::int64_t{1} << 31) + 7, std::int64_t{39000}})
    {
        decoder.skip(decoder.totalFrames() - left - decoder.framesPlayed());
        decoder.process(out);
        std::printf("%.4f s, ", decoder.clipTime());
        print("played", out);
    }
}

/// What a voice adds before a start that is 2^32 frames off, and at it; its faders go on meanwhile.
void playLate()
{
    PlannedPlay play;
    play.clip = dayLong();
    play.start = 3.0 * 3600.0;
    play.timeline.gains = {{{0.0, 0.5}}};
    const double fs = limits::highestRate;
    PlayVoice voice(play, 1, fs);
    voice.prepare(play);
    const auto buffers = std::make_unique<MixBuffers>();
    std::vector<float> out(1000);
    std::span<float> channel = out;
    const auto mix = [&](std::int64_t now, int blocks)
    {
        for (int block = 0; block < blocks; ++block, now += std::ssize(out))
        {
            std::fill(out.begin(), out.end(), 0.0f);
            voice.mix(play, {std::span(&channel, 1), 0, out.size(), now}, false, *buffers);
        }
        print("mixed", out);
    };
    const std::int64_t start = voice.startFrame(), later = start + 500 + (std::int64_t{1} << 32);
    mix(start - (std::int64_t{1} << 32) - 10, 1);
    mix(start - 500, 1);
    voice.setFader(Fader::play, 0.25, 1'000'000'000);
    voice.catchUp(later);
    std::printf("fader at %.6f\n", voice.fader(Fader::play).now());
    mix(later, 40); // until the decoder has a past
}

/// A packed clip with 64 MB of zeros behind it.
void unpack()
{
    Clip clip = dayLong();
    std::vector<std::byte> packed = packClip(clip, packParamsFor(clip));
    packed.resize(detail::packedHeaderBytes + (std::size_t{1} << 26) - 8);
    const auto sum = detail::crc16(std::span<const std::byte>(packed).subspan(detail::packedHeaderBytes));
    packed[5] = static_cast<std::byte>(sum >> 8);
    packed[6] = static_cast<std::byte>(sum & 0xFFu);
    const auto read = unpackClip(packed);
    std::printf("unpacked: %d, %d points\n", read ? 1 : 0, read ? static_cast<int>(breakpointCount(*read)) : 0);
}

} // namespace

int main()
{
    encode("1520 s at 48 kHz", 48000, 1520u * 48000u, true);
    encode("more than 2^32 frames at 768 kHz", 768000, (std::uint64_t{1} << 32) + 768000u, false);
    decode();
    playLate();
    unpack();
    return 0;
}
