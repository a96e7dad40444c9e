#pragma once

// Tree reader of JSON documents by lists of fields: fills a value from a parsed object.

#include "io/Fields.h"
#include "io/FormatNames.h"
#include "io/JsonText.h"
#include "io/ReadWarnings.h"

#include <pacini/foundation/ParseNumber.h>
#include <pacini/foundation/Result.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// Fills a value from a tree, entry by entry, and remembers the first thing that is wrong. Entries are visited by the
/// same function as in FieldsWriter.
class FieldsReader
{
public:
    static constexpr bool reads = true;

    /// With `warnings` for keys that are asked for nowhere.
    explicit FieldsReader(const nlohmann::json& document, ReadWarnings* keyWarnings = nullptr)
        : current(&document), warnings(keyWarnings)
    {
    }

    std::optional<Error> error;

    void fail(std::string_view name, std::string message, ErrorCode code = ErrorCode::invalidData)
    {
        if (!error)
            error = Error{code, place(name), std::move(message)};
    }

    /// An entry that may be there, and is not read.
    void passOver(const char* name) { (void)find(name, Need::optional); }

    void text(const char* name, std::string& value)
    {
        if (const nlohmann::json* entry = find(name, Need::required))
        {
            if (entry->is_string())
                value = entry->get<std::string>();
            else
                fail(name, "must be a text in quotes");
        }
    }

    void optionalText(const char* name, std::string& value)
    {
        if (find(name, Need::optional) != nullptr)
            text(name, value);
    }

    void optionalText(const char* name, std::optional<std::string>& value)
    {
        if (find(name, Need::optional) != nullptr)
            text(name, value.emplace());
    }

    void number(const char* name, double& value, Need need)
    {
        if (const nlohmann::json* entry = find(name, need))
        {
            if (entry->is_number())
                value = entry->get<double>();
            else if (!textsMayBeNumbers || !entry->is_string() ||
                     !numberIn(entry->get_ref<const std::string&>(), value))
                fail(name, "must be a number");
        }
    }

    /// Accepts numbers in quotes from now on, as some programs write them.
    void takeTextsAsNumbers() { textsMayBeNumbers = true; }

    /// Returns the number of numbers in quotes.
    [[nodiscard]] std::size_t textsTaken() const noexcept { return numbersInTexts; }

    void truth(const char* name, bool& value)
    {
        if (const nlohmann::json* entry = find(name, Need::optional))
        {
            if (entry->is_boolean())
                value = entry->get<bool>();
            else
                fail(name, "must be true or false");
        }
    }

    /// 1 for true, 0 for false.
    void optionalTruth(const char* name, std::optional<double>& value)
    {
        bool read = false;
        truth(name, read);
        if (find(name, Need::optional) != nullptr)
            value = read ? 1.0 : 0.0;
    }

    /// Returns the names of the entries of the current object.
    [[nodiscard]] std::vector<std::string> names() const
    {
        std::vector<std::string> all;
        for (const auto& [name, entry] : current->items())
            all.push_back(name);
        return all;
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
        const nlohmann::json* entry = find(name, need);
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
        if (const nlohmann::json* entry = find(name, need))
            enter(name, *entry, [&] { fields(value); });
    }

    template <typename T, typename Fields>
    void optionalObject(const char* name, std::optional<T>& value, Fields fields)
    {
        if (const nlohmann::json* entry = find(name, Need::optional))
            enter(name, *entry, [&] { fields(value.emplace()); });
    }

    /// At most `most` objects, called `elements` in errors.
    template <typename List, typename Fields>
    void list(const char* name, List& values, std::size_t most, const char* elements, Fields fields)
    {
        const nlohmann::json* entry = find(name, Need::optional);
        if (entry == nullptr)
            return;
        if (!entry->is_array())
            return fail(name, fmt::format("must be a list of {}", elements));
        if (entry->size() > most)
            return fail(name, fmt::format("has more than {} {}", most, elements), ErrorCode::tooLarge);
        for (std::size_t i = 0; i < entry->size() && !error; ++i)
        {
            append(values);
            enter(fmt::format("{}[{}]", name, i), (*entry)[i], [&] { fields(values[i]); });
        }
    }

    /// Numbers, at least one.
    void numbers(const char* name, std::vector<double>& values, std::size_t most)
    {
        const nlohmann::json* entry = find(name, Need::required);
        if (entry == nullptr)
            return;
        if (!entry->is_array() || entry->empty())
            return fail(name, "must be a list of numbers");
        if (entry->size() > most)
            return fail(name, fmt::format("has more than {} numbers", most), ErrorCode::tooLarge);
        values.clear();
        for (const nlohmann::json& element : *entry)
        {
            if (!element.is_number())
                return fail(fmt::format("{}[{}]", name, values.size()), "must be a number");
            values.push_back(element.get<double>());
        }
    }

    /// Texts that say something; none where the entry is missing.
    void textList(const char* name, std::vector<std::string>& values, std::size_t most)
    {
        const nlohmann::json* entry = find(name, Need::optional);
        if (entry == nullptr)
            return;
        if (!entry->is_array())
            return fail(name, "must be a list of texts");
        if (entry->size() > most)
            return fail(name, fmt::format("has more than {} texts", most), ErrorCode::tooLarge);
        for (const nlohmann::json& element : *entry)
        {
            if (!element.is_string() || element.get_ref<const std::string&>().empty())
                return fail(fmt::format("{}[{}]", name, values.size()), "must be a text in quotes that is not empty");
            values.push_back(element.get<std::string>());
        }
    }

    /// Pairs of a name and a text that says something.
    template <typename Texts>
    void texts(const char* name, Texts& values)
    {
        const nlohmann::json* entry = find(name, Need::optional);
        if (entry == nullptr)
            return;
        enter(name, *entry,
              [&]
              {
                  for (const auto& [key, text] : entry->items())
                  {
                      asked.emplace_back(key); // names are free
                      if (!text.is_string())
                          return fail(shownText(key), "must be a text in quotes");
                      if (text.template get_ref<const std::string&>().empty())
                          return fail(shownText(key), "must not be empty");
                      values.push_back({key, text.template get<std::string>()});
                  }
              });
    }

    /// Call this after all entries of the document have been visited. Warns of entries that were not.
    void finish() { doubtOthers(); }

    /// Checks the entries `format` and `version` of a document; versions are whole numbers from 1.
    void format(std::string_view name, int newest)
    {
        std::string given;
        text("format", given);
        if (given != name)
            fail("format", fmt::format("must be \"{}\"{}", name, detail::useOfFormat(given)));
        double version = 0.0;
        number("version", version, Need::required);
        if (version > newest)
            fail("version",
                 fmt::format("was written by a newer version ({}) of the format; this program reads version {}",
                             version, newest),
                 ErrorCode::unsupportedVersion);
        else if (version != newest)
            fail("version", fmt::format("must be {}", newest));
    }

private:
    bool numberIn(const std::string& text, double& value)
    {
        const auto number = parseNumber(text);
        if (!number || !std::isfinite(*number))
            return false;
        value = *number;
        ++numbersInTexts;
        return true;
    }

    [[nodiscard]] std::string place(std::string_view name) const
    {
        return where.empty() ? std::string(name) : fmt::format("{}.{}", where, name);
    }

    /// The entry; null where it is missing, or is not needed and has null.
    const nlohmann::json* find(const char* name, Need need)
    {
        if (warnings != nullptr && std::find(asked.begin(), asked.end(), std::string_view(name)) == asked.end())
            asked.emplace_back(name);
        const auto entry = current->find(name);
        if (entry == current->end() && need == Need::required)
            fail(name, "is missing");
        const bool counts = entry != current->end() && (need == Need::required || !entry->is_null());
        return counts ? &*entry : nullptr;
    }

    template <typename List>
    static void append(List& values)
    {
        if constexpr (requires { values.emplace_back(); })
            values.emplace_back();
        else
            values.pushBack({});
    }

    template <typename Fields>
    void enter(std::string_view name, const nlohmann::json& inner, Fields fields)
    {
        if (!inner.is_object())
            return fail(name, "must be an object in braces");
        const std::string outerPlace = std::exchange(where, place(name));
        const nlohmann::json* outer = std::exchange(current, &inner);
        std::vector<std::string_view> outerAsked = std::exchange(asked, {});
        fields();
        doubtOthers();
        asked = std::move(outerAsked);
        current = outer;
        where = outerPlace;
    }

    void doubtOthers()
    {
        if (warnings == nullptr || error)
            return;
        for (const auto& [name, entry] : current->items())
            if (std::find(asked.begin(), asked.end(), std::string_view(name)) == asked.end() && !isRemark(name))
            {
                if (warnings->isStrict())
                    return fail(name, unknownKeyText(name, asked));
                warnings->add(place(shownText(name)), unknownKeyText(name, asked));
            }
    }

    const nlohmann::json* current;
    ReadWarnings* warnings;
    std::vector<std::string_view> asked; ///< the keys that the current object may have
    std::string where;
    bool textsMayBeNumbers = false;
    std::size_t numbersInTexts = 0;
};

} // namespace pacini
