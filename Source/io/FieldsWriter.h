#pragma once

// Writer of JSON documents by lists of fields.

#include "io/Fields.h"
#include "io/JsonText.h"

#include <pacini/clip/Clip.h>

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace pacini
{

/// Builds the text: entries of the document and elements of lists on lines of their own, numbers in the shortest form
/// that reads back exactly.
class FieldsWriter
{
public:
    /// Layout of the entries of an object.
    enum class Layout
    {
        lines,  ///< each on its own
        spaced, ///< on one line, with blanks inside the braces
        compact ///< on one line
    };

    /// Objects inside the document have the layout `inside`. With a `sink` the text goes there in pieces of some 256
    /// kB.
    explicit FieldsWriter(Layout inside, const TextSink* sink = nullptr) : objects(inside), receiver(sink) {}

    /// The rest of the text, which is finished.
    [[nodiscard]] std::string document() &&
    {
        output += "\n}\n";
        return std::move(output);
    }

    void format(const DocumentFormat& document)
    {
        text("format", document.name);
        integer("version", document.version);
    }

    void text(std::string_view name, std::string_view value, Need = Need::required)
    {
        key(name);
        appendJsonString(output, value);
    }

    void optionalText(std::string_view name, std::string_view value)
    {
        if (!value.empty())
            text(name, value);
    }

    void number(std::string_view name, double value, Need need)
    {
        if (need == Need::optional && value == 0.0)
            return;
        key(name);
        number(value);
    }

    template <typename Rule = int>
    void integer(std::string_view name, std::integral auto value, const Rule& = {})
    {
        json(name, fmt::format_int(value).c_str());
    }

    void truth(std::string_view name, bool value) { json(name, value ? "true" : "false"); }

    /// A value that is JSON already.
    void json(std::string_view name, std::string_view value)
    {
        key(name);
        output += value;
    }

    void optionalNumber(std::string_view name, const std::optional<double>& value)
    {
        if (value)
            number(name, *value, Need::required);
    }

    template <typename E, typename Choices>
    void choice(std::string_view name, E value, const Choices& choices, Need)
    {
        text(name, nameOf(value, choices));
    }

    template <typename T, typename Fields, typename... Rules>
    void object(std::string_view name, const T& value, Need need, Fields fields, const Rules&...)
    {
        if (need == Need::optional && value == T{})
            return;
        key(name);
        object(value, fields, layout == Layout::lines ? objects : layout);
    }

    template <typename T, typename Fields>
    void optionalObject(std::string_view name, const std::optional<T>& value, Fields fields)
    {
        if (value)
            object(name, *value, Need::required, fields);
    }

    template <typename List, typename Fields, typename... Rules>
    void list(std::string_view name, const List& values, std::size_t, std::string_view, Fields fields,
              Need need = Need::optional, const Rules&...)
    {
        elements(name, values, need, fields, layout == Layout::lines ? objects : layout,
                 [](const auto&) { return true; });
    }

    /// A list whose elements have one line each.
    template <typename List, typename Fields>
    void rows(std::string_view name, const List& values, std::size_t, std::string_view, Fields fields)
    {
        elements(name, values, Need::usual, fields, Layout::compact, [](const auto&) { return true; });
    }

    /// A list of short objects that each have a time: those of one quarter of a second share a line, at most six.
    template <typename Events, typename Fields>
    void timeline(std::string_view name, const Events& events, Need, Fields fields)
    {
        constexpr double linesPerSecond = 4.0;
        constexpr int maxPerLine = 6;
        int onLine = 0;
        double quarter = -1.0;
        const auto separate = [&](const auto& event)
        {
            const double itsQuarter = std::floor(event.time * linesPerSecond);
            const bool starts = onLine == 0 || onLine == maxPerLine || itsQuarter != quarter;
            quarter = itsQuarter;
            onLine = starts ? 1 : onLine + 1;
            return starts;
        };
        elements(name, events, Need::usual, fields, Layout::compact, separate);
    }

    void numbers(std::string_view name, const std::vector<double>& values, std::size_t)
    {
        json(name, fmt::format("[{}]", fmt::join(values, ", ")));
    }

    /// Nothing for no texts.
    void textList(std::string_view name, const std::vector<std::string>& values, std::size_t)
    {
        if (values.empty())
            return;
        key(name);
        const char* before = "[";
        for (const std::string& value : values)
        {
            output += std::exchange(before, ", ");
            appendJsonString(output, value);
        }
        output += ']';
    }

    /// Pairs of a name and a text, on lines of their own.
    template <typename Texts>
    void texts(std::string_view name, const Texts& values)
    {
        if (values.empty())
            return;
        key(name);
        const auto fields = [](const Texts& pairs, FieldsWriter& writer)
        {
            for (const auto& [inner, value] : pairs)
                writer.text(inner, value);
        };
        object(values, fields, Layout::lines);
    }

    void parameters(std::string_view name, const std::vector<EncoderParameter>& values)
    {
        key(name);
        const auto fields = [](const std::vector<EncoderParameter>& all, FieldsWriter& writer)
        {
            for (const EncoderParameter& parameter : all)
            {
                if (const auto* number = std::get_if<double>(&parameter.value))
                    writer.number(parameter.name, *number, Need::required);
                else if (const auto* text = std::get_if<std::string>(&parameter.value))
                    writer.text(parameter.name, *text);
                else
                    writer.truth(parameter.name, std::get<bool>(parameter.value));
            }
        };
        object(values, fields, Layout::lines);
    }

private:
    void number(double value)
    {
        // Minus zero would come back as an integer zero.
        char digits[32];
        output.append(digits, fmt::format_to(digits, FMT_COMPILE("{}"), value == 0.0 ? 0.0 : value));
    }

    void key(std::string_view name)
    {
        if (layout == Layout::lines)
        {
            if (!first)
                output += ',';
            lineBreak(depth);
            appendJsonString(output, name); // the names of parameters are free
            output += ": ";
        }
        else
        {
            // Names of fields in one piece: long clips have millions.
            const std::string_view before = !first ? ", \"" : layout == Layout::spaced ? " \"" : "\"", after = "\": ";
            const std::size_t start = output.size();
            output.resize(start + before.size() + name.size() + after.size());
            char* at = std::copy(before.begin(), before.end(), output.data() + start);
            std::copy(after.begin(), after.end(), std::copy(name.begin(), name.end(), at));
        }
        first = false;
    }

    template <typename T, typename Fields>
    void object(const T& value, Fields fields, Layout inside)
    {
        const Layout outside = std::exchange(layout, inside);
        output += '{';
        ++depth;
        first = true;
        if constexpr (std::is_invocable_v<Fields, const T&, FieldsWriter&>)
            fields(value, *this);
        else
            fields(value);
        --depth;
        if (layout == Layout::lines && !first)
            lineBreak(depth);
        if (layout == Layout::spaced)
            output += ' ';
        output += '}';
        layout = outside;
        first = false;
    }

    template <typename List, typename Fields, typename Separate>
    void elements(std::string_view name, const List& values, Need need, Fields fields, Layout inside,
                  Separate startsLine)
    {
        if (need == Need::optional && values.empty())
            return;
        key(name);
        output += '[';
        const std::size_t outer = depth;
        bool isFirst = true;
        for (const auto& value : values)
        {
            if (!std::exchange(isFirst, false))
                output += ',';
            if (startsLine(value))
                lineBreak(outer + 1);
            else
                output += ' ';
            depth = inside == Layout::lines ? outer + 1 : outer;
            object(value, fields, inside);
        }
        depth = outer;
        if (!isFirst)
            lineBreak(depth);
        output += ']';
    }

    void lineBreak(std::size_t steps)
    {
        constexpr std::size_t maxKept = std::size_t(1) << 18;
        if (receiver != nullptr && output.size() >= maxKept)
        {
            (*receiver)(output);
            output.clear();
        }
        output += '\n';
        output.append(2 * steps, ' ');
    }

    Layout objects;
    const TextSink* receiver;
    std::string output = "{";
    Layout layout = Layout::lines; ///< of the object that is open
    bool first = true;             ///< no entry of it is written yet
    std::size_t depth = 1;         ///< steps by which its lines stand in
};

} // namespace pacini
