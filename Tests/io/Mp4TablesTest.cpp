#include "io/Mp4Tables.h"

#include "io/FileHandle.h"
#include "io/Mp4Bytes.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::vector<Mp4Track> tracksOf(const std::string& bytes, const TempFolder& folder)
{
    const auto path = put(folder / "film", bytes);
    const FileHandle file(std::fopen(path.string().c_str(), "rb"));
    REQUIRE(file != nullptr);
    return mp4Tracks(file.get());
}
} // namespace

TEST_CASE("The tables of an MP4 state its sound", "[io][audio]")
{
    const TempFolder folder;
    for (const std::uint32_t rate : {8000u, 44100u, 48000u})
    {
        const auto tracks = tracksOf(mp4Bytes(60, rate), folder);
        REQUIRE(tracks.size() == 1);
        const double seconds = 60.0 * 1024.0 / rate;
        CHECK(std::abs(tracks[0].seconds - seconds) < 1e-9);
        CHECK(std::abs(tracks[0].played - seconds) < 0.001);
        CHECK(tracks[0].sampleRate == static_cast<int>(rate));
        CHECK(tracks[0].doubts.empty());
    }
    // Encoders state less for the last block, which they filled up.
    for (const std::uint32_t blocks : {2u, 3u, 10u, 40u})
        for (const std::uint32_t last : {1u, 256u, 1023u})
        {
            const auto tracks = tracksOf(mp4Bytes(blocks, 16000, 1, last), folder);
            REQUIRE(tracks.size() == 1);
            CHECK(tracks[0].doubts.empty());
        }
    CHECK(tracksOf("RIFF", folder).empty());
}

TEST_CASE("No damage of an MP4's header shortens its sound in silence", "[io][audio]")
{
    const TempFolder folder;
    const std::string whole = mp4Bytes(60, 16000, 10, 300);
    constexpr double seconds = (59.0 * 1024.0 + 300.0) / 16000.0;
    const auto header = whole.find("mdat");
    const char* wanted = std::getenv("PACINI_MUTATIONS");
    const int rounds = wanted ? std::atoi(wanted) : 2000;
    Random random(20261129);
    int silent = 0, said = 0, without = 0;
    for (int round = 0; round < rounds; ++round)
    {
        auto bytes = whole;
        constexpr unsigned char usual[] = {0, 1, 127, 128, 255};
        for (int i = 0; i <= round % 4; ++i)
        {
            const auto kind = random.next() % 6;
            bytes[8 + random.next() % (header - 8)] = static_cast<char>(kind < 5 ? usual[kind] : random.next());
        }
        CAPTURE(round);
        const auto tracks = tracksOf(bytes, folder);
        // Without such a track, or with another codec, ffmpeg finds no sound either, or decodes all that there is.
        if (tracks.empty() || tracks[0].seconds == 0.0 || bytes.substr(whole.find("mp4a"), 4) != "mp4a")
        {
            ++without;
            continue;
        }
        const Mp4Track& track = tracks[0];
        const bool isSaid = !track.doubts.empty() || track.played + 0.4 < track.seconds;
        (isSaid ? said : silent) += 1;
        if (!isSaid)
            CHECK(track.seconds > 0.97 * seconds);
    }
    CHECK(said > rounds / 20);
    CHECK(silent > rounds / 20);
    CHECK(without < rounds / 2);
}

TEST_CASE("The fragments of an MP4 state its sound, and one behind another is told", "[io][audio]")
{
    const TempFolder folder;
    const auto twice = tracksOf(mp4Bytes(60, 16000) + mp4Bytes(60, 16000), folder);
    REQUIRE(twice.size() == 1);
    CHECK(twice[0].doubts ==
          std::vector<std::string>{"has another film behind it, which is left out; save it as a file of its own"});

    const std::string plain(4, '\0');
    const auto trackOf = [&](std::uint32_t id, const std::string& kind)
    {
        return mp4Box("trak",
                      mp4Box("tkhd", plain + plain + plain + bigEndian(id, 4) + std::string(68, '\0')) +
                          mp4Box("mdia", mp4Box("mdhd", plain + plain + plain + bigEndian(16000, 4) + plain + plain) +
                                             mp4Box("hdlr", plain + plain + kind + std::string(13, '\0'))));
    };
    const std::string movie =
        mp4Box("moov", mp4Box("mvhd", plain + plain + plain + bigEndian(1000, 4) + plain) + trackOf(7, "soun") +
                           trackOf(8, "vide") +
                           mp4Box("mvex", mp4Box("trex", plain + bigEndian(7, 4) + bigEndian(1, 4) +
                                                             bigEndian(1024, 4) + plain + plain)));
    const auto fragment =
        [&](std::uint32_t track, std::uint32_t headerFlags, const std::string& more, const std::string& run)
    {
        return mp4Box("moof",
                      mp4Box("mfhd", plain + bigEndian(1, 4)) +
                          mp4Box("traf", mp4Box("tfhd", bigEndian(headerFlags, 4) + bigEndian(track, 4) + more) +
                                             mp4Box("trun", run))) +
               mp4Box("mdat", std::string(100, 'x'));
    };
    // 10 blocks of the usual length, 5 of 512, two of their own lengths, and others of another track.
    const std::string whole = mp4Box("ftyp", "isom" + plain) + movie +
                              fragment(7, 0, "", bigEndian(1, 4) + bigEndian(10, 4) + plain) +
                              fragment(7, 8, bigEndian(512, 4), bigEndian(0, 4) + bigEndian(5, 4)) +
                              fragment(7, 0, "",
                                       bigEndian(0x300, 4) + bigEndian(2, 4) + bigEndian(1000, 4) + bigEndian(60, 4) +
                                           bigEndian(24, 4) + bigEndian(40, 4)) +
                              fragment(8, 0, "", bigEndian(0, 4) + bigEndian(50, 4));
    const auto tracks = tracksOf(whole, folder);
    REQUIRE(tracks.size() == 2);
    CHECK(tracks[1].seconds == 0.0);
    CHECK(std::abs(tracks[0].played - (10.0 * 1024.0 + 5.0 * 512.0 + 1024.0) / 16000.0) < 1e-9);
    CHECK(tracks[0].doubts.empty());
    CHECK(tracksOf(whole + std::string(100, '\0'), folder)[0].doubts.empty());
    for (const std::string& damaged : {whole.substr(0, whole.size() - 20), whole + "no box at all"})
        CHECK(tracksOf(damaged, folder)[0].doubts.size() == 1);
}

TEST_CASE("No damage of an MP4's fragments shortens its sound in silence", "[io][audio]")
{
    const TempFolder folder;
    const std::string whole = fragmentedMp4Bytes(6, 10, 16000);
    constexpr double seconds = 60.0 * 1024.0 / 16000.0;
    const auto untouched = tracksOf(whole, folder);
    REQUIRE(untouched.size() == 1);
    CHECK(untouched[0].doubts.empty());
    CHECK(std::abs(untouched[0].played - seconds) < 1e-9);
    std::vector<std::size_t> places; // outside of the sound itself
    for (std::size_t at = 8; at < whole.size();)
    {
        const auto data = whole.find("mdat", at);
        for (; at < std::min(data, whole.size()); ++at)
            places.push_back(at);
        at = data == std::string::npos ? whole.size() : whole.find("moof", data) - 4;
        if (at >= whole.size())
            break;
    }
    const char* wanted = std::getenv("PACINI_MUTATIONS");
    const int rounds = wanted ? std::atoi(wanted) : 2000;
    Random random(20261130);
    int silent = 0, said = 0;
    for (int round = 0; round < rounds; ++round)
    {
        auto bytes = whole;
        constexpr unsigned char usual[] = {0, 1, 127, 128, 255};
        for (int i = 0; i <= round % 4; ++i)
        {
            const auto kind = random.next() % 6;
            bytes[places[random.next() % places.size()]] = static_cast<char>(kind < 5 ? usual[kind] : random.next());
        }
        CAPTURE(round);
        const auto tracks = tracksOf(bytes, folder);
        // Without such a track, or with another codec, ffmpeg finds no sound either, or it is told where it does.
        // Another rate is told by what is decoded, since the codec has its own.
        if (tracks.empty() || (tracks[0].seconds == 0.0 && tracks[0].doubts.empty()) || tracks[0].sampleRate != 16000 ||
            bytes.substr(whole.find("mp4a"), 4) != "mp4a")
            continue;
        const bool isSaid = !tracks[0].doubts.empty() || tracks[0].played + 0.4 < tracks[0].seconds;
        (isSaid ? said : silent) += 1;
        if (!isSaid)
            CHECK(tracks[0].seconds > 0.97 * seconds);
    }
    CHECK(said > rounds / 20);
    CHECK(silent > rounds / 20);
}

TEST_CASE("Fragments that are missing at the end or between others are told by what is stated of all", "[io][audio]")
{
    const TempFolder folder;
    const std::string whole = fragmentedMp4Bytes(6, 10, 16000);
    const auto doubtsOf = [&](const std::string& bytes)
    {
        const auto tracks = tracksOf(bytes, folder);
        REQUIRE(tracks.size() == 1);
        return tracks[0].doubts;
    };
    const auto fragment = [](const std::string& bytes, int number)
    {
        auto place = bytes.find("moof");
        for (int i = 1; i < number && place != std::string::npos; ++i)
            place = bytes.find("moof", place + 4);
        return place == std::string::npos ? bytes.size() : place - 4;
    };
    // 60 blocks of 1024 frames at 16 kHz: by the header of the movie, whose unit is 1 ms, or by that of its fragments.
    const std::string plain(4, '\0');
    auto byMovie = whole;
    byMovie.replace(byMovie.find("mvhd") + 20, 4, bigEndian(3840, 4));
    auto byExtent = whole;
    const std::string extent = mp4Box("mehd", plain + bigEndian(3840, 4));
    byExtent.insert(byExtent.find("trex") - 4, extent);
    for (const std::string outer : {"mvex", "moov"})
    {
        const auto size = byExtent.find(outer) - 4;
        std::uint64_t stated = 0;
        for (std::size_t i = 0; i < 4; ++i)
            stated = stated << 8u | static_cast<unsigned char>(byExtent[size + i]);
        byExtent.replace(size, 4, bigEndian(stated + extent.size(), 4));
    }
    for (const std::string& bytes : {byMovie, byExtent})
    {
        CHECK(doubtsOf(bytes).empty());
        CHECK(doubtsOf(bytes.substr(0, fragment(bytes, 4))) ==
              std::vector<std::string>{"has a header that states 3.840 s, but fragments of 1.920 s are there; get a "
                                       "complete copy"});
    }
    // Without times of their own, the numbers of fragments tell which are missing.
    auto untimed = whole;
    for (auto place = untimed.find("tfdt"); place != std::string::npos; place = untimed.find("tfdt"))
        untimed.replace(place, 4, "free");
    CHECK(doubtsOf(untimed).empty());
    CHECK(doubtsOf(untimed.substr(0, fragment(untimed, 3)) + untimed.substr(fragment(untimed, 5))) ==
          std::vector<std::string>{"lacks 2 of its fragments by their numbers; get a complete copy"});
}

TEST_CASE("Times of an MP4 that no block of its codec has are told, whatever table they are in", "[io][audio]")
{
    const TempFolder folder;
    // 1024 frames of 16 kHz are 64 ms; by another unit of time they would be another number of frames. A unit of 32000
    // makes 512 of them, which are blocks of AAC, too.
    for (const std::string& whole : {mp4Bytes(60, 16000), fragmentedMp4Bytes(6, 10, 16000)})
        for (const std::uint32_t scale : {15000u, 16001u, 18000u, 32600u, 32640u, 33000u, 48000u})
        {
            CAPTURE(scale);
            auto bytes = whole;
            bytes.replace(bytes.find("mdhd") + 16, 4, bigEndian(scale, 4));
            const auto tracks = tracksOf(bytes, folder);
            REQUIRE(tracks.size() == 1);
            CHECK(tracks[0].doubts.empty() == (scale == 16001));
        }
}
