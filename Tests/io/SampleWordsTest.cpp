#include "io/AudioBytes.h"
#include "io/AudioReader.h"
#include "io/TagBytes.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
constexpr int wordRate = 8000;
constexpr std::size_t wordFrames = 40'000;

/// A container for words of any size, as its header describes them.
struct Container
{
    std::string name;
    bool bigEndian = false;
    /// The file of `data` in words of so many bytes, of which so many bits are stated.
    std::function<std::string(int bytes, int bits, const std::string& data)> write;
};

/// The `fmt ` of a WAV or W64, extensible where bits are stated beside those of the word.
std::string wordFormat(int tag, int bytes, int bits, bool isLong)
{
    const auto number = [](int value, int width)
    {
        return littleEndian(static_cast<std::uint64_t>(value), width);
    };
    const auto common = number(isLong ? 0xFFFE : tag, 2) + number(1, 2) + number(wordRate, 4) +
                        number(wordRate * bytes, 4) + number(bytes, 2) + number(isLong ? 8 * bytes : bits, 2);
    if (!isLong)
        return common;
    return common + number(22, 2) + number(bits, 2) + number(0, 4) + number(tag, 2) +
           std::string("\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71", 14);
}

std::string waveOf(const std::string& format, const std::string& data)
{
    const auto body =
        "WAVEfmt " + littleEndian(format.size(), 4) + format + "data" + littleEndian(data.size(), 4) + data;
    return "RIFF" + littleEndian(body.size(), 4) + body;
}

std::string longWaveOf(const std::string& id, const std::string& format, const std::string& data)
{
    const auto body = "WAVEds64" + littleEndian(28, 4) + littleEndian(0, 8) + littleEndian(data.size(), 8) +
                      littleEndian(0, 8) + littleEndian(0, 4) + "fmt " + littleEndian(format.size(), 4) + format +
                      "data" + littleEndian(0xFFFFFFFFu, 4) + data;
    return id + littleEndian(0xFFFFFFFFu, 4) + body;
}

std::string wave64Of(const std::string& format, const std::string& data)
{
    const std::string guid("\xF3\xAC\xD3\x11\x8C\xD1\x00\xC0\x4F\x8E\xDB\x8A", 12);
    const auto body = "wave" + guid + "fmt " + guid + littleEndian(format.size() + 24, 8) + format + "data" + guid +
                      littleEndian(data.size() + 24, 8) + data;
    return std::string("riff\x2E\x91\xCF\x11\xA5\xD6\x28\xDB\x04\xC1\x00\x00", 16) + littleEndian(body.size() + 24, 8) +
           body;
}

std::string aiffOf(int, int bits, const std::string& data, const std::string& codec = "")
{
    const auto count = data.size() / static_cast<std::size_t>((bits + 7) / 8);
    const auto comm = bigEndian(1, 2) + bigEndian(count, 4) + bigEndian(static_cast<std::uint64_t>(bits), 2) +
                      bigEndian(16383 + 12, 2) + bigEndian(std::uint64_t{wordRate} << 51u, 8) +
                      (codec.empty() ? "" : codec + std::string(2, '\0'));
    const auto body = (codec.empty() ? "AIFFCOMM" : "AIFCCOMM") + bigEndian(comm.size(), 4) + comm + "SSND" +
                      bigEndian(data.size() + 8, 4) + std::string(8, '\0') + data;
    return "FORM" + bigEndian(body.size(), 4) + body;
}

std::string cafOf(int flags, int bytes, int bits, const std::string& data)
{
    const auto number = [](int value)
    {
        return bigEndian(static_cast<std::uint64_t>(value), 4);
    };
    return "caff" + bigEndian(1, 2) + bigEndian(0, 2) + "desc" + bigEndian(32, 8) + bigEndian(0x40BF400000000000u, 8) +
           "lpcm" + number(flags) + number(bytes) + number(1) + number(1) + number(bits) + "data" +
           bigEndian(data.size() + 4, 8) + number(0) + data;
}

std::string auOf(int codec, const std::string& data)
{
    return ".snd" + bigEndian(24, 4) + bigEndian(data.size(), 4) + bigEndian(static_cast<std::uint64_t>(codec), 4) +
           bigEndian(wordRate, 4) + bigEndian(1, 4) + data;
}

/// Those that may have integers in longer words.
std::vector<Container> integerContainers()
{
    const auto isPlain = [](int bytes, int bits)
    {
        return (bits + 7) / 8 == bytes;
    };
    return {
        {"WAV", false,
         [](int w, int b, const auto& d)
         {
             return waveOf(wordFormat(1, w, b, false), d);
         }},
        {"extensible WAV", false,
         [](int w, int b, const auto& d)
         {
             return waveOf(wordFormat(1, w, b, true), d);
         }},
        {"RF64", false,
         [](int w, int b, const auto& d)
         {
             return longWaveOf("RF64", wordFormat(1, w, b, true), d);
         }},
        {"BW64", false,
         [](int w, int b, const auto& d)
         {
             return longWaveOf("BW64", wordFormat(1, w, b, false), d);
         }},
        {"W64", false,
         [](int w, int b, const auto& d)
         {
             return wave64Of(wordFormat(1, w, b, false), d);
         }},
        {"extensible W64", false,
         [](int w, int b, const auto& d)
         {
             return wave64Of(wordFormat(1, w, b, true), d);
         }},
        {"CAF", true,
         [](int w, int b, const auto& d)
         {
             return cafOf(0, w, b, d);
         }},
        {"little-endian CAF", false,
         [](int w, int b, const auto& d)
         {
             return cafOf(2, w, b, d);
         }},
        {"AIFF", true,
         [=](int w, int b, const auto& d)
         {
             return isPlain(w, b) ? aiffOf(w, b, d) : std::string();
         }},
        {"AIFC", false,
         [=](int w, int b, const auto& d)
         {
             return isPlain(w, b) ? aiffOf(w, b, d, "sowt") : std::string();
         }},
    };
}

double wordSoundAt(std::size_t frame)
{
    return 0.5 * std::sin(2.0 * 3.14159265358979 * 110.0 * static_cast<double>(frame) / wordRate);
}

/// The sound as integers of so many bits, shifted up by others.
std::string integersOf(int bytes, int bits, int shift, bool isBig,
                       const std::function<double(std::size_t)>& sound = wordSoundAt)
{
    std::string data;
    for (std::size_t i = 0; i < wordFrames; ++i)
    {
        const auto value = std::llround(sound(i) * std::ldexp(1.0, bits - 1)) * (std::int64_t{1} << shift);
        data += isBig ? bigEndian(static_cast<std::uint64_t>(value), bytes)
                      : littleEndian(static_cast<std::uint64_t>(value), bytes);
    }
    return data;
}

std::string numbersOf(double scale, bool isWhole, bool isBig, bool isDouble = false)
{
    std::string data;
    for (std::size_t i = 0; i < wordFrames; ++i)
    {
        const auto value = isWhole ? std::round(scale * wordSoundAt(i)) : scale * wordSoundAt(i);
        const auto bits =
            isDouble ? std::bit_cast<std::uint64_t>(value) : std::bit_cast<std::uint32_t>(static_cast<float>(value));
        data += isBig ? bigEndian(bits, isDouble ? 8 : 4) : littleEndian(bits, isDouble ? 8 : 4);
    }
    return data;
}

double farthestFrom(const AudioData& audio, const std::function<double(std::size_t)>& sound = wordSoundAt)
{
    double most = 0.0;
    for (std::size_t i = 0; i < audio.samples.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(audio.samples[i]) - sound(i)));
    return most;
}

const TempFolder& wordFolder()
{
    static const TempFolder one;
    return one;
}

AudioData readWords(const std::string& bytes)
{
    const auto audio = readAudio(put(wordFolder() / "x", bytes));
    REQUIRE(audio.ok());
    REQUIRE(audio->samples.size() == wordFrames);
    return *audio;
}
} // namespace

TEST_CASE("Integers in longer words are read whichever end they lie at, and told where it is the wrong one",
          "[io][audio]")
{
    for (const Container& container : integerContainers())
        for (const auto& [bytes, bits] :
             {std::pair(4, 24), std::pair(4, 20), std::pair(3, 20), std::pair(3, 18), std::pair(2, 12)})
        {
            CAPTURE(container.name, bytes, bits);
            const int spare = 8 * bytes - bits;
            const auto high = container.write(bytes, bits, integersOf(bytes, bits, spare, container.bigEndian));
            if (high.empty())
                continue;
            const double step = std::ldexp(1.0, 1 - bits);
            const auto whole = readWords(high);
            CHECK(farthestFrom(whole) < step);
            CHECK(whole.warnings.empty());
            const auto low = readWords(container.write(bytes, bits, integersOf(bytes, bits, 0, container.bigEndian)));
            CHECK(farthestFrom(low) < step);
            REQUIRE(low.warnings.size() == 1);
            CHECK(low.warnings.front().find("low end") != std::string::npos);
        }
}

TEST_CASE("Integers at the low end are told by all of a sound, not by a part of it", "[io][audio]")
{
    // Silence for all but the end, as pieces of the sound show it.
    const auto late = [](std::size_t i)
    {
        return i < wordFrames - 300 ? 0.0 : wordSoundAt(i);
    };
    const auto silent = readWords(waveOf(wordFormat(1, 4, 24, true), integersOf(4, 24, 0, false, late)));
    CHECK(farthestFrom(silent, late) < 1e-6);
    CHECK(silent.warnings.size() == 1);
    // A soft sound, and one word that has more.
    auto loud = integersOf(4, 24, 0, false);
    loud.replace(4 * 30'001, 4, littleEndian(0x40000001u, 4));
    const auto stated = readWords(waveOf(wordFormat(1, 4, 24, true), loud));
    CHECK(farthestFrom(stated) > 0.4);
    CHECK(std::abs(stated.samples[30'001] - 0.5f) < 1e-6f);
    CHECK(stated.warnings.empty());
    // A list of waves has its audio in several.
    const auto data = integersOf(4, 24, 0, false);
    const auto head = "WAVEfmt " + littleEndian(40, 4) + wordFormat(1, 4, 24, true);
    const auto list = "wavldata" + littleEndian(data.size() / 2, 4) + data.substr(0, data.size() / 2) + "data" +
                      littleEndian(data.size() / 2, 4) + data.substr(data.size() / 2);
    const auto body = head + "LIST" + littleEndian(list.size(), 4) + list;
    const auto waves = readWords("RIFF" + littleEndian(body.size(), 4) + body);
    CHECK(farthestFrom(waves) < 1e-6);
    CHECK(waves.warnings.size() == 1);
}

TEST_CASE("Words of 32 bits of which the lowest alone are used are read as stated, with a word", "[io][audio]")
{
    for (const auto& bytes : {waveOf(wordFormat(1, 4, 32, false), integersOf(4, 24, 0, false)),
                              aiffOf(4, 32, integersOf(4, 24, 0, true)), auOf(5, integersOf(4, 24, 0, true))})
    {
        const auto soft = readWords(bytes);
        REQUIRE(soft.warnings.size() == 1);
        CHECK(soft.warnings.front().find("uses 24 of the 32 bits") != std::string::npos);
        CHECK(farthestFrom(soft, [](std::size_t i) { return wordSoundAt(i) / 256.0; }) < 1e-6);
    }
    // A soft sound of 16 or 24 bits in words of 32 is none of those.
    const auto soft = [](std::size_t i)
    {
        return 0.003 * wordSoundAt(i);
    };
    CHECK(readWords(waveOf(wordFormat(1, 4, 32, false), integersOf(4, 24, 8, false, soft))).warnings.empty());
    CHECK(readWords(waveOf(wordFormat(1, 4, 32, false), integersOf(4, 32, 0, false))).warnings.empty());
    CHECK(readWords(waveOf(wordFormat(1, 3, 24, false), integersOf(3, 24, 0, false, soft))).warnings.empty());
    CHECK(readWords(waveOf(wordFormat(1, 2, 16, false), integersOf(2, 16, 0, false, soft))).warnings.empty());
}

TEST_CASE("Floating-point numbers that a header calls integers are read as what they are, and told", "[io][audio]")
{
    for (const auto& [bits, scale] : {std::pair(24, 1.0), std::pair(24, 8388608.0), std::pair(32, 32768.0),
                                      std::pair(16, 32768.0), std::pair(32, 1.0)})
        for (const bool isLong : {false, true})
        {
            CAPTURE(bits, scale, isLong);
            for (const auto& bytes : {waveOf(wordFormat(1, 4, bits, isLong), numbersOf(scale, false, false)),
                                      wave64Of(wordFormat(1, 4, bits, isLong), numbersOf(scale, false, false))})
            {
                const auto audio = readWords(bytes);
                CHECK(farthestFrom(audio) < 1e-6);
                REQUIRE(audio.warnings.size() == 1);
                CHECK(audio.warnings.front().find("floating-point") != std::string::npos);
            }
        }
}

TEST_CASE("Floating-point numbers that a CAF, AU or AIFF calls integers are read, or it is said that they are not",
          "[io][audio]")
{
    for (const double scale : {1.0, 32768.0})
    {
        for (const auto& bytes :
             {cafOf(0, 4, 32, numbersOf(scale, false, true)), cafOf(2, 4, 32, numbersOf(scale, false, false)),
              auOf(5, numbersOf(scale, false, true))})
        {
            CAPTURE(scale, bytes.substr(0, 4));
            const auto audio = readWords(bytes);
            CHECK(farthestFrom(audio) < 1e-6);
            REQUIRE(audio.warnings.size() == 1);
            CHECK(audio.warnings.front().find("it is read as these") != std::string::npos);
        }
        // Its header has no place for the kind of its samples.
        const auto bytes = aiffOf(4, 32, numbersOf(scale, false, true));
        const auto audio = readWords(bytes);
        CHECK(farthestFrom(audio) > 0.1);
        REQUIRE(audio.warnings.size() == 1);
        CHECK(audio.warnings.front().find("it is read as stated, which may be noise") != std::string::npos);
    }
}

TEST_CASE("Floating-point numbers are read as such, however their header says so", "[io][audio]")
{
    for (const bool isLong : {false, true})
        for (const auto& bytes : {waveOf(wordFormat(3, 4, 32, isLong), numbersOf(1.0, false, false)),
                                  waveOf(wordFormat(3, 8, 64, isLong), numbersOf(1.0, false, false, true)),
                                  longWaveOf("BW64", wordFormat(3, 4, 32, isLong), numbersOf(1.0, false, false)),
                                  wave64Of(wordFormat(3, 4, 32, isLong), numbersOf(1.0, false, false)),
                                  wave64Of(wordFormat(3, 8, 64, isLong), numbersOf(1.0, false, false, true))})
        {
            CAPTURE(isLong, bytes.size(), bytes.substr(0, 4));
            const auto audio = readWords(bytes);
            CHECK(farthestFrom(audio) < 1e-6);
            CHECK(audio.warnings.empty());
        }
}

TEST_CASE("Integers as floating-point numbers are read by their own full scale, and told", "[io][audio]")
{
    for (const auto& [scale, bits] : {std::pair(32768.0, 16), std::pair(8388608.0, 24), std::pair(2147483648.0, 32)})
        for (const auto& bytes :
             {waveOf(wordFormat(3, 4, 32, false), numbersOf(scale, true, false)),
              waveOf(wordFormat(3, 4, 32, true), numbersOf(scale, true, false)),
              waveOf(wordFormat(3, 8, 64, false), numbersOf(scale, true, false, true)),
              longWaveOf("RF64", wordFormat(3, 4, 32, false), numbersOf(scale, true, false)),
              wave64Of(wordFormat(3, 4, 32, false), numbersOf(scale, true, false)),
              aiffOf(4, 32, numbersOf(scale, true, true), "fl32"), cafOf(1, 4, 32, numbersOf(scale, true, true)),
              cafOf(3, 8, 64, numbersOf(scale, true, false, true)), auOf(6, numbersOf(scale, true, true)),
              auOf(7, numbersOf(scale, true, true, true))})
        {
            CAPTURE(bits, bytes.substr(0, 4));
            const auto audio = readWords(bytes);
            CHECK(farthestFrom(audio) < 2.0 / scale + 1e-7);
            REQUIRE(audio.warnings.size() == 1);
            CHECK(audio.warnings.front().find("integers of " + std::to_string(bits) + " bits") != std::string::npos);
        }
    // What is merely loud stays as it is, and far beyond full scale it is told.
    const auto beyond = readWords(waveOf(wordFormat(3, 4, 32, false), numbersOf(30.0, false, false)));
    CHECK(farthestFrom(beyond, [](std::size_t i) { return 30.0 * wordSoundAt(i); }) < 1e-5);
    CHECK(beyond.warnings.empty());
    const auto loud = readWords(waveOf(wordFormat(3, 4, 32, false), numbersOf(32768.0, false, false)));
    CHECK(farthestFrom(loud, [](std::size_t i) { return 32768.0 * wordSoundAt(i); }) < 0.01);
    REQUIRE(loud.warnings.size() == 1);
    CHECK(loud.warnings.front().find("16384 times full scale") != std::string::npos);
}
