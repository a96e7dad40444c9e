#include "support/Catch.h"

#include <pacini/clip/BandTiling.h>
#include <pacini/clip/Clip.h>
#include <pacini/clip/ClipText.h>
#include <pacini/clip/GridCurve.h>
#include <pacini/clip/PackedCurves.h>
#include <pacini/clip/Quantiser.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

Clip ruledClip()
{
    Clip clip;
    clip.duration = 1.0;
    clip.source = {"a.wav", 48000.0, 2};
    clip.envelope = {{0.0, 0.5}, {1.0, 0.25}};
    clip.centroid = {{0.0, 100.0}};
    clip.bands = {{50.0, 75.0, 100.0, 0, {{0.0, 0.5}}, {{0.0, 70.0}}}, {100.0, 150.0, 200.0, 1, {}, {}}};
    clip.transients = {{0.25, 0.5, 0.5}, {0.25, 0.5, 0.5}};
    clip.noise = {{10.0, 20.0, {{0.5, 0.5}}}};
    clip.markers = {{0.5, "m"}, {0.5, "n"}};
    return clip;
}

/// What validate() has against the clip after a change.
std::string ruleBroken(const std::function<void(Clip&)>& change, ErrorCode code = ErrorCode::invalidData)
{
    Clip clip = ruledClip();
    change(clip);
    const auto valid = validate(clip);
    if (valid.ok())
        return "";
    CHECK(valid.error().code == code);
    return valid.error().text();
}

} // namespace

TEST_CASE("What a clip does not say is 0", "[clip]")
{
    CHECK(Breakpoint{} == Breakpoint{0.0, 0.0});
    CHECK(Band{} == Band{0.0, 0.0, 0.0, 0, {}, {}});
    CHECK(Transient{} == Transient{0.0, 0.0, 0.0});
    CHECK(NoiseBand{} == NoiseBand{0.0, 0.0, {}});
    CHECK(Marker{} == Marker{0.0, ""});
    CHECK(ClipSource{} == ClipSource{"", 0.0, 0});
    CHECK(Clip{}.duration == 0.0);
    CHECK(GridPoint{} == GridPoint{0, 0});
}

TEST_CASE("Every number of a clip may reach the ends of its range and go no further", "[clip]")
{
    REQUIRE(validate(ruledClip()).ok());
    REQUIRE(validate(Clip{}).ok());
    struct Case
    {
        std::string where;
        std::function<double&(Clip&)> number;
        double low, high;
        std::string highest; ///< in the message; empty: it is about another rule
    };
    const auto inf = std::numeric_limits<double>::infinity();
    const std::vector<Case> cases = {
        {"source.sampleRate", [](Clip& c) -> double& { return c.source.sampleRate; }, 0.0, 1e9, "1000000000"},
        {"envelope[1].amplitude", [](Clip& c) -> double& { return c.envelope[1].value; }, 0.0, 1000.0, "1000"},
        {"centroid[0].frequency", [](Clip& c) -> double& { return c.centroid[0].value; }, 0.0, 4e5, "400000"},
        {"bands[0].amplitude[0].amplitude", [](Clip& c) -> double& { return c.bands[0].amplitude[0].value; }, 0.0,
         1000.0, "1000"},
        {"bands[0].pitch[0].frequency", [](Clip& c) -> double& { return c.bands[0].pitch[0].value; }, 1e-3, 4e5,
         "400000"},
        {"bands[1].highFrequency", [](Clip& c) -> double& { return c.bands[1].highFrequency; }, 150.0, 4e5, "400000"},
        {"bands[0].lowFrequency", [](Clip& c) -> double& { return c.bands[0].lowFrequency; }, 0.0, 75.0, ""},
        {"transients[0].amplitude", [](Clip& c) -> double& { return c.transients[0].amplitude; }, 0.0, 1000.0, "1000"},
        {"transients[1].sharpness", [](Clip& c) -> double& { return c.transients[1].sharpness; }, 0.0, 1.0, "1"},
        {"noise[0].lowFrequency", [](Clip& c) -> double& { return c.noise[0].lowFrequency; }, 0.0, 20.0, ""},
        {"noise[0].highFrequency", [](Clip& c) -> double& { return c.noise[0].highFrequency; }, 10.0, 4e5, "400000"},
        {"noise[0].amplitude[0].amplitude", [](Clip& c) -> double& { return c.noise[0].amplitude[0].value; }, 0.0,
         1000.0, "1000"},
    };
    for (const Case& test : cases)
    {
        CAPTURE(test.where);
        const auto with = [&](double value, ErrorCode code = ErrorCode::invalidData)
        {
            return ruleBroken([&](Clip& clip) { test.number(clip) = value; }, code);
        };
        CHECK(with(test.low).empty());
        CHECK(with(test.high).empty());
        const double step = 1e-9 * std::max(1.0, test.high);
        CHECK_FALSE(with(test.low - step).empty());
        CHECK_FALSE(with(test.high + step).empty());
        CHECK(with(inf, ErrorCode::notFinite) == test.where + ": is not a finite number");
        CHECK(with(std::nan(""), ErrorCode::notFinite) == test.where + ": is not a finite number");
        if (!test.highest.empty() && test.low == 0.0)
            CHECK(with(test.high + step) == test.where + ": is outside 0 to " + test.highest);
    }
    CHECK(ruleBroken([](Clip& c) { c.duration = 86400.0; }).empty());
    CHECK(ruleBroken([](Clip& c) { c.duration = 86400.001; }) == "duration: is outside 0 to 86400");
    CHECK(ruleBroken([](Clip& c) { c.duration = -1e-9; }) == "duration: is outside 0 to 86400");
    CHECK(ruleBroken([](Clip& c) { c.bands[0].pitch[0].value = 0.0009; }) ==
          "bands[0].pitch[0].frequency: is outside 0.001 to 400000");
    CHECK(ruleBroken([](Clip& c) { c.source.channels = 0; }).empty());
    CHECK(ruleBroken([](Clip& c) { c.source.channels = -1; }) == "source.channels: is negative");
    CHECK(ruleBroken([](Clip& c) { c.bands[0].lowFrequency = 76.0; }) ==
          "bands[0]: needs lowFrequency <= centreFrequency <= highFrequency");
    CHECK(ruleBroken([](Clip& c) { c.bands[0].highFrequency = 74.0; }) ==
          "bands[0]: needs lowFrequency <= centreFrequency <= highFrequency");
    CHECK(ruleBroken([](Clip& c) { c.bands[0].lowFrequency = c.bands[0].highFrequency = 75.0; }).empty());
    CHECK(ruleBroken([](Clip& c) { c.noise[0].highFrequency = 9.0; }) ==
          "noise[0].highFrequency: is outside 10 to 400000");
}

TEST_CASE("Times of a clip are in order and end with it, give or take a microsecond", "[clip]")
{
    struct Case
    {
        std::string where;
        std::function<double&(Clip&)> time;
        bool curve;
    };
    const std::vector<Case> cases = {
        {"envelope[1].time", [](Clip& c) -> double& { return c.envelope[1].time; }, true},
        {"centroid[0].time", [](Clip& c) -> double& { return c.centroid[0].time; }, true},
        {"bands[0].amplitude[0].time", [](Clip& c) -> double& { return c.bands[0].amplitude[0].time; }, true},
        {"bands[0].pitch[0].time", [](Clip& c) -> double& { return c.bands[0].pitch[0].time; }, true},
        {"noise[0].amplitude[0].time", [](Clip& c) -> double& { return c.noise[0].amplitude[0].time; }, true},
        {"transients[1].time", [](Clip& c) -> double& { return c.transients[1].time; }, false},
        {"markers[1].time", [](Clip& c) -> double& { return c.markers[1].time; }, false},
    };
    for (const Case& test : cases)
    {
        CAPTURE(test.where);
        const auto with = [&](double value, ErrorCode code = ErrorCode::invalidData)
        {
            return ruleBroken([&](Clip& clip) { test.time(clip) = value; }, code);
        };
        CHECK(with(1.0).empty());
        CHECK(with(1.0 + 0.9e-6).empty());
        CHECK(with(1.0 + 1.1e-6) ==
              test.where + (test.curve ? ": is later than the clip's duration" : ": is outside 0 to 1.000001"));
        CHECK(with(-1e-9) ==
              test.where + (test.curve ? ": is not a finite time of 0 or later" : ": is outside 0 to 1.000001"));
        CHECK(with(std::nan(""), ErrorCode::notFinite) ==
              test.where + (test.curve ? ": is not a finite time of 0 or later" : ": is not a finite number"));
    }
    CHECK(ruleBroken([](Clip& c) { c.envelope[0].time = 1.0; }).empty());
    CHECK(ruleBroken(
              [](Clip& c) {
                  c.envelope = {{0.5, 0.0}, {0.4, 0.0}};
              }) == "envelope[1].time: is earlier than the point before it");
    CHECK(ruleBroken([](Clip& c) { c.transients[0].time = 0.26; }) ==
          "transients[1].time: is earlier than the transient before it");
    CHECK(ruleBroken([](Clip& c) { c.markers[0].time = 0.6; }) ==
          "markers[1].time: is earlier than the marker before it");
    CHECK(ruleBroken([](Clip& c) { c.bands.resize(256); }).empty());
    CHECK(ruleBroken([](Clip& c) { c.bands.resize(257); }, ErrorCode::tooLarge) == "bands: has more than 256 bands");
}

TEST_CASE("Texts of a clip have 250 000 bytes together, 32 for each parameter", "[clip]")
{
    const auto withText = [](std::size_t bytes)
    {
        return ruleBroken(
            [&](Clip& c)
            {
                c.source.file = std::string(10, 'f');
                c.name = std::string(20, 'n');
                c.markers = {{0.0, std::string(30, 'm')}};
                c.encoder = {{std::string(40, 'p'), 1.0}, {std::string(50, 'q'), std::string(bytes, 't')}};
            },
            ErrorCode::tooLarge);
    };
    constexpr std::size_t others = 10 + 20 + 30 + 40 + 32 + 50 + 32;
    CHECK(withText(250000 - others).empty());
    CHECK(withText(250001 - others) == "has more than 250000 bytes of names and parameters");
    CHECK(ruleBroken(
              [](Clip& c) {
                  c.encoder = {{"a", 1.0}, {"a", true}};
              }) == "encoder: has two parameters of the same name");
    CHECK(ruleBroken(
              [](Clip& c) {
                  c.encoder = {{"a", std::nan("")}};
              },
              ErrorCode::notFinite) == "encoder: has a parameter that is not a finite number");
    Clip clip = ruledClip();
    clip.encoder = {{"x", 1.0}, {"y", std::string("text")}, {"x2", std::string("other")}};
    CHECK(encoderText(clip, "y", "none") == "text");
    CHECK(encoderText(clip, "x", "none") == "none");
    CHECK(encoderText(clip, "z", "none") == "none");
    CHECK(breakpointCount(clip) == 6);
    CHECK(breakpointCount(Clip{}) == 0);
}

TEST_CASE("A curve is read at its points, between them and beyond its ends", "[clip]")
{
    const Curve curve = {{1.0, 2.0}, {2.0, 4.0}, {2.0, 8.0}, {4.0, 0.0}};
    CurveReader reader(curve);
    for (const auto& [time, value] :
         {std::pair(0.0, 2.0), {1.0, 2.0}, {1.25, 2.5}, {2.0, 8.0}, {3.0, 4.0}, {4.0, 0.0}, {9.0, 0.0}})
    {
        CHECK(valueAt(curve, time) == value);
        CHECK(reader.at(time) == value);
    }
    CHECK(CurveReader().at(1.0) == 0.0);
    CHECK(valueAt({}, 1.0) == 0.0);
}

TEST_CASE("Grid curves are read in whole numbers, and their points are seen from afar", "[clip]")
{
    const GridCurve curve = {{10, 100}, {20, 103}, {20, 50}, {40, -51}};
    GridCurveReader reader(&curve);
    for (const auto& [tick, code] : {std::pair<std::int64_t, std::int64_t>(0, 100),
                                     {10, 100},
                                     {13, 100},
                                     {14, 101},
                                     {19, 102},
                                     {20, 50},
                                     {21, 45},
                                     {39, -45},
                                     {40, -51},
                                     {90, -51}})
        CHECK(reader.at(tick, 7) == code);
    GridCurveReader near(&curve);
    for (const auto& [tick, nearness] : {std::pair<std::int64_t, std::size_t>(7, 0),
                                         {8, 1},
                                         {9, 1},
                                         {10, 2},
                                         {12, 1},
                                         {13, 0},
                                         {17, 0},
                                         {18, 1},
                                         {20, 2},
                                         {22, 1},
                                         {23, 0},
                                         {38, 1},
                                         {40, 2},
                                         {42, 1},
                                         {43, 0}})
    {
        CAPTURE(tick);
        CHECK(near.nearness(tick, 2) == nearness);
    }
    const GridCurve nothing;
    CHECK(GridCurveReader(&nothing).at(5, 7) == 7);
    CHECK(GridCurveReader(nullptr).at(5, 7) == 7);
    CHECK(GridCurveReader(&nothing).nearness(5, 100) == 0);
    CHECK(GridCurveReader(nullptr).nearness(5, 100) == 0);
    CHECK(tickStride({}) == 1);
    CHECK(tickStride({{0, 1}}) == 1);
    CHECK(tickStride({{0, 1}, {12, 1}, {20, 1}}) == 4);
    CHECK(tickStride({{7, 1}}) == 7);
}

TEST_CASE("Texts of clips are escaped, split and put together again", "[clip]")
{
    using namespace detail;
    const std::string special("a\0b\1c\nd=e", 9);
    CHECK(escaped(special) == std::string("a\1\2b\1\3c\1\x0C"
                                          "d\1?e"));
    CHECK(unescaped(escaped(special)) == special);
    CHECK(unescaped("a\1") == "a\1");
    CHECK(escaped("").empty());
    CHECK(fileStem("a.b.wav") == "a.b");
    CHECK(fileStem("a") == "a");
    CHECK(fileStem(".wav") == ".wav");
    CHECK(fileStem("") == "");
    CHECK(fileStem("a.") == "a");
    const std::vector<EncoderParameter> parameters = {
        {"n=1", -0.1}, {"s", std::string("x\ny=z")}, {"yes", true}, {"no", false}, {"", 1e300}};
    CHECK(parameterText(parameters) == "nn\1?1=-0.1\nss=x\1\x0Cy\1?z\nbyes=1\nbno=0\nn=1e+300\n");
    CHECK(parametersOf(parameterText(parameters)) == parameters);
    CHECK(parametersOf("").empty());
    CHECK(parametersOf("no equals\n=\nna=x\nba=0\nba=11\nxa=y").size() == 4);
    CHECK(parametersOf("na=x")[0].value == EncoderParameter{"", 0.0}.value);
    CHECK(parametersOf("ba=11")[0].value == EncoderParameter{"", false}.value);
    CHECK(parametersOf("xa=y")[0] == EncoderParameter{"a", std::string("y")});
}

TEST_CASE("Tiled bands adjoin, end where they should and are recognised", "[clip]")
{
    using namespace detail;
    CHECK(tiledBands(2, 100.0, 400.0, BandSpacing::logarithmic) ==
          std::vector<BandEdges>{{100.0, 141.42, 200.0}, {200.0, 282.84, 400.0}});
    CHECK(tiledBands(2, 100.0, 400.0, BandSpacing::linear) ==
          std::vector<BandEdges>{{100.0, 175.0, 250.0}, {250.0, 325.0, 400.0}});
    CHECK(tiledBands(1, 0.001, 0.002, BandSpacing::linear)[0].low == 0.001); // ends are not rounded
    CHECK(tiledBands(1, 0.001, 0.002, BandSpacing::linear)[0].high == 0.002);
    CHECK(BandEdges{} == BandEdges{0.0, 0.0, 0.0});
    CHECK(canTile(1e-9, 400000.0));
    CHECK_FALSE(canTile(0.0, 100.0));
    CHECK_FALSE(canTile(100.0, 100.0));
    CHECK_FALSE(canTile(100.0, 400000.1));
    std::vector<Band> bands(2);
    setFrequencies(bands, tiledBands(2, 100.0, 400.0, BandSpacing::linear));
    CHECK(isTiled(bands, BandSpacing::linear));
    CHECK_FALSE(isTiled(bands, BandSpacing::logarithmic));
    bands[1].centreFrequency += 0.01;
    CHECK_FALSE(isTiled(bands, BandSpacing::linear));
    CHECK_FALSE(isTiled(std::vector<Band>(2), BandSpacing::linear));
}

TEST_CASE("Codes of the quantisers are those of their formulas, at both ends", "[clip]")
{
    CHECK(roundedToDigits(0.0, 3) == 0.0);
    CHECK(roundedToDigits(123456.0, 3) == 123000.0);
    CHECK(roundedToDigits(-0.00123456, 4) == Approx(-0.001235).epsilon(1e-12));
    CHECK(roundedToDigits(9.9996, 4) == 10.0);
    CHECK(roundedToDigits(1000.0, 1) == 1000.0);
    const UniformQuantiser uniform(3, 1.0, 8.0);
    CHECK(uniform.code(1.0) == 0);
    CHECK(uniform.code(1.49) == 0);
    CHECK(uniform.code(1.5) == 1);
    CHECK(uniform.code(8.0) == 7);
    CHECK(uniform.code(99.0) == 7);
    CHECK(uniform.code(-99.0) == 0);
    CHECK(uniform.value(0) == 1.0);
    CHECK(uniform.value(7) == 8.0);
    CHECK(uniform.value(3) == 4.0);
    for (const int bits : {4, 8, 9, 12, 13, 16})
    {
        CAPTURE(bits);
        const LevelQuantiser levels(bits);
        const std::int64_t top = (1 << bits) - 1;
        const double step = 72.0 / static_cast<double>(top - 1);
        CHECK(levels.topCode() == top);
        CHECK(levels.code(1.0) == top);
        CHECK(levels.code(std::pow(10.0, -72.0 / 20.0)) == 1);
        CHECK(levels.code(std::pow(10.0, -3.0 * step / 20.0)) == top - 3);
        CHECK(levels.code(std::pow(10.0, 2.4 * step / 20.0)) == top + 2);
        CHECK(levels.code(1e-300) == 0);
        CHECK(levels.code(std::nan("")) == 0);
        CHECK(levels.code(std::numeric_limits<double>::infinity()) == 1000000000);
        CHECK(levels.value(top - 5) == roundedToDigits(std::pow(10.0, -5.0 * step / 20.0), bits <= 8    ? 4
                                                                                           : bits <= 12 ? 6
                                                                                                        : 8));
        const PitchQuantiser pitches(bits);
        const double octave = 3.0 * (1 << bits) / 4.0;
        CHECK(pitches.code(1.0) == 0);
        CHECK(pitches.code(2.0) == std::llround(octave));
        CHECK(pitches.code(0.5) == -std::llround(octave));
        CHECK(pitches.code(400000.0) == std::llround(octave * std::log2(400000.0)));
        CHECK(pitches.code(399000.0) < pitches.code(400000.0) + (bits < 9 ? 1 : 0));
        CHECK(pitches.code(500000.0) == pitches.code(400000.0));
        CHECK(pitches.code(1e-3) == std::llround(octave * std::log2(1e-3)));
        CHECK(pitches.code(1e-4) == pitches.code(1e-3));
        CHECK(pitches.value(0) == 1.0);
        CHECK(pitches.value(std::llround(octave)) == 2.0);
        CHECK(pitches.value(7) == roundedToDigits(std::exp2(7.0 / octave), bits <= 8 ? 5 : bits <= 12 ? 6 : 8));
    }
    CHECK(LevelQuantiser::highest == 1000.0);
    CHECK(LevelQuantiser::range == 72.0);
    CHECK(PitchQuantiser(6).value(1000000) == 400000.0);
    CHECK(PitchQuantiser(6).value(-1000000) == 0.001);
    CHECK(LevelQuantiser(6).value(1000000) == 1000.0);
}
