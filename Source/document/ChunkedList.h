#pragma once

// Persistent list in shared chunks, for many slightly different versions of long lists.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// An immutable list in chunks that versions share: a version that differs from another in one place costs two chunks
/// and a pointer for each of the others. Copies are cheap; any thread may read.
template <typename T>
class ChunkedList
{
public:
    ChunkedList() = default;

    /// The list of `values`, sharing with `previous` the chunks before the first and behind the last difference.
    /// O(values), without allocation for what is shared.
    [[nodiscard]] static ChunkedList of(std::span<const T> values, const ChunkedList& previous = {})
    {
        ChunkedList list;
        list.count = values.size();
        const auto& old = previous.chunks;
        std::size_t front = 0;
        std::size_t begin = 0;
        while (front < old.size() && holds(values, begin, *old[front]))
            begin += old[front++]->size();
        std::size_t back = old.size();
        std::size_t end = values.size();
        while (back > front && end >= begin + old[back - 1]->size() &&
               holds(values, end - old[back - 1]->size(), *old[back - 1]))
            end -= old[--back]->size();
        // A short rest joins its neighbour, so that many small edits do not leave many small chunks.
        if (end - begin < chunkSize / 4 && front > 0 && begin < end)
            begin -= old[--front]->size();
        list.chunks.assign(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(front));
        list.append(values.subspan(begin, end - begin));
        list.chunks.insert(list.chunks.end(), old.begin() + static_cast<std::ptrdiff_t>(back), old.end());
        return list;
    }

    /// This list with one value more. O(chunks).
    [[nodiscard]] ChunkedList with(const T& value) const
    {
        ChunkedList longer = *this;
        if (longer.chunks.empty() || longer.chunks.back()->size() >= chunkSize)
            longer.chunks.push_back(std::make_shared<Chunk>(Chunk{value}));
        else
        {
            Chunk last = *longer.chunks.back();
            last.push_back(value);
            longer.chunks.back() = std::make_shared<Chunk>(std::move(last));
        }
        ++longer.count;
        return longer;
    }

    [[nodiscard]] std::size_t size() const noexcept { return count; }
    [[nodiscard]] bool empty() const noexcept { return count == 0; }

    /// All values.
    [[nodiscard]] std::vector<T> whole() const
    {
        std::vector<T> values;
        values.reserve(count);
        for (const auto& chunk : chunks)
            values.insert(values.end(), chunk->begin(), chunk->end());
        return values;
    }

    /// Bytes of the chunks that `other` does not have, and of the table: what keeping this version beside it costs.
    [[nodiscard]] std::size_t bytesBeside(const ChunkedList& other) const
    {
        std::size_t bytes = chunks.size() * sizeof(chunks[0]);
        for (const auto& chunk : chunks)
            if (std::find(other.chunks.begin(), other.chunks.end(), chunk) == other.chunks.end())
                bytes += chunk->size() * sizeof(T);
        return bytes;
    }

    [[nodiscard]] bool operator==(const ChunkedList& other) const
    {
        return count == other.count && (chunks == other.chunks || whole() == other.whole());
    }

private:
    using Chunk = std::vector<T>;
    static constexpr std::size_t chunkSize = 256;

    static bool holds(std::span<const T> values, std::size_t at, const Chunk& chunk)
    {
        return at + chunk.size() <= values.size() &&
               std::equal(chunk.begin(), chunk.end(), values.begin() + static_cast<std::ptrdiff_t>(at));
    }

    void append(std::span<const T> values)
    {
        const std::size_t pieces = (values.size() + chunkSize - 1) / chunkSize;
        for (std::size_t i = 0; i < pieces; ++i)
        {
            const std::size_t begin = values.size() * i / pieces;
            const std::size_t end = values.size() * (i + 1) / pieces;
            const auto piece = values.subspan(begin, end - begin);
            chunks.push_back(std::make_shared<Chunk>(piece.begin(), piece.end()));
        }
    }

    std::vector<std::shared_ptr<const Chunk>> chunks;
    std::size_t count = 0;
};

} // namespace pacini
