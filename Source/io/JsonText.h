#pragma once

// Strict, streaming JSON (RFC 8259) with limits, for texts that may be damaged or hostile.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>

namespace pacini
{

/// Objects and lists inside each other; deeper text is refused as soon as it comes.
inline constexpr std::size_t deepestJson = 32;

/// Receives the values of a document in their order. Every call returns true to go on, or stop(...) to end the parse.
class JsonHandler
{
public:
    virtual ~JsonHandler() = default;
    virtual bool openObject() = 0;
    virtual bool openList() = 0;
    virtual bool close() = 0;                    ///< the innermost open object or list ends
    virtual bool key(std::string_view name) = 0; ///< of an object, before its value
    virtual bool number(double value) = 0;       ///< finite
    virtual bool text(std::string& value) = 0;   ///< valid UTF-8; may be moved from
    virtual bool truth(bool value) = 0;
    virtual bool null() = 0;

    /// Why stop() was called; its `where` still lacks the path of the value.
    [[nodiscard]] const Error& reason() const noexcept { return failure; }

protected:
    /// Ends the parse. `below` is appended to the path of the current value, such as ".time" for a missing member.
    bool stop(ErrorCode code, std::string message, std::string below = {})
    {
        failure = {code, std::move(below), std::move(message)};
        return false;
    }

private:
    Error failure;
};

/// Feeds one JSON document to `handler`. Errors: what the handler stops with, at a path such as
/// `bands[2].amplitude[7].time`; notFinite with a path for numbers beyond the range of double; invalidData with
/// `line 3, column 17` (columns count characters) for wrong syntax, ill-formed UTF-8, text after the end, a byte order
/// mark, a NUL byte; tooLarge for more than `maximumBytes` or deeper than deepestJson; io when the stream fails.
/// Memory beyond the handler's is bounded by the longest string or number in the text.
[[nodiscard]] Result<void> parseJson(std::string_view text, JsonHandler& handler, std::size_t maximumBytes);
[[nodiscard]] Result<void> parseJson(std::istream& text, JsonHandler& handler, std::size_t maximumBytes);

/// `text` fit for an error message: on one line, cut after 40 characters, control characters as '?'.
[[nodiscard]] std::string shownText(std::string_view text);

} // namespace pacini
