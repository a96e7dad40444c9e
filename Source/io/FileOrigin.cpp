#include "io/FileOrigin.h"

#include "io/Fingerprint.h"
#include "io/InputFile.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t searched = 65536; // bytes; the header of our own files is much shorter
constexpr std::size_t digitCount = 16;
constexpr std::string_view before = "Made by Pacini from \"";
constexpr std::string_view place = "\" (place ";
constexpr std::string_view substance = ", substance ";
constexpr std::string_view seal = ", seal ";

/// An origin in the form stored in files.
struct FoundOrigin
{
    FileOrigin origin;
    std::size_t sealOffset = 0;
    std::string sealDigits;
};

bool isDigits(std::string_view text)
{
    return text.size() == digitCount && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::optional<FoundOrigin> findOrigin(std::string_view bytes)
{
    const auto start = bytes.find(before);
    if (start == std::string_view::npos)
        return std::nullopt;
    const auto nameEnd = bytes.find(place, start + before.size());
    constexpr std::size_t rest =
        place.size() + digitCount + substance.size() + digitCount + seal.size() + digitCount + 1;
    if (nameEnd == std::string_view::npos || bytes.size() - nameEnd < rest)
        return std::nullopt;
    FoundOrigin found;
    found.origin.input = bytes.substr(start + before.size(), nameEnd - start - before.size());
    auto at = nameEnd + place.size();
    found.origin.place = bytes.substr(at, digitCount);
    at += digitCount + substance.size();
    found.origin.substance = bytes.substr(at, digitCount);
    at += digitCount + seal.size();
    found.sealOffset = at;
    found.sealDigits = bytes.substr(at, digitCount);
    const bool whole = isDigits(found.origin.place) && isDigits(found.origin.substance) && isDigits(found.sealDigits) &&
                       bytes[at + digitCount] == ')';
    return whole ? std::optional(found) : std::nullopt;
}

/// What of a path every program shows alike.
std::string plainName(const fs::path& path)
{
    std::string name = path.filename().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7F || c == '"'; }, '_');
    return name;
}

std::string startOf(const fs::path& path)
{
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
        return {};
    const auto file = openForReading(path);
    std::string start(searched, '\0');
    start.resize(file ? std::fread(start.data(), 1, start.size(), file->get()) : 0);
    return start;
}

/// The seal by `fingerprint`, which is empty.
template <typename Print>
std::optional<OriginSeal> sealBy(Print fingerprint, const std::function<std::size_t(std::span<std::byte>)>& read)
{
    static_assert(searched % StripedFingerprint::stripe == 0);
    std::vector<std::byte> block(searched);
    const auto next = [&]
    {
        std::size_t got = 0;
        for (std::size_t more = 1; more > 0 && got < block.size(); got += more)
            more = read(std::span(block).subspan(got));
        return got;
    };
    auto got = next();
    const auto found = findOrigin({reinterpret_cast<const char*>(block.data()), got});
    if (!found)
        return std::nullopt;
    // The seal cannot depend on itself.
    std::fill_n(block.begin() + static_cast<std::ptrdiff_t>(found->sealOffset), digitCount, std::byte{'0'});
    for (; got > 0; got = next())
        fingerprint.add(std::span(block).first(got));
    return OriginSeal{static_cast<std::int64_t>(found->sealOffset), fingerprint.text()};
}
} // namespace

FileOrigin originOf(const fs::path& input, const fs::path& output, std::string substanceDigits)
{
    std::error_code error;
    const auto absolute = [&error](const fs::path& path)
    {
        const fs::path folder = fs::weakly_canonical(fs::absolute(path, error).parent_path(), error);
        return folder / path.filename();
    };
    Fingerprint way;
    way.add(absolute(input).lexically_proximate(absolute(output).parent_path()).generic_string());
    return {plainName(input), way.text(), std::move(substanceDigits)};
}

std::string originText(const FileOrigin& origin)
{
    std::string text(before);
    text += origin.input;
    text += place;
    text += origin.place;
    text += substance;
    text += origin.substance;
    text += seal;
    text += std::string(digitCount, '0') + ")";
    return text;
}

std::optional<FileOrigin> readOrigin(const fs::path& path)
{
    auto found = findOrigin(startOf(path));
    return found ? std::optional(std::move(found->origin)) : std::nullopt;
}

bool isAsMade(const fs::path& path)
{
    const auto found = findOrigin(startOf(path));
    if (!found)
        return false;
    const auto hasSealBy = [&](const auto& fingerprint)
    {
        const auto file = openForReading(path);
        if (!file)
            return false;
        const auto read = [&](std::span<std::byte> bytes)
        {
            return std::fread(bytes.data(), 1, bytes.size(), file->get());
        };
        const auto wanted = sealBy(fingerprint, read);
        return wanted && wanted->digits == found->sealDigits && std::ferror(file->get()) == 0;
    };
    return hasSealBy(StripedFingerprint()) || hasSealBy(Fingerprint()); // as 0.1 wrote it
}

std::optional<OriginSeal> sealOf(const std::function<std::size_t(std::span<std::byte>)>& read)
{
    return sealBy(StripedFingerprint(), read);
}

} // namespace pacini
