#include "cli/study/Page.h"

#include "io/Sha256.h"
#include "io/TableText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

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

/// Text has the width of a book's column, tables and figures that of the window. What is wider scrolls in its own box,
/// with a shadow where it goes on and its first column in sight; on paper everything fits instead.
constexpr std::string_view style = R"(
:root { color-scheme: light dark; --ground: #fff; --text: #1b2026; --dim: #5b6570; --line: #d9dde1; --shade: #0003;
  --accent: #0c7f69; }
@media (prefers-color-scheme: dark) { :root { --ground: #16191d; --text: #e6e9ec; --dim: #97a1ac; --line: #333b44;
  --shade: #000c; --accent: #3fc1a6; } }
* { box-sizing: border-box; }
body { font: 1rem/1.55 system-ui, sans-serif; color: var(--text); background: var(--ground); margin: 0; }
main { max-width: 72rem; margin: 0 auto; padding: clamp(1.5rem, 5vw, 4rem) clamp(1rem, 4vw, 3rem); }
h1, h2, h3 { line-height: 1.2; max-width: 44rem; text-wrap: balance; }
h1 { font-size: clamp(1.75rem, 4vw, 2.25rem); margin: 0 0 1rem; }
h2 { font-size: 1.375rem; margin: 3rem 0 .75rem; padding-top: 1.5rem; border-top: 1px solid var(--line);
  max-width: none; }
h3 { font-size: 1.0625rem; margin: 2rem 0 .5rem; }
p { max-width: 44rem; margin: 0 0 1rem; }
nav { margin: 1.5rem 0 0; display: flex; flex-wrap: wrap; gap: .5rem 1.5rem; font-size: .875rem; }
a { color: var(--accent); text-underline-offset: .2em; }
.scrolls { overflow-x: auto; margin: 1.5rem 0; background: linear-gradient(to right, var(--ground) 2rem, transparent) left,
  linear-gradient(to left, var(--ground) 2rem, transparent) right, linear-gradient(to right, var(--shade), transparent) left,
  linear-gradient(to left, var(--shade), transparent) right; background-size: 4rem 100%, 4rem 100%, .5rem 100%, .5rem 100%;
  background-repeat: no-repeat; background-attachment: local, local, scroll, scroll; }
.scrolls:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
table { width: max-content; border-collapse: collapse; font-size: .875rem; line-height: 1.4; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding: 0 0 .5rem; color: var(--dim); }
caption span { display: block; position: sticky; left: 0; width: max-content;
  max-width: min(44rem, 100vw - 2 * clamp(1rem, 4vw, 3rem)); }
th, td { padding: .375rem .75rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap;
  vertical-align: baseline; font-weight: normal; }
thead th { color: var(--dim); border-bottom-color: var(--dim); vertical-align: bottom; }
th:first-child { text-align: left; padding-left: 0; }
th:last-child, td:last-child { padding-right: 0; }
tbody th { font-weight: 600; }
tbody th.again { font-size: 0; }
.words { text-align: left; white-space: normal; max-width: 26rem; }
figure { margin: 1.5rem 0; overflow-x: auto; background: #fff; border: 1px solid var(--line); border-radius: 6px; }
figure svg { width: 100%; min-width: 38rem; height: auto; display: block; }
@media (prefers-color-scheme: dark) { figure { filter: invert(.91) hue-rotate(180deg); border-color: #ccc; } }
@media (max-width: 60rem) { th:first-child { white-space: normal; max-width: 16rem; } }
@media (max-width: 40rem) { th:first-child { white-space: normal; max-width: 9rem; } .words { max-width: 16rem; } }
@media print {
  @page { margin: 16mm; }
  :root { color-scheme: light; --ground: #fff; --text: #000; --dim: #444; --line: #bbb; --accent: #000;
    font-size: 10pt; }
  main { max-width: none; padding: 0; }
  nav { display: none; }
  h1, h2, h3, caption { break-after: avoid; }
  figure, tr { break-inside: avoid; }
  figure { filter: none; border: 0; overflow: visible; }
  figure svg { min-width: 0; }
  .scrolls { overflow: visible; background: none; }
  table { width: auto; font-size: 7.5pt; }
  th, td { padding: 2pt 4pt; white-space: normal; }
  .words { max-width: none; }
}
)";

/// The SVG without what only a file of its own needs.
std::string_view withoutProlog(std::string_view svg)
{
    const std::size_t start = svg.find("<svg");
    return start == std::string_view::npos ? svg : svg.substr(start);
}

/// Whether a cell is a number, an interval or nothing: it is aligned at the right.
bool isNumeric(std::string_view cell)
{
    constexpr std::string_view starts = "0123456789+-.<>=";
    return cell.empty() || starts.find(cell.front()) != std::string_view::npos;
}

/// Whether each column has words, which are read from the left and have several lines.
std::vector<bool> columnsOfWords(const PageTable& table)
{
    std::vector<bool> words(table.columns.size(), false);
    for (const auto& row : table.rows)
        for (std::size_t i = 0; i < std::min(row.size(), words.size()); ++i)
            words[i] = words[i] || !isNumeric(row[i]);
    return words;
}

std::string htmlTable(const PageTable& table)
{
    const std::vector<bool> words = columnsOfWords(table);
    std::string text = "<div class=\"scrolls\" tabindex=\"0\"><table>\n";
    if (!table.caption.empty())
        text += fmt::format("<caption><span>{}</span></caption>\n", xmlText(table.caption));
    text += "<thead><tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        text += fmt::format("<th scope=\"col\"{}>{}</th>", i > 0 && words[i] ? " class=\"words\"" : "",
                            xmlText(table.columns[i]));
    text += "</tr></thead>\n<tbody>\n";
    std::string_view before; // the first cell of the row above
    for (const auto& row : table.rows)
    {
        text += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            text += i == 0 ? fmt::format("<th scope=\"row\"{}>{}</th>", row[i] == before ? " class=\"again\"" : "",
                                         xmlText(row[i]))
                           : fmt::format("<td{}>{}</td>", i < words.size() && words[i] ? " class=\"words\"" : "",
                                         xmlText(row[i]));
        text += "</tr>\n";
        before = row.empty() ? std::string_view() : std::string_view(row.front());
    }
    return text + "</tbody>\n</table></div>\n";
}

/// Links to the sections of a long page; nothing for a short one.
std::string htmlContents(const Page& page)
{
    constexpr int least = 4;
    std::string links;
    int sections = 0;
    for (const PagePart& part : page.parts)
        if (const auto* heading = std::get_if<PageHeading>(&part); heading != nullptr && heading->level == 2)
        {
            ++sections;
            links += fmt::format("<a href=\"#section-{}\">{}</a>\n", sections, xmlText(heading->text));
        }
    return sections < least ? std::string()
                            : fmt::format("<nav aria-label=\"{}\">\n{}</nav>\n", xmlText(page.title), links);
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
    int sections = 0;
    for (const PagePart& part : page.parts)
    {
        if (const auto* heading = std::get_if<PageHeading>(&part); heading != nullptr && heading->level == 2)
        {
            if (sections++ == 0) // behind the title and what stands below it
                text += htmlContents(page);
            text += fmt::format("<h2 id=\"section-{}\">{}</h2>\n", sections, xmlText(heading->text));
        }
        else if (heading != nullptr)
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
