// Broken files of other formats: each is refused with the place of what is wrong.

#include "io/formats/FormatSamples.h"
#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A sample in which one text is replaced by another, and where that is to be found.
struct Broken
{
    std::string from, to, where;
};

void checkBroken(const ClipFormat& format, const std::string& sample, const std::vector<Broken>& all)
{
    for (const Broken& broken : all)
    {
        std::string text = sample;
        const std::size_t place = text.find(broken.from);
        CAPTURE(format.name, broken.from, broken.to);
        REQUIRE(place != std::string::npos);
        text.replace(place, broken.from.size(), broken.to);
        const auto read = format.read(text);
        REQUIRE_FALSE(read);
        CAPTURE(read.error().message);
        CHECK(read.error().where == broken.where);
        CHECK(!read.error().message.empty());
    }
}

/// What is broken in any text file.
void checkBrokenText(const ClipFormat& format, const std::string& sample)
{
    CAPTURE(format.name);
    const auto marked = format.read("\xEF\xBB\xBF" + sample);
    REQUIRE(marked);
    CHECK(!marked->warnings.empty());
    std::string wide = "\xFF\xFE";
    for (const char c : sample)
        wide += {c, '\0'};
    for (const std::string& text : {wide, wide.substr(2)})
    {
        const auto read = format.read(text);
        REQUIRE_FALSE(read);
        CHECK(read.error().message.find("UTF-16") != std::string::npos);
    }
    CHECK_FALSE(format.read(""));
    for (std::size_t length = 0; length + 2 < sample.size(); length += 7)
        (void)format.read(std::string_view(sample).substr(0, length)); // any end is an error or a shorter file
}

void checkBrokenJson(const ClipFormat& format, const std::string& sample)
{
    checkBrokenText(format, sample);
    for (const std::string& text :
         {std::string("[]"), std::string("null"), std::string("{"), sample + "x", std::string(5000, '['),
          sample.substr(0, sample.rfind('}')) + ",}", sample.substr(0, sample.rfind('}')) + ", \"x\": NaN}"})
    {
        const auto read = format.read(text);
        CAPTURE(text.substr(0, 40));
        REQUIRE_FALSE(read);
        CHECK(!read.error().message.empty());
    }
}
} // namespace

namespace
{
using Json = nlohmann::json;

std::string fuzzed(const char* path)
{
    std::ifstream file(sourceFolder() / "Tests/fuzz/corpus" / path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The clip that `document` is read as, as text; empty if it is refused.
std::string readText(const ClipFormat& format, const Json& document)
{
    const auto read = format.read(document.dump());
    return read ? writeClipJson(read->clip) : std::string();
}

/// Calls visit(place) with each member of an object in `part`, whose place is `place`.
template <typename Visit>
void forEachMember(const Json& part, const Json::json_pointer& place, Visit visit)
{
    if (!part.is_structured())
        return;
    for (const auto& [name, value] : part.items())
    {
        const auto inner = part.is_array() ? place / static_cast<std::size_t>(std::stoul(name)) : place / name;
        if (part.is_object())
            visit(inner);
        forEachMember(value, inner, visit);
    }
}
} // namespace

TEST_CASE("Null stands for what may be missing, in every JSON format", "[formats]")
{
    const std::vector<std::pair<std::string, std::string>> samples{
        {"hjif", hjifSample()},
        {"haps", hapsSample()},
        {"tact", tactSample()},
        {"android", androidWaveformSample()},
        {"android", androidEnvelopeSample(true)},
        {"android", androidEnvelopeSample(false)},
        {"ahap", fuzzed("ahap/plain.ahap")},
        {"haptic", fuzzed("haptic/plain.haptic")},
        {"vij", fuzzed("vij/everything")},
        {"json", R"({"format": "pacini.clip", "version": 1, "name": "n", "duration": 1, "source": {"file": "f",
            "sampleRate": 48000, "channels": 1}, "envelope": [], "centroid": [], "bands": [{"lowFrequency": 10,
            "centreFrequency": 20, "highFrequency": 30, "priority": 0, "amplitude": [{"time": 0, "amplitude": 1}],
            "pitch": []}], "transients": [], "noise": [], "markers": []})"}};
    for (const auto& [name, text] : samples)
    {
        const ClipFormat& format = *clipFormatNamed(name);
        const Json document = Json::parse(text);
        REQUIRE(readText(format, document) != "");
        int optional = 0;
        forEachMember(document, Json::json_pointer(),
                      [&](const Json::json_pointer& place)
                      {
                          Json missing = document, null = document;
                          missing.at(place.parent_pointer()).erase(place.back());
                          null.at(place) = nullptr;
                          const std::string without = readText(format, missing);
                          CAPTURE(name, place.to_string());
                          CHECK((without.empty() || readText(format, null) == without));
                          optional += without.empty() ? 0 : 1;
                      });
        CAPTURE(name);
        CHECK(optional > 0);
    }
}

TEST_CASE("Broken HJIF is refused with its place", "[formats]")
{
    const std::string channel = "perceptions[0].channels[0]";
    checkBrokenJson(*clipFormatNamed("hjif"), test::hjifSample());
    checkBroken(*clipFormatNamed("hjif"), test::hjifSample(),
                {{R"("version": "2023")", R"("version": 2023)", "version"},
                 {R"("version": "2023")", R"("version": "1.0")", "version"},
                 {R"("version": "2023", )", "", "version"},
                 {R"("timescale": 1000)", R"("timescale": 0)", "timescale"},
                 {R"("perceptions": [)", R"("others": [)", "perceptions"},
                 {R"("perception_modality": "Vibrotactile", )", "", "perceptions[0].perception_modality"},
                 {R"("gain": 1)", R"("gain": "1")", channel + ".gain"},
                 {R"("gain": 1)", R"("gain": 1e300)", channel + ".gain"},
                 {R"("avatar_id": 0, )", R"("avatar_id": 0, "perception_unit_exponent": 13, )",
                  "perceptions[0].perception_unit_exponent"},
                 {R"("avatar_id": 0, )", R"("avatar_id": 0, "perception_unit_exponent": -13, )",
                  "perceptions[0].perception_unit_exponent"},
                 {R"("band_type": "VectorialWave")", R"("band_type": "Wave")", channel + ".bands[0].band_type"},
                 {R"("lower_frequency_limit": 40)", R"("lower_frequency_limit": 140)", channel + ".bands[0]"},
                 {R"("position": 600)", R"("position": -1)", channel + ".bands[0].effects[1].position"},
                 {R"("position": 600)", R"("position": 1e15)", channel + ".bands[0].effects[1].position"},
                 {R"("position": 600, )", "", channel + ".bands[0].effects[1].position"},
                 {R"("effect_type": "Basis", "position": 600)", R"("effect_type": "Base", "position": 600)",
                  channel + ".bands[0].effects[1].effect_type"},
                 {R"("relative_position": 222)", R"("relative_position": 22)",
                  channel + ".bands[0].effects[0].keyframes[2].relative_position"},
                 {R"("amplitude_modulation": 0.8)", R"("amplitude_modulation": 80000)",
                  channel + ".bands[0].effects[0].keyframes[1].amplitude_modulation"},
                 {R"("amplitude_modulation": 0.8)", R"("amplitude_modulation": true)",
                  channel + ".bands[0].effects[0].keyframes[1].amplitude_modulation"},
                 {R"("position": 1000, "id": 7)", R"("position": 1000)", channel + ".bands[0].effects[2].id"}});
}

TEST_CASE("Broken wavelet bands of HJIF are refused with their place", "[formats]")
{
    const std::string band = "perceptions[0].channels[0].bands[0]";
    const std::string block = R"({"effect_type": "Basis", "position": 0, "wavelet_stream": "K3bDLtlxkLsMt"})";
    const std::string sample = test::hjifWith(R"({"band_type": "WaveletWave", "lower_frequency_limit": 0,
        "upper_frequency_limit": 8000, "block_length": 2, "effects": [)" +
                                              block + "]}");
    REQUIRE(readHjif(sample));
    std::string shortest = sample; // a block of 16 samples in one tick
    shortest.replace(shortest.find(R"("block_length": 2)"), 17, R"("block_length": 1)");
    shortest.replace(shortest.find(R"("timescale": 1000)"), 17, R"("timescale": 500)");
    CHECK(readHjif(shortest));
    std::string longest = block;
    for (int i = 0; i < 600; ++i)
        longest += ", " + block;
    checkBroken(
        *clipFormatNamed("hjif"), sample,
        {{R"("upper_frequency_limit": 8000)", R"("upper_frequency_limit": 8000.5)", band + ".upper_frequency_limit"},
         {R"("upper_frequency_limit": 8000)", R"("upper_frequency_limit": 400001)", band},
         {R"("upper_frequency_limit": 8000)", R"("upper_frequency_limit": 0)", band + ".upper_frequency_limit"},
         {R"("block_length": 2, )", "", band + ".block_length"},
         {R"("block_length": 2)", R"("block_length": 3)", band + ".block_length"},
         {R"("block_length": 2)", R"("block_length": 0)", band + ".block_length"},
         {R"("block_length": 2)", R"("block_length": 1048576)", band + ".block_length"},
         {R"(, "wavelet_stream": "K3bDLtlxkLsMt")", "", band + ".effects[0].wavelet_stream"},
         {"K3bD", "K3 bD", band + ".effects[0].wavelet_stream"},
         {R"(2, "effects": [)" + block, R"(8192, "effects": [)" + longest, band}}); // half an hour of each
}

TEST_CASE("What HJIF players let pass is read with a warning", "[formats]")
{
    const auto warned = [](const std::string& from, const std::string& to, const std::string& words)
    {
        std::string text = test::hjifSample();
        text.replace(text.find(from), from.size(), to);
        const auto read = readHjif(text);
        CAPTURE(to, read ? "" : read.error().text());
        REQUIRE(read);
        REQUIRE(read->warnings.size() == 1);
        CHECK(read->warnings[0].find(words) != std::string::npos);
    };
    warned(R"("level": 1, )", "", "level");
    warned(R"("version": "2023")", R"("version": "2031-2")", "newer");
    warned(R"("amplitude_modulation": 0.8)", R"("amplitude_modulation": -0.8)", "sign");
    warned(R"("frequency_modulation": 90)", R"("frequency_modulation": 900)", "limits");
    warned(R"("position": 1000, "id": 7)", R"("position": 1000, "id": 8)", "library");
    warned(R"("effect_type": "Basis", "position": 600)", R"("effect_type": "Composite", "position": 600)", "composite");
}

TEST_CASE("Broken vibration effects are refused with their place", "[formats]")
{
    const std::string waveform = test::androidWaveformSample();
    checkBrokenJson(*clipFormatNamed("android"), waveform);
    checkBroken(*clipFormatNamed("android"), waveform,
                {{"100, 30", "100", "waveform.amplitudes"},
                 {"100, 30", "100, -30", "waveform.timings[1]"},
                 {"100, 30", "100, 30.5", "waveform.timings[1]"},
                 {"100, 30", "100, 1e12", "waveform.timings[1]"},
                 {"100, 30", "\"100\", 30", "waveform.timings[0]"},
                 {"0, 255", "0, 256", "waveform.amplitudes[1]"},
                 {"0, 255", "0, -2", "waveform.amplitudes[1]"},
                 {"\"waveform\"", "\"wave\"", "waveformEnvelope"}});
    for (const bool isBasic : {false, true})
    {
        const std::string list = std::string(isBasic ? "basicEnvelope" : "waveformEnvelope") + ".controlPoints";
        const std::string level = isBasic ? "intensity" : "amplitude";
        checkBrokenJson(*clipFormatNamed("android"), test::androidEnvelopeSample(isBasic));
        checkBroken(*clipFormatNamed("android"), test::androidEnvelopeSample(isBasic),
                    {{"\"durationMs\": 7", "\"durationMs\": 0", list + "[1].durationMs"},
                     {"\"durationMs\": 7", "\"durationMs\": 7.5", list + "[1].durationMs"},
                     {", \"durationMs\": 7", "", list + "[1].durationMs"},
                     {"\"" + level + "\": 0.5", "\"" + level + "\": 1.5", list + "[0]." + level},
                     {"\"controlPoints\": [", "\"controlPoints\": [], \"x\": [", list}});
    }
}

TEST_CASE("A broken .haps file is refused with its place", "[formats]")
{
    const std::string note = "m_vibration.m_melodies[1].m_notes[0]";
    checkBrokenJson(*clipFormatNamed("haps"), test::hapsSample());
    checkBroken(*clipFormatNamed("haps"), test::hapsSample(),
                {{R"("m_version": "5")", R"("m_version": "6")", "m_version"},
                 {R"("m_version": "5", )", "", "m_version"},
                 {R"("m_vibration")", R"("vibration")", "m_vibration"},
                 {R"("m_startingPoint": 0,)", R"("m_startingPoint": -1,)", note + ".m_startingPoint"},
                 {R"("m_length": 1.5)", R"("m_length": 1e9)", note + ".m_length"},
                 {R"("m_gain": 1.109)", R"("m_gain": -1)", "m_vibration.m_melodies[0].m_notes[0].m_gain"},
                 {R"("m_time": 0.4)", R"("m_time": -0.4)",
                  note + ".m_hapticEffect.m_amplitudeModulation.m_keyframes[1].m_time"},
                 {R"("m_value": 0.2)", R"("m_value": [])",
                  note + ".m_hapticEffect.m_amplitudeModulation.m_keyframes[0].m_value"}});
    std::string text = test::hapsSample();
    text.replace(text.find("\"m_value\": 0.2"), 14, "\"m_value\": 1.2");
    const auto lenient = readHaps(text);
    REQUIRE(lenient);
    CHECK(lenient->warnings.size() == 1);
}

TEST_CASE("A broken .tact file is refused with its place", "[formats]")
{
    const std::string effect = "project.tracks[0].effects[0]";
    const std::string dots = effect + ".modes.VestFront.dotMode.feedback";
    checkBrokenJson(*clipFormatNamed("tact"), test::tactSample());
    checkBroken(*clipFormatNamed("tact"), test::tactSample(),
                {{R"("project")", R"("projects")", "project"},
                 {R"("startTime": 40)", R"("startTime": -40)", effect + ".startTime"},
                 {R"("startTime": 40, )", "", effect + ".startTime"},
                 {R"("mode": "DOT_MODE")", R"("mode": "LINE_MODE")", effect + ".modes.VestFront.mode"},
                 {R"("intensity": 0.75)", R"("intensity": 75)", dots + "[0].pointList[1].intensity"},
                 {R"("endTime": 100)", R"("endTime": -1)", dots + "[0].endTime"},
                 {R"("durationMillis": 500)", R"("durationMillis": 1e12)", "durationMillis"},
                 {R"("enable": true)", R"("enable": 1)", "project.tracks[0].enable"}});
}

TEST_CASE("A broken table is refused with its line and column", "[formats]")
{
    checkBrokenText(*clipFormatNamed("csv"), test::csvSample());
    checkBroken(*clipFormatNamed("csv"), test::csvSample(),
                {{"time,", "when,", "line 1, column 1"},
                 {"time,", "envelope,", "line 1, column 2"},
                 {"30 50 80", "30 90 80", "line 1, column 3"},
                 {"0.25,45", "0.25,x", "line 2, column 4"},
                 {"0.25,45", "0.25,nan", "line 2, column 4"},
                 {"0.25,45", "0.25,-45", "line 2, column 4"},
                 {"0.25,45", "0.25,0", "line 2, column 4"},
                 {"\n1.5,", "\n0.2,", "line 7, column 1"},
                 {"\n1.5,", "\n,", "line 7, column 1"},
                 {"\n1.5,", "\n1e9,", "line 7, column 1"},
                 {"0.75,0.5", "0.75,1.5", "line 5, column 8"},
                 {"0.75,0.5", ",0.5", "line 5, column 1"},
                 {"0.75,0.5", "0.75,0.5,1", "line 5, column 9"}});
}
