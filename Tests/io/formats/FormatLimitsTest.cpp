// What readers of other formats take at the end of each range and refuse just beyond it, in which words.

#include "io/formats/ClipFormat.h"
#include "io/formats/FormatSamples.h"
#include "support/Catch.h"
#include "support/Numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// A file with `@` in place of some values, which are given in order.
std::string limitsFilled(const std::string& pattern, const std::vector<std::string>& values)
{
    std::string text;
    std::size_t next = 0;
    for (const char c : pattern)
        if (c == '@')
            text += values.at(next++);
        else
            text += c;
    REQUIRE(next == values.size());
    return text;
}

ImportedClip limitsTaken(const std::string& format, const std::string& text)
{
    const auto read = clipFormatNamed(format)->read(text);
    CAPTURE(format, text, read ? "" : read.error().text());
    REQUIRE(read);
    return *read;
}

void limitsRefused(const std::string& format, const std::string& text, const std::string& where,
                   const std::string& message, ErrorCode code = ErrorCode::invalidData)
{
    const auto read = clipFormatNamed(format)->read(text);
    CAPTURE(format, text);
    REQUIRE_FALSE(read);
    CHECK(read.error().where == where);
    CHECK(read.error().message == message);
    CHECK(read.error().code == code);
}
} // namespace

TEST_CASE(".tact: times are 0 to 24 hours and intensities 0 to 1", "[formats]")
{
    const std::string pattern = R"({"project": {"name": "n", "tracks": [{"effects": [{"startTime": @, "offsetTime": @,
        "modes": {"Vest": {"dotMode": {"feedback": [{"startTime": @, "endTime": @, "pointList":
        [{"index": 0, "intensity": @, "time": @}]}]}}}}]}]}, "durationMillis": @})";
    const auto with = [&](const std::string& start, const std::string& offset, const std::string& from,
                          const std::string& to, const std::string& level, const std::string& time,
                          const std::string& duration)
    {
        return limitsFilled(pattern, {start, offset, from, to, level, time, duration});
    };
    const std::string effect = "project.tracks[0].effects[0]";
    const std::string feedback = effect + ".modes.Vest.dotMode.feedback[0]";
    const std::string hours = "must be 0 to 24 hours";
    CHECK(limitsTaken("tact", with("0", "0", "0", "0", "0", "0", "0")).clip.duration == 0.0);
    CHECK(limitsTaken("tact", with("86400000", "0", "0", "0", "1", "0", "0")).clip.duration == 86400.0);
    CHECK(limitsTaken("tact", with("86399000", "1000", "0", "1000", "1", "1000", "86400000")).clip.duration == 86400.0);
    CHECK(limitsTaken("tact", with("0", "250", "0", "100", "1", "0", "0")).clip.duration == 0.25);
    CHECK(limitsTaken("tact", with("0", "250", "0", "100", "1", "0", "300")).clip.duration == 0.3);
    limitsRefused("tact", with("-1", "0", "0", "0", "1", "0", "0"), effect + ".startTime", hours);
    limitsRefused("tact", with("86400001", "0", "0", "0", "1", "0", "0"), effect + ".startTime", hours);
    limitsRefused("tact", with("0", "-1", "0", "0", "1", "0", "0"), effect + ".offsetTime", hours);
    limitsRefused("tact", with("86400000", "1", "0", "0", "1", "0", "0"), effect + ".offsetTime", hours);
    limitsRefused("tact", with("1", "0", "-1", "0", "1", "0", "0"), feedback + ".endTime",
                  "must be from startTime on, within 24 hours");
    limitsRefused("tact", with("1", "0", "2", "1", "1", "0", "0"), feedback + ".endTime",
                  "must be from startTime on, within 24 hours");
    limitsRefused("tact", with("86399999", "0", "0", "2", "1", "0", "0"), feedback + ".endTime",
                  "must be from startTime on, within 24 hours");
    limitsRefused("tact", with("0", "0", "0", "0", "-0.001", "0", "0"), feedback + ".pointList[0].intensity",
                  "must be 0 to 1");
    limitsRefused("tact", with("0", "0", "0", "0", "1.001", "0", "0"), feedback + ".pointList[0].intensity",
                  "must be 0 to 1");
    limitsRefused("tact", with("1", "0", "0", "0", "1", "-1", "0"), feedback + ".pointList[0].time", hours);
    limitsRefused("tact", with("86400000", "0", "0", "0", "1", "1", "0"), feedback + ".pointList[0].time", hours);
    limitsRefused("tact", with("0", "0", "0", "0", "1", "0", "-1"), "durationMillis", hours);
    limitsRefused("tact", with("0", "0", "0", "0", "1", "0", "86400001"), "durationMillis", hours);
    std::string mode = with("0", "0", "0", "0", "1", "0", "0");
    mode.insert(mode.find("\"dotMode\""), R"("mode": "LINE_MODE", )");
    limitsRefused("tact", mode, effect + ".modes.Vest.mode", "must be DOT_MODE or PATH_MODE, not 'LINE_MODE'");
}

TEST_CASE(".tact: fades, paths and places make one strength", "[formats]")
{
    const auto piecesOf = [](const std::string& tracks)
    {
        return limitsTaken("tact",
                           R"({"project": {"name": "n", "tracks": [)" + tracks + R"(]}, "durationMillis": 900})");
    };
    const auto track = [](const std::string& modes, const std::string& enabled = "true")
    {
        return R"({"enable": )" + enabled + R"(, "effects": [{"startTime": 100, "modes": {)" + modes + "}}]}";
    };
    const auto dots = [](const std::string& place, const std::string& playback, const std::string& from,
                         const std::string& to, const std::string& level)
    {
        return "\"" + place + R"(": {"mode": "DOT_MODE", "dotMode": {"feedback": [{"startTime": )" + from +
               R"(, "endTime": )" + to + R"(, "playbackType": ")" + playback + R"(", "pointList": [{"intensity": 0.1},
               {"intensity": )" +
               level + R"(}, {"intensity": 0.2}]}]}})";
    };
    const auto curveOf = [&](const std::string& tracks)
    {
        return piecesOf(tracks).clip.bands.at(0).amplitude;
    };
    CHECK(curveOf(track(dots("V", "NONE", "50", "250", "0.5"))) ==
          Curve{{0.0, 0.0}, {0.15, 0.0}, {0.15, 0.5}, {0.35, 0.5}, {0.35, 0.0}, {0.9, 0.0}});
    CHECK(curveOf(track(dots("V", "FADE_IN", "50", "250", "0.5"))) ==
          Curve{{0.0, 0.0}, {0.15, 0.0}, {0.15, 0.0}, {0.35, 0.5}, {0.35, 0.0}, {0.9, 0.0}});
    CHECK(curveOf(track(dots("V", "FADE_OUT", "50", "250", "0.5"))) ==
          Curve{{0.0, 0.0}, {0.15, 0.0}, {0.15, 0.5}, {0.35, 0.0}, {0.35, 0.0}, {0.9, 0.0}});
    CHECK(curveOf(track(dots("V", "FADE_IN_OUT", "50", "250", "0.5"))) ==
          Curve{{0.0, 0.0}, {0.15, 0.0}, {0.15, 0.0}, {0.25, 0.5}, {0.25, 0.5}, {0.35, 0.0}, {0.35, 0.0}, {0.9, 0.0}});
    // Two places that do the same at once are one, the stronger at each end.
    CHECK(curveOf(track(dots("V", "FADE_IN", "50", "250", "0.5") + "," + dots("W", "FADE_OUT", "50", "250", "0.75"))) ==
          Curve{{0.0, 0.0}, {0.15, 0.0}, {0.15, 0.75}, {0.35, 0.5}, {0.35, 0.0}, {0.9, 0.0}});
    // Others are sampled in the middle of frames of 20 ms, the last of which may be shorter.
    CHECK(curveOf(track(dots("V", "FADE_IN", "0", "40", "0.8") + "," + dots("W", "NONE", "20", "50", "0.25"))) ==
          Curve{{0.0, 0.0},
                {0.1, 0.0},
                {0.1, 0.2},
                {0.12, 0.2},
                {0.12, 0.8 * 0.75},
                {0.14, 0.8 * 0.75},
                {0.14, 0.25},
                {0.15, 0.25},
                {0.15, 0.0},
                {0.9, 0.0}});
    // What follows without a gap has no silence in between.
    CHECK(curveOf(track(dots("V", "NONE", "0", "40", "0.5")) + "," + track(dots("V", "NONE", "40", "80", "0.25"))) ==
          Curve{{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.5}, {0.14, 0.5}, {0.14, 0.25}, {0.18, 0.25}, {0.18, 0.0}, {0.9, 0.0}});
    const auto disabled = piecesOf(track(dots("V", "NONE", "0", "4000", "0.5"), "false"));
    CHECK(disabled.clip.bands.empty());
    CHECK(disabled.clip.duration == 0.9);
    CHECK(disabled.warnings ==
          std::vector<std::string>{"project.tracks: the strongest of all motors is read as one amplitude"});
    // Points of a path count from the start of the effect; a point that goes back ends nothing.
    const std::string path = R"("V": {"mode": "PATH_MODE", "pathMode": {"feedback": [{"pointList":
        [{"time": 0, "intensity": 0.25}, {"time": 200, "intensity": 1}, {"time": 100, "intensity": 0.5},
         {"time": 300, "intensity": 0.125}]}]}})";
    const auto read = piecesOf(track(path));
    CHECK(read.clip.bands.at(0).amplitude.front() == Breakpoint{0.0, 0.0});
    CHECK(read.clip.bands.at(0).centreFrequency == 150.0);
    CHECK(valueAt(read.clip.bands.at(0).amplitude, 0.105) == Approx(0.25 + 0.75 * 0.05));
    CHECK(valueAt(read.clip.bands.at(0).amplitude, 0.39) == Approx(0.5 - 0.375 * 0.95));
    CHECK(read.clip.duration == 0.9);
    const std::string single = R"("V": {"mode": "PATH_MODE", "pathMode": {"feedback": [{"pointList":
        [{"time": 0, "intensity": 0.25}]}, {"pointList": []}]}})";
    CHECK(piecesOf(track(single)).clip.bands.empty());
    std::string one = track(dots("V", "NONE", "0", "40", "0.5"));
    one.replace(one.find("100"), 3, "\"100\"");
    CHECK(piecesOf(one).warnings.at(0) == "project.tracks: a number is in quotes and read as numbers");
}

TEST_CASE(".haps: times are 0 to 24 hours and gains 0 to 1000", "[formats]")
{
    const auto wave = [](const std::string& start, const std::string& length, const std::string& gain,
                         const std::string& amplitudes, const std::string& frequencies = "")
    {
        return R"({"m_version": "5.1", "m_gain": 2, "m_vibration": {"m_gain": 5, "m_melodies": [{"m_gain": 10, "m_notes":
            [{"m_startingPoint": )" +
               start + R"(, "m_length": )" + length + R"(, "m_gain": )" + gain + R"(, "m_hapticEffect":
            {"m_amplitudeModulation": {"m_keyframes": [)" +
               amplitudes + R"(]}, "m_frequencyModulation": {"m_keyframes": [)" + frequencies + "]}}}]}]}}";
    };
    const auto point = [](const std::string& time, const std::string& value)
    {
        return R"({"m_time": )" + time + R"(, "m_value": )" + value + "}";
    };
    const std::string note = "m_vibration.m_melodies[0].m_notes[0]";
    const std::string level = note + ".m_hapticEffect.m_amplitudeModulation.m_keyframes[0]";
    const std::string pitch = note + ".m_hapticEffect.m_frequencyModulation.m_keyframes[0]";

    const auto loud = limitsTaken("haps", wave("86399", "1", "10", point("1", "1")));
    CHECK(loud.clip.duration == 86400.0);
    CHECK(loud.clip.bands.at(0).amplitude == Curve{{86399.0, 0.0}, {86399.0, 1000.0}, {86400.0, 1000.0}});
    CHECK(loud.clip.bands.at(0).pitch.empty());
    CHECK(loud.clip.bands.at(0).centreFrequency == 150.0);
    CHECK(loud.warnings.empty());
    CHECK(limitsTaken("haps", wave("0", "0", "0", point("0", "1"))).clip.duration == 0.0);
    limitsRefused("haps", wave("86400.5", "0", "1", point("0", "1")), note + ".m_startingPoint",
                  "must be 0 to 24 hours");
    limitsRefused("haps", wave("-0.5", "1", "1", point("0", "1")), note + ".m_startingPoint", "must be 0 to 24 hours");
    limitsRefused("haps", wave("86399", "1.5", "1", point("0", "1")), note + ".m_length", "must be 0 to 24 hours");
    limitsRefused("haps", wave("1", "-0.5", "1", point("0", "1")), note + ".m_length", "must be 0 to 24 hours");
    limitsRefused("haps", wave("1", "1", "10.01", point("0", "1")), note + ".m_gain", "makes a gain outside 0 to 1000");
    limitsRefused("haps", wave("1", "1", "-0.01", point("0", "1")), note + ".m_gain", "makes a gain outside 0 to 1000");
    limitsRefused("haps", wave("86399", "0", "1", point("1.5", "1")), level + ".m_time", "is later than 24 hours");
    limitsRefused("haps", wave("1", "0", "1", point("-0.5", "1")), level + ".m_time", "is negative");
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("0", "1.5"))).warnings ==
          std::vector<std::string>{level + ".m_value: is outside of 0 to 1 and is limited to this range"});
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("0", "-0.5"))).clip.bands.at(0).amplitude.at(0).value == 0.0);
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("0", "0") + "," + point("1", "1"))).warnings.empty());
    const auto wide =
        limitsTaken("haps", wave("0", "1", "1", point("0", "1"), point("0", "1") + "," + point("1", "20000")));
    CHECK(wide.warnings.empty());
    CHECK(wide.clip.bands.at(0).lowFrequency == 1.0);
    CHECK(wide.clip.bands.at(0).highFrequency == 20000.0);
    CHECK(wide.clip.bands.at(0).centreFrequency == Approx(std::sqrt(20000.0)));
    CHECK(
        limitsTaken("haps", wave("0", "1", "1", point("0", "1"), point("0", "0.5") + "," + point("1", "2"))).warnings ==
        std::vector<std::string>{pitch + ".m_value: is outside of 1 to 20000 and is limited to this range"});
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("0", "1"), point("0", "20001")))
              .clip.bands.at(0)
              .centreFrequency == 20000.0);
    // A millisecond beyond the length is rounding.
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("1.0009", "1"))).warnings.empty());
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("1.0011", "1"))).warnings ==
          std::vector<std::string>{note + ".m_length: ends before its keyframes; they are kept"});
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("1.5", "1"))).clip.duration == 1.5);
    limitsRefused("haps", R"({"m_version": 6, "m_vibration": {}})", "m_version",
                  "is '6.0'; this program reads version 5", ErrorCode::unsupportedVersion);
    limitsRefused("haps", R"({"m_version": "51", "m_vibration": {}})", "m_version",
                  "is '51'; this program reads version 5", ErrorCode::unsupportedVersion);
    limitsRefused("haps", R"({"m_vibration": {}})", "m_version", "is missing");
    CHECK(limitsTaken("haps", R"({"m_version": 5, "m_vibration": {}})").warnings ==
          std::vector<std::string>{"m_vibration: nothing is played"});
}

TEST_CASE(".haps: melodies, mutes and transients are read by their gains", "[formats]")
{
    const std::string transient = R"({"m_startingPoint": @, "m_length": @, "m_gain": @, "m_hapticEffect": {@}})";
    const auto notes = [](const std::string& list, const std::string& melody = "")
    {
        return R"({"m_version": "5", "m_description": "d", "m_texture": {"m_melodies": [{}]}, "m_stiffness":
            {"m_melodies": []}, "m_vibration": {"m_melodies": [{)" +
               melody + R"("m_notes": [)" + list + "]}]}}";
    };
    const auto read = limitsTaken("haps", notes(limitsFilled(transient, {"0.5", "0.4", "0.25", R"("m_type": 0)"}) +
                                                    "," + limitsFilled(transient, {"0.25", "0", "0.75", ""}),
                                                R"("m_gain": 0.5, )"));
    CHECK(read.clip.transients == std::vector<Transient>{{0.25, 0.375, 0.5}, {0.5, 0.125, 0.5}});
    CHECK(read.clip.duration == 0.9);
    CHECK(read.clip.name == "d");
    CHECK(read.warnings ==
          std::vector<std::string>{
              "m_texture: is not read",
              "m_vibration.m_melodies[0].m_notes[1]: has neither a type nor an amplitude and is read as a transient"});
    CHECK(limitsTaken("haps", notes(limitsFilled(transient, {"86400", "0", "1", R"("m_type": 0)"}))).clip.duration ==
          86400.0);
    CHECK(limitsTaken("haps", notes(limitsFilled(transient, {"1", "0.001", "1", R"("m_type": 0)"}))).clip.duration ==
          Approx(1.022));
    const auto muted =
        limitsTaken("haps", notes(limitsFilled(transient, {"1", "0", "1", R"("m_type": 0)"}), R"("m_mute": 1, )"));
    CHECK(muted.clip.transients.empty());
    CHECK(muted.warnings == std::vector<std::string>{"m_texture: is not read",
                                                     "m_vibration.m_melodies[0]: is muted and left out",
                                                     "m_vibration: nothing is played"});
    // Notes that follow each other share a band, those that overlap do not.
    const std::string wave = R"({"m_startingPoint": @, "m_length": @, "m_hapticEffect": {"m_amplitudeModulation":
        {"m_keyframes": [{"m_time": @, "m_value": 0.5}, {"m_time": 0.5, "m_value": 1}]}, "m_frequencyModulation":
        {"m_keyframes": [{"m_time": 0, "m_value": @}]}}})";
    const auto waves = limitsTaken("haps", notes(limitsFilled(wave, {"0", "0.5", "0", "100"}) + "," +
                                                 limitsFilled(wave, {"0.5", "1", "0.25", "200"}) + "," +
                                                 limitsFilled(wave, {"1.25", "0.5", "0", "300"})));
    REQUIRE(waves.clip.bands.size() == 2);
    CHECK(waves.clip.duration == 1.75);
    CHECK(waves.clip.bands[0].amplitude == Curve{{0.0, 0.5},
                                                 {0.5, 1.0},
                                                 {0.5, 0.0},
                                                 {0.5, 0.0},
                                                 {0.5, 0.5},
                                                 {0.75, 0.5},
                                                 {1.0, 1.0},
                                                 {1.5, 1.0},
                                                 {1.5, 0.0}});
    CHECK(waves.clip.bands[0].pitch == Curve{{0.0, 100.0}, {0.5, 200.0}});
    CHECK(waves.clip.bands[1].amplitude == Curve{{1.25, 0.0}, {1.25, 0.5}, {1.75, 1.0}});
    CHECK(waves.clip.bands[1].centreFrequency == 300.0);
}

TEST_CASE("Vibration effects have whole milliseconds, amplitudes of -1 to 255 and frequencies above 0", "[formats]")
{
    const auto steps = [](const std::string& timings, const std::string& amplitudes, const std::string& more = "")
    {
        return R"({"name": "w", "waveform": {"timings": [)" + timings + R"(], "amplitudes": [)" + amplitudes + "]" +
               more + "}}";
    };
    const auto read = limitsTaken("android", steps("0, 10, 86399990", "3, -1, 0", R"(, "repeat": 0)"));
    CHECK(read.clip.duration == 86400.0);
    CHECK(read.clip.bands.at(0).amplitude == Curve{{0.0, 1.0}, {0.01, 1.0}, {0.01, 0.0}, {86400.0, 0.0}});
    CHECK(read.warnings == std::vector<std::string>{"waveform.repeat: the effect is read without its repetition",
                                                    "waveform.amplitudes: the device's default of -1 becomes 255"});
    CHECK(limitsTaken("android", steps("10", "255", R"(, "repeat": -1)")).warnings.empty());
    CHECK(limitsTaken("android", steps("10", "0")).clip.bands.empty());
    CHECK(limitsTaken("android", steps("10", "51")).clip.bands.at(0).amplitude.at(0).value == 0.2);
    limitsRefused("android", steps("10, 10", "1"), "waveform.amplitudes", "has 1 numbers, but 2 timings");
    const std::string whole = "must be a whole number of milliseconds from 0 on";
    limitsRefused("android", steps("10, -1", "1, 1"), "waveform.timings[1]", whole);
    limitsRefused("android", steps("10, 1.5", "1, 1"), "waveform.timings[1]", whole);
    limitsRefused("android", steps("86400000, 1", "1, 1"), "waveform.timings[1]", "ends later than 24 hours",
                  ErrorCode::tooLarge);
    for (const char* level : {"-2", "256", "1.5"})
        limitsRefused("android", steps("10, 10", std::string("1, ") + level), "waveform.amplitudes[1]",
                      "must be a whole number, -1 to 255");
    limitsRefused("android", R"({"name": "x"})", "waveformEnvelope",
                  "is missing, and so are basicEnvelope and waveform");

    const auto points = [](bool isBasic, const std::string& initial, const std::string& level,
                           const std::string& frequency, const std::string& duration)
    {
        return isBasic ? R"({"basicEnvelope": {)" + initial + R"("controlPoints": [{"intensity": )" + level +
                             R"(, "sharpness": )" + frequency + R"(, "durationMs": )" + duration + "}]}}"
                       : R"({"waveformEnvelope": {)" + initial + R"("controlPoints": [{"amplitude": )" + level +
                             R"(, "frequencyHz": )" + frequency + R"(, "durationMs": )" + duration + "}]}}";
    };
    const auto wave = limitsTaken("android", points(false, R"("initialFrequencyHz": 1, )", "1", "20000", "86400000"));
    CHECK(wave.clip.duration == 86400.0);
    CHECK(wave.clip.bands.at(0).amplitude == Curve{{0.0, 0.0}, {86400.0, 1.0}});
    CHECK(wave.clip.bands.at(0).pitch == Curve{{0.0, 1.0}, {86400.0, 20000.0}});
    CHECK(wave.warnings ==
          std::vector<std::string>{"controlPoints: the last amplitude is not 0; Android rejects such effects"});
    const auto basic = limitsTaken("android", points(true, R"("initialSharpness": 0, )", "1", "1", "1"));
    CHECK(basic.clip.bands.at(0).pitch == Curve{{0.0, 65.0}, {0.001, 300.0}});
    CHECK(limitsTaken("android", points(true, "", "1", "0", "1")).clip.bands.at(0).centreFrequency == 65.0);
    CHECK(limitsTaken("android", points(true, "", "0", "1", "1")).warnings.empty());
    const std::string waveList = "waveformEnvelope.controlPoints[0]", basicList = "basicEnvelope.controlPoints[0]";
    for (const char* level : {"-0.001", "1.001"})
    {
        limitsRefused("android", points(false, "", level, "100", "1"), waveList + ".amplitude", "must be 0 to 1");
        limitsRefused("android", points(true, "", level, "1", "1"), basicList + ".intensity", "must be 0 to 1");
        limitsRefused("android", points(true, "", "1", level, "1"), basicList + ".sharpness", "must be 0 to 1");
    }
    for (const char* frequency : {"0", "-1", "20001"})
    {
        const std::string text = "must be above 0 and at most 20000 Hz";
        limitsRefused("android", points(false, "", "1", frequency, "1"), waveList + ".frequencyHz", text);
        limitsRefused("android",
                      points(false, std::string(R"("initialFrequencyHz": )") + frequency + ", ", "1", "100", "1"),
                      "waveformEnvelope.initialFrequencyHz", text);
    }
    limitsRefused("android", points(true, R"("initialSharpness": 1.5, )", "1", "1", "1"),
                  "basicEnvelope.initialSharpness", "must be 0 to 1");
    limitsRefused("android", points(false, "", "1", "100", "0"), waveList + ".durationMs",
                  "must be a whole number of milliseconds from 1 on");
    limitsRefused("android", points(false, "", "1", "100", "1.5"), waveList + ".durationMs",
                  "must be a whole number of milliseconds from 1 on");
    limitsRefused("android", points(false, "", "1", "100", "86400001"), waveList + ".durationMs",
                  "ends later than 24 hours", ErrorCode::tooLarge);
    limitsRefused("android", R"({"basicEnvelope": {"controlPoints": []}})", "basicEnvelope.controlPoints",
                  "has no control point");
}

TEST_CASE("A vibration effect has at most five million steps", "[formats]")
{
    std::string many = "0";
    for (int i = 1; i < 5000000; ++i)
        many += ",0";
    // Not shown where it fails: the texts are long.
    const auto errorOf = [](const std::string& timings, const std::string& amplitudes)
    {
        const auto read = clipFormatNamed("android")->read(R"({"name": "w", "waveform": {"timings": [)" + timings +
                                                           R"(], "amplitudes": [)" + amplitudes + "]}}");
        return read ? "" : read.error().text();
    };
    CHECK(errorOf(many, "0") == "waveform.amplitudes: has 1 numbers, but 5000000 timings");
    many += ",0";
    CHECK(errorOf(many, "0") == "waveform.timings: has more than 5000000 numbers");
    CHECK(errorOf("0", many) == "waveform.amplitudes: has more than 5000000 numbers");
}

TEST_CASE("A table is read by the names of its columns, up to as many as there may be", "[formats]")
{
    const auto warningsOf = [](const std::string& text)
    {
        return limitsTaken("csv", text).warnings;
    };
    const auto read =
        limitsTaken("csv", "# a note\n\n time ; \"envelope\";centroid;frequency;amplitude;event;sharpness;noise 5 9\r\n"
                           "0;0.5;90;80;0.25;;;0.125\r\n\n1;1000;400000;0.001;0;1;0;0\n1;0;0;400000;;;;\n2;;;;;0.5\n");
    CHECK(read.warnings.empty());
    const Clip& clip = read.clip;
    CHECK(clip.envelope == Curve{{0.0, 0.5}, {1.0, 1000.0}, {1.0, 0.0}});
    CHECK(clip.centroid == Curve{{0.0, 90.0}, {1.0, 400000.0}, {1.0, 0.0}});
    REQUIRE(clip.bands.size() == 1);
    CHECK(clip.bands[0].lowFrequency == 150.0);
    CHECK(clip.bands[0].centreFrequency == 150.0);
    CHECK(clip.bands[0].highFrequency == 150.0);
    CHECK(clip.bands[0].amplitude == Curve{{0.0, 0.25}, {1.0, 0.0}});
    CHECK(clip.bands[0].pitch == Curve{{0.0, 80.0}, {1.0, 0.001}, {1.0, 400000.0}});
    CHECK(clip.transients == std::vector<Transient>{{1.0, 1.0, 0.0}, {2.0, 0.5, 0.5}});
    CHECK(clip.noise.at(0).amplitude == Curve{{0.0, 0.125}, {1.0, 0.0}});
    CHECK(clip.noise.at(0).lowFrequency == 5.0);
    CHECK(clip.noise.at(0).highFrequency == 9.0);
    CHECK(clip.duration > 2.01); // until the last event has sounded
    CHECK(limitsTaken("csv", "time,event\n1,1\n3,\n").clip.duration == 3.0);
    CHECK(limitsTaken("csv", "sharpness\ttime\tevent\n0.25\t1\t0.75\n").clip.transients ==
          std::vector<Transient>{{1.0, 0.75, 0.25}});
    CHECK(limitsTaken("csv",
                      "time,amplitude 1 2 3,pitch 1 2 3,amplitude 1 2 4,amplitude 1 3 3,amplitude 2 2 3\n0,1,2,3,4,5")
              .clip.bands.size() == 4);
    CHECK(limitsTaken("csv", "time,amplitude 0 0 400000\n86400,1").clip.duration == 86400.0);
    const std::vector<std::string> leftOut{"line 1: the column 'x' is left out"};
    CHECK(warningsOf("time,x\n0,word") == leftOut);
    CHECK(warningsOf("time,x,x\n0,1,2").size() == 2);
    for (const char* title : {"amplitude 1 2", "amplitude 1 2 3 4", "noise 1", "noise 1 2 3", "pitch -1 2 3",
                              "pitch 1 2 400001", "pitch 1 b 3", "other 1 2 3", "noise", "event 1", "other 1 2"})
        CHECK(warningsOf(std::string("time,") + title + "\n0,1") ==
              std::vector<std::string>{std::string("line 1: the column '") + title + "' is left out"});
    CHECK(warningsOf("time,noise 0 400000\n0,1").empty());
    CHECK(warningsOf("time,noise 7 7\n0,1").empty());

    limitsRefused("csv", "", "", "has no header line with the names of its columns");
    limitsRefused("csv", "# time\n", "", "has no header line with the names of its columns");
    limitsRefused("csv", "a,b\n", "line 1, column 1", "no column is called 'time'");
    limitsRefused("csv", "\n#\ntime,event,event\n", "line 3, column 3", "'event' is given twice");
    limitsRefused("csv", "time,frequency,pitch\n", "line 1, column 3", "'pitch' is given twice");
    limitsRefused("csv", "time,amplitude 3 2 4\n", "line 1, column 2", "needs low <= centre <= high");
    limitsRefused("csv", "time,amplitude 1 5 4\n", "line 1, column 2", "needs low <= centre <= high");
    limitsRefused("csv", "time,noise 3 2\n", "line 1, column 2", "needs low <= high");
    limitsRefused("csv", "time,event\n0,1,2\n", "line 2, column 3", "has more cells than columns");
    limitsRefused("csv", "time,event\n0,1e\n", "line 2, column 2", "'1e' is not a number");
    limitsRefused("csv", "time,event\n0,inf\n", "line 2, column 2", "is not a finite number");
    limitsRefused("csv", "event,time\n1\n", "line 2, column 1", "the time is missing");
    limitsRefused("csv", "event,time\n1,0\n1\n", "line 3, column 2", "the time is missing");
    limitsRefused("csv", "event,time\n1,86401\n", "line 2, column 2", "is later than 24 hours");
    limitsRefused("csv", "event,time\n1,-1\n", "line 2, column 2", "is negative");
    limitsRefused("csv", "event,time\n1,1\n1,0.5\n", "line 3, column 2", "is earlier than the row before");
    limitsRefused("csv", "time,event,sharpness\n0,,1\n", "line 2, column 1",
                  "a sharpness needs an event in the same line");
    limitsRefused("csv", "time,event\n0,1000.5\n", "line 2, column 2", "must be 0 to 1000");
    limitsRefused("csv", "time,event\n0,-0.5\n", "line 2, column 2", "must be 0 to 1000");
    limitsRefused("csv", "time,event,sharpness\n0,1,1.5\n", "line 2, column 3", "must be 0 to 1");
    limitsRefused("csv", "time,centroid\n0,400001\n", "line 2, column 2", "must be 0 to 400000");
    limitsRefused("csv", "time,pitch\n0,0.0009\n", "line 2, column 2", "must be 0.001 to 400000");
    limitsRefused("csv", "time,pitch\n0,400001\n", "line 2, column 2", "must be 0.001 to 400000");
    std::string most = "time";
    for (int i = 1; i < 2 * 256 + 64; ++i)
        most += ",x";
    CHECK(warningsOf(most + "\n0").size() == 575);
    limitsRefused("csv", most + ",x\n0", "line 1, column 577", "there are more than 576 columns");
}

TEST_CASE(".vij: times are 0 to 24 hours and values 0 to 1", "[formats]")
{
    const auto file = [](const std::string& envelopes, const std::string& transients, const std::string& more = "")
    {
        return R"({"voices": {"envelopes": [)" + envelopes + R"(], "transients": [)" + transients + "]" + more + "}}";
    };
    const auto point = [](const std::string& time, const std::string& value)
    {
        return R"({"time": )" + time + R"(, "amplitude": )" + value + "}";
    };
    const auto stated = [&](const std::string& duration)
    {
        std::string text = file("[" + point("0", "1") + "]", "");
        return text.insert(1, R"("metadata": {"duration": )" + duration + "}, ");
    };
    const std::string hold = "[" + point("0", "0.5") + "," + point("1", "0.25") + "]";
    const auto plain = limitsTaken("vij", file(hold, ""));
    CHECK(plain.warnings.empty());
    CHECK(plain.clip.duration == 1.0);
    REQUIRE(plain.clip.bands.size() == 1);
    CHECK(plain.clip.bands[0].lowFrequency == 55.0);
    CHECK(plain.clip.bands[0].centreFrequency == 127.5);
    CHECK(plain.clip.bands[0].highFrequency == 200.0);
    CHECK(plain.clip.bands[0].amplitude == Curve{{0.0, 0.5}, {1.0, 0.25}});
    CHECK(plain.clip.bands[0].pitch.empty());

    // The duration is what is stated, but not before the last amplitude and until the last event has sounded.
    CHECK(limitsTaken("vij", stated("0")).clip.duration == 0.0);
    CHECK(limitsTaken("vij", stated("86400")).clip.duration == 86400.0);
    for (const char* duration : {"-0.5", "86400.5"})
        limitsRefused("vij", stated(duration), "metadata.duration", "must be 0 to 24 hours");
    CHECK(limitsTaken("vij", file("[" + point("86400", "1") + "]", "")).clip.duration == 86400.0);
    limitsRefused("vij", file("[" + point("86400.5", "1") + "]", ""), "voices.envelopes[0][0].time",
                  "is later than 24 hours", ErrorCode::tooLarge);
    limitsRefused("vij", file("[" + point("-0.5", "1") + "]", ""), "voices.envelopes[0][0].time", "is before 0");
    limitsRefused("vij", file(hold + ", [" + point("1", "1") + "," + point("0.5", "1") + "]", ""),
                  "voices.envelopes[1][1].time", "is earlier than the point before it");
    CHECK(limitsTaken("vij", file(hold + ", [" + point("0.5", "1") + "," + point("0.5", "0") + "]", "")).warnings ==
          std::vector<std::string>{});
    limitsRefused("vij", file("[]", ""), "voices.envelopes", "has no point of amplitude");
    const auto tap = limitsTaken("vij", file(hold, "[" + point("3", "1") + "], [" + point("3", "0") + "]"));
    CHECK(tap.clip.duration == Approx(3.02).margin(1e-4));
    CHECK(tap.clip.transients == std::vector<Transient>{{3.0, 1.0, 0.0}});
    // Frequencies after the end stand at it.
    const auto late = limitsTaken("vij", file(hold + ", [" + point("0.5", "0") + "," + point("1.5", "1") + "]", ""));
    CHECK(late.clip.duration == 1.0);
    CHECK(late.clip.bands.at(0).pitch == Curve{{0.5, 55.0}, {1.0, 200.0}});

    const std::string limited = ": is outside of 0 to 1 and is limited to this range";
    const auto loud = limitsTaken("vij", file("[" + point("0", "1.5") + "," + point("1", "-0.5") + "]", ""));
    CHECK(loud.clip.bands.at(0).amplitude == Curve{{0.0, 1.0}, {1.0, 0.0}});
    CHECK(loud.warnings == std::vector<std::string>{"voices.envelopes[0][0].amplitude" + limited,
                                                    "voices.envelopes[0][1].amplitude" + limited});
    CHECK(limitsTaken("vij", file("[" + point("0", "1") + "," + point("1", "0") + "]", "")).warnings.empty());

    // Sharpness is read at the times of the strengths, and in the middle where there is none.
    const std::string strengths = "[" + point("0.25", "1") + "," + point("0.5", "0.5") + "]";
    const auto few = limitsTaken("vij", file(hold, strengths + ", [" + point("0.25", "0.75") + "]"));
    CHECK(few.clip.transients == std::vector<Transient>{{0.25, 1.0, 0.75}, {0.5, 0.5, 0.75}});
    const std::vector<std::string> unequal{
        "voices.transients: the number of sharpnesses differs from that of the strengths; the nearest one is used"};
    CHECK(few.warnings == unequal);
    const auto none = limitsTaken("vij", file(hold, strengths));
    CHECK(none.clip.transients == std::vector<Transient>{{0.25, 1.0, 0.5}, {0.5, 0.5, 0.5}});
    CHECK(none.warnings == unequal);
    const auto both =
        limitsTaken("vij", file(hold, strengths + ", [" + point("0", "0") + "," + point("1", "1") + "], [3]"));
    CHECK(both.clip.transients == std::vector<Transient>{{0.25, 1.0, 0.25}, {0.5, 0.5, 0.5}});
    CHECK(both.warnings.empty());
    CHECK(limitsTaken("vij", file(hold, "", R"(, "bands": [[]])")).warnings ==
          std::vector<std::string>{"voices.bands: is not kept"});
    CHECK(limitsTaken("vij", file(hold, "", R"(, "bands": [])")).warnings.empty());
}

TEST_CASE(".haptic: numbers are taken up to the ends of their ranges", "[formats]")
{
    const std::string pattern = R"({"version": {"major": @, "minor": @, "patch": @}, "metadata": {@}, "signals":
        {"continuous": {"envelopes": {"amplitude": [@], "frequency": [@]}}}})";
    const std::string points = R"({"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.25})";
    const auto with = [&](const std::vector<std::pair<std::size_t, std::string>>& changes)
    {
        std::vector<std::string> values{"1", "0", "0", "", points, ""};
        for (const auto& [i, value] : changes)
            values.at(i) = value;
        return limitsFilled(pattern, values);
    };
    const auto level = [](const std::string& time, const std::string& value, const std::string& emphasis = "")
    {
        return R"({"time": )" + time + R"(, "amplitude": )" + value + emphasis + "}";
    };
    const auto pitch = [](const std::string& time, const std::string& value)
    {
        return R"({"time": )" + time + R"(, "frequency": )" + value + "}";
    };
    const auto plain = limitsTaken("haptic", with({}));
    CHECK(plain.warnings.empty());
    CHECK(plain.clip.bands.at(0).lowFrequency == 55.0);
    CHECK(plain.clip.bands.at(0).centreFrequency == 127.5);
    CHECK(plain.clip.bands.at(0).highFrequency == 200.0);

    limitsRefused("haptic", with({{0, "2"}}), "version.major", "is 2, but only version 1 is read",
                  ErrorCode::unsupportedVersion);
    limitsRefused("haptic", with({{0, "0"}}), "version.major", "is 0, but only version 1 is read",
                  ErrorCode::unsupportedVersion);
    for (const auto& [place, name] : {std::pair<std::size_t, std::string>{1, "minor"}, {2, "patch"}})
    {
        CHECK(limitsTaken("haptic", with({{place, "4294967295"}})).warnings.size() == (place == 1 ? 1 : 0));
        for (const char* number : {"4294967296", "-1", "0.5"})
            limitsRefused("haptic", with({{place, number}}), "version." + name, "must be a whole number from 0");
    }
    CHECK(limitsTaken("haptic", with({{1, "1"}})).warnings ==
          std::vector<std::string>{"version.minor: is 1; entries newer than version 1.0 are not kept"});

    const std::vector<std::string> notKept{"metadata: author, description and tags are not kept"};
    for (const char* one :
         {R"("author": "a")", R"("description": "d")", R"("tags": ["t"])", R"("tags": ["", "t", ""])"})
        CHECK(limitsTaken("haptic", with({{3, one}})).warnings == notKept);
    for (const char* one : {R"("author": "")", R"("description": "")", R"("tags": [""])", R"("editor": "e")"})
        CHECK(limitsTaken("haptic", with({{3, one}})).warnings.empty());
    limitsRefused("haptic", with({{3, R"("editor": 3)"}}), "metadata.editor", "must be a text in quotes");
    CHECK(limitsTaken("haptic", with({{3, R"("source": "a/b\\c/d.wav")"}})).clip.source.file == "d.wav");
    CHECK(limitsTaken("haptic", with({{3, R"("source": "d.wav")"}})).clip.source.file == "d.wav");

    const std::string amplitude = "signals.continuous.envelopes.amplitude";
    const std::string frequency = "signals.continuous.envelopes.frequency";
    CHECK(limitsTaken("haptic", with({{4, level("0", "0") + "," + level("86400", "1")}})).clip.duration == 86400.0);
    limitsRefused("haptic", with({{4, level("0", "0") + "," + level("86401", "1")}}), amplitude + "[1].time",
                  "is later than 24 hours", ErrorCode::tooLarge);
    limitsRefused("haptic", with({{4, level("-0.5", "0")}}), amplitude + "[0].time", "is before 0");
    limitsRefused("haptic", with({{4, level("1", "0") + "," + level("0.5", "0")}}), amplitude + "[1].time",
                  "is earlier than the point before it");
    limitsRefused("haptic", with({{4, ""}}), amplitude, "has no point");
    for (const char* value : {"-0.001", "1.001"})
    {
        limitsRefused("haptic", with({{4, level("0", value)}}), amplitude + "[0].amplitude", "is outside of 0 to 1");
        limitsRefused("haptic", with({{5, pitch("0", value)}}), frequency + "[0].frequency", "is outside of 0 to 1");
        const std::string emphasis = std::string(R"(, "emphasis": {"amplitude": 1, "frequency": )") + value + "}";
        limitsRefused("haptic", with({{4, level("0", "0", emphasis)}}), amplitude + "[0].emphasis.frequency",
                      "is outside of 0 to 1");
    }
    limitsRefused("haptic", with({{4, level("0", "0.5", R"(, "emphasis": {"amplitude": 0.25, "frequency": 0})")}}),
                  amplitude + "[0].emphasis.amplitude", "is below the amplitude of its point");
    const auto tap =
        limitsTaken("haptic", with({{4, level("0", "1", R"(, "emphasis": {"amplitude": 1, "frequency": 1})") + "," +
                                            level("1", "0", R"(, "emphasis": null)")}}));
    CHECK(tap.clip.transients == std::vector<Transient>{{0.0, 1.0, 1.0}});

    CHECK(limitsTaken("haptic", with({{4, level("0.5", "1")}})).warnings ==
          std::vector<std::string>{amplitude + ": has no duration; strict readers refuse it"});
    const std::vector<std::string> beyond{frequency +
                                          ": is longer than the amplitudes and is cut off; strict readers refuse it"};
    const auto cut = limitsTaken("haptic", with({{5, pitch("0", "0") + "," + pitch("2", "1")}}));
    CHECK(cut.warnings == beyond);
    CHECK(cut.clip.bands.at(0).pitch == Curve{{0.0, 55.0}, {1.0, 127.5}});
    const auto after = limitsTaken("haptic", with({{5, pitch("1.5", "0") + "," + pitch("2", "1")}}));
    CHECK(after.warnings == beyond);
    CHECK(after.clip.bands.at(0).pitch == Curve{{1.0, 55.0}});
    CHECK(limitsTaken("haptic", with({{5, pitch("0", "0") + "," + pitch("1", "1")}})).warnings.empty());
    const std::string started = level("0.25", "0") + "," + level("1", "1");
    CHECK(limitsTaken("haptic", with({{4, started}, {5, pitch("0", "0")}})).warnings == beyond);
    CHECK(limitsTaken("haptic", with({{4, started}, {5, pitch("0.25", "0")}})).warnings.empty());
}

TEST_CASE("AHAP: what is out of range is limited, refused or left out in these words", "[formats]")
{
    const auto file = [](const std::string& pattern, const std::string& head = "")
    {
        return "{" + head + R"("Pattern": [)" + pattern + "]}";
    };
    const auto event = [](const std::string& type, const std::string& time, const std::string& duration,
                          const std::string& parameters = "")
    {
        return R"({"Event": {"EventType": ")" + type + R"(", "Time": )" + time + R"(, "EventDuration": )" + duration +
               R"(, "EventParameters": [)" + parameters + "]}}";
    };
    const auto parameter = [](const std::string& id, const std::string& value)
    {
        return R"({"ParameterID": ")" + id + R"(", "ParameterValue": )" + value + "}";
    };
    const auto curve = [](const std::string& id, const std::string& time, const std::string& points)
    {
        return R"({"ParameterCurve": {"ParameterID": ")" + id + R"(", "Time": )" + time +
               R"(, "ParameterCurveControlPoints": [)" + points + "]}}";
    };
    const auto point = [](const std::string& time, const std::string& value)
    {
        return R"({"Time": )" + time + R"(, "ParameterValue": )" + value + "}";
    };
    const auto control = [](const std::string& id, const std::string& time, const std::string& value)
    {
        return R"({"Parameter": {"ParameterID": ")" + id + R"(", "Time": )" + time + R"(, "ParameterValue": )" + value +
               "}}";
    };
    const std::string tap = event("HapticTransient", "0.5", "0");
    CHECK(limitsTaken("ahap", file(tap, R"("Version": 1.0, "Metadata": {"Project": "p"}, )")).clip.name == "p");
    limitsRefused("ahap", file(tap, R"("Version": 1.1, )"), "Version", "is 1.1, but only version 1 is read",
                  ErrorCode::unsupportedVersion);
    const auto plain = limitsTaken("ahap", file(tap));
    CHECK(plain.clip.transients == std::vector<Transient>{{0.5, 1.0, 0.5}});
    CHECK(plain.clip.bands.empty());
    CHECK(plain.warnings.empty());
    CHECK(limitsTaken("ahap", file(event("HapticTransient", "86400", "0"))).clip.duration == 86400.0);
    limitsRefused("ahap", file(event("HapticTransient", "86400.5", "0")), "Pattern[0].Event.Time",
                  "is later than 24 hours", ErrorCode::tooLarge);
    limitsRefused("ahap", file(event("HapticTransient", "-0.5", "0")), "Pattern[0].Event.Time", "is before 0");
    limitsRefused("ahap", file(event("HapticContinuous", "1", "-0.5")), "Pattern[0].Event.EventDuration", "is below 0");
    limitsRefused("ahap", file(event("HapticContinuous", "86399", "1.5")), "Pattern[0].Event.EventDuration",
                  "is later than 24 hours", ErrorCode::tooLarge);
    CHECK(limitsTaken("ahap", file(event("HapticContinuous", "86399", "1"))).clip.duration == 86400.0);
    limitsRefused("ahap", file(event("Haptic", "1", "0")), "Pattern[0].Event.EventType",
                  "is no type of event: 'Haptic'");
    limitsRefused("ahap", file("{}"), "Pattern[0]", "is neither an Event, a Parameter nor a ParameterCurve");
    CHECK(
        limitsTaken("ahap", file(event("AudioCustom", "1", "0") + "," + event("AudioContinuous", "1", "0"))).warnings ==
        std::vector<std::string>{"Pattern: audio events are not kept"});

    const auto limited = limitsTaken(
        "ahap", file(event("HapticTransient", "0.5", "0",
                           parameter("HapticIntensity", "1.5") + "," + parameter("HapticSharpness", "-0.5"))));
    CHECK(limited.clip.transients == std::vector<Transient>{{0.5, 1.0, 0.0}});
    CHECK(limited.warnings ==
          std::vector<std::string>{"Pattern[0].Event.EventParameters[0].ParameterValue: is outside of 0 to 1 and is "
                                   "limited to this range",
                                   "Pattern[0].Event.EventParameters[1].ParameterValue: is outside of 0 to 1 and is "
                                   "limited to this range"});
    const auto kept =
        limitsTaken("ahap", file(event("HapticTransient", "0.5", "0",
                                       parameter("HapticIntensity", "0") + "," + parameter("HapticSharpness", "1"))));
    CHECK(kept.clip.transients == std::vector<Transient>{{0.5, 0.0, 1.0}});
    CHECK(kept.warnings.empty());
    std::string many;
    for (int i = 0; i < 25; ++i)
        many += (i > 0 ? "," : "") + parameter("HapticIntensity", "2");
    CHECK(limitsTaken("ahap", file(event("HapticTransient", "0.5", "0", many))).warnings.size() == 20);
    const auto ignoredOf = [&](const std::string& id, const std::string& value)
    {
        return limitsTaken("ahap", file(event("HapticTransient", "0.5", "0", parameter(id, value)))).warnings;
    };
    CHECK(ignoredOf("AttackTime", "0").empty());
    CHECK(ignoredOf("AttackTime", "0.5") == std::vector<std::string>{"Pattern: the parameter AttackTime is not kept"});
    CHECK(ignoredOf("Sustained", "1").empty());
    CHECK(ignoredOf("Sustained", "0") == std::vector<std::string>{"Pattern: the parameter Sustained is not kept"});
    CHECK(ignoredOf("AttackTime", "1").size() == 1);
    CHECK(ignoredOf("", "1").empty());

    const auto curved = [&](const std::string& id, const std::string& points)
    {
        return limitsTaken("ahap", file(tap + "," + curve(id, "0.25", points)));
    };
    const auto scaled = curved("HapticIntensityControl", point("0", "0.5") + "," + point("0.5", "1"));
    CHECK(scaled.clip.transients == std::vector<Transient>{{0.5, 0.5625, 0.5}});
    CHECK(scaled.clip.duration == 0.75);
    CHECK(scaled.warnings.empty());
    CHECK(curved("HapticSharpnessControl", point("0", "-1")).clip.transients.at(0).sharpness == 0.0);
    CHECK(curved("HapticSharpnessControl", point("0", "0.25")).clip.transients.at(0).sharpness == 0.75);
    CHECK(curved("HapticSharpnessControl", point("0", "1")).clip.transients.at(0).sharpness == 1.0);
    CHECK(curved("HapticSharpnessControl", point("0", "1")).warnings.empty());
    CHECK(curved("HapticSharpnessControl", point("0", "-1.5")).warnings ==
          std::vector<std::string>{
              "Pattern: values of HapticSharpnessControl outside of -1 to 1 are limited to this range"});
    CHECK(curved("HapticIntensityControl", point("0", "0")).warnings.empty());
    CHECK(curved("HapticIntensityControl", point("0", "-0.5")).warnings ==
          std::vector<std::string>{
              "Pattern: values of HapticIntensityControl outside of 0 to 1 are limited to this range"});
    CHECK(curved("HapticIntensityControl", point("0", "1.5")).clip.transients.at(0).amplitude == 1.0);
    CHECK(curved("HapticAttackControl", point("0", "1")).warnings ==
          std::vector<std::string>{"Pattern: the parameter HapticAttackControl is not kept"});
    const std::string place = "Pattern[0].ParameterCurve.ParameterCurveControlPoints";
    const auto wrongCurve = [&](const std::string& time, const std::string& points)
    {
        return file(curve("HapticIntensityControl", time, points));
    };
    limitsRefused("ahap", wrongCurve("0", ""), place, "has no point");
    limitsRefused("ahap", wrongCurve("0", point("1", "1") + "," + point("0.5", "1")), place + "[1].Time",
                  "is earlier than the point before it");
    limitsRefused("ahap", wrongCurve("0", point("-0.5", "1")), place + "[0].Time", "is before 0");
    limitsRefused("ahap", wrongCurve("86400", point("0.5", "1")), place + "[0].Time", "is later than 24 hours",
                  ErrorCode::tooLarge);
    limitsRefused("ahap", wrongCurve("-1", point("2", "1")), "Pattern[0].ParameterCurve.Time", "is before 0");
    limitsRefused("ahap", file(control("HapticIntensityControl", "-1", "1")), "Pattern[0].Parameter.Time",
                  "is before 0");
    CHECK(limitsTaken("ahap", wrongCurve("0", point("0", "1") + "," + point("0", "0.5"))).warnings.empty());

    // Controls step, and a sound takes the value after a step at its start and the one before a step at its end.
    const auto stepped = limitsTaken(
        "ahap",
        file(event("HapticContinuous", "0", "1") + "," + control("HapticIntensityControl", "0.25", "0.5") + "," +
             control("HapticIntensityControl", "0.75", "0") + "," + control("HapticSharpnessControl", "0.5", "0.25") +
             "," + event("HapticContinuous", "1.25", "0.25", parameter("HapticIntensity", "0.5"))));
    REQUIRE(stepped.clip.bands.size() == 1);
    CHECK(test::asNumbers(stepped.clip.bands[0].lowFrequency, stepped.clip.bands[0].centreFrequency,
                          stepped.clip.bands[0].highFrequency, stepped.clip.bands[0].priority,
                          stepped.clip.duration) == test::Numbers{65.0, 182.5, 300.0, 0, 1.5});
    const Curve& amplitude = stepped.clip.bands[0].amplitude;
    CHECK(valueAt(amplitude, 0.2) == 1.0);
    CHECK(valueAt(amplitude, 0.3) == 0.25);
    CHECK(valueAt(amplitude, 0.8) == 0.0);
    CHECK(valueAt(stepped.clip.bands[0].pitch, 0.4) == 182.5);
    CHECK(valueAt(stepped.clip.bands[0].pitch, 0.6) == 241.25);
    const auto both =
        limitsTaken("ahap", file(event("HapticContinuous", "0", "1") + "," + event("HapticContinuous", "0.5", "1") +
                                 "," + event("HapticContinuous", "1", "0.5")));
    CHECK(both.clip.bands.size() == 2);
    CHECK(both.clip.bands.at(1).priority == 1);
    CHECK(both.warnings == std::vector<std::string>{"Pattern: continuous events that sound together are weaker where "
                                                    "they add up to more than full drive"});
    const auto open =
        limitsTaken("ahap", file(event("HapticContinuous", "1", "0") + "," + event("HapticTransient", "50", "0")));
    CHECK(valueAt(open.clip.bands.at(0).amplitude, 30.9) == 1.0);
    CHECK(valueAt(open.clip.bands.at(0).amplitude, 31.1) == 0.0);
    CHECK(limitsTaken("ahap", file(event("HapticContinuous", "1", "0"))).clip.duration == 31.0);
    CHECK(open.warnings ==
          std::vector<std::string>{
              "Pattern: continuous events without a duration last to the end of the pattern, but at most 30 s"});
}

TEST_CASE("HJIF: numbers are taken up to the ends of their ranges", "[formats]")
{
    const std::string pattern = R"({"version": "@", "profile": "Main", "level": 1, "date": "2026-01-01",
        "description": "d", "timescale": @, "avatars": [], "syncs": [], "perceptions": [{"id": 0, "avatar_id": 0,
        "perception_modality": "Vibrotactile", "perception_unit_exponent": @, "effect_library": [], "channels": [{"gain": @,
        "frequency_sampling": @, "sample_count": @, "bands": [{"band_type": "@", "lower_frequency_limit": @,
        "upper_frequency_limit": @, "effects": [{"effect_type": "@", "position": @, "keyframes": [
        {"relative_position": @, "amplitude_modulation": @}, {"relative_position": 100, "amplitude_modulation": 0.5}]}]}]}]}]})";
    const auto with = [&](const std::vector<std::pair<std::size_t, std::string>>& changes)
    {
        std::vector<std::string> values{"2023", "1000", "0",     "1", "8000", "0",  "VectorialWave",
                                        "40",   "120",  "Basis", "0", "0",    "0.5"};
        for (const auto& [i, value] : changes)
            values.at(i) = value;
        return limitsFilled(pattern, values);
    };
    const std::string channel = "perceptions[0].channels[0]", band = channel + ".bands[0]",
                      effect = band + ".effects[0]";
    const auto plain = limitsTaken("hjif", with({}));
    CHECK(plain.warnings.empty());
    CHECK(plain.clip.name == "d");
    CHECK(plain.clip.duration == 0.1);
    CHECK(plain.clip.bands.at(0).amplitude == Curve{{0.0, 0.5}, {0.1, 0.5}});
    CHECK(plain.clip.bands.at(0).centreFrequency == Approx(std::sqrt(4800.0)));
    const std::string year = "must be a year from 2023, such as \"2023\" or \"2023-1\"";
    for (const char* version : {"2022", "202", "", "20x3", "2023.1", "20231"})
        limitsRefused("hjif", with({{0, version}}), "version", year);
    CHECK(limitsTaken("hjif", with({{0, "2025-1"}})).warnings.empty());
    CHECK(limitsTaken("hjif", with({{0, "2026"}})).warnings ==
          std::vector<std::string>{"version: 2026 is newer than the versions that this program supports"});
    CHECK(limitsTaken("hjif", with({{1, "1"}})).clip.duration == 100.0);
    CHECK(limitsTaken("hjif", with({{1, "1e9"}})).clip.duration == Approx(1e-7));
    for (const char* ticks : {"0.5", "1000000001"})
        limitsRefused("hjif", with({{1, ticks}}), "timescale", "must be 1 to 1000000000 ticks per second");
    CHECK(limitsTaken("hjif", with({{2, "-12"}})).clip.bands.at(0).amplitude.at(0).value == Approx(0.5e-12));
    CHECK(limitsTaken("hjif", with({{2, "3"}})).clip.bands.at(0).amplitude.at(0).value == Approx(500.0));
    CHECK(limitsTaken("hjif", with({{2, "12"}, {3, "1e-9"}})).clip.bands.at(0).amplitude.at(0).value == Approx(500.0));
    for (const char* exponent : {"-12.5", "12.5"})
        limitsRefused("hjif", with({{2, exponent}}), "perceptions[0].perception_unit_exponent", "must be -12 to 12");
    CHECK(limitsTaken("hjif", with({{3, "-2"}})).clip.bands.at(0).amplitude.at(0).value == 1.0);
    for (const char* gain : {"1e6", "-1e6"})
        CHECK(limitsTaken("hjif", with({{2, "-6"}, {3, gain}})).clip.bands.at(0).amplitude.at(0).value == Approx(0.5));
    for (const char* gain : {"1000001", "-1000001"})
        limitsRefused("hjif", with({{3, gain}}), channel + ".gain", "must be -1000000 to 1000000");
    CHECK(limitsTaken("hjif", with({{5, "4000"}})).clip.duration == 0.5);
    CHECK(limitsTaken("hjif", with({{5, "4000"}})).clip.bands.at(0).amplitude ==
          Curve{{0.0, 0.5}, {0.1, 0.5}, {0.1, 0.0}});
    CHECK(limitsTaken("hjif", with({{4, "0"}, {5, "4000"}})).clip.duration == 0.1);
    CHECK(limitsTaken("hjif", with({{5, "-4000"}})).clip.duration == 0.1);
    CHECK(limitsTaken("hjif", with({{5, "400"}})).clip.duration == 0.1);
    const std::string range = "needs 0 <= lower_frequency_limit <= upper_frequency_limit <= 400000";
    CHECK(limitsTaken("hjif", with({{7, "0"}, {8, "0"}})).clip.bands.size() == 1);
    CHECK(limitsTaken("hjif", with({{7, "120"}, {8, "400000"}})).clip.bands.size() == 1);
    limitsRefused("hjif", with({{7, "-1"}}), band, range);
    limitsRefused("hjif", with({{7, "121"}}), band, range);
    limitsRefused("hjif", with({{8, "400001"}}), band, range);
    limitsRefused("hjif", with({{6, "Wave"}}), band + ".band_type",
                  "must be Transient, Curve, VectorialWave or WaveletWave, not 'Wave'");
    limitsRefused("hjif", with({{9, "Base"}}), effect + ".effect_type",
                  "must be Basis, Reference or Composite, not 'Base'");
    limitsRefused("hjif", with({{9, "Reference"}}), effect + ".id", "is missing");
    limitsRefused("hjif", with({{9, "Composite"}}), "perceptions", "contain no vibration over time");
    CHECK(limitsTaken("hjif", with({{10, "86399900"}})).clip.duration == 86400.0);
    limitsRefused("hjif", with({{10, "86399901"}}), effect + ".keyframes[1].relative_position",
                  "must be 0 to 24 hours");
    limitsRefused("hjif", with({{10, "86400001"}}), effect + ".position", "must be 0 to 24 hours");
    limitsRefused("hjif", with({{10, "-1"}}), effect + ".position", "must be 0 to 24 hours");
    limitsRefused("hjif", with({{11, "-1"}}), effect + ".keyframes[0].relative_position", "must be 0 to 24 hours");
    limitsRefused("hjif", with({{11, "101"}}), effect + ".keyframes[1].relative_position",
                  "is earlier than the keyframe before it");
    CHECK(limitsTaken("hjif", with({{11, "100"}})).clip.duration == 0.1);
    CHECK(limitsTaken("hjif", with({{12, "1000.9"}})).clip.bands.at(0).amplitude.at(0).value == 1000.0);
    for (const char* level : {"1001.1", "-1001.1"})
        limitsRefused("hjif", with({{12, level}}), effect + ".keyframes[0].amplitude_modulation",
                      "is more than a thousand times full drive");
    // A transient: of its frequency, or of the middle one, above its strength by that of its pulse.
    const auto tap = limitsTaken("hjif", with({{6, "Transient"}, {10, "50"}, {12, "-0.25"}}));
    REQUIRE(tap.clip.transients.size() == 2);
    CHECK(tap.clip.transients[0].time == 0.05);
    CHECK(tap.clip.transients[0].sharpness == 0.5);
    CHECK(tap.clip.transients[0].amplitude == Approx(0.25 / hjifTransientLevel(0.5)));
    CHECK(tap.clip.transients[1].time == 0.15);
    CHECK(tap.clip.duration == Approx(0.172).margin(0.003));
    CHECK(tap.clip.bands.empty());
    std::string missing = with({{6, "Transient"}});
    missing.replace(missing.find(R"(, "amplitude_modulation": 0.5})"), 29, "");
    CHECK(limitsTaken("hjif", missing).warnings ==
          std::vector<std::string>{effect + ": a transient without amplitude is left out"});
    std::string other = with({});
    other.replace(other.find("Vibrotactile"), 12, "Temperature");
    limitsRefused("hjif", other, "perceptions", "contain no vibration over time");
    for (const char* modality :
         {"Other", "Pressure", "Acceleration", "Velocity", "Position", "Vibration", "Force", "Kinesthetic"})
    {
        std::string known = with({});
        known.replace(known.find("Vibrotactile"), 12, modality);
        CHECK(limitsTaken("hjif", known).clip.bands.size() == 1);
    }
    for (const char* name : {"profile", "level", "date", "avatars", "syncs"})
    {
        std::string without = with({});
        without.insert(without.find(std::string("\"") + name + "\"") + 1, "x");
        CHECK(limitsTaken("hjif", without).warnings ==
              std::vector<std::string>{std::string(name) + ": is missing; other players refuse the file"});
    }
    // Two channels sound at half their strength each.
    std::string two = with({});
    const auto from = two.find(R"({"gain")");
    const std::string one = two.substr(from, two.size() - from - 4);
    two.insert(from, one + ",");
    const auto merged = limitsTaken("hjif", two);
    CHECK(merged.clip.bands.size() == 2);
    CHECK(merged.clip.bands.at(0).amplitude.at(0).value == 0.25);
    CHECK(merged.warnings ==
          std::vector<std::string>{"perceptions: 2 channels are merged into one clip, each at 1 / 2"});
}

TEST_CASE("Rates of drive samples are 2 to 48 kHz, and samples go up to full scale", "[formats]")
{
    Clip clip;
    clip.duration = 0.05;
    clip.bands.push_back({100.0, 100.0, 100.0, 0, {{0.0, 2.0}}, {}});
    ExportParams params;
    for (const int rate : {2000, 48000})
    {
        params.sampleRate = rate;
        CHECK(clipFormatNamed("raw8")->write(clip, params).ok());
    }
    for (const int rate : {1999, 48001})
    {
        params.sampleRate = rate;
        const auto refused = clipFormatNamed("raw8")->write(clip, params);
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.error().where == "sampleRate");
        CHECK(refused.error().message == "must be 2000 to 48000 Hz");
        CHECK(refused.error().code == ErrorCode::invalidArgument);
    }
    params.sampleRate = 2000;
    const auto raw = clipFormatNamed("raw16")->write(clip, params);
    REQUIRE(raw.ok());
    const std::string& bytes = raw->files.at(0).bytes;
    CHECK(bytes.size() == 200);
    int largest = 0, smallest = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 2)
    {
        const int value = static_cast<unsigned char>(bytes[i]) + 256 * static_cast<signed char>(bytes[i + 1]);
        largest = std::max(largest, value);
        smallest = std::min(smallest, value);
    }
    CHECK(largest == 32767);
    CHECK(smallest == -32768);
    clip.bands[0] = {950.0, 950.0, 950.0, 0, {{0.0, 0.5}}, {}};
    const auto high = clipFormatNamed("raw16")->write(clip, params);
    REQUIRE(high.ok());
    REQUIRE(high->losses.size() == 1);
    CHECK(high->losses[0].kind == LossKind::frequency);
    CHECK(high->losses[0].error == Approx(std::log2(950.0 / 900.0)));
    CHECK(high->losses[0].duration == 0.05);
    clip.bands[0].centreFrequency = 900.0;
    clip.bands[0].lowFrequency = 900.0;
    CHECK(clipFormatNamed("raw16")->write(clip, params)->losses.empty());
    // An odd number of bytes is filled up in a WAV file.
    params.sampleRate = 2000;
    clip.duration = 0.0505;
    const auto wav = clipFormatNamed("wav8")->write(clip, params);
    REQUIRE(wav.ok());
    CHECK(wav->files.at(0).bytes.size() == 44 + 102);
    CHECK(static_cast<unsigned char>(wav->files.at(0).bytes[40]) == 101);
    CHECK(static_cast<unsigned char>(wav->files.at(0).bytes[4]) == 36 + 102);
}

TEST_CASE("A name that is too long is cut in every format that has one", "[formats]")
{
    const std::string most(125000, 'n');
    for (auto [format, text] : {std::pair<std::string, std::string>{"tact", test::tactSample()},
                                {"hjif", test::hjifSample()},
                                {"haps", test::hapsSample()},
                                {"android", test::androidWaveformSample()}})
    {
        CAPTURE(format);
        const std::string key = format == "hjif"   ? R"("description": "sample)"
                                : format == "haps" ? R"("m_description": "d)"
                                : format == "tact" ? R"("name": "t)"
                                                   : R"("name": "w)";
        const auto place = text.find(key);
        REQUIRE(place != std::string::npos);
        const auto start = text.find('"', text.find(':', place)) + 1;
        text.replace(start, place + key.size() - start, most + "\u20AC");
        const auto read = clipFormatNamed(format)->read(text);
        REQUIRE(read.ok());
        CHECK((read->clip.name == most)); // not shown, being long
    }
}

TEST_CASE("Lists that hold everything else have at most as many elements as any player knows", "[formats]")
{
    struct Limited
    {
        const char* format;
        std::string before, after, where;
        std::size_t most;
        const char* elements;
    };
    const std::string head = R"({"version": "2023", "timescale": 1000, "perceptions": [)";
    const std::string channels = head + R"({"perception_modality": "Vibrotactile", "channels": [)";
    const std::vector<Limited> all{
        {"haps", R"({"m_version": "5", "m_vibration": {"m_melodies": [)", "]}}", "m_vibration.m_melodies", 100000,
         "melodies"},
        {"tact", R"({"project": {"name": "n", "tracks": [)", "]}}", "project.tracks", 10000, "tracks"},
        {"hjif", head, "]}", "perceptions", 65535, "perceptions"},
        {"hjif", channels, "]}]}", "perceptions[0].channels", 65535, "channels"},
        {"hjif", channels + R"({"gain": 1, "bands": [)", "]}]}]}", "perceptions[0].channels[0].bands", 65535, "bands"}};
    for (const Limited& list : all)
    {
        CAPTURE(list.format, list.where);
        const auto errorOf = [&](const std::string& elements)
        {
            const auto read = clipFormatNamed(list.format)->read(list.before + elements + list.after);
            return read ? Error{} : read.error();
        };
        std::string numbers = "0";
        for (std::size_t i = 1; i < list.most; ++i)
            numbers += ",0";
        const Error inside = errorOf(numbers); // there are not too many, but they are wrong
        CHECK(inside.where == list.where + "[0]");
        CHECK(inside.code == ErrorCode::invalidData);
        const Error beyond = errorOf(numbers + ",0");
        CHECK(beyond.where == list.where);
        CHECK(beyond.message == "has more than " + std::to_string(list.most) + " " + list.elements);
        CHECK(beyond.code == ErrorCode::tooLarge);
    }
}
