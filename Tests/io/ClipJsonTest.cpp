#include "io/formats/json/ClipJson.h"

#include "support/Catch.h"
#include "support/RandomClip.h"

#include <nlohmann/json.hpp>

#include <clocale>
#include <functional>
#include <sstream>
#include <string>

using namespace pacini;
using test::randomFullClip;

namespace
{
const std::string shortest = R"({"format": "pacini.clip", "version": 1, "duration": 2, "bands": []})";

/// `shortest` with further members.
std::string with(const std::string& members)
{
    return R"({"format": "pacini.clip", "version": 1, "duration": 2, "bands": [], )" + members + "}";
}
} // namespace

TEST_CASE("Reading what was written gives the same clip to the last bit", "[io][json]")
{
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        CAPTURE(seed);
        const auto clip = randomFullClip(seed);
        REQUIRE(validate(clip).ok());
        const auto text = writeClipJson(clip);
        const auto back = readClipJson(text);
        REQUIRE(back.ok());
        REQUIRE(*back == clip);
        REQUIRE(writeClipJson(*back) == text);
    }
    CHECK(*readClipJson(writeClipJson(Clip{})) == Clip{});
}

TEST_CASE("The extremes of every number survive", "[io][json]")
{
    Clip clip;
    clip.duration = limits::duration;
    clip.source = {"", 1e9, 2147483647};
    clip.bands.resize(limits::bands);
    clip.bands[0].priority = -2147483647 - 1;
    clip.bands[1].priority = 2147483647;
    clip.bands[0].highFrequency = limits::frequency;
    clip.bands[0].amplitude = {{0.0, 0.0}, {5e-324, limits::amplitude}, {limits::duration, 2.2250738585072014e-308}};
    clip.bands[0].pitch = {{0.0, 1e-3}, {0.1 + 0.2, limits::frequency}};
    clip.transients = {{0.0, -0.0, 1.0}};
    REQUIRE(validate(clip).ok());
    const auto back = readClipJson(writeClipJson(clip));
    REQUIRE(back.ok());
    CHECK(*back == clip);
}

TEST_CASE("Every entry is named, in the order of the schema", "[io][json]")
{
    Clip clip;
    clip.name = "Knock";
    clip.duration = 0.5;
    clip.source = {"knock.wav", 48000.0, 1};
    clip.encoder = {{"method", std::string("a2vt")}, {"bands", 1.0}, {"adaptive", false}};
    clip.centroid = {{0.0, 140.0}};
    clip.bands = {{60.0, 100.0, 160.0, 2, {{0.0, 0.8}, {0.1, 0.5}, {0.3, 0.0}}, {}}};
    clip.transients = {{0.01, 0.9, 0.7}};
    clip.noise = {{30.0, 400.0, {{0.0, 0.05}}}};
    clip.markers = {{0.01, "impact"}};
    CHECK(writeClipJson(clip) == R"({
  "format": "pacini.clip",
  "version": 1,
  "name": "Knock",
  "duration": 0.5,
  "source": {
    "file": "knock.wav",
    "sampleRate": 48000,
    "channels": 1
  },
  "encoder": {
    "method": "a2vt",
    "bands": 1,
    "adaptive": false
  },
  "envelope": [],
  "centroid": [
    {"time": 0, "frequency": 140}
  ],
  "bands": [
    {
      "lowFrequency": 60,
      "centreFrequency": 100,
      "highFrequency": 160,
      "priority": 2,
      "amplitude": [
        {"time": 0, "amplitude": 0.8}, {"time": 0.1, "amplitude": 0.5},
        {"time": 0.3, "amplitude": 0}
      ],
      "pitch": []
    }
  ],
  "transients": [
    {"time": 0.01, "amplitude": 0.9, "sharpness": 0.7}
  ],
  "noise": [
    {
      "lowFrequency": 30,
      "highFrequency": 400,
      "amplitude": [
        {"time": 0, "amplitude": 0.05}
      ]
    }
  ],
  "markers": [
    {"time": 0.01, "name": "impact"}
  ]
}
)");
}

TEST_CASE("An edit of one point changes one line", "[io][json]")
{
    auto clip = randomFullClip(5, 400);
    clip.envelope.clear();
    for (int i = 0; i < 400; ++i)
        clip.envelope.push_back({clip.duration * i / 400.0, 0.5});
    const auto before = writeClipJson(clip);
    clip.envelope[200].value = 0.25;
    const auto after = writeClipJson(clip);
    std::istringstream a(before), b(after);
    int changed = 0;
    for (std::string x, y; std::getline(a, x) && std::getline(b, y);)
        changed += x != y ? 1 : 0;
    CHECK(changed == 1);
    // An inserted point moves none of the lines of other quarters of a second.
    clip.envelope.insert(clip.envelope.begin() + 200, {clip.envelope[200].time, 0.1});
    std::istringstream c(after), d(writeClipJson(clip));
    std::vector<std::string> old, fresh;
    for (std::string line; std::getline(c, line);)
        old.push_back(line);
    for (std::string line; std::getline(d, line);)
        fresh.push_back(line);
    std::size_t same = 0;
    while (same < old.size() && old[same] == fresh[same])
        ++same;
    std::size_t tail = 0;
    while (tail < old.size() && old[old.size() - 1 - tail] == fresh[fresh.size() - 1 - tail])
        ++tail;
    CHECK(old.size() - same - tail <= 2);
}

TEST_CASE("Another parser sees the same values", "[io][json]")
{
    const auto clip = randomFullClip(77);
    const auto json = nlohmann::json::parse(writeClipJson(clip));
    CHECK(json["format"] == "pacini.clip");
    CHECK(json["version"] == 1);
    CHECK(json["name"] == clip.name);
    CHECK(json["duration"] == clip.duration);
    CHECK(json["source"]["channels"] == clip.source.channels);
    CHECK(json["encoder"].size() == clip.encoder.size());
    REQUIRE(json["bands"].size() == clip.bands.size());
    REQUIRE_FALSE(clip.bands.empty());
    for (std::size_t i = 0; i < clip.bands.size(); ++i)
    {
        CHECK(json["bands"][i]["centreFrequency"] == clip.bands[i].centreFrequency);
        REQUIRE(json["bands"][i]["pitch"].size() == clip.bands[i].pitch.size());
        for (std::size_t k = 0; k < clip.bands[i].pitch.size(); ++k)
        {
            CHECK(json["bands"][i]["pitch"][k]["time"] == clip.bands[i].pitch[k].time);
            CHECK(json["bands"][i]["pitch"][k]["frequency"] == clip.bands[i].pitch[k].value);
        }
    }
}

TEST_CASE("What may be missing takes its default", "[io][json]")
{
    Clip expected;
    expected.duration = 2.0;
    CHECK(*readClipJson(shortest) == expected);
    const auto band = readClipJson(R"({"bands": [{"highFrequency": 3, "centreFrequency": 2, "amplitude": [],
        "lowFrequency": 1}], "duration": 2, "version": 1.0, "format": "pacini.clip", "source": {}, "encoder": {}})");
    REQUIRE(band.ok());
    expected.bands.push_back({1.0, 2.0, 3.0, 0, {}, {}});
    CHECK(*band == expected);
}

TEST_CASE("Unknown keys are ignored wherever they stand and whatever they hold", "[io][json]")
{
    Clip expected;
    expected.duration = 2.0;
    const auto deep = std::string(31, '[') + std::string(31, ']');
    for (const auto& value :
         {std::string("1"), std::string("null"), std::string("\"x\""), std::string("true"), std::string("{}"),
          std::string("[]"), std::string(R"({"bands": [1, {"time": "x"}], "version": 9})"),
          std::string(R"([[], {}, [{"a": {}}]])"), deep})
    {
        CAPTURE(value);
        CHECK(*readClipJson(with("\"extra\": " + value)) == expected);
        CHECK(*readClipJson(with("\"extra\": " + value + ", \"extra\": " + value + ", \"markers\": []")) == expected);
    }
    const auto inside = readClipJson(R"({"format": "pacini.clip", "version": 1, "duration": 2,
        "source": {"sampleRate": 8000, "licence": {"name": "CC0"}},
        "bands": [{"lowFrequency": 1, "x": [{}], "centreFrequency": 2, "highFrequency": 3,
                   "amplitude": [{"time": 0, "curve": "log", "amplitude": 1, "more": [1]}]}]})");
    REQUIRE(inside.ok());
    expected.source.sampleRate = 8000.0;
    expected.bands.push_back({1.0, 2.0, 3.0, 0, {{0.0, 1.0}}, {}});
    CHECK(*inside == expected);
}

TEST_CASE("Hostile texts fail where they turn bad", "[io][json]")
{
    const auto endOf = [](const std::string& start, char repeated)
    {
        const auto clip = readClipJson(start + std::string(3'000'000, repeated));
        REQUIRE_FALSE(clip.ok());
        return clip.error();
    };
    CHECK(endOf("", '[').where.empty());
    const auto nested = endOf("{\"x\": ", '[');
    CHECK(nested.code == ErrorCode::tooLarge);
    CHECK(nested.where == "line 1, column 38");
    CHECK(endOf("{\"encoder\": ", '[').where == "encoder");
    for (const auto& [start, repeated] : {std::pair("", ' '), std::pair("{\"x\": \"", 'a')})
        CHECK(endOf(start, repeated).code == ErrorCode::invalidData);
    CHECK(endOf("{\"duration\": ", '7').code == ErrorCode::notFinite);
}

TEST_CASE("The limit on the length of texts is exact", "[io][json]")
{
    CHECK(readClipJson(shortest, shortest.size()).ok());
    CHECK(readClipJson(shortest, shortest.size() - 1).error().code == ErrorCode::tooLarge);
}

TEST_CASE("Places count lines and characters", "[io][json]")
{
    for (const std::size_t padding : {0u, 1u, 65535u, 65536u})
        CHECK(readClipJson("{\"name\": \"\xC3\xA4\",\n" + std::string(padding, ' ') + "}").error().where ==
              "line 2, column " + std::to_string(padding + 1));
    CHECK(readClipJson("{\r\n  \"n\xC3\xA4me\": x").error().where == "line 2, column 11");
}

TEST_CASE("Errors stay on one short line whatever the keys are", "[io][json]")
{
    const auto clip = readClipJson(with("\"encoder\": {\"" + std::string(1000, 'k') + "\\n\\u0000\": []}"));
    REQUIRE_FALSE(clip.ok());
    CHECK(clip.error().text().size() < 200);
    const auto lines = readClipJson(with("\"encoder\": {\"a\\nb\\u0000c\": []}"));
    REQUIRE_FALSE(lines.ok());
    CHECK(lines.error().where == "encoder.a?b?c");
}

TEST_CASE("Text that is not UTF-8 is written with replacement characters", "[io][json]")
{
    Clip clip;
    clip.name = "a\xFF"
                "b";
    const auto back = readClipJson(writeClipJson(clip));
    REQUIRE(back.ok());
    CHECK(back->name == "a\uFFFDb");
}

TEST_CASE("A decimal comma of the locale changes nothing", "[io][json]")
{
    const auto clip = randomFullClip(9);
    const auto text = writeClipJson(clip);
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
        if (std::setlocale(LC_ALL, name) != nullptr)
            break;
    const auto written = writeClipJson(clip);
    const auto back = readClipJson(text);
    std::setlocale(LC_ALL, before.c_str());
    CHECK(written == text);
    REQUIRE(back.ok());
    CHECK(*back == clip);
}
