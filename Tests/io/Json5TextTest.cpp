#include "io/Json5Text.h"

#include "io/JsonText.h"
#include "support/Catch.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <utility>

using namespace pacini;

namespace
{
constexpr std::size_t limit = 100000;

/// The value of a JSON5 text, read by another parser after the conversion.
nlohmann::json valueOf(std::string_view text)
{
    const auto json = jsonFromJson5(text, limit);
    CAPTURE(text, json.ok() ? *json : json.error().text());
    REQUIRE(json.ok());
    return nlohmann::json::parse(*json);
}

std::string errorOf(std::string_view text)
{
    CAPTURE(text);
    const auto json = jsonFromJson5(text, limit);
    REQUIRE_FALSE(json.ok());
    return json.error().text();
}
} // namespace

TEST_CASE("What JSON5 adds to JSON is understood", "[io]")
{
    using Json = nlohmann::json;
    CHECK(valueOf("{a: 1, $b_2: 'x', \"c\": [1, 2,], ünï: null, d\\u0065: true,}") ==
          Json{{"a", 1}, {"$b_2", "x"}, {"c", {1, 2}}, {"ünï", nullptr}, {"de", true}});
    CHECK(valueOf("// one\n/* two\n * three **/ [ /**/ ] // four") == Json::array());
    CHECK(valueOf("\xEF\xBB\xBF\v\f\xC2\xA0\xE2\x80\xA8 {} \xE3\x80\x80") == Json::object());
    CHECK(valueOf("'it\\'s \"so\"'") == "it's \"so\"");
    CHECK(valueOf(R"('\b\f\n\r\t\v\0\\\/\a\x41\u00e9\uD83D\uDE00')") ==
          std::string("\b\f\n\r\t\v\0\\/aA\xC3\xA9\xF0\x9F\x98\x80", 17));
    CHECK(valueOf("'two \\\nlines \\\r\nor three\\\xE2\x80\xA9'") == "two lines or three");
    CHECK(valueOf("'\t\x01\xE2\x80\xA8'") == "\t\x01\xE2\x80\xA8");
    for (const auto& [text, number] : {std::pair("+1", 1.0),
                                       {"-1", -1.0},
                                       {".5", 0.5},
                                       {"5.", 5.0},
                                       {"-.5e+2", -50.0},
                                       {"5.e-1", 0.5},
                                       {"0", 0.0},
                                       {"0x1F", 31.0},
                                       {"-0Xff", -255.0},
                                       {"+0x0", 0.0},
                                       {"0xFFFFFFFFFFFFFFFF", 18446744073709551615.0},
                                       {"1E3", 1000.0}})
        CHECK(valueOf(text).get<double>() == number);
}

TEST_CASE("Strict JSON stays what it is", "[io]")
{
    const std::string text = R"({"a":[1,-2.5e-3,true,false,null,"x\"\\\u00e9"],"b":{}})";
    CHECK(valueOf(text) == nlohmann::json::parse(text));
}

TEST_CASE("Broken JSON5 is refused with line and column", "[io]")
{
    CHECK(errorOf("") == "line 1, column 1: ends too early");
    CHECK(errorOf("{a: 1,\n  b: }") == "line 2, column 6: should be a value");
    CHECK(errorOf("{a: 1\n b: 2}") == "line 2, column 2: should be a comma or a closing brace");
    CHECK(errorOf("[1 2]") == "line 1, column 4: should be a comma or a closing bracket");
    CHECK(errorOf("{a 1}") == "line 1, column 4: should be a colon");
    CHECK(errorOf("{,}") == "line 1, column 2: should be a name");
    CHECK(errorOf("{1: 2}") == "line 1, column 2: should be a name");
    CHECK(errorOf("{a: b}") == "line 1, column 5: is neither a value nor a quoted text");
    CHECK(errorOf("truely") == "line 1, column 5: is neither a value nor a quoted text");
    CHECK(errorOf("{} x") == "line 1, column 4: has text after its end");
    CHECK(errorOf("{ü: /* never") == "line 1, column 5: opens a comment that does not end");
    CHECK(errorOf("'open\n'") == "line 1, column 6: ends a line inside a text");
    CHECK(errorOf("'open") == "line 1, column 6: ends too early");
    CHECK(errorOf("'\\") == "line 1, column 3: ends too early");
    CHECK(errorOf("'\\1'") == "line 1, column 3: is not a valid escape; write \\x and two digits");
    CHECK(errorOf("'\\01'") == "line 1, column 3: is not a valid escape; write \\x and two digits");
    CHECK(errorOf("'\\x4'") == "line 1, column 3: is not a valid escape of a character");
    CHECK(errorOf("'\\uD800'") == "line 1, column 3: is not a valid escape of a character");
    CHECK(errorOf("'\\uD800\\u0041'") == "line 1, column 3: is not a valid escape of a character");
    CHECK(errorOf("'\\uDC00'") == "line 1, column 3: is not a valid escape of a character");
    CHECK(errorOf("{a\\x: 1}") == "line 1, column 4: should be a letter of a name");
    CHECK(errorOf("Infinity") == "line 1, column 1: Infinity is not a number in the supported range");
    CHECK(errorOf("[-NaN]") == "line 1, column 2: NaN is not a number in the supported range");
    for (const char* number : {"+", ".", "-.", "1e", "1e+", "1.e", "1x", "N", "--1", "+ 1", "1_0"})
        CHECK(errorOf(number) == "line 1, column 1: is not a number");
    CHECK(errorOf("01") == "line 1, column 1: starts with a zero; remove it");
    CHECK(errorOf(std::string(500, '1')) == "line 1, column 1: is not a number");
    for (const char* number : {"0x", "0xG", "0x12345678901234567", "0x1.5"})
        CHECK_FALSE(errorOf(number).empty());
    CHECK(errorOf("{a: '\xC3('}") == "line 1, column 6: is not UTF-8");
    CHECK(errorOf("'\xED\xA0\x80'") == "line 1, column 2: is not UTF-8");
    CHECK(errorOf("'\xC0\x80'") == "line 1, column 2: is not UTF-8");
    CHECK(errorOf(std::string_view("{}\0", 3)) == "line 1, column 3: has text after its end");
}

TEST_CASE("JSON5 that is too deep or too long is refused before it costs much", "[io]")
{
    CHECK(jsonFromJson5(std::string(32, '[') + std::string(32, ']'), limit).ok());
    const auto deep = jsonFromJson5(std::string(limit, '['), limit);
    REQUIRE_FALSE(deep.ok());
    CHECK(deep.error().code == ErrorCode::tooLarge);
    CHECK(deep.error().where == "line 1, column 33");
    CHECK(jsonFromJson5(std::string(limit + 1, ' '), limit).error().code == ErrorCode::tooLarge);
}
