#include "support/Catch.h"

#include <pacini/foundation/ParseNumber.h>
#include <pacini/foundation/Random.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>

using namespace pacini;

TEST_CASE("A number is read back from its text to the last bit, with either way to read it", "[foundation]")
{
    Random random(7);
    for (int i = 0; i < 20000; ++i)
    {
        const auto value = std::bit_cast<double>(random.next());
        if (!std::isfinite(value))
            continue;
        std::array<char, 40> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
        const std::string text(digits.data(), end);
        INFO(text);
        REQUIRE(parseNumber(text) == value);
        REQUIRE(detail::parseByStrtod(text) == value);
    }
}

TEST_CASE("Texts that are numbers and texts that are none", "[foundation]")
{
    struct Case
    {
        const char* text;
        std::optional<double> number;
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const auto& [text, number] : std::initializer_list<Case>{{"0", 0.0},
                                                                  {"-12.50", -12.5},
                                                                  {".5", 0.5},
                                                                  {"5.", 5.0},
                                                                  {"1e3", 1000.0},
                                                                  {"1.5E+3", 1500.0},
                                                                  {"25e-1", 2.5},
                                                                  {"0.1", 0.1},
                                                                  {"-inf", -infinity},
                                                                  {"0000000000000000000000000000000000000001", 1.0},
                                                                  {"4.9e-324", 4.9e-324},
                                                                  {"1e-400", {}},
                                                                  {"1e400", {}},
                                                                  {"1e99999999999", {}},
                                                                  {"", {}},
                                                                  {"-", {}},
                                                                  {".", {}},
                                                                  {"+1", {}},
                                                                  {" 1", {}},
                                                                  {"1 ", {}},
                                                                  {"--1", {}},
                                                                  {"1,5", {}},
                                                                  {"1.5.2", {}},
                                                                  {"0x10", {}},
                                                                  {"1e", {}},
                                                                  {"1e+", {}},
                                                                  {"1e+-2", {}},
                                                                  {"1e2.5", {}},
                                                                  {"1f", {}},
                                                                  {"e5", {}},
                                                                  {"number", {}}})
    {
        INFO("'" << text << "'");
        CHECK(parseNumber(text) == number);
        CHECK(detail::parseByStrtod(text) == number);
    }
    CHECK(std::isnan(parseNumber("nan").value()));
    CHECK(std::isnan(detail::parseByStrtod("nan").value()));
    CHECK(parseNumber<int>("-17") == -17);
    CHECK(parseNumber<std::uint8_t>("256") == std::nullopt);
    CHECK(parseNumber<int>("1.0") == std::nullopt);
}
