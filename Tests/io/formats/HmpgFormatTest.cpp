// HMPG holds what HJIF holds: files that the reference program made of HJIF are read as these, and what is written is
// read as it was but for its steps.

#include "io/formats/hmpg/HmpgFormat.h"

#include "FormatSamples.h"
#include "io/formats/hmpg/HmpgBits.h"
#include "io/formats/hmpg/HmpgFields.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/RandomClip.h"

#include <pacini/synthesis/Decoder.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A file that the reference program (MPEG haptics reference software, develop branch) wrote.
std::string referenceFile(const char* name)
{
    std::ifstream stream(testFolder() / "fuzz" / "corpus" / "hmpg" / name, std::ios::binary);
    REQUIRE(stream);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Steps of an amplitude in the file, and of what the channel's gain makes of it.
constexpr double amplitudeStep = 2.0 / 255.0;

void checkCurves(const Curve& read, const Curve& wanted, double valueMargin, double timeMargin = 0.0)
{
    REQUIRE(read.size() == wanted.size());
    for (std::size_t i = 0; i < read.size(); ++i)
    {
        INFO("point " << i << " at " << wanted[i].time << " s");
        CHECK(std::abs(read[i].time - wanted[i].time) <= timeMargin + 1e-12);
        CHECK(std::abs(read[i].value - wanted[i].value) <= valueMargin);
    }
}

void checkAlike(const Clip& read, const Clip& wanted, double valueMargin)
{
    CHECK(std::abs(read.duration - wanted.duration) <= 1e-9);
    REQUIRE(read.bands.size() == wanted.bands.size());
    for (std::size_t b = 0; b < read.bands.size(); ++b)
    {
        checkCurves(read.bands[b].amplitude, wanted.bands[b].amplitude, valueMargin);
        checkCurves(read.bands[b].pitch, wanted.bands[b].pitch, 1e-9);
        CHECK(read.bands[b].lowFrequency == wanted.bands[b].lowFrequency);
        CHECK(read.bands[b].highFrequency == wanted.bands[b].highFrequency);
    }
    REQUIRE(read.transients.size() == wanted.transients.size());
    for (std::size_t i = 0; i < read.transients.size(); ++i)
    {
        CHECK(read.transients[i].time == wanted.transients[i].time);
        CHECK(std::abs(read.transients[i].amplitude - wanted.transients[i].amplitude) <= 2.0 * valueMargin);
        CHECK(std::abs(read.transients[i].sharpness - wanted.transients[i].sharpness) <= 1e-9);
    }
}

/// A swell of `duration` s at 80 Hz, with a point every second, and nothing else.
Clip swell(double duration, double highest = 0.9)
{
    Clip clip;
    clip.duration = duration;
    Band band{70.0, 80.0, 90.0, 0, {}, {}};
    for (double t = 0.0; t <= duration; t += 1.0)
        band.amplitude.push_back({t, highest * (0.6 + 0.4 * std::sin(0.7 * t))});
    clip.bands.push_back(std::move(band));
    return clip;
}

std::vector<float> drive(const Clip& clip)
{
    DecoderParams params;
    params.sampleRate = 2000.0;
    Decoder decoder(clip, params);
    std::vector<float> samples(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(samples);
    return samples;
}

/// dB of what two drives have in common above their difference.
double likeness(const std::vector<float>& drive, const std::vector<float>& wanted)
{
    double difference = 0.0, power = 0.0;
    for (std::size_t n = 0; n < std::min(drive.size(), wanted.size()); ++n)
    {
        difference += std::pow(static_cast<double>(drive[n] - wanted[n]), 2.0);
        power += std::pow(static_cast<double>(wanted[n]), 2.0);
    }
    return 10.0 * std::log10(power / std::max(difference, 1e-30));
}
} // namespace

TEST_CASE("Files of the MPEG reference program are what they were as HJIF", "[io][hmpg]")
{
    const auto bytes = referenceFile("everything");
    REQUIRE(isHmpg(bytes));
    CHECK(clipFormatOf(".hmpg", bytes)->name == "hmpg");
    CHECK(clipFormatOf(".bin", bytes)->name == "hmpg");
    const auto read = readHmpg(bytes);
    REQUIRE(read);
    const auto wanted = readHjif(hjifSample());
    REQUIRE(wanted);
    CHECK(read->clip.name == wanted->clip.name);
    checkAlike(read->clip, wanted->clip, amplitudeStep); // the reference program cuts to the step below
    CHECK(read->warnings == wanted->warnings);
}

TEST_CASE("Wavelets of the MPEG reference program are read from HMPG", "[io][hmpg]")
{
    std::ifstream stream(testFolder() / "fuzz" / "corpus" / "hjif" / "wavelets", std::ios::binary);
    auto tree = nlohmann::json::parse(stream);
    for (auto& band : tree["perceptions"][0]["channels"][0]["bands"])
        if (band["band_type"] == "WaveletWave")
            band["effects"].erase(band["effects"].begin() + 1,
                                  band["effects"].end()); // that program writes one in 128 ms
    const auto wanted = readHjif(tree.dump());
    const auto read = readHmpg(referenceFile("wavelets"));
    REQUIRE(wanted);
    REQUIRE(read);
    CHECK(likeness(drive(read->clip), drive(wanted->clip)) > 30.0);
}

TEST_CASE("HMPG is written as the reference program writes it", "[io][hmpg]")
{
    // Its file, but for amplitudes and phases that are rounded here and cut there, and fields without meaning.
    const auto read = readHmpg(referenceFile("reference"));
    REQUIRE(read);
    ExportParams params;
    params.events = EventExport::transients;
    const auto written = writeHmpg(read->clip, params);
    REQUIRE(written);
    const std::string& bytes = written->files.front().bytes;
    CHECK(isHmpg(bytes));
    CHECK(bytes.substr(0, 5) == referenceFile("reference").substr(0, 5));
    CHECK(bytes.substr(9, 70) == referenceFile("reference").substr(9, 70)); // timing and head, behind the unit's length
    const auto again = readHmpg(bytes);
    REQUIRE(again);
    CHECK(again->clip.transients.size() == read->clip.transients.size());
    CHECK(std::abs(again->clip.duration - read->clip.duration) < 0.002);
    const auto text = readHjif(writeHjif(read->clip, params)->files.front().bytes);
    REQUIRE(text);
    CHECK(likeness(drive(again->clip), drive(text->clip)) > 30.0);
}

TEST_CASE("HMPG keeps what HJIF keeps, but for its steps", "[io][hmpg]")
{
    for (unsigned seed = 1; seed <= 20; ++seed)
    {
        INFO("clip " << seed);
        const Clip clip = randomFullClip(seed);
        ExportParams params;
        params.quick = true;
        const auto text = writeHjif(clip, params);
        const auto bits = writeHmpg(clip, params);
        REQUIRE(text.ok() == bits.ok());
        if (!text)
            continue;
        CHECK(bits->files.front().bytes.size() < text->files.front().bytes.size() / 2);
        const auto fromText = readHjif(text->files.front().bytes);
        const auto fromBits = readHmpg(bits->files.front().bytes);
        REQUIRE(fromText);
        REQUIRE(fromBits);
        CHECK(std::abs(fromText->clip.duration - fromBits->clip.duration) < 1e-9);
        CHECK(fromText->clip.bands.size() == fromBits->clip.bands.size());
    }
}

TEST_CASE("Waves of more than a minute go on in further effects of HMPG", "[io][hmpg]")
{
    const Clip clip = swell(200.0);
    const auto written = writeHmpg(clip, {});
    REQUIRE(written);
    const auto read = readHmpg(written->files.front().bytes);
    REQUIRE(read);
    CHECK(std::abs(read->clip.duration - 200.0) < 0.01);
    CHECK(likeness(drive(read->clip), drive(clip)) > 30.0); // phases go on too
}

TEST_CASE("Quiet clips use the steps of HMPG", "[io][hmpg]")
{
    for (const double highest : {1.0, 0.3, 0.13})
    {
        INFO("highest " << highest);
        const Clip clip = swell(5.0, highest);
        const auto written = writeHmpg(clip, {});
        REQUIRE(written);
        const auto read = readHmpg(written->files.front().bytes);
        REQUIRE(read);
        CHECK(likeness(drive(read->clip), drive(clip)) > 35.0);
    }
}

TEST_CASE("HMPG that is cut off, or refers to nothing, is refused with the byte", "[io][hmpg]")
{
    const std::string whole = referenceFile("everything");
    const auto all = readHmpg(whole);
    REQUIRE(all);
    std::size_t complete = 0;
    for (std::size_t length = 0; length < whole.size(); ++length)
    {
        const auto read = readHmpg(std::string_view(whole).substr(0, length));
        if (read) // only where a unit ends: the format says nowhere how many there are
            ++complete;
        else
            CHECK(!read.error().text().empty());
    }
    CHECK(complete <= 12);

    std::string noBand = whole; // a band's number in the first packet of data
    const std::size_t data = noBand.find(std::string("\x14\x00", 2), 300);
    REQUIRE(data != std::string::npos);
    noBand[data + 6] = '\x7f';
    noBand[data + 5] = '\x7f';
    const auto read = readHmpg(noBand);
    CHECK(!read);
}

TEST_CASE("Unknown packets and units of HMPG are left out with a word", "[io][hmpg]")
{
    const std::string whole = referenceFile("reference");
    const auto silentKind = [](unsigned kind)
    {
        HmpgBitWriter unit;
        unit.put(kind, 6);
        unit.put(0, 2 + 4);
        unit.put(0, 24);
        unit.put(2, 32);
        unit.put(0, 4);
        unit.put(0, 16);
        return unit.bytes();
    };
    for (const unsigned kind : {2u, 9u})
    {
        const auto read = readHmpg(whole + silentKind(kind));
        REQUIRE(read);
        CHECK(read->warnings.size() == readHmpg(whole)->warnings.size() + 1);
        CHECK(read->warnings.front().find("is left out") != std::string::npos);
    }
    const auto many = readHmpg(whole + silentKind(9) + silentKind(9));
    REQUIRE(many);
    CHECK(many->warnings.size() == readHmpg(whole)->warnings.size() + 1); // once for each kind
}

TEST_CASE("Bits are packed from the most significant one", "[io][hmpg]")
{
    HmpgBitWriter writer;
    writer.put(5, 3);
    writer.put(0x1234, 16);
    writer.put(static_cast<std::uint64_t>(-3), 25);
    writer.putText("ab");
    HmpgBitReader reader(writer.bytes());
    CHECK(reader.take(3) == 5);
    CHECK(reader.take(16) == 0x1234);
    CHECK(reader.takeSigned(25) == -3);
    CHECK(reader.takeText() == "ab");
    CHECK(!reader.failed());
    CHECK(reader.take(8) == 0); // what fills the last byte, and less than that
    CHECK(reader.failed());
}
