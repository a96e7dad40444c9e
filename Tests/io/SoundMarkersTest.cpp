#include "io/AudioBytes.h"
#include "io/AudioReader.h"
#include "io/AudioWriter.h"
#include "io/ClipSeal.h"
#include "io/FileOrigin.h"
#include "io/Id3Chapters.h"
#include "io/SoundEncoder.h"
#include "io/TagBytes.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;
using namespace std::string_literals;

namespace
{
struct Cue
{
    std::uint32_t frame;
    std::string name; // empty: without a label
};

std::string wavChunk(const std::string& name, const std::string& content)
{
    return name + littleEndian(content.size(), 4) + content + std::string(content.size() % 2, '\0');
}

// A second of sound at 8 kHz, and cues behind it.
std::string withCues(const std::vector<Cue>& cues)
{
    std::string points = littleEndian(cues.size(), 4);
    std::string labels = "adtl";
    for (std::size_t i = 0; i < cues.size(); ++i)
    {
        const auto id = littleEndian(i + 1, 4);
        points += id + littleEndian(cues[i].frame, 4) + "data" + littleEndian(0, 8) + littleEndian(cues[i].frame, 4);
        if (!cues[i].name.empty())
            labels += wavChunk("labl", id + cues[i].name + '\0');
    }
    std::vector<int> samples(8000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = i % 80 < 40 ? 8000 : -8000;
    std::string bytes = wavBytes({}, pcm16(samples)) + wavChunk("cue ", points) + wavChunk("LIST", labels);
    return bytes.replace(4, 4, littleEndian(bytes.size() - 8, 4));
}

std::string taggedSound(const std::string& name)
{
    return bytesOf(testFolder() / "io/audio" / name);
}

// The WAV with another chunk at its end.
std::string withChunk(std::string wav, const std::string& name, const std::string& content)
{
    wav += wavChunk(name, content);
    return wav.replace(4, 4, littleEndian(wav.size() - 8, 4));
}

std::string loopChunk(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& frames)
{
    std::string content = littleEndian(0, 28) + littleEndian(frames.size(), 4) + littleEndian(0, 4);
    for (const auto& [first, last] : frames)
        content += littleEndian(0, 8) + littleEndian(first, 4) + littleEndian(last, 4) + littleEndian(0, 8);
    return content;
}

struct Taken
{
    std::vector<Marker> markers;
    std::vector<std::string> warnings;
};

// What a clip of the whole sound gets.
Taken takenOf(const std::string& bytes)
{
    TempFolder folder;
    auto reader = AudioReader::open(put(folder / "sound", bytes));
    REQUIRE(reader);
    std::uint64_t frames = 0;
    REQUIRE(reader->forEachBlock(4096,
                                 [&](std::span<const float> block)
                                 {
                                     frames += block.size() / static_cast<std::size_t>(reader->channels());
                                     return true;
                                 }));
    auto markers = reader->takeMarkers(static_cast<double>(frames) / reader->sampleRate());
    return {std::move(markers), reader->warnings()};
}

const std::vector<Marker> twoChapters{{0.0625, "hit"}, {0.125, "L\xC3\xA4rm"}};
const std::vector<std::string> twoComments{"TITLE=a", "CHAPTER002=00:00:00,125", "CHAPTER002NAME=L\xC3\xA4rm",
                                           "chapter001=00:00:00.0625", "Chapter001Name=hit"};

std::vector<Marker> markersOf(const std::string& bytes)
{
    TempFolder folder;
    const auto reader = AudioReader::open(put(folder / "cues.wav", bytes));
    REQUIRE(reader);
    return reader->markers();
}
} // namespace

TEST_CASE("Cues of a WAV are its markers, by their labels and in order", "[io]")
{
    CHECK(markersOf(withCues({{4000, "ring"}, {2000, "hit"}})) == std::vector<Marker>{{0.25, "hit"}, {0.5, "ring"}});
    // Labels of Windows-1252, which most programs write, and one that is cut off within a character of UTF-8.
    CHECK(markersOf(withCues({{0, ""}, {4000, "T\xC3\xBCr\xE2\x82"}, {8000, "T\xFCr \x80"}})) ==
          std::vector<Marker>{{0.0, "1"}, {0.5, "T\xC3\xBCr"}, {1.0, "T\xC3\xBCr \xE2\x82\xAC"}});
    CHECK(markersOf(withCues({})).empty());
    CHECK(markersOf(wavBytes({}, pcm16({1, 2, 3}))).empty());
    std::vector<Cue> many;
    for (std::uint32_t i = 0; i < 500; ++i)
        many.push_back({16 * i, "m" + std::to_string(i)});
    CHECK(markersOf(withCues(many)).size() == 500);
}

TEST_CASE("A clip has the markers of its sound that lie within it", "[io]")
{
    TempFolder folder;
    const auto path = put(folder / "cues.wav", withCues({{2000, "hit"}, {9000, "beyond"}}));
    auto reader = AudioReader::open(path);
    REQUIRE(reader);
    SoundEncoder encoder{SoundEncoderParams{}};
    Stopwatch work;
    const auto clip = encoder.clipOf(
        *reader, path, [](double) {}, work);
    REQUIRE(clip);
    REQUIRE(clip->markers.size() == 1);
    CHECK(clip->markers[0].time == Approx(0.25).margin(0.001));
    CHECK(clip->markers[0].name == "hit");
    CHECK(onGrids(*clip) == *clip);
    CHECK(sealOf(*clip) == ClipSeal::whole);
    auto edited = *clip;
    edited.markers[0].name = "miss";
    CHECK(sealOf(edited) == ClipSeal::broken);
}

TEST_CASE("Chapters of Ogg and FLAC are markers, in whatever order their comments stand", "[io]")
{
    const auto comments = commentBytes(twoComments);
    CHECK(takenOf(flacWithComments(taggedSound("tone.flac"), comments)).markers == twoChapters);
    CHECK(takenOf(oggWithComments(taggedSound("tone.ogg"), comments)).markers == twoChapters);
    CHECK(takenOf(oggWithComments(taggedSound("tone.opus"), comments)).markers == twoChapters);
    // A picture before them takes many pages.
    auto large = twoComments;
    large.insert(large.begin(), "METADATA_BLOCK_PICTURE=" + std::string(300'000, 'A'));
    for (const char* name : {"tone.ogg", "tone.opus"})
    {
        const auto taken = takenOf(oggWithComments(taggedSound(name), commentBytes(large)));
        CHECK(taken.markers == twoChapters);
        CHECK(taken.warnings.empty());
    }
    CHECK(takenOf(flacWithComments(taggedSound("tone.flac"), commentBytes({}))).markers.empty());
}

TEST_CASE("Cue sheets in a FLAC are markers, as a block and among its comments", "[io]")
{
    const TempFolder folder;
    const std::string flac = bytesOf(testFolder() / "io/audio/ramp.flac"); // .05 s at 8 kHz
    const auto read = [&](const std::string& bytes)
    {
        auto reader = AudioReader::open(put(folder / "x.flac", bytes));
        REQUIRE(reader.ok());
        std::vector<std::pair<double, std::string>> found;
        for (const Marker& marker : reader->takeMarkers(1.0))
            found.emplace_back(marker.time, marker.name);
        return std::pair(found, reader->warnings());
    };
    const auto index = [](std::uint64_t offset, int number)
    {
        return bigEndian(offset, 8) + bigEndian(static_cast<std::uint64_t>(number), 1) + std::string(3, '\0');
    };
    const auto track = [](std::uint64_t offset, int number, const std::vector<std::string>& indices)
    {
        std::string all = bigEndian(offset, 8) + bigEndian(static_cast<std::uint64_t>(number), 1) +
                          std::string(26, '\0') + bigEndian(indices.size(), 1);
        for (const std::string& one : indices)
            all += one;
        return all;
    };
    const auto block = [](int type, const std::string& content)
    {
        return bigEndian(static_cast<std::uint64_t>(type), 1) + bigEndian(content.size(), 3) + content;
    };
    const std::string sheet = std::string(395, '\0') + bigEndian(3, 1) + track(0, 1, {index(0, 1)}) +
                              track(160, 2, {index(0, 0), index(80, 1)}) + track(400, 170, {});
    const auto with = [&](const std::string& blocks)
    {
        return std::string(flac).insert(42, blocks);
    };
    using Found = std::vector<std::pair<double, std::string>>;
    const auto tracks = read(with(block(5, sheet)));
    CHECK(tracks.first == Found{{0.0, "1"}, {0.03, "2"}});
    CHECK(tracks.second.empty());
    const std::string text = "CueSheet=FILE \"a.wav\" WAVE\n TRACK 01 AUDIO\n  TITLE \"door\"\n  INDEX 01 00:00:00\n"
                             " TRACK 02 AUDIO\n  INDEX 01 00:00:03\n";
    const auto named = read(with(block(4, commentBytes({text})) + block(5, sheet)));
    CHECK(named.first == Found{{0.0, "door"}, {0.04, "02"}});
    const auto cut = read(with(block(5, sheet.substr(0, 470))));
    CHECK(cut.first == Found{{0.0, "1"}});
    CHECK(cut.second == std::vector<std::string>{"has a cue sheet of 2 tracks, of which 1 can be read"});
    const auto wrong = read(with(block(4, commentBytes({"CUESHEET=FILE a WAVE\nTRACK 1\nINDEX 01 x\n"}))));
    CHECK(wrong.first.empty());
    CHECK(wrong.second ==
          std::vector<std::string>{"has a cue sheet whose line 3 has a time that is not "
                                   "minutes:seconds:frames, such as 03:25:74; its tracks are left out"});
}

TEST_CASE("A chapter without a time is told, one without a name is called by its number", "[io]")
{
    const auto read = [](const std::vector<std::string>& comments)
    {
        return takenOf(flacWithComments(taggedSound("tone.flac"), commentBytes(comments)));
    };
    CHECK(read({"CHAPTER007=0.05"}).markers == std::vector<Marker>{{0.05, "7"}});
    const auto none = read({"CHAPTER001NAME=lost", "CHAPTER002=soon", "CHAPTER003=1:2:3:4", "CHAPTER004=nan"});
    CHECK(none.markers.empty());
    CHECK(none.warnings == std::vector<std::string>{"has 4 chapters without a time that can be read, which are left "
                                                    "out; the first has no time"});
    CHECK(read({"CHAPTER001=soon"}).warnings ==
          std::vector<std::string>{"has a chapter with the time \"soon\", which is left out"});
    CHECK(read({"CHAPTER001=s\xE8"}).warnings ==
          std::vector<std::string>{"has a chapter with the time \"s\xEF\xBF\xBD\", which is left out"});
    CHECK(read({"CHAPTER001=10:00:00"}).warnings ==
          std::vector<std::string>{"has a marker behind the end of its sound, which is left out"});
    CHECK(read({"CHAPTER=1", "CHAPTERX=1", "CHAPTER001URL=x", "noequals", ""}).warnings.empty());
    const auto whole = commentBytes(twoComments);
    const auto cut = takenOf(flacWithComments(taggedSound("tone.flac"), whole.substr(0, whole.size() - 3)));
    CHECK(cut.warnings.size() == 1);
}

TEST_CASE("Chapters of an ID3 tag are markers, in any version and encoding", "[io]")
{
    const std::string utf16 = std::string("\1\xFF\xFEL\0\xE4\0r\0m\0", 11), latin = "\0L\xE4rm"s + '\0';
    for (const int version : {3, 4})
        for (const std::string& title : {utf16, latin, "\3L\xC3\xA4rm"s, std::string("\2\0L\0\xE4\0r\0m", 9)})
        {
            const auto tag = id3Tag(id3Frame("TIT2", "\3a", version) + id3Chapter("b", 125, title, version) +
                                        id3Chapter("a", 62, "\3hit", version) + std::string(50, '\0'),
                                    version);
            const std::vector<Marker> expected{{0.062, "hit"}, {0.125, "L\xC3\xA4rm"}};
            CHECK(takenOf(tag + taggedSound("tone.mp3")).markers == expected);
            CHECK(takenOf(tag + taggedSound("tone.flac")).markers == expected);
            CHECK(takenOf(withChunk(withCues({}), "id3 ", tag)).markers == expected);
            // A chunk of odd length, without the byte behind it.
            CHECK(takenOf(withChunk(withChunk(withCues({}), "ID3 ", tag), "JUNK", "x")).markers == expected);
            CHECK(takenOf(tag + taggedSound("tone.mp3")).warnings == takenOf(taggedSound("tone.mp3")).warnings);
        }
    // Sizes of 8 bits in version 2.4, as some programs write them.
    const std::string image(200, 'x');
    const auto plain = "APIC" + bigEndian(image.size(), 4) + bigEndian(0, 2) + image;
    CHECK(id3Chapters(id3Tag(plain + id3Chapter("a", 62, "", 4), 4)).markers == std::vector<Marker>{{0.062, "1"}});
    // Zeros behind 0xFF.
    auto apart = id3Chapter("a", 62, "\3hit", 3);
    for (std::size_t at = 0; (at = apart.find('\xFF', at)) != std::string::npos; at += 2)
        apart.insert(at + 1, 1, '\0');
    CHECK(id3Chapters(id3Tag(apart, 3, 0x80)).markers == std::vector<Marker>{{0.062, "hit"}});
}

TEST_CASE("Damaged ID3 tags are told and break nothing", "[io]")
{
    const auto tag = id3Tag(id3Chapter("a", 62, "\3hit", 4) + id3Chapter("b", 125, "\1\xFF\xFE" + "a\0"s, 4), 4);
    for (std::size_t length = 0; length < tag.size(); ++length)
    {
        const auto found = id3Chapters(tag.substr(0, length));
        CHECK((length < 10 || !found.warnings.empty()));
    }
    for (std::size_t at = 0; at < tag.size(); ++at)
        for (const char byte : {'\0', '\x7F', '\xFF'})
        {
            auto broken = tag;
            broken[at] = byte;
            CHECK(id3Chapters(broken).markers.size() <= 2);
        }
    const auto packed = id3Frame("CHAP", std::string(30, 'x'), 4, 0x08);
    CHECK(id3Chapters(id3Tag(packed, 4)).warnings ==
          std::vector<std::string>{
              "has 1 chapters in its ID3 tag that are compressed, encrypted or damaged and left out"});
}

TEST_CASE("Loops of a WAV are two markers each", "[io]")
{
    const auto taken = takenOf(withChunk(withCues({}), "smpl", loopChunk({{2000, 3999}, {0, 7999}})));
    CHECK(taken.markers ==
          std::vector<Marker>{{0.0, "loop 2 start"}, {0.25, "loop start"}, {0.5, "loop end"}, {1.0, "loop 2 end"}});
    CHECK(taken.warnings.empty());
    // Before the sound.
    auto front = wavBytes({}, pcm16(std::vector<int>(8000)));
    front.insert(36, wavChunk("smpl", loopChunk({{2000, 3999}})));
    CHECK(takenOf(front.replace(4, 4, littleEndian(front.size() - 8, 4))).markers.size() == 2);
    CHECK(takenOf(withChunk(withCues({}), "smpl", loopChunk({{4000, 2000}}))).warnings ==
          std::vector<std::string>{"has 1 loops that are damaged and left out"});
    auto claims = loopChunk({{0, 100}});
    claims.replace(28, 4, littleEndian(0xFFFFFFFF, 4));
    CHECK(takenOf(withChunk(withCues({}), "smpl", claims)).markers.size() == 2);
    CHECK(takenOf(withChunk(withCues({}), "smpl", claims)).warnings.size() == 1);
    CHECK(takenOf(withChunk(withCues({}), "smpl", "short")).markers.empty());
}

TEST_CASE("The same marker in two places is one, and markers of what follows count from its start", "[io]")
{
    const auto tag = id3Tag(id3Chapter("a", 250, "\3hit", 4) + id3Chapter("b", 500, "\3other", 4), 4);
    const auto both = withChunk(withCues({{2000, "hit"}}), "id3 ", tag);
    CHECK(takenOf(both).markers == std::vector<Marker>{{0.25, "hit"}, {0.5, "other"}});
    const auto once = flacWithComments(taggedSound("tone.flac"), commentBytes({"CHAPTER001=0.05"}));
    const auto joined = takenOf(once + once).markers;
    REQUIRE(joined.size() == 2);
    CHECK(joined[1].time > joined[0].time + 0.1);
    CHECK(joined[1].name == "1");
}

TEST_CASE("Markers that cannot be kept are told", "[io]")
{
    CHECK(takenOf(withCues({{2000, "hit"}, {9000, "beyond"}})).warnings ==
          std::vector<std::string>{"has a marker behind the end of its sound, which is left out"});
    CHECK(takenOf(withCues({{9000, "a"}, {0xFFFFFFFF, "b"}})).warnings ==
          std::vector<std::string>{"has 2 markers behind the end of its sound, which are left out"});
    std::vector<Cue> many;
    for (std::uint32_t i = 0; i < 3000; ++i)
        many.push_back({i, "m" + std::to_string(i)});
    CHECK(takenOf(withCues(many)).markers.size() == 3000);
    CHECK(takenOf(withCues(many)).warnings.empty());
    const std::string long400(400, 'n');
    CHECK(takenOf(withCues({{0, long400}})).markers == std::vector<Marker>{{0.0, long400}});
    auto claims = withCues({{0, "a"}, {100, "b"}});
    claims.replace(claims.find("cue ") + 8, 4, littleEndian(0xFFFFFFFF, 4));
    CHECK(takenOf(claims).markers.size() == 2);
    CHECK(takenOf(claims).warnings == std::vector<std::string>{"states 4294967295 markers, of which 2 can be read"});
    const auto region = wavChunk("ltxt", littleEndian(1, 4) + littleEndian(800, 4) + "rgn " + littleEndian(0, 8));
    CHECK(takenOf(withChunk(withCues({{0, "a"}}), "LIST", "adtl" + region)).warnings ==
          std::vector<std::string>{"has 1 regions, whose starts are read as markers, but not how long they last"});
    std::vector<std::string> chapters;
    for (int i = 0; i < 2000; ++i)
        chapters.push_back("CHAPTER" + std::to_string(1000 + i) + "=0.01"),
            chapters.push_back("CHAPTER" + std::to_string(1000 + i) + "NAME=" + std::string(100, 'n') +
                               char('a' + i % 26));
    const auto full = takenOf(flacWithComments(taggedSound("tone.flac"), commentBytes(chapters)));
    CHECK(full.markers.size() < 1000);
}

TEST_CASE("Cues are found behind a sound whose size is wrong, and in any kind of WAV", "[io]")
{
    const auto whole = withCues({{2000, "hit"}});
    const std::vector<Marker> hit{{0.25, "hit"}};
    const auto data = whole.find("data") + 4;
    for (const std::uint32_t size : {0xFFFFFFFFu, 0x7FFFFF00u, 2'000'000'000u})
    {
        auto open = whole;
        open.replace(data, 4, littleEndian(size, 4));
        CHECK(takenOf(open).markers == hit);
    }
    for (const char* name : {"RF64", "BW64"})
    {
        auto large = whole;
        large.replace(0, 4, name).replace(data, 4, littleEndian(0xFFFFFFFF, 4));
        large.insert(12, wavChunk("ds64", littleEndian(large.size() + 28, 8) + littleEndian(16000, 8) +
                                              littleEndian(8000, 8) + littleEndian(0, 4)));
        CHECK(takenOf(large).markers == hit);
    }
    CHECK(takenOf(whole + whole).markers == std::vector<Marker>{{0.25, "hit"}, {1.25, "hit"}});
}

TEST_CASE("Cues that count frames in the order of play only are read", "[io]")
{
    auto bytes = withCues({{2000, "hit"}});
    const auto cue = bytes.find("cue ") + 12;
    bytes.replace(cue + 4, 4, littleEndian(2000, 4)).replace(cue + 20, 4, littleEndian(0, 4));
    CHECK(markersOf(bytes) == std::vector<Marker>{{0.25, "hit"}});
}

TEST_CASE("Markers of an AIFF are read, and a list of them that is cut off breaks nothing", "[io]")
{
    const auto marker = [](int id, std::uint32_t frame, const std::string& name)
    {
        const auto text = bigEndian(name.size(), 1) + name;
        return bigEndian(static_cast<unsigned>(id), 2) + bigEndian(frame, 4) + text +
               std::string(text.size() % 2, '\0');
    };
    const auto content = bigEndian(3, 2) + marker(7, 40, "even") + marker(9, 10, "odd") + marker(1, 20, "");
    const auto aiff = [](const std::string& marks)
    {
        auto bytes = taggedSound("ramp.aiff") + "MARK" + bigEndian(marks.size(), 4) + marks +
                     std::string(marks.size() % 2, '\0');
        return bytes.replace(4, 4, bigEndian(bytes.size() - 8, 4));
    };
    const auto found = markersOf(aiff(content));
    REQUIRE(found.size() == 3);
    CHECK(found[0].name == "odd");
    CHECK(found[1].name == "3");
    CHECK(found[2].name == "even");
    CHECK(found[1].time == Approx(2.0 * found[0].time));
    for (std::size_t length = 0; length < content.size(); ++length)
        CHECK(markersOf(aiff(content.substr(0, length))).size() <= 3);
}

TEST_CASE("Markers that are written to a WAV come back exactly", "[io]")
{
    TempFolder folder;
    const std::vector<Marker> markers{
        {0.0, "start"}, {0.25, "L\xC3\xA4rm"}, {0.25, ""}, {0.5, std::string(300, 'n')}, {1.0, "end"}};
    auto expected = markers;
    expected[2].name = "3";
    for (const auto encoding : {SampleEncoding::float32, SampleEncoding::pcm24, SampleEncoding::pcm16})
        for (const std::size_t frames : {8000u, 8001u})
        {
            AudioWriteParams params;
            params.sampleRate = 8000;
            params.encoding = encoding;
            params.markers = markers;
            params.markers.push_back({2.0, "behind"});
            const auto path = folder / "out.wav";
            const auto report = writeAudio(path, std::vector<float>(frames, 0.25f), params);
            REQUIRE(report);
            CHECK(report->bytes == std::filesystem::file_size(path));
            const auto taken = takenOf(bytesOf(path));
            CHECK(taken.markers == expected);
            CHECK(taken.warnings.empty());
            CHECK(readAudio(path)->samples == std::vector<float>(frames, 0.25f));
            CHECK(littleEndian(report->bytes - 8, 4) == bytesOf(path).substr(4, 4));
            params.origin = FileOrigin{"a.json", std::string(16, '1'), std::string(16, '2')};
            REQUIRE(writeAudio(path, std::vector<float>(frames, 0.25f), params));
            CHECK(isAsMade(path));
        }
    AudioWriteParams large;
    large.sampleRate = 8000;
    large.markers = {{0.5, "hit"}};
    large.expectedFrames = std::uint64_t(1) << 40u; // RF64
    auto writer = AudioWriter::create(folder / "large.wav", large);
    REQUIRE(writer);
    REQUIRE(writer->write(std::vector<float>(8000, 0.25f)));
    REQUIRE(writer->finish());
    CHECK(takenOf(bytesOf(folder / "large.wav")).markers == large.markers);
    CHECK(takenOf(bytesOf(folder / "large.wav")).warnings.empty());
}

TEST_CASE("Markers of a CAF are the clip's, by the names of its texts; regions are told to be left out", "[io]")
{
    const auto cafChunk = [](const std::string& name, const std::string& content)
    {
        return name + bigEndian(content.size(), 8) + content;
    };
    const auto frameOf = [](double frame)
    {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &frame, 8);
        return bigEndian(bits, 8);
    };
    std::string samples;
    for (int i = 0; i < 8000; ++i)
        samples += bigEndian(i % 80 < 40 ? 8000 : 0xE0C0, 2);
    const std::string head =
        "caff" + bigEndian(1, 2) + bigEndian(0, 2) +
        cafChunk("desc", bigEndian(0x40BF400000000000u, 8) + "lpcm" + bigEndian(0, 4) + bigEndian(2, 4) +
                             bigEndian(1, 4) + bigEndian(1, 4) + bigEndian(16, 4));
    const std::string data = cafChunk("data", bigEndian(0, 4) + samples);
    const auto marker = [&](double frame, std::uint32_t id)
    {
        return bigEndian(0, 4) + frameOf(frame) + bigEndian(id, 4) + std::string(12, '\0');
    };
    const std::string texts = "hit\0L\xC3\xA4rm\0"s;
    const std::string names = cafChunk("strg", bigEndian(2, 4) + bigEndian(7, 4) + bigEndian(0, 8) + bigEndian(9, 4) +
                                                   bigEndian(4, 8) + texts);
    const auto marks = [&](const std::string& content, std::uint32_t count)
    {
        return cafChunk("mark", bigEndian(0, 4) + bigEndian(count, 4) + content);
    };
    const auto two = marks(marker(1000.0, 9) + marker(500.0, 7), 2);
    for (const auto& file : {head + data + two + names, head + names + two + data})
    {
        const auto taken = takenOf(file);
        CHECK(taken.markers == twoChapters);
        CHECK(taken.warnings.empty());
    }
    CHECK(takenOf(head + data + marks(marker(500.0, 3), 1)).markers == std::vector<Marker>{{0.0625, "1"}});
    const auto nan = takenOf(head + data + marks(marker(std::nan(""), 7) + marker(500.0, 7), 3) + names);
    CHECK(nan.markers == std::vector<Marker>{twoChapters[0]});
    CHECK(nan.warnings == std::vector<std::string>{"states 3 markers, of which 1 can be read"});
    const auto regions = takenOf(head + data + cafChunk("regn", bigEndian(0, 4) + bigEndian(2, 4)));
    CHECK(regions.warnings == std::vector<std::string>{"has 2 regions, which are left out"});
}

TEST_CASE("Chapters in an ID3 tag behind a sound are markers", "[io]")
{
    // With a footer, as the standard has it for tags behind a sound.
    const auto frames = id3Chapter("a", 10, "\3hit", 4) + id3Chapter("b", 20, "\3ring", 4);
    const auto tag =
        id3Tag(frames, 4, 0x10) + "3DI\4" + '\0' + '\x10' + sevenBits(static_cast<std::uint32_t>(frames.size()));
    const std::vector<Marker> expected{{0.01, "hit"}, {0.02, "ring"}};
    for (const char* name : {"tone.mp3", "ramp.flac", "tone.ogg"})
    {
        CAPTURE(name);
        const auto sound = taggedSound(name);
        for (const std::string& bytes : {sound + tag, sound + tag + "TAG" + std::string(125, 'x')})
            CHECK(takenOf(bytes).markers == expected);
        CHECK(takenOf(tag + sound + tag).markers == expected);
    }
}

TEST_CASE("Cues are read beyond their stated number, and notes are names where there is no label", "[io]")
{
    TempFolder folder;
    const auto read = [&](const std::string& chunks)
    {
        const std::string bytes = wavBytes({}, pcm16(std::vector<int>(8000, 5))) + chunks;
        auto reader = AudioReader::open(put(folder / "x.wav", bytes));
        REQUIRE(reader);
        const auto markers = reader->takeMarkers(1.0);
        return std::pair(markers, reader->warnings());
    };
    const auto point = [](std::uint64_t id, std::uint64_t frame)
    {
        return littleEndian(id, 4) + littleEndian(frame, 4) + "data" + littleEndian(0, 8) + littleEndian(frame, 4);
    };
    const auto cues = [&](std::uint64_t stated)
    {
        return wavChunk("cue ", littleEndian(stated, 4) + point(1, 2000) + point(2, 4000));
    };
    const auto id = [](std::uint64_t number)
    {
        return littleEndian(number, 4);
    };
    for (const std::uint64_t stated : {0u, 1u})
    {
        const auto [markers, warnings] = read(cues(stated));
        CHECK(markers == std::vector<Marker>{{0.25, "1"}, {0.5, "2"}});
        REQUIRE(warnings.size() == 1);
        CHECK(warnings.front() == "states " + std::to_string(stated) + " markers, but has 2, which are all read");
    }
    const auto texts = wavChunk("note", id(1) + "a note\0"s) + wavChunk("labl", id(2) + "label\0"s) +
                       wavChunk("note", id(2) + "unused\0"s);
    CHECK(read(cues(2) + wavChunk("LIST", "adtl" + texts)).first ==
          std::vector<Marker>{{0.25, "a note"}, {0.5, "label"}});
    const auto region = wavChunk("ltxt", id(2) + littleEndian(0, 4) + "rgn " + std::string(8, '\0') + "text\0"s);
    CHECK(read(cues(2) + wavChunk("LIST", "adtl" + region)).first == std::vector<Marker>{{0.25, "1"}, {0.5, "text"}});
    // Without the byte of padding behind an odd length.
    const auto unpadded =
        "labl" + littleEndian(7, 4) + id(1) + "ab\0"s + "labl" + littleEndian(8, 4) + id(2) + "cde\0"s;
    CHECK(read(cues(2) + wavChunk("LIST", "adtl" + unpadded)).first == std::vector<Marker>{{0.25, "ab"}, {0.5, "cde"}});
}
