#pragma once

// Result<T>: a value or an Error with place and message, for expected failures.

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace pacini
{

/// Kind of an Error. Callers branch on the code; the message is for people.
enum class ErrorCode
{
    invalidArgument,    ///< a parameter is outside its documented range
    invalidData,        ///< the input breaks the rules of its format
    unsupportedVersion, ///< the input was written by a newer version
    truncated,          ///< the input ends too early
    notFinite,          ///< a NaN or an infinity where a number is needed
    tooLarge,           ///< a size or a count exceeds its limit
    io,                 ///< the file system refused
    diskFull,           ///< no more can be written there
    cancelled,          ///< the user stopped the work
};

/// A failure: `where` is a path into the input such as `bands[2].amplitude[7].time`, empty for the whole input.
struct Error
{
    ErrorCode code = ErrorCode::invalidData;
    std::string where;
    std::string message;

    /// "where: message", or only the message when there is no place to name.
    [[nodiscard]] std::string text() const { return where.empty() ? message : where + ": " + message; }
};

/// The Error of work that the user stopped.
[[nodiscard]] inline Error wasCancelled()
{
    return {ErrorCode::cancelled, "", "was cancelled"};
}

/// Either a value or an Error. Accessing the absent one is a programming error (asserted).
template <typename T>
class [[nodiscard]] Result
{
public:
    Result(T value) : content(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : content(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const noexcept { return content.index() == 0; }
    explicit operator bool() const noexcept { return ok(); }

    [[nodiscard]] const T& value() const&
    {
        assert(ok());
        return *std::get_if<0>(&content);
    }
    [[nodiscard]] T& value() &
    {
        assert(ok());
        return *std::get_if<0>(&content);
    }
    [[nodiscard]] T&& value() &&
    {
        assert(ok());
        return std::move(*std::get_if<0>(&content));
    }
    [[nodiscard]] const Error& error() const
    {
        assert(!ok());
        return *std::get_if<1>(&content);
    }

    const T& operator*() const& { return value(); }
    T& operator*() & { return value(); }
    const T* operator->() const { return &value(); }
    T* operator->() { return &value(); }

private:
    std::variant<T, Error> content;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void>
{
public:
    Result() = default;
    Result(Error error) : failure(std::move(error)), failed(true) {}

    [[nodiscard]] bool ok() const noexcept { return !failed; }
    explicit operator bool() const noexcept { return ok(); }
    [[nodiscard]] const Error& error() const
    {
        assert(failed);
        return failure;
    }

private:
    Error failure;
    bool failed = false;
};

} // namespace pacini
