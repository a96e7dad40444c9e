#pragma once

// A report as headings, paragraphs, tables and pictures, and its text in HTML and Markdown.

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pacini::cli
{

struct PageHeading
{
    int level = 2; ///< 1: of the page
    std::string text;
};

struct PageParagraph
{
    std::string text;
};

struct PageTable
{
    std::string caption;
    std::vector<std::string> columns; ///< the first holds names, the others numbers
    std::vector<std::vector<std::string>> rows;
};

/// A picture, embedded in the page as SVG and stored as a file.
struct PagePicture
{
    std::string file; ///< its name, beside the page
    std::string description;
    std::string svg;
};

using PagePart = std::variant<PageHeading, PageParagraph, PageTable, PagePicture>;

struct Page
{
    std::string title;
    std::string language = "en";
    std::vector<PagePart> parts;
};

/// One file that needs no other, readable in light and dark, for screen readers and printers.
[[nodiscard]] std::string htmlOf(const Page& page);

/// With pictures as files beside it.
[[nodiscard]] std::string markdownOf(const Page& page);

/// Returns `text` (HTML, Markdown or SVG) with a comment by which isAsWritten() recognises it.
[[nodiscard]] std::string stamped(std::string text);

/// Whether a file was written by Pacini and not changed since.
[[nodiscard]] bool isAsWritten(std::string_view text);

} // namespace pacini::cli
