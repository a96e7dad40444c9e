// What readers of other formats take at the end of each range and refuse just beyond it, in which words.

#include "io/formats/ClipFormat.h"
#include "io/formats/FormatSamples.h"
#include "support/Catch.h"

#include <cmath>
#include <cstddef>
#include <string>
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
          std::vector<std::string>{"project.tracks: the strongest motor of all places is read as one amplitude"});
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
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("0", "1"), point("0", "0.5"))).warnings ==
          std::vector<std::string>{pitch + ".m_value: is outside of 1 to 20000 and is limited to this range"});
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("0", "1"), point("0", "20001")))
              .clip.bands.at(0)
              .centreFrequency == 20000.0);
    // A millisecond beyond the length is rounding.
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("1.0009", "1"))).warnings.empty());
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("1.0011", "1"))).warnings ==
          std::vector<std::string>{note + ".m_length: ends before the keyframes; they are kept"});
    CHECK(limitsTaken("haps", wave("0", "1", "1", point("1.5", "1"))).clip.duration == 1.5);
    limitsRefused("haps", R"({"m_version": 6, "m_vibration": {}})", "m_version",
                  "is '6.0'; this program reads version 5", ErrorCode::unsupportedVersion);
    limitsRefused("haps", R"({"m_version": "51", "m_vibration": {}})", "m_version",
                  "is '51'; this program reads version 5", ErrorCode::unsupportedVersion);
    limitsRefused("haps", R"({"m_vibration": {}})", "m_version", "is missing");
    CHECK(limitsTaken("haps", R"({"m_version": 5, "m_vibration": {}})").warnings ==
          std::vector<std::string>{"m_vibration: nothing sounds"});
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
    CHECK(read.warnings == std::vector<std::string>{
                               "m_texture: is not read",
                               "m_vibration.m_melodies[0].m_notes[1]: has neither a type nor an amplitude; taken for "
                               "a transient"});
    CHECK(limitsTaken("haps", notes(limitsFilled(transient, {"86400", "0", "1", R"("m_type": 0)"}))).clip.duration ==
          86400.0);
    CHECK(limitsTaken("haps", notes(limitsFilled(transient, {"1", "0.001", "1", R"("m_type": 0)"}))).clip.duration ==
          Approx(1.022));
    const auto muted =
        limitsTaken("haps", notes(limitsFilled(transient, {"1", "0", "1", R"("m_type": 0)"}), R"("m_mute": 1, )"));
    CHECK(muted.clip.transients.empty());
    CHECK(muted.warnings == std::vector<std::string>{"m_texture: is not read",
                                                     "m_vibration.m_melodies[0]: is muted and left out",
                                                     "m_vibration: nothing sounds"});
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
    CHECK(read.warnings == std::vector<std::string>{"waveform.repeat: the effect is read once",
                                                    "waveform.amplitudes: the device's default of -1 becomes 255"});
    CHECK(limitsTaken("android", steps("10", "255", R"(, "repeat": -1)")).warnings.empty());
    CHECK(limitsTaken("android", steps("10", "0")).clip.bands.empty());
    CHECK(limitsTaken("android", steps("10", "51")).clip.bands.at(0).amplitude.at(0).value == 0.2);
    limitsRefused("android", steps("10, 10", "1"), "waveform.amplitudes", "has 1 numbers beside 2 timings");
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
          std::vector<std::string>{"controlPoints: the last amplitude is not 0; Android refuses this"});
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
