// Files as other programs really write them: read with a warning where their own players do.

#include "io/ClipFile.h"
#include "io/formats/ClipFormat.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/haptic/HapticFormat.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{
ImportedClip readAs(const char* format, const std::string& text)
{
    auto read = clipFormatNamed(format)->read(text);
    INFO((read.ok() ? "" : read.error().text()));
    REQUIRE(read.ok());
    return std::move(*read);
}

std::string errorOf(const char* format, const std::string& text)
{
    const auto read = clipFormatNamed(format)->read(text);
    return read.ok() ? "" : read.error().text();
}

std::string corpus(const char* path)
{
    std::ifstream file(sourceFolder() / "Tests/fuzz/corpus" / path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string haps(const std::string& keyframes)
{
    return R"({"m_version": "5", "m_vibration": {"m_melodies": [{"m_notes": [{"m_startingPoint": 0, "m_length": 1,
        "m_hapticEffect": {"m_amplitudeModulation": {"m_keyframes": [)" +
           keyframes + "]}}}]}]}}";
}

std::string tact(const std::string& start, const std::string& intensity)
{
    return R"({"project": {"name": "x", "tracks": [{"effects": [{"startTime": )" + start +
           R"(, "offsetTime": "200", "modes": {"Vest": {"mode": "DOT_MODE", "dotMode": {"feedback": [
        {"startTime": "0", "endTime": 200, "pointList": [{"index": "3", "intensity": )" +
           intensity + R"(}]}]}}}}]}]}, "durationMillis": "300"})";
}

std::string vij(const std::string& envelopes, const std::string& transients, const std::string& duration = "1")
{
    return R"({"metadata": {"editor": "x", "format": "Additive", "duration": )" + duration +
           R"(}, "voices": {"envelopes": )" + envelopes + R"(, "bands": [], "transients": )" + transients + "}}";
}

std::string hasp(const std::string& clips)
{
    return R"({"version": "2.0.0", "metadata": {"name": "p"}, "clips": [)" + clips + "]}";
}

std::string haspClip(const std::string& name, double end = 1.0)
{
    return R"({"clipId": "1", "name": ")" + name + R"(", "haptic": {"version": {"major": 1}, "signals": {"continuous":
        {"envelopes": {"amplitude": [{"time": 0, "amplitude": 0.5}, {"time": )" +
           std::to_string(end) + R"(, "amplitude": 0.5}]}}}}})";
}
} // namespace

TEST_CASE(".haps: keyframes out of order are put into it with a warning", "[io][formats]")
{
    const auto read = readAs("haps", haps(R"({"m_time": 0, "m_value": 0.1}, {"m_time": 0.8, "m_value": 0.9},
                                             {"m_time": 0.4, "m_value": 0.5}, {"m_time": 1, "m_value": 0})"));
    REQUIRE(read.warnings.size() == 1);
    CHECK(read.warnings[0].find("m_keyframes: are not in order") != std::string::npos);
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.4) == Approx(0.5));
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.6) == Approx(0.7));
    CHECK(errorOf("haps", haps(R"({"m_time": 0.5, "m_value": 0}, {"m_time": -1, "m_value": 0})"))
              .find("m_keyframes[1].m_time: is negative") != std::string::npos);
}

TEST_CASE(".haps: frequencies of 0 to 1 are fractions, not Hz that nobody feels", "[io][formats]")
{
    const auto withFrequency = [](const std::string& keyframes)
    {
        std::string text = haps(R"({"m_time": 0, "m_value": 0.5}, {"m_time": 1, "m_value": 0.9})");
        return text.replace(text.find(R"("m_amplitudeModulation")"), 0,
                            R"("m_frequencyModulation": {"m_keyframes": [)" + keyframes + "]}, ");
    };
    const auto half = readAs("haps", withFrequency(R"({"m_time": 0, "m_value": 0.5})"));
    REQUIRE(half.clip.bands.size() == 1);
    CHECK(half.clip.bands[0].centreFrequency == 410.0); // 60 + 700 / 2
    REQUIRE(half.warnings.size() == 1);
    CHECK(half.warnings[0].find("fractions of 60 to 760 Hz") != std::string::npos);
    const auto course = readAs("haps", withFrequency(R"({"m_time": 0, "m_value": 0}, {"m_time": 1, "m_value": 1})"));
    CHECK(course.clip.bands[0].pitch == Curve{{0.0, 60.0}, {1.0, 760.0}});
    const auto none = readAs("haps", withFrequency(R"({"m_time": 0, "m_value": 0})"));
    CHECK(none.clip.bands[0].centreFrequency == 150.0);
    CHECK(none.warnings.size() == 1);
    const auto hertz = readAs("haps", withFrequency(R"({"m_time": 0, "m_value": 1.5})"));
    CHECK(hertz.clip.bands[0].centreFrequency == 1.5);
    CHECK(hertz.warnings.empty());
}

TEST_CASE(".haps: gains of file and effect count, and a loop or numbers that nobody explains are told", "[io][formats]")
{
    const auto with = [](const std::string& outer, const std::string& inner)
    {
        std::string text = haps(R"({"m_time": 0, "m_value": 0.5}, {"m_time": 1, "m_value": 0.5})");
        text.replace(text.find(R"("m_vibration": {)"), 16, outer + R"("m_vibration": {)" + inner);
        return readAs("haps", text);
    };
    const auto quiet =
        with(R"("m_gain": 0.5, "m_time_unit": 0, )", R"("m_gain": 0.5, "m_loop": 0, "m_maximum": 1.0, )");
    CHECK(quiet.warnings.empty());
    CHECK(valueAt(quiet.clip.bands[0].amplitude, 0.5) == Approx(0.125));
    const auto loop = with("", R"("m_loop": 1, )");
    CHECK(loop.warnings ==
          std::vector<std::string>{"m_vibration.m_loop: says that the effect is repeated, which a clip "
                                   "does not; it is read once; repeat it in a scene"});
    const auto unit = with(R"("m_time_unit": 3, )", "");
    CHECK(unit.clip.duration == Approx(1.0));
    CHECK(unit.warnings == std::vector<std::string>{"m_time_unit: is 3; only 0 is known, and the times are read as "
                                                    "seconds; compare the length of the clip"});
    const auto most = with("", R"("m_maximum": 0.5, )");
    CHECK(most.warnings ==
          std::vector<std::string>{"m_vibration.m_maximum: is 0.5; only 1 is known, and the levels are "
                                   "read as they are"});
}

TEST_CASE(".haps: what a writer leaves out is its default, with a warning", "[io][formats]")
{
    const std::string where = "m_vibration.m_melodies[0].m_notes[0]";
    std::string text = haps(R"({"m_value": 0.5}, {"m_time": 1})");
    text.replace(text.find("\"m_startingPoint\": 0,"), 21, "");
    const auto read = readAs("haps", text);
    const std::string keyframes = where + ".m_hapticEffect.m_amplitudeModulation.m_keyframes";
    CHECK(read.warnings ==
          std::vector<std::string>{where + ".m_startingPoint: is missing; the note is read as starting at 0",
                                   keyframes + "[0].m_time: is missing and read as 0",
                                   keyframes + "[1].m_value: is missing and read as 0"});
    CHECK(read.clip.duration == Approx(1.0));
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.5) == Approx(0.25));
    text = haps(R"({"m_time": 0, "m_value": 0.5}, {"m_time": 0.25, "m_value": 1})");
    text.replace(text.find("\"m_length\": 1,"), 14, "");
    const auto open = readAs("haps", text);
    CHECK(open.warnings ==
          std::vector<std::string>{where + ".m_length: is missing; the note lasts until its last keyframe"});
    CHECK(open.clip.duration == Approx(0.25));
    const auto tap = readAs("haps", R"({"m_version": "5", "m_vibration": {"m_melodies": [{"m_notes": [{}]}]},
        "m_stiffness": [{"m_melodies": []}], "m_texture": [{"m_melodies": []}, {"m_melodies": [{}]}]})");
    CHECK(tap.clip.transients.size() == 1);
    CHECK(tap.warnings ==
          std::vector<std::string>{"m_texture: is not read",
                                   where + ".m_startingPoint: is missing; the note is read as starting at 0",
                                   where + ": has neither a type nor an amplitude and is read as a transient"});
}

TEST_CASE(".tact: numbers in quotes are taken as what they say, with a warning", "[io][formats]")
{
    const auto read = readAs("tact", tact("\"100\"", "\"0.75\""));
    REQUIRE(read.warnings.size() == 2);
    CHECK(read.warnings[0].find("5 numbers are in quotes") != std::string::npos);
    CHECK(read.clip.duration == Approx(0.3));
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.2) == 0.75);
    CHECK(valueAt(read.clip.bands[0].amplitude, 0.05) == 0.0);
    for (const char* bad : {"\"abc\"", "\"\"", "\"1 \"", "\"nan\"", "\"inf\"", "\"1e999\"", "\"0x10\"", "true", "[]"})
    {
        CAPTURE(bad);
        CHECK(errorOf("tact", tact(bad, "1")).find("startTime: must be a number") != std::string::npos);
    }
    CHECK(errorOf("haps", haps(R"({"m_time": "0", "m_value": 0})")).find("must be a number") != std::string::npos);
}

TEST_CASE(".vij: envelopes and transients become one voice with events", "[io][formats]")
{
    const auto read = readAs("vij", corpus("vij/everything"));
    CHECK(read.warnings.empty());
    const Clip& clip = read.clip;
    CHECK(clip.duration == 0.5); // the last amplitude holds until the stated end
    REQUIRE(clip.bands.size() == 1);
    CHECK(valueAt(clip.bands[0].amplitude, 0.05) == Approx(0.5));
    CHECK(valueAt(clip.bands[0].amplitude, 0.5) == Approx(0.1));
    CHECK(valueAt(clip.bands[0].pitch, 0.2) == Approx(questRange.hertzOf(0.75)));
    REQUIRE(clip.transients.size() == 2); // the second stands at no point, where Lofelt's upgrade would drop it
    CHECK(clip.transients[1] == Transient{0.25, 0.5, 0.9});
    // It goes on to the format that came after it.
    const auto later = readHaptic(writeHaptic(clip, {})->files[0].bytes);
    REQUIRE(later.ok());
    CHECK(later->clip.transients.size() == 2);

    const std::string points = R"([[{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}], []])";
    CHECK(readAs("vij", vij(points, "[]")).clip.transients.empty());
    CHECK(readAs("vij", vij(points, "[[], []]")).clip.bands[0].pitch.empty());
    const auto tap = readAs("vij", vij(points, R"([[{"time": 1, "amplitude": 0.5}], []])"));
    CHECK(tap.clip.duration > 1.01);
    CHECK(tap.warnings.size() == 1);
    CHECK(readAs("vij", vij(R"([[{"time": 0, "amplitude": 1.5}], []])", "[]")).warnings.size() == 1);
}

TEST_CASE(".vij: what is wrong is refused with its place", "[io][formats]")
{
    const std::string points = R"([[{"time": 0, "amplitude": 0.5}], []])";
    CHECK(errorOf("vij", "{}").starts_with("voices: is missing"));
    CHECK(errorOf("vij", "[]") != "");
    CHECK(errorOf("vij", vij("[]", "[]")).starts_with("voices.envelopes: has no point of amplitude"));
    CHECK(errorOf("vij", vij("3", "[]")).starts_with("voices.envelopes: must be a list"));
    CHECK(errorOf("vij", vij(points, "[]", "-1")).starts_with("metadata.duration: must be"));
    CHECK(errorOf("vij", vij(points, "[]", "\"1\"")).starts_with("metadata.duration: must be a number"));
    CHECK(errorOf("vij", vij(R"([[{"time": 1, "amplitude": 0}, {"time": 0, "amplitude": 0}], []])", "[]"))
              .starts_with("voices.envelopes[0][1].time: is earlier"));
    CHECK(errorOf("vij", vij(points, R"([[{"time": -1, "amplitude": 0}], []])"))
              .starts_with("voices.transients[0][0].time: is before 0"));
    CHECK(errorOf("vij", vij(points, R"([[{"time": 1}], []])"))
              .starts_with("voices.transients[0][0].amplitude: is missing"));
}

TEST_CASE(".hasp: a project of one clip is that clip, one of several says how to get at them", "[io][formats]")
{
    const auto one = readAs("hasp", corpus("hasp/everything"));
    CHECK(one.clip.name == "Door");
    CHECK(one.clip.transients.size() == 1);
    CHECK(one.clip.duration == Approx(0.3));
    const std::string longest(125000, 'n');
    CHECK((readAs("hasp", hasp(haspClip(longest + "\u20AC"))).clip.name == longest)); // not shown, being long
    const std::string several = errorOf("hasp", hasp(haspClip("Door") + "," + haspClip("Window")));
    CHECK(several.starts_with("clips: has 2 clips ('Door', 'Window'): this is a project of Haptics Studio"));
    CHECK(several.find(".haptic") != std::string::npos);
    const auto named = [](int count)
    {
        std::string clips;
        for (int i = 0; i < count; ++i)
            clips += (i > 0 ? "," : "") + haspClip(std::string(1, static_cast<char>('a' + i)));
        return errorOf("hasp", hasp(clips));
    };
    CHECK(named(5).starts_with("clips: has 5 clips ('a', 'b', 'c', 'd', 'e'): "));
    CHECK(named(6).starts_with("clips: has 6 clips ('a', 'b', 'c', 'd', 'e', ...): "));
    CHECK(errorOf("hasp", hasp("")).find("project of Haptics Studio") != std::string::npos);
    CHECK(errorOf("hasp", "{}").starts_with("clips: is missing"));
    CHECK(errorOf("hasp", hasp(haspClip("Door", -1.0)))
              .starts_with("clips[0].haptic.signals.continuous.envelopes.amplitude[1].time: is before 0"));
    // What the clip warns of is said with its place in the project.
    std::string author = haspClip("Door");
    author.insert(author.find("\"signals\""), R"("metadata": {"author": "someone"}, )");
    const auto warned = readAs("hasp", hasp("{}, " + author));
    REQUIRE(warned.warnings.size() == 1);
    CHECK(warned.warnings[0].starts_with("clips[1].haptic.metadata: author"));
    // What is no clip with haptics is passed over, and a clip needs no name.
    const std::string others = R"(3, null, {}, {"name": "n"}, {"name": "n", "haptic": 3}, )";
    for (const char* name : {R"("name": "Door", )", R"("name": 3, )", ""})
    {
        CAPTURE(name);
        std::string clip = haspClip("Door");
        clip.replace(clip.find(R"("name")"), std::string(R"("name": "Door", )").size(), name);
        const auto read = readAs("hasp", hasp(others + clip));
        CHECK(read.clip.name == (std::string(name).find("Door") == std::string::npos ? "" : "Door"));
        CHECK(read.clip.duration == 1.0);
    }
    CHECK(errorOf("hasp", hasp(others + haspClip("Door", -1.0)))
              .starts_with("clips[5].haptic.signals.continuous.envelopes.amplitude[1].time: is before 0"));
    CHECK(errorOf("hasp", hasp(others + R"({"name": "n"})"))
              .starts_with("clips: has no clip with haptics: this is a project of Haptics Studio; export them"));
    CHECK(errorOf("hasp", R"({"clips": {}})") == "clips: must be a list in brackets");
    // By its content it is told from a clip whatever it is called.
    CHECK(clipFormatOf(".json", hasp(haspClip("Door")))->name == "hasp");
    CHECK(clipFormatOf(".haptic", hasp(haspClip("Door")))->name == "hasp");
    CHECK(clipFormatOf(".vij", corpus("vij/everything"))->name == "vij");
}

TEST_CASE("A pair of files that Haptics Studio exports is one clip", "[io][formats]")
{
    const TempFolder folder;
    std::ofstream(folder / "door.continuous.ahap") << R"({"Version": 1, "Pattern": [{"Event": {"Time": 0,
        "EventType": "HapticContinuous", "EventDuration": 0.5}}]})";
    std::ofstream(folder / "door.transients.ahap") << R"({"Version": 1, "Pattern": [{"Event": {"Time": 0.5,
        "EventType": "HapticTransient"}}]})";
    const auto read = readClip(folder / "door.continuous.ahap");
    REQUIRE(read.ok());
    CHECK(read->clip.transients.size() == 1);
    REQUIRE(read->clip.bands.size() == 1);
    CHECK(read->clip.duration > 0.51);
    CHECK(valueAt(read->clip.bands[0].amplitude, 0.505) == 0.0); // which ends at 0.5 s
    CHECK(companionOf(folder / "door.transients.ahap") == folder / "door.continuous.ahap");
    CHECK(companionOf(folder / "door.continuous.ahap").empty());
}
