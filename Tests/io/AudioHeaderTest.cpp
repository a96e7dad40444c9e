#include "io/AudioHeader.h"

#include "io/AudioBytes.h"
#include "io/FileHandle.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <optional>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{

/// The audio bytes that a header promises and the bytes that the file has in their place.
struct AudioDataSize
{
    std::uint64_t promised = 0;
    std::uint64_t present = 0;
    bool operator==(const AudioDataSize&) const = default;
};

std::optional<AudioDataSize> headerSize(const std::string& bytes)
{
    const TempFolder folder;
    const auto file = openStream(put(folder / "x", bytes), "rb");
    REQUIRE(file);
    ByteWindow window(file.get());
    const auto chunk = findAudioChunk(window, 0, window.size());
    if (!chunk || !chunk->promise)
        return {};
    return AudioDataSize{*chunk->promise, std::min(*chunk->promise, chunk->present(window.size()))};
}

std::optional<AudioDataSize> promisedSize(std::uint64_t promised, std::uint64_t present)
{
    return AudioDataSize{promised, present};
}

const std::string headerSamples(100, 'x');

/// A chunk of the RIFF kind, padded to an even length.
std::string riffChunk(const std::string& id, const std::string& content)
{
    return id + littleEndian(content.size(), 4) + content + std::string(content.size() % 2, '\0');
}

/// The same of AIFF.
std::string aiffChunk(const std::string& id, const std::string& content)
{
    return id + bigEndian(content.size(), 4) + content + std::string(content.size() % 2, '\0');
}

/// A chunk of W64: the size includes the header of 24 bytes, and chunks start at multiples of 8.
std::string waveChunk(const std::string& id, std::uint64_t size, const std::string& content)
{
    std::string chunk = id + std::string(16 - id.size(), '\x11') + littleEndian(size, 8) + content;
    return chunk + std::string((8 - chunk.size() % 8) % 8, '\0');
}

} // namespace

TEST_CASE("The audio bytes that a WAV promises are told from those that it has", "[io][audio]")
{
    for (const std::string& id : {std::string("RIFF"), std::string("RIFX")})
    {
        CAPTURE(id);
        const auto number = [&](std::uint64_t value)
        {
            return id == "RIFF" ? littleEndian(value, 4) : bigEndian(value, 4);
        };
        const std::string start = id + number(0) + "WAVE";
        const std::string odd = "odd " + number(3) + "abc" + std::string(1, '\0');
        CHECK(headerSize(start + "data" + number(100) + headerSamples) == promisedSize(100, 100));
        CHECK(headerSize(start + "data" + number(101) + headerSamples) == promisedSize(101, 100));
        CHECK(headerSize(start + "data" + number(60) + headerSamples) == promisedSize(60, 60));
        CHECK(headerSize(start + odd + "data" + number(200) + headerSamples) == promisedSize(200, 100));
        CHECK(headerSize(start + odd + odd + "data" + number(0)) == promisedSize(0, 0));
        CHECK(headerSize(start + "even" + number(2) + "ab" + "data" + number(7) + "abc") == promisedSize(7, 3));
        CHECK(headerSize(start + "data" + number(0x7FFE0000) + headerSamples) == promisedSize(0x7FFE0000, 100));
        CHECK(headerSize(start + "data" + number(0x80000001) + headerSamples) == promisedSize(0x80000001, 100));
        CHECK(headerSize(start + "data" + number(2'000'000'002) + headerSamples) == promisedSize(2'000'000'002, 100));
        // Sizes that writers leave behind which cannot seek back promise nothing.
        for (const std::uint64_t open : {0xFFFFFFFFull, 0xFFFFFFDBull, 0x80000000ull, 0x7FFFFFFFull, 0x7FFFFF00ull,
                                         0x7FFFF000ull, 2'000'000'000ull})
            CHECK(headerSize(start + "data" + number(open) + headerSamples) == std::nullopt);
        CHECK(headerSize(start) == std::nullopt);
        CHECK(headerSize(start + "even" + number(2) + "ab") == std::nullopt);
        CHECK(headerSize(start + "data" + number(100).substr(0, 3)) == std::nullopt);
        // A chunk that is longer than the whole file.
        CHECK(headerSize(start + "long" + number(5000) + "data" + number(4) + "abcd") == std::nullopt);
    }
    CHECK(headerSize("RIFF" + littleEndian(0, 4) + "WAV") == std::nullopt); // 11 bytes
    CHECK(headerSize("RIFG" + littleEndian(0, 4) + "WAVEdata" + littleEndian(4, 4) + "abcd") == std::nullopt);
    CHECK(headerSize("") == std::nullopt);
}

TEST_CASE("A size of exactly the file's length is still followed, one more is not", "[io][audio]")
{
    const std::string start = "RIFF" + littleEndian(0, 4) + "WAVE";
    const std::string rest = "data" + littleEndian(4, 4) + "abcd";
    // The chunk claims as many bytes as the file has: its end lies behind, and there is nothing.
    CHECK(headerSize(start + "long" + littleEndian(start.size() + 8 + rest.size(), 4) + rest) == std::nullopt);
    // Ten thousand chunks are gone through, no more.
    std::string chunks;
    for (int i = 0; i < 9999; ++i)
        chunks += riffChunk("void", "");
    CHECK(headerSize(start + chunks + rest) == promisedSize(4, 4));
    CHECK(headerSize(start + chunks + riffChunk("void", "") + rest) == std::nullopt);
}

TEST_CASE("A long WAV keeps its size in a chunk of its own", "[io][audio]")
{
    const std::string start = "RF64" + littleEndian(0xFFFFFFFF, 4) + "WAVE";
    const auto sizes = [](std::uint64_t data)
    {
        return riffChunk("ds64", littleEndian(1, 8) + littleEndian(data, 8) + littleEndian(77, 8) + littleEndian(0, 4));
    };
    const auto data = [](std::uint64_t size)
    {
        return "data" + littleEndian(size, 4) + headerSamples;
    };
    CHECK(headerSize(start + sizes(90) + data(0xFFFFFFFF)) == promisedSize(90, 90));
    CHECK(headerSize(start + sizes(0x123456789A) + data(0xFFFFFFFF)) == promisedSize(0x123456789A, 100));
    CHECK(headerSize(start + sizes(0xFFFFFFFFFFFFFFFF) + data(0xFFFFFFFF)) == std::nullopt);
    CHECK(headerSize("BW64" + start.substr(4) + sizes(90) + data(0xFFFFFFFF)) == promisedSize(90, 90));
    CHECK(headerSize(start + sizes(90) + data(50)) == promisedSize(50, 50));
    CHECK(headerSize(start + data(0xFFFFFFFF)) == std::nullopt);
    CHECK(headerSize(start + sizes(90) + data(0x7FFFFFFF)) == std::nullopt);
    // Only an RF64 has it.
    CHECK(headerSize("RIFF" + start.substr(4) + sizes(90) + data(0xFFFFFFFF)) == std::nullopt);
}

TEST_CASE("The audio bytes of AIFF, CAF, W64 and AU are found behind their own headers", "[io][audio]")
{
    const std::string aiff = "FORM" + bigEndian(0, 4) + "AIFF";
    const auto soundChunk = [](std::uint64_t size)
    {
        return "SSND" + bigEndian(size, 4) + std::string(8, '\0') + headerSamples;
    };
    CHECK(headerSize(aiff + aiffChunk("COMM", "abcde") + soundChunk(108)) == promisedSize(100, 100));
    CHECK(headerSize(aiff + aiffChunk("COMM", "abcd") + soundChunk(308)) == promisedSize(300, 100));
    CHECK(headerSize(aiff + soundChunk(5)) == promisedSize(0, 0));
    CHECK(headerSize(aiff + soundChunk(0x7FFFFFFF)) == std::nullopt);

    const std::string caf = std::string("caff") + bigEndian(1, 2) + bigEndian(0, 2);
    const auto cafChunk = [](const std::string& id, std::uint64_t size, const std::string& content)
    {
        return id + bigEndian(size, 8) + content;
    };
    CHECK(headerSize(caf + cafChunk("desc", 3, "abc") + cafChunk("data", 104, "edit" + headerSamples)) ==
          promisedSize(100, 100));
    CHECK(headerSize(caf + cafChunk("data", 304, "edit" + headerSamples)) == promisedSize(300, 100));
    CHECK(headerSize(caf + cafChunk("data", 0xFFFFFFFFFFFFFFFF, "edit" + headerSamples)) == std::nullopt);
    CHECK(headerSize(caf + cafChunk("data", 0x7FFFFFFFFFFFFFFF, "edit" + headerSamples)) == std::nullopt);
    CHECK(headerSize(caf + cafChunk("data", 0xFFFFFFFF, "edit" + headerSamples)) == promisedSize(0xFFFFFFFB, 100));
    CHECK(headerSize(caf + cafChunk("data", 0x7FFFFFFF, "edit" + headerSamples)) == promisedSize(0x7FFFFFFB, 100));

    const std::string wave = "riff" + std::string(36, '\x22');
    CHECK(headerSize(wave + waveChunk("fmt ", 24 + 20, std::string(20, 'f')) + waveChunk("data", 124, headerSamples)) ==
          promisedSize(100, 100));
    CHECK(headerSize(wave + waveChunk("data", 324, headerSamples.substr(0, 96))) == promisedSize(300, 96));
    // A size below that of its own header still leads on.
    CHECK(headerSize(wave + waveChunk("fmt ", 3, "") + waveChunk("data", 24 + 8, "abcdefgh")) == promisedSize(8, 8));
    CHECK(headerSize(wave + waveChunk("data", 23, "abcdefgh")) == promisedSize(0, 0));
    CHECK(headerSize(wave + waveChunk("data", 0xFFFFFFFFFFFFFFFF, headerSamples)) == std::nullopt);

    const auto au = [](std::uint64_t header, std::uint64_t size)
    {
        return ".snd" + bigEndian(header, 4) + bigEndian(size, 4) + std::string(12, '\0') + headerSamples;
    };
    CHECK(headerSize(au(24, 100)) == promisedSize(100, 100));
    CHECK(headerSize(au(24, 99)) == promisedSize(99, 99));
    CHECK(headerSize(au(28, 100)) == promisedSize(100, 96));
    CHECK(headerSize(au(5000, 100)) == promisedSize(100, 0));
    CHECK(headerSize(au(24, 0x7FFFFFFF)) == std::nullopt);
    CHECK(headerSize(au(24, 0xFFFFFFFF)) == std::nullopt);
    for (const char* other : {"fLaC", "OggS", "ID3\x03"})
        CHECK(headerSize(other + std::string(200, '\0')) == std::nullopt);
}
