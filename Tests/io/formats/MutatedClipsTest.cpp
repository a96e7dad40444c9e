// Files of clips in bits and in archives whose structure is damaged: all of the clip, or a word.

#include "io/formats/ClipFormat.h"
#include "io/formats/hmpg/HmpgBits.h"
#include "io/formats/hmpg/HmpgFields.h"
#include "support/Catch.h"
#include "support/RandomClip.h"

#include <pacini/foundation/Random.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
int wantedOfClips(const char* name, int usual)
{
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : usual;
}

/// A swell and three events.
Clip knownClip()
{
    Clip clip;
    clip.duration = 2.0;
    Band band{70.0, 80.0, 90.0, 0, {}, {}};
    for (int i = 0; i <= 20; ++i)
        band.amplitude.push_back({0.1 * i, 0.5 + 0.4 * std::sin(0.9 * i)});
    clip.bands.push_back(std::move(band));
    for (const double time : {0.25, 0.8, 1.5})
        clip.transients.push_back({time, 0.9, 0.5});
    return clip;
}

/// s over which something is played, and the number of events.
std::pair<double, std::size_t> contentOf(const Clip& clip)
{
    double last = 0.0;
    for (const Band& band : clip.bands)
        if (!band.amplitude.empty())
            last = std::max(last, band.amplitude.back().time - band.amplitude.front().time);
    return {last, clip.transients.size()};
}

/// Places of an HMPG file that say how much follows and of what: heads of units and packets, numbers, and counts.
std::vector<std::size_t> structureOf(const std::string& bytes)
{
    std::vector<std::size_t> places;
    for (std::size_t at = 0; at < bytes.size();)
    {
        HmpgBitReader unit(std::string_view(bytes).substr(at));
        unit.skip(12 + 24);
        const auto end = at + hmpgUnitHeader + static_cast<std::size_t>(unit.take(32));
        for (std::size_t i = 0; i < hmpgUnitHeader; ++i)
            if (i != 1 && i != 2 && i != 3 && i != 4) // when and how long
                places.push_back(at + i);
        for (at += hmpgUnitHeader; at < end;)
        {
            HmpgBitReader packet(std::string_view(bytes).substr(at));
            const auto kind = static_cast<HmpgPacket>(packet.take(6));
            const auto length = static_cast<std::size_t>(packet.take(17));
            // A band's limits are its frequencies, and behind the head of data stand its effects.
            const std::size_t counted = kind == HmpgPacket::band ? 5u : kind == HmpgPacket::data ? 6u : 0u;
            for (std::size_t i = 0; i < hmpgPacketHeader + counted; ++i)
                places.push_back(at + i);
            at += hmpgPacketHeader + length;
        }
    }
    return places;
}

void checkDamage(const ClipFormat& format, const std::string& whole, const std::vector<std::size_t>& places)
{
    const auto known = format.read(whole);
    REQUIRE(known);
    REQUIRE(known->warnings.empty());
    const auto [seconds, events] = contentOf(known->clip);
    REQUIRE(events >= 3);
    Random random(static_cast<std::uint64_t>(wantedOfClips("PACINI_MUTATION_SEED", 20261130)));
    const int rounds = wantedOfClips("PACINI_MUTATIONS", 2000);
    for (int round = 0; round < rounds; ++round)
    {
        auto bytes = whole;
        std::string changed;
        for (int i = 0; i <= round % 4; ++i)
        {
            const auto place = places.empty() ? random.next() % bytes.size() : places[random.next() % places.size()];
            bytes[place] = static_cast<char>(random.next());
            changed += fmt::format("{} = {} ", place, static_cast<unsigned char>(bytes[place]));
        }
        const auto read = format.read(bytes);
        if (!read || !read->warnings.empty())
            continue;
        const auto [secondsRead, eventsRead] = contentOf(read->clip);
        CAPTURE(round, changed);
        CHECK(eventsRead >= events);
        CHECK(secondsRead > seconds - 0.06);
    }
}
} // namespace

TEST_CASE("Damaged structure of an HMPG or a bundle of Pulsar loses nothing in silence", "[io][formats]")
{
    for (const char* name : {"hmpg", "pulsar"})
        DYNAMIC_SECTION(name)
        {
            const ClipFormat* const format = clipFormatNamed(name);
            if (!format)
                continue; // bundles, without libzip
            ExportParams params;
            params.quick = true;
            const auto written = format->write(knownClip(), params);
            REQUIRE(written);
            const auto& bytes = written->files.front().bytes;
            checkDamage(*format, bytes, std::string(name) == "hmpg" ? structureOf(bytes) : std::vector<std::size_t>());
        }
}

TEST_CASE("What an HMPG holds beside what is read, and what it lacks, is told", "[io][hmpg]")
{
    const ClipFormat& format = *clipFormatNamed("hmpg");
    ExportParams params;
    params.quick = true;
    const auto written = format.write(knownClip(), params);
    REQUIRE(written);
    const std::string& whole = written->files.front().bytes;
    std::vector<std::size_t> units;
    for (std::size_t at = 0; at < whole.size();)
    {
        units.push_back(at);
        HmpgBitReader head(std::string_view(whole).substr(at));
        head.skip(12 + 24);
        at += hmpgUnitHeader + static_cast<std::size_t>(head.take(32));
    }
    REQUIRE(units.size() > 3);
    const auto warningsOf = [&](const std::string& bytes)
    {
        const auto read = format.read(bytes);
        REQUIRE(read);
        return read->warnings;
    };
    CHECK(warningsOf(whole).empty());
    // Cut off between two units.
    const auto cut = warningsOf(whole.substr(0, units.at(2)));
    REQUIRE(!cut.empty());
    CHECK(cut.front().starts_with("lacks "));
    // A unit that calls itself silence, and has packets.
    auto silent = whole;
    silent[units.at(1)] = static_cast<char>(3u << 2u);
    const auto said = warningsOf(silent);
    REQUIRE(!said.empty());
    CHECK(said.front().ends_with("content in a silent unit is left out"));
    // Another number of ticks a second on the way.
    HmpgBitWriter timing;
    timing.put(static_cast<std::uint64_t>(HmpgPacket::firstTiming), 6);
    timing.put(hmpgFirstTiming, 17);
    timing.put(0, 1 + 32);
    timing.put(44100, 32);
    timing.put(0, 56);
    HmpgBitWriter unit;
    unit.put(static_cast<std::uint64_t>(HmpgUnit::initialisation), 6);
    unit.put(0, 6 + 24);
    unit.put(timing.bytes().size(), 32);
    unit.put(0, 4);
    const auto twice = format.read(whole + unit.bytes() + timing.bytes());
    REQUIRE(!twice);
    CHECK(twice.error().message.starts_with("has 44100 ticks per second, but "));
}
