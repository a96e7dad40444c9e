#include "cli/DescribedOptions.h"

#include "cli/HelpText.h"
#include "support/Catch.h"

#include <array>
#include <optional>
#include <string>

using namespace pacini;
using namespace pacini::cli;

namespace
{
enum class Shape
{
    sine,
    square,
};

/// What a command could get: two edits each, a field and its description.
struct MadeUpParams
{
    double shimmer = 0.5;
    int count = 3;
    bool loud = true;
    Shape shape = Shape::sine;
    std::optional<double> most;
};

constexpr std::array<std::string_view, 2> shapes{"sine", "square"};
constexpr std::array table{
    described<&MadeUpParams::shimmer>(
        {.name = "shimmerDepth", .text = "How much it shimmers", .unit = "dB", .range = {0, 6}, .group = "Light"}),
    described<&MadeUpParams::count>({.name = "count", .text = "How many", .range = {1, 8}, .group = "Light"}),
    described<&MadeUpParams::loud>({.name = "quiet", .text = "Keep still", .group = "Sound", .negated = true}),
    described<&MadeUpParams::shape>(
        {.name = "shape", .text = "Form: sine or square", .choices = shapes, .group = "Sound"}),
    described<&MadeUpParams::most>({.name = "most", .text = "Limit", .range = {0, 1}, .usualText = "none"}),
};

struct Program
{
    Program()
    {
        command = app.add_subcommand("make", "Make things");
        options.declare(*command, infosOf(table));
    }

    /// What is wrong with the arguments; empty: nothing.
    std::string parse(const std::string& arguments)
    {
        try
        {
            app.parse("make " + arguments);
        }
        catch (const CLI::ParseError& error)
        {
            return error.what();
        }
        return "";
    }

    CLI::App app;
    CLI::App* command;
    DescribedOptions options;
};
} // namespace

TEST_CASE("Described parameters are options with their ranges, defaults and headings", "[cli]")
{
    Program program;
    const CommandText tree = commandTree(program.app);
    const std::string help = helpText(*commandNamed(tree, "make"), 120) + "\n";
    for (const char* line :
         {"\nLight:\n", "\nSound:\n", "    --shimmer-depth X     How much it shimmers (0 to 6 dB) [0.5]\n",
          "    --count N             How many (1 to 8) [3]\n", "    --quiet               Keep still\n",
          "    --shape NAME          Form: sine or square [sine]\n",
          "    --most X              Limit (0 to 1) [none]\n"})
    {
        CAPTURE(help, line);
        CHECK(help.find(line) != std::string::npos);
    }
}

TEST_CASE("Options that were given are the values of their parameters", "[cli]")
{
    Program program;
    REQUIRE(program.parse("--shimmer-depth 2.5 --count 8 --quiet --shape square").empty());
    MadeUpParams params;
    program.options.apply(table, params);
    CHECK(params.shimmer == 2.5);
    CHECK(params.count == 8);
    CHECK(!params.loud);
    CHECK(params.shape == Shape::square);
    CHECK(!params.most);
}

TEST_CASE("Values that a description does not allow are usage errors", "[cli]")
{
    for (const auto& [arguments, says] :
         {std::pair("--shimmer-depth 7", "'7' is not a number from 0 to 6 dB"),
          std::pair("--shimmer-depth nan", "'nan' is not a number from 0 to 6 dB"),
          std::pair("--count 1.5", "'1.5' is not a whole number from 1 to 8"),
          std::pair("--count -1", "'-1' is not a whole number from 1 to 8"),
          std::pair("--count 99999999999999999999", "is not a whole number from 1 to 8"),
          std::pair("--most 2", "--most: '2' is not a number from 0 to 1"),
          std::pair("--shape sqare", "'sqare' is not one of sine, square; did you mean square?")})
    {
        Program program;
        const std::string message = program.parse(arguments);
        CAPTURE(arguments, message);
        CHECK(message.find(says) != std::string::npos);
    }
}
