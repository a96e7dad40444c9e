#include "io/JsonText.h"

#include "io/JsonSource.h"
#include "io/TextMark.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <new>
#include <utility>

namespace pacini
{

namespace
{
/// Turns the events of nlohmann's parser into those of a JsonHandler, knows the path, and keeps the first Error.
class Events
{
public:
    Events(JsonHandler& receiver, JsonSource& textSource, ReadWarnings* collector)
        : handler(&receiver), source(textSource), warnings(collector)
    {
        handler->setWarnings(warnings);
    }

    Error error;

    bool null()
    {
        return value([this] { return handler->null(); });
    }
    bool boolean(bool v)
    {
        return value([this, v] { return handler->truth(v); });
    }
    bool number_integer(std::int64_t v) { return number(static_cast<double>(v)); }
    bool number_unsigned(std::uint64_t v) { return number(static_cast<double>(v)); }
    bool number_float(double v, const std::string&) { return number(v); }
    bool string(std::string& v)
    {
        return value([this, &v] { return handler->text(v); });
    }
    bool binary(nlohmann::json::binary_t&) { return false; }

    bool start_object(std::size_t) { return open(false); }
    bool start_array(std::size_t) { return open(true); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool key(std::string& name)
    {
        steps[depth - 1].key = name;
        return handler->key(name) ? warnings == nullptr || doubted() : stopped();
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& exception)
    {
        constexpr int numberOverflow = 406;
        if (exception.id == numberOverflow)
        {
            countPlace();
            error = {ErrorCode::notFinite, path(), "is beyond the range of numbers"};
        }
        else if (source.endedByNul())
            error = {ErrorCode::invalidData, source.place(position), "has a NUL byte; is this a text file?"};
        else
            error = {ErrorCode::invalidData, source.place(position), "is not valid JSON: " + cause(exception.what())};
        return false;
    }

private:
    struct Step
    {
        std::string key;
        std::size_t place = SIZE_MAX; ///< one before the first
        bool list = false;
    };

    /// The middle of "[...] parse error at line 1, column 2: syntax error while parsing value - CAUSE; last read:
    /// '...'".
    static std::string cause(std::string_view what)
    {
        if (const auto start = what.find(" - "); start != std::string_view::npos)
            what.remove_prefix(start + 3);
        // What was read last may be long and unprintable; line and column say where it is.
        const auto end = what.find("; last read: ");
        std::string text(what.substr(0, end));
        if (text.starts_with("invalid string: ") || text.starts_with("invalid number; "))
            text[text.find_first_of(":;")] = ',';
        return text;
    }

    bool number(double v)
    {
        return value([this, v] { return handler->number(v); });
    }

    void countPlace()
    {
        if (depth > 0 && steps[depth - 1].list)
            ++steps[depth - 1].place;
    }

    template <typename Call>
    bool value(Call call)
    {
        countPlace();
        return call() || stopped();
    }

    bool open(bool list)
    {
        if (depth == deepestJson)
        {
            error = {ErrorCode::tooLarge, source.place(source.passed()),
                     "has more than 32 levels of objects and lists"};
            return false;
        }
        if (!value([this, list] { return list ? handler->openList() : openObject(); }))
            return false;
        Step& step = steps[depth++];
        step.key.clear();
        step.place = SIZE_MAX;
        step.list = list;
        return true;
    }

    bool openObject()
    {
        if (!handler->openObject())
            return false;
        JsonHandler* next = handler->takeNext();
        if (next == nullptr)
            return true;
        outer = std::exchange(handler, next);
        outerDepth = depth;
        return handler->openObject();
    }

    bool close()
    {
        --depth;
        if (!handler->close())
            return stopped();
        if (outer == nullptr || depth > outerDepth)
            return true;
        handler = std::exchange(outer, nullptr);
        return handler->passedOn() || stopped();
    }

    /// Whether to go on after what the handler may have against the key.
    bool doubted()
    {
        const auto doubt = handler->takeDoubt();
        if (!doubt)
            return true;
        if (warnings->isStrict())
            error = {ErrorCode::invalidData, path(), *doubt};
        else
            warnings->add(path(), *doubt);
        return !warnings->isStrict();
    }

    bool stopped()
    {
        error = handler->reason();
        error.where = path() + error.where;
        if (error.where.starts_with('.'))
            error.where.erase(0, 1);
        return false;
    }

    [[nodiscard]] std::string path() const
    {
        std::string text;
        for (std::size_t i = 0; i < depth; ++i)
        {
            const Step& step = steps[i];
            if (step.list)
                text += fmt::format("[{}]", step.place);
            else
                text += fmt::format("{}{}", i > 0 ? "." : "", shownText(step.key));
        }
        return text;
    }

    JsonHandler* handler;
    JsonHandler* outer = nullptr; ///< that goes on when `handler` has its object
    std::size_t outerDepth = 0;
    JsonSource& source;
    ReadWarnings* warnings;
    std::array<Step, deepestJson> steps;
    std::size_t depth = 0;
};

} // namespace

static Result<void> parseText(std::string_view text, JsonHandler& handler, std::size_t maximumBytes,
                              ReadWarnings* warnings)
{
    const auto unmarked = utf8Text(text, maximumBytes);
    if (!unmarked)
        return unmarked.error();
    JsonSource source(*unmarked);
    if (source.atEnd())
        return Error{ErrorCode::invalidData, "", "is empty"};
    Events events(handler, source, warnings);
    if (!nlohmann::json::sax_parse(JsonCursor(source), JsonCursor(), &events))
        return events.error;
    if (source.endedByNul())
        return Error{ErrorCode::invalidData, source.place(source.passed()), "has a NUL byte after its end"};
    return {};
}

Result<void> parseJson(std::string_view text, JsonHandler& handler, std::size_t maximumBytes, ReadWarnings* warnings)
{
#if defined(__cpp_exceptions)
    try
    {
        return parseText(text, handler, maximumBytes, warnings);
    }
    catch (const std::bad_alloc&)
    {
        return Error{ErrorCode::tooLarge, "", "needs more memory than is available"};
    }
    catch (const std::exception& exception)
    {
        return Error{ErrorCode::io, "", std::string("cannot be read: ") + exception.what()};
    }
#else
    return parseText(text, handler, maximumBytes, warnings);
#endif
}
void appendJsonString(std::string& text, std::string_view value)
{
    const auto isPlain = [](char c)
    {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 && byte < 0x80 && c != '"' && c != '\\';
    };
    using nlohmann::json;
    if (std::all_of(value.begin(), value.end(), isPlain))
        ((text += '"') += value) += '"';
    else
        text += json(value).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string inQuotes(std::string_view value)
{
    std::string text;
    appendJsonString(text, value);
    return text;
}

std::string shownText(std::string_view text)
{
    constexpr std::size_t maxCharacters = 40;
    std::string shown;
    std::size_t characters = 0;
    for (char c : text)
    {
        const auto byte = static_cast<unsigned char>(c);
        const bool continues = (byte & 0xC0u) == 0x80u;
        if (!continues && ++characters > maxCharacters)
        {
            shown += "...";
            break;
        }
        shown += byte < 0x20 || byte == 0x7F ? '?' : c;
    }
    return shown;
}

} // namespace pacini
