#pragma once

// Validation of edit operations before they are applied and stored.

#include "document/EditFields.h"

#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pacini
{

namespace detail
{
/// Visits an operation like FieldsWriter and finds values that JSON cannot represent.
class OperationVisitor
{
public:
    std::optional<Error> wrong;

    void number(const char* name, double value, Need)
    {
        if (!std::isfinite(value))
            wrong = Error{ErrorCode::notFinite, name, "is not a finite number"};
    }
    void integer(const char* name, int value, const char*)
    {
        if (value < -1'000'000 || value > 1'000'000)
            wrong = Error{ErrorCode::invalidArgument, name, "is beyond a million"};
    }
    void clip(const char* name, const std::shared_ptr<const Clip>& value)
    {
        if (!value)
            wrong = Error{ErrorCode::invalidArgument, name, "is missing"};
        else if (auto valid = validate(*value); !valid)
            wrong = valid.error();
    }
    template <typename List, typename Fields>
    void list(const char*, const List& values, std::size_t, const char*, Fields fields)
    {
        for (const auto& value : values)
            fields(value);
    }
    template <typename T, typename Fields>
    void optionalObject(const char*, const std::optional<T>& value, Fields fields)
    {
        if (value)
            fields(*value);
    }
    void text(const char*, const std::string&) {}
    void truth(const char*, bool) {}
    template <typename E, typename Choices>
    void choice(const char*, E, const Choices&, Need)
    {
    }
};
} // namespace detail

/// What keeps an operation from being applied and kept, if anything: notFinite, invalidArgument, or an invalid clip
/// inside it.
[[nodiscard]] inline std::optional<Error> checkOperation(const EditOperation& operation)
{
    detail::OperationVisitor visitor;
    std::visit([&](const auto& op) { projectFields::visitOperation(op, visitor); }, operation);
    return visitor.wrong;
}

} // namespace pacini
