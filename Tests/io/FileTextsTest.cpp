#include "io/AcfFile.h"
#include "io/AtomicFile.h"
#include "io/AudioBytes.h"
#include "io/AudioReader.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/FileOrigin.h"
#include "io/InputFile.h"
#include "io/OnsetFile.h"
#include "io/ProfileFile.h"
#include "io/ResponseTable.h"
#include "io/SceneFile.h"
#include "io/SceneJson.h"
#include "io/ShippedProfiles.h"
#include "io/SoundHandle.h"
#include "io/SweepFile.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace fs = std::filesystem;

namespace
{

/// An ACF text with one entry changed.
std::string acfWith(const std::string& entry, const std::string& value)
{
    std::string text = acfText(Acf{});
    const auto at = text.find("\"" + entry + "\": ");
    REQUIRE(at != std::string::npos);
    const auto start = at + entry.size() + 4;
    return text.replace(start, text.find_first_of(",\n }", start) - start, value);
}

std::string acfError(const std::string& text)
{
    const auto acf = readAcf(text);
    return acf.ok() ? "" : acf.error().text();
}

std::string tableError(const std::string& text)
{
    const auto table = readResponseTable(text);
    return table.ok() ? "" : table.error().text();
}

/// Seven valid lines, so that only what is added can be wrong.
std::string tableLines(const std::string& more = {})
{
    std::string text;
    for (int i = 1; i <= 8; ++i)
        text += std::to_string(10 * i) + ",0\n";
    return text + more;
}

std::string onsetError(const std::string& text)
{
    const auto onsets = readOnsetText(text);
    return onsets.ok() ? "" : onsets.error().text();
}

Result<Clip> clipNamedAfterFile(const std::string& file)
{
    if (file.starts_with("no"))
        return Error{ErrorCode::io, "", "is not there"};
    Clip clip;
    clip.duration = 2.5;
    clip.name = file == "same.pacb" ? "twin" : file == "same2.pacb" ? "twin" : "clip of " + file;
    return clip;
}

std::string sceneError(const std::string& members)
{
    const auto scene =
        readSceneJson(R"({"format": "pacini.scene", "version": 1, )" + members + "}", clipNamedAfterFile);
    return scene.ok() ? "" : scene.error().text();
}

} // namespace

TEST_CASE("The text of an ACF file is as its documentation has it, to the digit", "[io]")
{
    Acf acf;
    acf.version = "1.0.0";
    acf.device = "A \"pad\"";
    acf.continuousGain = 1.0 / 3.0;
    acf.ends[1] = {165.0, 12.125, AcfShape::triangle};
    CHECK(acfText(acf) == R"({
  "metadata": {
    "version": "1.0.0",
    "device": "A \"pad\""
  },
  "continuous": {
    "gain": 0.333333,
    "emphasis_ducking": 0.5,
    "frequency_min": 55,
    "frequency_max": 200
  },
  "emphasis": {
    "gain": 1,
    "fade_out_percent": 0,
    "frequency_min": { "output_frequency": 55, "duration_ms": 36.4, "shape": "sine" },
    "frequency_max": { "output_frequency": 165, "duration_ms": 12.125, "shape": "triangle" }
  }
}
)");
    for (const AcfShape shape : {AcfShape::saw, AcfShape::sine, AcfShape::square, AcfShape::triangle})
    {
        acf.ends[0].shape = shape;
        CHECK(readAcf(acfText(acf))->ends[0].shape == shape);
    }
    CHECK(acfText(Acf{}).starts_with("{\n  \"metadata\": {\n  },\n"));
}

TEST_CASE("Numbers of an ACF file reach the ends of their ranges and go no further", "[io]")
{
    struct Case
    {
        std::string entry, place, low, high, below, above;
    };
    for (const Case& c :
         {Case{"emphasis_ducking", "continuous.emphasis_ducking", "0", "1", "-0.01", "1.01"},
          Case{"fade_out_percent", "emphasis.fade_out_percent", "0", "100", "-0.01", "100.01"},
          Case{"output_frequency", "emphasis.frequency_min.output_frequency", "1", "2000", "0.99", "2000.1"},
          Case{"duration_ms", "emphasis.frequency_min.duration_ms", "0.1", "10000", "0.09", "10000.1"}})
    {
        CAPTURE(c.entry);
        CHECK(acfError(acfWith(c.entry, c.low)).empty());
        CHECK(acfError(acfWith(c.entry, c.high)).empty());
        CHECK(acfError(acfWith(c.entry, c.below)) == c.place + ": must be " + c.low + " to " + c.high);
        CHECK(acfError(acfWith(c.entry, c.above)) == c.place + ": must be " + c.low + " to " + c.high);
    }
    CHECK(acfError(acfWith("gain", "0")).empty());
    CHECK(acfError(acfWith("gain", "1.01")) == "continuous.gain: must be 0 to 1");
    CHECK(acfError(acfWith("frequency_min", "1")).empty());
    CHECK(acfError(acfWith("frequency_min", "0.9")) == "continuous.frequency_min: must be 1 to 20000");
    CHECK(acfError(acfWith("frequency_min", "200")).empty());
    CHECK(acfError(acfWith("frequency_min", "200.1")) == "continuous.frequency_max: must not be below frequency_min");
    CHECK(acfError(acfWith("frequency_max", "20000")).empty());
    CHECK(acfError(acfWith("frequency_max", "20001")) == "continuous.frequency_max: must be 1 to 20000");
    CHECK(acfError(acfWith("gain", "true")) == "continuous.gain: must be a number");
    CHECK(acfError("{}") == "continuous: is missing");
    CHECK(acfError("{continuous: 3}") == "continuous: must be an object in braces");
    CHECK(acfError("{metadata: 3}") == "metadata: must be an object in braces");
    CHECK(acfError(std::string(largestAcfText + 1, ' ')) == "is longer than the longest supported text");
    // The defaults of what may be missing.
    const auto least = readAcf("{continuous: {frequency_min: 55, frequency_max: 200}, emphasis: {frequency_min: "
                               "{output_frequency: 55, duration_ms: 36.4, shape: 'sine'}, frequency_max: "
                               "{output_frequency: 55, duration_ms: 36.4, shape: 'sine'}}}");
    REQUIRE(least.ok());
    CHECK(*least == Acf{});
    CHECK(Acf{}.continuousGain == 1.0);
    CHECK(Acf{}.emphasisDucking == 0.5);
    CHECK(Acf{}.lowFrequency == 55.0);
    CHECK(Acf{}.highFrequency == 200.0);
    CHECK(Acf{}.emphasisGain == 1.0);
    CHECK(Acf{}.fadeOutPercent == 0.0);
    CHECK(AcfEmphasisEnd{} == AcfEmphasisEnd{55.0, 36.4, AcfShape::sine});
}

TEST_CASE("A profile of an ACF file has its numbers by the rules, and its warnings word by word", "[io]")
{
    Acf acf;
    acf.ends = {AcfEmphasisEnd{80.0, 20.0, AcfShape::sine}, AcfEmphasisEnd{180.0, 10.0, AcfShape::square}};
    const ProfileOfAcf adaptive = profileOfAcf(acf);
    CHECK(adaptive.profile.name == "Unnamed actuator");
    CHECK(adaptive.profile.resonance.frequency == Approx(100.0)); // 0.8 and 1.8 times
    CHECK(adaptive.profile.range.lowFrequency == 55.0);
    CHECK(adaptive.profile.range.highFrequency == 200.0);
    CHECK(adaptive.profile.drive.overdrive == 1.0);
    CHECK(adaptive.profile.transient.shape == TransientShape::adaptive);
    CHECK(adaptive.warnings ==
          std::vector<std::string>{
              "continuous.emphasis_ducking cannot be held by a profile",
              "emphasis.frequency_min and frequency_max differ: events are played adaptively, and the resonance is "
              "estimated from them",
              "technology, q, dynamic range and response and drive limits are not in an ACF file; the profile has "
              "defaults for them"});
    CHECK(adaptive.profile.sources.size() == 6);

    acf.version = "2";
    acf.date = "today";
    acf.author = "me";
    acf.device = "Pad";
    acf.fadeOutPercent = 10.0;
    acf.continuousGain = 0.25;
    acf.ends.fill({100.0, 20.0, AcfShape::square});
    const ProfileOfAcf fixed = profileOfAcf(acf);
    CHECK(fixed.profile.name == "Pad");
    CHECK(fixed.profile.resonance.frequency == Approx(100.0));
    CHECK(fixed.profile.drive.overdrive == 4.0);
    CHECK(fixed.profile.transient == ActuatorTransient{TransientShape::square, 100.0, 2.0});
    CHECK(fixed.warnings.front() == "metadata.version, metadata.date, metadata.author, continuous.emphasis_ducking "
                                    "and emphasis.fade_out_percent cannot be held by a profile");
    CHECK(fixed.warnings.size() == 2);
    CHECK(fixed.profile.sources.back().text == "ACF file, emphasis");
    const auto shapeOf = [&](double frequency, double duration, AcfShape shape)
    {
        acf.ends.fill({frequency, duration, shape});
        return profileOfAcf(acf).profile.transient;
    };
    CHECK(shapeOf(200.0, 25.0, AcfShape::sine) == ActuatorTransient{TransientShape::sine, 200.0, 5.0});
    CHECK(shapeOf(200.0, 25.0, AcfShape::saw) == ActuatorTransient{});
    CHECK(shapeOf(200.0, 25.0, AcfShape::triangle) == ActuatorTransient{});
    CHECK(shapeOf(1.0, 100.0, AcfShape::sine).shape == TransientShape::sine); // 0.1 cycles
    CHECK(shapeOf(1.0, 99.0, AcfShape::sine).shape == TransientShape::adaptive);
    CHECK(shapeOf(10.0, 10000.0, AcfShape::sine).shape == TransientShape::sine); // 100 cycles
    CHECK(shapeOf(10.1, 10000.0, AcfShape::sine).shape == TransientShape::adaptive);

    acf = {};
    acf.lowFrequency = acf.highFrequency = 100.0;
    const Profile single = profileOfAcf(acf).profile;
    CHECK(single.polyphony == 0);
    CHECK(single.resonance.frequency == 100.0);
    CHECK(single.range.lowFrequency == Approx(70.710678));
    CHECK(single.range.highFrequency == Approx(141.421356));
    CHECK(single.sources[1].text == "ACF file: equal frequencies, so only amplitude counts");
    CHECK(single.sources[2].text == "assumed: half an octave on each side of the one frequency of the ACF file");
    CHECK(single.sources[4].text == "ACF file, continuous");
    acf.lowFrequency = acf.highFrequency = 1.0;
    CHECK(profileOfAcf(acf).profile.range.lowFrequency == 1.0);
    acf.lowFrequency = acf.highFrequency = 20000.0;
    CHECK(profileOfAcf(acf).profile.range.highFrequency == 20000.0);

    const auto gains = [](double continuous, double emphasis)
    {
        Acf file;
        file.continuousGain = continuous;
        file.emphasisGain = emphasis;
        const ProfileOfAcf result = profileOfAcf(file);
        const bool lost = result.warnings.front().find("the absolute gains") != std::string::npos;
        return std::pair(result.profile.drive.overdrive, lost);
    };
    CHECK(gains(1.0, 1.0) == std::pair(1.0, false));
    CHECK(gains(0.5, 1.0) == std::pair(2.0, false));
    CHECK(gains(0.1, 1.0) == std::pair(10.0, false));
    CHECK(gains(0.05, 1.0) == std::pair(10.0, true));
    CHECK(gains(0.0, 1.0) == std::pair(10.0, true));
    CHECK(gains(1.0, 0.5) == std::pair(1.0, true));
    CHECK(gains(0.25, 0.5) == std::pair(2.0, true));
}

TEST_CASE("An ACF file of a profile has its numbers by the rules, and its warnings word by word", "[io]")
{
    Profile profile;
    profile.name = "Coil";
    profile.resonance.frequency = 100.0;
    profile.drive.overdrive = 4.0;
    profile.response.riseTime = 0.015;
    profile.range.lowFrequency = 30.0;
    profile.range.highFrequency = 900.0;
    const AcfOfProfile adaptive = acfOfProfile(profile);
    CHECK(adaptive.acf.version == "1.0.0");
    CHECK(adaptive.acf.device == "Coil");
    CHECK(adaptive.acf.continuousGain == 0.25);
    CHECK(adaptive.acf.emphasisGain == 1.0);
    CHECK(adaptive.acf.lowFrequency == 30.0);
    CHECK(adaptive.acf.highFrequency == 900.0);
    CHECK(adaptive.acf.ends[0].frequency == Approx(80.0));
    CHECK(adaptive.acf.ends[0].duration == Approx(25.0)); // two cycles
    CHECK(adaptive.acf.ends[0].shape == AcfShape::sine);
    CHECK(adaptive.acf.ends[1].frequency == Approx(180.0));
    CHECK(adaptive.acf.ends[1].duration == Approx(15.0)); // the rise time is longer
    CHECK(adaptive.acf.ends[1].shape == AcfShape::square);
    CHECK(adaptive.warnings ==
          std::vector<std::string>{
              "emphasis is made up from the resonance: 0.8 and 1.8 times its frequency, two cycles or the rise time",
              "response cannot be held by an ACF file",
              "continuous.emphasis_ducking 0.5 and emphasis.fade_out_percent 0 are not in a profile; they are the "
              "usual values"});
    profile.resonance.frequency = 20000.0;
    CHECK(acfOfProfile(profile).acf.ends[1].frequency == 2000.0);
    profile.resonance.frequency = 1.0;
    CHECK(acfOfProfile(profile).acf.ends[0].frequency == 1.0);

    Profile other;
    other.technology = Technology::erm;
    other.resonance.q += 1.0;
    other.range.dynamicRange += 1.0;
    other.response.fallTime += 1.0;
    other.polyphony += 1;
    other.frequencyMapping = FrequencyMapping::fold;
    other.drive.impedance = 8.0;
    other.equalizer.pushBack({});
    other.body.emplace();
    other.sources.push_back({"q", "measured"});
    other.transient = {TransientShape::square, 50.0, 2.0};
    const AcfOfProfile much = acfOfProfile(other);
    CHECK(much.acf.ends[0] == AcfEmphasisEnd{50.0, 40.0, AcfShape::square});
    CHECK(much.acf.ends[1] == much.acf.ends[0]);
    CHECK(much.warnings.front() == "technology, resonance.q, range.dynamicRange, response, polyphony, "
                                   "frequencyMapping, drive (but overdrive), equalizer, body and sources cannot be "
                                   "held by an ACF file");
    CHECK(much.warnings.size() == 2);
    other.polyphony = 0;
    const AcfOfProfile single = acfOfProfile(other);
    CHECK(single.acf.lowFrequency == other.resonance.frequency);
    CHECK(single.acf.highFrequency == other.resonance.frequency);
    CHECK(single.warnings.front().find("range.lowFrequency, range.highFrequency, range.dynamicRange, response, "
                                       "frequencyMapping") != std::string::npos);
    other.transient = {TransientShape::sine, 1000.0, 0.01};
    CHECK(acfOfProfile(other).acf.ends[0] == AcfEmphasisEnd{1000.0, 0.1, AcfShape::sine});
    other.transient = {TransientShape::sine, 1.0, 100.0};
    CHECK(acfOfProfile(other).acf.ends[0].duration == 10000.0);
}

TEST_CASE("Each line of a response is understood or refused for its own reason", "[io]")
{
    CHECK(tableError(tableLines()).empty());
    CHECK(tableError(tableLines("90,-3.5")).empty());
    CHECK(tableError(tableLines("  \"90\" ,\t\"-3.5\"\t\r\n")).empty());
    CHECK(tableError(tableLines("90;-3,5\n")).empty());
    CHECK(tableError(tableLines("90\t-3.5\n")).empty());
    CHECK(tableError(tableLines("90 -3.5 77\n")).empty());
    CHECK(tableError(tableLines("+90,+3.5\n")).empty());
    CHECK(tableError(tableLines("\n#x\n*x\n;x\n//x\n   \n90,1\n")).empty());
    CHECK(readResponseTable(tableLines("90;-3,5\n"))->level.back() == -3.5);
    CHECK(readResponseTable(tableLines("\"90,5\";\"1\"\n"))->frequency.back() == 90.5);
    CHECK(tableError(tableLines("/90,1\n")) == "line 9: frequency: '/90' is not a number");
    CHECK(tableError(tableLines("++90,1\n")) == "line 9: frequency: '++90' is not a number");
    CHECK(tableError(tableLines("\"90,1\n")) == "line 9: frequency: '\"90' is not a number");
    CHECK(tableError(tableLines("90,\"\n")) == "line 9: level: '\"' is not a number");
    CHECK(tableError(tableLines("90,\"\"\n")) ==
          "line 9: level: is missing; each line needs a frequency in Hz and a level in dB");
    CHECK(tableError(tableLines(",1\n")) ==
          "line 9: frequency: is missing; each line needs a frequency in Hz and a level in dB");
    CHECK(tableError(tableLines("x,y\n")) == "line 9: frequency: 'x' is not a number");
    CHECK(tableError("a,b\nc,d\n" + tableLines()) == "line 2: frequency: 'c' is not a number");
    CHECK(tableError("a,1\n" + tableLines()) == "line 1: frequency: 'a' is not a number");
    CHECK(tableError("1,b\n" + tableLines()) == "line 1: level: 'b' is not a number");
    CHECK(tableError("a,b\n" + tableLines()).empty());
    CHECK(tableError("#\n\n" + tableLines("20,0\n")).starts_with("line 11: frequency: "));
    std::string most;
    for (std::size_t i = 1; i <= FrequencyResponse::maxPoints; ++i)
        most += std::to_string(1.0 + 1e-4 * static_cast<double>(i)) + " 0\n";
    CHECK(readResponseTable(most).ok());
    CHECK(tableError(most + "20000 0\n") == "line 100001: is beyond 100000 points; thin or smooth the response first");
    const std::vector<double> values = {0.1, std::nan(""), -3.0};
    const std::vector<TableColumn> columns = {{"a", values}, {"b", values}};
    CHECK(tableText(columns) == "a,b\n0.1,0.1\n,\n-3,-3\n");
    CHECK(tableText({}) == "\n");
}

TEST_CASE("Onsets are taken from lines and lists, and what is none is said", "[io]")
{
    CHECK(readOnsetText("0.5 x\n0.25,y\n0.125;z\n\t1\r\n# 9\n  \n")->ofAny ==
          std::vector<double>{0.125, 0.25, 0.5, 1.0});
    CHECK(readOnsetText("0")->ofAny == std::vector<double>{0.0});
    CHECK(readOnsetText("[0, 0.5]")->ofAny == std::vector<double>{0.0, 0.5});
    CHECK(readOnsetText("[]")->ofAny.empty());
    CHECK(readOnsetText("\xEF\xBB\xBF[2, 1]")->ofAny == std::vector<double>{1.0, 2.0});
    for (const char* text : {"", "\n", "# nothing\n", "\xEF\xBB\xBF"})
        CHECK(onsetError(text) == "has no times; write one in seconds on each line, or [] for a sound without onsets");
    CHECK(readOnsetText("{}")->namesFiles);
    CHECK(readOnsetText("{}")->find("a.wav") == nullptr);
    CHECK(onsetError("0.5\n-0.001") == "line 2: \"-0.001\" is not a time in seconds, 0 or more");
    CHECK(onsetError("inf") == "line 1: \"inf\" is not a time in seconds, 0 or more");
    CHECK(onsetError("[true]") == "[0]: must be a time in seconds");
    CHECK(onsetError("[null]") == "[0]: must be a time in seconds");
    CHECK(onsetError("{\"a\": true}") == "a: must be a list of times in seconds, such as [0.12, 0.8]");
    CHECK(onsetError("{\"a\": null}") == "a: must be a list of times in seconds, such as [0.12, 0.8]");
    CHECK(onsetError("{\"a\": \"1\"}") == "a: must be a list of times in seconds, such as [0.12, 0.8]");
    CHECK(onsetError("{\"a\": [1, -0.5]}") == "a[1]: is -0.5; times are 0 or more, in seconds");
    CHECK(onsetError("{\"a\": [1], \"b\": [2], \"a\": [3]}") == "a: is given twice");
    CHECK(readOnsetText("{\"a\": [3, 1], \"b.wav\": [2]}")->byFile.at("a") == std::vector<double>{1.0, 3.0});
}

TEST_CASE("A scene says which reference it cannot follow", "[io][scene]")
{
    const std::string clips = R"("clips": ["a.pacb", "dir/a.pacb", "same.pacb", "same2.pacb"], )";
    const auto play = [&](const std::string& clip)
    {
        return sceneError(clips + R"("plays": [{"clip": )" + clip + "}]");
    };
    CHECK(play("0").empty());
    CHECK(play("3").empty());
    CHECK(play("4") == "plays[0].clip: is 4, but the scene has 4 clips, counted from 0");
    CHECK(play("-1") == "plays[0].clip: is -1, but the scene has 4 clips, counted from 0");
    CHECK(play("0.5") == "plays[0].clip: is 0.5, but the scene has 4 clips, counted from 0");
    CHECK(play("\"a.pacb\"").empty());
    CHECK(play("\"dir/a.pacb\"").empty());
    CHECK(play("\"twin\"") == "plays[0].clip: is \"twin\", the name of several clips; give the index of one");
    CHECK(play("\"no.pacb\"") ==
          "plays[0].clip: no.pacb: is not one of the scene's clips, and as a file it is not there");
    CHECK(sceneError(R"("clips": ["no\u0001.pacb"])") == "clips[0]: no?.pacb: is not there");
    CHECK(sceneError(R"("clips": [{}])") == "clips[0]: needs either \"file\" or \"clip\"");
    CHECK(sceneError(R"("clips": [""])") == "clips[0]: is empty; a file name is needed");
    CHECK(sceneError(R"("clips": [3])") ==
          "clips[0]: is a number; a file name in quotes or an object in braces is needed");
    const std::string plays =
        R"("plays": [{"clip": "x", "name": "p"}, {"clip": "x", "name": "q"}, {"clip": "x", "name": "q"}], )";
    const auto change = [&](const std::string& to)
    {
        return sceneError(plays + R"("changes": [{"time": 0, "play": )" + to +
                          R"(, "parameter": "gain", "value": 0.5}])");
    };
    CHECK(change("2").empty());
    CHECK(change("\"p\"").empty());
    CHECK(change("3") == "changes[0].play: is 3, but the scene has 3 plays, counted from 0");
    CHECK(change("\"q\"") ==
          "changes[0].play: is \"q\", which several plays are called; give a play's name or its index");
    CHECK(change("\"r\"") == "changes[0].play: is \"r\", which no play is called; give a play's name or its index");
    const auto seed = [&](const std::string& value)
    {
        return sceneError(R"("plays": [{"clip": "x", "variation": {"seed": )" + value + "}}]");
    };
    CHECK(seed("9007199254740992").empty());
    CHECK(seed("\"18446744073709551615\"").empty());
    for (const char* bad : {"9007199254740994", "-1", "0.5", "\"18446744073709551616\"", "\"\"", "\"1 \""})
        CHECK(seed(bad).find("a whole number from 0 to 2^53, or the digits of a larger one in quotes is needed") !=
              std::string::npos);
    CHECK(sceneError(R"("actuators": 16)").empty());
    CHECK(sceneError(R"("actuators": 0)") == "actuators: is 0; a whole number from 1 to 16 is needed");
    CHECK(sceneError(R"("actuators": 17)") == "actuators: is 17; a whole number from 1 to 16 is needed");
    CHECK(sceneError(R"("plays": [{"clip": "x", "passes": 1000000000}])").find("is needed") == std::string::npos);
    CHECK(sceneError(R"("plays": [{"clip": "x", "passes": 1000000001}])") ==
          "plays[0].passes: is 1000000001; a whole number from 0 to 1000000000 is needed");
    CHECK(sceneError(R"("plays": [{"clip": "x", "passes": -1}])") ==
          "plays[0].passes: is -1; a whole number from 0 to 1000000000 is needed");
    CHECK(isSceneText(" \n{\"a\": {\"format\": 1}, \"format\": \"pacini.scene\"}"));
    CHECK_FALSE(isSceneText("[\"pacini.scene\"]"));
    CHECK_FALSE(isSceneText("{\"format\": \"pacini.clip\", \"x\": \"pacini.scene\"}"));
    CHECK_FALSE(isSceneText("{\"a\": {\"format\": \"pacini.scene\"}}"));
    CHECK_FALSE(isSceneText("{\"name\": \"pacini.scene\"}"));
    CHECK_FALSE(isSceneText("{\"format\": [\"pacini.scene\"]}"));
    CHECK_FALSE(isSceneText(""));
}

TEST_CASE("Shipped profiles are found beside a program and above it, and named when one is not there", "[io]")
{
    const TempFolder folder;
    const fs::path deep = folder.path() / "1/2/3/4/5/6";
    fs::create_directories(deep);
    fs::create_directories(folder.path() / "1/profiles");
    for (const char* name : {"lra.json", "erm.json", "piezo.json", "notes.txt"})
        put(folder.path() / "1/profiles" / name, "{}");
    CHECK(shippedProfiles(deep).size() == 3); // five folders up
    CHECK(shippedProfiles(deep)[0].name == "erm");
    CHECK(shippedProfiles(deep)[2].path == folder.path() / "1/profiles/piezo.json");
    fs::create_directories(deep / "7");
    CHECK(shippedProfiles(deep / "7").empty()); // six are too many
    CHECK(*findProfile("lra", deep) == folder.path() / "1/profiles/lra.json");
    CHECK(*findProfile((folder.path() / "1/profiles/notes.txt").string(), deep) ==
          folder.path() / "1/profiles/notes.txt");
    CHECK(findProfile("lar", deep).error().text() == "is neither a file nor a shipped profile; did you mean lra?");
    CHECK(findProfile("something", deep).error().text() ==
          "is neither a file nor a shipped profile; there are erm, lra, piezo");
    CHECK(findProfile("x", deep / "7").error().text() == "is neither a file nor a shipped profile");
    CHECK(findProfile("x", deep).error().code == ErrorCode::io);
    fs::create_directories(folder.path() / "1/2/share/pacini/profiles");
    put(folder.path() / "1/2/share/pacini/profiles/eap.json", "{}");
    CHECK(shippedProfiles(deep).size() == 1); // the nearer ones
    CHECK(shippedProfiles(deep)[0].name == "eap");
}

TEST_CASE("The origin of a file is one line that is found again, and nothing that only looks like it", "[io]")
{
    const TempFolder folder;
    const FileOrigin origin{"door.json", "0123456789abcdef", "fedcba9876543210"};
    const std::string line = originText(origin);
    CHECK(line == "Made by Pacini from \"door.json\" (place 0123456789abcdef, substance fedcba9876543210, seal "
                  "0000000000000000)");
    const auto read = [&](const std::string& bytes)
    {
        return readOrigin(put(folder / "x", bytes)) == origin;
    };
    CHECK(read(line));
    CHECK(read("abc" + line + "def"));
    CHECK(read(std::string(65536 - line.size(), ' ') + line));
    CHECK_FALSE(read(std::string(65537 - line.size(), ' ') + line));
    CHECK_FALSE(read(line.substr(0, line.size() - 1)));
    CHECK_FALSE(read(line.substr(0, line.size() - 1) + "]"));
    for (const std::size_t at : {line.find("0123"), line.find("fedc"), line.find("0000")})
    {
        std::string other = line;
        other[at + 3] = 'g';
        CHECK_FALSE(read(other));
        other[at + 3] = 'A';
        CHECK_FALSE(read(other));
    }
    CHECK_FALSE(read("made" + line.substr(4)));
    CHECK_FALSE(isAsMade(folder / "x"));
    CHECK(originOf(folder / "a b~.json", folder / "c.wav", "x").input == "a b~.json");
    CHECK(originOf(folder / "a\x1F\x7F\".json", folder / "c.wav", "x").input == "a___.json");
    CHECK(originOf(folder / "a.json", folder / "c.wav", "x").substance == "x");
    CHECK(originOf(folder / "a.json", folder / "c.wav", "x").place.size() == 16);
}

TEST_CASE("Whole files are read up to their limit, whatever their size", "[io]")
{
    const TempFolder folder;
    for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 200000u})
    {
        const std::string bytes(size, 'x');
        const auto path = put(folder / "x", bytes);
        CHECK(readWholeFile(path, 300000).value() == bytes);
        CHECK(readWholeFile(path, size).value() == bytes);
        if (size > 0)
        {
            CHECK(readWholeFile(path, size - 1).error().code == ErrorCode::tooLarge);
            CHECK(readWholeFile(path, size - 1).error().text() ==
                  "is larger than " + std::to_string(size - 1) + " bytes");
        }
    }
    CHECK(readWholeFile("", 10).error().text() == "no file name was given");
    CHECK(readWholeFile("", 10).error().code == ErrorCode::invalidArgument);
    CHECK(readWholeFile(folder.path(), 10).error().text() == "is a folder; give the name of a file");
    CHECK(readWholeFile(folder / "missing", 10).error().code == ErrorCode::io);
}

TEST_CASE("A file being written tells its place and size, and goes where it is told", "[io]")
{
    const TempFolder folder;
    {
        auto file = AtomicFile::create(folder / "x");
        REQUIRE(file.ok());
        CHECK(file->size() == 0);
        CHECK(file->write(std::as_bytes(std::span("abcdef", 6))));
        CHECK(file->write({}));
        CHECK(file->tell() == 6);
        CHECK(file->size() == 6);
        CHECK(file->seek(2, SEEK_SET));
        CHECK(file->tell() == 2);
        CHECK(file->size() == 6);
        CHECK(file->tell() == 2);
        CHECK(file->write(std::as_bytes(std::span("X", 1))));
        CHECK(file->seek(0, SEEK_SET));
        std::vector<std::byte> back(10);
        CHECK(file->read(back) == 6);
        CHECK(back[2] == std::byte{'X'});
        CHECK_FALSE(file->failure());
        REQUIRE(file->commit().ok());
    }
    CHECK(bytesOf(folder / "x") == "abXdef");
    CHECK(folder.entries() == 1);
    CHECK_FALSE(AtomicFile::create(folder / "x")->seek(-1, SEEK_SET));
    CHECK(AtomicFile::create("").error().text() == "no file name was given");
    CHECK(AtomicFile::create(folder.path() / "none/x").error().text() ==
          "its folder does not exist; create the folder first");
    CHECK(AtomicFile::create(folder / "x", Existing::keep).error().text() ==
          "was created meanwhile and was kept; choose another name");
    CHECK(writeFileAtomically(folder / "y", "1234").value() == 4);
    CHECK(writeFileAtomically(folder / "y", "", Existing::replace).value() == 0);
    fs::permissions(folder / "y", fs::perms::owner_read);
    CHECK(writeFileAtomically(folder / "y", "1").error().text() ==
          "is marked read-only; choose another name or make it writable");
    fs::permissions(folder / "y", fs::perms::owner_all);
    for (const char* out : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"})
        CHECK(isStandardOutput(out));
    for (const char* other : {"", "x", "--", "/dev/stdin"})
        CHECK_FALSE(isStandardOutput(other));
    CHECK(isStream("-"));
    CHECK_FALSE(isStream(folder / "x"));
    CHECK_FALSE(isStream(folder / "missing"));
}

TEST_CASE("Samples are stored as the nearest steps, full scale at most, in both widths", "[io][audio]")
{
    const TempFolder folder;
    CHECK(AudioWriteParams{}.sampleRate == 48000);
    CHECK(AudioWriteParams{}.channels == 1);
    CHECK(AudioWriteParams{}.encoding == SampleEncoding::float32);
    CHECK_FALSE(AudioWriteParams{}.ditherSeed);
    CHECK(AudioWriteParams{}.expectedFrames == 0);
    CHECK_FALSE(AudioReadOptions{}.allowTruncated);
    CHECK_FALSE(AudioReadOptions{}.allowNan);
    CHECK_FALSE(AudioReadOptions{}.keepNan);
    CHECK(AudioReadOptions{}.lowestSampleRate == 8000);
    for (const auto& [encoding, bits] : {std::pair(SampleEncoding::pcm16, 16), std::pair(SampleEncoding::pcm24, 24)})
    {
        const float step = std::ldexp(1.0f, 1 - bits);
        const std::vector<float> samples = {0.0f,  step, 1.25f * step, 1.75f * step, -1.0f,
                                            -1.5f, 1.0f, 2.0f,         1.0f - step};
        const std::vector<float> stored = {0.0f,  step,        step,        2.0f * step, -1.0f,
                                           -1.0f, 1.0f - step, 1.0f - step, 1.0f - step};
        const auto report = writeAudio(folder / "x.wav", samples, {.encoding = encoding});
        REQUIRE(report.ok());
        CHECK(report->clippedSamples == 2); // what is beyond full scale, 1 is not
        CHECK(report->frames == 9);
        CHECK(report->bytes == fs::file_size(folder / "x.wav"));
        CHECK(readAudio(folder / "x.wav")->samples == stored);
        auto reader = AudioReader::open(folder / "x.wav");
        REQUIRE(reader.ok());
        CHECK(reader->frames() == 9);
        CHECK(reader->sampleRate() == 48000);
        CHECK(reader->channels() == 1);
        CHECK(reader->replacedSamples() == 0);
    }
}

TEST_CASE("A WAV holds all that 32 bits can count, and one frame more makes it an RF64", "[io][audio]")
{
    const TempFolder folder;
    const auto container = [&](std::uint64_t frames, int channels, SampleEncoding encoding)
    {
        AudioWriteParams params{.channels = channels, .encoding = encoding};
        params.expectedFrames = frames;
        auto writer = AudioWriter::create(folder / "x.wav", params);
        REQUIRE(writer.ok());
        REQUIRE(writer->write(std::vector<float>(static_cast<std::size_t>(channels), 0.5f)).ok());
        REQUIRE(writer->finish().ok());
        return bytesOf(folder / "x.wav").substr(0, 4);
    };
    constexpr std::uint64_t most = 0xFFFFFFFFull - 4096;
    CHECK(container(most / 4, 1, SampleEncoding::float32) == "RIFF");
    CHECK(container(most / 4 + 1, 1, SampleEncoding::float32) == "RF64");
    CHECK(container(most / 6, 2, SampleEncoding::pcm24) == "RIFF");
    CHECK(container(most / 6 + 1, 2, SampleEncoding::pcm24) == "RF64");
    CHECK(container(most / 2, 1, SampleEncoding::pcm16) == "RIFF");
    CHECK(container(most / 2 + 1, 1, SampleEncoding::pcm16) == "RF64");
}

TEST_CASE("Files that are cut off within a frame or of packed codecs are judged by their bytes", "[io][audio]")
{
    const TempFolder folder;
    const auto error = [&](const std::string& bytes)
    {
        const auto audio = readAudio(put(folder / "x", bytes));
        return audio.ok() ? "" : audio.error().text();
    };
    const std::string data(400, '\1');
    for (const auto& [width, kind] : {std::pair(8, 1), {16, 1}, {24, 1}, {32, 1}, {32, 3}, {64, 3}, {8, 6}, {8, 7}})
    {
        const int bits = width, tag = kind;
        CAPTURE(bits, tag);
        const auto frameBytes = static_cast<std::uint32_t>(2 * bits / 8);
        const auto wav = [&](std::uint32_t claimed, std::size_t there)
        {
            return wavBytes({.channels = 2,
                             .bits = static_cast<std::uint16_t>(bits),
                             .tag = static_cast<std::uint16_t>(tag),
                             .dataBytes = claimed},
                            std::string(there, '\0'));
        };
        CHECK(error(wav(100 * frameBytes, 100 * frameBytes)).empty());
        CHECK(error(wav(1000 * frameBytes, 900 * frameBytes)) ==
              "is truncated: it has 900 frames of 1000; get a complete copy");
        CHECK(error(wav(100 * frameBytes + frameBytes - 1, 100 * frameBytes)).empty()); // no whole frame is missing
    }
    CHECK(error("") == "is empty; choose a file with audio");
    CHECK(error("neither this nor that, but long enough to be looked at") ==
          "is not audio in a supported format; convert it to WAV, AIFF, FLAC, Ogg or CAF");
    CHECK(error(wavBytes({.channels = 64}, std::string(128, '\0'))).empty());
    CHECK(error(wavBytes({.channels = 65}, std::string(130, '\0'))) ==
          "has 65 channels, but only 1 to 64 are supported; mix it down");
}

TEST_CASE("Exports are named after the main file, and companions found by both ways of naming", "[io]")
{
    const TempFolder folder;
    CHECK(exportPath("a/b.c.ahap", "-x") == fs::path("a/b.c-x.ahap"));
    CHECK(exportPath("b", "-x") == fs::path("b-x"));
    for (const ClipFormat& format : clipFormats())
        if (!format.companion.empty())
        {
            const std::string extension(format.extension);
            const auto main = put(folder / ("m" + extension), "x");
            const auto second = exportPath(main, format.companion);
            CHECK(companionOf(second) == main);
            CHECK(companionOf(main).empty());
            const auto studio = put(folder / ("s.continuous" + extension), "x");
            CHECK(companionOf(folder / ("s.transients" + extension)) == studio);
            CHECK(companionOf(folder / ("t.transients" + extension)).empty());
            ExportedClip exported;
            exported.files.resize(1);
            CHECK(strayCompanion(main, format, exported).empty());
            put(second, "y");
            CHECK(strayCompanion(main, format, exported) == second);
            CHECK(strayWarning(second) ==
                  second.filename().string() +
                      ": exists already, is not part of this clip, but would be read with it; remove it");
            exported.files[0].suffix = format.companion;
            CHECK(strayCompanion(main, format, exported).empty());
        }
    CHECK(readClip(put(folder / "empty.json", "")).error().text() == "is empty; choose a file with a clip");
    CHECK(readClip(put(folder / "no.json", "hello")).error().text() ==
          "is not a clip: neither JSON nor packed; encode audio to get a clip");
    CHECK(readClip(put(folder / "scene.json", R"({"format": "pacini.scene", "version": 1})")).error().text() ==
          "is a scene, not a clip; 'pacini render' renders scenes");
    CHECK(readProfile(put(folder / "x.acf", "{}")).error().text() ==
          "is an ACF file; convert it to a profile with 'pacini convert' first");
    CHECK(isProfile(put(folder / "p.json", R"({"format": "pacini.profile"})")));
    CHECK_FALSE(isProfile(put(folder / "q.json", R"({"format": "pacini.clip"})")));
    CHECK_FALSE(isProfile(put(folder / "q.json", "[]")));
    CHECK_FALSE(isProfile(put(folder / "q.json", "{}")));
    CHECK_FALSE(isProfile(put(folder / "q.json", "{")));
    CHECK_FALSE(isProfile(folder.path()));
    CHECK_FALSE(isProfile(folder / "missing"));
}

TEST_CASE("The gain of a sweep is within 200 dB, and its text is as documented", "[io]")
{
    SweepFile file;
    CHECK(file.gain == 0.0);
    for (const double gain : {-200.0, 200.0})
    {
        file.gain = gain;
        CHECK(readSweepJson(sweepJson(file))->gain == gain);
    }
    for (const double gain : {-200.1, 200.1})
    {
        file.gain = gain;
        CHECK(readSweepJson(sweepJson(file)).error().text() == "gain: must be -200 to 200 dB");
    }
    CHECK(readSweepJson("[]").error().text() == "is not the description of a sweep, as it is not a JSON object");
    file = {};
    file.sweep.levels.assign(32, -10.0);
    CHECK(readSweepJson(sweepJson(file)).ok());
    file.sweep.levels.assign(33, -10.0);
    CHECK(readSweepJson(sweepJson(file)).error().text() == "levels: has more than 32 numbers");
    CHECK(SoundLibraryCall::isActive() == false);
    const SoundLibraryCall outer;
    {
        const SoundLibraryCall inner;
        CHECK(SoundLibraryCall::isActive());
    }
    CHECK(SoundLibraryCall::isActive());
    const std::string reason = soundError(nullptr);
    CHECK_FALSE(reason.empty());
    CHECK(reason.back() != '.');
}
