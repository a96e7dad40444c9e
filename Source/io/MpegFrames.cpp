#include "io/MpegFrames.h"

#include "io/SoundTags.h"

#include <algorithm>
#include <span>

namespace pacini
{

namespace
{
// Sources: ISO/IEC 11172-3:1993, 2.4.2.3, and ISO/IEC 13818-3:1998, 2.4.2.3 (lower rates; those of "MPEG 2.5" are half
// of them); Xing's header as LAME's "Mp3 Info Tag revision 1 Specification" describes it.
constexpr int bitRates[5][15] = {
    {0, 32, 64, 96, 128, 160, 192, 224, 256, 288, 320, 352, 384, 416, 448}, // MPEG 1, layer I
    {0, 32, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 384},    // MPEG 1, layer II
    {0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320},     // MPEG 1, layer III
    {0, 32, 48, 56, 64, 80, 96, 112, 128, 144, 160, 176, 192, 224, 256},    // MPEG 2, layer I
    {0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160},         // MPEG 2, layers II and III
};
constexpr int sampleRates[3] = {44100, 48000, 32000};
constexpr std::size_t headerBytes = 4;
constexpr std::size_t mostRuns = 1000;

struct Frame
{
    std::uint64_t bytes = 0;
    std::uint64_t samples = 0;
    int layer = 0;
    int sampleRate = 0;
    bool mono = false;
    bool lower = false; ///< MPEG 2 and 2.5

    /// Whether one decoder goes on from this to `next`.
    [[nodiscard]] bool isLike(const Frame& next) const noexcept
    {
        return layer == next.layer && sampleRate == next.sampleRate && mono == next.mono;
    }
    [[nodiscard]] std::size_t sideBytes() const noexcept { return lower ? (mono ? 9u : 17u) : (mono ? 17u : 32u); }
};

/// The frame whose header begins `bytes`; nothing for other bytes and for frames of free length.
std::optional<Frame> frameOf(std::span<const unsigned char> bytes)
{
    if (bytes.size() < headerBytes || bytes[0] != 0xFF || (bytes[1] & 0xE0u) != 0xE0u)
        return {};
    const unsigned version = (bytes[1] >> 3u) & 3u; // 0: 2.5, 2: 2, 3: 1
    const unsigned layerBits = (bytes[1] >> 1u) & 3u;
    const unsigned rate = bytes[2] >> 4u;
    const unsigned frequency = (bytes[2] >> 2u) & 3u;
    if (version == 1 || layerBits == 0 || rate == 0 || rate == 15 || frequency == 3)
        return {};
    Frame frame;
    frame.layer = static_cast<int>(4 - layerBits);
    frame.lower = version != 3;
    frame.mono = bytes[3] >> 6u == 3;
    frame.sampleRate = sampleRates[frequency] / (version == 3 ? 1 : version == 2 ? 2 : 4);
    const int table = frame.lower ? (frame.layer == 1 ? 3 : 4) : frame.layer - 1;
    const int bits = bitRates[table][rate] * 1000;
    const int padding = (bytes[2] >> 1u) & 1;
    const bool half = frame.lower && frame.layer == 3;
    frame.samples = frame.layer == 1 ? 384 : half ? 576 : 1152;
    frame.bytes = static_cast<std::uint64_t>(frame.layer == 1 ? (12 * bits / frame.sampleRate + padding) * 4
                                                              : (half ? 72 : 144) * bits / frame.sampleRate + padding);
    return frame.bytes >= headerBytes ? std::optional(frame) : std::nullopt;
}

std::optional<Frame> frameAt(ByteWindow& file, std::uint64_t offset)
{
    return frameOf(file.at(offset, headerBytes));
}

/// Whether the frame at `offset` is followed by two more like it, by the end or by a tag: four bytes alone may be
/// chance.
bool isConfirmed(ByteWindow& file, std::uint64_t offset, Frame frame, std::uint64_t end)
{
    for (int i = 0; i < 2; ++i)
    {
        offset += frame.bytes;
        if (offset == end || (i > 0 && offset > end) || tagBytesAt(file, offset) > 0)
            return true;
        const auto next = offset < end ? frameAt(file, offset) : std::nullopt;
        if (!next || !frame.isLike(*next))
            return false;
        frame = *next;
    }
    return true;
}

/// Where frames or a tag begin next from `offset` on, or `end`.
std::uint64_t findFrames(ByteWindow& file, std::uint64_t offset, std::uint64_t end)
{
    while (offset < end)
    {
        const auto piece = file.at(offset, static_cast<std::size_t>(std::min<std::uint64_t>(end - offset, 4096)));
        const auto mark = std::find_if(piece.begin(), piece.end(),
                                       [](unsigned char c) { return c == 0xFF || c == 'I' || c == 'A' || c == 'T'; });
        const auto passed = static_cast<std::uint64_t>(mark - piece.begin());
        const bool found = mark != piece.end();
        if (piece.empty())
            return end;
        offset += passed;
        if (!found)
            continue;
        if (const auto frame = frameAt(file, offset); frame && isConfirmed(file, offset, *frame, end))
            return offset;
        const auto tag = file.has(offset, "ID3") || file.has(offset, "APETAGEX") ? tagBytesAt(file, offset) : 0;
        if (tag > 0 && offset + tag <= end)
            return offset;
        ++offset;
    }
    return end;
}

/// The number of frames that the header of Xing's kind in the frame at `offset` states.
struct Count
{
    std::uint64_t field = 0; ///< where it is; 0: in a header of another kind, or nowhere
    std::optional<std::uint64_t> frames;
};

std::optional<Count> countIn(ByteWindow& file, std::uint64_t offset, const Frame& frame)
{
    if (frame.layer != 3)
        return {};
    for (const std::uint64_t checksum : {0u, 2u})
    {
        const auto id = offset + headerBytes + checksum + frame.sideBytes();
        if (id + 12 > offset + frame.bytes)
            continue;
        if (file.has(id, "Xing") || file.has(id, "Info"))
        {
            if ((file.number(id + 4, 4, true) & 1u) == 0)
                return Count{};
            return Count{id + 8, file.number(id + 8, 4, true)};
        }
    }
    // Fraunhofer's header is 32 bytes behind that of the frame; the number of frames is 14 bytes further.
    if (const auto id = offset + headerBytes + 32; id + 18 <= offset + frame.bytes && file.has(id, "VBRI"))
        return Count{0, file.number(id + 14, 4, true)};
    return {};
}
} // namespace

std::vector<MpegRun> mpegRuns(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    std::vector<MpegRun> runs;
    Frame last;
    bool isRunning = false; ///< `last` is right before
    std::uint64_t lastStart = begin;
    std::uint64_t skipped = 0;
    auto offset = begin;
    const auto isNewRun = [&](const Frame& frame, const std::optional<Count>& count)
    {
        return !isRunning || !last.isLike(frame) || count.has_value();
    };
    while (offset < end)
    {
        const auto frame = frameAt(file, offset);
        const bool known = frame && isRunning && last.isLike(*frame);
        if (frame && (known || isConfirmed(file, offset, *frame, end)))
        {
            if (offset + frame->bytes > end)
            {
                if (isRunning)
                    runs.back().rest = end - offset;
                return runs;
            }
            const auto count = countIn(file, offset, *frame);
            if (isNewRun(*frame, count))
            {
                if (runs.size() >= mostRuns)
                    break;
                MpegRun run;
                run.begin = count && count->field == 0 ? offset + frame->bytes : offset;
                run.end = run.begin;
                run.sampleRate = frame->sampleRate;
                run.skipped = skipped;
                if (count)
                {
                    run.countField = count->field;
                    run.statedFrames = count->frames;
                }
                skipped = 0;
                runs.push_back(run);
            }
            MpegRun& run = runs.back();
            if (!count)
            {
                ++run.frames;
                run.samples += frame->samples;
            }
            lastStart = offset;
            last = *frame;
            isRunning = true;
            offset += frame->bytes;
            run.end = offset;
            continue;
        }
        if (const auto tag = tagBytesAt(file, offset); tag > 0 && tag <= end - offset)
        {
            offset += tag;
            isRunning = false;
            continue;
        }
        // The size of the frame before may be what is damaged.
        const auto from = isRunning ? lastStart + headerBytes : offset + 1;
        const auto found = findFrames(file, from, end);
        skipped += found > offset ? found - offset : 0;
        if (isRunning && found < offset)
            runs.back().end = found;
        offset = found;
        isRunning = false;
    }
    if (!runs.empty() && skipped > 0)
    {
        MpegRun gap;
        gap.begin = gap.end = end;
        gap.sampleRate = runs.back().sampleRate;
        gap.skipped = skipped;
        runs.push_back(gap);
    }
    return runs;
}

} // namespace pacini
