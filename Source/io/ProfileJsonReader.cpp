#include "io/JsonText.h"
#include "io/JsonTree.h"
#include "io/ProfileFields.h"
#include "io/ProfileJson.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
using Json = nlohmann::json;
using profileFields::Need;

std::size_t mostIn(const EqualizerSections& sections)
{
    return sections.capacity();
}

std::size_t mostIn(const std::vector<MeasuredPoint>&)
{
    return ProfileMeasurement::mostPoints;
}

std::size_t mostIn(const std::vector<LinearityOutlier>&)
{
    return ProfileMeasurement::mostOutliers;
}

void append(EqualizerSections& sections)
{
    sections.pushBack({});
}

template <typename T>
void append(std::vector<T>& values)
{
    values.emplace_back();
}

/// Fills a profile from a tree, entry by entry, and remembers the first thing that is wrong.
class Reader
{
public:
    explicit Reader(const Json& document) : current(&document) {}

    std::optional<Error> error;

    void fail(std::string_view name, std::string message, ErrorCode code = ErrorCode::invalidData)
    {
        if (!error)
            error = Error{code, place(name), std::move(message)};
    }

    void text(const char* name, std::string& value)
    {
        if (const Json* entry = find(name, Need::required))
        {
            if (entry->is_string())
                value = entry->get<std::string>();
            else
                fail(name, "must be a text in quotes");
        }
    }

    void number(const char* name, double& value, Need need)
    {
        if (const Json* entry = find(name, need))
        {
            if (entry->is_number())
                value = entry->get<double>();
            else
                fail(name, "must be a number");
        }
    }

    void optionalNumber(const char* name, std::optional<double>& value)
    {
        if (find(name, Need::optional) != nullptr)
            number(name, value.emplace(), Need::required);
    }

    void integer(const char* name, int& value, const char* rule)
    {
        double read = value;
        number(name, read, Need::optional);
        if (read == std::floor(read) && std::abs(read) <= 1e6)
            value = static_cast<int>(read);
        else
            fail(name, rule);
    }

    template <typename E, typename Choices>
    void choice(const char* name, E& value, const Choices& choices, Need need)
    {
        const Json* entry = find(name, need);
        if (entry == nullptr)
            return;
        std::string known;
        for (const auto& c : choices)
        {
            if (entry->is_string() && entry->get_ref<const std::string&>() == c.name)
            {
                value = c.value;
                return;
            }
            known += fmt::format("{}{}", known.empty() ? "" : &c == &choices.back() ? " or " : ", ", c.name);
        }
        const std::string given =
            entry->is_string() ? fmt::format(", not '{}'", shownText(entry->get_ref<const std::string&>())) : "";
        fail(name, fmt::format("must be {}{}", known, given));
    }

    template <typename T, typename Fields>
    void object(const char* name, T& value, Need need, Fields fields)
    {
        if (const Json* entry = find(name, need))
            enter(name, *entry, [&] { fields(value); });
    }

    template <typename T, typename Fields>
    void optionalObject(const char* name, std::optional<T>& value, Fields fields)
    {
        if (const Json* entry = find(name, Need::optional))
            enter(name, *entry, [&] { fields(value.emplace()); });
    }

    template <typename List, typename Fields>
    void list(const char* name, List& values, const char* elements, Fields fields)
    {
        const Json* entry = find(name, Need::optional);
        if (entry == nullptr)
            return;
        if (!entry->is_array())
            return fail(name, fmt::format("must be a list of {}", elements));
        if (entry->size() > mostIn(values))
            return fail(name, fmt::format("has more than {} {}", mostIn(values), elements), ErrorCode::tooLarge);
        for (std::size_t i = 0; i < entry->size() && !error; ++i)
        {
            append(values);
            enter(fmt::format("{}[{}]", name, i), (*entry)[i], [&] { fields(values[i]); });
        }
    }

    void sources(const char* name, ProfileSources& values)
    {
        const Json* entry = find(name, Need::optional);
        if (entry == nullptr)
            return;
        enter(name, *entry,
              [&]
              {
                  for (const auto& [path, text] : entry->items())
                  {
                      if (!text.is_string())
                          return fail(shownText(path), "must be a text in quotes");
                      if (text.get_ref<const std::string&>().empty())
                          return fail(shownText(path), "must say something");
                      values.push_back({path, text.get<std::string>()});
                  }
              });
    }

private:
    [[nodiscard]] std::string place(std::string_view name) const
    {
        return where.empty() ? std::string(name) : fmt::format("{}.{}", where, name);
    }

    const Json* find(const char* name, Need need)
    {
        const auto entry = current->find(name);
        if (entry != current->end())
            return &*entry;
        if (need == Need::required)
            fail(name, "is missing");
        return nullptr;
    }

    template <typename Fields>
    void enter(std::string_view name, const Json& inner, Fields fields)
    {
        if (!inner.is_object())
            return fail(name, "must be an object in braces");
        const std::string outerPlace = std::exchange(where, place(name));
        const Json* outer = std::exchange(current, &inner);
        fields();
        current = outer;
        where = outerPlace;
    }

    const Json* current;
    std::string where;
};
} // namespace

Result<Profile> readProfileJson(std::string_view text)
{
    const auto document = readJsonTree(text, largestProfileText);
    if (!document)
        return document.error();
    if (!document->is_object())
        return Error{ErrorCode::invalidData, "", "is not a profile, which is a JSON object"};
    Reader reader(*document);
    std::string format;
    reader.text("format", format);
    if (format != profileFormatName)
        reader.fail("format", "must be \"pacini.profile\"");
    double version = 0.0;
    reader.number("version", version, Need::required);
    if (version > profileFormatVersion)
        reader.fail(
            "version",
            fmt::format("was written by a newer version ({}) of the format; this program reads version 1", version),
            ErrorCode::unsupportedVersion);
    else if (version != profileFormatVersion)
        reader.fail("version", "must be 1");

    Profile profile;
    profileFields::visitFields(profile, reader);
    if (reader.error)
        return *reader.error;
    if (auto valid = validate(profile); !valid)
        return valid.error();
    return profile;
}

} // namespace pacini
