#include "cli/bench/BenchTable.h"

#include "cli/bench/Timed.h"
#include "support/Catch.h"

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

using namespace pacini::cli;

namespace
{
std::vector<BenchColumn> columns()
{
    return {{"clip", "", Reduction::sound},
            {"method", "", Reduction::key},
            summed("work", "s"),
            summed("duration", "s"),
            {"error", "%"},
            {"speed", "", Reduction::ratio, "duration", "work", 10.0},
            {"relative", "", Reduction::relative, "work"}};
}

BenchTable twoSounds()
{
    BenchTable table(columns());
    table.add({"a.wav", "slow", 4.0, 1.0, 3.0});
    table.add({"a.wav", "fast", 1.0, 1.0, 5.0});
    table.add({"b.wav", "slow", 2.0, 5.0, {}});
    table.add({"b.wav", "fast", 0.5, 5.0, 1.0});
    return table;
}
} // namespace

TEST_CASE("Ratio columns of a bench table are the quotient of two others", "[cli][bench]")
{
    const BenchTable table = twoSounds();
    CHECK(table.number(0, "speed") == 2.5);
    CHECK(table.number(3, "speed") == 100.0);
    BenchTable zero(columns());
    zero.add({"a.wav", "slow", 0.0, 1.0, 1.0});
    CHECK(std::isnan(zero.number(0, "speed")));
}

TEST_CASE("Relative columns of a bench table compare with the first row of the same sound", "[cli][bench]")
{
    const BenchTable table = twoSounds();
    CHECK(table.number(0, "relative") == 1.0);
    CHECK(table.number(1, "relative") == 0.25);
    CHECK(table.number(2, "relative") == 1.0);
    CHECK(table.number(3, "relative") == 0.25);
}

TEST_CASE("Relative columns of a bench table can compare within a key", "[cli][bench]")
{
    BenchTable table({{"group", "", Reduction::key},
                      {"time", "", Reduction::mean},
                      {"relative", "", Reduction::relative, "time", "group"}});
    table.add({"x", 2.0});
    table.add({"y", 8.0});
    table.add({"x", 3.0});
    table.add({"y", 2.0});
    CHECK(table.number(2, "relative") == 1.5);
    CHECK(table.number(3, "relative") == 0.25);
}

TEST_CASE("Over the sounds, means skip empty cells, sums add up and ratios are those of the sums", "[cli][bench]")
{
    const BenchTable means = twoSounds().overSounds();
    REQUIRE(means.rows() == 2);
    CHECK(means.header().front().name == "method");
    CHECK(means.text(0, "method") == "slow");
    CHECK(means.number(0, "work") == 6.0);
    CHECK(means.number(0, "error") == 3.0);
    CHECK(means.number(1, "error") == 3.0);
    CHECK(means.number(0, "speed") == 10.0);
    CHECK(means.number(1, "speed") == 40.0);
    CHECK(means.number(1, "relative") == 0.25);
}

TEST_CASE("Spreads are the SD over the sounds, and a table is sorted by a column with the gaps last", "[cli][bench]")
{
    BenchTable table({{"clip", "", Reduction::sound},
                      {"method", "", Reduction::key},
                      {"match", "", Reduction::mean},
                      {"sd", "", Reduction::spread, "match"}});
    using Sound = std::tuple<const char*, double, double>;
    for (const auto& [clip, first, second] : {Sound{"a", 40.0, 70.0}, Sound{"b", 44.0, 76.0}, Sound{"c", 48.0, 70.0}})
    {
        table.add({clip, "first", first});
        table.add({clip, "none", {}});
        table.add({clip, "second", second});
    }
    table.add({"a", "once", 50.0});
    CHECK(std::isnan(table.number(0, "sd")));
    const BenchTable means = table.overSounds().sortedBy("match");
    REQUIRE(means.rows() == 4);
    CHECK(means.text(0, "method") == "second");
    CHECK(means.number(0, "sd") == Approx(std::sqrt(12.0)));
    CHECK(means.text(1, "method") == "once");
    CHECK(means.text(1, "sd") == "-");
    CHECK(means.text(2, "method") == "first");
    CHECK(means.number(2, "sd") == Approx(4.0));
    CHECK(means.text(3, "method") == "none");
}

TEST_CASE("A bench table filters its rows by a text", "[cli][bench]")
{
    const BenchTable fast = twoSounds().where("method", "fast");
    REQUIRE(fast.rows() == 2);
    CHECK(fast.text(1, "clip") == "b.wav");
    CHECK(twoSounds().where("method", "none").rows() == 0);
}

TEST_CASE("A bench table as CSV has a header with units, quotes what needs it and loses no digits", "[cli][bench]")
{
    BenchTable table({{"name", "", Reduction::sound}, {"error", "dB"}});
    table.add({"a, \"b\"", 0.1});
    table.add({"c", {}});
    CHECK(table.csv() == "name,error [dB]\n\"a, \"\"b\"\"\",0.1\nc,\n");
    BenchTable third({{"name", "", Reduction::key}, {"x", ""}});
    third.add({"third", 1.0 / 3.0});
    const std::string csv = third.csv();
    CHECK(std::stod(csv.substr(csv.rfind(",") + 1)) == 1.0 / 3.0);
}

TEST_CASE("A bench table as JSON keeps numbers, texts and gaps apart", "[cli][bench]")
{
    const auto json = nlohmann::json::parse(twoSounds().json().dump());
    REQUIRE(json.size() == 4);
    CHECK(json[0]["clip"] == "a.wav");
    CHECK(json[0]["error"] == 3.0);
    CHECK(json[2]["error"].is_null());
    CHECK(json[0]["speed"] == 2.5);
}

TEST_CASE("A bench table for people has aligned columns and three digits, without what only files show", "[cli][bench]")
{
    BenchTable table({{"name", "", Reduction::key}, summed("hidden"), {"time", "s"}});
    table.add({"a", 1.0, 12345.678});
    table.add({"longer", 1.0, 0.0123456});
    table.add({"tiny", 1.0, 1.5e-9});
    CHECK(table.aligned() == "name        time\n"
                             "               s\n"
                             "a          12346\n"
                             "longer    0.0123\n"
                             "tiny    1.50e-09\n");
    CHECK(table.markdown() == "| name | time [s] |\n|---|---:|\n| a | 12346 |\n| longer | 0.0123 |\n"
                              "| tiny | 1.50e-09 |\n");
}

TEST_CASE("Timed work gives its result, at least one run and no more than asked for", "[cli][bench]")
{
    int runs = 0;
    const auto run = timed(3, [&runs] { return ++runs; });
    CHECK(runs == 3);
    CHECK(run.result == 3);
    CHECK(run.seconds >= 0.0);
}
