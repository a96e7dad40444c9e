#include "io/SampleWords.h"

#include "io/AudioHeader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
/// The words of a file by its header.
struct SampleWords
{
    std::uint64_t bytes = 0; ///< of a word
    std::uint64_t bits = 0;  ///< of a word that are the sample's
    bool isFloat = false;
    bool bigEndian = false;
    bool isMisread = false;                        ///< libsndfile would take them for shorter words, or refuse them
    std::vector<BytePatch> asInteger{}, asFloat{}; ///< of the header
    std::vector<BytePatch> always{};               ///< likewise, where it says the truth but libsndfile misreads it
};

/// Sources: Microsoft, "Multiple channel audio data and WAVE files", 2001 (bits that are valid).
std::optional<SampleWords> wordsOfWave(ByteWindow& file, const FileChunk& format, bool isBig, bool isWave64)
{
    constexpr std::uint64_t pcm = 1, floats = 3, extensible = 0xFFFE;
    const auto at = [&](std::uint64_t place)
    {
        return file.number(format.content + place, 2, isBig);
    };
    const bool isLong = at(0) == extensible && format.bytes >= 26;
    const auto codec = isLong ? at(24) : at(0), channels = at(2), frame = at(12), bits = at(14);
    if ((codec != pcm && codec != floats) || channels == 0 || bits == 0)
        return {};
    SampleWords words{.bytes = (bits + 7) / 8, .bits = bits, .isFloat = codec == floats, .bigEndian = isBig};
    if (frame % channels == 0 && frame / channels > words.bytes && frame / channels <= 4)
    {
        words.bytes = frame / channels;
        words.isMisread = true;
    }
    if (const auto valid = isLong ? at(18) : 0; valid > 0 && valid < words.bits)
        words.bits = valid;
    const auto put = [&](std::vector<BytePatch>& patches, std::uint64_t place, std::uint64_t value)
    {
        patches.push_back({format.content + place, numberBytes(value, 2, isBig)});
    };
    for (auto* const patches : {&words.asInteger, &words.asFloat})
    {
        put(*patches, 14, 8 * words.bytes);
        put(*patches, isLong ? 24 : 0, patches == &words.asFloat ? floats : pcm);
        if (isLong)
            put(*patches, 18, 8 * words.bytes);
    }
    // libsndfile takes all that is extensible in a W64 for integers.
    if (isLong && isWave64)
        put(words.asFloat, 0, floats);
    if (words.isFloat && !words.isMisread)
        words.always = words.asFloat;
    return words;
}

std::optional<SampleWords> wordsOfAiff(ByteWindow& file, const FileChunk& comm)
{
    const auto codec = comm.content + 18;
    const auto is = [&](std::string_view name)
    {
        return comm.bytes >= 22 && file.has(codec, name);
    };
    SampleWords words{.bits = bitsOfAifcCodec(file, comm).value_or(file.number(comm.content + 6, 2, true)),
                      .isFloat = is("fl32") || is("FL32") || is("fl64") || is("FL64"),
                      .bigEndian = !is("sowt")};
    words.bytes = (words.bits + 7) / 8;
    const bool isPlain =
        comm.bytes < 22 || words.isFloat || is("NONE") || is("twos") || is("sowt") || is("in24") || is("in32");
    return isPlain ? std::optional(words) : std::nullopt;
}

std::optional<SampleWords> wordsOfCaf(ByteWindow& file, const FileChunk& desc)
{
    constexpr std::uint64_t isFloat = 1, isLittle = 2;
    const auto at = [&](std::uint64_t place)
    {
        return file.number(desc.content + place, 4, true);
    };
    const auto flags = at(12), packet = at(16), channels = at(24), bits = at(28);
    if (channels == 0 || bits == 0 || packet % channels != 0)
        return {};
    SampleWords words{.bytes = packet / channels,
                      .bits = bits,
                      .isFloat = (flags & isFloat) != 0,
                      .bigEndian = (flags & isLittle) == 0};
    // It takes the bits for those of a word.
    words.isMisread = bits < 8 * words.bytes;
    words.asInteger.push_back({desc.content + 28, numberBytes(8 * words.bytes, 4, true)});
    words.asFloat = words.asInteger;
    words.asFloat.push_back({desc.content + 12, numberBytes(flags | isFloat, 4, true)});
    return words;
}

std::optional<SampleWords> wordsOfAu(ByteWindow& file, std::uint64_t begin)
{
    const bool isBig = file.has(begin, ".snd");
    const auto codec = file.number(begin + 12, 4, isBig);
    if (codec < 3 || codec > 7)
        return {};
    constexpr std::uint64_t widths[] = {2, 3, 4, 4, 8};
    const auto bytes = widths[codec - 3];
    constexpr std::uint64_t floats = 6;
    SampleWords words{.bytes = bytes, .bits = 8 * bytes, .isFloat = codec >= floats, .bigEndian = isBig};
    words.asFloat.push_back({begin + 12, numberBytes(floats, 4, isBig)});
    return words;
}

std::optional<SampleWords> sampleWords(ByteWindow& file, std::uint64_t begin, std::uint64_t headerEnd)
{
    if (file.has(begin, ".snd") || file.has(begin, "dns."))
        return wordsOfAu(file, begin);
    for (const FileChunk& chunk : chunksOf(file, begin, headerEnd, 0))
    {
        if (file.has(chunk.offset, "fmt ") && chunk.bytes >= 16)
            return wordsOfWave(file, chunk, file.has(begin, "RIFX"), file.has(begin, "riff"));
        if (file.has(chunk.offset, "COMM") && chunk.bytes >= 18)
            return wordsOfAiff(file, chunk);
        if (file.has(chunk.offset, "desc") && chunk.bytes >= 32 && file.has(chunk.content + 8, "lpcm"))
            return wordsOfCaf(file, chunk);
    }
    return {};
}

/// What the words of a file have in common.
class WordScan
{
public:
    explicit WordScan(const SampleWords& described) : words(described) {}

    void take(std::span<const unsigned char> bytes)
    {
        for (std::size_t at = 0; at + words.bytes <= bytes.size(); at += words.bytes)
        {
            std::uint64_t bits = 0;
            for (std::size_t i = 0; i < words.bytes; ++i)
                bits = bits << 8u | bytes[at + (words.bigEndian ? i : words.bytes - 1 - i)];
            if (bits == 0)
                continue;
            ++sounding;
            if (words.isFloat && words.bytes == 8)
                takeNumber(std::bit_cast<double>(bits));
            else if (words.bytes == 4)
                takeNumber(static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits))));
            if (!words.isFloat)
                takeInteger(bits);
        }
    }

    /// Bits that the largest integer takes, its sign among them.
    [[nodiscard]] std::uint64_t integerBits() const
    {
        return static_cast<std::uint64_t>(std::bit_width(magnitude)) + 1;
    }
    [[nodiscard]] std::uint64_t lowZeros() const { return static_cast<std::uint64_t>(std::countr_zero(any)); }
    [[nodiscard]] bool isSilent() const { return sounding == 0; }

    /// Whether words of 32 bits are floating-point numbers: integers that change their sign are also near 0, where they
    /// would be no such numbers, and few of the others have the usual sizes.
    [[nodiscard]] bool areNumbers() const
    {
        constexpr int fewestExponents = 4;
        constexpr std::uint64_t fewestWords = 64, unusualOf = 50;
        return areFinite && sounding >= fewestWords && unusual <= sounding / unusualOf && hasBelow && hasAbove &&
               std::popcount(exponents) >= fewestExponents;
    }

    bool areWhole = true; ///< the numbers
    bool areFinite = true;
    double peak = 0.0; ///< of the numbers
    std::uint64_t sounding = 0;

private:
    void takeNumber(double value)
    {
        constexpr int lowest = -30, highest = 25;
        if (!std::isfinite(value))
        {
            areWhole = areFinite = false;
            return;
        }
        const auto size = std::abs(value);
        peak = std::max(peak, size);
        areWhole = areWhole && std::trunc(value) == value;
        const int exponent = size > 0.0 ? std::ilogb(size) : lowest - 1;
        if (exponent >= lowest && exponent <= highest)
            exponents |= std::uint64_t{1} << static_cast<unsigned>(exponent - lowest);
        else
            ++unusual;
        (value < 0.0 ? hasBelow : hasAbove) = true;
    }

    void takeInteger(std::uint64_t bits)
    {
        any |= bits;
        const auto width = 8 * words.bytes;
        const bool isBelow = (bits >> (width - 1)) != 0;
        magnitude |= isBelow ? ~bits & ((std::uint64_t{1} << width) - 1) : bits;
    }

    SampleWords words;
    std::uint64_t any = 0, magnitude = 0, exponents = 0, unusual = 0;
    bool hasBelow = false, hasAbove = false;
};

enum class Justified
{
    asStated,
    high,   ///< as all formats have it, in words that libsndfile misreads
    low,    ///< integers at the low end of their words
    quiet,  ///< integers that may be so
    number, ///< floating-point numbers that are called integers
    whole,  ///< integers as floating-point numbers
    loud    ///< floating-point numbers far beyond full scale
};

Justified judge(const SampleWords& words, const WordScan& scan)
{
    constexpr std::uint64_t fewestWords = 64; // that are no chance
    constexpr double leastWhole = 16.0, loudest = 256.0;
    if (words.isFloat)
    {
        if (!scan.areFinite || scan.sounding < fewestWords)
            return Justified::asStated;
        if (scan.areWhole && scan.peak >= leastWhole)
            return Justified::whole;
        return scan.peak > loudest ? Justified::loud : Justified::asStated;
    }
    if (words.bytes == 4 && scan.areNumbers())
        return Justified::number;
    if (scan.isSilent())
        return words.isMisread ? Justified::high : Justified::asStated;
    const auto spare = 8 * words.bytes - words.bits;
    if (spare == 0)
    {
        constexpr std::uint64_t usual = 24;
        const bool isQuiet = words.bytes == 4 && scan.integerBits() <= usual && scan.lowZeros() == 0;
        return isQuiet && scan.sounding >= fewestWords ? Justified::quiet : Justified::asStated;
    }
    const bool fitsLow = scan.integerBits() <= words.bits;
    if (scan.lowZeros() >= spare)
        return fitsLow ? Justified::quiet : Justified::high;
    return fitsLow ? Justified::low : Justified::asStated;
}

void scanAll(ByteWindow& file, std::span<const ByteRange> audio, const SampleWords& words, WordScan& scan)
{
    const auto piece = ByteWindow::most / words.bytes * words.bytes;
    for (const ByteRange& range : audio)
        for (auto at = range.begin; at < range.end; at += piece)
            scan.take(file.at(at, static_cast<std::size_t>(std::min(piece, range.end - at))));
}

/// Some pieces of the audio, which mostly show that it is as stated.
void scanSome(ByteWindow& file, std::span<const ByteRange> audio, const SampleWords& words, WordScan& scan)
{
    constexpr std::uint64_t pieces = 16, pieceBytes = 4096;
    for (const ByteRange& range : audio.first(std::min<std::size_t>(audio.size(), 1)))
    {
        const auto count = range.end > range.begin ? range.end - range.begin : 0;
        for (std::uint64_t i = 0; i < pieces; ++i)
        {
            const auto from = count / pieces * i / words.bytes * words.bytes;
            scan.take(file.at(range.begin + from, static_cast<std::size_t>(std::min(pieceBytes, count - from))));
        }
    }
}

double decibels(std::uint64_t bits)
{
    return 20.0 * std::log10(2.0) * static_cast<double>(bits);
}

/// 2^bits for integers of 16, 24 or 32 bits that reach `peak`.
int fullScaleBits(double peak)
{
    return peak <= 32768.0 ? 15 : peak <= 8388608.0 ? 23 : 31;
}

SampleReading readingOf(const SampleWords& words, Justified found, const WordScan& scan)
{
    const auto width = 8 * words.bytes;
    switch (found)
    {
    case Justified::low:
        return {words.asInteger, std::ldexp(1.0, static_cast<int>(width - words.bits)),
                fmt::format("has samples of {} bits at the low end of words of {} bits, not at the high end; they are "
                            "read there, {:.0f} dB louder than other programs may play them; save it anew",
                            words.bits, width, decibels(width - words.bits))};
    case Justified::high:
        return {words.isMisread ? words.asInteger : std::vector<BytePatch>(), 1.0, ""};
    case Justified::quiet:
        return {words.isMisread ? words.asInteger : std::vector<BytePatch>(), 1.0,
                fmt::format(
                    "uses {} of the {} bits of its samples, at the low end; it is read as its header has it, {:.0f} "
                    "dB below full scale; if that is too soft, save it anew with the right number of bits",
                    scan.integerBits(), width, decibels(width - scan.integerBits()))};
    case Justified::number:
    {
        // Cool Edit wrote such files: "24.0 float" states 24 bits, "16.8 float" others.
        if (words.asFloat.empty())
            return {
                {},
                1.0,
                fmt::format("states integers of {} bits, but seems to have floating-point numbers, which this format "
                            "does not have; it is read as stated, which may be noise; save it anew",
                            words.bits)};
        constexpr double loudest = 8.0;
        const int scale = scan.peak <= loudest ? 0 : words.bits == 24 || scan.peak > 131072.0 ? 23 : 15;
        auto warning = scale == 0
                           ? fmt::format("states integers of {} bits, but has floating-point numbers; it is read "
                                         "as these; save it anew",
                                         words.bits)
                           : fmt::format("states integers of {} bits, but has floating-point numbers whose full "
                                         "scale is {:.0f}; it is read as these; save it anew",
                                         words.bits, std::ldexp(1.0, scale));
        return {words.asFloat, std::ldexp(1.0, -scale), std::move(warning)};
    }
    case Justified::whole:
    {
        const int scale = fullScaleBits(scan.peak);
        return {{},
                std::ldexp(1.0, -scale),
                fmt::format("has floating-point samples that are all whole numbers, up to {:.0f}; they are read as "
                            "integers of {} bits, with a full scale of {:.0f}; save it anew",
                            scan.peak, scale + 1, std::ldexp(1.0, scale))};
    }
    case Justified::loud:
        return {
            {},
            1.0,
            fmt::format("has floating-point samples up to {:.0f} times full scale, which are read as they are; scale "
                        "them to 1 if that is not meant",
                        scan.peak)};
    case Justified::asStated:
        break;
    }
    return {};
}
} // namespace

SampleReading sampleReading(ByteWindow& file, std::uint64_t begin, std::uint64_t headerEnd,
                            std::span<const ByteRange> audio)
{
    const auto words = sampleWords(file, begin, headerEnd);
    if (!words || words->bits > 8 * words->bytes)
        return {};
    const bool isKnown =
        words->isFloat ? words->bytes == 4 || words->bytes == 8 : words->bytes >= 2 && words->bytes <= 4;
    if (!isKnown || (words->isFloat && words->isMisread))
        return {};
    // Full words of up to 24 bits say nothing of their own.
    if (!words->isFloat && words->bytes < 4 && words->bits == 8 * words->bytes)
        return {};
    WordScan some(*words);
    scanSome(file, audio, *words, some);
    if (const auto found = judge(*words, some); found == Justified::asStated && !some.isSilent())
        return {.patches = words->always};
    WordScan all(*words);
    scanAll(file, audio, *words, all);
    auto reading = readingOf(*words, judge(*words, all), all);
    reading.patches.insert(reading.patches.end(), words->always.begin(), words->always.end());
    return reading;
}

} // namespace pacini
