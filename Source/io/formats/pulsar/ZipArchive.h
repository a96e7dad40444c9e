#pragma once

// ZIP archives in memory.

#include <pacini/foundation/Result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct zip;

namespace pacini
{

/// An archive that is being read. The bytes must outlive it.
class ZipArchive
{
public:
    /// Errors: invalidData when it is no archive, or damaged.
    [[nodiscard]] static Result<ZipArchive> open(std::string_view bytes);

    /// The content of the file `name`. Errors: invalidData when it is missing, damaged, encrypted or compressed in a
    /// way that is not supported; tooLarge beyond `most` bytes, whatever the archive says of it.
    [[nodiscard]] Result<std::string> content(const std::string& name, std::uint64_t most) const;

private:
    struct Closer
    {
        void operator()(zip* archive) const noexcept;
    };
    explicit ZipArchive(zip* opened) noexcept : archive(opened) {}

    std::unique_ptr<zip, Closer> archive;
};

/// An archive of files, by name and content, without times and compression: the same files give the same bytes, with
/// any version of zlib. Errors: io when there is no memory.
[[nodiscard]] Result<std::string> zipOf(const std::vector<std::pair<std::string, std::string>>& files);

} // namespace pacini
