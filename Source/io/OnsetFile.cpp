#include "io/OnsetFile.h"

#include "io/CueSheet.h"
#include "io/InputFile.h"
#include "io/JsonText.h"
#include "io/TextMark.h"
#include "io/TimeLines.h"

#include <fmt/format.h>

#include <algorithm>
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

Result<Onsets> readLines(std::string_view text)
{
    Onsets onsets;
    if (const auto read = forEachTimeLine(text, [&](const TimeLine& line) { onsets.ofAny.push_back(line.time); });
        !read)
        return read.error();
    if (onsets.ofAny.empty())
        return Error{ErrorCode::invalidData, "",
                     "has no times; write one in seconds on each line, or [] for a sound without onsets"};
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
    const auto read = forEachTimeLine(
        *unmarked,
        [&](const TimeLine& line)
        {
            found.markers.push_back(
                {line.time, line.label.empty() ? std::to_string(found.markers.size() + 1) : utf8OfEither(line.label)});
            regions += line.end.value_or(line.time) > line.time ? 1u : 0u;
        });
    if (!read)
        return read.error();
    if (found.markers.empty())
        found.warnings.emplace_back("has no labels, so it adds no markers");
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
