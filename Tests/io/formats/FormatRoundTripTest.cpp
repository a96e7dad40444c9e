// What a format can say comes back when a clip made of it is written again.

#include "io/formats/FormatSamples.h"
#include "io/formats/players/AndroidPlayer.h"
#include "io/formats/players/HjifPlayer.h"
#include "support/Catch.h"
#include "support/RandomClip.h"

#include <cmath>

using namespace pacini;

namespace
{
constexpr double timeMargin = 0.0005 + 1e-9; // s
constexpr double valueMargin = 1.0 / 255.0;

ImportedClip readBack(const ClipFormat& format, const std::string& text)
{
    const auto read = format.read(text);
    CAPTURE(format.name, text.substr(0, 300), read ? "" : read.error().text());
    REQUIRE(read);
    return *read;
}

std::string written(const ClipFormat& format, const Clip& clip)
{
    const auto exported = format.write(clip, {});
    REQUIRE(exported);
    return exported->files.at(0).bytes;
}

/// Both curves over the time of both: at every point of either the other has that value within reach of 0.5 ms.
void checkCurves(const Curve& a, const Curve& b, double duration, double margin)
{
    const auto near = [&](const Curve& curve, double time, double value)
    {
        double least = 1e300;
        for (int i = -10; i <= 10; ++i)
        {
            const double t = time + 0.1 * i * timeMargin;
            for (const double at : {t, std::nextafter(t, 0.0)})
                least = std::min(least, std::abs(valueAt(curve, at) - value));
        }
        for (const Breakpoint& point : curve) // both sides of steps
            if (std::abs(point.time - time) <= timeMargin)
                least = std::min(least, std::abs(point.value - value));
        return least <= margin;
    };
    for (const Breakpoint& point : a)
    {
        CAPTURE(point.time, point.value, duration);
        CHECK(near(b, point.time, point.value));
    }
    for (const Breakpoint& point : b)
    {
        CAPTURE(point.time, point.value, duration);
        CHECK(near(a, point.time, point.value));
    }
}

void checkSameClip(const Clip& a, const Clip& b, double pitchMargin = 1e-3)
{
    CHECK(b.duration == Approx(a.duration).margin(timeMargin));
    REQUIRE(a.bands.size() == b.bands.size());
    for (std::size_t i = 0; i < a.bands.size(); ++i)
    {
        CAPTURE(i);
        checkCurves(a.bands[i].amplitude, b.bands[i].amplitude, a.duration, valueMargin);
        CHECK(a.bands[i].pitch.empty() == b.bands[i].pitch.empty());
        if (a.bands[i].pitch.empty())
            CHECK(b.bands[i].centreFrequency == Approx(a.bands[i].centreFrequency).margin(pitchMargin));
        for (const Breakpoint& point : a.bands[i].pitch)
            CHECK(valueAt(b.bands[i].pitch, point.time) == Approx(point.value).epsilon(pitchMargin));
    }
    REQUIRE(a.transients.size() == b.transients.size());
    for (std::size_t i = 0; i < a.transients.size(); ++i)
    {
        CHECK(b.transients[i].time == Approx(a.transients[i].time).margin(timeMargin));
        CHECK(b.transients[i].amplitude == Approx(a.transients[i].amplitude).margin(valueMargin));
        CHECK(b.transients[i].sharpness == Approx(a.transients[i].sharpness).margin(valueMargin));
    }
}

void checkRoundTrip(const ClipFormat& format, const std::string& text)
{
    const Clip first = readBack(format, text).clip;
    const std::string again = written(format, first);
    CAPTURE(format.name, again.substr(0, 2000));
    const Clip second = readBack(format, again).clip;
    checkSameClip(first, second);
    CHECK(written(format, second) == written(format, readBack(format, written(format, second)).clip));
}
} // namespace

TEST_CASE("HJIF comes back from a clip as it was", "[formats]")
{
    checkRoundTrip(*clipFormatNamed("hjif"), test::hjifSample());
}

TEST_CASE("The parts of an HJIF file are read as what they say", "[formats]")
{
    const ImportedClip read = readBack(*clipFormatNamed("hjif"), test::hjifSample());
    CHECK(read.warnings.empty());
    REQUIRE(read.clip.bands.size() == 2);
    const Band& low = read.clip.bands[0];
    CHECK(low.lowFrequency == 40.0);
    CHECK(low.highFrequency == 120.0);
    CHECK(valueAt(low.amplitude, 0.15) == Approx(0.8));
    CHECK(valueAt(low.amplitude, 0.5) == 0.0); // between effects
    CHECK(valueAt(low.amplitude, 0.6) == Approx(0.5));
    CHECK(valueAt(low.amplitude, 1.0) == Approx(0.4)); // by reference
    CHECK(valueAt(low.pitch, 0.222) == Approx(90.0));
    CHECK(read.clip.bands[1].pitch.empty());
    CHECK(read.clip.bands[1].centreFrequency == 200.0);
    REQUIRE(read.clip.transients.size() == 3);
    CHECK(read.clip.transients[0].sharpness == Approx((100.0 - 65.0) / 235.0));
    CHECK(read.clip.transients[2].time == Approx(0.7)); // the short wave
    CHECK(read.clip.transients[2].amplitude == Approx(0.7));
    CHECK(read.clip.transients[2].sharpness == Approx(std::log(2.5) / std::log(2.8)));
}

TEST_CASE("A drawn curve of HJIF becomes the sinusoid that it draws", "[formats]")
{
    std::string keyframes;
    for (int i = 0; i < 50; ++i) // extrema every 5 ms: 100 Hz
        keyframes += (i > 0 ? ", " : "") + std::string("{\"relative_position\": ") + std::to_string(5 * i) +
                     ", \"amplitude_modulation\": " + (i % 2 == 0 ? "0.5" : "-0.5") + "}";
    const auto read = readBack(*clipFormatNamed("hjif"), test::hjifWith(R"({"band_type": "Curve", "curve_type": "Cubic",
        "lower_frequency_limit": 0, "upper_frequency_limit": 300, "effects": [{"effect_type": "Basis", "position": 0,
        "keyframes": [)" + keyframes + "]}]}"));
    REQUIRE(read.clip.bands.size() == 1);
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.1) == Approx(0.5));
    CHECK(read.clip.bands[0].centreFrequency == Approx(100.0));
}

TEST_CASE("Steps and points within a millisecond stay what they are in HJIF", "[formats]")
{
    Clip clip;
    clip.duration = 2.0;
    clip.bands = {{90.0, 100.0, 110.0, 0, {}, {{0.0, 100.0}}}};
    clip.bands[0].amplitude = {{0.0, 0.2},    {0.5, 0.2},    {0.5, 0.6},    {1.0, 0.6},    {1.0, 0.1}, {1.2, 0.1},
                               {1.2001, 0.4}, {1.2002, 0.3}, {1.2003, 0.8}, {1.2011, 0.5}, {1.6, 0.5}, {2.0, 0.0}};
    const ImportedClip read = readBack(*clipFormatNamed("hjif"), written(*clipFormatNamed("hjif"), clip));
    REQUIRE(read.clip.bands.size() == 1);
    for (double time = 0.0; time < 2.0; time += 0.01)
    {
        CAPTURE(time);
        double nearest = 1.0;
        for (const double moved : {-0.0021, -0.0011, 0.0, 0.0011, 0.0021}) // points of one millisecond take turns
            nearest = std::min(nearest, std::abs(valueAt(read.clip.bands[0].amplitude, time + moved) -
                                                 valueAt(clip.bands[0].amplitude, time)));
        CHECK(nearest < 0.005);
    }
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.499) == Approx(0.2).margin(0.001));
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.502) == Approx(0.6).margin(0.001));
    CHECK(valueAt(read.clip.bands[0].amplitude, 1.1) == Approx(0.1).margin(0.001));
    CHECK(valueAt(read.clip.bands[0].amplitude, 1.4) == Approx(0.5).margin(0.001));
}

TEST_CASE("The names in a C array are those of the clip, as C has names", "[formats]")
{
    Clip clip;
    clip.duration = 0.1;
    clip.name = "2 Azure-buzz!";
    const auto exported = writeCArray(clip, {});
    REQUIRE(exported);
    const std::string& text = exported->files.at(0).bytes;
    CAPTURE(text.substr(0, 300));
    CHECK(text.starts_with("#ifndef HAPTIC_CLIP_2_AZURE_BUZZ_H\n#define HAPTIC_CLIP_2_AZURE_BUZZ_H\n"));
    CHECK(text.find("#define HAPTIC_CLIP_2_AZURE_BUZZ_SAMPLE_RATE 8000\n") != std::string::npos);
    CHECK(text.find("#define HAPTIC_CLIP_2_AZURE_BUZZ_LENGTH 800\n") != std::string::npos);
    CHECK(text.find("int8_t haptic_clip_2_azure_buzz[HAPTIC_CLIP_2_AZURE_BUZZ_LENGTH]") != std::string::npos);
    CHECK(isCArray(text));
}

TEST_CASE("Channels of HJIF are merged with a warning", "[formats]")
{
    std::string text = test::hjifSample();
    const std::size_t channel = text.find("{\"id\": 0, \"description\": \"\", \"gain\"");
    const std::size_t end = text.rfind("]}]}");
    const std::string other = text.substr(channel, end - channel);
    text.insert(end, ", " + other);
    const auto read = readBack(*clipFormatNamed("hjif"), text);
    REQUIRE(read.warnings.size() == 1);
    CHECK(read.warnings[0].find("2 channels") != std::string::npos);
    CHECK(read.clip.bands.size() == 4);
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.15) == Approx(0.4));
}

TEST_CASE("Android's envelopes and waveforms come back from a clip as they were", "[formats]")
{
    const auto section = [](const std::string& text, const char* name)
    {
        return nlohmann::json{{name, nlohmann::json::parse(text).at(name)}}.dump();
    };
    for (const char* name : {"waveformEnvelope", "basicEnvelope", "waveform"})
    {
        const std::string text = std::string(name) == "waveform" ? test::androidWaveformSample()
                                                                 : test::androidEnvelopeSample(name[0] == 'b');
        const Clip first = readBack(*clipFormatNamed("android"), text).clip;
        const std::string again = section(written(*clipFormatNamed("android"), first), name);
        CAPTURE(name, again);
        checkSameClip(first, readBack(*clipFormatNamed("android"), again).clip);
    }
}

TEST_CASE("Android's rules hold for every clip", "[formats]")
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
        const Clip clip = test::randomFullClip(seed);
        CAPTURE(seed);
        const auto root = nlohmann::json::parse(written(*clipFormatNamed("android"), clip));
        const auto& waveform = root.at("waveform");
        REQUIRE(waveform.at("timings").size() == waveform.at("amplitudes").size());
        double sum = 0.0;
        for (std::size_t i = 0; i < waveform.at("timings").size(); ++i)
        {
            const double length = waveform.at("timings").at(i).get<double>();
            const int level = waveform.at("amplitudes").at(i).get<int>();
            CHECK(length >= 1.0);
            CHECK((level >= 0 && level <= 255));
            // No 0 inside a texture.
            CHECK((level > 0 || length >= 50.0 || i == 0 || i + 1 == waveform.at("timings").size()));
            sum += length;
        }
        CHECK(sum == Approx(1000.0 * clip.duration).margin(1.0));
        for (const bool isBasic : {true, false})
        {
            const auto& points = root.at(isBasic ? "basicEnvelope" : "waveformEnvelope").at("controlPoints");
            REQUIRE(!points.empty());
            CHECK(points.back().at(isBasic ? "intensity" : "amplitude") == 0);
            for (const auto& point : points)
            {
                const double length = point.at("durationMs").get<double>();
                CHECK((length >= 1.0 && length <= 1000.0));
                const double level = point.at(isBasic ? "intensity" : "amplitude").get<double>();
                CHECK((level >= 0.0 && level <= 1.0));
            }
        }
    }
}

TEST_CASE("A .haps file comes back from a clip as it was", "[formats]")
{
    checkRoundTrip(*clipFormatNamed("haps"), test::hapsSample());
}

TEST_CASE("A .tact file comes back from a clip as it was", "[formats]")
{
    checkRoundTrip(*clipFormatNamed("tact"), test::tactSample());
    const Clip clip = readBack(*clipFormatNamed("tact"), test::tactSample()).clip;
    CHECK(clip.duration == Approx(0.5));
    REQUIRE(clip.bands.size() == 1);
    CHECK(valueAt(clip.bands[0].amplitude, 0.02) == 0.0);
    CHECK(valueAt(clip.bands[0].amplitude, 0.10) == 0.75);
    CHECK(valueAt(clip.bands[0].amplitude, 0.30) == 0.0);
    CHECK(valueAt(clip.bands[0].amplitude, 0.40) == 1.0);
}

TEST_CASE("A table keeps all curves of a clip exactly", "[formats]")
{
    checkRoundTrip(*clipFormatNamed("csv"), test::csvSample());
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
        Clip clip = test::randomFullClip(seed);
        const Clip back = readBack(*clipFormatNamed("csv"), written(*clipFormatNamed("csv"), clip)).clip;
        CAPTURE(seed);
        CHECK(back.duration == clip.duration);
        CHECK(back.envelope == clip.envelope);
        CHECK(back.centroid == clip.centroid);
        CHECK(back.transients == clip.transients);
        REQUIRE(back.bands.size() == clip.bands.size());
        for (std::size_t i = 0; i < clip.bands.size(); ++i)
        {
            CHECK(back.bands[i].lowFrequency == clip.bands[i].lowFrequency);
            CHECK(back.bands[i].amplitude == clip.bands[i].amplitude);
            CHECK(back.bands[i].pitch == clip.bands[i].pitch);
        }
        REQUIRE(back.noise.size() == clip.noise.size());
        for (std::size_t i = 0; i < clip.noise.size(); ++i)
            CHECK(back.noise[i] == clip.noise[i]);
    }
}

TEST_CASE("Every format writes every clip, the same bytes each time, and reads what it wrote", "[formats][slow]")
{
    for (const ClipFormat& format : clipFormats())
        for (std::uint64_t seed = 0; seed <= 6 && format.isWritten(); ++seed)
        {
            Clip clip;
            if (seed > 0)
                clip = test::randomFullClip(seed, 10);
            CAPTURE(format.name, seed);
            const auto first = format.write(clip, {});
            const auto second = format.write(clip, {});
            REQUIRE(first);
            CHECK(first->files.at(0).bytes == second->files.at(0).bytes);
            CHECK(first->losses == second->losses);
            const ClipFormat* told = clipFormatOf(format.extension, first->files.at(0).bytes);
            CHECK((told == &format || format.extension == ".wav")); // which is read as a sound
            CHECK(std::is_sorted(first->losses.begin(), first->losses.end(),
                                 [](const FormatLoss& a, const FormatLoss& b) { return a.time < b.time; }));
            if (format.isRead())
            {
                const auto back = format.read(first->files.at(0).bytes);
                CAPTURE(back ? "" : back.error().text());
                REQUIRE(back);
                CHECK(back->clip.duration == Approx(clip.duration).margin(0.0255));
            }
        }
}
