#include "io/Mp4Tables.h"

#include "io/AudioHeader.h"
#include "io/ByteWindow.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

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
    Mp4Reader(std::FILE* opened, std::uint64_t start) : file(opened), begin(start) {}

    std::vector<Mp4Track> tracks()
    {
        const Mp4Box whole{begin, std::max(begin, file.size())};
        const auto movie = child(whole, "moov");
        if (!movie)
            return {};
        const auto fragments = children(whole, "moof");
        const bool isWhole = stopped + 8 > whole.end || areZeros(file, stopped, whole.end);
        const bool isFragmented = !fragments.empty() || child(*movie, "mvex");
        if (isFragmented && fragments.size() * 2 >= mostBoxes) // too many to look at
        {
            Mp4Track unchecked;
            unchecked.isUnchecked = true;
            return std::vector<Mp4Track>(children(*movie, "trak").size(), unchecked);
        }
        const auto header = child(*movie, "mvhd");
        movieScale = header ? timeScale(*header) : 0;
        isPrimingTold = file.find("iTunSMPB", movie->begin, movie->end) < movie->end;
        std::vector<Mp4Track> all;
        for (const Mp4Box& box : children(*movie, "trak"))
            all.push_back(isFragmented ? fragmentedTrack(box, *movie, fragments, isWhole) : track(box));
        if (isFragmented)
            checkFragments(all, *movie, fragments);
        if (children(whole, "moov").size() > 1)
            for (Mp4Track& one : all)
                one.doubts.emplace_back("has another film behind it, which is left out; save it as a file of its own");
        return all;
    }

private:
    /// Whether fragments are missing, by what is stated of all of them: how long they last, and their numbers where
    /// they have no times.
    void checkFragments(std::vector<Mp4Track>& all, const Mp4Box& movie, const std::vector<Mp4Box>& fragments)
    {
        const Mp4Box extent = inner(movie, {"mvex", "mehd"}), header = inner(movie, {"mvhd"});
        const auto ticks = std::max(at(extent, 4, at(extent, 0, 1) == 1 ? 8 : 4),
                                    at(header, 0, 1) == 1 ? at(header, 24, 8) : at(header, 16, 4));
        const bool isStated = ticks != 0xFFFFFFFFu && ticks != ~std::uint64_t{0};
        const double stated =
            isStated && movieScale > 0 ? static_cast<double>(ticks) / static_cast<double>(movieScale) : 0.0;
        constexpr double least = 0.3; // s: codecs are primed and filled up with less
        std::string doubt;
        if (stated > longest + least)
            doubt = fmt::format("has a header that states {:.3f} s, but fragments of {:.3f} s are there; get a "
                                "complete copy",
                                stated, longest);
        std::uint64_t lost = 0, before = 0;
        for (const Mp4Box& fragment : fragments)
        {
            const auto number = at(inner(fragment, {"mfhd"}), 4, 4);
            if (before > 0 && number > before + 1 && inner(fragment, {"traf", "tfdt"}).bytes() == 0)
                lost += number - before - 1;
            before = number;
        }
        if (doubt.empty() && lost > 0)
            doubt = fmt::format("lacks {} of its fragments by their numbers; get a complete copy", lost);
        for (Mp4Track& one : all)
            if (!doubt.empty() && one.seconds > 0.0)
                one.doubts.push_back(doubt);
    }

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
        stopped = offset;
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
        checkCodec(found, descriptions);
        checkEdits(found, inner(box, {"edts", "elst"}), scale);
        return found;
    }

    /// A track whose blocks are told of piece by piece, in front of each piece.
    Mp4Track fragmentedTrack(const Mp4Box& box, const Mp4Box& movie, const std::vector<Mp4Box>& fragments, bool isWhole)
    {
        Mp4Track found;
        const auto id = idOf(box);
        const auto scale = timeScale(inner(box, {"mdia", "mdhd"}));
        const Mp4Box tables = inner(box, {"mdia", "minf", "stbl"});
        const Mp4Box times = inner(tables, {"stts"});
        Run all;
        for (std::uint64_t i = 0; i < rows(times, 4, 8); ++i)
            if (const auto count = at(times, 8 + 8 * i, 4); count > 0)
                all.add(count, at(times, 12 + 8 * i, 4));
        std::set<std::uint64_t> known; // tracks of the movie
        for (const Mp4Box& one : children(movie, "trak"))
            known.insert(idOf(one));
        // Sound in front of all fragments, of which the movie does not tell: the first of them is damaged.
        bool agree = all.blocks > 0 || fragments.empty() ||
                     children({begin, std::max(begin, fragments.front().begin - 8)}, "mdat").empty();
        for (std::size_t i = 0; i < fragments.size(); ++i)
        {
            const auto until = i + 1 < fragments.size() ? fragments[i + 1].begin - 8 : file.size();
            agree = addFragment(all, fragments[i], movie, id, known, until) && agree;
        }
        const double seconds = scale > 0 ? all.ticks / static_cast<double>(scale) : 0.0;
        longest = std::max(longest, seconds);
        const Mp4Box handler = inner(box, {"mdia", "hdlr"});
        if (handler.bytes() < 12 || !file.has(handler.begin + 8, "soun"))
            return found;
        found.seconds = found.played = seconds;
        if (!isWhole || fragments.empty())
            found.doubts.emplace_back(
                "is damaged or cut off between its fragments; some of its sound may be missing; get "
                "a complete copy");
        else if (!agree)
            found.doubts.emplace_back("has fragments whose tables disagree with what is in them; some of its sound may "
                                      "be missing; get a complete copy");
        const Mp4Box descriptions = inner(tables, {"stsd"});
        if (all.blocks > 0 && scale > 0 && descriptions.bytes() >= 8 + 36)
        {
            // As a rule all blocks but the last are alike.
            const auto blocks = static_cast<double>(all.blocks);
            const bool areAlike = all.differing <= 1;
            checkBlocks(found, descriptions,
                        (areAlike ? static_cast<double>(all.each) : all.ticks / blocks) / static_cast<double>(scale),
                        areAlike ? 0.006 : 0.011 + 1.0 / blocks);
        }
        checkCodec(found, descriptions);
        checkEdits(found, inner(box, {"edts", "elst"}), scale);
        return found;
    }

    /// Blocks of one track.
    struct Run
    {
        std::uint64_t blocks = 0;
        double ticks = 0.0;
        std::uint64_t bytes = 0;
        bool areSized = true;        ///< all of them state how many bytes they have
        bool isWhole = true;         ///< their tables have as many rows as they state
        std::uint64_t each = 0;      ///< ticks of the first block
        std::uint64_t differing = 0; ///< blocks of other lengths than the first

        void add(std::uint64_t count, std::uint64_t length)
        {
            each = blocks == 0 ? length : each;
            differing += length == each ? 0 : count;
            blocks += count;
            ticks += static_cast<double>(count) * static_cast<double>(length);
        }
    };

    /// The number that a track has in its movie.
    std::uint64_t idOf(const Mp4Box& track)
    {
        const Mp4Box header = inner(track, {"tkhd"});
        return at(header, at(header, 0, 1) == 1 ? 20 : 12, 4);
    }

    /// Adds the blocks of track `id` in a fragment to `all`; whether it tells of all that lies between it and `until`.
    bool addFragment(Run& all, const Mp4Box& fragment, const Mp4Box& movie, std::uint64_t id,
                     const std::set<std::uint64_t>& known, std::uint64_t until)
    {
        const auto pieces = children(fragment, "traf");
        bool isWhole = !pieces.empty() && stopped == fragment.end;
        std::uint64_t told = 0;
        bool areSized = true;
        for (const Mp4Box& piece : pieces)
        {
            constexpr std::uint64_t isEmpty = 0x10000;
            const Mp4Box header = inner(piece, {"tfhd"});
            const auto owner = at(header, 4, 4);
            const Run run = runOf(piece, header, movie);
            isWhole = isWhole && run.isWhole && known.contains(owner) &&
                      (run.blocks > 0 || (at(header, 1, 3) & isEmpty) != 0);
            told += run.bytes;
            areSized = areSized && run.areSized;
            if (owner != id || run.blocks == 0)
                continue;
            all.each = all.blocks == 0 ? run.each : all.each;
            all.differing += run.each == all.each ? run.differing : run.blocks;
            all.blocks += run.blocks;
            all.ticks += run.ticks;
        }
        std::uint64_t there = 0;
        for (const Mp4Box& data : children({fragment.end, until}, "mdat"))
            there += data.bytes();
        return isWhole && (!areSized || told == there);
    }

    /// The blocks that a fragment tells of one track.
    Run runOf(const Mp4Box& piece, const Mp4Box& header, const Mp4Box& movie)
    {
        constexpr std::uint64_t hasBase = 1, hasDescription = 2, hasDuration = 8, hasSize = 16;
        std::uint64_t usual = 0, size = 0; // ticks and bytes of a block, where nothing else is stated
        for (const Mp4Box& defaults : children(inner(movie, {"mvex"}), "trex"))
            if (at(defaults, 4, 4) == at(header, 4, 4))
            {
                usual = at(defaults, 12, 4);
                size = at(defaults, 16, 4);
            }
        const auto flags = at(header, 1, 3);
        std::uint64_t place = 8 + ((flags & hasBase) != 0 ? 8u : 0u) + ((flags & hasDescription) != 0 ? 4u : 0u);
        if ((flags & hasDuration) != 0)
            usual = at(header, std::exchange(place, place + 4), 4);
        if ((flags & hasSize) != 0)
            size = at(header, place, 4);
        Run all;
        for (const Mp4Box& run : children(piece, "trun"))
        {
            // An offset of the data, flags of the first block, then up to four numbers of each block.
            const auto what = at(run, 1, 3);
            const auto first = 8 + ((what & 1u) != 0 ? 4u : 0u) + ((what & 4u) != 0 ? 4u : 0u);
            const auto count = std::min(at(run, 4, 4), mostRows);
            std::uint64_t bytes = 0;
            for (const std::uint64_t one : {0x100u, 0x200u, 0x400u, 0x800u})
                bytes += (what & one) != 0 ? 4u : 0u;
            const bool isTimed = (what & 0x100u) != 0, isSized = (what & 0x200u) != 0;
            const auto there = bytes > 0 && run.bytes() > first ? (run.bytes() - first) / bytes : 0;
            all.areSized = all.areSized && (isSized || size > 0);
            all.isWhole = all.isWhole && (bytes == 0 || count == there);
            if (!isTimed && count > 0)
                all.add(count, usual);
            if (!isSized)
                all.bytes += count * size;
            for (std::uint64_t i = 0; (isTimed || isSized) && i < std::min(count, there); ++i)
            {
                if (isTimed)
                    all.add(1, at(run, first + i * bytes, 4));
                if (isSized)
                    all.bytes += at(run, first + i * bytes + (isTimed ? 4 : 0), 4);
            }
        }
        return all;
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
        found.blockSeconds = seconds;
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

    /// What a codec's description says besides.
    void checkCodec(Mp4Track& found, const Mp4Box& descriptions)
    {
        constexpr std::uint64_t gainPlace = 12; // behind version, channels, frames left out and rate
        const auto opus = file.find("dOps", descriptions.begin, descriptions.end);
        if (opus < descriptions.end)
            found.opusGain = static_cast<std::int16_t>(file.number(opus + gainPlace, 2, true));
        found.isPrimingTold = isPrimingTold;
    }

    void checkEdits(Mp4Track& found, const Mp4Box& list, std::uint64_t scale)
    {
        if (list.bytes() == 0)
            return;
        found.isPrimingTold = true;
        const bool isLong = at(list, 0, 1) == 1;
        const std::uint64_t width = isLong ? 8 : 4, row = 2 * width + 4;
        const std::uint64_t nothing = isLong ? ~std::uint64_t{0} : 0xFFFFFFFFu;
        double ticks = 0.0;
        std::optional<std::uint64_t> skipped; // ticks of the media before the first that is played
        for (std::uint64_t i = 0; i < rows(list, 4, row); ++i)
            if (const auto start = at(list, 8 + row * i + width, width); start != nothing)
            {
                ticks += static_cast<double>(at(list, 8 + row * i, width));
                skipped = std::min(start, skipped.value_or(start));
            }
        if (scale > 0)
            found.played -=
                std::min(found.played, static_cast<double>(skipped.value_or(0)) / static_cast<double>(scale));
        // 0 stands for all of it.
        if (ticks > 0.0)
            found.played = movieScale > 0 ? std::min(found.played, ticks / static_cast<double>(movieScale)) : 0.0;
    }

    ByteWindow file;
    std::uint64_t begin = 0;
    std::uint64_t movieScale = 0;
    bool isPrimingTold = false; ///< by iTunes
    double longest = 0.0;       ///< s of the longest track in fragments
    std::uint64_t stopped = 0;  ///< where the boxes ended that were looked at last
};
} // namespace

std::vector<Mp4Track> mp4Tracks(std::FILE* file, std::uint64_t begin)
{
    return Mp4Reader(file, begin).tracks();
}

} // namespace pacini
