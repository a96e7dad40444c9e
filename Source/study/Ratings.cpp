#include "study/Ratings.h"

#include "io/InputFile.h"
#include "io/TableText.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

namespace pacini::study
{

namespace
{
/// Lines of fields. A field in quotes may contain separators.
class CsvLines
{
public:
    CsvLines(std::string_view wholeText, char fieldEnd) : text(wholeText), separator(fieldEnd) {}

    /// The next line; nothing at the end.
    std::optional<std::vector<std::string>> next()
    {
        if (at >= text.size())
            return std::nullopt;
        line = nextLine;
        std::vector<std::string> fields(1);
        bool quoted = false;
        for (; at < text.size(); ++at)
        {
            const char c = text[at];
            if (c == '\n')
                ++nextLine;
            if (quoted && c == '"' && at + 1 < text.size() && text[at + 1] == '"')
                fields.back() += text[at++];
            else if (c == '"' && (quoted || fields.back().empty()))
                quoted = !quoted;
            else if (!quoted && c == separator)
                fields.emplace_back();
            else if (!quoted && c == '\n')
                break;
            else if (quoted || c != '\r')
                fields.back() += c;
        }
        ++at;
        return fields;
    }

    [[nodiscard]] std::string place() const { return fmt::format("line {}", line); }

private:
    std::string_view text;
    char separator;
    std::size_t at = 0;
    std::size_t line = 1;
    std::size_t nextLine = 1;
};

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t largestTable = 64'000'000; // bytes
} // namespace

Result<std::vector<Rating>> ratingsOfCsv(std::string_view text)
{
    if (text.starts_with(byteOrderMark))
        text.remove_prefix(byteOrderMark.size());
    const std::string_view first = text.substr(0, text.find('\n'));
    CsvLines lines(text, first.find(';') != std::string_view::npos ? ';' : ',');
    const auto names = lines.next();
    const auto column = [&](std::string_view wanted) -> std::optional<std::size_t>
    {
        for (std::size_t i = 0; names && i < names->size(); ++i)
        {
            std::string name = (*names)[i];
            std::transform(name.begin(), name.end(), name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            if (name == wanted)
                return i;
        }
        return std::nullopt;
    };
    const auto group = column("group"), participant = column("participant"), block = column("block"),
               stimulus = column("stimulus"), rating = column("rating");
    for (const auto& [name, found] : {std::pair("stimulus", stimulus), std::pair("rating", rating)})
        if (!found)
            return Error{ErrorCode::invalidData, "line 1",
                         fmt::format("has no column '{}'; a table of ratings has stimulus and rating, and where there "
                                     "are any group, participant and block",
                                     name)};
    std::vector<Rating> ratings;
    while (const auto fields = lines.next())
    {
        if (fields->size() == 1 && fields->front().empty())
            continue;
        const auto field = [&](const std::optional<std::size_t>& i)
        {
            return i && *i < fields->size() ? (*fields)[*i] : std::string();
        };
        const std::string number = field(rating);
        const auto value = parseNumber(number);
        if (!value || !std::isfinite(*value))
            return Error{ErrorCode::invalidData, lines.place(), fmt::format("'{}' is not a rating", number)};
        if (ratings.size() == mostRatings)
            return Error{ErrorCode::tooLarge, lines.place(), fmt::format("has more than {} ratings", mostRatings)};
        ratings.push_back({field(group), field(participant), field(block), field(stimulus), *value});
    }
    if (ratings.empty())
        return Error{ErrorCode::invalidData, "", "has no rating"};
    return ratings;
}

Result<std::vector<Rating>> readRatings(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestTable);
    if (!text)
        return text.error();
    return ratingsOfCsv(*text);
}

std::string ratingsCsv(const std::vector<Rating>& ratings)
{
    std::string text = "group,participant,block,stimulus,rating\n";
    for (const Rating& one : ratings)
        text += fmt::format("{},{},{},{},{}\n", csvField(one.group), csvField(one.participant), csvField(one.block),
                            csvField(one.stimulus), one.value);
    return text;
}

} // namespace pacini::study
