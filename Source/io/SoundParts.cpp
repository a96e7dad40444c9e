#include "io/SoundParts.h"

#include "io/AudioHeader.h"
#include "io/ByteWindow.h"
#include "io/FilmSound.h"
#include "io/MpegFrames.h"
#include "io/OggPages.h"
#include "io/OggTimes.h"
#include "io/SampleWords.h"
#include "io/SoundCodec.h"
#include "io/SoundLengths.h"
#include "io/SoundTags.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::uint64_t largest32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t mostParts = 1000;

bool hasMpegSync(ByteWindow& file, std::uint64_t offset)
{
    const auto bytes = file.at(offset, 2);
    return bytes.size() == 2 && bytes[0] == 0xFF && (bytes[1] & 0xE0u) == 0xE0u;
}

class Planner
{
public:
    explicit Planner(std::FILE* source) : opened(source), file(source), end(file.size()) {}

    std::vector<SoundPart> run()
    {
        if (end == 0)
            return {};
        const std::uint64_t tagged = behindTags();
        const std::uint64_t first = behindJunk(tagged);
        std::optional<std::uint64_t> begin = first;
        while (begin && parts.size() < mostParts)
            begin = add(*begin);
        if (!parts.empty())
            parts.front().skippedBytes += first - tagged;
        if (begin && !parts.empty())
            parts.back().leftOutBytes += end - *begin;
        return std::move(parts);
    }

    SoundPart flac(std::uint64_t begin)
    {
        SoundPart part;
        part.begin = begin;
        part.end = endBeforeTags(file, begin, end);
        hideMetadata(part);
        // STREAMINFO comes first; the lowest 36 bits before its checksum count the frames, 0 if they are not known (RFC
        // 9639, 8.2). libsndfile reads no more than they say, so it is not told.
        const auto type = file.at(begin + 4, 1);
        const auto count = file.at(begin + 21, 1);
        if (type.empty() || count.empty() || (type[0] & 0x7Fu) != 0)
            return part;
        const unsigned char high = count[0];
        const auto frames = (std::uint64_t{high & 0x0Fu} << 32u) | file.number(begin + 22, 4, true);
        if (frames == 0)
        {
            part.promisedFrames = numberedFlacFrames(file, begin, part.end);
            part.isNumbered = true;
            return part;
        }
        part.promisedFrames = frames;
        part.patches.push_back({begin + 21, static_cast<char>(high & 0xF0u) + std::string(4, '\0')});
        return part;
    }

private:
    /// Lets libsndfile pass over all blocks of metadata but the first: its decoder refuses the whole sound for a
    /// picture or comments that are damaged.
    void hideMetadata(SoundPart& part)
    {
        constexpr unsigned last = 0x80, padding = 1;
        constexpr int most = 1000;
        auto offset = part.begin + 4;
        for (int block = 0; block < most && offset + 4 <= part.end; ++block)
        {
            const auto type = file.number(offset, 1, true);
            if ((type & 0x7Fu) > padding)
                part.patches.push_back({offset, std::string(1, static_cast<char>((type & last) | padding))});
            if ((type & last) != 0)
                return;
            offset += 4 + file.number(offset + 1, 3, true);
        }
    }

    /// Where the first sound begins. libsndfile skips tags only in front of some formats.
    std::uint64_t behindTags()
    {
        std::uint64_t begin = 0;
        for (;;)
        {
            const bool tagged = file.has(begin, "ID3") || file.has(begin, "APETAGEX");
            const auto tag = tagged ? tagBytesAt(file, begin) : 0;
            if (tag == 0)
                break;
            const auto next = begin + tag;
            if (next < end && (startsSound(file, next) || hasMpegSync(file, next) || tagBytesAt(file, next) > 0))
            {
                begin = next;
                continue;
            }
            return next < end && isFilm(opened, next) ? next : searched(begin);
        }
        return begin;
    }

    /// Where a sound begins behind a few bytes of anything else: heads of servers' answers, filling. `begin` itself
    /// where there is none.
    std::uint64_t behindJunk(std::uint64_t begin)
    {
        constexpr std::uint64_t reach = 4096, window = 65536;
        constexpr std::size_t fewestFrames = 8; // which chance does not make
        if (startsSound(file, begin) || hasMpegSync(file, begin) || isFilm(opened, begin))
            return begin;
        const auto from = behindZeros(begin);
        const auto last = std::min(end, from + reach);
        if (const auto first = firstSound(from, last); first < last)
            return first;
        const auto runs = mpegRuns(file, from, std::min(end, from + window));
        const bool found = !runs.empty() && runs.front().begin < last && runs.front().frames >= fewestFrames;
        return found ? runs.front().begin : begin;
    }

    /// Where something else than zeros begins: files that were fetched in pieces may lack the first.
    std::uint64_t behindZeros(std::uint64_t begin)
    {
        for (auto offset = begin; offset < end;)
        {
            const auto piece = file.at(offset, static_cast<std::size_t>(std::min<std::uint64_t>(end - offset, 4096)));
            const auto found = std::find_if(piece.begin(), piece.end(), [](unsigned char c) { return c != 0; });
            if (found != piece.end())
                return offset + static_cast<std::uint64_t>(found - piece.begin());
            if (piece.empty())
                break;
            offset += piece.size();
        }
        return begin;
    }

    /// Where the first sound of a known kind begins from one place to another; the latter if there is none.
    std::uint64_t firstSound(std::uint64_t from, std::uint64_t last)
    {
        auto first = last;
        for (const std::string_view id :
             {"RIFF", "RIFX", "RF64", "BW64", "FORM", "caff", "riff", ".snd", "dns.", "fLaC", "OggS"})
            for (auto place = file.find(id, from, first); place < first; place = file.find(id, place + 1, first))
                if (startsSound(file, place))
                {
                    first = place;
                    break;
                }
        return first;
    }

    /// Where a sound begins in or behind a tag whose size is wrong.
    std::uint64_t searched(std::uint64_t tag)
    {
        constexpr std::uint64_t reach = 16u << 20u;
        const auto last = std::min(end, tag + reach);
        if (const auto first = firstSound(tag, last); first < last)
            return first;
        const auto runs = mpegRuns(file, tag + 10, end);
        return runs.empty() ? tag : runs.front().begin;
    }

    /// Adds what begins there; where the next begins, if one does.
    std::optional<std::uint64_t> add(std::uint64_t begin)
    {
        if (file.has(begin, "fLaC"))
        {
            parts.push_back(flac(begin));
            return {};
        }
        if (file.has(begin, "OggS"))
            return addOgg(begin), std::nullopt;
        if (hasMpegSync(file, begin) && addMpeg(begin, endBeforeTags(file, begin, end)))
            return {};
        return addChunked(begin);
    }

    /// A sound of chunks, or of a format that is not looked into.
    std::optional<std::uint64_t> addChunked(std::uint64_t begin)
    {
        parts.emplace_back().begin = begin;
        parts.back().end = end;
        const auto found = findAudioChunk(file, begin, end);
        if (!found)
        {
            // libsndfile reads a CAF of any version.
            if (startsSound(file, begin) || file.has(begin, "caff"))
                parts.back().presentBytes = end - begin; // at most
            else if (const auto stated = statedSound(file, begin, end))
                addStated(parts.back(), *stated);
            return {};
        }
        later.reset();
        auto next = addAudio(parts.back(), *found);
        if (soundCodecOf(file, begin, end) == SoundCodec::mpeg)
        {
            addMpegInside(*found, begin);
            parts.back().leftOutBytes += later ? end - later->start : 0;
            return next;
        }
        const auto first = parts.size() - 1;
        parts.back().statedFrameBytes = frameBytesOf(file, begin, found->sizeField);
        parts.back().hasOtherFormat = hasOtherFormat(begin, found->sizeField);
        parts.back().silence = found->silence;
        std::vector<AudioChunk> chunks{*found};
        while (const auto chunk = std::exchange(later, std::nullopt))
        {
            if (parts.size() == mostParts)
            {
                parts.back().leftOutBytes += end - chunk->start;
                break;
            }
            SoundPart& part = parts.emplace_back();
            part.begin = begin;
            part.end = end;
            part.isContinued = true;
            part.silence = chunk->silence;
            next = addAudio(part, *chunk);
            chunks.push_back(*chunk);
        }
        std::vector<ByteRange> audio;
        for (std::size_t i = 0; i < chunks.size(); ++i)
            audio.push_back({chunks[i].start, chunks[i].start + parts[first + i].presentBytes});
        const auto reading = sampleReading(file, begin, found->sizeField, audio);
        parts[first].sampleWarning = reading.warning;
        if (found->rightOffset > 0)
            parts[first].offsetWarning =
                fmt::format("has a header by which its sound begins within its text; it is read from byte {} on, where "
                            "the text ends; save it anew",
                            found->rightOffset);
        for (std::size_t i = 0; i < chunks.size(); ++i)
        {
            SoundPart& part = parts[first + i];
            part.gain = reading.gain;
            part.patches.insert(part.patches.end(), reading.patches.begin(), reading.patches.end());
            addHeader(part, chunks[i]);
        }
        return next;
    }

    /// A length that only the header knows.
    static void addStated(SoundPart& part, const StatedSound& stated)
    {
        constexpr std::uint64_t filling = 64; // bytes, with the end mark of a VOC
        if (stated.behind > filling)
        {
            part.leftOutBytes = stated.behind;
            part.end -= stated.behind;
        }
        if (stated.present >= stated.promised)
            return;
        part.promisedBytes = stated.promised;
        part.presentBytes = stated.present;
        part.isWhole = false;
    }

    /// Whether a WAV or W64 says twice how its samples look, and each time otherwise.
    bool hasOtherFormat(std::uint64_t begin, std::uint64_t audio)
    {
        constexpr std::uint64_t largest = 4096;
        std::optional<std::string> first;
        for (const FileChunk& chunk : chunksOf(file, begin, audio, 0))
        {
            if (!file.has(chunk.offset, "fmt "))
                continue;
            auto content = bytesAt(chunk.content, std::min(chunk.bytes, largest));
            if (first && content != *first)
                return true;
            first = std::move(content);
        }
        return false;
    }

    /// libsndfile reads as many cues as are stated, though they lead it into the audio.
    void limitCues(SoundPart& part, std::uint64_t audio, bool bigEndian)
    {
        constexpr std::uint64_t cueBytes = 24;
        for (const FileChunk& chunk : chunksOf(file, part.begin, audio, 0))
            if (file.has(chunk.offset, "cue ") && chunk.bytes >= 4)
                if (const auto there = (chunk.bytes - 4) / cueBytes; file.number(chunk.content, 4, bigEndian) > there)
                    part.patches.push_back({chunk.content, numberBytes(there, 4, bigEndian)});
    }

    /// Lets a file begin later whose audio chunk libsndfile does not find: header and format are read in front of it.
    void addHeader(SoundPart& part, const AudioChunk& chunk)
    {
        if (chunk.wrongOffset > 0)
            part.patches.push_back({chunk.wrongOffset, numberBytes(chunk.rightOffset, 4, chunk.bigEndian)});
        const auto* layout = chunk.layout;
        if (layout && layout->fileId == "FORM")
            for (const FileChunk& piece : chunksOf(file, part.begin, end, 0))
                if (const auto bits = file.has(piece.offset, "COMM") ? bitsOfAifcCodec(file, piece) : std::nullopt)
                    part.patches.push_back({piece.content + 6, numberBytes(*bits, 2, true)});
        if (!layout)
            return;
        const auto audio = chunk.sizeField - layout->idBytes;
        if (layout->isWave())
            limitCues(part, audio, layout->bigEndian);
        if (!chunk.isHidden)
            return;
        constexpr std::string_view needed[] = {"fmt ", "fact", "FVER", "COMM", "desc", "chan"};
        constexpr std::uint64_t largest = 4096;
        const auto patched = [&](std::uint64_t offset, std::uint64_t count)
        {
            auto bytes = bytesAt(offset, count);
            for (const BytePatch& patch : part.patches)
                if (patch.offset >= offset && patch.offset + patch.bytes.size() <= offset + bytes.size())
                    bytes.replace(static_cast<std::size_t>(patch.offset - offset), patch.bytes.size(), patch.bytes);
            return bytes;
        };
        auto header = patched(part.begin, layout->firstChunk);
        std::set<std::string_view> taken;
        const auto take = [&](std::uint64_t chunksEnd, std::uint64_t audioEnd)
        {
            for (const FileChunk& piece : chunksOf(file, part.begin, chunksEnd, audioEnd))
                for (const std::string_view id : needed)
                    if (piece.bytes <= largest && file.has(piece.offset, id) && taken.insert(id).second)
                    {
                        header += patched(piece.offset, piece.content + piece.bytes - piece.offset);
                        header.append((layout->alignment - header.size() % layout->alignment) % layout->alignment,
                                      '\0');
                    }
        };
        take(audio, 0);
        if (layout->isWave() && !taken.contains("fmt "))
            take(end, chunk.start + part.presentBytes);
        part.outerBegin = std::exchange(part.begin, audio);
        part.head = std::move(header);
    }

    std::string bytesAt(std::uint64_t offset, std::uint64_t count)
    {
        const auto bytes = file.at(offset, static_cast<std::size_t>(count));
        return {bytes.begin(), bytes.end()};
    }

    /// Puts the MPEG audio inside a file of chunks, which begins at `begin`, in the place of that file.
    void addMpegInside(const AudioChunk& chunk, std::uint64_t begin)
    {
        const SoundPart whole = std::move(parts.back());
        const auto count = parts.size();
        parts.pop_back();
        if (!addMpeg(chunk.start, chunk.start + whole.presentBytes))
        {
            parts.push_back(whole);
            return;
        }
        // W64 and some writers of WAV fill their chunks up.
        constexpr std::uint64_t mostPadding = 8;
        const auto audioEnd = chunk.start + whole.presentBytes;
        if (const SoundPart& last = parts.back(); parts.size() > count && last.end <= last.begin &&
                                                  last.skippedBytes <= mostPadding &&
                                                  areZeros(file, audioEnd - last.skippedBytes, audioEnd))
            parts.pop_back();
        for (auto i = count - 1; i < parts.size(); ++i)
            parts[i].outerBegin = begin;
        parts.back().leftOutBytes = whole.leftOutBytes;
        SoundPart& first = parts[count - 1];
        first.promisedBytes = whole.promisedBytes;
        first.presentBytes = whole.presentBytes;
        first.isWhole = whole.isWhole;
    }

    std::optional<std::uint64_t> addAudio(SoundPart& part, const AudioChunk& chunk)
    {
        const auto soundEnd = endBeforeTags(file, std::min(chunk.start, end), end);
        if (!chunk.promise)
        {
            setEnd(part, chunk, beforeLastChunks(chunk, soundEnd));
            return {};
        }
        const auto promise = *chunk.promise;
        if (promise > chunk.present(end))
        {
            part.promisedBytes = promise;
            part.isWhole = isWholeAnyway(chunk, part.begin);
            const auto audioEnd = part.isWhole ? beforeLastChunks(chunk, soundEnd) : end;
            part.presentBytes = chunk.present(audioEnd);
            if (part.isWhole || isRenamed(chunk))
                setEnd(part, chunk, audioEnd);
            return {};
        }
        const auto stop = chunk.start + promise;
        part.presentBytes = promise;
        // libsndfile takes what follows the audio of a W64 for more of it.
        if (isRenamed(chunk) || (chunk.layout && chunk.layout->fileId == "riff" && stop < end))
            setEnd(part, chunk, stop);
        return addBehind(part, chunk, stop, std::max(stop, soundEnd));
    }

    /// Looks at what lies between the stated end of a sound and that of the file.
    std::optional<std::uint64_t> addBehind(SoundPart& part, const AudioChunk& chunk, std::uint64_t stop,
                                           std::uint64_t soundEnd)
    {
        if (stop >= soundEnd)
            return {};
        // Odd sizes are followed by a byte of padding, which some writers leave out; W64 fills up to 8 bytes.
        const std::uint64_t padding = chunk.layout ? chunk.layout->alignment : 1;
        for (std::uint64_t pad = 0; pad < padding; ++pad)
        {
            // What is no padding and holds a frame is sound.
            if (pad > 1 && !areZeros(file, stop, std::min(stop + pad, soundEnd)) &&
                pad >= frameBytesOf(file, part.begin, chunk.sizeField))
                break;
            const auto behind = std::min(stop + pad, soundEnd);
            std::optional<std::uint64_t> tag;
            const auto next = chunk.layout ? endOfChunks(file, *chunk.layout, behind, soundEnd, &tag) : std::nullopt;
            if (next && *next >= soundEnd)
            {
                part.end = tag.value_or(part.end);
                return {};
            }
            if (next || startsSound(file, behind))
            {
                part.end = next.value_or(behind);
                return part.end;
            }
            if (const auto tagged = behindLastTags(behind, soundEnd))
            {
                part.end = behind;
                return *tagged < soundEnd ? tagged : std::nullopt;
            }
            if (chunk.layout && (later = nextAudioChunk(file, *chunk.layout, part.begin, behind, soundEnd)))
            {
                setEnd(part, chunk, stop);
                return {};
            }
        }
        constexpr std::uint64_t mostPadding = 65536; // the largest blocks that discs are divided in
        if (*chunk.promise > 0 && soundEnd - stop <= mostPadding && areZeros(file, stop, soundEnd))
        {
            part.leftOutBytes = soundEnd - stop;
            return {};
        }
        // A few bytes that make no whole frame, behind a stated end that does.
        constexpr std::uint64_t fewBytes = 64;
        const auto frame = soundEnd - stop < fewBytes ? frameBytesOf(file, part.begin, chunk.sizeField) : 0;
        if (frame > 1 && *chunk.promise > 0 && *chunk.promise % frame == 0 && (soundEnd - stop) % frame != 0)
        {
            setEnd(part, chunk, stop);
            part.leftOutBytes = soundEnd - stop;
            return {};
        }
        const auto audioEnd = beforeLastChunks(chunk, soundEnd);
        part.promisedBytes = chunk.promise;
        setEnd(part, chunk, audioEnd);
        return {};
    }

    /// The end, or where another sound begins, behind nothing but tags; nothing where something else lies there.
    std::optional<std::uint64_t> behindLastTags(std::uint64_t offset, std::uint64_t soundEnd)
    {
        const auto begin = offset;
        while (offset < soundEnd)
        {
            if (offset > begin && startsSound(file, offset))
                return offset;
            const auto tag = tagBytesAt(file, offset);
            if (tag == 0 || tag > soundEnd - offset)
                return {};
            offset += tag;
        }
        return offset;
    }

    /// Whether a header that promises more than the file has is merely wrong: by its own length or a few bytes, by
    /// twice, or because the size of the file that it states as well is right.
    bool isWholeAnyway(const AudioChunk& chunk, std::uint64_t begin)
    {
        constexpr std::uint64_t fewBytes = 64;
        const auto present = chunk.present(end);
        const auto excess = *chunk.promise - present;
        if (present == 0)
            return false;
        if (excess <= fewBytes || excess == chunk.start - begin ||
            (*chunk.promise + fewBytes >= 2 * present && *chunk.promise <= 2 * present + fewBytes))
            return true;
        const auto* layout = chunk.layout;
        if (!layout || layout->sizeBytes != 4 || layout->fileId == "RF64" || layout->fileId == "BW64")
            return false;
        const auto whole = file.number(begin + 4, 4, layout->bigEndian) + 8;
        return whole == end - begin || whole + 1 == end - begin;
    }

    std::uint64_t beforeLastChunks(const AudioChunk& chunk, std::uint64_t soundEnd)
    {
        return chunk.layout ? startOfLastChunks(file, *chunk.layout, std::min(chunk.start, soundEnd), soundEnd)
                            : soundEnd;
    }

    /// Whether libsndfile must be told of another format: it does not know BW64, and not which of the sizes of an RF64
    /// is right.
    static bool isRenamed(const AudioChunk& chunk)
    {
        return chunk.layout && chunk.layout->isWave() && chunk.layout->fileId != "RIFF";
    }

    /// Lets the audio, and the file with it, end at `audioEnd`.
    void setEnd(SoundPart& part, const AudioChunk& chunk, std::uint64_t audioEnd)
    {
        part.end = audioEnd;
        part.presentBytes = chunk.present(audioEnd);
        part.patches.clear();
        auto size = chunk.present(audioEnd) + chunk.sizeExtra;
        const bool fits = size < largest32;
        const auto* layout = chunk.layout;
        if (!layout)
        {
            part.patches.push_back({chunk.sizeField, numberBytes(std::min(size, largest32), 4, chunk.bigEndian)});
            return;
        }
        if (layout->sizeBytes == 4 && layout->fileId != "FORM")
        {
            if (layout->isWave())
                part.patches.push_back({part.begin, "RIFF"});
            // libsndfile takes these two sizes for those of a file that was not closed, and reads it to its end.
            if (!fits)
            {
                part.patches.push_back({part.begin + 4, numberBytes(8, 4, layout->bigEndian)});
                size = 0;
            }
        }
        else if (layout->sizeBytes == 4 && !fits)
        {
            part.leftOutBytes = size - largest32;
            size = largest32;
        }
        part.patches.push_back({chunk.sizeField, numberBytes(size, layout->sizeBytes, layout->bigEndian)});
    }

    /// The streams of an Ogg file: each begins with one or more pages that say so (RFC 3533, 6).
    void addOgg(std::uint64_t begin)
    {
        constexpr unsigned beginsStream = 2, endsStream = 4;
        bool headers = false;
        std::uint64_t skipped = 0;
        std::uint64_t stream = 0, nextPage = 0;
        bool isSound = false;          // what `stream` is
        std::set<std::uint64_t> begun; // streams of the part
        for (auto offset = begin; offset < end;)
        {
            const auto bytes = oggPageBytes(file, offset);
            if (bytes == 0)
            {
                const auto tag = tagBytesAt(file, offset);
                const auto next = tag > 0 ? std::min(end, offset + tag) : file.find("OggS", offset + 1, end);
                if (tag == 0)
                    skipped += next - offset;
                offset = next;
                continue;
            }
            const auto flags = file.number(offset + 5, 1, true);
            const bool starts = (flags & beginsStream) != 0, ends = (flags & endsStream) != 0;
            if ((starts && !headers) || parts.empty())
            {
                if (isSound)
                    mendTimes(stream);
                if (parts.size() == mostParts)
                {
                    parts.back().leftOutBytes += end - offset;
                    return;
                }
                parts.emplace_back().begin = offset;
                isSound = false;
                begun.clear();
            }
            const bool beginsSound = starts && startsOggSound(offset);
            SoundPart& part = parts.back();
            // The first sound among streams that run side by side.
            if (part.begin == offset || (beginsSound && !isSound))
            {
                stream = file.number(offset + 14, 4, false);
                nextPage = file.number(offset + 18, 4, false);
                isSound = beginsSound;
                part.preSkip = opusNumber(offset, 10);
                part.opusGain = static_cast<std::int16_t>(opusNumber(offset, 16));
            }
            else if (beginsSound)
                ++part.streamsBeside;
            headers = starts;
            const auto serial = file.number(offset + 14, 4, false);
            if ((starts && begun.size() < mostParts) || part.begin == offset)
                begun.insert(serial);
            else if (!begun.contains(serial))
                part.skippedBytes += bytes; // of a stream that never began
            if (serial == stream)
            {
                const auto page = file.number(offset + 18, 4, false);
                part.lostPages += page > nextPage ? page - nextPage : 0;
                nextPage = page + 1;
                part.isUnended = !ends;
                // The time at the end of the page; all ones where no packet ends on it.
                if (const auto time = file.number(offset + 6, 8, false); time > 0 && time < std::uint64_t{1} << 62u)
                {
                    part.firstTime = part.firstTime == 0 ? time : std::min(part.firstTime, time);
                    part.lastTime = std::max(part.lastTime, time);
                }
            }
            part.skippedBytes += std::exchange(skipped, 0);
            offset += bytes;
            part.end = std::min(offset, end);
        }
        parts.back().skippedBytes += skipped;
        if (isSound)
            mendTimes(stream);
    }

    /// Takes the times of the last part, whose sound is `stream`, and lets it begin at 0 where it begins before it,
    /// which not all decoders honour.
    void mendTimes(std::uint64_t stream)
    {
        SoundPart& part = parts.back();
        const auto content = oggContent(file, part.begin, part.end, stream);
        part.framesLeftOut = content.leftOut;
        part.damagedPages = content.damagedPages;
        part.packetFrames = content.frames;
        part.lastRightTime = content.lastTime;
        auto shift = vorbisShift(file, part.begin, part.end, stream);
        if (shift.frames == 0)
            return;
        part.patches = std::move(shift.patches);
        if (shift.isEdit)
        {
            part.leadFrames = shift.frames;
            return;
        }
        part.shiftedFrames = shift.frames;
        part.firstTime += shift.frames;
        part.lastTime += shift.frames;
    }

    /// A number of 16 bits of the header of Opus on the page at `offset` (RFC 7845, 5.1), 0 for other sounds.
    std::uint64_t opusNumber(std::uint64_t offset, std::uint64_t place)
    {
        const auto packet = offset + oggHeaderBytes + file.number(offset + 26, 1, true);
        return file.has(packet, "OpusHead") ? file.number(packet + place, 2, false) : 0;
    }

    /// Whether the page at `offset` begins a stream of sound.
    bool startsOggSound(std::uint64_t offset)
    {
        using namespace std::string_view_literals;
        const auto packet = offset + oggHeaderBytes + file.number(offset + 26, 1, true);
        for (const auto name : {"\1vorbis"sv, "OpusHead"sv, "\x7F\x46LAC"sv, "Speex   "sv})
            if (file.has(packet, name))
                return true;
        return false;
    }

    bool addMpeg(std::uint64_t begin, std::uint64_t audioEnd)
    {
        auto runs = mpegRuns(file, begin, audioEnd);
        // A header that counts frames, in front of another such header instead of them: programs that join files leave
        // it.
        for (std::size_t i = 0; i + 1 < runs.size();)
            if (runs[i].frames == 0 && runs[i].end > runs[i].begin && runs[i + 1].skipped == 0)
            {
                runs[i + 1].skipped += runs[i].skipped;
                runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(i));
            }
            else
                ++i;
        // Zeros behind the sound.
        std::uint64_t zeros = 0;
        if (runs.size() > 1 && runs.back().end == runs.back().begin && runs.back().skipped <= audioEnd - begin &&
            areZeros(file, audioEnd - runs.back().skipped, audioEnd))
        {
            zeros = runs.back().skipped;
            runs.pop_back();
        }
        if (runs.empty() || runs.front().frames == 0)
            return false;
        for (const MpegRun& run : runs)
        {
            SoundPart& part = parts.emplace_back();
            part.begin = run.begin;
            part.end = run.end;
            part.skippedBytes = run.skipped;
            part.endsInFrame = run.rest > 0;
            part.countedFrames = run.samples;
            const auto perFrame = run.frames > 0 ? run.samples / run.frames : 0;
            if (run.statedFrames)
                part.promisedFrames = *run.statedFrames * perFrame;
            if (run.frames == 0)
                continue;
            if (run.countField != 0 && run.statedFrames != run.frames)
                part.patches.push_back({run.countField, numberBytes(run.frames, 4, true)});
        }
        parts.back().leftOutBytes += zeros;
        return true;
    }

    std::FILE* opened;
    ByteWindow file;
    std::uint64_t end;
    std::optional<AudioChunk> later; ///< more audio behind that of the last part, in the same file of chunks
    std::vector<SoundPart> parts;
};
} // namespace

std::string numberBytes(std::uint64_t value, std::size_t count, bool bigEndian)
{
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i)
        bytes += static_cast<char>((value >> (8 * (bigEndian ? count - 1 - i : i))) & 0xFFu);
    return bytes;
}

std::vector<SoundPart> soundParts(std::FILE* file)
{
    return Planner(file).run();
}

std::optional<std::uint64_t> flacFrames(std::FILE* file, std::uint64_t begin, std::uint64_t end)
{
    ByteWindow window(file);
    return numberedFlacFrames(window, begin, end);
}

std::optional<SoundPart> nextFlac(std::FILE* file, std::uint64_t offset, std::uint64_t end)
{
    ByteWindow window(file);
    const auto begin = window.find(std::string_view("fLaC\0\0\0\x22", 8), offset, end);
    return begin < end ? std::optional(Planner(file).flac(begin)) : std::nullopt;
}

} // namespace pacini
