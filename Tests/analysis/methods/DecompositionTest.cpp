#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/methods/Decomposition.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/synthesis/Decoder.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

/// Two tones, the second fading in from 1.5 to 1.7 s, clicks at 0.5, 1.25 and 2.25 s, and hiss, for 3 s.
std::vector<float> soundOfAllKinds(double fs, double tones, double clicks, double hiss)
{
    const auto frames = static_cast<std::size_t>(3.0 * fs);
    auto x = noise(frames, 31, hiss);
    const auto low = sine(frames, 90.0, fs, tones);
    const auto high = sine(frames, 420.0, fs, 0.5 * tones);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double in = std::clamp((static_cast<double>(n) / fs - 1.5) / 0.2, 0.0, 1.0);
        x[n] += low[n] + static_cast<float>(in) * high[n];
    }
    const auto crack = noise(static_cast<std::size_t>(0.006 * fs), 77, clicks);
    for (const double time : {0.5, 1.25, 2.25})
        for (std::size_t i = 0; i < crack.size(); ++i)
            x[static_cast<std::size_t>(time * fs) + i] += crack[i];
    return x;
}

/// The band whose level is highest at `time`.
const Band& strongest(const Clip& clip, double time)
{
    return *std::max_element(clip.bands.begin(), clip.bands.end(),
                             [time](const Band& a, const Band& b)
                             { return valueAt(a.amplitude, time) < valueAt(b.amplitude, time); });
}

double noiseEnergy(const Clip& clip)
{
    double sum = 0.0;
    for (const NoiseBand& band : clip.noise)
        sum += curveEnergy(band.amplitude, clip.duration);
    return sum;
}

double gainOf(const Clip& clip)
{
    for (const EncoderParameter& parameter : clip.encoder)
        if (parameter.name == "gain")
            return std::get<double>(parameter.value);
    return 0.0;
}

/// Mean power of x between two frequencies, by its transform over all of it.
double powerBetween(std::span<const float> x, double low, double high, double fs)
{
    RealFft<double> fft(nextFastFftSize(x.size()));
    std::vector<double> padded(x.begin(), x.end());
    padded.resize(fft.size());
    std::vector<std::complex<double>> spectrum(fft.bins());
    fft.forward(padded, spectrum);
    double sum = 0.0;
    for (std::size_t k = 0; k < spectrum.size(); ++k)
        if (const double f = static_cast<double>(k) * fs / static_cast<double>(fft.size()); f >= low && f < high)
            sum += 2.0 * std::norm(spectrum[k]);
    return sum / static_cast<double>(fft.size()) / static_cast<double>(x.size());
}

} // namespace

TEST_CASE("Tones become partials on carriers, clicks events, hiss bands of noise", "[methods]")
{
    for (const double fs : {8000.0, 44100.0, 96000.0})
    {
        CAPTURE(fs);
        const auto x = soundOfAllKinds(fs, 0.3, 0.8, 0.03);
        const Clip clip = decompositionClip(x, fs);
        REQUIRE(validate(clip).ok());
        CHECK(clip.bands.size() == 12);
        CHECK(!clip.noise.empty());
        const double gain = gainOf(clip);

        const Band& low = strongest(clip, 0.9);
        CHECK(valueAt(low.amplitude, 0.9) == Approx(0.3 * gain).epsilon(0.1));
        CHECK(valueAt(low.pitch, 0.9) == Approx(90.0).epsilon(0.01));
        const auto high = std::find_if(clip.bands.begin(), clip.bands.end(),
                                       [](const Band& band) { return band.highFrequency > 420.0; });
        CHECK(valueAt(high->amplitude, 1.8) == Approx(0.15 * gain).epsilon(0.15));
        CHECK(valueAt(high->pitch, 1.8) == Approx(420.0).epsilon(0.01));
        CHECK(valueAt(high->amplitude, 0.9) < 0.02 * gain);

        std::vector<double> times;
        for (const Transient& event : clip.transients)
            if (event.amplitude > 0.1)
                times.push_back(event.time);
        REQUIRE(times.size() == 3); // the ends of the tones are none
        const double expected[] = {0.5, 1.25, 2.25};
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(times[i] == Approx(expected[i]).margin(0.006));
    }
}

TEST_CASE("Noise bands have the level of the noise in their range", "[methods]")
{
    const double fs = 8000.0;
    const auto x = noise(static_cast<std::size_t>(4.0 * fs), 3, 0.5);
    const Clip clip = decompositionClip(x, fs);
    const double gain = gainOf(clip);
    REQUIRE(clip.noise.size() == 6);
    CHECK(clip.noise.front().lowFrequency == 30.0);
    CHECK(clip.noise.back().highFrequency == 1000.0);
    for (std::size_t k = 2; k < clip.noise.size(); ++k) // the lower ones are too narrow for 4 s
    {
        const NoiseBand& band = clip.noise[k];
        // A uniform distribution's power, spread evenly up to 4 kHz. Where both medians are alike the harmonic part
        // gets a fifth of the amplitude, so 4/5 (-1.9 dB) are left; chance makes some bins more harmonic than that.
        const double expected = 0.25 / 3.0 * (band.highFrequency - band.lowFrequency) / 4000.0 * gain * gain;
        CAPTURE(k);
        CHECK(10.0 * std::log10(curveEnergy(band.amplitude, clip.duration) / clip.duration / expected) ==
              Approx(-3.0).margin(1.2));
    }
}

TEST_CASE("Noise survives packing and is played in its band at its level", "[methods]")
{
    const double fs = 8000.0;
    const auto x = noise(static_cast<std::size_t>(4.0 * fs), 9, 0.5);
    const Clip clip = decompositionClip(x, fs);
    const Clip read = unpackClip(packClip(clip, packParamsFor(clip))).value();
    REQUIRE(read.noise.size() == clip.noise.size());
    for (std::size_t k = 0; k < read.noise.size(); ++k)
    {
        CHECK(read.noise[k].lowFrequency == clip.noise[k].lowFrequency);
        CHECK(read.noise[k].highFrequency == clip.noise[k].highFrequency);
        REQUIRE(read.noise[k].amplitude.size() == clip.noise[k].amplitude.size());
        for (double t = 0.0; t < 4.0; t += 0.1) // 6 bits: steps of 1.2 dB
            CHECK(valueAt(read.noise[k].amplitude, t) == Approx(valueAt(clip.noise[k].amplitude, t)).epsilon(0.08));
    }
    CHECK(unpackClip(packClip(read, packParamsFor(read))).value() == read);
    Clip alone = read;
    alone.bands.clear();
    alone.transients.clear();
    const auto y = played(alone, fs);
    CHECK(10.0 * std::log10(powerBetween(y, 20.0, 1300.0, fs) * clip.duration / noiseEnergy(read)) ==
          Approx(0.0).margin(1.0));
    for (std::size_t k = 2; k < read.noise.size(); ++k)
    {
        Clip one = alone;
        one.noise = {read.noise[k]};
        const auto part = played(one, fs);
        CAPTURE(k);
        // Half-power edges.
        const double all = powerBetween(part, 0.0, 4000.0, fs);
        CHECK(powerBetween(part, read.noise[k].lowFrequency, read.noise[k].highFrequency, fs) > 0.55 * all);
        CHECK(10.0 * std::log10(all * clip.duration / noiseEnergy(one)) == Approx(0.0).margin(1.5));
    }
}

TEST_CASE("By the thesis's own equation noise bands leave the percussive part out", "[methods]")
{
    const double fs = 16000.0;
    const auto x = soundOfAllKinds(fs, 0.0, 0.9, 0.002);
    DecompositionParams strict;
    strict.percussiveNoise = false;
    const Clip literal = decompositionClip(x, fs, strict);
    const Clip usual = decompositionClip(x, fs);
    CHECK(noiseEnergy(literal) < 0.3 * noiseEnergy(usual));
    CHECK(literal.transients == usual.transients);
    CHECK(literal.envelope == usual.envelope);
}

TEST_CASE("More breakpoints follow a sound more closely, and numbers of bands are what was asked", "[methods]")
{
    const double fs = 8000.0;
    const auto x = soundOfAllKinds(fs, 0.3, 0.8, 0.1);
    std::size_t before = 0;
    for (const double breakpoints : {2.0, 10.0, 40.0, 200.0})
    {
        DecompositionParams params;
        params.breakpoints = breakpoints;
        const std::size_t count = breakpointCount(decompositionClip(x, fs, params));
        CHECK(count > before);
        before = count;
    }
    DecompositionParams params;
    for (const std::size_t bands : {0u, 1u, 5u, 32u, 40u})
    {
        params.bands = bands;
        params.noiseBands = bands;
        const Clip clip = decompositionClip(x, fs, params);
        CHECK(validate(clip).ok());
        CHECK(clip.bands.size() == std::clamp<std::size_t>(bands, 1, 32));
        CHECK(clip.noise.size() <= std::min<std::size_t>(bands, 32));
        CHECK((bands != 5 || clip.noise.size() == 5));
    }
    const auto withPoints = [&](double breakpoints, int bits)
    {
        DecompositionParams p;
        p.breakpoints = breakpoints;
        p.quantise = bits;
        return decompositionClip(x, fs, p);
    };
    CHECK(withPoints(0.0, 6) == withPoints(0.5, 6));
    CHECK(withPoints(1e9, 6) == withPoints(1000.0, 6));
    CHECK(withPoints(20.0, 0) == withPoints(20.0, 4));
    CHECK(withPoints(20.0, 99) == withPoints(20.0, 16));
}

TEST_CASE("Without noise bands none are made, and a sound above touch has no curves", "[methods]")
{
    DecompositionParams params;
    params.noiseBands = 0;
    CHECK(decompositionClip(noise(8000, 1), 8000.0, params).noise.empty());
    const Clip clip = decompositionClip(sine(48000, 9000.0, 48000.0, 0.5), 48000.0);
    CHECK(validate(clip).ok());
    CHECK(clip.duration == 1.0);
}

TEST_CASE("Frames reach to the very end of a sound", "[methods]")
{
    const double fs = 8000.0;
    const auto x = sine(static_cast<std::size_t>(1.013 * fs), 200.0, fs, 0.5);
    const Clip clip = decompositionClip(x, fs);
    const Band& band = strongest(clip, 0.5);
    CHECK(valueAt(band.amplitude, 0.95) == Approx(valueAt(band.amplitude, 0.5)).epsilon(0.1));
    CHECK(band.amplitude.back().time <= clip.duration);
    CHECK(valueAt(band.amplitude, clip.duration) > 0.3 * valueAt(band.amplitude, 0.5));
}
