#include "io/OnsetFile.h"

#include "io/InputFile.h"
#include "io/JsonText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <locale>
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

Result<Onsets> readLines(std::string_view text)
{
    Onsets onsets;
    std::istringstream lines{std::string(text)};
    std::string line;
    for (std::size_t count = 1; std::getline(lines, line); ++count)
    {
        const auto begin = line.find_first_not_of(" \t\r");
        if (begin == std::string::npos || line[begin] == '#')
            continue;
        const auto end = line.find_first_of(" \t\r,;", begin);
        std::istringstream field(line.substr(begin, end == std::string::npos ? end : end - begin));
        field.imbue(std::locale::classic());
        double time = 0.0;
        if (!(field >> time) || field.peek() != std::istringstream::traits_type::eof() || !std::isfinite(time) ||
            time < 0.0)
            return Error{ErrorCode::invalidData, fmt::format("line {}", count),
                         fmt::format("\"{}\" is not a time in seconds, 0 or more", shownText(field.str()))};
        onsets.ofAny.push_back(time);
    }
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
    if (text.starts_with("\xEF\xBB\xBF"))
        text.remove_prefix(3);
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

Result<Onsets> readOnsets(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestFile);
    if (!text)
        return text.error();
    return readOnsetText(*text);
}

} // namespace pacini
