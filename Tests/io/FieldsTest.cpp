#include "io/FieldsHandler.h"
#include "io/FieldsReader.h"
#include "io/FieldsWriter.h"
#include "io/JsonSource.h"
#include "io/JsonTree.h"
#include "support/Catch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

enum class FieldsShape
{
    round,
    square,
    long_
};

constexpr std::array<Choice<FieldsShape>, 3> fieldsShapes{
    {{"round", FieldsShape::round}, {"square", FieldsShape::square}, {"long", FieldsShape::long_}}};

struct FieldsPoint
{
    double time = 0.0;
    double value = 1.0;
    bool operator==(const FieldsPoint&) const = default;
};

/// Something of every kind of field.
struct FieldsThing
{
    std::string name;
    double size = 0.5;
    int count = 3;
    bool ready = false;
    FieldsShape shape = FieldsShape::round;
    FieldsPoint point;
    std::optional<FieldsPoint> other;
    std::optional<double> maybe;
    std::optional<std::string> remark;
    std::vector<FieldsPoint> points;
    std::vector<double> numbers{1.0};
    std::vector<std::pair<std::string, std::string>> texts;
};

/// Reads a tree as the small documents are read.
struct FieldsRead
{
    FieldsThing thing;
    std::string error;
    ErrorCode code = ErrorCode::invalidData;
    std::vector<std::string> warnings;
    std::size_t textsTaken = 0;
};

FieldsRead readFields(const nlohmann::json& document, bool strict = false, bool textsAsNumbers = false)
{
    FieldsRead read;
    ReadWarnings warnings(strict);
    FieldsReader reader(document, &warnings);
    if (textsAsNumbers)
        reader.takeTextsAsNumbers();
    FieldsThing& thing = read.thing;
    const auto pointFields = [&](FieldsPoint& point)
    {
        reader.number("time", point.time, Need::required);
        reader.number("value", point.value, Need::usual);
    };
    reader.text("name", thing.name);
    reader.number("size", thing.size, Need::usual);
    reader.integer("count", thing.count, "must be a whole number");
    reader.truth("ready", thing.ready);
    reader.choice("shape", thing.shape, fieldsShapes, Need::usual);
    reader.object("point", thing.point, Need::usual, pointFields);
    reader.optionalObject("other", thing.other, pointFields);
    reader.optionalNumber("maybe", thing.maybe);
    reader.optionalText("remark", thing.remark);
    reader.list("points", thing.points, 3, "points", pointFields);
    reader.numbers("numbers", thing.numbers, 3);
    reader.texts("texts", thing.texts);
    reader.finish();
    if (reader.error)
    {
        read.error = reader.error->text();
        read.code = reader.error->code;
    }
    read.warnings = warnings.texts();
    read.textsTaken = reader.textsTaken();
    return read;
}

constexpr DocumentFormat fieldsFormat{"pacini.thing", 2, "a thing"};
constexpr DocumentFormat fieldsWholeFormat{"pacini.thing", 2, "a thing", true};
constexpr WholeRange fieldsRange{-2.0, 5.0, "a whole number from -2 to 5", "a whole number"};

constexpr auto fieldsPoint = [](auto& point, auto& visitor)
{
    visitor.number("time", point.time, Need::required);
    visitor.number("value", point.value, Need::usual);
};

struct FieldsStream
{
    std::string name;
    double size = 0.5;
    int count = 3;
    FieldsShape shape = FieldsShape::round;
    FieldsPoint point;
    std::optional<FieldsPoint> other;
    std::vector<FieldsPoint> points, rows, times;
    std::vector<EncoderParameter> parameters;
};

template <const DocumentFormat& format>
struct FieldsOfStream
{
    template <typename Stream, typename Visitor>
    void operator()(Stream& stream, Visitor& visitor) const
    {
        visitor.format(format);
        visitor.text("name", stream.name, Need::usual);
        visitor.number("size", stream.size, Need::usual);
        visitor.integer("count", stream.count, fieldsRange);
        visitor.choice("shape", stream.shape, fieldsShapes, Need::usual);
        visitor.object("point", stream.point, Need::optional, fieldsPoint);
        visitor.optionalObject("other", stream.other, fieldsPoint);
        visitor.list("points", stream.points, 2, "points that it may have", fieldsPoint, Need::optional);
        visitor.rows("rows", stream.rows, 3, "rows that it may have", fieldsPoint);
        visitor.timeline("times", stream.times, Need::usual, fieldsPoint);
        visitor.parameters("parameters", stream.parameters);
    }
};

/// More fields than a word of 32 bits has, of which the first is required.
struct FieldsOfMany
{
    template <typename Visitor>
    void operator()(std::array<double, 63>& values, Visitor& visitor) const
    {
        static const auto names = []
        {
            std::array<std::string, 63> made;
            for (std::size_t i = 0; i < made.size(); ++i)
                made[i] = fmt::format("f{}", i);
            return made;
        }();
        for (std::size_t i = 0; i < values.size(); ++i)
            visitor.number(names[i], values[i], i == 0 ? Need::required : Need::usual);
    }
};

std::string streamError(const std::string& members, bool whole = false)
{
    FieldsStream stream;
    const auto parse = [&](FieldsHandler handler)
    {
        return parseJson("{" + members + "}", handler, 10000);
    };
    const auto parsed = whole ? parse(FieldsHandler(stream, FieldsOfStream<fieldsWholeFormat>{}))
                              : parse(FieldsHandler(stream, FieldsOfStream<fieldsFormat>{}));
    return parsed.ok() ? "" : parsed.error().text();
}

const std::string fieldsStart = R"("format": "pacini.thing", "version": 2)";

std::string memberError(const std::string& members)
{
    return streamError(fieldsStart + ", " + members);
}

} // namespace

TEST_CASE("A small document is read field by field, and what is missing keeps its default", "[io][json]")
{
    const FieldsRead least = readFields({{"name", "x"}, {"numbers", {2.0}}});
    CHECK(least.error.empty());
    CHECK(least.warnings.empty());
    CHECK(least.thing.name == "x");
    CHECK(least.thing.size == 0.5);
    CHECK(least.thing.count == 3);
    CHECK_FALSE(least.thing.ready);
    CHECK(least.thing.shape == FieldsShape::round);
    CHECK(least.thing.point == FieldsPoint{});
    CHECK_FALSE(least.thing.other);
    CHECK_FALSE(least.thing.maybe);
    CHECK_FALSE(least.thing.remark);
    CHECK(least.thing.points.empty());
    CHECK(least.thing.numbers == std::vector<double>{2.0});
    const FieldsRead all = readFields({{"name", "y"},
                                       {"size", 2},
                                       {"count", -7},
                                       {"ready", true},
                                       {"shape", "long"},
                                       {"point", {{"time", 1}, {"value", 2}}},
                                       {"other", {{"time", 3}}},
                                       {"maybe", 4.5},
                                       {"remark", "r"},
                                       {"points", {{{"time", 5}}, {{"time", 6}, {"value", 7}}, {{"time", 8}}}},
                                       {"numbers", {1, 2, 3}},
                                       {"texts", {{"a", "b"}, {"c", "d"}}}});
    CHECK(all.error.empty());
    CHECK(all.warnings.empty());
    CHECK(all.thing.size == 2.0);
    CHECK(all.thing.count == -7);
    CHECK(all.thing.ready);
    CHECK(all.thing.shape == FieldsShape::long_);
    CHECK(all.thing.point == FieldsPoint{1.0, 2.0});
    CHECK(all.thing.other == FieldsPoint{3.0, 1.0});
    CHECK(all.thing.maybe == 4.5);
    CHECK(all.thing.remark == "r");
    CHECK(all.thing.points == std::vector<FieldsPoint>{{5.0, 1.0}, {6.0, 7.0}, {8.0, 1.0}});
    CHECK(all.thing.numbers == std::vector<double>{1.0, 2.0, 3.0});
    CHECK(all.thing.texts.size() == 2);
    CHECK(all.thing.texts[1].second == "d");
}

TEST_CASE("A wrong field of a small document is named with what it must be", "[io][json]")
{
    const auto error = [](const char* name, const nlohmann::json& value)
    {
        nlohmann::json document = {{"name", "x"}, {"numbers", {2.0}}};
        document[name] = value;
        return readFields(document).error;
    };
    CHECK(readFields({{"numbers", {2.0}}}).error == "name: is missing");
    CHECK(readFields({{"name", "x"}}).error == "numbers: is missing");
    CHECK(error("name", 1) == "name: must be a text in quotes");
    CHECK(error("size", "1") == "size: must be a number");
    CHECK(error("count", 1.5) == "count: must be a whole number");
    CHECK(error("count", 1000000).empty());
    CHECK(error("count", 1000001) == "count: must be a whole number");
    CHECK(error("count", -1000001) == "count: must be a whole number");
    CHECK(error("ready", 1) == "ready: must be true or false");
    CHECK(error("shape", "flat") == "shape: must be round, square or long, not 'flat'");
    CHECK(error("shape", 1) == "shape: must be round, square or long");
    CHECK(error("point", 1) == "point: must be an object in braces");
    CHECK(error("point", {{"value", 1}}) == "point.time: is missing");
    CHECK(error("point", {{"time", "x"}}) == "point.time: must be a number");
    CHECK(error("other", nlohmann::json::array()) == "other: must be an object in braces");
    CHECK(error("maybe", "x") == "maybe: must be a number");
    CHECK(error("remark", 1) == "remark: must be a text in quotes");
    CHECK(error("points", 1) == "points: must be a list of points");
    CHECK(error("points", {{{"time", 1}}, 5}) == "points[1]: must be an object in braces");
    CHECK(error("points", {{{"time", 1}}, {{"value", 5}}}) == "points[1].time: is missing");
    const nlohmann::json point = {{"time", 1}};
    CHECK(error("points", {point, point, point}).empty());
    CHECK(error("points", {point, point, point, point}) == "points: has more than 3 points");
    CHECK(error("numbers", nlohmann::json::array()) == "numbers: must be a list of numbers");
    CHECK(error("numbers", 1) == "numbers: must be a list of numbers");
    CHECK(error("numbers", {1, "x"}) == "numbers[1]: must be a number");
    CHECK(error("numbers", {1, 2, 3, 4}) == "numbers: has more than 3 numbers");
    CHECK(readFields({{"name", "x"}, {"numbers", {1, 2, 3, 4}}}).code == ErrorCode::tooLarge);
    CHECK(error("texts", 1) == "texts: must be an object in braces");
    CHECK(error("texts", {{"a", 1}}) == "texts.a: must be a text in quotes");
    CHECK(error("texts", {{"a", ""}}) == "texts.a: must not be empty");
    // The first of several wrong fields is the one that is told.
    CHECK(readFields({{"size", "1"}, {"ready", 3}}).error == "name: is missing");
}

TEST_CASE("Unknown fields of a small document are doubted at their place, remarks are not", "[io][json]")
{
    const nlohmann::json document = {{"name", "x"},
                                     {"numbers", {2.0}},
                                     {"sise", 3},
                                     {"_note", 1},
                                     {"$schema", "s"},
                                     {"texts", {{"anything", "goes"}}},
                                     {"point", {{"time", 1}, {"vlaue", 2}}}};
    CHECK(readFields(document).warnings == std::vector<std::string>{"point.vlaue: is unknown; did you mean \"value\"?",
                                                                    "sise: is unknown; did you mean \"size\"?"});
    CHECK(readFields(document, true).error == "point.vlaue: is unknown; did you mean \"value\"?");
    CHECK(readFields({{"name", "x"}, {"numbers", {2.0}}, {"sise", 3}}, true).error ==
          "sise: is unknown; did you mean \"size\"?");
    CHECK(readFields({{"sise", 3}}).warnings.empty()); // an error says enough
    FieldsReader quiet(document);
    quiet.finish();
    CHECK_FALSE(quiet.error);
    CHECK(FieldsReader(document).names().size() == 7);
}

TEST_CASE("Numbers in quotes are taken where they may be, and counted", "[io][json]")
{
    const FieldsRead read =
        readFields({{"name", "x"}, {"numbers", {2.0}}, {"size", "-1.5e2"}, {"maybe", "3"}}, false, true);
    CHECK(read.error.empty());
    CHECK(read.thing.size == -150.0);
    CHECK(read.thing.maybe == 3.0);
    CHECK(read.textsTaken == 2);
    for (const char* bad : {"", "x", "1x", "inf", "nan"})
        CHECK(readFields({{"name", "x"}, {"numbers", {2.0}}, {"size", bad}}, false, true).error ==
              "size: must be a number");
}

TEST_CASE("Format and version of a small document must be its own", "[io][json]")
{
    const auto error = [](const nlohmann::json& document)
    {
        FieldsReader reader(document);
        reader.format("pacini.thing", 2);
        return reader.error ? reader.error->text() : "";
    };
    CHECK(error({{"format", "pacini.thing"}, {"version", 2}}).empty());
    CHECK(error({{"version", 2}}) == "format: is missing");
    CHECK(error({{"format", "pacini.thing"}}) == "version: is missing");
    CHECK(error({{"format", "pacini.clip"}, {"version", 2}}) ==
          "format: must be \"pacini.thing\"; clips are for 'pacini render'");
    CHECK(error({{"format", "pacini.thing"}, {"version", 3}}) ==
          "version: was written by a newer version (3) of the format; this program reads version 2");
    CHECK(error({{"format", "pacini.thing"}, {"version", 2.5}}) ==
          "version: was written by a newer version (2.5) of the format; this program reads version 2");
    CHECK(error({{"format", "pacini.thing"}, {"version", 1}}) == "version: must be 2");
    CHECK(error({{"format", "pacini.thing"}, {"version", "2"}}) == "version: must be a number");
}

TEST_CASE("A streamed document says what is wrong with a field and what is needed", "[io][json]")
{
    CHECK(streamError(fieldsStart).empty());
    CHECK(streamError("") == "format: is missing");
    CHECK(streamError("\"version\": 2") == "format: is missing");
    CHECK(streamError("\"format\": \"pacini.thing\"") == "version: is missing");
    CHECK(streamError("\"format\": \"other\"") == "format: is \"other\"; a thing has \"pacini.thing\" here");
    CHECK(streamError("\"format\": 1") == "format: is a number; a text in quotes is needed");
    CHECK(streamError("\"version\": \"2\"") == "version: is a text; a whole number is needed");
    CHECK(streamError("\"version\": 3") ==
          "version: was written by a newer version (3) of the format; this program reads version 2");
    CHECK(streamError("\"version\": 2.5") ==
          "version: was written by a newer version (2.5) of the format; this program reads version 2");
    CHECK(streamError("\"version\": 2.5", true) ==
          "version: is 2.5, which is not a version of the format; this program reads version 2");
    CHECK(streamError("\"version\": 3", true) ==
          "version: was written by a newer version (3) of the format; this program reads version 2");
    CHECK(streamError("\"version\": 1") == "version: is 1, which is not a version of the format");
    CHECK(streamError("\"version\": 0", true) ==
          "version: is 0, which is not a version of the format; this program reads version 2");
    CHECK(memberError("\"name\": 1") == "name: is a number; a text in quotes is needed");
    CHECK(streamError("\"format\": null") == "format: is null; a text in quotes is needed");
    CHECK(memberError("\"point\": {\"time\": null}") == "point.time: is null; a number is needed");
    CHECK(memberError("\"points\": [null]") == "points[0]: is null; an object in braces is needed");
    CHECK(memberError("\"size\": true") == "size: is true or false; a number is needed");
    CHECK(memberError("\"size\": \"1\"") == "size: is a text; a number is needed");
    CHECK(memberError("\"size\": []") == "size: is a list; a number is needed");
    CHECK(memberError("\"size\": {}") == "size: is an object; a number is needed");
    CHECK(memberError("\"count\": -2").empty());
    CHECK(memberError("\"count\": 5").empty());
    CHECK(memberError("\"count\": -3") == "count: is -3; a whole number from -2 to 5 is needed");
    CHECK(memberError("\"count\": 6") == "count: is 6; a whole number from -2 to 5 is needed");
    CHECK(memberError("\"count\": 0.5") == "count: is 0.5; a whole number from -2 to 5 is needed");
    CHECK(memberError("\"count\": \"1\"") == "count: is a text; a whole number is needed");
    CHECK(memberError("\"shape\": \"flat\"") == "shape: is \"flat\"; \"round\", \"square\" or \"long\" is needed");
    CHECK(memberError("\"shape\": 1") == "shape: is a number; \"round\", \"square\" or \"long\" is needed");
    CHECK(memberError("\"point\": 1") == "point: is a number; an object in braces is needed");
    CHECK(memberError("\"point\": []") == "point: is a list; an object in braces is needed");
    CHECK(memberError("\"point\": {}") == "point.time: is missing");
    CHECK(memberError("\"point\": {\"value\": 3}") == "point.time: is missing");
    CHECK(memberError("\"other\": {\"time\": \"x\"}") == "other.time: is a text; a number is needed");
    CHECK(memberError("\"points\": {}") == "points: is an object; a list in brackets is needed");
    CHECK(memberError("\"points\": 3") == "points: is a number; a list in brackets is needed");
    CHECK(memberError("\"points\": [3]") == "points[0]: is a number; an object in braces is needed");
    CHECK(memberError("\"points\": [[]]") == "points[0]: is a list; an object in braces is needed");
    CHECK(memberError("\"points\": [{\"time\": 1}, {}]") == "points[1].time: is missing");
    CHECK(memberError("\"points\": [{\"time\": 1}, {\"time\": 1}]").empty());
    CHECK(memberError("\"points\": [{\"time\": 1}, {\"time\": 1}, {\"time\": 1}]") ==
          "points[2]: is beyond the 2 points that it may have");
    CHECK(memberError("\"rows\": [{\"time\": 1}, {\"time\": 1}, {\"time\": 1}, {\"time\": 1}]") ==
          "rows[3]: is beyond the 3 rows that it may have");
    CHECK(memberError("\"name\": \"a\", \"name\": \"b\"") == "name: is given twice; remove one of the two");
    CHECK(memberError("\"parameters\": {\"a\": 1, \"b\": 2, \"a\": 3}") ==
          "parameters.a: is given twice; remove one of the two");
    CHECK(memberError("\"parameters\": {\"a\": null}") ==
          "parameters.a: is null; a number, a text, true or false is needed");
    CHECK(memberError("\"parameters\": {\"a\": []}") ==
          "parameters.a: is a list; a number, a text, true or false is needed");
    CHECK(memberError("\"unknown\": [{\"a\": [1, {}]}, 2], \"size\": \"x\"") == "size: is a text; a number is needed");
    FieldsStream stream;
    FieldsHandler handler(stream, FieldsOfStream<fieldsFormat>{});
    CHECK_FALSE(parseJson("[]", handler, 100).ok());
    FieldsHandler again(stream, FieldsOfStream<fieldsFormat>{});
    CHECK(parseJson("3", again, 100).error().text() == "is a number; an object in braces is needed");
    CHECK(FieldsHandler::keysOf<FieldsStream>(FieldsOfStream<fieldsFormat>{}) ==
          std::vector<std::string_view>{"format", "version", "name", "size", "count", "shape", "point", "other",
                                        "points", "rows", "times", "parameters"});
}

TEST_CASE("Each of 63 fields of a document counts for itself", "[io][json]")
{
    std::array<double, 63> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        INFO(i);
        FieldsHandler handler(values, FieldsOfMany{});
        const auto parsed = parseJson(fmt::format(R"({{"f{}": {}}})", i, i + 1), handler, 10000);
        REQUIRE(parsed.ok() == (i == 0));
        CHECK((i == 0 || parsed.error().text() == "f0: is missing"));
        CHECK(values[i] == static_cast<double>(i + 1));
    }
}

TEST_CASE("Null stands for what may be missing", "[io][json]")
{
    const FieldsRead least = readFields({{"name", "x"}, {"numbers", {2.0}}});
    nlohmann::json document = {{"name", "x"}, {"numbers", {2.0}}};
    for (const char* name :
         {"size", "count", "ready", "shape", "point", "other", "maybe", "remark", "points", "texts", "unknown"})
        document[name] = nullptr;
    const FieldsRead read = readFields(document);
    CHECK(read.error.empty());
    CHECK(read.warnings == std::vector<std::string>{"unknown: is unknown"});
    CHECK(read.thing.size == least.thing.size);
    CHECK(read.thing.shape == least.thing.shape);
    CHECK_FALSE(read.thing.other);
    CHECK_FALSE(read.thing.maybe);
    CHECK_FALSE(read.thing.remark);
    CHECK(read.thing.points.empty());
    CHECK(readFields({{"name", nullptr}, {"numbers", {2.0}}}).error == "name: must be a text in quotes");
    CHECK(readFields({{"name", "x"}, {"numbers", nullptr}}).error == "numbers: must be a list of numbers");

    std::string members;
    for (const char* name :
         {"name", "size", "count", "shape", "point", "other", "points", "rows", "times", "parameters"})
        members += fmt::format("{}\"{}\": null", members.empty() ? "" : ", ", name);
    CHECK(memberError(members) == "");
    CHECK(memberError("\"size\": null, \"size\": 1") == "size: is given twice; remove one of the two");
}

TEST_CASE("A streamed document fills all its fields, and is written in the same order and layout", "[io][json]")
{
    FieldsStream stream;
    stream.name = "a \"b\"";
    stream.size = -0.0;
    stream.count = 5;
    stream.shape = FieldsShape::square;
    stream.point = {0.25, 4.0};
    stream.other = FieldsPoint{1.0, 2.0};
    stream.points = {{1.0, 2.0}, {3.0, 4.0}};
    stream.rows = {{0.5, 1.0}};
    for (int i = 0; i < 9; ++i)
        stream.times.push_back({0.03125 * i, 1.0});
    stream.times.push_back({0.5, 1.0});
    stream.times.push_back({0.75, 1.0});
    stream.parameters = {{"text", std::string("t")}, {"number", 0.1}, {"yes", true}, {"no", false}};
    const auto textOf = [](const FieldsStream& value, FieldsWriter::Layout layout)
    {
        FieldsWriter writer(layout);
        FieldsOfStream<fieldsFormat>{}(value, writer);
        return std::move(writer).document();
    };
    const std::string compact = R"({
  "format": "pacini.thing",
  "version": 2,
  "name": "a \"b\"",
  "size": 0,
  "count": 5,
  "shape": "square",
  "point": {"time": 0.25, "value": 4},
  "other": {"time": 1, "value": 2},
  "points": [
    {"time": 1, "value": 2},
    {"time": 3, "value": 4}
  ],
  "rows": [
    {"time": 0.5, "value": 1}
  ],
  "times": [
    {"time": 0, "value": 1}, {"time": 0.03125, "value": 1}, {"time": 0.0625, "value": 1}, {"time": 0.09375, "value": 1}, {"time": 0.125, "value": 1}, {"time": 0.15625, "value": 1},
    {"time": 0.1875, "value": 1}, {"time": 0.21875, "value": 1},
    {"time": 0.25, "value": 1},
    {"time": 0.5, "value": 1},
    {"time": 0.75, "value": 1}
  ],
  "parameters": {
    "text": "t",
    "number": 0.1,
    "yes": true,
    "no": false
  }
}
)";
    CHECK(textOf(stream, FieldsWriter::Layout::compact) == compact);
    const std::string spaced = textOf(stream, FieldsWriter::Layout::spaced);
    CHECK(spaced.find("\"point\": { \"time\": 0.25, \"value\": 4 },\n") != std::string::npos);
    CHECK(spaced.find("    { \"time\": 3, \"value\": 4 }\n  ],\n") != std::string::npos);
    CHECK(spaced.find("    {\"time\": 0.5, \"value\": 1}\n") != std::string::npos); // rows stay compact
    const std::string lines = textOf(stream, FieldsWriter::Layout::lines);
    CHECK(lines.find("  \"point\": {\n    \"time\": 0.25,\n    \"value\": 4\n  },\n") != std::string::npos);
    CHECK(lines.find("  \"points\": [\n    {\n      \"time\": 1,\n      \"value\": 2\n    },\n    {\n") !=
          std::string::npos);
    for (const std::string& text : {compact, spaced, lines})
    {
        FieldsStream back;
        FieldsHandler handler(back, FieldsOfStream<fieldsFormat>{});
        REQUIRE(parseJson(text, handler, 10000).ok());
        CHECK(back.name == stream.name);
        CHECK(back.size == 0.0);
        CHECK(back.count == 5);
        CHECK(back.shape == FieldsShape::square);
        CHECK(back.point == stream.point);
        CHECK(back.other == stream.other);
        CHECK(back.points == stream.points);
        CHECK(back.rows == stream.rows);
        CHECK(back.times == stream.times);
        CHECK(back.parameters == stream.parameters);
    }
    // What equals its default is left out where that is allowed, empty lists and objects are short.
    CHECK(textOf({}, FieldsWriter::Layout::compact) == std::string(R"({
  "format": "pacini.thing",
  "version": 2,
  "name": "",
  "size": 0.5,
  "count": 3,
  "shape": "round",
  "rows": [],
  "times": [],
  "parameters": {}
}
)"));
}

TEST_CASE("A writer with a sink hands the text over in pieces that make the same whole", "[io][json]")
{
    FieldsStream stream;
    for (int i = 0; i < 20000; ++i)
        stream.times.push_back({0.1 * i, 1.0 / (i + 1)});
    FieldsWriter whole(FieldsWriter::Layout::compact);
    FieldsOfStream<fieldsFormat>{}(stream, whole);
    const std::string text = std::move(whole).document();
    std::vector<std::string> pieces;
    const TextSink sink = [&](std::string_view piece)
    {
        pieces.emplace_back(piece);
    };
    FieldsWriter streamed(FieldsWriter::Layout::compact, &sink);
    FieldsOfStream<fieldsFormat>{}(stream, streamed);
    pieces.push_back(std::move(streamed).document());
    std::string joined;
    for (const std::string& piece : pieces)
        joined += piece;
    CHECK(joined == text);
    REQUIRE(pieces.size() > 2);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
    {
        CHECK(pieces[i].size() >= 262144);
        CHECK(pieces[i].size() < 262144 + 1000);
    }
}

TEST_CASE("Places in a text count lines, and characters rather than bytes", "[io][json]")
{
    JsonSource source("ab\nc\xC3\xA4z");
    CHECK(source.place(0) == "line 1, column 1");
    CHECK(source.place(1) == "line 1, column 1");
    CHECK(source.place(2) == "line 1, column 2");
    CHECK(source.place(3) == "line 1, column 3");
    CHECK(source.place(4) == "line 2, column 1");
    CHECK(source.place(5) == "line 2, column 2");
    CHECK(source.place(7) == "line 2, column 3");
    CHECK(source.passed() == 0);
    CHECK_FALSE(source.endedByNul());
    CHECK(source.startsWith("ab"));
    CHECK_FALSE(source.startsWith("b"));
    JsonCursor cursor(source);
    CHECK(*cursor == 'a');
    ++cursor;
    CHECK(*cursor == 'b');
    cursor++;
    CHECK(source.passed() == 2);
    CHECK_FALSE(cursor == JsonCursor());
    for (int i = 0; i < 5; ++i)
        ++cursor;
    CHECK(source.atEnd());
    CHECK(cursor == JsonCursor());
}

TEST_CASE("Whole numbers are taken within their range and without a fraction alone", "[io][json]")
{
    int value = 7;
    const auto take = [&](JsonScalar scalar)
    {
        return takeWhole(scalar, -1.0, 2.0, value);
    };
    CHECK(take(2.0) == Taken::yes);
    CHECK(value == 2);
    CHECK(take(-1.0) == Taken::yes);
    CHECK(value == -1);
    CHECK(take(3.0) == Taken::wrongValue);
    CHECK(take(-2.0) == Taken::wrongValue);
    CHECK(take(0.5) == Taken::wrongValue);
    CHECK(take(std::nan("")) == Taken::wrongValue);
    CHECK(take(true) == Taken::wrongKind);
    CHECK(take(std::monostate()) == Taken::wrongKind);
    CHECK(value == -1);
    CHECK(nameOf(FieldsShape::long_, fieldsShapes) == "long");
    CHECK(anyInt.lowest == -2147483648.0);
    CHECK(anyInt.highest == 2147483647.0);
}
