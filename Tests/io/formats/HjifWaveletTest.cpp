// WaveletWave bands of HJIF are what they say: blocks of samples.

#include "io/formats/hjif/HjifWavelet.h"

#include "io/formats/DemoSounds.h"
#include "io/formats/FormatSamples.h"
#include "io/formats/HjifEncoder.h"
#include "io/formats/hjif/HjifStream.h"
#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
constexpr int waveletRate = 8000;
constexpr std::size_t blockSize = 1024;

/// A WaveletWave band of `samples`, and its stated length.
std::string waveletBand(std::vector<double> samples, int planes = 12)
{
    std::string effects;
    for (std::size_t at = 0; at < samples.size(); at += blockSize)
    {
        std::vector<double> block(blockSize);
        std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(at), std::min(blockSize, samples.size() - at),
                    block.begin());
        effects += (at > 0 ? ", " : "") + std::string(R"({"effect_type": "Basis", "position": )") +
                   std::to_string(at / blockSize * 128) + R"(, "wavelet_stream": ")" +
                   test::hjifBlockOf(block, planes) + "\"}";
    }
    return R"({"band_type": "WaveletWave", "lower_frequency_limit": 0, "upper_frequency_limit": 8000,
        "block_length": 128, "effects": [)" +
           effects + "]}";
}

/// What the reader makes of bands whose channel lasts `seconds`.
ImportedClip readBands(const std::string& bands, double seconds)
{
    std::string text = test::hjifWith(bands);
    const std::string mask = R"("body_part_mask": 0, )";
    text.insert(text.find(mask), R"("frequency_sampling": 8000, "sample_count": )" +
                                     std::to_string(std::lround(seconds * waveletRate)) + ", ");
    auto read = readHjif(text);
    CAPTURE(read ? "" : read.error().text());
    REQUIRE(read);
    return *read;
}

std::vector<double> sine(double seconds, double frequency, double amplitude)
{
    std::vector<double> samples;
    for (int n = 0; n < static_cast<int>(seconds * waveletRate); ++n)
        samples.push_back(amplitude * std::sin(2.0 * std::numbers::pi * frequency * n / waveletRate));
    return samples;
}

/// Level of a part of a signal, dB.
double levelOf(const std::vector<double>& samples, double from, double to)
{
    double power = 0.0;
    for (double n = std::round(from * waveletRate); n < to * waveletRate; n += 1.0)
        power += std::pow(samples.at(static_cast<std::size_t>(n)), 2.0) / ((to - from) * waveletRate);
    return 10.0 * std::log10(power);
}

std::vector<double> played(const Clip& clip)
{
    const std::vector<float> samples = test::decoded(clip, waveletRate);
    return {samples.begin(), samples.end()};
}

std::vector<double> randomSamples(std::size_t size, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> samples;
    for (std::size_t i = 0; i < size; ++i)
        samples.push_back(random.uniform(-1.0, 1.0));
    return samples;
}
} // namespace

TEST_CASE("A block of wavelet coefficients is what the reference player makes of it", "[formats]")
{
    const std::string stream = "K3bDLtlxkLsMt";
    const auto block = decodeHjifStream(stream, 16);
    REQUIRE(block);
    CHECK(block->coefficients == std::vector<int>{15, 7, -6, 3, -10, 6, -4, 4, -4, 0, 0, 0, 0, 0, 0, 0});
    CHECK(block->step == Approx(0.8203125 / 16.0));
    const std::vector<int> expected{-2881, 17142, 19826, 14753, 4748, -3395, -9495, -8795,
                                    -5341, -254,  4292,  4543,  3117, 501,   -2009, -2589};
    const auto samples = hjifBlockSamples(stream, 16);
    REQUIRE(samples);
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(std::lround(32768.0 * (*samples)[i]) == expected[i]);
}

TEST_CASE("Any wavelet coefficients come back from their stream", "[formats]")
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
        Random random(seed);
        const std::size_t size = std::size_t(16) << (seed % 7);
        const int planes = 1 + static_cast<int>(seed % 16);
        const int level = static_cast<int>(1 + seed % 127);
        std::vector<int> coefficients;
        for (std::size_t i = 0; i < size; ++i) // small ones are the most frequent
            coefficients.push_back(static_cast<int>(std::pow(random.uniform(-1.0, 1.0), 3.0) * ((1 << planes) - 1)));
        CAPTURE(seed, size, planes);
        const auto block = decodeHjifStream(test::hjifStream(coefficients, planes, seed % 2 == 0, level), size);
        REQUIRE(block);
        CHECK(block->coefficients == coefficients);
        const double most = seed % 2 == 0 ? 1.0 + level / 8.0 : level / 128.0;
        CHECK(block->step == Approx(most / (1 << (planes - 1))));
    }
}

TEST_CASE("The inverse wavelet transform undoes the forward one", "[formats]")
{
    for (std::size_t size = hjifSmallestBlock; size <= 1024; size *= 2)
    {
        const std::vector<double> samples = randomSamples(size, size);
        std::vector<double> block = test::hjifCoefficients(samples);
        invertHjifWavelet(block);
        for (std::size_t i = 0; i < size; ++i)
            CHECK(block[i] == Approx(samples[i]).margin(1e-9));
    }
}

TEST_CASE("A block of samples comes back to within its quantisation", "[formats]")
{
    const std::vector<double> samples = randomSamples(1024, 5);
    const auto back = hjifBlockSamples(test::hjifBlockOf(samples, 12), samples.size());
    REQUIRE(back);
    for (std::size_t i = 0; i < samples.size(); ++i)
        CHECK((*back)[i] == Approx(samples[i]).margin(0.01));
}

TEST_CASE("Streams of any length are blocks, other characters are not", "[formats]")
{
    for (const char* stream : {"", "A", "AAAAAAAA", "/", "////////////////////////", "K3b=", "K3b=="})
    {
        const auto samples = hjifBlockSamples(stream, 64);
        REQUIRE(samples);
        for (const double x : *samples)
            CHECK(std::abs(x) < 100.0);
    }
    for (const char* stream : {"K3b D", "K3b-", "=K3b", "K\n"})
        CHECK_FALSE(hjifBlockSamples(stream, 64));
}

TEST_CASE("The size of a block is the power of two that lasts so many ticks", "[formats]")
{
    CHECK(hjifBlockSize(2.0, 1000.0, 8000.0) == 16u);
    CHECK(hjifBlockSize(128.0, 1000.0, 8000.0) == 1024u);
    CHECK(hjifBlockSize(23.0, 1000.0, 44100.0) == 1024u); // of 23.2 ticks
    CHECK(hjifBlockSize(10.0, 1000.0, 96000.0) == 1024u); // of 10.7
    CHECK(hjifBlockSize(6144.0, 48000.0, 8000.0) == 1024u);
    for (const double ticks : {1.0, 3.0, 100.0, 1e9})
        CHECK_FALSE(hjifBlockSize(ticks, 1000.0, 8000.0));
}

TEST_CASE("A wavelet band becomes a clip that sounds as its samples do", "[formats]")
{
    std::vector<double> samples = sine(1.5, 150.0, 0.4);
    for (std::size_t n = 0; n < samples.size(); ++n) // with a pause in it
        samples[n] *= n < 6000 ? 1.0 : n < 9000 ? 0.0 : 0.5;
    const ImportedClip read = readBands(waveletBand(samples), 1.5);
    CHECK(read.warnings.empty());
    CHECK(read.clip.duration == 1.5);
    CHECK(read.clip.bands.size() == 12);
    CHECK(!read.clip.envelope.empty());
    const std::vector<double> back = played(read.clip);
    CHECK(levelOf(back, 0.1, 0.7) == Approx(levelOf(samples, 0.1, 0.7)).margin(0.5));
    CHECK(levelOf(back, 0.85, 1.05) < -40.0);
    CHECK(levelOf(back, 1.2, 1.45) == Approx(levelOf(samples, 1.2, 1.45)).margin(0.5));
}

TEST_CASE("A curve and the wavelets of what it is off by are one waveform", "[formats]")
{
    // A drawn triangle of 25 Hz, and wavelets that replace it by 50 Hz.
    std::string keyframes;
    std::vector<double> samples = sine(1.0, 50.0, 0.5);
    for (int i = 0; i <= 50; ++i)
        keyframes += (i > 0 ? ", " : "") + std::string("{\"relative_position\": ") + std::to_string(20 * i) +
                     ", \"amplitude_modulation\": " + (i % 2 == 0 ? "0.3" : "-0.3") + "}";
    const std::vector<double> wanted = samples;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        const double place = static_cast<double>(n % 160) / 160.0;
        samples[n] -= (n / 160 % 2 == 0 ? 1.0 : -1.0) * (0.3 - 0.6 * place);
    }
    const std::string curve = R"({"band_type": "Curve", "curve_type": "Linear", "lower_frequency_limit": 0,
        "upper_frequency_limit": 72, "effects": [{"effect_type": "Basis", "position": 0, "keyframes": [)" +
                              keyframes + "]}]}";
    const ImportedClip read = readBands(curve + ", " + waveletBand(samples), 1.0);
    CHECK(read.warnings.empty());
    CHECK(levelOf(played(read.clip), 0.1, 0.9) == Approx(levelOf(wanted, 0.1, 0.9)).margin(0.5));
    double others = 0.0; // what is left of the triangle
    for (const Band& band : read.clip.bands)
        if (band.highFrequency < 50.0 || band.lowFrequency > 50.0)
            others = std::max(others, valueAt(band.amplitude, 0.5));
    CHECK(others < 0.003);
}

TEST_CASE("A curve beside wavelets is drawn where it stands, in straight lines or bent ones", "[formats]")
{
    std::string keyframes;
    for (int i = 0; i <= 100; ++i) // extrema every 5 ms: 100 Hz, for half a second
        keyframes += (i > 0 ? ", " : "") + std::string("{\"relative_position\": ") + std::to_string(5 * i) +
                     ", \"amplitude_modulation\": " + (i % 2 == 0 ? "0.5" : "-0.5") + "}";
    for (const bool straight : {false, true})
    {
        CAPTURE(straight);
        const std::string curve = std::string(R"({"band_type": "Curve", "curve_type": ")") +
                                  (straight ? "Linear" : "Cubic") +
                                  R"(", "lower_frequency_limit": 0, "upper_frequency_limit": 200, "effects": [
            {"effect_type": "Basis", "position": 400, "keyframes": [)" +
                                  keyframes + "]}]}";
        const ImportedClip read = readBands(curve + ", " + waveletBand(std::vector<double>(10240)), 1.25);
        const std::vector<double> back = played(read.clip);
        constexpr double pi = std::numbers::pi;
        // The first harmonic of a triangle and of a wave of smooth steps, nearly all that there is of both.
        const double amplitude = 0.5 * (straight ? 8.0 / (pi * pi) : 96.0 / std::pow(pi, 4.0));
        CHECK(levelOf(back, 0.5, 0.8) == Approx(20.0 * std::log10(amplitude / std::sqrt(2.0))).margin(0.4));
        CHECK(levelOf(back, 0.1, 0.35) < -40.0);
        CHECK(levelOf(back, 0.95, 1.2) < -40.0);
    }
}

TEST_CASE("Waves and transients beside a wavelet band stay what they are", "[formats]")
{
    const std::vector<double> samples = sine(1.0, 300.0, 0.25);
    const ImportedClip read = readBands(waveletBand(samples) + R"(,
        {"band_type": "VectorialWave", "lower_frequency_limit": 60, "upper_frequency_limit": 60, "effects": [
          {"effect_type": "Basis", "position": 0, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.25, "frequency_modulation": 60},
            {"relative_position": 1000, "amplitude_modulation": 0.25}]}]},
        {"band_type": "Transient", "lower_frequency_limit": 65, "upper_frequency_limit": 300, "effects": [
          {"effect_type": "Basis", "position": 500, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 65}]}]})",
                                        1.0);
    CHECK(read.clip.bands.at(0).centreFrequency == 60.0);
    CHECK(valueAt(read.clip.bands.at(0).amplitude, 0.3) == 0.25);
    CHECK(std::count_if(read.clip.transients.begin(), read.clip.transients.end(),
                        [](const Transient& event) { return event.time == 0.5 && event.amplitude > 0.8; }) == 1);
    const double both = levelOf(samples, 0.1, 0.45) + 10.0 * std::log10(2.0);
    CHECK(levelOf(played(read.clip), 0.1, 0.45) == Approx(both).margin(0.5));
}

TEST_CASE("Wavelet bands of several channels and rates are one clip", "[formats]")
{
    const std::vector<double> samples = sine(1.0, 120.0, 0.5);
    std::string half = waveletBand(samples); // the same samples in twice the time: 60 Hz
    half.replace(half.find("8000"), 4, "4000");
    half.replace(half.find("128,"), 4, "256,");
    const std::string channel = R"(]}, {"id": 1, "description": "", "gain": 1, "mixing_coefficient": 1,
        "body_part_mask": 0, "bands": [)";
    const ImportedClip read = readBands(waveletBand(samples) + channel + half, 1.0);
    const double both = levelOf(samples, 0.1, 0.9) - 20.0 * std::log10(2.0) + 10.0 * std::log10(2.0);
    CHECK(levelOf(played(read.clip), 0.1, 0.9) == Approx(both).margin(0.7));
    const auto strongest = [&](double frequency)
    {
        double most = 0.0;
        for (const Band& band : read.clip.bands)
            if (band.lowFrequency < frequency && frequency < band.highFrequency)
                most = std::max(most, valueAt(band.amplitude, 0.5));
        return most;
    };
    CHECK(strongest(60.0) == Approx(0.25).margin(0.03));
    CHECK(strongest(120.0) == Approx(0.25).margin(0.03));
}

TEST_CASE("A silent wavelet band is a silent clip of its length", "[formats]")
{
    const ImportedClip read = readBands(waveletBand(std::vector<double>(2048)), 0.25);
    CHECK(read.clip.duration == 0.25);
    CHECK(read.clip.transients.empty());
    REQUIRE(clipFormatNamed("hjif")->write(read.clip, {}));
}
