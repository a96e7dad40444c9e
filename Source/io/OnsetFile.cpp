#include "io/OnsetFile.h"

#include "io/CueSheet.h"
#include "io/InputFile.h"
#include "io/JsonText.h"
#include "io/TextMark.h"
#include "io/Utf8.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t largestFile = std::size_t(64) << 20;

/// Takes one list of numbers, or an object of such lists.
class OnsetHandler final : public JsonHandler
{
public:
    Onsets onsets;

    bool openObject() override
    {
        if (onsets.namesFiles || times != nullptr)
            return refuse();
        onsets.namesFiles = true;
        return true;
    }
    bool openList() override
    {
        if (times != nullptr)
            return refuse();
        times = onsets.namesFiles ? &onsets.byFile[name] : &onsets.ofAny;
        return true;
    }
    bool close() override
    {
        times = nullptr;
        return true;
    }
    bool key(std::string_view file) override
    {
        name = file;
        if (onsets.byFile.contains(name))
            return stop(ErrorCode::invalidData, "is given twice");
        return true;
    }
    bool number(double value) override
    {
        if (times == nullptr)
            return refuse();
        if (value < 0.0)
            return stop(ErrorCode::invalidData, fmt::format("is {}; times are 0 or more, in seconds", value));
        times->push_back(value);
        return true;
    }
    bool text(std::string&) override { return refuse(); }
    bool truth(bool) override { return refuse(); }
    bool null() override { return refuse(); }

private:
    bool refuse()
    {
        return stop(ErrorCode::invalidData, times != nullptr
                                                ? "must be a time in seconds"
                                                : "must be a list of times in seconds, such as [0.12, 0.8]");
    }

    std::string name;
    std::vector<double>* times = nullptr; // of the list that is open
};

/// The first field of a line of times. A comma in it stands for the decimal point where digits are on both sides and
/// fields end otherwise: in lines with tabs or semicolons, and in files whose times have no points.
std::string firstField(std::string_view line, bool timesHavePoints)
{
    const auto isNumber = [](std::string_view part)
    {
        return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
    };
    std::string field(line.substr(0, line.find_first_of(" \t\r;")));
    const auto comma = field.find(',');
    std::string_view whole = std::string_view(field).substr(0, comma);
    whole.remove_prefix(whole.starts_with('+') || whole.starts_with('-') ? 1 : 0);
    if (comma == std::string::npos)
        return field;
    const std::string_view rest = std::string_view(field).substr(comma + 1);
    const bool otherEnds = line.find_first_of("\t;") != std::string_view::npos;
    if (!isNumber(whole) || !isNumber(rest.substr(0, rest.find(','))) || (timesHavePoints && !otherEnds))
        field.resize(comma);
    else if (isNumber(rest))
        field[comma] = '.';
    return field; // `0,5,1,25` may be two times or four, and is no number
}

bool hasPoint(std::string_view line)
{
    return line.substr(0, line.find_first_of(" \t\r,;")).find('.') != std::string_view::npos;
}

/// A line of times.
struct TimeLine
{
    double time = 0.0;
    std::string_view rest;     ///< what follows it
    std::optional<double> end; ///< where that begins with another time, behind which `rest` goes on
};

/// Hands visit(line) each line of times, which is valid until the next.
template <typename Visit>
Result<void> forEachLine(std::string_view text, Visit visit)
{
    std::vector<std::string> lines;
    std::istringstream stream{std::string(text)};
    bool timesHavePoints = false;
    for (std::string line; std::getline(stream, line);)
    {
        line.erase(0, line.find_first_not_of(" \t\r"));
        // A line that begins with a backslash holds the frequencies of Audacity's label before it.
        if (line.starts_with('#') || line.starts_with('\\'))
            line.clear();
        timesHavePoints = timesHavePoints || hasPoint(line);
        lines.push_back(std::move(line));
    }
    const auto timeAt = [&](std::string_view line)
    {
        const std::string field = firstField(line, timesHavePoints);
        const auto time = parseNumber(std::string_view(field).substr(field.starts_with('+') ? 1 : 0));
        return std::pair(time && std::isfinite(*time) && *time >= 0.0 ? time : std::nullopt, field);
    };
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
        if (lines[i].empty())
            continue;
        const auto [time, field] = timeAt(lines[i]);
        if (!time)
            return Error{ErrorCode::invalidData, fmt::format("line {}", i + 1),
                         fmt::format("\"{}\" is not a time in seconds, 0 or more", shownText(field))};
        const auto behind = [](std::string_view line, std::size_t bytes)
        {
            line.remove_prefix(std::min(bytes, line.size()));
            line.remove_prefix(std::min(line.find_first_not_of(" \t\r,;"), line.size()));
            return line;
        };
        TimeLine line{*time, behind(lines[i], field.size()), std::nullopt};
        const auto [end, endField] = timeAt(line.rest);
        if (end && *end >= *time)
        {
            line.end = end;
            line.rest = behind(line.rest, endField.size());
        }
        visit(line);
    }
    return {};
}

Result<Onsets> readLines(std::string_view text)
{
    Onsets onsets;
    if (const auto read = forEachLine(text, [&](const TimeLine& line) { onsets.ofAny.push_back(line.time); }); !read)
        return read.error();
    return onsets;
}
} // namespace

const std::vector<double>* Onsets::find(const std::filesystem::path& sound) const
{
    if (!namesFiles)
        return &ofAny;
    for (const auto& name : {sound.filename(), sound.stem()})
        if (const auto found = byFile.find(name.string()); found != byFile.end())
            return &found->second;
    return nullptr;
}

Result<Onsets> readOnsetText(std::string_view text)
{
    const auto unmarked = utf8Text(text);
    if (!unmarked)
        return unmarked.error();
    text = *unmarked;
    const auto first = text.find_first_not_of(" \t\r\n");
    const bool isJson = first != std::string_view::npos && (text[first] == '{' || text[first] == '[');
    Onsets onsets;
    if (isJson)
    {
        OnsetHandler handler;
        if (auto parsed = parseJson(text, handler, largestFile); !parsed)
            return parsed.error();
        onsets = std::move(handler.onsets);
    }
    else
    {
        auto read = readLines(text);
        if (!read)
            return read.error();
        onsets = std::move(*read);
    }
    std::sort(onsets.ofAny.begin(), onsets.ofAny.end());
    for (auto& [file, times] : onsets.byFile)
        std::sort(times.begin(), times.end());
    return onsets;
}

Result<FoundMarkers> readLabelText(std::string_view text)
{
    const auto unmarked = utf8Text(text);
    if (!unmarked)
        return unmarked.error();
    if (isCueSheet(*unmarked))
        return readCueSheet(*unmarked);
    FoundMarkers found;
    std::size_t regions = 0;
    const auto read =
        forEachLine(*unmarked,
                    [&](const TimeLine& line)
                    {
                        auto name = line.rest;
                        name = name.substr(0, name.find_last_not_of(" \t\r") + 1);
                        found.markers.push_back({line.time, name.empty() ? std::to_string(found.markers.size() + 1)
                                                                         : wellFormedUtf8(name)});
                        regions += line.end.value_or(line.time) > line.time ? 1u : 0u;
                    });
    if (!read)
        return read.error();
    if (regions > 0)
        found.warnings.push_back(fmt::format(
            "has labels of regions ({}), whose starts are read as markers, but not how long they last", regions));
    std::stable_sort(found.markers.begin(), found.markers.end(),
                     [](const Marker& a, const Marker& b) { return a.time < b.time; });
    return found;
}

Result<FoundMarkers> readLabels(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestFile);
    return text ? readLabelText(*text) : text.error();
}

Result<Onsets> readOnsets(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestFile);
    return text ? readOnsetText(*text) : text.error();
}

} // namespace pacini
