#include "io/AudioBytes.h"
#include "io/AudioReader.h"
#include "io/FileHandle.h"
#include "io/MatroskaParts.h"
#include "io/Mp4Tables.h"
#include "io/TagBytes.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/Skip.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A sound whose number of frames is known, and where its file may be changed without becoming another sound.
struct KnownSound
{
    std::string name;
    std::string bytes;
    std::uint64_t frames = 0;
    std::size_t header = 0;                     ///< bytes that may be changed
    std::pair<std::size_t, std::size_t> format; ///< of these, the first and the last but one that say how samples look
    std::size_t size = 0;                       ///< where the size of the audio is; 0: nowhere
    int sizeBytes = 4;
    bool bigEndian = false;
    std::uint64_t slack = 1; ///< frames that may be left out: less than a frame behind the stated end is padding
    std::vector<std::size_t> places = {};         ///< bytes that may be changed besides: further headers
    std::string (*finish)(std::string) = nullptr; ///< makes sums right that a program would have written with the rest
    bool isFilm = false;                          ///< the edges of bytes are tried oftener
    int rate = 0;                                 ///< Hz, of films
};

constexpr int rate = 8000;
constexpr std::size_t knownFrames = 4000;

/// Never the same twice and never zero, so that no part of it passes for chunks or padding.
std::string tone(bool big)
{
    std::string data;
    for (std::size_t i = 0; i < knownFrames; ++i)
    {
        const auto value =
            static_cast<std::int16_t>(std::lround(12000.0 * std::sin(0.05 * static_cast<double>(i)))) | 1;
        const auto bits = static_cast<std::uint16_t>(value);
        data += big ? bigEndian(bits, 2) : littleEndian(bits, 2);
    }
    return data;
}

KnownSound waveFile(const std::string& id)
{
    const auto data = tone(false);
    const bool isLong = id != "RIFF";
    const std::string sizes = isLong
                                  ? "ds64" + littleEndian(28, 4) + littleEndian(0, 8) + littleEndian(data.size(), 8) +
                                        littleEndian(data.size() / 2, 8) + littleEndian(0, 4)
                                  : "";
    auto bytes = wavBytes({.sampleRate = rate, .dataBytes = isLong ? std::optional(0xFFFFFFFFu) : std::nullopt}, data);
    bytes.replace(0, 4, id);
    bytes.insert(12, sizes);
    const auto shift = sizes.size();
    return {id, bytes, knownFrames, 44 + shift, {20 + shift, 36 + shift}, isLong ? 28u : 40u, isLong ? 8 : 4};
}

KnownSound aiff()
{
    const auto data = tone(true);
    const std::string head = "AIFFCOMM" + bigEndian(18, 4) + bigEndian(1, 2) + bigEndian(knownFrames, 4) +
                             bigEndian(16, 2) + bigEndian(16383 + 12, 2) + bigEndian(std::uint64_t{rate} << 51u, 8) +
                             "SSND" + bigEndian(data.size() + 8, 4) + std::string(8, '\0');
    return {"AIFF", "FORM" + bigEndian(head.size() + data.size(), 4) + head + data, knownFrames, 54, {20, 38}, 42, 4,
            true};
}

KnownSound caf()
{
    const auto data = tone(true);
    const std::string head = "caff" + bigEndian(1, 2) + bigEndian(0, 2) + "desc" + bigEndian(32, 8) +
                             bigEndian(0x40BF400000000000u, 8) + "lpcm" + bigEndian(0, 4) + bigEndian(2, 4) +
                             bigEndian(1, 4) + bigEndian(1, 4) + bigEndian(16, 4) + "data" +
                             bigEndian(data.size() + 4, 8) + bigEndian(0, 4);
    return {"CAF", head + data, knownFrames, head.size(), {20, 52}, 56, 8, true};
}

KnownSound au()
{
    const auto data = tone(true);
    return {"AU",
            ".snd" + bigEndian(24, 4) + bigEndian(data.size(), 4) + bigEndian(3, 4) + bigEndian(rate, 4) +
                bigEndian(1, 4) + data,
            knownFrames,
            24,
            {12, 24},
            8,
            4,
            true};
}

KnownSound wave64()
{
    const auto data = tone(false);
    const std::string guid("\xF3\xAC\xD3\x11\x8C\xD1\x00\xC0\x4F\x8E\xDB\x8A", 12);
    const std::string body = "wave" + guid + "fmt " + guid + littleEndian(40, 8) + littleEndian(1, 2) +
                             littleEndian(1, 2) + littleEndian(rate, 4) + littleEndian(2 * rate, 4) +
                             littleEndian(2, 2) + littleEndian(16, 2) + "data" + guid +
                             littleEndian(data.size() + 24, 8) + data;
    const std::string first("riff\x2E\x91\xCF\x11\xA5\xD6\x28\xDB\x04\xC1\x00\x00", 16);
    return {"W64", first + littleEndian(body.size() + 24, 8) + body, knownFrames, 104, {64, 80}, 96, 8};
}

/// A file of the fixtures, which is read whole as it is.
KnownSound fixture(const std::string& name, std::uint64_t slack)
{
    const auto path = testFolder() / "io/audio" / name;
    KnownSound sound{name, bytesOf(path), 0, 0, {0, 0}, 0, 0, false, slack};
    const auto whole = readAudio(path);
    REQUIRE(whole.ok());
    CHECK(whole->warnings.empty());
    sound.frames = whole->samples.size() / static_cast<std::size_t>(whole->channels);
    sound.header = std::min<std::size_t>(sound.bytes.size(), 200);
    return sound;
}

/// Where the pages of an Ogg file begin.
std::vector<std::size_t> pagesIn(const std::string& bytes)
{
    std::vector<std::size_t> begins;
    for (auto at = bytes.find("OggS"); at != std::string::npos; at = bytes.find("OggS", at + 4))
        begins.push_back(at);
    return begins;
}

std::string withChecksums(std::string bytes)
{
    const auto begins = pagesIn(bytes);
    for (std::size_t i = 0; i < begins.size(); ++i)
    {
        const auto length = (i + 1 < begins.size() ? begins[i + 1] : bytes.size()) - begins[i];
        if (length >= 27)
            bytes.replace(begins[i], length, withOggChecksum(bytes.substr(begins[i], length)));
    }
    return bytes;
}

/// An Ogg file with the headers of all its pages, which are damaged, or have been written so.
KnownSound ogg(const std::string& name, std::pair<std::size_t, std::size_t> format, std::uint64_t packet,
               bool isWrittenSo)
{
    auto sound = fixture(name, 0);
    for (const auto begin : pagesIn(sound.bytes))
        for (std::size_t i = 0; i < 27u + static_cast<unsigned char>(sound.bytes[begin + 26]); ++i)
            if (begin + i >= sound.header)
                sound.places.push_back(begin + i);
    if (isWrittenSo)
    {
        sound.name += " written so";
        sound.slack = packet; // which encoders fill up
        sound.format = format;
        sound.finish = withChecksums;
    }
    return sound;
}

/// An MP3 with the headers of all its frames.
KnownSound mp3()
{
    auto sound = fixture("tone.mp3", 2304);
    const auto sync = sound.bytes.substr(0, 2);
    for (auto at = sound.bytes.find(sync, sound.header); at != std::string::npos; at = sound.bytes.find(sync, at + 1))
        for (std::size_t i = 0; i < 4 && at + i < sound.bytes.size(); ++i)
            sound.places.push_back(at + i);
    return sound;
}

std::vector<KnownSound> knownSounds()
{
    // Of a FLAC, what says how samples look is from the smallest block to the number of bits.
    auto flac = fixture("ramp.flac", 0);
    flac.header = 42;
    flac.format = {8, 21};
    // Of a Vorbis, its channels, rates and blocks; of an Opus, its channels, and behind the frames that are left out
    // its rate, loudness and mapping.
    constexpr std::pair<std::size_t, std::size_t> vorbisFormat{39, 57}, opusFormat{37, 47};
    return {waveFile("RIFF"),
            waveFile("RF64"),
            waveFile("BW64"),
            wave64(),
            aiff(),
            caf(),
            au(),
            flac,
            ogg("tone.ogg", vorbisFormat, 1024, false),
            ogg("tone.ogg", vorbisFormat, 1024, true),
            ogg("tone.opus", opusFormat, 480, false),
            ogg("tone.opus", opusFormat, 480, true),
            mp3()};
}

/// Bytes of an MP4 or MOV that are not in its sound.
std::vector<std::size_t> outsideOfMp4Sound(const std::string& bytes)
{
    std::vector<std::size_t> places;
    for (std::size_t begin = 0; begin + 8 <= bytes.size();)
    {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8u | static_cast<unsigned char>(bytes[begin + i]);
        const bool isSound = bytes.substr(begin + 4, 4) == "mdat";
        for (std::size_t i = 0; i < (isSound ? 8 : length); ++i)
            places.push_back(begin + i);
        begin += std::max<std::size_t>(length, 8);
    }
    return places;
}

/// Adds bytes of a Matroska file from `begin` to `end` that are not in its sound. Elements are an id and a size, whose
/// first bits say how long they are; all bits of a size set leave it open (RFC 8794).
void addOutsideOfBlocks(const std::string& bytes, std::size_t begin, std::size_t end, std::vector<std::size_t>& places)
{
    const auto number = [&](std::size_t at, bool hasMark, std::size_t& width)
    {
        const auto first = static_cast<unsigned char>(bytes.at(at));
        width = 1;
        while (width < 8 && (first >> (8 - width) & 1u) == 0)
            ++width;
        std::uint64_t value = hasMark ? first : first & (0xFFu >> width);
        for (std::size_t i = 1; i < width; ++i)
            value = value << 8u | static_cast<unsigned char>(bytes.at(at + i));
        return value;
    };
    while (begin < end)
    {
        std::size_t idBytes = 0, sizeBytes = 0;
        const auto id = number(begin, true, idBytes);
        const auto size = number(begin + idBytes, false, sizeBytes);
        const auto content = begin + idBytes + sizeBytes;
        const bool isOpen = size == (std::uint64_t{1} << 7u * sizeBytes) - 1;
        const auto last = isOpen ? end : std::min<std::size_t>(end, content + static_cast<std::size_t>(size));
        constexpr std::uint64_t segment = 0x18538067, cluster = 0x1F43B675, group = 0xA0, block = 0xA1, single = 0xA3;
        const bool isOuter = id == segment || id == cluster || id == group;
        const auto told = isOuter ? content : id == block || id == single ? content + 4 : last;
        for (auto at = begin; at < told; ++at)
            places.push_back(at);
        if (isOuter)
            addOutsideOfBlocks(bytes, content, last, places);
        // A cluster of an open size ends where the next begins; they lie in one another here.
        begin = last;
    }
}

/// A sound that ffmpeg decodes, with all that is no sound in it; codecs are primed and filled up.
KnownSound film(const std::string& name)
{
    const auto path = testFolder() / "io/films" / name;
    KnownSound sound{name, bytesOf(path), 0, 0, {0, 0}};
    const auto whole = readAudio(path);
    REQUIRE(whole.ok());
    CHECK(whole->warnings.empty());
    sound.frames = whole->samples.size();
    sound.slack = static_cast<std::uint64_t>(whole->sampleRate) * 17 / 100;
    sound.isFilm = true;
    sound.rate = whole->sampleRate;
    if (sound.bytes.starts_with("\x1A\x45\xDF\xA3"))
        addOutsideOfBlocks(sound.bytes, 0, sound.bytes.size(), sound.places);
    else
        sound.places = outsideOfMp4Sound(sound.bytes);
    return sound;
}

/// Whether all of a film's sound came and is to be heard, or something was said.
void checkNoFilmIsLostInSilence(const KnownSound& sound, const std::filesystem::path& path)
{
    // What contradicts itself in the tables is told whatever the programs find, which take long to start.
    const FileHandle file(std::fopen(path.string().c_str(), "rb"));
    const auto tracks = mp4Tracks(file.get());
    if (std::any_of(tracks.begin(), tracks.end(), [](const Mp4Track& track) { return !track.doubts.empty(); }))
        return;
    const auto audio = readAudio(path, {}, 10'000'000);
    if (!audio.ok() || !audio->warnings.empty())
        return;
    const auto channels = static_cast<std::size_t>(audio->channels);
    const auto frames = audio->samples.size() / channels;
    const auto at = [](std::uint64_t count, int perSecond)
    {
        return static_cast<double>(count) / perSecond;
    };
    const double least = at(sound.frames - sound.slack, sound.rate);
    // Another rate is no loss where all samples are there, and none where all of the time is.
    CHECK((frames + sound.slack >= sound.frames || at(frames, audio->sampleRate) >= least));
    // Pieces of the sound, which is equally loud throughout, that are no silence.
    constexpr std::size_t pieces = 100;
    std::size_t loud = 0;
    for (std::size_t piece = 0; piece < pieces; ++piece)
    {
        const auto from = frames * piece / pieces * channels, until = frames * (piece + 1) / pieces * channels;
        double most = 0.0;
        for (auto i = from; i < until; ++i)
            most = std::max(most, std::abs(static_cast<double>(audio->samples[i])));
        loud += most > 0.05 ? 1u : 0u;
    }
    CHECK(loud * 100 >= pieces * 83);
}

/// Whether all of the sound came, or something was said.
void checkNothingIsLostInSilence(const KnownSound& sound, const std::filesystem::path& path)
{
    const auto audio = readAudio(path, {}, 1'000'000);
    if (!audio.ok() || !audio->warnings.empty())
        return;
    CHECK(audio->samples.size() / static_cast<std::size_t>(audio->channels) + sound.slack >= sound.frames);
}

/// A number of the environment.
int wanted(const char* name, int usual)
{
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : usual;
}

/// Checks rounds of random damage, PACINI_MUTATIONS of them or as many as `usual`.
template <typename Check>
void damage(const KnownSound& sound, int usual, Check check)
{
    const TempFolder folder;
    Random random(static_cast<std::uint64_t>(wanted("PACINI_MUTATION_SEED", 20261128)));
    const int rounds = wanted("PACINI_MUTATIONS", usual);
    for (int round = 0; round < rounds; ++round)
    {
        auto bytes = sound.bytes;
        std::string changed;
        for (int i = 0; i <= round % 4; ++i)
        {
            auto place = random.next() % (sound.header + sound.places.size());
            if (place >= sound.header)
                place = sound.places[place - sound.header];
            if (place >= sound.format.first && place < sound.format.second)
                continue;
            constexpr unsigned char edges[] = {0, 1, 127, 128, 255};
            const auto kind = sound.isFilm ? random.next() % 6 : 5;
            bytes[place] = static_cast<char>(kind < 5 ? edges[kind] : random.next());
            changed += fmt::format("{} = {} ", place, static_cast<unsigned char>(bytes[place]));
        }
        CAPTURE(sound.name, round, changed);
        check(sound, put(folder / "damaged", sound.finish ? sound.finish(std::move(bytes)) : bytes));
    }
}
} // namespace

TEST_CASE("No size that a header may state loses sound in silence", "[io][audio]")
{
    const TempFolder folder;
    for (const KnownSound& sound : knownSounds())
    {
        if (sound.size == 0)
            continue;
        CAPTURE(sound.name);
        const auto whole = readAudio(put(folder / "whole", sound.bytes));
        REQUIRE(whole.ok());
        CHECK(whole->warnings.empty());
        REQUIRE(whole->samples.size() == sound.frames);
        const std::uint64_t right = 2 * knownFrames;
        for (const std::uint64_t stated :
             {std::uint64_t{0}, std::uint64_t{8}, std::uint64_t{1}, right / 2, right - 2, right - 44, right + 1,
              right + 44, 2 * right, std::uint64_t{0x80000000}, std::uint64_t{2'000'000'000}, std::uint64_t{0x7FFFFF00},
              std::uint64_t{0xFFFFFFFF}, ~std::uint64_t{0}})
        {
            CAPTURE(stated);
            auto bytes = sound.bytes;
            const auto field =
                sound.bigEndian ? bigEndian(stated, sound.sizeBytes) : littleEndian(stated, sound.sizeBytes);
            bytes.replace(sound.size, field.size(), field);
            const auto audio = readAudio(put(folder / "x", bytes));
            if (!audio.ok() && sound.sizeBytes == 8 && stated >= 2'000'000'000 && stated <= 0xFFFFFFFFu)
            {
                // What 32 bits leave open is a size where there are 64.
                CHECK(audio.error().code == ErrorCode::truncated);
                continue;
            }
            REQUIRE(audio.ok());
            CHECK(audio->samples == whole->samples);
            if (stated < right - 24) // less than any of the formats counts besides
                CHECK(audio->warnings.size() == 1);
        }
    }
}

TEST_CASE("Damaged headers of every kind lose no sound in silence", "[io][audio]")
{
    for (const KnownSound& sound : knownSounds())
        DYNAMIC_SECTION(sound.name) // -c NAME runs one kind alone
    damage(sound, 300, checkNothingIsLostInSilence);
}

TEST_CASE("Damaged headers of every kind of film lose no sound in silence", "[io][audio][slow]")
{
    if (const auto found = readAudio(testFolder() / "io/films/tone.m4a"); !found.ok())
    {
        REQUIRE(found.error().message.find("is not installed") != std::string::npos);
        return skip("ffmpeg is not installed");
    }
    for (const char* name : {"tone.m4a", "fragments.mp4", "tone.mov", "tone.mka", "recorded.webm"})
        DYNAMIC_SECTION(name)
    damage(film(name), 20, checkNoFilmIsLostInSilence);
}

TEST_CASE("What follows a sound is told from more of it", "[io][audio]")
{
    const TempFolder folder;
    const auto read = [&](const std::string& bytes)
    {
        const auto audio = readAudio(put(folder / "x", bytes));
        REQUIRE(audio.ok());
        return *audio;
    };
    const std::string list = "LIST" + littleEndian(12, 4) + "INFOISFT" + littleEndian(0, 4);
    const std::string id3v1 = "TAG" + std::string(125, 'x');
    const std::string id3v2 = "ID3\x03" + std::string(5, '\0') + "\x40" + std::string(64, 'x');
    const KnownSound wave = waveFile("RIFF");
    for (const std::string& rest : {list, list + list, id3v1, list + id3v1, id3v2, list + id3v2, id3v2 + id3v1})
    {
        const auto audio = read(wave.bytes + rest);
        CHECK(audio.samples.size() == knownFrames);
        CHECK(audio.warnings.empty());
    }
    CHECK(read(id3v2 + wave.bytes).samples.size() == knownFrames);
    CHECK(read(id3v2 + wave.bytes).warnings.empty());
    CHECK(read(wave.bytes + wave.bytes).samples.size() == 2 * knownFrames);
    CHECK(read(wave.bytes + id3v2 + wave.bytes).samples.size() == 2 * knownFrames);
    CHECK(read(wave.bytes + list + wave.bytes).samples.size() == 2 * knownFrames);
    // A size that was left open, and chunks behind the sound.
    auto open = wave.bytes;
    open.replace(40, 4, "\xFF\xFF\xFF\xFF");
    CHECK(read(open + list).samples.size() == knownFrames);
    CHECK(read(wave.bytes + std::string(400, '\0')).warnings ==
          std::vector<std::string>{"has 400 bytes behind its sound that are left out; as sound they would be 0.025 s"});

    for (const char* name : {"ramp.flac", "tone.ogg", "tone.opus", "tone.mp3"})
    {
        CAPTURE(name);
        const KnownSound sound = fixture(name, 0);
        for (const std::string& bytes : {sound.bytes + id3v1, id3v2 + sound.bytes})
        {
            const auto audio = read(bytes);
            CHECK(audio.samples.size() / static_cast<std::size_t>(audio.channels) == sound.frames);
            CHECK(audio.warnings.empty());
        }
        const auto twice = read(sound.bytes + sound.bytes);
        CHECK(twice.samples.size() / static_cast<std::size_t>(twice.channels) == 2 * sound.frames);
    }
    // Ogg numbers its pages: the third of this one has 22656 of 24000 frames.
    const auto ogg = bytesOf(testFolder() / "io/audio/tone.ogg");
    const auto third = ogg.find("OggS", ogg.find("OggS", 4) + 4), fourth = ogg.find("OggS", third + 4);
    const auto lacking = read(ogg.substr(0, third) + ogg.substr(fourth));
    REQUIRE(lacking.warnings.size() == 1);
    CHECK(lacking.warnings.front().starts_with("lacks 1 of its pages, by their times about "));

    auto flac = bytesOf(testFolder() / "io/audio/ramp.flac");
    flac.replace(22, 4, bigEndian(100, 4));
    CHECK(read(flac).samples.size() == 800);
    CHECK(read(flac).warnings == std::vector<std::string>{"has a header that states 0.013 s, but 0.050 s are there and "
                                                          "all of them are read; save it anew"});
}

TEST_CASE("The frames of an MP3 are counted where no header does, or a wrong one", "[io][audio]")
{
    const TempFolder folder;
    const KnownSound sound = fixture("tone.mp3", 0);
    const auto header =
        sound.bytes.find("Xing") != std::string::npos ? sound.bytes.find("Xing") : sound.bytes.find("Info");
    REQUIRE(header != std::string::npos);
    // Its first frame is that header; frames begin with the same two bytes.
    const auto second = sound.bytes.find(sound.bytes.substr(0, 2), header);
    const auto bare = readAudio(put(folder / "bare", sound.bytes.substr(second)));
    REQUIRE(bare.ok());
    CHECK(bare->samples.size() >= sound.frames);
    CHECK(bare->samples.size() % 576 == 0);
    auto few = sound.bytes;
    few.replace(header + 8, 4, bigEndian(3, 4));
    const auto counted = readAudio(put(folder / "few", few));
    REQUIRE(counted.ok());
    CHECK(counted->samples.size() >= sound.frames);
    CHECK(counted->warnings.size() == 1);
    // A hole is passed over, and said.
    auto hole = sound.bytes;
    hole.replace(hole.size() / 2, 700, std::string(700, '\0'));
    const auto rest = readAudio(put(folder / "hole", hole), {.allowTruncated = true});
    REQUIRE(rest.ok());
    CHECK_FALSE(rest->warnings.empty());
}

TEST_CASE("Slow sounds are read at a multiple of their rate, which is said", "[io][audio]")
{
    const TempFolder folder;
    std::vector<int> values;
    for (int i = 0; i < 3000; ++i)
        values.push_back(
            static_cast<int>(std::lround(16384.0 * std::sin(2.0 * std::numbers::pi * 100.0 * i / 1000.0))));
    const auto path = put(folder / "slow", wavBytes({.sampleRate = 1000}, pcm16(values)));
    const auto audio = readAudio(path);
    REQUIRE(audio.ok());
    CHECK(audio->sampleRate == 8000);
    REQUIRE(audio->samples.size() == 24000);
    for (std::size_t i = 4000; i < 20000; ++i)
        REQUIRE(std::abs(static_cast<double>(audio->samples[i]) -
                         0.5 * std::sin(2.0 * std::numbers::pi * 100.0 * static_cast<double>(i) / 8000.0)) < 0.005);
    CHECK(audio->warnings ==
          std::vector<std::string>{"is sampled at 1000 Hz, so all above 500 Hz is missing; it is read at 8000 Hz"});
    const auto asItIs = readAudio(path, {.lowestSampleRate = 1000});
    REQUIRE(asItIs.ok());
    CHECK(asItIs->sampleRate == 1000);
    CHECK(asItIs->samples.size() == 3000);
    CHECK(asItIs->warnings.empty());
}

namespace
{
std::vector<float> readsWithoutWarning(const std::string& bytes)
{
    const TempFolder folder;
    const auto audio = readAudio(put(folder / "x", bytes));
    REQUIRE(audio.ok());
    CHECK(audio->warnings.empty());
    return audio->samples;
}
} // namespace

TEST_CASE("A WAV may have its audio in a list of waves, and in front of its format", "[io][audio]")
{
    const TempFolder folder;
    const auto read = readsWithoutWarning;
    const std::string wave = waveFile("RIFF").bytes, data = wave.substr(44);
    const auto whole = read(wave);
    const auto chunk = [](const std::string& id, const std::string& content)
    {
        return id + littleEndian(content.size(), 4) + content;
    };
    const auto riff = [&](const std::string& chunks)
    {
        return chunk("RIFF", "WAVE" + chunks);
    };
    const std::string format = wave.substr(12, 24), info = chunk("LIST", "INFOISFT" + littleEndian(4, 4) + "abc\1");
    const std::string fact = chunk("fact", littleEndian(knownFrames, 4));
    const std::string one = chunk("data", data.substr(0, 3000)), other = chunk("data", data.substr(3000));
    const std::string quiet = chunk("slnt", littleEndian(500, 4));
    CHECK(read(riff(format + fact + chunk("LIST", "wavl" + one + other))) == whole);
    CHECK(read(riff(format + chunk("LIST", "wavl" + chunk("data", data)) + info)) == whole);
    auto silent = whole;
    silent.insert(silent.begin() + 1500, 500, 0.0f);
    CHECK(read(riff(format + fact + chunk("LIST", "wavl" + one + quiet + other) + info)) == silent);
    auto late = whole;
    late.insert(late.begin(), 1000, 0.0f);
    CHECK(read(riff(format + chunk("LIST", "wavl" + quiet + quiet + one + other))) == late);
    for (const std::string& chunks : {chunk("data", data) + format, info + chunk("data", data) + info + format + info})
        CHECK(read(riff(chunks)) == whole);
    CHECK_FALSE(readAudio(put(folder / "x", riff(chunk("data", data)))).ok());
}

TEST_CASE("MPEG audio in a file of chunks is read as if it lay alone", "[io][audio]")
{
    const TempFolder folder;
    const auto read = [&](const std::string& bytes, bool allowTruncated = false)
    {
        return readAudio(put(folder / "x", bytes), {.allowTruncated = allowTruncated});
    };
    const auto mp3 = bytesOf(testFolder() / "io/audio/tone.mp3");
    const auto alone = read(mp3);
    REQUIRE(alone.ok());
    const std::string head = "WAVEfmt " + littleEndian(30, 4) + littleEndian(0x55, 2) + littleEndian(1, 2) +
                             littleEndian(static_cast<std::uint64_t>(alone->sampleRate), 4) + littleEndian(8000, 4) +
                             littleEndian(1, 2) + littleEndian(0, 2) + littleEndian(12, 2) + std::string(12, '\0') +
                             "fact" + littleEndian(4, 4) + littleEndian(2 * alone->samples.size(), 4) + "data";
    const auto wav = [&](std::uint64_t size, const std::string& behind)
    {
        return "RIFF" + littleEndian(head.size() + 4 + mp3.size() + behind.size(), 4) + head + littleEndian(size, 4) +
               mp3 + behind;
    };
    const std::string cue = "cue " + littleEndian(28, 4) + littleEndian(1, 4) + littleEndian(1, 4) +
                            littleEndian(1000, 4) + "data" + std::string(8, '\0') + littleEndian(1000, 4);
    const std::string padding(mp3.size() % 2, '\0');
    for (const auto& [size, warnings] : {std::pair(mp3.size(), 0u), std::pair(std::size_t{0}, 1u),
                                         std::pair(mp3.size() / 2, 1u), std::pair(std::size_t{0xFFFFFFFF}, 0u)})
    {
        CAPTURE(size);
        const auto audio = read(wav(size, padding + cue));
        REQUIRE(audio.ok());
        CHECK(audio->sampleRate == alone->sampleRate);
        CHECK(audio->samples == alone->samples);
        CHECK(audio->warnings.size() == warnings);
    }
    auto reader = AudioReader::open(put(folder / "x", wav(mp3.size(), padding + cue)));
    REQUIRE(reader.ok());
    REQUIRE(reader->markers().size() == 1);
    CHECK(reader->markers().front().time == 1000.0 / alone->sampleRate);
    const auto whole = wav(mp3.size(), "");
    const auto cut = read(whole.substr(0, whole.size() - mp3.size() / 2));
    REQUIRE_FALSE(cut.ok());
    CHECK(cut.error().code == ErrorCode::truncated);
    const auto rest = read(whole.substr(0, whole.size() - mp3.size() / 2), true);
    REQUIRE(rest.ok());
    CHECK_FALSE(rest->warnings.empty());
}

TEST_CASE("Audio in several chunks of one file is read as one", "[io][audio]")
{
    const TempFolder folder;
    const auto read = readsWithoutWarning;
    // The header in front of the audio is that of the known sound; its size is of the first part alone.
    const std::string listOfWave = "LIST" + littleEndian(4, 4) + "INFO", listOfAiff = "NAME" + bigEndian(2, 4) + "ab";
    const std::string guid("\xF3\xAC\xD3\x11\x8C\xD1\x00\xC0\x4F\x8E\xDB\x8A", 12);
    struct Kind
    {
        KnownSound sound;
        std::size_t start;    // of the audio
        std::uint64_t counts; // what a size counts besides
        std::string id;
        std::string list;
    };
    const std::size_t first = 2000, second = 3000; // bytes
    for (const Kind& kind : {Kind{waveFile("RIFF"), 44, 0, "data", listOfWave},
                             Kind{waveFile("RF64"), 80, 0, "data", listOfWave}, Kind{aiff(), 54, 8, "SSND", listOfAiff},
                             Kind{caf(), 68, 4, "data", ""}, Kind{wave64(), 104, 24, "data" + guid, ""}})
    {
        CAPTURE(kind.sound.name);
        const auto& bytes = kind.sound.bytes;
        const auto whole = read(bytes);
        const bool isLong = kind.sound.name == "RF64";
        const auto sized = [&](std::size_t count, int width)
        {
            return kind.sound.bigEndian ? bigEndian(count + kind.counts, width)
                                        : littleEndian(count + kind.counts, width);
        };
        const int width = isLong ? 4 : kind.sound.sizeBytes;
        const auto chunk = [&](std::size_t from, std::size_t count)
        {
            const auto inside = kind.sound.name == "AIFF" ? 8u : kind.sound.name == "CAF" ? 4u : 0u;
            return kind.id + sized(count, width) + std::string(inside, '\0') + bytes.substr(kind.start + from, count);
        };
        const auto audio = bytes.find(kind.id, 12 + (isLong ? 36 : 0));
        const auto header = bytes.substr(0, audio);
        const auto rest = bytes.size() - kind.start - first - second;
        const auto whenSplit = [&](const std::string& between)
        {
            return header + chunk(0, first) + between + chunk(first, second) + chunk(first + second, rest);
        };
        CHECK(read(whenSplit(kind.list)) == whole);
        CHECK(read(whenSplit("")) == whole);
        CHECK(read(header + chunk(0, 0) + kind.list + chunk(0, first + second + rest)) == whole);
    }
    // The second part may be what is cut off.
    const auto wave = waveFile("RIFF").bytes;
    const auto cut = wave.substr(0, 40) + littleEndian(2000, 4) + wave.substr(44, 2000) + "data" +
                     littleEndian(50'000, 4) + wave.substr(2044, 3000);
    const auto refused = readAudio(put(folder / "x", cut));
    const auto taken = readAudio(put(folder / "x", cut), {.allowTruncated = true});
    REQUIRE(refused.ok());
    CHECK(refused->samples.size() == 1000);
    REQUIRE(refused->warnings.size() == 1);
    CHECK(refused->warnings.front().starts_with(
        "has another sound behind 0.125 s, which is left out: it is truncated: "));
    REQUIRE(taken.ok());
    CHECK(taken->samples.size() == 2500);
    CHECK(taken->warnings.size() == 1);
    // Markers behind the last part count from the start of the first.
    const std::string cue = "cue " + littleEndian(28, 4) + littleEndian(1, 4) + littleEndian(1, 4) +
                            littleEndian(3000, 4) + "data" + std::string(8, '\0') + littleEndian(3000, 4);
    const auto split = wave.substr(0, 40) + littleEndian(2000, 4) + wave.substr(44, 2000) + "data" +
                       littleEndian(6000, 4) + wave.substr(2044) + cue;
    auto reader = AudioReader::open(put(folder / "x", split));
    REQUIRE(reader.ok());
    REQUIRE(reader->markers().size() == 1);
    CHECK(reader->markers().front().time == 3000.0 / rate);
    // Two chunks of format, of which libsndfile wants one.
    CHECK(read(wave.substr(0, 36) + wave.substr(12, 24) + wave.substr(36)) == read(wave));
}

TEST_CASE("An AIFF places its first frame where it says, unless its number of frames contradicts", "[io][audio]")
{
    const TempFolder folder;
    const KnownSound sound = aiff();
    const auto whole = readAudio(put(folder / "whole", sound.bytes));
    REQUIRE(whole.ok());
    const auto read = [&](std::size_t stated, std::size_t filled, char filling)
    {
        auto bytes = sound.bytes;
        bytes.replace(sound.size, 4, bigEndian(8 + filled + 2 * knownFrames, 4));
        bytes.replace(sound.size + 4, 4, bigEndian(stated, 4));
        bytes.insert(sound.size + 12, std::string(filled, filling));
        const auto audio = readAudio(put(folder / "x", bytes));
        REQUIRE(audio.ok());
        CHECK(audio->warnings.empty());
        return audio->samples;
    };
    for (const std::size_t offset : {2u, 8u, 512u, 4096u, 5000u, 70000u})
    {
        CAPTURE(offset);
        CHECK(read(offset, offset, '\0') == whole->samples);
        CHECK(read(offset, offset, 'U') == whole->samples);
        CHECK(read(offset, 0, '\0') == whole->samples);
    }
    CHECK(read(0xFFFFFFF0u, 0, '\0') == whole->samples);
}

TEST_CASE("An AU whose bytes are the other way round is read as a whole, too", "[io][audio]")
{
    const TempFolder folder;
    const auto data = tone(false);
    const auto file = [&](std::uint64_t stated)
    {
        return "dns." + littleEndian(24, 4) + littleEndian(stated, 4) + littleEndian(3, 4) + littleEndian(rate, 4) +
               littleEndian(1, 4) + data;
    };
    for (const auto& [stated, warnings] :
         {std::pair(std::uint64_t{2 * knownFrames}, 0u), std::pair(std::uint64_t{0xFFFFFFFF}, 0u),
          std::pair(std::uint64_t{0}, 1u), std::pair(std::uint64_t{1000}, 1u)})
    {
        CAPTURE(stated);
        const auto audio = readAudio(put(folder / "x", file(stated)));
        REQUIRE(audio.ok());
        CHECK(audio->samples.size() == knownFrames);
        CHECK(audio->warnings.size() == warnings);
    }
    CHECK(readAudio(put(folder / "x", file(50'000))).error().code == ErrorCode::truncated);
}

TEST_CASE("Chunks behind the audio of a W64 are not read as sound", "[io][audio]")
{
    const TempFolder folder;
    const std::string guid("\xF3\xAC\xD3\x11\x8C\xD1\x00\xC0\x4F\x8E\xDB\x8A", 12);
    const auto audio =
        readAudio(put(folder / "x", wave64().bytes + "list" + guid + littleEndian(32, 8) + std::string(8, 'x')));
    REQUIRE(audio.ok());
    CHECK(audio->samples.size() == knownFrames);
    CHECK(audio->warnings.empty());
}

TEST_CASE("A CAF whose version and sizes are damaged does not end early in silence", "[io][audio]")
{
    const TempFolder folder;
    auto sound = caf();
    sound.bytes[4] = 40;
    sound.bytes[15] = 100;
    sound.bytes[63] = 102;
    const auto audio = readAudio(put(folder / "x", sound.bytes));
    CHECK((!audio.ok() || audio->samples.size() >= knownFrames || !audio->warnings.empty()));
}

TEST_CASE("Frames in the place of the padding of a W64 are sound", "[io][audio]")
{
    const TempFolder folder;
    for (const std::uint64_t lacking : {1u, 2u, 3u, 4u, 6u, 7u})
    {
        CAPTURE(lacking);
        auto sound = wave64();
        sound.bytes.replace(sound.size, 8, littleEndian(2 * knownFrames + 24 - lacking, 8));
        const auto audio = readAudio(put(folder / "x", sound.bytes));
        REQUIRE(audio.ok());
        CHECK(audio->samples.size() + (lacking < 2 ? 1u : 0u) >= knownFrames);
        CHECK(audio->warnings.size() == (lacking < 2 ? 0u : 1u));
    }
}

TEST_CASE("Sounds that run side by side in an Ogg, and a missing mark of its end, are told", "[io][audio]")
{
    const TempFolder folder;
    const auto pagesOf = [](const std::string& name)
    {
        const auto bytes = bytesOf(testFolder() / "io/audio" / name);
        std::vector<std::string> pages;
        for (std::size_t begin = 0; begin < bytes.size();)
        {
            auto next = bytes.find("OggS", begin + 4);
            next = next == std::string::npos ? bytes.size() : next;
            pages.push_back(bytes.substr(begin, next - begin));
            begin = next;
        }
        return pages;
    };
    const auto vorbis = pagesOf("tone.ogg"), opus = pagesOf("tone.opus");
    const auto joined = [](const std::vector<std::string>& pages, std::size_t from, std::size_t to)
    {
        std::string bytes;
        for (std::size_t i = from; i < to; ++i)
            bytes += pages[i];
        return bytes;
    };
    const auto alone = readAudio(put(folder / "x", joined(vorbis, 0, vorbis.size())));
    REQUIRE(alone.ok());
    const auto beside = readAudio(
        put(folder / "x", vorbis[0] + opus[0] + joined(vorbis, 1, vorbis.size()) + joined(opus, 1, opus.size())));
    REQUIRE(beside.ok());
    CHECK(beside->samples == alone->samples);
    CHECK(beside->warnings == std::vector<std::string>{"has another sound at the same time, which is left out; save it "
                                                       "as a file of its own"});
    const auto unended = readAudio(put(folder / "x", joined(vorbis, 0, vorbis.size() - 1)));
    REQUIRE(unended.ok());
    REQUIRE(unended->samples.size() < alone->samples.size());
    REQUIRE(unended->warnings.size() == 1);
    CHECK(unended->warnings.front().starts_with("lacks the mark of its end behind "));
}

TEST_CASE("Zeros around an MP3 are passed over, and a header in front of another is none", "[io][audio]")
{
    const TempFolder folder;
    const auto mp3 = bytesOf(testFolder() / "io/audio/tone.mp3");
    const auto alone = readAudio(put(folder / "x", mp3));
    REQUIRE(alone.ok());
    const auto header = std::min(mp3.find("Xing"), mp3.find("Info"));
    const auto begin = mp3.rfind('\xFF', header), second = mp3.find(mp3.substr(begin, 2), header);
    const auto twice =
        readAudio(put(folder / "x", mp3.substr(0, begin) + mp3.substr(begin, second - begin) + mp3.substr(begin)));
    REQUIRE(twice.ok());
    CHECK(twice->samples == alone->samples);
    CHECK(twice->warnings.empty());
    for (const std::size_t zeros : {5000u, 100'000u})
    {
        CAPTURE(zeros);
        const auto behind = readAudio(put(folder / "x", mp3 + std::string(zeros, '\0')));
        REQUIRE(behind.ok());
        CHECK(behind->samples == alone->samples);
        REQUIRE(behind->warnings.size() == 1);
        CHECK(behind->warnings.front().find("bytes behind its sound that are left out") != std::string::npos);
        const auto before = readAudio(put(folder / "x", std::string(zeros, '\0') + mp3.substr(begin)));
        REQUIRE(before.ok());
        CHECK(before->samples == alone->samples);
        CHECK(before->warnings.size() == 1);
    }
}

TEST_CASE("A FLAC is read whatever its blocks of metadata hold", "[io][audio]")
{
    const TempFolder folder;
    const auto flac = bytesOf(testFolder() / "io/audio/ramp.flac");
    const auto alone = readAudio(put(folder / "x", flac));
    REQUIRE(alone.ok());
    const auto first = std::size_t{4 + 4 + 34}; // behind the first block
    for (const char type : {'\x03', '\x04', '\x05', '\x06', '\x55'})
    {
        CAPTURE(int(type));
        auto bytes = flac;
        bytes.insert(first, type + bigEndian(30, 3) + std::string(30, '\x7F'));
        bytes[4] = static_cast<char>(bytes[4] & 0x7F);
        if ((flac[4] & 0x80) != 0)
            bytes[first] = static_cast<char>(bytes[first] | 0x80);
        const auto audio = readAudio(put(folder / "x", bytes));
        REQUIRE(audio.ok());
        CHECK(audio->samples == alone->samples);
    }
}

TEST_CASE("A warning of two lengths that differ little has the digits that tell them apart", "[io][audio]")
{
    const TempFolder folder;
    auto bytes = waveFile("RIFF").bytes;
    bytes.replace(40, 4, littleEndian(2 * knownFrames + 4, 4));
    const auto audio = readAudio(put(folder / "x", bytes));
    REQUIRE(audio.ok());
    CHECK(audio->warnings ==
          std::vector<std::string>{"has a header that states 0.500250 s, but 0.500000 s are there and "
                                   "all of them are read; save it anew"});
}

TEST_CASE("A few bytes behind a sound that make no frame are left out with a word", "[io][audio]")
{
    const TempFolder folder;
    for (const KnownSound& sound : {waveFile("RIFF"), waveFile("RF64"), aiff(), caf(), au()})
    {
        CAPTURE(sound.name);
        const auto audio = readAudio(put(folder / "x", sound.bytes + "\7\6\5"));
        REQUIRE(audio.ok());
        CHECK(audio->samples.size() == knownFrames);
        REQUIRE(audio->warnings.size() == 1);
        CHECK(audio->warnings.front().starts_with("has 3 bytes behind its sound that are left out"));
    }
}

TEST_CASE("The codec of an AIFC says how long its samples are, whatever number stands beside it", "[io][audio]")
{
    const TempFolder folder;
    const auto aifc = [](const std::string& codec, int stated, const std::string& data)
    {
        const std::string head = "AIFCFVER" + bigEndian(4, 4) + bigEndian(0xA2805140u, 4) + "COMM" + bigEndian(24, 4) +
                                 bigEndian(1, 2) + bigEndian(3, 4) + bigEndian(static_cast<std::uint64_t>(stated), 2) +
                                 bigEndian(16383 + 12, 2) + bigEndian(std::uint64_t{rate} << 51u, 8) + codec +
                                 std::string(2, '\0') + "SSND" + bigEndian(data.size() + 8, 4) + std::string(8, '\0');
        return "FORM" + bigEndian(head.size() + data.size(), 4) + head + data;
    };
    const auto bits24 = std::string("\x20\0\0\xE0\0\0\x10\0\0", 9);
    const auto bits32 = std::string("\x20\0\0\0\xE0\0\0\0\x10\0\0\0", 12);
    const auto floats = std::string("\x3E\x80\0\0\xBE\x80\0\0\x3E\0\0\0", 12);
    const auto doubles = std::string("\x3F\xD0\0\0\0\0\0\0\xBF\xD0\0\0\0\0\0\0\x3F\xC0\0\0\0\0\0\0", 24);
    for (const auto& [codec, data] : {std::pair("in24", bits24), std::pair("in32", bits32), std::pair("fl32", floats),
                                      std::pair("FL32", floats), std::pair("fl64", doubles)})
        for (const int stated : {8, 16, 24, 32, 64})
        {
            CAPTURE(codec, stated);
            const auto audio = readAudio(put(folder / "x", aifc(codec, stated, data)));
            REQUIRE(audio.ok());
            CHECK(audio->samples == std::vector<float>{0.25f, -0.25f, 0.125f});
            CHECK(audio->warnings.empty());
        }
}

TEST_CASE("A header whose frames are longer or shorter than its samples is told with both lengths", "[io][audio]")
{
    const TempFolder folder;
    for (const auto& [sound, place, bytes, big] :
         {std::tuple(waveFile("RIFF"), 32u, 2, false), std::tuple(waveFile("RF64"), 68u, 2, false),
          std::tuple(waveFile("BW64"), 68u, 2, false), std::tuple(wave64(), 76u, 2, false),
          std::tuple(caf(), 36u, 4, true)})
    {
        CAPTURE(sound.name);
        for (const std::uint64_t frame : {1u, 2u, 4u, 8u})
        {
            CAPTURE(frame);
            auto changed = sound.bytes;
            const auto stated = big ? bigEndian(frame, bytes) : littleEndian(frame, bytes);
            changed.replace(place, static_cast<std::size_t>(bytes), stated);
            const auto audio = readAudio(put(folder / "x", changed));
            if (!audio.ok())
                continue;
            CHECK(audio->warnings.empty() == (frame == 2 && audio->samples.size() == knownFrames));
            if (frame == 2)
                continue;
            REQUIRE(audio->warnings.size() == 1);
            CHECK(audio->warnings.front().starts_with(
                fmt::format("has a header that states frames of {} bytes, but its samples make frames of 2; ", frame)));
            CHECK(audio->warnings.front().find(
                      fmt::format("would last {:.3f} s", static_cast<double>(2 * knownFrames) /
                                                             static_cast<double>(frame * rate))) != std::string::npos);
        }
    }
    // A size of 0 states nothing.
    auto none = waveFile("RIFF").bytes;
    none.replace(32, 2, littleEndian(0, 2));
    const auto audio = readAudio(put(folder / "x", none));
    REQUIRE(audio.ok());
    CHECK(audio->warnings.empty());
    CHECK(audio->samples.size() == knownFrames);
}

TEST_CASE("An AU whose sound begins within its text is read behind it, with a word", "[io][audio]")
{
    const TempFolder folder;
    const auto plain = au().bytes;
    const auto samples = plain.substr(24);
    const auto read = [&](std::uint64_t offset, const std::string& text, bool isOpen)
    {
        const std::string head =
            ".snd" + bigEndian(offset, 4) + bigEndian(isOpen ? 0xFFFFFFFFu : samples.size(), 4) + plain.substr(12, 12);
        const auto audio = readAudio(put(folder / "x", head + text + samples));
        REQUIRE(audio.ok());
        return *audio;
    };
    const auto whole = readAudio(put(folder / "x", plain));
    REQUIRE(whole.ok());
    for (const bool isOpen : {false, true})
        for (const std::size_t letters : {39u, 2000u})
        {
            CAPTURE(isOpen, letters);
            const auto text = std::string(letters, 'a') + std::string(8 - letters % 8, '\0');
            const auto right = read(24 + text.size(), text, isOpen);
            CHECK(right.samples == whole->samples);
            CHECK(right.warnings.empty());
            for (const std::uint64_t offset : {24u, 28u, 43u})
            {
                CAPTURE(offset);
                const auto audio = read(offset, text, isOpen);
                CHECK(audio.samples == whole->samples);
                REQUIRE(audio.warnings.size() == 1);
                CHECK(audio.warnings.front() ==
                      fmt::format("has a header by which its sound begins within its text; it is read from byte {} on, "
                                  "where the text ends; save it anew",
                                  24 + text.size()));
            }
        }
}

TEST_CASE("The footer of an APE tag takes nothing of the sound, whatever it claims", "[io][audio]")
{
    const TempFolder folder;
    const std::string item = littleEndian(5, 4) + littleEndian(0, 4) + std::string("Title\0Hello", 11);
    const auto mark = [&](std::uint64_t size, std::uint64_t flags)
    {
        return "APETAGEX" + littleEndian(2000, 4) + littleEndian(size, 4) + littleEndian(1, 4) +
               littleEndian(flags, 4) + std::string(8, '\0');
    };
    constexpr std::uint64_t hasHeader = 0x80000000u, isHeader = 0xA0000000u;
    auto open = waveFile("RIFF").bytes;
    open.replace(40, 4, littleEndian(0xFFFFFFFFu, 4));
    const auto size = item.size() + 32;
    for (const std::string& sound : {waveFile("RIFF").bytes, open})
        for (const std::uint64_t claim : {std::uint64_t{0}, hasHeader})
            for (const bool isThere : {false, true})
            {
                CAPTURE(claim, isThere);
                const auto audio = readAudio(
                    put(folder / "x", sound + (isThere ? mark(size, isHeader) : "") + item + mark(size, claim)));
                REQUIRE(audio.ok());
                CHECK(audio->samples.size() == knownFrames);
                CHECK(audio->warnings.empty());
            }
    // A size that leads into the sound.
    for (const std::uint64_t wrong : {std::uint64_t{0}, std::uint64_t{31}, size + 400, std::uint64_t{1} << 31u})
    {
        CAPTURE(wrong);
        const auto audio = readAudio(put(folder / "x", open + item + mark(wrong, hasHeader)));
        REQUIRE(audio.ok());
        CHECK(audio->samples.size() >= knownFrames);
    }
}

TEST_CASE("A Matroska file without a duration says what of it no player knows", "[io][audio]")
{
    const TempFolder folder;
    const auto recorded = bytesOf(testFolder() / "io/films/recorded.webm");
    const auto unknownOf = [&](const std::string& bytes)
    {
        const FileHandle file(std::fopen(put(folder / "x", bytes).string().c_str(), "rb"));
        return unknownBytesOfMatroska(file.get());
    };
    CHECK(unknownOf(recorded) == 0);
    CHECK(unknownOf(recorded.substr(0, recorded.size() - 20)) == 0); // which ffmpeg tells
    const auto cluster = recorded.find("\x1F\x43\xB6\x75");
    auto damaged = recorded;
    damaged[cluster + 2] = '\x7F';
    CHECK(unknownOf(damaged) > 3000); // with all its blocks
    damaged = recorded;
    damaged[cluster] = '\0';
    CHECK(unknownOf(damaged) == recorded.size() - cluster);
    CHECK(unknownOf(recorded + std::string("\xEC\x84\0\0\0\0", 6)) == 0);
}

TEST_CASE("Two descriptions of the samples of a WAV that differ are told", "[io][audio]")
{
    const TempFolder folder;
    for (const auto& [sound, place] : {std::pair(waveFile("RIFF"), 12u), std::pair(waveFile("RF64"), 48u)})
    {
        CAPTURE(sound.name);
        const auto format = sound.bytes.substr(place, 24);
        REQUIRE(format.starts_with("fmt "));
        auto twice = sound.bytes, other = sound.bytes;
        auto stereo = format;
        stereo.replace(10, 2, littleEndian(2, 2)).replace(20, 2, littleEndian(4, 2));
        const auto same = readAudio(put(folder / "x", twice.insert(place, format)));
        REQUIRE(same.ok());
        CHECK(same->warnings.empty());
        CHECK(same->samples.size() == knownFrames);
        const auto differing = readAudio(put(folder / "x", other.insert(place, stereo)));
        REQUIRE(differing.ok());
        REQUIRE(differing->warnings.size() == 1);
        CHECK(differing->warnings.front() ==
              "has two descriptions of its samples that differ; it is read by the first, "
              "as 2 channels at 8000 Hz, and lasts 0.250 s; save it anew");
    }
}

TEST_CASE("An Opus that leaves out more of its beginning than a decoder needs to settle says so", "[io][audio]")
{
    const TempFolder folder;
    const auto opus = bytesOf(testFolder() / "io/audio/tone.opus");
    const auto place = opus.find("OpusHead");
    const auto second = opus.find("OggS", place);
    const auto withNumber = [&](std::size_t at, std::uint64_t number)
    {
        auto packet = opus.substr(place, second - place);
        packet.replace(at, 2, littleEndian(number, 2));
        return oggPageBytes(opus.substr(0, 26), opus.substr(26 + 1, static_cast<unsigned char>(opus[26])), packet, 0) +
               opus.substr(second);
    };
    const auto usual = readAudio(put(folder / "x", withNumber(10, 3840)));
    REQUIRE(usual.ok());
    CHECK(usual->warnings.empty());
    const auto longer = readAudio(put(folder / "x", withNumber(10, 24000)));
    REQUIRE(longer.ok());
    CHECK(longer->samples.size() < usual->samples.size());
    CHECK(longer->warnings == std::vector<std::string>{"has a header that leaves out 0.500 s at its beginning"});
    const auto all = readAudio(put(folder / "x", withNumber(10, 65535)));
    REQUIRE(!all.ok());
    CHECK(all.error().message.starts_with("has a header that leaves out 1.365 s at its beginning, but only 1.0"));
    // Its gain, dB / 256.
    CHECK(readAudio(put(folder / "x", withNumber(16, 20 * 256)))->warnings.empty());
    CHECK(readAudio(put(folder / "x", withNumber(16, 65536 - 60 * 256)))->warnings ==
          std::vector<std::string>{"has a header that makes it 60 dB softer"});
}

TEST_CASE("What the times of an Ogg leave out at its end, and a page of wrong sums and times, are told", "[io][audio]")
{
    const TempFolder folder;
    for (const auto& [name, ratio] : {std::pair("tone.ogg", 1u), std::pair("tone.opus", 2u)})
    {
        CAPTURE(name);
        const auto bytes = bytesOf(testFolder() / "io/audio" / name);
        const auto last = pagesIn(bytes).back();
        const auto time = [&](std::uint64_t frames, bool isWrittenSo)
        {
            auto changed = bytes;
            changed.replace(last + 6, 8, littleEndian(frames, 8));
            const auto audio = readAudio(put(folder / "x", isWrittenSo ? withChecksums(changed) : changed));
            REQUIRE(audio.ok());
            return *audio;
        };
        const std::uint64_t end = std::uint64_t{24000} * ratio + (ratio == 2 ? 312u : 0u);
        CHECK(time(end, true).samples.size() == 24000);
        CHECK(time(end, true).warnings.empty());
        // All that is said to be left out, and the filling that was left out before.
        const auto shorter = time(end - 6000 * ratio, true);
        REQUIRE(shorter.warnings.size() == 1);
        CHECK(shorter.warnings.front().starts_with("has times that leave out 0.2"));
        CHECK(shorter.warnings.front().ends_with(" s at its end"));
    }
    // The third page of four, whose damage is in its own time: libogg leaves it out.
    auto damaged = bytesOf(testFolder() / "io/audio/tone.ogg");
    damaged[pagesIn(damaged).at(2) + 13] = '\xF8';
    const auto audio = readAudio(put(folder / "x", damaged));
    REQUIRE(audio.ok());
    CHECK(audio->samples.size() < 2000);
    REQUIRE(audio->warnings.size() == 1);
    CHECK(audio->warnings.front().starts_with("is damaged: 1 of its pages have wrong checksums, about 0.9"));
    // An end before the last page, which names a stream that never began.
    auto stray = bytesOf(testFolder() / "io/audio/tone.ogg");
    const auto pages = pagesIn(stray);
    stray[pages.at(2) + 5] = '\4';
    stray[pages.at(3) + 14] = '\x07';
    const auto ended = readAudio(put(folder / "x", withChecksums(stray)));
    REQUIRE(ended.ok());
    CHECK(ended->samples.size() < 24000);
    REQUIRE(ended->warnings.size() == 1);
    CHECK(ended->warnings.front().starts_with("is damaged: 316 bytes are no sound, about 0.0"));
}
