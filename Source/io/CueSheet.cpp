#include "io/CueSheet.h"

#include "io/TextLines.h"
#include "io/TextMark.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace pacini
{

namespace
{
/// Takes the first word off `line`; a text in quotes is one.
std::string_view wordOf(std::string_view& line)
{
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const bool isQuoted = line.starts_with('"');
    line.remove_prefix(isQuoted ? 1 : 0);
    const auto end = std::min(isQuoted ? line.find('"') : line.find_first_of(" \t\r"), line.size());
    const auto word = line.substr(0, end);
    line.remove_prefix(std::min(line.size(), end + (isQuoted ? 1 : 0)));
    return word;
}

bool isWord(std::string_view given, std::string_view known)
{
    return std::equal(given.begin(), given.end(), known.begin(), known.end(),
                      [](char a, char b) { return (a >= 'a' && a <= 'z' ? a - 32 : a) == b; });
}

/// s of `12:34:56`, minutes, seconds and frames.
std::optional<double> cueTimeOf(std::string_view text)
{
    constexpr double framesPerSecond = 75.0;
    double parts[3] = {};
    for (int i = 0; i < 3; ++i)
    {
        const auto colon = std::min(text.find(':'), text.size());
        const auto digits = text.substr(0, colon);
        const bool isWhole =
            !digits.empty() && digits.size() <= 6 && digits.find_first_not_of("0123456789") == std::string_view::npos;
        if (!isWhole || (i < 2) != (colon < text.size()))
            return {};
        parts[i] = parseNumber(digits).value_or(0.0);
        text.remove_prefix(std::min(text.size(), colon + 1));
    }
    return parts[0] * 60.0 + parts[1] + parts[2] / framesPerSecond;
}

/// Calls visit(number from 1, line) until it says false.
template <typename Visit>
void forEachCueLine(std::string_view text, Visit visit)
{
    for (std::size_t number = 1; !text.empty(); ++number)
        if (!visit(number, takeLine(text)))
            return;
}
} // namespace

bool isCueSheet(std::string_view text)
{
    bool hasFile = false, hasIndex = false;
    forEachCueLine(text,
                   [&](std::size_t, std::string_view line)
                   {
                       const auto word = wordOf(line);
                       hasFile = hasFile || isWord(word, "FILE");
                       hasIndex = hasFile && isWord(word, "INDEX");
                       return !hasIndex;
                   });
    return hasIndex;
}

Result<FoundMarkers> readCueSheet(std::string_view text)
{
    FoundMarkers found;
    std::optional<Error> wrong;
    std::size_t files = 0, others = 0;
    std::string track, title;
    forEachCueLine(text,
                   [&](std::size_t number, std::string_view line)
                   {
                       const auto word = wordOf(line);
                       if (isWord(word, "FILE"))
                           ++files;
                       else if (isWord(word, "TRACK"))
                       {
                           track = wordOf(line);
                           title.clear();
                       }
                       else if (isWord(word, "TITLE") && !track.empty())
                           title = utf8OfEither(wordOf(line));
                       if (!isWord(word, "INDEX"))
                           return true;
                       const auto index = parseNumber(wordOf(line)).value_or(0.0);
                       const auto time = cueTimeOf(wordOf(line));
                       if (!time)
                           wrong = {ErrorCode::invalidData, fmt::format("line {}", number),
                                    "has a time that is not minutes:seconds:frames, such as 03:25:74"};
                       else if (files > 1)
                           ++others;
                       else if (index >= 1.0)
                       {
                           auto name = title.empty() ? utf8OfEither(track) : title;
                           if (index >= 2.0)
                               name += fmt::format(" {}", index);
                           found.markers.push_back({*time, std::move(name)});
                       }
                       return !wrong;
                   });
    if (wrong)
        return *wrong;
    if (others > 0)
        found.warnings.push_back(fmt::format(
            "names {} sounds; the markers of the first are read, {} of others are left out", files, others));
    std::stable_sort(found.markers.begin(), found.markers.end(),
                     [](const Marker& a, const Marker& b) { return a.time < b.time; });
    return found;
}

} // namespace pacini
