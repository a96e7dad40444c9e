#include "support/Catch.h"

#include <pacini/foundation/Description.h>
#include <pacini/foundation/Units.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

using namespace pacini;

namespace
{
enum class Shape
{
    sine,
    square,
};

struct Inner
{
    Seconds attackTime{0.01};
    std::optional<double> most;
};

struct MadeUpParams
{
    int count = 3;
    bool loud = true;
    Shape shape = Shape::square;
    Inner inner;
    std::optional<Inner> more;
};

constexpr std::array<std::string_view, 2> shapes{"sine", "square"};
constexpr std::array table{
    described<&MadeUpParams::count>({.name = "count", .text = "How many", .range = {1, 8}}),
    described<&MadeUpParams::loud>({.name = "quiet", .member = "loud", .text = "Keep still", .negated = true}),
    described<&MadeUpParams::shape>({.name = "shape", .text = "Form", .choices = shapes}),
    described<&MadeUpParams::inner, &Inner::attackTime>(
        {.name = "attackTime", .text = "Rise", .unit = "s", .range = {0, 1.5}}),
    described<&MadeUpParams::inner, &Inner::most>({.name = "most", .text = "Limit", .range = {0, 1}}),
    described<&MadeUpParams::more, &Inner::attackTime>({.name = "moreAttack", .text = "Rise", .range = {0, 1}}),
};
} // namespace

TEST_CASE("A description takes kind and default from the struct", "[description]")
{
    CHECK(table[0].kind == ParameterKind::whole);
    CHECK(table[0].usual() == 3.0);
    CHECK(table[0].member == "count");
    CHECK(table[1].kind == ParameterKind::truth);
    CHECK(table[1].usual() == 0.0); // not quiet
    CHECK(table[2].kind == ParameterKind::choice);
    CHECK(valueText(table[2], table[2].usual()) == "square");
    CHECK(table[3].kind == ParameterKind::number);
    CHECK(table[3].usual() == 0.01);
    CHECK(!table[3].optional);
    for (const std::size_t unset : {4u, 5u})
    {
        CHECK(table[unset].optional);
        CHECK(std::isnan(table[unset].usual()));
        CHECK(valueText(table[unset], table[unset].usual()).empty());
    }
}

TEST_CASE("Values go through a description into the struct and back", "[description]")
{
    MadeUpParams params;
    table[0].set(params, 5.0);
    table[1].set(params, 1.0);
    table[2].set(params, 0.0);
    table[3].set(params, 0.5);
    table[4].set(params, 0.25);
    table[5].set(params, 0.75);
    CHECK(params.count == 5);
    CHECK(!params.loud);
    CHECK(params.shape == Shape::sine);
    CHECK(params.inner.attackTime == Seconds(0.5));
    CHECK(params.inner.most == 0.25);
    REQUIRE(params.more);
    CHECK(params.more->attackTime == Seconds(0.75));
    for (const auto& [index, value] : {std::pair(0u, 5.0), std::pair(1u, 1.0), std::pair(2u, 0.0), std::pair(3u, 0.5),
                                       std::pair(4u, 0.25), std::pair(5u, 0.75)})
        CHECK(table[index].get(params) == value);
}

TEST_CASE("Values that a description does not allow are refused at its name", "[description]")
{
    const auto message = [](std::size_t index, double value)
    {
        const auto allowed = checkValue(table[index], value);
        return allowed ? std::string() : allowed.error().text();
    };
    CHECK(message(0, 1.0).empty());
    CHECK(message(0, 8.0).empty());
    CHECK(message(0, 9.0) == "count: must be 1 to 8");
    CHECK(message(0, 1.5) == "count: must be a whole number, 1 to 8");
    CHECK(message(0, NAN) == "count: must be a whole number, 1 to 8");
    CHECK(message(3, NAN) == "attackTime: must be 0 to 1.5 s");
    CHECK(message(1, 2.0) == "quiet: must be true or false");
    CHECK(message(2, 2.0) == "shape: must be sine or square");
    CHECK(message(3, 1.5).empty());
    CHECK(message(3, -1e-9) == "attackTime: must be 0 to 1.5 s");

    MadeUpParams params;
    CHECK(checkParameters(table, params)); // what is not set is not checked
    params.inner.most = 2.0;
    REQUIRE(!checkParameters(table, params));
    CHECK(checkParameters(table, params).error().where == "most");
}

TEST_CASE("Names have a form for each door", "[description]")
{
    CHECK(separatedName("attackTime", '-') == "attack-time");
    CHECK(separatedName("attackTime", '_') == "attack_time");
    CHECK(separatedName("count", '-') == "count");
    CHECK(numberText(1000000.0, std::chars_format::fixed) == "1000000");
    CHECK(numberText(0.00001, std::chars_format::fixed) == "0.00001");
    CHECK(numberText(-120.0, std::chars_format::fixed) == "-120");
}
