#include "io/CommentChapters.h"

#include "io/CueSheet.h"
#include "io/JsonText.h"
#include "io/TextMark.h"
#include "io/Utf8.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace pacini
{

namespace
{
/// Takes comments off a list of them.
struct CommentList
{
    std::string_view rest;
    bool isCut = false;

    /// The number of 32 bits that comes next.
    std::uint32_t number()
    {
        isCut = isCut || rest.size() < 4;
        if (isCut)
            return 0;
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;)
            value = value << 8u | static_cast<unsigned char>(rest[i]);
        rest.remove_prefix(4);
        return value;
    }

    /// The text that comes next, behind its length.
    std::string_view text()
    {
        const auto bytes = number();
        isCut = isCut || bytes > rest.size();
        if (isCut)
            return {};
        const auto found = rest.substr(0, bytes);
        rest.remove_prefix(bytes);
        return found;
    }
};

struct CommentChapter
{
    std::optional<std::string_view> time;
    std::string_view name;
};

/// Seconds of `1:02:03.5`, `02:03.5` or `3.5`.
std::optional<double> chapterTimeOf(std::string_view text)
{
    double seconds = 0.0;
    for (int parts = 0; parts < 3; ++parts)
    {
        const auto colon = std::min(text.find(':'), text.size());
        std::string digits(text.substr(0, colon));
        std::replace(digits.begin(), digits.end(), ',', '.');
        const bool isPlain = !digits.empty() && digits.find_first_not_of("0123456789.") == std::string::npos;
        const auto value = isPlain ? parseNumber(digits) : std::nullopt;
        if (!value || !std::isfinite(*value))
            return {};
        seconds = seconds * 60.0 + *value;
        if (colon == text.size())
            return seconds;
        text.remove_prefix(colon + 1);
    }
    return {};
}

/// The name of a comment, in capitals.
std::string keyOf(std::string_view comment)
{
    std::string key(comment.substr(0, comment.find('=')));
    std::transform(key.begin(), key.end(), key.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
    return key;
}

/// Takes one comment among `chapters`, by their numbers, if it is of one.
void takeChapter(std::string_view comment, std::map<std::string, CommentChapter, std::less<>>& chapters)
{
    constexpr std::string_view prefix = "CHAPTER", suffix = "NAME";
    const auto equals = comment.find('=');
    if (equals == std::string_view::npos)
        return;
    std::string key = keyOf(comment);
    if (!key.starts_with(prefix))
        return;
    key.erase(0, prefix.size());
    const bool isName = key.ends_with(suffix);
    if (isName)
        key.resize(key.size() - suffix.size());
    if (key.empty() || key.size() > 9 || key.find_first_not_of("0123456789") != std::string::npos)
        return;
    // Numbers in order of their value.
    key.insert(0, 9 - key.size(), '0');
    CommentChapter& chapter = chapters[key];
    const auto value = comment.substr(equals + 1);
    if (isName)
        chapter.name = value;
    else
        chapter.time = value;
}
} // namespace

FoundMarkers commentChapters(std::string_view comments)
{
    CommentList list{comments};
    list.text(); // the vendor
    const auto count = list.number();
    std::map<std::string, CommentChapter, std::less<>> chapters;
    FoundMarkers found;
    for (std::uint32_t i = 0; i < count && !list.isCut; ++i)
    {
        const auto comment = list.text();
        takeChapter(comment, chapters);
        if (keyOf(comment) != "CUESHEET" || !isCueSheet(comment.substr(comment.find('=') + 1)))
            continue;
        if (auto sheet = readCueSheet(comment.substr(comment.find('=') + 1)))
            appendFound(found, std::move(*sheet));
        else
            found.warnings.push_back(fmt::format("has a cue sheet whose {} {}; its tracks are left out",
                                                 sheet.error().where, sheet.error().message));
    }
    if (list.isCut)
        found.warnings.emplace_back("has comments that are cut off; chapters among what is missing are left out");
    std::size_t broken = 0;
    std::string example;
    for (const auto& [number, chapter] : chapters)
    {
        if (const auto time = chapterTimeOf(chapter.time.value_or("")))
        {
            const auto digits = number.substr(std::min(number.find_first_not_of('0'), number.size() - 1));
            found.markers.push_back({*time, utf8OfEither(chapter.name.empty() ? digits : chapter.name)});
            continue;
        }
        if (broken++ == 0)
            example = chapter.time
                          ? fmt::format("the time \"{}\"", shownText(wellFormedUtf8(chapter.time->substr(0, 200))))
                          : "no time";
    }
    if (broken == 1)
        found.warnings.push_back(fmt::format("has a chapter with {}, which is left out", example));
    else if (broken > 1)
        found.warnings.push_back(fmt::format(
            "has {} chapters without a time that can be read, which are left out; the first has {}", broken, example));
    return found;
}

} // namespace pacini
