#include "support/Catch.h"

#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/RoundStep.h>

#include <charconv>
#include <limits>

using namespace pacini;

TEST_CASE("A number becomes the shortest text that reads back as it, or one of the form that is asked for",
          "[foundation]")
{
    CHECK(numberText(0.1) == "0.1");
    CHECK(numberText(-1e300) == "-1e+300");
    CHECK(numberText(1700.0, std::chars_format::fixed) == "1700");
    CHECK(numberText(1e22, std::chars_format::fixed) == "10000000000000000000000");
    CHECK(numberText(-12.345, std::chars_format::general, 3) == "-12.3");
    CHECK(numberText(-std::numeric_limits<double>::max(), std::chars_format::fixed, 17).size() == 328);
}

TEST_CASE("Decimals are rounded, and what rounds to zero has no sign", "[foundation]")
{
    CHECK(decimalText(2.345, 1) == "2.3");
    CHECK(decimalText(-0.04, 1) == "0.0");
    CHECK(decimalText(-0.4, 0) == "0");
    CHECK(decimalText(-0.06, 1) == "-0.1");
    CHECK(decimalText(10.0, 2) == "10.00");
    CHECK(shortDecimalText(10.0, 2) == "10");
    CHECK(shortDecimalText(10.5, 3) == "10.5");
    CHECK(shortDecimalText(100.0, 0) == "100");
    CHECK(shortDecimalText(-0.001, 2) == "0");
    CHECK(decimalText(-std::numeric_limits<double>::infinity(), 1) == "-inf");
    CHECK(shortDecimalText(std::numeric_limits<double>::quiet_NaN(), 1) == "nan");
}

TEST_CASE("A round step is 1, 2 or 5 times a power of ten, the finest that is wide enough", "[foundation]")
{
    CHECK(RoundStep::from(1.0).size() == 1.0);
    CHECK(RoundStep::from(1.0000001).size() == 1.0); // within a millionth
    CHECK(RoundStep::from(1.1).size() == 2.0);
    CHECK(RoundStep::from(2.5).size() == 5.0);
    CHECK(RoundStep::from(5.1).size() == 10.0);
    CHECK(RoundStep::from(0.0003).size() == 0.0005);
    CHECK(RoundStep::from(0.1).size() == 0.1);
    CHECK(RoundStep::from(3e7).size() == 5e7);
}
