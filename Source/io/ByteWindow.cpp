#include "io/ByteWindow.h"

#include "io/FileHandle.h"

#include <algorithm>

namespace pacini
{

ByteWindow::ByteWindow(std::FILE* opened) : file(opened)
{
    if (!seekStream(file, 0, SEEK_END))
        return;
    if (const auto end = tellStream(file); end > 0)
        bytesOfFile = static_cast<std::uint64_t>(end);
}

std::span<const unsigned char> ByteWindow::at(std::uint64_t offset, std::size_t count)
{
    if (offset >= bytesOfFile)
        return {};
    count = static_cast<std::size_t>(std::min<std::uint64_t>({count, most, bytesOfFile - offset}));
    if (offset < start || offset + count > start + filled)
    {
        start = offset;
        filled = 0;
        if (seekStream(file, static_cast<std::int64_t>(offset), SEEK_SET))
            filled = std::fread(bytes.data(), 1, bytes.size(), file);
    }
    const auto skipped = static_cast<std::size_t>(offset - start);
    return std::span(bytes).subspan(skipped, std::min(count, filled - std::min(filled, skipped)));
}

bool ByteWindow::has(std::uint64_t offset, std::string_view text)
{
    const auto found = at(offset, text.size());
    return found.size() == text.size() &&
           std::equal(text.begin(), text.end(), found.begin(),
                      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

std::uint64_t ByteWindow::number(std::uint64_t offset, std::size_t count, bool bigEndian)
{
    const auto found = at(offset, count);
    std::uint64_t value = 0;
    if (found.size() == count)
        for (std::size_t i = 0; i < count; ++i)
            value = (value << 8u) | found[bigEndian ? i : count - 1 - i];
    return value;
}

std::uint64_t ByteWindow::find(std::string_view text, std::uint64_t from, std::uint64_t to)
{
    while (from < to)
    {
        const auto piece = at(from, static_cast<std::size_t>(std::min<std::uint64_t>(to - from, most)));
        if (piece.size() < text.size())
            return to;
        const std::string_view words(reinterpret_cast<const char*>(piece.data()), piece.size());
        if (const auto place = words.find(text); place != std::string_view::npos)
            return from + place;
        from += piece.size() - (text.size() - 1);
    }
    return to;
}

} // namespace pacini
