#include "study/Ratings.h"

#include "io/InputFile.h"
#include "io/JsonText.h"
#include "io/TableText.h"
#include "io/TextLines.h"
#include "io/TextMark.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace pacini::study
{

namespace
{
std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

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
            const bool isEnd = c == '\n' || (c == '\r' && (at + 1 == text.size() || text[at + 1] != '\n'));
            if (isEnd)
                ++nextLine;
            if (quoted && c == '"' && at + 1 < text.size() && text[at + 1] == '"')
                fields.back() += text[at++];
            else if (c == '"' && quoted)
                quoted = false;
            else if (c == '"' && trimmed(fields.back()).empty())
            {
                fields.back().clear();
                quoted = true;
            }
            else if (!quoted && c == separator)
                fields.emplace_back();
            else if (!quoted && isEnd)
                break;
            else if (quoted || c != '\r')
                fields.back() += c;
        }
        ++at;
        open = quoted;
        return fields;
    }

    /// Whether the last line ends within quotes, which hold all of the text from there.
    [[nodiscard]] bool endsInQuotes() const noexcept { return open; }

    [[nodiscard]] std::string place() const { return fmt::format("line {}", line); }

private:
    std::string_view text;
    char separator;
    std::size_t at = 0;
    std::size_t line = 1;
    std::size_t nextLine = 1;
    bool open = false;
};

constexpr std::size_t largestTable = 64'000'000; // bytes

std::string inSmallLetters(std::string_view text)
{
    std::string small(trimmed(text));
    std::transform(small.begin(), small.end(), small.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

/// What a column holds, and how it is called: by the first line of names of which the table has one.
struct Role
{
    std::string_view name;
    std::string RatingColumns::*given;
    std::vector<std::vector<std::string_view>> titles; ///< Pacini's own, then those of webMUSHRA, jsPsych and others
};

const std::vector<Role>& roles()
{
    static const std::vector<Role> all{
        {"group", &RatingColumns::group, {{"group"}}},
        {"participant",
         &RatingColumns::participant,
         {{"participant"},
          {"participant_id", "participantid", "subject", "subject_id", "subjectid", "prolific_pid"},
          {"session_uuid"},
          {"email"},
          {"name"}}},
        {"block", &RatingColumns::block, {{"block"}, {"trial_id"}}},
        {"stimulus", &RatingColumns::stimulus, {{"stimulus"}, {"rating_stimulus"}}},
        {"rating", &RatingColumns::rating, {{"rating"}, {"rating_score"}, {"response", "score"}}}};
    return all;
}

/// The columns with one of these names.
std::vector<std::size_t> columnsNamed(const std::vector<std::string>& heading,
                                      const std::vector<std::string_view>& titles)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < heading.size(); ++i)
        if (std::find(titles.begin(), titles.end(), inSmallLetters(heading[i])) != titles.end())
            found.push_back(i);
    return found;
}

/// The column of a role, if there is one. Errors: several that could be it, or none that is called as it was said.
Result<std::optional<std::size_t>> columnOf(const Role& role, const std::vector<std::string>& heading,
                                            const RatingColumns& columns)
{
    auto titles = role.titles;
    const std::string given = inSmallLetters(columns.*(role.given));
    if (!given.empty())
        titles = {{given}};
    for (const auto& names : titles)
    {
        const auto found = columnsNamed(heading, names);
        if (found.size() > 1)
            return Error{ErrorCode::invalidData, "line 1",
                         fmt::format("has the columns '{}' and '{}', which may both be the {}; name it with --columns "
                                     "{}=NAME",
                                     shownText(heading[found[0]]), shownText(heading[found[1]]), role.name, role.name)};
        if (found.size() == 1)
            return std::optional(found[0]);
    }
    if (!given.empty())
        return Error{ErrorCode::invalidData, "line 1", fmt::format("has no column '{}'", shownText(given))};
    return std::optional<std::size_t>();
}

/// What programs write for no answer.
bool isMissing(std::string_view field)
{
    const std::string small = inSmallLetters(field);
    constexpr std::array<std::string_view, 7> nothing{"", "na", "n/a", "nan", "null", "none", "-"};
    return std::find(nothing.begin(), nothing.end(), small) != nothing.end();
}

/// A finite number; a comma may stand for its point.
std::optional<double> ratingIn(std::string_view field)
{
    std::string text(trimmed(field));
    const auto comma = text.find(',');
    if (comma != std::string::npos && text.find('.') == std::string::npos)
        text[comma] = '.';
    const auto value = parseNumber(std::string_view(text).substr(text.starts_with('+') ? 1 : 0));
    return value && std::isfinite(*value) ? value : std::nullopt;
}

char separatorOf(std::string_view heading)
{
    for (const char separator : {'\t', ';'})
        if (heading.find(separator) != std::string_view::npos)
            return separator;
    return ',';
}

/// The places of the roles in a heading, in the order of roles(). Errors also: no stimulus or no rating.
Result<std::vector<std::optional<std::size_t>>> placesIn(const std::vector<std::string>& heading,
                                                         const RatingColumns& columns)
{
    std::vector<std::optional<std::size_t>> places;
    for (const Role& role : roles())
    {
        const auto place = columnOf(role, heading, columns);
        if (!place)
            return place.error();
        if (!*place && (role.name == "stimulus" || role.name == "rating"))
            return Error{ErrorCode::invalidData, "line 1",
                         fmt::format("has no column '{}'; a table of ratings has stimulus and rating, and where there "
                                     "are any group, participant and block; name others with --columns {}=NAME",
                                     role.name, role.name)};
        places.push_back(*place);
    }
    return places;
}

/// Lines of a table that do not count for one reason: the first, and how many.
class LinesLeftOut
{
public:
    LinesLeftOut(std::string whyOne, std::string whyAll) : one(std::move(whyOne)), several(std::move(whyAll)) {}

    void add(const std::string& place)
    {
        if (number++ == 0)
            first = place;
    }

    void tell(std::size_t lines, std::vector<std::string>& said) const
    {
        if (number > 0)
            said.push_back(
                fmt::format("{}: {}; {} of {} lines {} and are left out", first, one, number, lines, several));
    }

    [[nodiscard]] std::size_t count() const noexcept { return number; }
    [[nodiscard]] const std::string& place() const noexcept { return first; }

private:
    std::string one, several, first;
    std::size_t number = 0;
};

/// Leaves out ratings without a participant (or group) where others have one: together they would be one person (or a
/// further group).
void leaveOutUnnamed(std::vector<Rating>& ratings, std::vector<std::string>& places, std::string Rating::*name,
                     std::string_view what, std::size_t lines, std::vector<std::string>& said)
{
    const auto isUnnamed = [&](const Rating& one)
    {
        return (one.*name).empty();
    };
    if (std::all_of(ratings.begin(), ratings.end(), isUnnamed))
        return;
    LinesLeftOut unnamed(fmt::format("has no {}", what), "have none");
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ratings.size(); ++i)
        if (isUnnamed(ratings[i]))
            unnamed.add(places[i]);
        else if (kept++ != i)
        {
            ratings[kept - 1] = std::move(ratings[i]);
            places[kept - 1] = std::move(places[i]);
        }
    ratings.resize(kept);
    places.resize(kept);
    unnamed.tell(lines, said);
}

constexpr std::string_view typeColumn = "trial_type"; // of jsPsych

/// What a line of jsPsych was; empty where there is no such column.
std::string typeIn(const std::vector<std::string>& fields, const std::vector<std::string>& heading)
{
    const auto column = columnsNamed(heading, {typeColumn});
    return column.empty() || column[0] >= fields.size() ? std::string() : inSmallLetters(fields[column[0]]);
}

/// The types of a jsPsych table's lines that are ratings: its sliders, where it has any. Other lines have a response
/// too, such as the number of a button or a text. None: all lines are.
std::set<std::string> typesOfRatings(CsvLines lines, const std::vector<std::string>& heading, std::size_t rating)
{
    std::set<std::string> types;
    if (inSmallLetters(heading[rating]) != "response" || columnsNamed(heading, {typeColumn}).empty())
        return types;
    while (const auto fields = lines.next())
        if (const std::string type = typeIn(*fields, heading); type.find("slider") != std::string::npos)
            types.insert(type);
    return types;
}

/// Whether a line has more fields than the heading that say something.
bool isTooLong(const std::vector<std::string>& fields, std::size_t columns)
{
    return fields.size() > columns && std::any_of(fields.begin() + static_cast<std::ptrdiff_t>(columns), fields.end(),
                                                  [](const std::string& field) { return !trimmed(field).empty(); });
}
} // namespace

Result<std::vector<Rating>> ratingsOfCsv(std::string_view bytes, const RatingColumns& columns,
                                         std::vector<std::string>* warnings, bool* isWebMushra)
{
    const auto unmarked = utf8Text(bytes);
    if (!unmarked)
        return unmarked.error();
    const bool isOld = !isUtf8(*unmarked);
    const std::string decoded = isOld ? utf8OfWindows1252(*unmarked) : std::string();
    const std::string_view text = isOld ? std::string_view(decoded) : *unmarked;
    if (isOld && warnings != nullptr)
        warnings->emplace_back("is not UTF-8, and was read as Latin-1 (Windows-1252)");
    std::string_view rest = text;
    const std::optional<char> told = takeSeparatorLine(rest);
    CsvLines lines(text, told.value_or(separatorOf(text.substr(0, text.find_first_of("\r\n")))));
    if (told)
        (void)lines.next();
    const auto heading = lines.next().value_or(std::vector<std::string>());
    const auto places = placesIn(heading, columns);
    if (!places)
        return places.error();
    constexpr std::size_t stimulusRole = 3, ratingRole = 4;
    if (isWebMushra != nullptr)
        *isWebMushra = inSmallLetters(heading[*(*places)[stimulusRole]]) == "rating_stimulus";
    const std::set<std::string> ratingTypes = typesOfRatings(lines, heading, *(*places)[ratingRole]);
    std::vector<Rating> ratings;
    LinesLeftOut missing("has no rating", "have none"), withoutStimulus("has no stimulus", "have none"),
        ofOtherTypes("is no rating of jsPsych's sliders by its trial_type", "are none");
    std::vector<std::string> placesOf; // of the ratings
    while (const auto fields = lines.next())
    {
        if (lines.endsInQuotes())
            return Error{ErrorCode::invalidData, lines.place(),
                         "has a quotation mark without a second one; close it, or write two of them for one in a text"};
        if (fields->size() == 1 && trimmed(fields->front()).empty())
            continue;
        if (isTooLong(*fields, heading.size()))
            return Error{ErrorCode::invalidData, lines.place(),
                         fmt::format("has {} fields where the first line has {}; put texts and numbers with a "
                                     "separator in quotes",
                                     fields->size(), heading.size())};
        const auto field = [&](std::size_t role)
        {
            const auto& place = (*places)[role];
            return std::string(place && *place < fields->size() ? trimmed((*fields)[*place]) : std::string_view());
        };
        if (!ratingTypes.empty() && !ratingTypes.contains(typeIn(*fields, heading)))
        {
            ofOtherTypes.add(lines.place());
            continue;
        }
        const std::string number = field(ratingRole);
        if (isMissing(number))
        {
            missing.add(lines.place());
            continue;
        }
        const auto value = ratingIn(number);
        if (!value)
            return Error{ErrorCode::invalidData, lines.place(), fmt::format("'{}' is not a rating", shownText(number))};
        if (ratings.size() == mostRatings)
            return Error{ErrorCode::tooLarge, lines.place(), fmt::format("has more than {} ratings", mostRatings)};
        if (field(stimulusRole).empty())
        {
            withoutStimulus.add(lines.place());
            continue;
        }
        ratings.push_back({field(0), field(1), field(2), field(stimulusRole), *value});
        placesOf.push_back(lines.place());
    }
    if (ratings.empty())
        return Error{ErrorCode::invalidData, missing.place(), "has no rating"};
    const std::size_t others = missing.count() + withoutStimulus.count() + ofOtherTypes.count();
    const std::size_t all = ratings.size() + others;
    std::vector<std::string> said;
    for (const LinesLeftOut* lost : {&ofOtherTypes, &missing, &withoutStimulus})
        lost->tell(all, said);
    leaveOutUnnamed(ratings, placesOf, &Rating::participant, "participant", all, said);
    leaveOutUnnamed(ratings, placesOf, &Rating::group, "group", all, said);
    if (warnings != nullptr)
        warnings->insert(warnings->end(), said.begin(), said.end());
    return ratings;
}

Result<std::vector<Rating>> readRatings(const std::filesystem::path& path, const RatingColumns& columns,
                                        std::vector<std::string>* warnings, bool* isWebMushra)
{
    const auto text = readWholeFile(path, largestTable);
    if (!text)
        return text.error();
    return ratingsOfCsv(*text, columns, warnings, isWebMushra);
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
