#include "cli/study/Page.h"

#include "io/Sha256.h"
#include "io/TableText.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace pacini::cli
{

namespace
{
/// A cell of a Markdown table: on one line, without its separator; HTML in it stays text.
std::string cellText(std::string_view text)
{
    std::string safe;
    for (const char c : text)
    {
        if (c == '|' || c == '\\' || c == '<' || c == '*' || c == '_' || c == '`')
            safe += '\\';
        safe += c == '\n' ? ' ' : c;
    }
    return safe;
}

constexpr std::string_view stampStart = "<!-- Report by Pacini; SHA-256 of what stands above: ";

constexpr std::string_view style = R"(
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1, h2, h3 { line-height: 1.2; margin: 2rem 0 .5rem; }
.scrolls { overflow-x: auto; }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding: .3rem 0; opacity: .8; }
th, td { padding: .2rem .7rem; border-bottom: 1px solid #8884; text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
figure { margin: 1rem 0; background: #fff; border-radius: 6px; }
figure svg { width: 100%; height: auto; display: block; }
@media print { body { max-width: none; } h2 { break-after: avoid; } figure, table { break-inside: avoid; } }
)";

/// The SVG without what only a file of its own needs.
std::string_view withoutProlog(std::string_view svg)
{
    const std::size_t start = svg.find("<svg");
    return start == std::string_view::npos ? svg : svg.substr(start);
}

std::string htmlTable(const PageTable& table)
{
    std::string text = "<div class=\"scrolls\" tabindex=\"0\"><table>\n";
    if (!table.caption.empty())
        text += fmt::format("<caption>{}</caption>\n", xmlText(table.caption));
    text += "<thead><tr>";
    for (const std::string& column : table.columns)
        text += fmt::format("<th scope=\"col\">{}</th>", xmlText(column));
    text += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows)
    {
        text += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            text += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", xmlText(row[i]))
                           : fmt::format("<td>{}</td>", xmlText(row[i]));
        text += "</tr>\n";
    }
    return text + "</tbody>\n</table></div>\n";
}

std::string markdownTable(const PageTable& table)
{
    std::string text;
    if (!table.caption.empty())
        text += table.caption + "\n\n";
    std::string line = "|";
    text += "|";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
    {
        text += fmt::format(" {} |", cellText(table.columns[i]));
        line += i == 0 ? "---|" : "---:|";
    }
    text += "\n" + line + "\n";
    for (const auto& row : table.rows)
    {
        text += "|";
        for (const std::string& cell : row)
            text += fmt::format(" {} |", cellText(cell));
        text += "\n";
    }
    return text;
}
} // namespace

std::string stamped(std::string text)
{
    const std::string hash = sha256(text);
    return std::move(text) + fmt::format("{}{} -->\n", stampStart, hash);
}

bool isAsWritten(std::string_view text)
{
    const std::size_t at = text.rfind(stampStart);
    return at != std::string_view::npos &&
           text.substr(at) == fmt::format("{}{} -->\n", stampStart, sha256(text.substr(0, at)));
}

std::string htmlOf(const Page& page)
{
    std::string text = fmt::format("<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n"
                                   "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n"
                                   "<style>{}</style>\n</head>\n<body>\n<main>\n",
                                   page.language, xmlText(page.title), style);
    for (const PagePart& part : page.parts)
    {
        if (const auto* heading = std::get_if<PageHeading>(&part))
            text += fmt::format("<h{0}>{1}</h{0}>\n", heading->level, xmlText(heading->text));
        else if (const auto* paragraph = std::get_if<PageParagraph>(&part))
            text += fmt::format("<p>{}</p>\n", xmlText(paragraph->text));
        else if (const auto* table = std::get_if<PageTable>(&part))
            text += htmlTable(*table);
        else if (const auto* picture = std::get_if<PagePicture>(&part))
            text += fmt::format("<figure role=\"img\" aria-label=\"{}\">\n{}\n</figure>\n",
                                xmlText(picture->description), withoutProlog(picture->svg));
    }
    return text + "</main>\n</body>\n</html>\n";
}

std::string markdownOf(const Page& page)
{
    std::string text;
    for (const PagePart& part : page.parts)
    {
        if (!text.empty())
            text += "\n";
        if (const auto* heading = std::get_if<PageHeading>(&part))
            text += std::string(static_cast<std::size_t>(heading->level), '#') + " " + heading->text + "\n";
        else if (const auto* paragraph = std::get_if<PageParagraph>(&part))
            text += paragraph->text + "\n";
        else if (const auto* table = std::get_if<PageTable>(&part))
            text += markdownTable(*table);
        else if (const auto* picture = std::get_if<PagePicture>(&part))
            text += fmt::format("![{}]({})\n", picture->description, picture->file);
    }
    return text;
}

} // namespace pacini::cli
