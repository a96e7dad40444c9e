#include "io/AudioWriter.h"

#include "io/AudioBytes.h"
#include "io/AudioReader.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::vector<float> ramp(std::size_t samples)
{
    std::vector<float> x(samples);
    for (std::size_t i = 0; i < samples; ++i)
        x[i] = static_cast<float>(static_cast<int>(i * 7919 % 65536) - 32768) / 32768.0f;
    return x;
}

std::string data(const std::string& wav)
{
    return wav.substr(wav.find("data") + 8);
}
} // namespace

TEST_CASE("Float samples come back bit by bit, beyond full scale too", "[io][audio]")
{
    const TempFolder folder;
    auto samples = ramp(6000);
    samples[0] = limits::sample;
    samples[1] = -3.25f;
    samples[2] = std::numeric_limits<float>::denorm_min();
    const auto report = writeAudio(folder / "x.wav", samples, {.sampleRate = 44100, .channels = 3});
    REQUIRE(report.ok());
    CHECK(report->frames == 2000);
    CHECK(report->clippedSamples == 0);
    CHECK(report->bytes == std::filesystem::file_size(folder / "x.wav"));
    const auto audio = readAudio(folder / "x.wav");
    REQUIRE(audio.ok());
    CHECK(audio->sampleRate == 44100);
    CHECK(audio->channels == 3);
    CHECK(audio->samples == samples);
    CHECK(data(bytesOf(folder / "x.wav")) == float32(samples));
}

TEST_CASE("Integer samples on the grid come back exactly from WAV and FLAC", "[io][audio]")
{
    const TempFolder folder;
    const auto samples = ramp(65536);
    for (const char* name : {"x.wav", "x.flac", "X.FLAC"})
        for (auto encoding : {SampleEncoding::pcm16, SampleEncoding::pcm24})
        {
            CAPTURE(name);
            const auto report = writeAudio(folder / name, samples, {.channels = 2, .encoding = encoding});
            REQUIRE(report.ok());
            CHECK(report->clippedSamples == 0);
            CHECK(readAudio(folder / name)->samples == samples);
        }
    // Independent of our reader: the bytes of 16-bit PCM.
    REQUIRE(
        writeAudio(folder / "y.wav", std::vector<float>{0.0f, 0.5f, -0.5f, -1.0f}, {.encoding = SampleEncoding::pcm16})
            .ok());
    CHECK(data(bytesOf(folder / "y.wav")) == pcm16({0, 16384, -16384, -32768}));
}

TEST_CASE("Clipping stores full scale and is counted", "[io][audio]")
{
    const TempFolder folder;
    const std::vector<float> samples{1.0f, 1.0001f, -1.0f, -1.5f, 1e30f, -1e30f, 0.25f};
    for (auto encoding : {SampleEncoding::pcm16, SampleEncoding::pcm24})
    {
        const auto report = writeAudio(folder / "x.wav", samples, {.encoding = encoding});
        REQUIRE(report.ok());
        CHECK(report->clippedSamples == 4);
        const float top = encoding == SampleEncoding::pcm16 ? 32767.0f / 32768.0f : 8388607.0f / 8388608.0f;
        CHECK(readAudio(folder / "x.wav")->samples == std::vector<float>{top, top, -1.0f, -1.0f, top, -1.0f, 0.25f});
    }
}

TEST_CASE("Rounding without dither is to the nearest step", "[io][audio]")
{
    const TempFolder folder;
    std::vector<float> samples;
    Random random(11);
    for (int i = 0; i < 5000; ++i)
        samples.push_back(static_cast<float>(random.uniform(-0.99, 0.99)));
    REQUIRE(writeAudio(folder / "x.wav", samples, {.encoding = SampleEncoding::pcm16}).ok());
    const auto audio = readAudio(folder / "x.wav");
    for (std::size_t i = 0; i < samples.size(); ++i)
        REQUIRE(std::abs(audio->samples[i] - samples[i]) <= 0.5f / 32768.0f);
}

TEST_CASE("Triangular dither has no bias and a power of 3/12 step^2 at any level", "[io][audio]")
{
    // Without dither, a constant between two steps is always rounded to the same side. With it the mean is right and
    // the error's variance is 1/4 step^2 (rounding 1/12, dither 2/12) whatever the level.
    const TempFolder folder;
    constexpr int count = 200000;
    for (double level : {0.0, 0.25, 0.5, 0.9})
    {
        CAPTURE(level);
        const std::vector<float> samples(count, static_cast<float>(level / 32768.0));
        AudioWriteParams params{.encoding = SampleEncoding::pcm16, .ditherSeed = 42};
        REQUIRE(writeAudio(folder / "x.wav", samples, params).ok());
        const auto audio = readAudio(folder / "x.wav");
        double mean = 0.0, power = 0.0;
        for (float x : audio->samples)
        {
            const double error = static_cast<double>(x) * 32768.0 - level;
            mean += error / count;
            power += error * error / count;
        }
        CHECK(mean == Approx(0.0).margin(0.005));
        CHECK(power == Approx(0.25).margin(0.005));
    }
    const std::vector<float> samples(1000, 0.1f);
    const auto bytes = [&](std::uint64_t seed)
    {
        REQUIRE(writeAudio(folder / "d.wav", samples, {.encoding = SampleEncoding::pcm16, .ditherSeed = seed}).ok());
        return bytesOf(folder / "d.wav");
    };
    CHECK(bytes(1) == bytes(1));
    CHECK(bytes(1) != bytes(2));
}

TEST_CASE("Writing in parts gives the bytes of writing at once", "[io][audio]")
{
    const TempFolder folder;
    const auto samples = ramp(30000);
    for (const char* name : {".wav", ".flac"})
    {
        const AudioWriteParams params{.channels = 2, .encoding = SampleEncoding::pcm16, .ditherSeed = 5};
        REQUIRE(writeAudio(folder / (std::string("a") + name), samples, params).ok());
        auto writer = AudioWriter::create(folder / (std::string("b") + name), params);
        REQUIRE(writer.ok());
        for (std::size_t i = 0; i < samples.size();)
        {
            const auto n = std::min<std::size_t>(samples.size() - i, 2 * (1 + i % 3001));
            REQUIRE(writer->write(std::span(samples).subspan(i, n)).ok());
            i += n;
        }
        const auto report = writer->finish();
        REQUIRE(report.ok());
        CHECK(report->frames == 15000);
        CHECK(bytesOf(folder / (std::string("a") + name)) == bytesOf(folder / (std::string("b") + name)));
    }
}

TEST_CASE("Audio without frames can be written and read", "[io][audio]")
{
    const TempFolder folder;
    for (const char* name : {"x.wav", "x.flac"})
    {
        CAPTURE(name);
        REQUIRE(writeAudio(folder / name, {}, {.encoding = SampleEncoding::pcm16}).ok());
        const auto audio = readAudio(folder / name);
        REQUIRE(audio.ok());
        CHECK(audio->samples.empty());
        CHECK(audio->sampleRate == 48000);
    }
}

TEST_CASE("Parameters that no file can hold are refused before anything is written", "[io][audio]")
{
    const TempFolder folder;
    const std::vector<float> samples(64, 0.0f);
    const auto refused = [&](const char* name, const AudioWriteParams& params)
    {
        const auto report = writeAudio(folder / name, samples, params);
        REQUIRE_FALSE(report.ok());
        CHECK(report.error().code == ErrorCode::invalidArgument);
        return report.error().message;
    };
    CHECK(refused("x.mp3", {}) == "must have the extension .wav or .flac");
    CHECK(refused("x", {}) == "must have the extension .wav or .flac");
    CHECK(refused("x.flac", {}) == "FLAC does not support float samples; choose 16 or 24 bit, or write a .wav");
    CHECK(refused("x.wav", {.channels = 0}) == "0 channels are not supported; write 1 to 64");
    CHECK(refused("x.wav", {.channels = 65}) == "65 channels are not supported; write 1 to 64");
    CHECK(refused("x.flac", {.channels = 9, .encoding = SampleEncoding::pcm16}) ==
          "9 channels are not supported; write 1 to 8");
    CHECK(refused("x.wav", {.sampleRate = 0}) == "a sample rate of 0 Hz is not supported; choose 2000 to 768000 Hz");
    refused("x.wav", {.sampleRate = 768001});
    for (const int rate : {65537, 655351, 655360, 768000})
        CHECK(
            refused("x.flac", {.sampleRate = rate, .encoding = SampleEncoding::pcm24}) ==
            fmt::format("FLAC does not support a sample rate of {} Hz; choose (--rate) 2000 to 65535 Hz, or a multiple "
                        "of 10 Hz up to 655350 Hz, or write a .wav",
                        rate));
    CHECK(folder.entries() == 0);
    for (const int rate : {65535, 65540, 655350})
        CHECK(writeAudio(folder / "z.flac", samples, {.sampleRate = rate, .encoding = SampleEncoding::pcm24}).ok());
    for (int channels : {1, 64})
        for (int rate : {2000, 768000})
            CHECK(writeAudio(folder / "y.wav", samples, {.sampleRate = rate, .channels = channels}).ok());
    CHECK(
        writeAudio(folder / "y.flac", samples, {.sampleRate = 384000, .channels = 8, .encoding = SampleEncoding::pcm24})
            .ok());
}

TEST_CASE("A sample that is no number stops the writing and leaves no file", "[io][audio]")
{
    const TempFolder folder;
    for (const char* name : {"x.wav", "x.flac"})
    {
        auto writer = AudioWriter::create(folder / name, {.channels = 2, .encoding = SampleEncoding::pcm24});
        REQUIRE(writer.ok());
        std::vector<float> samples(20000, 0.0f);
        REQUIRE(writer->write(samples).ok());
        samples[15] = std::numeric_limits<float>::quiet_NaN();
        const auto written = writer->write(samples);
        REQUIRE_FALSE(written.ok());
        CHECK(written.error().code == ErrorCode::notFinite);
        CHECK(written.error().where == "frame 10007, channel 1");
        CHECK_FALSE(writer->finish().ok());
    }
    CHECK(folder.entries() == 0);
}

TEST_CASE("A writer that is dropped leaves the old file", "[io][audio]")
{
    const TempFolder folder;
    put(folder / "x.wav", "old");
    {
        auto writer = AudioWriter::create(folder / "x.wav", {});
        REQUIRE(writer.ok());
        REQUIRE(writer->write(std::vector<float>(100000, 0.5f)).ok());
    }
    CHECK(bytesOf(folder / "x.wav") == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("The same samples give the same bytes", "[io][audio]")
{
    // The peak chunk that libsndfile adds to float files would hold the time of day.
    const TempFolder folder;
    REQUIRE(writeAudio(folder / "x.wav", ramp(1000), {}).ok());
    const auto bytes = bytesOf(folder / "x.wav");
    CHECK(bytes.find("PEAK") == std::string::npos);
    CHECK(bytes.starts_with("RIFF"));
}

TEST_CASE("A WAV announced to pass 4 GB becomes an RF64, and an unannounced one is stopped", "[io][audio]")
{
    const TempFolder folder;
    const auto samples = ramp(1000);
    AudioWriteParams params{.channels = 2};
    params.expectedFrames = std::uint64_t(1) << 30;
    auto writer = AudioWriter::create(folder / "x.wav", params);
    REQUIRE(writer.ok());
    REQUIRE(writer->write(samples).ok());
    REQUIRE(writer->finish().ok());
    CHECK(bytesOf(folder / "x.wav").starts_with("RF64"));
    CHECK(readAudio(folder / "x.wav")->samples == samples);

    params.expectedFrames = 1000;
    CHECK(writeAudio(folder / "y.wav", samples, params).ok());
    CHECK(bytesOf(folder / "y.wav").starts_with("RIFF"));
}

TEST_CASE("A recording without a known end has room for more than 4 GB, and is a WAV when it needs less", "[io][audio]")
{
    const TempFolder folder;
    const auto samples = ramp(1000);
    AudioWriteParams params{.channels = 2};
    params.expectedFrames = AudioWriteParams::endless;
    params.markers = {{0.001, "hit"}};
    for (const bool hasSamples : {true, false})
    {
        auto writer = AudioWriter::create(folder / "x.wav", params);
        REQUIRE(writer.ok());
        if (hasSamples)
            REQUIRE(writer->write(samples).ok());
        const auto report = writer->finish();
        REQUIRE(report.ok());
        const std::string bytes = bytesOf(folder / "x.wav");
        CHECK(bytes.starts_with("RIFF"));
        CHECK(bytes.substr(12, 4) == "JUNK"); // the room for sizes of 64 bits, which a WAV does not have
        std::uint32_t stated = 0;
        std::memcpy(&stated, bytes.data() + 4, 4);
        CHECK(stated == bytes.size() - 8);
        CHECK(report->bytes == bytes.size());
        const auto back = readAudio(folder / "x.wav");
        REQUIRE(back.ok());
        CHECK(back->samples == (hasSamples ? samples : std::vector<float>{}));
    }
}
