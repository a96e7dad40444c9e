// The initial phase of a band in files: those of Pacini and CSV keep it, MPEG's carries it on, the others say that they
// leave it out.

#include "io/ClipSeal.h"
#include "io/formats/ClipFormat.h"
#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/ClipSamples.h"

#include <pacini/clip/PackedClip.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace pacini;

namespace
{
/// A clip of two bands, the second at this phase.
Clip twoBands(double phase)
{
    Clip clip = test::steadyClip(100.0, 0.5, 1.0);
    clip.bands.push_back({200.0, 250.0, 300.0, 1, {{0.0, 0.25}, {1.0, 0.5}}, {}, phase});
    return clip;
}

ExportedClip writtenAs(const char* name, const Clip& clip)
{
    const ClipFormat* format = clipFormatNamed(name);
    REQUIRE(format != nullptr);
    auto exported = format->write(clip, {});
    REQUIRE(exported);
    return *exported;
}

bool tellsOfPhase(const ExportedClip& exported)
{
    return std::any_of(exported.losses.begin(), exported.losses.end(),
                       [](const FormatLoss& loss) { return loss.message.find("phase") != std::string::npos; });
}
} // namespace

TEST_CASE("JSON, packed clips and CSV keep the initial phase of a band", "[io][formats]")
{
    for (const double phase : {0.25, 0.5, 1234.0 / 4096.0})
        for (const char* name : {"json", "packed", "csv"})
        {
            CAPTURE(name, phase);
            const ExportedClip exported = writtenAs(name, twoBands(phase));
            CHECK_FALSE(tellsOfPhase(exported));
            const auto read = clipFormatNamed(name)->read(exported.files.at(0).bytes, true);
            REQUIRE(read);
            REQUIRE(read->clip.bands.size() == 2);
            CHECK(read->clip.bands[0].phase == 0.0);
            CHECK(read->clip.bands[1].phase == phase);
        }
    CHECK(readClipJson(writeClipJson(twoBands(0.1))).value() == twoBands(0.1));
}

TEST_CASE("A clip without phases has the files it had", "[io][formats]")
{
    CHECK(writeClipJson(twoBands(0.0)).find("phase") == std::string::npos);
    CHECK(writtenAs("csv", twoBands(0.0)).files.at(0).bytes.find("phase") == std::string::npos);
    CHECK(writtenAs("packed", twoBands(0.0)).files.at(0).bytes.at(4) == 1);
    CHECK(writtenAs("packed", twoBands(0.25)).files.at(0).bytes.at(4) == 2);
}

TEST_CASE("A seal from before phases holds, and a phase that is changed breaks it", "[io]")
{
    Clip clip = test::steadyClip(100.0, 0.5, 1.0);
    sealClip(clip);
    REQUIRE(clip.encoder.size() == 1);
    CHECK(clip.encoder[0].value == EncoderParameter{"", 3390436435.0}.value); // as written by version 0.1
    CHECK(sealOf(clip) == ClipSeal::whole);
    clip.bands[0].phase = 0.25;
    CHECK(sealOf(clip) == ClipSeal::broken);
    clip = onGrids(clip);
    sealClip(clip);
    CHECK(sealOf(clip) == ClipSeal::whole);
    CHECK(sealOf(unpackClip(packClip(clip)).value()) == ClipSeal::whole);
}

TEST_CASE("A wrong phase in JSON or CSV is an error at its place", "[io][formats]")
{
    for (const char* value : {"-0.1", "1.5", "1e300", "\"half\""})
    {
        CAPTURE(value);
        const auto read =
            readClipJson(std::string(R"({"format": "pacini.clip", "version": 1, "duration": 1, "bands": [)") +
                         R"({"lowFrequency": 80, "centreFrequency": 100, "highFrequency": 125, "amplitude": [], )" +
                         R"("phase": )" + value + "}]}");
        REQUIRE_FALSE(read);
        CHECK(read.error().where == "bands[0].phase");
    }
    const auto csv = [](const std::string& rows)
    {
        return clipFormatNamed("csv")->read("time,amplitude 80 100 125,phase 80 100 125\n" + rows);
    };
    CHECK(csv("0,0.5,0.25\n1,0.5,\n"));
    for (const char* rows : {"0,0.5,1.25\n", "0,0.5,-1\n", "0,0.5,\n0.5,0.5,0.25\n"})
    {
        CAPTURE(rows);
        CHECK_FALSE(csv(rows));
    }
}

TEST_CASE("Formats of one voice tell that they leave out the phase", "[io][formats]")
{
    for (const char* name : {"ahap", "haptic", "haps"})
    {
        CAPTURE(name);
        CHECK(tellsOfPhase(writtenAs(name, twoBands(0.25))));
        CHECK_FALSE(tellsOfPhase(writtenAs(name, twoBands(0.0))));
    }
}

TEST_CASE("MPEG's files start a wave at its phase", "[io][formats]")
{
    // 0.25 cycles are pi / 2.
    const auto with = writtenAs("hjif", twoBands(0.25)).files.at(0).bytes;
    const auto without = writtenAs("hjif", twoBands(0.0)).files.at(0).bytes;
    CHECK(with.find("\"phase\":1.571") != std::string::npos);
    CHECK(without.find("\"phase\":1.571") == std::string::npos);
}

TEST_CASE("MPEG's files give the phase of a band back, in text and in bits", "[io][formats]")
{
    for (const char* name : {"hjif", "hmpg"})
        for (const double phase : {0.0, 0.25, 0.7})
        {
            CAPTURE(name, phase);
            const auto read = clipFormatNamed(name)->read(writtenAs(name, twoBands(phase)).files.at(0).bytes);
            REQUIRE(read);
            REQUIRE(read->clip.bands.size() == 2);
            CHECK(read->clip.bands[0].phase == 0.0);
            CHECK(read->clip.bands[1].phase == Approx(phase).margin(1e-3));
            // And again the same file.
            CHECK(writtenAs(name, read->clip).losses.size() == writtenAs(name, twoBands(phase)).losses.size());
        }
    // A wave that begins late says nothing of the start, as its frequency is a whole number of Hz.
    Clip late = twoBands(0.25);
    late.bands[1].amplitude = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {1.0, 0.5}};
    const auto read = clipFormatNamed("hjif")->read(writtenAs("hjif", late).files.at(0).bytes);
    REQUIRE(read);
    for (const Band& band : read->clip.bands)
        CHECK(band.phase == 0.0);
}

TEST_CASE("A phase in an MPEG file that is no angle of one turn is read as one", "[io][formats]")
{
    const std::string file = writtenAs("hjif", twoBands(0.25)).files.at(0).bytes;
    for (const auto& [text, cycles] : {std::pair("-1.571", 0.75), std::pair("7.854", 0.25), std::pair("1e300", -1.0)})
    {
        CAPTURE(text);
        std::string changed = file;
        changed.replace(changed.find("1.571"), 5, text);
        const auto read = clipFormatNamed("hjif")->read(changed);
        REQUIRE(read);
        const double phase = read->clip.bands.back().phase;
        CHECK((phase >= 0.0 && phase <= 1.0));
        if (cycles >= 0.0)
            CHECK(phase == Approx(cycles).margin(1e-3));
    }
}
