#pragma once

// Another program as a child process, whose output is read through a pipe.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// A running program. It is started without a shell and ended with this object, however far it has come. One thread at
/// a time.
class ChildProgram
{
public:
    /// How a program ended, and the start of what it said on its standard error.
    struct Ending
    {
        bool succeeded = false; ///< its exit code was 0, or is not known
        std::string complaint;
    };

    /// Starts the program `name`, which is looked for in the folders of PATH, with `input` as its standard input (null:
    /// none). Arguments are UTF-8. Null when no such program is installed. Error: io, when the system refuses.
    [[nodiscard]] static Result<std::unique_ptr<ChildProgram>>
    start(const std::string& name, const std::vector<std::string>& arguments, std::FILE* input = nullptr);

    virtual ~ChildProgram() = default;

    /// Fills `bytes` with what it prints next; returns how many came, fewer than fit only at the end.
    [[nodiscard]] virtual std::size_t read(std::span<char> bytes) = 0;

    /// Waits for the end of a program whose output was read to the end. For one call.
    [[nodiscard]] virtual Ending wait() = 0;

protected:
    ChildProgram() = default;
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;
};

/// All that `program` prints, at most `maximumBytes`.
[[nodiscard]] std::string allOutput(ChildProgram& program, std::size_t maximumBytes);

} // namespace pacini
