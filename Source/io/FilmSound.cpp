#include "io/FilmSound.h"

#include "io/AudioHeader.h"
#include "io/ByteWindow.h"
#include "io/FileHandle.h"
#include "io/MatroskaParts.h"
#include "io/Mp4Tables.h"
#include "io/SoundCodec.h"
#include "io/SoundTags.h"
#include "io/Utf8.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
using Json = nlohmann::json;
using namespace std::string_view_literals;

constexpr double shortest = 0.1; // s that are missing before it is said: codecs are primed and filled up with less
constexpr std::uint64_t longestBlock = 4096; // frames of any codec
constexpr int aacPriming = 2112;             // frames, the most that encoders of AAC put in front
constexpr double latest = 24.0 * 3600.0;     // s after the picture that a sound may begin

Error invalid(std::string message)
{
    return {ErrorCode::invalidData, "", std::move(message)};
}

/// The first error that a program told, without its own names of parts and of the file:
/// `[mov,mp4 @ 0x55] [error] moov atom not found`.
std::string complaintOf(std::string_view text, std::string_view name)
{
    for (const std::string_view level : {"[error] "sv, "[fatal] "sv, "[panic] "sv})
    {
        const auto at = text.find(level);
        if (at == std::string_view::npos)
            continue;
        auto line = text.substr(at + level.size());
        line = line.substr(0, line.find_first_of("\r\n"));
        if (line.starts_with(name) && line.substr(name.size()).starts_with(": "))
            line.remove_prefix(name.size() + 2);
        while (line.ends_with('.') || line.ends_with(' '))
            line.remove_suffix(1);
        return wellFormedUtf8(line.substr(0, 200));
    }
    return {};
}

/// The sum of the numbers that stand between two words wherever they do.
double sumOf(std::string_view text, std::string_view before, std::string_view behind)
{
    double sum = 0.0;
    for (auto at = text.find(before); at != std::string_view::npos; at = text.find(before, at + 1))
    {
        const auto rest = text.substr(at + before.size());
        const auto digits = rest.substr(0, rest.find_first_not_of("0123456789"));
        if (rest.substr(digits.size()).starts_with(behind))
            sum += parseNumber(digits).value_or(0.0);
    }
    return sum;
}

Error notInstalled(std::string_view program)
{
    return invalid(fmt::format("is a film or has a codec that is decoded by ffmpeg, but the program {} is not "
                               "installed; install ffmpeg, or convert the sound to WAV elsewhere",
                               program));
}

/// How the programs are to open the film: nothing that it names elsewhere, and no more memory than a block needs.
std::vector<std::string> safely(const char* level)
{
    return {"-v", level, "-protocol_whitelist", "file,pipe,subfile", "-max_alloc", "134217728"};
}

std::string textOf(const Json& object, const char* name)
{
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// A number that is one in JSON, or a text.
std::optional<double> numberOf(const Json& object, const char* name)
{
    const auto found = object.find(name);
    if (found == object.end())
        return {};
    const auto number = found->is_number()   ? std::optional(found->get<double>())
                        : found->is_string() ? parseNumber(found->get_ref<const std::string&>())
                                             : std::nullopt;
    return number && std::isfinite(*number) ? number : std::nullopt;
}

const Json& partOf(const Json& object, const char* name)
{
    static const Json nothing = Json::object();
    const auto found = object.find(name);
    return found != object.end() && found->is_object() ? *found : nothing;
}

/// Objects of a list.
std::vector<const Json*> listOf(const Json& object, const char* name)
{
    std::vector<const Json*> all;
    if (const auto found = object.find(name); found != object.end() && found->is_array())
        for (const Json& one : *found)
            if (one.is_object())
                all.push_back(&one);
    return all;
}

/// s of a tag such as `00:00:04.701000000`.
std::optional<double> secondsOfTag(std::string_view text)
{
    double seconds = 0.0;
    for (;;)
    {
        const auto colon = text.find(':');
        const auto part = parseNumber(text.substr(0, colon));
        if (!part || !(*part >= 0.0 && *part < 1e9))
            return {};
        seconds = 60.0 * seconds + *part;
        if (colon == std::string_view::npos)
            return seconds;
        text.remove_prefix(colon + 1);
    }
}

/// By the names that ffmpeg has for layouts of loudspeakers.
SpecialChannels specialChannelsOf(std::string_view layout)
{
    struct Known
    {
        std::string_view name;
        SpecialChannels channels;
    };
    constexpr SpecialChannels centre{.lowFrequency = {}, .centre = 2};
    constexpr SpecialChannels both{.lowFrequency = 3, .centre = 2};
    constexpr SpecialChannels low{.lowFrequency = 2, .centre = {}};
    static constexpr std::array known = std::to_array<Known>({
        {"2.1", low},        {"3.0", centre},          {"3.1", both},          {"4.0", centre},
        {"4.1", both},       {"5.0", centre},          {"5.0(side)", centre},  {"5.1", both},
        {"5.1(side)", both}, {"6.0", centre},          {"6.1", both},          {"6.1(back)", both},
        {"6.1(front)", low}, {"7.0", centre},          {"7.0(front)", centre}, {"7.1", both},
        {"7.1(wide)", both}, {"7.1(wide-side)", both}, {"5.1.2", both},        {"5.1.4", both},
        {"7.1.2", both},     {"7.1.4", both},
    });
    const auto found = std::find_if(known.begin(), known.end(), [&](const Known& one) { return one.name == layout; });
    return found != known.end() ? found->channels : SpecialChannels{};
}

/// Bytes that the chunks of an AVI state and the file lacks.
std::uint64_t missingBytesOfAvi(std::FILE* opened)
{
    ByteWindow file(opened);
    std::uint64_t end = 0;
    while (file.has(end, "RIFF") && file.number(end + 4, 4, false) > 0)
        end += 8 + file.number(end + 4, 4, false);
    return end > file.size() ? end - file.size() : 0;
}

/// Bytes that the header of an ASF file states and the file lacks. The object of file properties has an id of 16 bytes,
/// its size and another id, then the size of the file (Microsoft, "Advanced Systems Format Specification", 2004).
std::uint64_t missingBytesOfAsf(std::FILE* opened)
{
    constexpr auto properties = "\xA1\xDC\xAB\x8C\x47\xA9\xCF\x11\x8E\xE4\x00\xC0\x0C\x20\x53\x65"sv;
    constexpr std::uint64_t reach = 65536;
    ByteWindow file(opened);
    const auto place = file.find(properties, 0, std::min(file.size(), reach));
    const auto stated = file.has(place, properties) ? file.number(place + 40, 8, false) : 0;
    const bool isStream = file.has(place, properties) && (file.number(place + 88, 4, false) & 1u) != 0;
    return !isStream && stated > file.size() ? stated - file.size() : 0;
}

/// Bytes that the last tag of an FLV states and the file lacks: each has a head of 11 bytes with its size at the
/// second, and its whole size behind it (Adobe, "Flash Video File Format Specification 10.1", 2010).
std::uint64_t missingBytesOfFlv(std::FILE* opened)
{
    ByteWindow file(opened);
    auto offset = file.number(5, 4, true) + 4;
    while (offset + 11 <= file.size())
        offset += 15 + file.number(offset + 1, 3, true);
    return offset > file.size() ? offset - file.size() : 0;
}

/// Whether a box of an MP4 or MOV begins there that may be the first.
bool isMp4(std::FILE* opened, std::uint64_t begin)
{
    ByteWindow file(opened);
    const auto boxes = {"ftyp"sv, "moov"sv, "mdat"sv, "wide"sv, "free"sv, "skip"sv, "pnot"sv};
    return std::any_of(boxes.begin(), boxes.end(), [&](std::string_view box) { return file.has(begin + 4, box); });
}

/// Whether a transport stream of MPEG begins there or within its first packet: packets of 188 bytes begin with a G
/// (ISO/IEC 13818-1); cameras put four bytes in front of each.
bool isTransportStream(ByteWindow& file, std::uint64_t begin)
{
    constexpr std::uint64_t packets = 16; // which samples of a tone make, too, but not in front of them
    const bool isOther = startsSound(file, begin) || tagBytesAt(file, begin) > 0 || file.number(begin, 1, true) == 0xFF;
    for (const std::uint64_t length : {std::uint64_t{188}, std::uint64_t{192}})
        for (std::uint64_t first = 0; first < length; ++first)
        {
            if (first > 0 && isOther)
                return false;
            const auto fewest = first == length - 188 ? 3 : packets;
            std::uint64_t found = 0;
            while (found < fewest && file.has(begin + first + found * length, "G"))
                ++found;
            if (found == fewest)
                return true;
        }
    return false;
}

/// What a person calls a track: `2 (eng, 5.1)`.
std::string trackText(std::size_t number, const Json& stream)
{
    std::string text;
    for (const std::string& part : {textOf(partOf(stream, "tags"), "language"), textOf(partOf(stream, "tags"), "title"),
                                    textOf(stream, "channel_layout")})
        if (!part.empty() && part != "und")
            text += (text.empty() ? "" : ", ") + part.substr(0, 60);
    return fmt::format("{}{}", number, text.empty() ? "" : " (" + wellFormedUtf8(text) + ")");
}

/// Starts a program that is given what came through a pipe, from its begin. Errors: invalidData; io.
Result<std::unique_ptr<ChildProgram>> started(const char* name, const std::vector<std::string>& words, std::FILE* pipe)
{
    if (pipe != nullptr && !seekStream(pipe, 0, SEEK_SET))
        return invalid("is a film, which cannot be read from a pipe here; save it to a file first");
    auto program = ChildProgram::start(name, words, pipe);
    if (program && *program == nullptr)
        return notInstalled(name);
    return program;
}

/// What ffprobe tells of a film. Errors: invalidData; io.
Result<Json> probed(const std::string& name, std::FILE* pipe)
{
    constexpr const char* entries =
        "stream=index,codec_type,codec_name,sample_rate,channels,channel_layout,start_time,duration,nb_frames:"
        "stream_disposition=default,attached_pic:stream_tags:format=format_name,duration:"
        "chapter=start_time:chapter_tags=title";
    auto words = safely("level+error");
    for (const char* word : {"-of", "json", "-show_chapters", "-show_entries", entries})
        words.emplace_back(word);
    words.push_back(name);
    const auto program = started("ffprobe", words, pipe);
    if (!program)
        return program.error();
    const std::string printed = allOutput(**program, std::size_t(1) << 24);
    const auto ending = (*program)->wait();
    Json found = Json::parse(printed, nullptr, false);
    if (!ending.succeeded || !found.is_object())
    {
        const std::string why = complaintOf(ending.complaint, name);
        return invalid(fmt::format("cannot be read by ffmpeg ({}); get a complete copy",
                                   why.empty() ? "it did not say why" : why));
    }
    return found;
}
} // namespace

bool isFilm(std::FILE* opened, std::uint64_t begin)
{
    ByteWindow file(opened);
    const auto at = [&](std::uint64_t offset, std::string_view text)
    {
        return file.has(begin + offset, text);
    };
    if (isMp4(opened, begin))
        return true;
    for (const std::string_view id : {"FLV\1"sv, "\x30\x26\xB2\x75\x8E\x66\xCF\x11"sv, "wvpk"sv, "MAC "sv, "TTA1"sv,
                                      "#!AMR"sv, "\x7F\xFE\x80\x01"sv, "\xFE\x7F\x01\x80"sv})
        if (at(0, id))
            return true;
    return at(0, "\x1A\x45\xDF\xA3"sv) || (at(0, "RIFF") && at(8, "AVI ")) || at(0, "\xFF\xF1"sv) ||
           at(0, "\xFF\xF9"sv) || at(0, "\x0B\x77"sv) || at(0, "\0\0\1\xBA"sv) || isTransportStream(file, begin);
}

/// What ffprobe tells of a film, and what of it is read.
struct FilmSound::Probe
{
    explicit Probe(Json told) : found(std::move(told)) {}

    Json found;
    const Json* track = nullptr;   ///< the one that is read
    std::optional<double> picture; ///< s at which the first one begins
    std::string kind, codec;
    double zero = 0.0; ///< s of the film that are time 0 of the sound
};

Result<FilmSound> FilmSound::open(const fs::path& path, std::FILE* file, const Options& options)
{
    // What came through a pipe has no name. Its copy has none either, but the child is given it.
    std::error_code unknown;
    const bool named = path != "-" && fs::is_regular_file(path, unknown);
    std::FILE* const pipe = named ? nullptr : file;
    const auto place = fs::absolute(path, unknown).u8string();
    // With its protocol, so that no name is taken for an option or an address.
    std::string name = "file:" + (named ? std::string(place.begin(), place.end()) : "/dev/fd/0");
    // An MP4 counts its offsets from its own start.
    const bool isBehindTag = options.begin > 0 && isMp4(file, options.begin);
    if (isBehindTag)
        name = fmt::format("subfile,,start,{},end,0,,:{}", options.begin, name);

    auto found = probed(name, pipe);
    if (!found)
        return found.error();
    Probe probe(std::move(*found));
    FilmSound sound;
    sound.takesTruncated = options.allowTruncated;
    if (const auto taken = sound.takeTrack(probe); !taken)
        return taken.error();
    if (const auto taken = sound.takeTimes(probe); !taken)
        return taken.error();
    const std::string &kind = probe.kind, &codec = probe.codec;
    const double index = numberOf(*probe.track, "index").value_or(0.0);
    if (const auto whole = sound.checkCut(file, kind); !whole)
        return whole.error();
    if (kind.find("mov") != std::string::npos)
        sound.checkTables(file, isBehindTag ? options.begin : 0, index, codec);
    if (kind.find("matroska") != std::string::npos)
        sound.checkMatroska(file, codec);
    if (kind == "aac" || (codec == "aac" && !sound.hasPicture && (kind == "mpegts" || kind == "flv")))
        sound.warnings.push_back(primingWarning(aacPriming, sound.rate));
    sound.takeChapters(probe);

    auto words = safely("level+verbose"); // which tells of samples that were added or left out
    words.insert(words.begin(), {"-nostdin", "-nostats", "-hide_banner", "-copyts"});
    if (options.toTheEnd && kind == "wav")
        words.insert(words.end(), {"-ignore_length", "1"});
    words.insert(words.end(), {"-i", name, "-map", fmt::format("0:{}", static_cast<int>(index)), "-af",
                               fmt::format("aresample=async=1:first_pts={}", std::llround(probe.zero * sound.rate)),
                               "-ar", fmt::format("{}", sound.rate), "-ac", fmt::format("{}", sound.width), "-f",
                               std::endian::native == std::endian::little ? "f32le" : "f32be", "-"});
    auto decoder = started("ffmpeg", words, pipe);
    if (!decoder)
        return decoder.error();
    sound.ffmpeg = std::move(*decoder);
    return sound;
}

Result<void> FilmSound::takeTrack(Probe& probe)
{
    std::vector<const Json*> tracks;
    for (const Json* stream : listOf(probe.found, "streams"))
    {
        const std::string kind = textOf(*stream, "codec_type");
        if (kind == "audio")
            tracks.push_back(stream);
        if (kind != "video" || numberOf(partOf(*stream, "disposition"), "attached_pic").value_or(0.0) != 0.0)
            continue;
        hasPicture = true;
        if (!probe.picture)
            probe.picture = numberOf(*stream, "start_time");
    }
    if (tracks.empty())
        return invalid(hasPicture ? "is a film without sound; choose one with sound"
                                  : "has no sound that ffmpeg knows; convert it to WAV elsewhere");
    const auto chosen = std::find_if(tracks.begin(), tracks.end(),
                                     [](const Json* one)
                                     { return numberOf(partOf(*one, "disposition"), "default").value_or(0.0) != 0.0; });
    probe.track = chosen != tracks.end() ? *chosen : tracks.front();
    const Json& track = *probe.track;
    if (tracks.size() > 1)
        warnings.push_back(fmt::format(
            "has {} tracks of sound; track {} is read; save another as a file of its own", tracks.size(),
            trackText(static_cast<std::size_t>((chosen != tracks.end() ? chosen : tracks.begin()) - tracks.begin()) + 1,
                      track)));

    const double frequency = numberOf(track, "sample_rate").value_or(0.0);
    const double count = numberOf(track, "channels").value_or(0.0);
    if (!(frequency >= 1.0 && frequency < 1e9) || !(count >= 1.0 && count < 1e6))
        return invalid("has a sound whose sample rate or channels ffmpeg cannot tell; get a complete copy");
    rate = static_cast<int>(frequency);
    width = static_cast<int>(count);
    special = specialChannelsOf(textOf(track, "channel_layout"));
    probe.codec = textOf(track, "codec_name");
    return {};
}

Result<void> FilmSound::takeTimes(Probe& probe)
{
    const Json& track = *probe.track;
    const double begins = numberOf(track, "start_time").value_or(0.0);
    const double zero = probe.zero = probe.picture.value_or(std::max(begins, 0.0)); // codecs are primed before 0
    if (!(std::abs(begins - zero) < latest))
        return invalid("has a damaged header, by which its sound begins more than a day from its picture; get a "
                       "complete copy");
    late = begins - zero;
    if (begins < zero - shortest)
        warnings.push_back(
            fmt::format("has a sound that begins before its picture; the first {:.3f} s are left out", zero - begins));

    // What states a duration, and how reliably, differs by kind.
    const std::string& kind = probe.kind = textOf(partOf(probe.found, "format"), "format_name");
    std::optional<double> end;
    if (kind.find("mov") != std::string::npos)
    {
        duration = Duration::exact;
        end = numberOf(track, "duration");
        if (end)
            *end += begins;
    }
    else if (kind.find("matroska") != std::string::npos)
    {
        duration = Duration::atLeast;
        end = secondsOfTag(textOf(partOf(track, "tags"), "DURATION"));
    }
    else if (kind == "avi")
    {
        // By the number of its blocks, those of PCM are frames; damaged ones are passed over.
        end = numberOf(track, "duration");
        if (const auto frames = numberOf(track, "nb_frames"); !end && frames && probe.codec.starts_with("pcm_"))
            end = *frames / rate;
        statesTrack = end.has_value();
        if (end)
            *end += begins;
    }
    else if (kind == "wv" || kind == "tta" || kind == "ape" || kind == "caf")
    {
        duration = Duration::atLeast;
        end = numberOf(track, "duration");
    }
    statesSound = end.has_value() || !hasPicture;
    if (!end)
    {
        duration = Duration::estimated;
        end = numberOf(partOf(probe.found, "format"), "duration");
        if (end)
            *end += zero;
    }
    if (end && *end - zero < latest)
        stated = static_cast<std::uint64_t>(std::llround(std::max(*end - zero, 0.0) * rate));
    return {};
}

void FilmSound::takeChapters(const Probe& probe)
{
    std::size_t number = 0;
    for (const Json* chapter : listOf(probe.found, "chapters"))
    {
        ++number;
        const auto time = numberOf(*chapter, "start_time");
        std::string title = wellFormedUtf8(textOf(partOf(*chapter, "tags"), "title"));
        if (time && *time - probe.zero > -0.0005)
            markers.markers.push_back({std::max(*time - probe.zero, 0.0),
                                       title.empty() ? fmt::format("chapter {}", number) : std::move(title)});
        else
            markers.warnings.push_back(fmt::format("has a chapter before its picture, {}, which is left out", number));
    }
}

std::size_t FilmSound::readFrames(std::span<float> interleaved)
{
    const auto frameBytes = sizeof(float) * static_cast<std::size_t>(width);
    return ffmpeg->read({reinterpret_cast<char*>(interleaved.data()), interleaved.size_bytes()}) / frameBytes;
}

Result<std::size_t> FilmSound::read(std::span<float> interleaved)
{
    const auto perFrame = static_cast<std::size_t>(width);
    std::size_t done = 0; // samples
    while (done < interleaved.size() && !(ended && handedOn == behind.size()))
    {
        auto rest = interleaved.subspan(done);
        if (handedOn < behind.size())
        {
            rest = rest.first(std::min(rest.size(), behind.size() - handedOn));
            std::copy_n(behind.begin() + static_cast<std::ptrdiff_t>(handedOn), rest.size(), rest.begin());
            handedOn += rest.size();
            done += rest.size();
            delivered += rest.size() / perFrame;
            continue;
        }
        const bool beforeEnd = duration == Duration::exact && stated && delivered < *stated;
        if (beforeEnd && rest.size() / perFrame > *stated - delivered)
            rest = rest.first(static_cast<std::size_t>(*stated - delivered) * perFrame);
        const auto got = readFrames(rest);
        done += got * perFrame;
        delivered += got;
        ended = got * perFrame < rest.size();
        if (!ended && beforeEnd && delivered == *stated)
        {
            // The last block of a codec is filled up. More than that is sound that the header does not count.
            behind.resize(longestBlock * perFrame);
            const auto more = readFrames(behind);
            ended = more < longestBlock;
            behind.resize(ended ? 0 : more * perFrame);
            handedOn = 0;
        }
    }
    if (ended && handedOn == behind.size() && ffmpeg)
        if (const auto end = explainEnd(); !end)
            return end.error();
    return done / perFrame;
}

/// What the file as a whole states, of kinds that tell nothing of it to ffmpeg.
Result<void> FilmSound::checkCut(std::FILE* file, const std::string& kind)
{
    const auto missing = kind == "avi"   ? missingBytesOfAvi(file)
                         : kind == "asf" ? missingBytesOfAsf(file)
                         : kind == "flv" ? missingBytesOfFlv(file)
                                         : 0;
    ByteWindow window(file);
    const bool isCut = kind == "ogg" && isCutOgg(window, 0, window.size());
    if (missing == 0 && !isCut)
        return {};
    auto message = isCut ? std::string("is cut off: the mark of its end is missing")
                         : fmt::format("is cut off: {} bytes are missing of what its header states", missing);
    if (!takesTruncated)
        return Error{ErrorCode::truncated, "", message + "; get a complete copy"};
    cutOff = std::move(message); // told at the end, in seconds where they are known
    return {};
}

/// What the tables of an MP4 state beside what ffmpeg believes of them.
void FilmSound::checkTables(std::FILE* file, std::uint64_t begin, double index, const std::string& codec)
{
    auto tracks = mp4Tracks(file, begin);
    const bool isThere = index >= 0.0 && index < static_cast<double>(tracks.size());
    const auto* const found = isThere ? &tracks[static_cast<std::size_t>(index)] : nullptr;
    if (!found || (found->seconds == 0.0 && found->doubts.empty()))
    {
        if (duration == Duration::exact && !(found && found->isUnchecked))
            warnings.emplace_back("has a header in which not all of its tracks are found; some of its sound may "
                                  "be missing; get a complete copy");
        return;
    }
    Mp4Track& track = tracks[static_cast<std::size_t>(index)];
    std::move(track.doubts.begin(), track.doubts.end(), std::back_inserter(warnings));
    if (auto loudness = opusGainWarning(track.opusGain))
        warnings.push_back(std::move(*loudness));
    if (codec == "aac" && !hasPicture && !track.isPrimingTold)
        warnings.push_back(primingWarning(aacPriming, rate));
    // Codecs are primed with up to 2112 frames, and their last block is filled up.
    constexpr double mostBlocks = 3.0;
    const double longest = static_cast<double>(longestBlock) / rate;
    const double margin =
        shortest + (track.blockSeconds > 0.0 ? std::min(longest, mostBlocks * track.blockSeconds) : longest);
    held = track.played - std::max(-late, 0.0) - margin;
    if (track.played + margin < track.seconds)
        warnings.push_back(fmt::format("has an edit list, by which {:.3f} s of the {:.3f} s of its sound are left out",
                                       track.seconds - track.played, track.seconds));
}

/// What players pass over in a Matroska file, which they do not tell.
void FilmSound::checkMatroska(std::FILE* file, const std::string& codec)
{
    if (const auto unknown = duration == Duration::estimated ? unknownBytesOfMatroska(file) : 0; unknown > 0)
        warnings.push_back(
            fmt::format("is damaged: {} bytes are no part of a film that is known; some of its sound may "
                        "be missing; get a complete copy",
                        unknown));
    if (codec != "opus")
        return;
    constexpr std::uint64_t reach = 1 << 20, gainPlace = 16;
    constexpr std::string_view name = "OpusHead";
    ByteWindow window(file);
    const auto last = std::min(window.size(), reach);
    auto place = window.find(name, 0, last);
    // ffmpeg does not mind the name; the description of one or two channels has 19 bytes.
    constexpr std::string_view description = "\x63\xA2\x93";
    if (!window.has(place, name))
        place = window.find(description, 0, last) + description.size();
    if (place >= last)
        return;
    if (auto loudness = opusGainWarning(static_cast<std::int16_t>(window.number(place + gainPlace, 2, false))))
        warnings.push_back(std::move(*loudness));
}

Result<void> FilmSound::explainEnd()
{
    const auto ending = ffmpeg->wait();
    ffmpeg.reset();
    const double here = static_cast<double>(delivered) / rate;
    const double promised = std::max(static_cast<double>(stated.value_or(delivered)) / rate, here < held ? held : 0.0);
    const std::string why = complaintOf(ending.complaint, "file:");
    const auto withReason = [&why](std::string_view what)
    {
        return why.empty() ? std::string(what) : fmt::format("{} (ffmpeg reports: {})", what, why);
    };
    if (delivered == 0)
        return invalid(
            withReason("has no sound that ffmpeg can decode; get a complete copy, or convert it to WAV elsewhere"));
    // ffmpeg begins its filters anew with other channels or another rate, and fills up from 0 again.
    constexpr std::string_view filters = "[graph_0_in_";
    const auto first = ending.complaint.find(filters);
    const auto again = first == std::string::npos ? first : ending.complaint.find(filters, first + 1);
    if (again != std::string::npos &&
        sumOf(std::string_view(ending.complaint).substr(again), "adding ", " audio samples of silence") / rate >
            shortest)
        return invalid(
            "changes the channels or the sample rate of its sound, which would come late from there on; save "
            "its sound as one WAV first (ffmpeg -i FILM -vn SOUND.wav)");
    const bool lacks = here < held || (duration != Duration::estimated && here + shortest < promised);
    const bool isShort = statesTrack && here + shortest < promised;
    if (!cutOff.empty())
        warnings.push_back(isShort ? fmt::format("is cut off: {:.3f} s of {:.3f} s are there", here, promised)
                                   : cutOff);
    if (lacks || !ending.succeeded)
    {
        if (!takesTruncated)
            return Error{ErrorCode::truncated, "",
                         withReason(lacks
                                        ? fmt::format("is truncated: {:.3f} s of {:.3f} s of its sound can be decoded; "
                                                      "get a complete copy",
                                                      here, promised)
                                        : fmt::format("is damaged after {:.3f} s; get a complete copy", here))};
        warnings.push_back(withReason(lacks ? fmt::format("is cut off: {:.3f} s of {:.3f} s are there", here, promised)
                                            : fmt::format("is damaged after {:.3f} s", here)));
    }
    else if (!why.empty())
        warnings.push_back(withReason(
            statesSound && here + shortest < promised
                ? fmt::format("is damaged, or ffmpeg does not know all of it; {:.3f} s of {:.3f} s were decoded", here,
                              promised)
                : fmt::format("is damaged, or ffmpeg does not know all of it; {:.3f} s were decoded", here)));
    else if (statesTrack ? isShort && cutOff.empty()
                         : duration == Duration::estimated && !hasPicture && here < 0.5 * promised)
        warnings.push_back(
            fmt::format("lasts about {:.3f} s by its header, of which {:.3f} s can be decoded", promised, here));
    // Of a block of AAC that has fewer channels than its header states, in ffmpeg's words.
    if (const auto element = ending.complaint.find("ChannelElement ");
        element != std::string::npos && ending.complaint.find(" missing", element) != std::string::npos)
        warnings.push_back(fmt::format("has a header that states other channels than its sound has; it is read with "
                                       "{}, of which those that it lacks are silent; save it anew",
                                       width));
    // Beyond what makes time 0 that of the picture.
    const double added = sumOf(ending.complaint, "adding ", " audio samples of silence") / rate - std::max(late, 0.0);
    const double cut = sumOf(ending.complaint, "discarding ", " audio samples") / rate - std::max(-late, 0.0);
    if (cut > shortest)
        warnings.push_back(
            fmt::format("has {:.3f} s of sound whose times are those of other sound; they are left out", cut));
    if (added > shortest)
        warnings.push_back(fmt::format("has gaps of {:.3f} s in its sound, where silence stands", added));
    if (duration == Duration::exact && here > promised + shortest)
        warnings.push_back(fmt::format("has a header that states {:.3f} s, but {:.3f} s are there and all of them are "
                                       "read; save it anew",
                                       promised, here));
    return {};
}

} // namespace pacini
