#include "io/FileExtension.h"
#include "io/FileHandle.h"
#include "io/Fingerprint.h"
#include "io/Json5Cursor.h"
#include "io/Json5Text.h"
#include "io/JsonText.h"
#include "io/JsonTree.h"
#include "io/NearestName.h"
#include "io/ReadWarnings.h"
#include "io/Sha256.h"
#include "io/Utf8.h"
#include "support/Catch.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <set>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

/// The number of edits by its definition, without a table: exponential, for short texts.
std::size_t slowTypingDistance(const std::string& a, const std::string& b)
{
    if (a.empty() || b.empty())
        return a.size() + b.size();
    const std::string restA = a.substr(1), restB = b.substr(1);
    std::size_t least = slowTypingDistance(restA, restB) + (a[0] == b[0] ? 0 : 1);
    least = std::min(least, slowTypingDistance(restA, b) + 1);
    least = std::min(least, slowTypingDistance(a, restB) + 1);
    if (a.size() > 1 && b.size() > 1 && a[0] == b[1] && a[1] == b[0])
        least = std::min(least, slowTypingDistance(a.substr(2), b.substr(2)) + 1);
    return least;
}

std::string scannerError(const std::string& text, std::size_t most = 1000)
{
    const auto read = readJsonTree(text, most);
    REQUIRE_FALSE(read.ok());
    return read.error().text();
}

} // namespace

TEST_CASE("Every character survives UTF-8, and nothing else is UTF-8", "[io]")
{
    for (char32_t code = 0; code <= 0x10FFFF; code += code < 0x11000 || code > 0x10FF00 ? 1 : 37)
    {
        if (code >= 0xD800 && code < 0xE000)
            continue;
        std::string text;
        appendUtf8(text, code);
        const std::size_t bytes = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        if (text.size() != bytes || firstUtf8(text + "x").code != code || firstUtf8(text).bytes != bytes ||
            (bytes > 1 && firstUtf8(text.substr(0, bytes - 1)).bytes != 0))
            FAIL(static_cast<unsigned>(code));
    }
    // All pairs and triples at the edges: well-formed exactly where the table of RFC 3629 says so.
    const auto isTail = [](unsigned b)
    {
        return b >= 0x80 && b <= 0xBF;
    };
    const unsigned edges[] = {0x00, 0x7F, 0x80, 0x8F, 0x90, 0x9F, 0xA0, 0xBF, 0xC0, 0xFF};
    for (unsigned lead = 0x80; lead <= 0xFF; ++lead)
        for (const unsigned second : edges)
            for (const unsigned third : edges)
                for (const unsigned fourth : edges)
                {
                    const std::string text = {static_cast<char>(lead), static_cast<char>(second),
                                              static_cast<char>(third), static_cast<char>(fourth)};
                    std::size_t bytes = 0;
                    if (lead >= 0xC2 && lead <= 0xDF && isTail(second))
                        bytes = 2;
                    else if (lead >= 0xE0 && lead <= 0xEF && isTail(second) && isTail(third) &&
                             (lead != 0xE0 || second >= 0xA0) && (lead != 0xED || second <= 0x9F))
                        bytes = 3;
                    else if (lead >= 0xF0 && lead <= 0xF4 && isTail(second) && isTail(third) && isTail(fourth) &&
                             (lead != 0xF0 || second >= 0x90) && (lead != 0xF4 || second <= 0x8F))
                        bytes = 4;
                    if (firstUtf8(text).bytes != bytes)
                        FAIL(lead << " " << second << " " << third << " " << fourth);
                }
    CHECK(firstUtf8("").bytes == 0);
    CHECK(firstUtf8(std::string_view("\0", 1)).bytes == 1);
    CHECK(wellFormedUtf8("a\xC3\xA4\xE2\x82\xAC") == "a\xC3\xA4\xE2\x82\xAC");
    CHECK(wellFormedUtf8("a\xC3z\x80") == "a\xEF\xBF\xBDz\xEF\xBF\xBD");
    CHECK(wellFormedUtf8("\xE2\x82") == "\xEF\xBF\xBD\xEF\xBF\xBD");
    CHECK(wellFormedUtf8("").empty());
}

TEST_CASE("The classes of characters of JSON5 are those of its specification", "[io]")
{
    const std::set<char32_t> spaces = {0x09,   0x0A,   0x0B,   0x0C,   0x0D,   0x20,   0xA0,   0x1680, 0x2000,
                                       0x2001, 0x2002, 0x2003, 0x2004, 0x2005, 0x2006, 0x2007, 0x2008, 0x2009,
                                       0x200A, 0x2028, 0x2029, 0x202F, 0x205F, 0x3000, 0xFEFF};
    for (char32_t c = 0; c < 0x11000; ++c)
    {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const bool digit = c >= '0' && c <= '9';
        const bool hex = digit || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
        const bool space = spaces.contains(c);
        if (json5::isSpace(c) != space || json5::isDigit(c) != digit ||
            json5::endsLine(c) != (c == 0x0A || c == 0x0D || c == 0x2028 || c == 0x2029) ||
            (json5::hexValue(c) >= 0) != hex ||
            json5::startsName(c) != (letter || c == '$' || c == '_' || c == '\\' || (c >= 0x80 && !space)))
            FAIL(static_cast<unsigned>(c));
    }
    CHECK_FALSE(json5::startsName(json5::endOfText));
    for (int i = 0; i < 10; ++i)
        CHECK(json5::hexValue(static_cast<char32_t>('0' + i)) == i);
    for (int i = 0; i < 6; ++i)
    {
        CHECK(json5::hexValue(static_cast<char32_t>('a' + i)) == 10 + i);
        CHECK(json5::hexValue(static_cast<char32_t>('A' + i)) == 10 + i);
    }
}

TEST_CASE("Escapes of JSON5 give the characters at the ends of their ranges", "[io]")
{
    const auto value = [](const std::string& text)
    {
        const auto json = jsonFromJson5(text, 1000);
        CAPTURE(text, json.ok() ? *json : json.error().text());
        REQUIRE(json.ok());
        return nlohmann::json::parse(*json).get<std::string>();
    };
    CHECK(value(R"('\x00')") == std::string(1, '\0'));
    CHECK(value(R"('\xfF')") == "\xC3\xBF");
    CHECK(value(R"('\uFFFF')") == "\xEF\xBF\xBF");
    CHECK(value(R"('\uD7FF\uE000')") == "\xED\x9F\xBF\xEE\x80\x80");
    CHECK(value(R"('\uD800\uDC00')") == "\xF0\x90\x80\x80");
    CHECK(value(R"('\uDBFF\uDFFF')") == "\xF4\x8F\xBF\xBF");
    CHECK(value(R"('\uD801\uDC37')") == "\xF0\x90\x90\xB7");
    CHECK(value(R"('\q\'\"')") == "q'\"");
    CHECK(value("'a\\\nb\\\rc\\\r\nd\\\xE2\x80\xA8"
                "e\\\xE2\x80\xA9"
                "f'") == "abcdef");
    for (const char* bad : {R"('\uD800')", R"('\uDBFF\uDBFF')", R"('\uDBFF\uE000')", R"('\uDFFF')", R"('\uD800x')",
                            R"('\uD800\u12')", R"('\u123')", R"('\x1')", R"('\u12G4')", R"('\xG0')"})
    {
        const auto json = jsonFromJson5(bad, 1000);
        REQUIRE_FALSE(json.ok());
        CHECK(json.error().text() == "line 1, column 3: is not a valid escape of a character");
    }
    for (char digit = '1'; digit <= '9'; ++digit)
        CHECK_FALSE(jsonFromJson5(std::string("'\\") + digit + "'", 1000).ok());
}

TEST_CASE("Numbers of JSON5 become the same numbers of JSON, up to their longest", "[io]")
{
    const auto json = [](const std::string& text)
    {
        const auto converted = jsonFromJson5(text, 1000);
        return converted.ok() ? *converted : converted.error().text();
    };
    CHECK(json("+12") == "12");
    CHECK(json("-.5") == "-0.5");
    CHECK(json("5.") == "5.0");
    CHECK(json("10.25e-3") == "10.25e-3");
    CHECK(json("1E+2") == "1e+2");
    CHECK(json("0.5") == "0.5");
    CHECK(json("-0") == "-0");
    CHECK(json("0x10") == "16");
    CHECK(json("-0Xa") == "-10");
    CHECK(json("0xFFFFFFFFFFFFFFFF") == "1.8446744073709552e+19");
    CHECK(json("0x1FFFFFFFFFFFFFFFF") == "line 1, column 1: is not a hexadecimal number of at most 16 digits");
    CHECK(json("0x") == "line 1, column 1: is not a hexadecimal number of at most 16 digits");
    CHECK(json("0x1g") == "line 1, column 1: is not a hexadecimal number of at most 16 digits");
    CHECK(json("00") == "line 1, column 1: starts with a zero; remove it");
    CHECK(json("-012") == "line 1, column 1: starts with a zero; remove it");
    CHECK(json(std::string(400, '1')) == std::string(400, '1'));
    CHECK(json(std::string(401, '1')) == "line 1, column 1: is not a number");
    CHECK(json("{a:1,'b':[2,3,],}") == "{\"a\":1,\"b\":[2,3]}");
    CHECK(json("[ ]") == "[]");
    CHECK(json("{ }") == "{}");
    CHECK(json("tru") == "line 1, column 1: is neither a value nor a quoted text");
    CHECK(json("true1") == "line 1, column 5: is neither a value nor a quoted text");
    CHECK(json("[null,false,true]") == "[null,false,true]");
    CHECK(json("@") == "line 1, column 1: should be a value");
    CHECK(json("{\"a\"") == "line 1, column 5: ends too early");
    CHECK(json("{\"a\":") == "line 1, column 6: ends too early");
    CHECK(json("[1") == "line 1, column 3: ends too early");
    CHECK(json("{a\\n: 1}") == "line 1, column 4: should be a letter of a name");
    CHECK(json("{\\u0061b1: 1}") == "{\"ab1\":1}");
    const std::string deepest = std::string(32, '[') + std::string(32, ']');
    CHECK(json(deepest) == deepest);
    CHECK(json("[" + deepest + "]") == "line 1, column 33: has more than 32 levels of objects and lists");
    CHECK(jsonFromJson5("[ ]", 3).ok());
    CHECK(jsonFromJson5("[ ]", 2).error().text() == "is longer than the longest supported text");
}

TEST_CASE("Typing distances are those of their definition", "[io]")
{
    const std::vector<std::string> words = {"",     "a",    "b",     "ab",    "ba",   "abc",  "acb",  "cab",
                                            "gain", "gian", "agin",  "pan",   "nap",  "abcd", "badc", "aabb",
                                            "time", "tiem", "times", "emits", "tmie", "xyz",  "xzyw", "abab"};
    for (const std::string& a : words)
        for (const std::string& b : words)
        {
            CAPTURE(a, b);
            CHECK(typingDistance(a, b) == slowTypingDistance(a, b));
        }
    CHECK(typingDistance("GAIN", "gain") == 0);
    CHECK(typingDistance("GIAN", "gain") == 1);
    const std::vector<std::string> names = {"alpha", "beta", "gamma"};
    CHECK(nearestOf("alpah", names, 2) == std::pair<std::string_view, std::size_t>("alpha", 1));
    CHECK(nearestOf("alpah", names, 1) == std::pair<std::string_view, std::size_t>("", 1));
    CHECK(nearestOf("beta", names, 1) == std::pair<std::string_view, std::size_t>("beta", 0));
    const std::vector<std::string> twins = {"ab", "ac"};
    CHECK(nearestOf("ad", twins, 5).first == "ab");
    // One letter, or a third of them.
    CHECK(meantText("bet", names) == "; did you mean beta?");
    CHECK(meantText("bt", names).empty());
    CHECK(meantText("btea", names) == "; did you mean beta?");
    CHECK(meantText("be", names).empty());
    CHECK(meantText("gamma1", names) == "; did you mean gamma?");
    CHECK(meantText("gamm12", names) == "; did you mean gamma?");
    CHECK(meantText("gam123", names).empty());
    CHECK(meantText("gxmm1", names).empty());
    CHECK(meantText("", {}).empty());
}

TEST_CASE("Nearest keys follow the length of the word, other words and beginnings", "[io][keys]")
{
    const std::vector<std::string_view> known = {"gain", "amplitude", "frequency", "start", "time", "q", "Duration"};
    CHECK(nearestKey("gian", known) == "gain");
    CHECK(nearestKey("gxxn", known).empty());
    CHECK(nearestKey("amplxtxde", known) == "amplitude");
    CHECK(nearestKey("amxlxtxde", known).empty());
    CHECK(nearestKey("sta", known) == "start");
    CHECK(nearestKey("starting", known) == "start");
    CHECK(nearestKey("st", known).empty());
    CHECK(nearestKey("quality", known) == "q");
    CHECK(nearestKey("qualty", known) == "q");
    CHECK(nearestKey("volume", known) == "gain");
    CHECK(nearestKey("volum", known) == "gain");
    CHECK(nearestKey("hz", known) == "frequency");
    CHECK(nearestKey("hx", known).empty());
    CHECK(nearestKey("dur", known) == "Duration");
    CHECK(nearestKey("DURATIOM", known) == "Duration");
    CHECK(nearestKey("", known).empty());
    CHECK(nearestKey(std::string("start") + std::string(35, 'x'), known) == "start");
    CHECK(nearestKey(std::string("start") + std::string(36, 'x'), known).empty());
    CHECK(unknownKeyText("gian", known) == "is unknown; did you mean \"gain\"?");
    CHECK(unknownKeyText("zzz", known) == "is unknown");
    for (const char* remark : {"$schema", "_x", "//", "// a", "$"})
        CHECK(isRemark(remark));
    for (const char* key : {"", "a$", "/", "x_", "a//"})
        CHECK_FALSE(isRemark(key));
    ReadWarnings warnings;
    CHECK_FALSE(warnings.isStrict());
    CHECK(ReadWarnings(true).isStrict());
    CHECK(warnings.texts().empty());
    for (int i = 0; i < 20; ++i)
    {
        CHECK(warnings.hasRoom());
        warnings.add("at " + std::to_string(i), "wrong");
    }
    CHECK_FALSE(warnings.hasRoom());
    CHECK(warnings.texts().size() == 20);
    CHECK(warnings.texts()[19] == "at 19: wrong");
    warnings.add("at 20", "wrong");
    warnings.count();
    CHECK(warnings.texts().size() == 21);
    CHECK(warnings.texts()[20] == "and 2 more of this kind");
}

TEST_CASE("SHA-256 of every length around its blocks is that of another implementation", "[io]")
{
    std::string all;
    for (std::size_t n = 0; n < 200; ++n)
    {
        std::string text;
        for (std::size_t i = 0; i < n; ++i)
            text += static_cast<char>((7 * i + n) % 256);
        all += sha256(text);
    }
    // Python's hashlib of the same.
    CHECK(sha256(all) == "b8f5d54cfd1cbbcae2003d1365d9fab7e5bc61813fa3486ee6a6a6bf38db4745");
}

TEST_CASE("FNV-1a gives the hashes that its authors print", "[io]")
{
    const auto of = [](std::string_view text)
    {
        Fingerprint print;
        print.add(text);
        return print.text();
    };
    CHECK(of("") == "cbf29ce484222325");
    CHECK(of("a") == "af63dc4c8601ec8c");
    CHECK(of("foobar") == "85944171f73967e8");
    Fingerprint parts;
    parts.add("foo");
    parts.add("bar");
    CHECK(parts.value() == 0x85944171f73967e8ull);
}

TEST_CASE("Texts that are no JSON say where and why", "[io][json]")
{
    CHECK(scannerError("") == "is empty");
    CHECK(scannerError("\xEF\xBB\xBF") == "is empty");
    CHECK(scannerError("\xEF\xBB\xBF{1").starts_with("line 1, column 2: is not valid JSON"));
    CHECK(scannerError("\xFE\xFF{}") == "line 1, column 1: is UTF-16 text; save it as UTF-8");
    CHECK(scannerError("\xFF\xFE{}") == "line 1, column 1: is UTF-16 text; save it as UTF-8");
    CHECK(scannerError("[1, 1e999]") == "[1]: is beyond the range of numbers");
    CHECK(scannerError("{\"a\": {\"b\": [0, -1e999]}}") == "a.b[1]: is beyond the range of numbers");
    CHECK(scannerError("1e999") == "is beyond the range of numbers");
    CHECK(scannerError(std::string("{\0}", 3)) == "line 1, column 2: has a NUL byte; is this a text file?");
    CHECK(scannerError(std::string("{}\0", 3)) == "line 1, column 3: has a NUL byte after its end");
    CHECK(scannerError("{\"a\": 1, \"a\": 2}") == "a: is given twice");
    CHECK(scannerError("[\n\xC3\xA4").starts_with("line 2, column 1: is not valid JSON: "));
    CHECK(scannerError("[1 2]").starts_with("line 1, column 4: is not valid JSON: "));
    CHECK(scannerError("[\"\x01\"]").find("is not valid JSON: invalid string, ") != std::string::npos);
    CHECK(scannerError("[-x]").find("is not valid JSON: invalid number, ") != std::string::npos);
    CHECK(scannerError("[1 2]").find("last read") == std::string::npos);
    CHECK(scannerError("[1]  ", 4) == "is longer than the longest supported text");
    CHECK(readJsonTree("[1] ", 4).ok());
    const std::string deepest = std::string(32, '[') + std::string(32, ']');
    CHECK(readJsonTree(deepest, 1000).ok());
    CHECK(scannerError("[" + deepest + "]") == "line 1, column 33: has more than 32 levels of objects and lists");
    std::string objects;
    for (int i = 0; i < 33; ++i)
        objects += "{\"a\":";
    CHECK(scannerError(objects) == "line 1, column 161: has more than 32 levels of objects and lists");
    CHECK(*readJsonTree("{\"a\": [1, [2, {\"b\": null}], -3, 0.5], \"c\": true, \"d\": \"x\"}", 1000) ==
          nlohmann::json{{"a", {1, {2, {{"b", nullptr}}}, -3, 0.5}}, {"c", true}, {"d", "x"}});
}

TEST_CASE("Texts for messages stay on one short line, and in quotes they are JSON", "[io][json]")
{
    CHECK(shownText("plain") == "plain");
    CHECK(shownText(std::string("a\x01\x1F\x7F\n z", 7)) == "a???? z");
    CHECK(shownText(std::string(40, 'x')) == std::string(40, 'x'));
    CHECK(shownText(std::string(41, 'x')) == std::string(40, 'x') + "...");
    std::string umlauts;
    for (int i = 0; i < 41; ++i)
        umlauts += "\xC3\xA4";
    CHECK(shownText(umlauts) == umlauts.substr(0, 80) + "...");
    CHECK(shownText(umlauts.substr(0, 80)) == umlauts.substr(0, 80));
    CHECK(inQuotes("a b~ !#[]^") == "\"a b~ !#[]^\"");
    CHECK(inQuotes("\"\\") == R"("\"\\")");
    CHECK(inQuotes("\x1F\x7F") == "\"\\u001f\x7F\"");
    CHECK(inQuotes("\xC3\xA4") == "\"\xC3\xA4\"");
    CHECK(inQuotes("\xC3") == "\"\xEF\xBF\xBD\"");
    CHECK(inQuotes("") == "\"\"");
}

TEST_CASE("What the system refuses is said in plain words", "[io]")
{
    const auto text = [](int number)
    {
        return fileError(number).text();
    };
    CHECK(text(EISDIR) == "is a folder; give the name of a file");
    CHECK(text(EACCES) == "permission denied; check the permissions of the file and its folder");
    CHECK(text(EPERM) == text(EACCES));
    CHECK(text(EROFS) == "the disk is read-only; choose another folder");
    CHECK(text(ENOSPC) == "the disk is full; free some space and try again");
    CHECK(text(EFBIG) == "the file would be larger than the system allows; write a shorter file or raise the limit");
    CHECK(text(ENAMETOOLONG) == "the file name is too long; choose a shorter one");
    CHECK(text(EMFILE) == "too many files are open; close some and try again");
    CHECK(text(ENFILE) == text(EMFILE));
    CHECK(text(EIO) == "the disk reported a read or write error; check the disk");
    CHECK(text(EPIPE) == "the reader of the pipe has closed it");
    CHECK(text(EDOM).starts_with("the system refused: "));
    CHECK(fileError(ENOSPC).code == ErrorCode::diskFull);
    CHECK(fileError(EIO).code == ErrorCode::io);
    CHECK(lowerExtension("A/b.C.WaVZ") == ".wavz");
    CHECK(lowerExtension("A/b.[@`{a") == ".[@`{a");
    CHECK(lowerExtension("A") == "");
}
