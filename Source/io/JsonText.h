#pragma once

// Strict, streaming parser of JSON (RFC 8259) with limits, for texts that may be damaged or hostile.

#include "io/ReadWarnings.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <functional>
#include <optional>
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

    /// The object that passOn() gave to another handler is complete.
    virtual bool passedOn() { return true; }

    /// Returns the handler of the object that was just opened, if it is another one.
    [[nodiscard]] JsonHandler* takeNext() noexcept { return std::exchange(next, nullptr); }

    /// Why stop() was called; its `where` still lacks the path of the value.
    [[nodiscard]] const Error& reason() const noexcept { return failure; }

    /// Sets the collector of warnings; null: no warnings, which takes no time.
    void setWarnings(ReadWarnings* collector) noexcept { warnings = collector; }

    /// Returns the objection to the last key, if any.
    [[nodiscard]] std::optional<std::string> takeDoubt() { return std::exchange(doubt, std::nullopt); }

protected:
    /// Ends the parse. `below` is appended to the path of the current value, such as ".time" for a missing member.
    bool stop(ErrorCode code, std::string message, std::string below = {})
    {
        failure = {code, std::move(below), std::move(message)};
        return false;
    }

    /// Call this in openObject(): `other` gets all events of the object up to its close instead, and then passedOn() is
    /// called.
    bool passOn(JsonHandler& other) noexcept
    {
        next = &other;
        return true;
    }

    /// Reports that the last key is not one of `known()`; its value is skipped.
    template <typename Known>
    void doubtKey(std::string_view name, Known known)
    {
        if (warnings == nullptr || isRemark(name))
            return;
        if (!warnings->hasRoom() && !warnings->isStrict())
            return warnings->count();
        doubt = unknownKeyText(name, known());
    }

    ReadWarnings* warnings = nullptr;

private:
    Error failure;
    std::optional<std::string> doubt;
    JsonHandler* next = nullptr;
};

/// Feeds one JSON document to `handler`. Errors: what the handler stops with, at a path such as
/// `bands[2].amplitude[7].time`; notFinite with a path for numbers beyond the range of double; invalidData with
/// `line 3, column 17` (columns count characters) for wrong syntax, ill-formed UTF-8, UTF-16, text after the end, a NUL
/// byte; tooLarge for more than `maximumBytes` or deeper than deepestJson.
/// Memory beyond the handler's is bounded by the longest string or number in the text. What the handler doubts goes to
/// `warnings` with its path, or is an error (invalidData) where these are strict.
[[nodiscard]] Result<void> parseJson(std::string_view text, JsonHandler& handler, std::size_t maximumBytes,
                                     ReadWarnings* warnings = nullptr);

/// Receiver of a text, piece by piece.
using TextSink = std::function<void(std::string_view)>;

/// Appends `value` as a JSON text in quotes; ill-formed UTF-8 becomes U+FFFD.
void appendJsonString(std::string& text, std::string_view value);

/// `value` as a JSON text in quotes.
[[nodiscard]] std::string inQuotes(std::string_view value);

/// `text` fit for an error message: on one line, cut after 40 characters, control characters as '?'.
[[nodiscard]] std::string shownText(std::string_view text);

} // namespace pacini
