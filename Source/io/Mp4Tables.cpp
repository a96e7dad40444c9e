#include "io/Mp4Tables.h"

#include "io/ByteWindow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace pacini
{

namespace
{
/// The content of a box.
struct Mp4Box
{
    std::uint64_t begin = 0;
    std::uint64_t end = 0;

    [[nodiscard]] std::uint64_t bytes() const noexcept { return end - begin; }
};

constexpr int mostBoxes = 10000;              // of one level
constexpr std::uint64_t mostRows = 1u << 24u; // of a table

class Mp4Reader
{
public:
    explicit Mp4Reader(std::FILE* opened) : file(opened) {}

    std::vector<Mp4Track> tracks()
    {
        const auto movie = child({0, file.size()}, "moov");
        if (!movie || child({0, file.size()}, "moof") || child(*movie, "mvex"))
            return {};
        const auto header = child(*movie, "mvhd");
        movieScale = header ? timeScale(*header) : 0;
        std::vector<Mp4Track> all;
        for (const Mp4Box& box : children(*movie, "trak"))
            all.push_back(track(box));
        return all;
    }

private:
    /// The boxes of that name in `outer`, as far as they fit.
    std::vector<Mp4Box> children(Mp4Box outer, std::string_view name)
    {
        std::vector<Mp4Box> found;
        auto offset = outer.begin;
        for (int box = 0; box < mostBoxes && offset + 8 <= outer.end; ++box)
        {
            std::uint64_t size = file.number(offset, 4, true), head = 8;
            if (size == 1)
            {
                size = file.number(offset + 8, 8, true);
                head = 16;
            }
            else if (size == 0)
                size = outer.end - offset;
            if (size < head || size > outer.end - offset)
                break;
            if (file.has(offset + 4, name))
                found.push_back({offset + head, offset + size});
            offset += size;
        }
        return found;
    }

    std::optional<Mp4Box> child(Mp4Box outer, std::string_view name)
    {
        const auto found = children(outer, name);
        return found.empty() ? std::nullopt : std::optional(found.front());
    }

    /// The box that lies where the names lead; empty where there is none.
    Mp4Box inner(Mp4Box outer, std::initializer_list<std::string_view> names)
    {
        for (const auto name : names)
        {
            const auto found = child(outer, name);
            if (!found)
                return {};
            outer = *found;
        }
        return outer;
    }

    /// A number of a box, 0 behind its end.
    std::uint64_t at(const Mp4Box& box, std::uint64_t offset, std::size_t count)
    {
        return offset + count <= box.bytes() ? file.number(box.begin + offset, count, true) : 0;
    }

    /// The ticks per second that a header of movie or media states.
    std::uint64_t timeScale(const Mp4Box& header) { return at(header, at(header, 0, 1) == 1 ? 20 : 12, 4); }

    /// The rows of a table whose number is at `place`, as far as they are there.
    std::uint64_t rows(const Mp4Box& box, std::uint64_t place, std::uint64_t bytes)
    {
        const auto there = box.bytes() > place + 4 ? (box.bytes() - place - 4) / bytes : 0;
        return std::min({at(box, place, 4), there, mostRows});
    }

    Mp4Track track(const Mp4Box& box)
    {
        Mp4Track found;
        const Mp4Box handler = inner(box, {"mdia", "hdlr"});
        if (handler.bytes() < 12 || !file.has(handler.begin + 8, "soun"))
            return found;
        const Mp4Box tables = inner(box, {"mdia", "minf", "stbl"});
        const Mp4Box times = inner(tables, {"stts"}), sizes = inner(tables, {"stsz"}), runs = inner(tables, {"stsc"});
        const Mp4Box chunks = inner(tables, {"stco"}), longChunks = inner(tables, {"co64"});
        const Mp4Box descriptions = inner(tables, {"stsd"});
        const auto scale = timeScale(inner(box, {"mdia", "mdhd"}));

        std::uint64_t timed = 0; // blocks by the table of their durations
        double ticks = 0.0;
        for (std::uint64_t i = 0; i < rows(times, 4, 8); ++i)
        {
            const auto count = at(times, 8 + 8 * i, 4);
            timed += count;
            ticks += static_cast<double>(count) * static_cast<double>(at(times, 12 + 8 * i, 4));
        }
        found.seconds = scale > 0 ? ticks / static_cast<double>(scale) : 0.0;
        found.played = found.seconds;

        const bool hasSizes = sizes.bytes() > 0;
        const auto sized = at(sizes, 8, 4);
        const auto chunkCount = longChunks.bytes() > 0 ? rows(longChunks, 4, 8) : rows(chunks, 4, 4);
        const auto inChunks = blocksOf(runs, chunkCount);
        if (timed == 0 || scale == 0 || (hasSizes && sized != timed) || inChunks != timed ||
            descriptions.bytes() < 8 + 36)
            found.doubts.emplace_back("has a header whose tables disagree on how many blocks of sound it has; some may "
                                      "be missing; get a complete copy");
        else
        {
            // As a rule all blocks but the last are alike.
            const bool areAlike = at(times, 8, 4) + 2 >= timed;
            const double each = areAlike ? static_cast<double>(at(times, 12, 4)) : ticks / static_cast<double>(timed);
            const double tolerance = areAlike ? 0.006 : 0.011 + 1.0 / static_cast<double>(timed);
            checkBlocks(found, descriptions, each / static_cast<double>(scale), tolerance);
        }
        checkEdits(found, inner(box, {"edts", "elst"}));
        return found;
    }

    /// Blocks by the table that says how many are in each chunk: first chunk, blocks, description.
    std::uint64_t blocksOf(const Mp4Box& runs, std::uint64_t chunks)
    {
        std::uint64_t sum = 0;
        const auto count = rows(runs, 4, 12);
        for (std::uint64_t i = 0; i < count; ++i)
        {
            const auto first = at(runs, 8 + 12 * i, 4);
            const auto next = std::min(i + 1 < count ? at(runs, 8 + 12 * (i + 1), 4) : chunks + 1, chunks + 1);
            if (first == 0 || next < first)
                return 0;
            sum += (next - first) * at(runs, 12 + 12 * i, 4);
        }
        return sum;
    }

    /// Whether the blocks of AAC and MP3, of `seconds` each, last as long as such do.
    void checkBlocks(Mp4Track& found, const Mp4Box& descriptions, double seconds, double tolerance)
    {
        const auto entry = descriptions.begin + 8;
        // The second version of QuickTime's descriptions has a rate of its own.
        const bool isSecond = file.number(entry + 16, 2, true) == 2;
        const double rate = isSecond ? std::bit_cast<double>(file.number(entry + 40, 8, true))
                                     : static_cast<double>(file.number(entry + 32, 2, true));
        if (rate >= 1.0 && rate < 1e6)
            found.sampleRate = static_cast<int>(rate);
        if (!file.has(entry + 4, "mp4a") || found.sampleRate == 0)
            return;
        // Frames at the rate that the description states: half of it or twice it with spectral band replication.
        constexpr std::array lengths{480.0, 512.0, 576.0, 960.0, 1024.0, 1152.0, 1920.0, 2048.0, 4096.0};
        const double frames = seconds * found.sampleRate;
        if (std::none_of(lengths.begin(), lengths.end(),
                         [&](double length) { return std::abs(frames - length) < tolerance * length; }))
            found.doubts.emplace_back("has a header whose times disagree with its blocks of sound; some may be missing "
                                      "or be at wrong times; get a complete copy");
    }

    void checkEdits(Mp4Track& found, const Mp4Box& list)
    {
        if (list.bytes() == 0)
            return;
        const bool isLong = at(list, 0, 1) == 1;
        const std::uint64_t width = isLong ? 8 : 4, row = 2 * width + 4;
        const std::uint64_t nothing = isLong ? ~std::uint64_t{0} : 0xFFFFFFFFu;
        double ticks = 0.0;
        for (std::uint64_t i = 0; i < rows(list, 4, row); ++i)
            if (at(list, 8 + row * i + width, width) != nothing)
                ticks += static_cast<double>(at(list, 8 + row * i, width));
        // 0 stands for all of it.
        if (ticks > 0.0)
            found.played = movieScale > 0 ? std::min(found.seconds, ticks / static_cast<double>(movieScale)) : 0.0;
    }

    ByteWindow file;
    std::uint64_t movieScale = 0;
};
} // namespace

std::vector<Mp4Track> mp4Tracks(std::FILE* file)
{
    return Mp4Reader(file).tracks();
}

} // namespace pacini
