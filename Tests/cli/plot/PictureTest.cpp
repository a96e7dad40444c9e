#include "cli/plot/SvgCanvas.h"
#include "cli/plot/WorkPrecisionFigure.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

using namespace pacini;
using namespace pacini::plot;

namespace
{
std::uint32_t bigEndian(const std::string& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes.at(i));
    return value;
}

std::size_t occurrences(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

WorkPrecisionFigure example()
{
    WorkPrecisionFigure figure;
    figure.title = "Error & time";
    figure.workTitle = "Time (s)";
    figure.errorTitle = "Error (dB)";
    figure.series = {{"first <method>", {{1e-5, 3.0, "small"}, {1e-4, 0.3, ""}, {1e-3, 0.03, ""}}, true},
                     {"second", {{2e-5, 2.0, ""}, {0.0, 1.0, ""}, {1e-4, 0.0, ""}}, true}};
    return figure;
}
} // namespace

TEST_CASE("A PNG has its signature and the size asked for", "[plot]")
{
    const test::TempFolder folder;
    const auto written = writeWorkPrecision(folder / "a.PNG", example(), {{640, 480}, true});
    REQUIRE(written.ok());
    const std::string bytes = test::bytesOf(folder / "a.PNG");
    CHECK(bytes.size() == *written);
    CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    CHECK(bytes.substr(12, 4) == "IHDR");
    CHECK(bigEndian(bytes, 16) == 640);
    CHECK(bigEndian(bytes, 20) == 480);
}

TEST_CASE("The same figure gives the same bytes", "[plot]")
{
    const test::TempFolder folder;
    for (const std::string extension : {".png", ".svg"})
    {
        REQUIRE(writeWorkPrecision(folder / ("a" + extension), example()).ok());
        REQUIRE(writeWorkPrecision(folder / ("b" + extension), example()).ok());
        CHECK(test::bytesOf(folder / ("a" + extension)) == test::bytesOf(folder / ("b" + extension)));
    }
}

TEST_CASE("A PDF is one", "[plot]")
{
    const test::TempFolder folder;
    REQUIRE(writeWorkPrecision(folder / "a.pdf", example()).ok());
    const std::string bytes = test::bytesOf(folder / "a.pdf");
    CHECK(bytes.substr(0, 5) == "%PDF-");
    CHECK(bytes.find("%%EOF") != std::string::npos);
}

TEST_CASE("A work-precision figure as SVG has its texts as texts and leaves out what has no logarithm", "[plot]")
{
    const test::TempFolder folder;
    REQUIRE(writeWorkPrecision(folder / "a.svg", example()).ok());
    const std::string svg = test::bytesOf(folder / "a.svg");
    for (const std::string text :
         {"Error &amp; time", "first &lt;method&gt;", "second", "Time (s)", "Error (dB)", "small"})
        CHECK(occurrences(svg, ">" + text + "</text>") == 1);

    const Figure figure = makeFigure(example(), {});
    REQUIRE(figure.panels.size() == 1);
    REQUIRE(figure.panels[0].series.size() == 2);
    CHECK(std::get<Line>(figure.panels[0].series[0]).points.size() == 3);
    CHECK(std::get<Line>(figure.panels[0].series[1]).points == std::vector<Point>{{2e-5, 2.0}});
}

TEST_CASE("A work-precision figure without points is drawn all the same", "[plot]")
{
    const test::TempFolder folder;
    CHECK(writeWorkPrecision(folder / "empty.png", {}).ok());
    WorkPrecisionFigure figure;
    figure.series = {{"none", {{std::nan(""), 1.0, ""}, {1.0, std::numeric_limits<double>::infinity(), ""}}, false}};
    CHECK(writeWorkPrecision(folder / "none.svg", figure).ok());
}

TEST_CASE("Series differ in colour or shape as far as the twenty-first", "[plot]")
{
    WorkPrecisionFigure data;
    data.series.resize(21);
    const Figure figure = makeFigure(data, {});
    const auto& series = figure.panels[0].series;
    for (std::size_t a = 0; a < series.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
        {
            const plot::Marker& first = *std::get<Line>(series[a]).marker;
            const plot::Marker& second = *std::get<Line>(series[b]).marker;
            CHECK_FALSE((first.shape == second.shape && first.colour == second.colour));
        }
}

TEST_CASE("A picture that cannot be written is an error and leaves nothing", "[plot]")
{
    const test::TempFolder folder;
    const auto nowhere = writeWorkPrecision(folder / "missing/a.png", example());
    REQUIRE_FALSE(nowhere.ok());
    CHECK(nowhere.error().code == ErrorCode::io);
    const auto unknown = writeWorkPrecision(folder / "a.gif", example());
    REQUIRE_FALSE(unknown.ok());
    CHECK(unknown.error().code == ErrorCode::invalidArgument);
    CHECK(folder.entries() == 0);
}

TEST_CASE("Texts keep what is UTF-8 and replace the rest", "[plot]")
{
    const std::string mark = "\xef\xbf\xbd";
    CHECK(printable("T\xc3\xbcr \xe2\x82\xac \xf0\x9f\x8e\xb5") == "T\xc3\xbcr \xe2\x82\xac \xf0\x9f\x8e\xb5");
    CHECK(printable("a\nb") == "a" + mark + "b");
    CHECK(printable("\xff") == mark);
    CHECK(printable("\xc3") == mark);
    CHECK(printable("\xc0\xaf") == mark + mark);            // overlong
    CHECK(printable("\xed\xa0\x80") == mark + mark + mark); // surrogate
    CHECK(printable("\xf5\x80\x80\x80").find(mark) == 0);   // beyond Unicode
    CHECK(printable(std::string("a\0b", 3)) == "a" + mark + "b");
    CHECK(printable("").empty());
}

TEST_CASE("Shortened texts fit", "[plot]")
{
    const SvgCanvas canvas(100, 100, "");
    const TextStyle style{};
    const std::string text = "\u00fcberaus lange \u00dcberschrift";
    CHECK(shortened(canvas, text, style, 1e4) == text);
    for (const double width : {20.0, 50.0, 100.0})
    {
        const std::string part = shortened(canvas, text, style, width);
        CHECK(canvas.textWidth(part, style) <= width);
        CHECK(printable(part) == part); // not cut within a character
        CHECK(part.ends_with("\u2026"));
    }
}
