// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/Lv2Parameters.h"

#include "io/Fields.h"
#include "plugin/engine/ParameterGroups.h"
#include "plugin/engine/ParameterTable.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <locale>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

namespace pacini::plugin
{

namespace
{
constexpr std::string_view blanks = " \t\r\n";

/// The statements of a document, each with its full stop and what stands before it.
std::vector<std::string_view> statementsOf(std::string_view turtle)
{
    std::vector<std::string_view> statements;
    std::size_t begin = 0;
    char closing = 0; // what ends the string or the address around `i`
    for (std::size_t i = 0; i < turtle.size(); ++i)
    {
        const char c = turtle[i];
        if (closing != 0)
        {
            if (c == '\\')
                ++i;
            else if (c == closing)
                closing = 0;
        }
        else if (c == '"' || c == '<')
            closing = c == '"' ? '"' : '>';
        else if (c == '.' && (i + 1 == turtle.size() || blanks.find(turtle[i + 1]) != blanks.npos))
        {
            statements.push_back(turtle.substr(begin, i + 1 - begin));
            begin = i + 1;
        }
    }
    statements.push_back(turtle.substr(begin));
    return statements;
}

std::string_view trimmedStart(std::string_view statement)
{
    return statement.substr(std::min(statement.find_first_not_of(blanks), statement.size()));
}

/// The id of the parameter that a statement describes; empty if it describes anything else.
std::string_view parameterOf(std::string_view statement)
{
    constexpr std::string_view prefix = "plug:";
    statement = trimmedStart(statement);
    const std::size_t end = statement.find_first_of(blanks);
    if (!statement.starts_with(prefix) || end == statement.npos)
        return {};
    const std::size_t next = statement.find_first_not_of(blanks, end);
    return next != statement.npos && statement.substr(next).starts_with("a lv2:Parameter")
               ? statement.substr(prefix.size(), end - prefix.size())
               : std::string_view();
}

std::string quoted(std::string_view text)
{
    std::string result = "\"";
    for (const char c : text)
    {
        if (c == '"' || c == '\\')
            result += '\\';
        result += c;
    }
    return result + '"';
}

constexpr std::string_view groupPrefix = "plug:group_";
/// What presets of JUCE's wrapper set, and what it leaves undefined.
constexpr std::string_view program = "plug:Program";

/// What JUCE's wrapper writes, and what stands there instead.
using Correction = std::array<std::string_view, 2>;

/// There is no page and no address to name.
constexpr std::array<Correction, 10> corrections{{
    {"lv2:name \"Audio In 1\"", "lv2:name \"Sound In Left\""},
    {"lv2:name \"Audio In 2\"", "lv2:name \"Sound In Right\""},
    {"lv2:name \"Audio In 3\"", "lv2:name \"Sidechain\""},
    {"lv2:name \"Audio Out 1\"", "lv2:name \"Sound Out Left\""},
    {"lv2:name \"Audio Out 2\"", "lv2:name \"Sound Out Right\""},
    {"lv2:name \"Audio Out 3\"", "lv2:name \"Haptic\""},
    {"lv2:name \"Main\"", "lv2:name \"Sound\""},
    {"\t\tfoaf:homepage <https://pacini.example> ;\n", ""},
    {"\t\tfoaf:mbox <> ;\n", ""},
    {"\ta lv2:Plugin ;\n\tdoap:name", "\ta lv2:Plugin , doap:Project ;\n\tdoap:name"},
}};

/// The window can be resized; and an interface for options is data, no feature.
constexpr std::array<Correction, 2> windowCorrections{{
    {"\t\tui:noUserResize ,\n", ""},
    {"\t\tui:resize ,\n\t\topts:interface ,\n", "\t\tui:resize ,\n"},
}};

void correct(std::string& text, std::span<const Correction> wrong)
{
    for (const auto& [written, wanted] : wrong)
        for (std::size_t at = text.find(written); at != text.npos; at = text.find(written, at + wanted.size()))
            text.replace(at, written.size(), wanted);
}

constexpr std::array<Choice<ParameterUnit>, 4> lv2Units{{{"units:db", ParameterUnit::decibels},
                                                         {"units:semitone12TET", ParameterUnit::semitones},
                                                         {"units:ms", ParameterUnit::milliseconds},
                                                         {"units:coef", ParameterUnit::percent}}};

constexpr std::array<Choice<ParameterUnit>, 3> lv2Properties{{{"lv2:integer", ParameterUnit::number},
                                                              {"lv2:integer , lv2:enumeration", ParameterUnit::choice},
                                                              {"lv2:toggled", ParameterUnit::toggle}}};

void describe(const ParameterRow& row, std::ostream& out)
{
    out << "plug:" << row.id << "\n\ta lv2:Parameter ;\n\trdfs:label " << quoted(row.name) << " ;\n\trdfs:comment "
        << quoted(row.help) << " ;\n\trdfs:range atom:Float ;\n";
    out << "\tpg:group " << groupPrefix << groupOf(row.id).symbol << " ;\n";
    if (const auto unit = nameOf(row.unit, lv2Units); !unit.empty())
        out << "\tunits:unit " << unit << " ;\n";
    if (const auto properties = nameOf(row.unit, lv2Properties); !properties.empty())
        out << "\tlv2:portProperty " << properties << " ;\n";
    for (std::size_t i = 0; i < row.choices.size(); ++i)
        if (!hasNoActuator(row.choices[i]))
            out << "\tlv2:scalePoint [ rdfs:label " << quoted(row.choices[i]) << " ; rdf:value "
                << static_cast<double>(i) << " ] ;\n";
    out << "\tlv2:default " << row.standard << " ;\n\tlv2:minimum " << row.low << " ;\n\tlv2:maximum " << row.high
        << " .\n\n";
}
} // namespace

Result<std::string> describeLv2Parameters(std::string_view turtle)
{
    std::string rest;
    std::array<bool, parameterCount> found{};
    for (const std::string_view statement : statementsOf(turtle))
    {
        const std::string_view id = parameterOf(statement);
        if (id.empty())
        {
            const std::string_view subject = trimmedStart(statement);
            if (!subject.starts_with(groupPrefix) && !subject.starts_with(program)) // written anew below
                rest += statement;
            continue;
        }
        const auto row = std::find_if(parameterTable.begin(), parameterTable.end(),
                                      [id](const ParameterRow& each) { return id == each.id; });
        if (row == parameterTable.end())
            return Error{ErrorCode::invalidData, std::string(id), "is not a parameter of the plugin"};
        found[static_cast<std::size_t>(row->parameter)] = true;
    }
    // One gap whatever stood here, so that what is described again stays as it is.
    rest.erase(rest.find_last_not_of(blanks) + 1);
    correct(rest, corrections);
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.setf(std::ios::fixed);
    out.precision(4);
    out << rest << "\n\n";
    for (const ParameterRow& row : parameterTable)
    {
        if (!found[static_cast<std::size_t>(row.parameter)])
            return Error{ErrorCode::invalidData, row.id, "is missing in the description that JUCE made"};
        describe(row, out);
    }
    out << program << "\n\ta rdf:Property ;\n\trdfs:label \"Program\" .\n\n";
    for (const ParameterGroup& group : parameterGroups())
        out << groupPrefix << group.symbol << "\n\ta pg:Group ;\n\tlv2:name " << quoted(group.name)
            << " ;\n\tlv2:symbol " << quoted(group.symbol) << " .\n\n";
    return std::move(out).str();
}

std::string describeLv2Window(std::string_view turtle)
{
    std::string text(turtle);
    correct(text, windowCorrections);
    return text;
}

} // namespace pacini::plugin
