#include "io/AudioReader.h"

#include "io/AudioBytes.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/Skip.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace fs = std::filesystem;

namespace
{
const fs::path fixtures = testFolder() / "io/audio";

constexpr AudioReadOptions truncatedAllowed{.allowTruncated = true, .allowNan = false};
constexpr AudioReadOptions nanAllowed{.allowTruncated = false, .allowNan = true};

/// The Error of reading `bytes` as a file.
Error failureOf(const TempFolder& folder, const std::string& bytes, AudioReadOptions options = {})
{
    const auto audio = readAudio(put(folder / "case", bytes), options);
    REQUIRE_FALSE(audio.ok());
    return audio.error();
}
} // namespace

TEST_CASE("Lossless formats deliver the very samples", "[io][audio]")
{
    for (const char* name :
         {"ramp.aiff", "ramp-double.aiff", "ramp.caf", "ramp.w64", "ramp.au", "ramp.flac", "ramp-rf64.wav"})
    {
        CAPTURE(name);
        auto reader = AudioReader::open(fixtures / name);
        REQUIRE(reader.ok());
        CHECK(reader->sampleRate() == 8000);
        CHECK(reader->channels() == 2);
        CHECK(reader->frames() == 400);
        const auto audio = readAudio(fixtures / name);
        REQUIRE(audio.ok());
        REQUIRE(audio->samples.size() == 800);
        for (std::size_t i = 0; i < 400; ++i)
        {
            REQUIRE(audio->samples[2 * i] == static_cast<float>(i) / 1024.0f);
            REQUIRE(audio->samples[2 * i + 1] == static_cast<float>(i) / -2048.0f);
        }
    }
}

TEST_CASE("A WAV written byte by byte is read in blocks of any size", "[io][audio]")
{
    const TempFolder folder;
    std::vector<int> values;
    for (int i = 0; i < 300; ++i)
        values.push_back((i * 7919) % 65536 - 32768);
    const auto path = put(folder / "x.bin", wavBytes({.channels = 3}, pcm16(values)));
    for (std::size_t frames : {1u, 7u, 64u, 1000u})
    {
        auto reader = AudioReader::open(path);
        REQUIRE(reader.ok());
        std::vector<float> block(frames * 3);
        std::vector<float> all;
        for (;;)
        {
            const auto got = reader->read(block);
            REQUIRE(got.ok());
            if (*got == 0)
                break;
            all.insert(all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(*got * 3));
        }
        REQUIRE(all.size() == values.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            REQUIRE(all[i] == static_cast<float>(values[i]) / 32768.0f);
    }
}

TEST_CASE("Lossy formats deliver a tone of the right level and length", "[io][audio]")
{
    for (const char* name : {"tone.ogg", "tone.opus", "tone.mp3"})
    {
        CAPTURE(name);
        const auto audio = readAudio(fixtures / name);
        if (!audio.ok() && std::string(name) == "tone.mp3" &&
            audio.error().message.starts_with("is not audio in a supported format"))
        {
            test::skip("this libsndfile reads no MP3");
            continue;
        }
        REQUIRE(audio.ok());
        CHECK(audio->channels == 1);
        CHECK(audio->samples.size() == Approx(audio->sampleRate).margin(2304));
        double power = 0.0;
        for (float x : audio->samples)
            power += static_cast<double>(x) * static_cast<double>(x);
        CHECK(std::sqrt(power / static_cast<double>(audio->samples.size())) ==
              Approx(0.5 / std::sqrt(2.0)).epsilon(0.05));
    }
}

TEST_CASE("Files that are no audio are refused with one clear line", "[io][audio]")
{
    const TempFolder folder;
    CHECK(readAudio(folder / "missing.wav").error().message == "does not exist; check the name and the folder");
    CHECK(readAudio(folder.path()).error().message == "is a folder; give the name of a file");
    CHECK(failureOf(folder, "").message == "is empty; choose a file with audio");
    const auto unknown = "is not audio in a supported format; convert it to WAV, AIFF, FLAC, Ogg or CAF";
    CHECK(failureOf(folder, "These are words, not sounds.\n").message == unknown);
    CHECK(failureOf(folder, "R").message == unknown);
    CHECK(failureOf(folder, std::string(10000, '\0')).message == unknown);
    // A name does not make audio: headerless formats are not guessed from the extension.
    for (const char* name : {"words.vox", "words.gsm", "words.raw", "words.wav"})
        CHECK(readAudio(put(folder / name, std::string(1000, 'a'))).error().message == unknown);
    using namespace std::string_literals;
    for (const auto& start : {"\0\0\0\x20"
                              "ftypisom"s,
                              "\x1A\x45\xDF\xA3\xA3"s,
                              "RIFF\0\x10\0\0"
                              "AVI LIST"s,
                              "\xFF\xF1\x50\x80"s})
    {
        // What ffmpeg says of them differs by its version, and it may not be installed.
        const auto error = failureOf(folder, start + std::string(2000, '\0'));
        CHECK(error.code == ErrorCode::invalidData);
        CHECK((error.message.starts_with("cannot be read by ffmpeg (") ||
               error.message.starts_with("is a film or has a codec that is decoded by ffmpeg, but") ||
               error.message.starts_with("has no sound that ffmpeg knows")));
    }
    const auto onlyStart = failureOf(folder, wavBytes({}, "").substr(0, 30));
    CHECK(onlyStart.code == ErrorCode::invalidData);
    CHECK(onlyStart.message.find('\n') == std::string::npos);
}

TEST_CASE("Channels and rates outside the accepted range are refused", "[io][audio]")
{
    const TempFolder folder;
    const std::string data(2000, '\0');
    CHECK(failureOf(folder, wavBytes({.channels = 65}, data)).message ==
          "has 65 channels, but only 1 to 64 are supported; mix it down");
    CHECK(failureOf(folder, wavBytes({.sampleRate = 999}, data)).message ==
          "has a sample rate of 999 Hz, but only 1000 to 768000 Hz are supported; resample it");
    CHECK(failureOf(folder, wavBytes({.sampleRate = 768001}, data)).code == ErrorCode::invalidData);
    const AudioReadOptions slow{.lowestSampleRate = 2000};
    CHECK(readAudio(put(folder / "slow", wavBytes({.sampleRate = 2000}, data)), slow)->sampleRate == 2000);
    CHECK(readAudio(put(folder / "ok", wavBytes({.channels = 64, .sampleRate = 768000}, data))).ok());
    for (std::uint16_t channels : {std::uint16_t(0), std::uint16_t(1025), std::uint16_t(65535)})
        CHECK(failureOf(folder, wavBytes({.channels = channels}, data)).code == ErrorCode::invalidData);
    for (std::uint32_t rate : {0u, 3000000000u})
        CHECK(failureOf(folder, wavBytes({.sampleRate = rate}, data)).code == ErrorCode::invalidData);
}

TEST_CASE("Memory does not follow what a header claims", "[io][audio]")
{
    const TempFolder folder;
    const std::string data(2000, '\0');
    CHECK(failureOf(folder, auBytes(10'000'000, 2000, data)).code == ErrorCode::invalidData);

    const auto huge = wavBytes({.bits = 8, .dataBytes = 0x81234567u}, data);
    const auto error = failureOf(folder, huge);
    CHECK(error.code == ErrorCode::truncated);
    CHECK(error.message == "is truncated: it has 2000 frames of 2166572391; get a complete copy");
    const auto audio = readAudio(put(folder / "huge", huge), truncatedAllowed);
    REQUIRE(audio.ok());
    CHECK(audio->samples.size() == 2000);
    CHECK(audio->samples.capacity() < 1000000);

    // 2^36 - 1 frames, the most that a FLAC can claim.
    auto flac = bytesOf(fixtures / "ramp.flac");
    flac[21] = static_cast<char>(flac[21] | 0x0F);
    flac.replace(22, 4, "\xFF\xFF\xFF\xFF");
    CHECK(failureOf(folder, flac).message == "is truncated: it has 400 frames of 68719476735; get a complete copy");
}

TEST_CASE("A file that was cut off is told from a whole one", "[io][audio]")
{
    const TempFolder folder;
    const auto cut = [&](const char* name, std::size_t bytes)
    {
        return put(folder / name, bytesOf(fixtures / name).substr(0, bytes));
    };

    // 100 of 400 frames of two 16-bit channels less.
    struct Case
    {
        const char* name;
        std::size_t frameBytes;
    };
    for (const auto& [name, frameBytes] : {Case{"ramp.aiff", 4}, Case{"ramp-double.aiff", 16}, Case{"ramp.w64", 4},
                                           Case{"ramp.au", 4}, Case{"ramp-rf64.wav", 4}})
    {
        CAPTURE(name);
        const auto path = cut(name, fs::file_size(fixtures / name) - 100 * frameBytes);
        const auto refused = AudioReader::open(path);
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.error().code == ErrorCode::truncated);
        CHECK(refused.error().message == "is truncated: it has 300 frames of 400; get a complete copy");
        const auto allowed = readAudio(path, truncatedAllowed);
        REQUIRE(allowed.ok());
        CHECK(allowed->samples.size() == 600);
    }
    for (const auto& [name, keep] : {std::pair("ramp.caf", 4500u), std::pair("tone.flac", 9000u),
                                     std::pair("tone.ogg", 6500u), std::pair("tone.mp3", 2500u)})
    {
        CAPTURE(name);
        const auto path = cut(name, keep);
        const auto refused = readAudio(path);
        REQUIRE_FALSE(refused.ok());
        if (refused.error().message.starts_with("is not audio in a supported format"))
            continue; // a libsndfile without MP3
        CHECK(refused.error().code == ErrorCode::truncated);
        CHECK(readAudio(path, truncatedAllowed).ok());
    }
    // Codecs pack samples together: bytes are counted instead.
    CHECK(readAudio(cut("ramp-adpcm.wav", 400)).error().message.find("bytes of audio of 512") != std::string::npos);
}

TEST_CASE("Streamed files with an open length are read to their end", "[io][audio]")
{
    const TempFolder folder;
    const auto data = pcm16(std::vector<int>(500, 1000));
    for (std::uint32_t left : {0xFFFFFFFFu, 0x7FFFF000u, 0x7FFFFFFFu, 0x80000000u, 2'000'000'000u, 0x7FFFFF00u})
    {
        CAPTURE(left);
        const auto audio = readAudio(put(folder / "x", wavBytes({.dataBytes = left}, data)));
        REQUIRE(audio.ok());
        CHECK(audio->samples.size() == 500);
    }
}

TEST_CASE("Chunks of odd length without the byte of padding do not hide the sound behind them", "[io][audio]")
{
    const TempFolder folder;
    const auto plain = wavBytes({}, pcm16({1000, -2000, 3000, -4000}));
    const auto data = plain.find("data");
    const auto odd = "LIST" + littleEndian(17, 4) + "INFOISFT" + littleEndian(5, 4) + "Lame3";
    const auto expected = readAudio(put(folder / "plain.wav", plain))->samples;
    REQUIRE(expected.size() == 4);
    for (const auto& between : {odd, odd + odd, odd + "JUNK" + littleEndian(4, 4) + "wxyz"})
        for (const auto& behind : {std::string(), odd})
        {
            auto wav = plain;
            wav.insert(data, between);
            wav += behind;
            const auto audio = readAudio(put(folder / "odd.wav", wav));
            REQUIRE(audio.ok());
            CHECK(audio->samples == expected);
            CHECK(audio->warnings.empty());
        }
}

TEST_CASE("A file without frames is correct and empty", "[io][audio]")
{
    const TempFolder folder;
    const auto audio = readAudio(put(folder / "x", wavBytes({}, "")));
    REQUIRE(audio.ok());
    CHECK(audio->samples.empty());
    CHECK(audio->sampleRate == 8000);
    CHECK(failureOf(folder, wavBytes({.dataBytes = 1000}, "")).code == ErrorCode::truncated);
}

TEST_CASE("Samples that are no numbers are named by frame and channel, or replaced and counted", "[io][audio]")
{
    const TempFolder folder;
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                      -std::numeric_limits<float>::infinity()})
    {
        // Beyond the first block of reading, so that frames must be counted over blocks.
        std::vector<float> samples(200000, 0.5f);
        samples[150001] = bad;
        samples[150005] = bad;
        const auto bytes = wavBytes({.channels = 2, .bits = 32, .tag = 3}, float32(samples));
        const auto error = failureOf(folder, bytes);
        CHECK(error.code == ErrorCode::notFinite);
        CHECK(error.where == "frame 75000, channel 1");
        CHECK(error.message == std::string("is ") + (std::isnan(bad) ? "NaN" : "infinite") +
                                   ", not a number (counted from 0); repair the file");
        const auto audio = readAudio(put(folder / "x", bytes), nanAllowed);
        REQUIRE(audio.ok());
        CHECK(audio->replacedSamples == 2);
        const auto kept = readAudio(folder / "x", {.keepNan = true});
        REQUIRE(kept.ok());
        CHECK_FALSE(std::isfinite(kept->samples[150001]));
        samples[150001] = samples[150005] = 0.0f;
        CHECK(audio->samples == samples);
    }
}

TEST_CASE("Samples far beyond any full scale are damage, not sound", "[io][audio]")
{
    const TempFolder folder;
    const auto file = [](float value)
    {
        return wavBytes({.bits = 32, .tag = 3}, float32(std::vector<float>{0.5f, value}));
    };
    const auto error = failureOf(folder, file(-1e30f));
    CHECK(error.code == ErrorCode::notFinite);
    CHECK(error.where == "frame 1, channel 0");
    CHECK(error.message == "is -1e+30, far beyond full scale (counted from 0); repair the file");
    CHECK(readAudio(put(folder / "x", file(-1e30f)), nanAllowed)->replacedSamples == 1);
    CHECK(readAudio(put(folder / "x", file(limits::sample)))->samples[1] == limits::sample);
}

TEST_CASE("More frames than allowed are refused", "[io][audio]")
{
    const TempFolder folder;
    const auto path = put(folder / "x", wavBytes({}, std::string(200, '\0')));
    CHECK(readAudio(path, {}, 100).ok());
    CHECK(readAudio(path, {}, 99).error().code == ErrorCode::tooLarge);
}

TEST_CASE("Damaged files of every format end in samples or in an error", "[io][audio]")
{
    const TempFolder folder;
    Random random(20260101);
    for (const auto& entry : fs::directory_iterator(fixtures))
    {
        const auto whole = bytesOf(entry.path());
        for (int round = 0; round < 60; ++round)
        {
            auto bytes = whole;
            // Most of what can go wrong is in the header.
            const auto reach = round % 2 == 0 ? std::min<std::size_t>(bytes.size(), 96) : bytes.size();
            for (int i = 0; i <= round % 5; ++i)
                bytes[random.next() % reach] = static_cast<char>(random.next());
            if (round % 3 == 0)
                bytes.resize(random.next() % bytes.size());
            CAPTURE(entry.path().filename().string(), round);
            const auto path = put(folder / "damaged", bytes);
            for (bool allow : {false, true})
            {
                const auto audio = readAudio(path, {.allowTruncated = allow, .allowNan = allow}, 10'000'000);
                if (audio.ok())
                    for (float x : audio->samples)
                        REQUIRE(std::isfinite(x));
                else
                {
                    CHECK_FALSE(audio.error().message.empty());
                    CHECK(audio.error().message.find('\n') == std::string::npos);
                }
            }
        }
    }
}
