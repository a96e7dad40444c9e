#include "io/formats/ForeignText.h"
#include "io/formats/hjif/HjifImport.h"
#include "io/formats/hmpg/HmpgBits.h"
#include "io/formats/hmpg/HmpgFields.h"
#include "io/formats/hmpg/HmpgFormat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
constexpr std::size_t mostEffectsRead = 1'000'000, mostKeyframesRead = 5'000'000;
constexpr std::size_t mostChannels = 4096;
constexpr std::size_t mostTimelines = 32; // one inside of the other

bool isSpatial(std::string_view modality)
{
    return modality == "Vibrotactile Texture" || modality == "Stiffness" || modality == "Friction";
}

/// Bits of a wavelet block as the text that HJIF files have: bytes from their lowest bit, six bits a character.
std::string streamText(std::string_view bytes)
{
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    unsigned bits = 0;
    int count = 0;
    for (const char c : bytes)
        for (int i = 0; i < 8; ++i)
        {
            bits = (bits << 1) | ((static_cast<unsigned char>(c) >> i) & 1u);
            if (++count == 6)
            {
                text += alphabet[bits];
                bits = 0;
                count = 0;
            }
        }
    if (count > 0)
        text += alphabet[bits << (6 - count)];
    return text;
}

/// Lists grow by emplace_back() alone, as those of the JSON reader, whose code this shares in libpacini.
class Reader
{
public:
    Reader(std::string_view bytesToRead, std::vector<std::string>& warningsFound)
        : bytes(bytesToRead), warnings(warningsFound)
    {
    }

    Result<HjifFile> read()
    {
        for (std::size_t at = 0; at < bytes.size() && !error;)
            at = readUnit(at);
        if (!error && version.empty())
            fail(0, "has no description of the file");
        if (!error)
            checkEffects();
        if (!error)
            error = checkHjifVersion(version, warnings);
        if (error)
            return *std::move(error);
        return std::move(file);
    }

private:
    static constexpr std::size_t none = SIZE_MAX;

    /// Where a channel is, by the index of its perception and its number.
    struct Channel
    {
        std::size_t perception;
        std::uint64_t number;
        std::size_t index;
    };

    struct Place
    {
        std::size_t perception = none, channel = 0, band = 0;
        std::uint64_t stated = 0;           ///< effects
        std::vector<std::uint32_t> effects; ///< index + 1 by number
    };

    void fail(std::size_t at, const std::string& message, ErrorCode code = ErrorCode::invalidData)
    {
        if (!error)
            error = Error{code, fmt::format("byte {}", at), message};
    }

    /// Returns where the next unit begins.
    std::size_t readUnit(std::size_t at)
    {
        if (bytes.size() - at < hmpgUnitHeader)
        {
            fail(at, "is cut off within the head of a unit");
            return bytes.size();
        }
        HmpgBitReader head(bytes.substr(at, hmpgUnitHeader));
        const std::uint64_t kind = head.take(6);
        head.skip(2 + 4);
        const std::uint64_t ticks = head.take(24), length = head.take(32);
        const std::size_t first = at + hmpgUnitHeader;
        if (length > bytes.size() - first)
        {
            fail(at, fmt::format("is cut off: {} of the {} bytes of a unit", bytes.size() - first, length));
            return bytes.size();
        }
        const auto end = first + static_cast<std::size_t>(length);
        if (kind <= static_cast<std::uint64_t>(HmpgUnit::temporal))
            for (std::size_t packet = first; packet < end && !error;)
                packet = readPacket(packet, end);
        else if (kind == static_cast<std::uint64_t>(HmpgUnit::silent))
        {
            if (length > 0)
                leaveOut(at, "content in a silent unit");
        }
        else
            leaveOut(at, kind == static_cast<std::uint64_t>(HmpgUnit::spatial) ? "a unit of spatial haptics"
                                                                               : "a unit of an unknown kind");
        time += static_cast<double>(ticks);
        return end;
    }

    void leaveOut(std::size_t at, const std::string& what)
    {
        if (std::find(leftOut.begin(), leftOut.end(), what) != leftOut.end())
            return;
        leftOut.push_back(what);
        warnings.push_back(fmt::format("byte {}: {} is left out", at, what));
    }

    /// Returns where the next packet of the unit that ends at `end` begins.
    std::size_t readPacket(std::size_t at, std::size_t end)
    {
        if (end - at < hmpgPacketHeader)
        {
            fail(at, "is cut off within the head of a packet");
            return end;
        }
        HmpgBitReader head(bytes.substr(at, hmpgPacketHeader));
        const std::uint64_t kind = head.take(6), length = head.take(17);
        const std::size_t first = at + hmpgPacketHeader;
        if (length > end - first)
        {
            fail(at, fmt::format("is cut off: {} of the {} bytes of a packet", end - first, length));
            return end;
        }
        place = at;
        HmpgBitReader bits(bytes.substr(first, static_cast<std::size_t>(length)));
        switch (static_cast<HmpgPacket>(kind))
        {
        case HmpgPacket::firstTiming:
            readFirstTiming(bits);
            break;
        case HmpgPacket::timing:
            time = static_cast<double>(bits.take(32));
            break;
        case HmpgPacket::file:
            readHead(bits);
            break;
        case HmpgPacket::perception:
            readPerception(bits);
            break;
        case HmpgPacket::library:
            readLibrary(bits);
            break;
        case HmpgPacket::channel:
            readChannel(bits);
            break;
        case HmpgPacket::band:
            readBand(bits);
            break;
        case HmpgPacket::data:
            readData(bits);
            break;
        case HmpgPacket::checksum16:
        case HmpgPacket::checksumOfAll16:
            bits.skip(16);
            break;
        case HmpgPacket::checksum32:
        case HmpgPacket::checksumOfAll32:
            bits.skip(32);
            break;
        default:
            leaveOut(at, fmt::format("a packet of kind {}", kind));
        }
        if (bits.failed())
            fail(at, "is a packet that ends before its content");
        // Of others, what follows is of no use here.
        constexpr HmpgPacket whole[] = {HmpgPacket::timing,          HmpgPacket::band,           HmpgPacket::data,
                                        HmpgPacket::library,         HmpgPacket::checksum16,     HmpgPacket::checksum32,
                                        HmpgPacket::checksumOfAll16, HmpgPacket::checksumOfAll32};
        if (bits.wholeBytesLeft() > 0 && !isLeftOut &&
            std::find(std::begin(whole), std::end(whole), static_cast<HmpgPacket>(kind)) != std::end(whole))
            leaveOut(at, "what follows in a packet");
        isLeftOut = false;
        return first + static_cast<std::size_t>(length);
    }

    void readFirstTiming(HmpgBitReader& bits)
    {
        time = static_cast<double>(bits.take(32));
        const bool isFirst = !std::exchange(isTimed, true);
        const double before = std::exchange(file.ticks, static_cast<double>(bits.take(32)));
        if (!isFirst && file.ticks != before)
            fail(place, fmt::format("has {} ticks per second, but {} before", file.ticks, before));
        if (!(file.ticks >= 1.0 && file.ticks <= 1e9))
            fail(place, fmt::format("has {} ticks per second, not 1 to 1000000000", file.ticks));
    }

    void readHead(HmpgBitReader& bits)
    {
        version = bits.takeText();
        bits.skipText(); // profile
        bits.skip(8);    // level
        bits.skipText(); // date
        file.description = bits.takeText();
        // Perceptions come in packets of their own; nothing is played by avatars.
    }

    void readPerception(HmpgBitReader& bits)
    {
        HjifPerception perception;
        const std::uint64_t number = bits.take(8);
        bits.skip(8); // priority
        bits.skipText();
        perception.modality = nameOf(hmpgModalities, bits.take(8), "modality");
        bits.skip(8 + 16); // avatar, effects of the library
        if (bits.take(1) == 1)
            bits.skipText(); // scheme of meanings
        bits.skip(8);        // exponent of the unit
        perception.unitExponent = static_cast<double>(bits.takeSigned(8));
        // Units of the reference devices that follow change nothing of what is played.
        if (perceptions[number] != none)
            return; // again in each initialisation
        perceptions[number] = file.perceptions.size();
        file.perceptions.emplace_back() = std::move(perception);
    }

    void readChannel(HmpgBitReader& bits)
    {
        HjifChannel channel;
        const std::uint64_t number = bits.take(16);
        const std::size_t owner = perceptions[bits.take(8)];
        bits.skip(8); // priority
        bits.skipText();
        bits.skip(8); // reference device
        channel.gain = hmpgGain.valueOf(bits.take(hmpgGain.bits));
        bits.skip(hmpgMixing.bits);
        const std::uint64_t has = bits.take(8);
        if ((has & 1u) != 0)
            bits.skip(32); // mask of body parts
        else if ((has & 2u) != 0)
        {
            bits.skip(24);   // resolution
            bits.skipText(); // parts of the body, a byte each
            for (std::uint64_t n = bits.take(8); n > 0 && !bits.failed(); --n)
                bits.skip(24);
        }
        if (const std::uint64_t rate = bits.take(32); rate > 0)
        {
            channel.rate = static_cast<double>(rate);
            channel.samples = static_cast<double>(bits.take(32));
        }
        // Direction and vertices follow.
        if (owner == none)
            return fail(place, "is a channel of no perception");
        if (channelOf(owner, number) != none)
            return;
        if (!isWithin(channels.size() + 1, mostChannels, "channels"))
            return;
        auto& siblings = file.perceptions[owner].channels;
        channels.push_back({owner, number, siblings.size()});
        siblings.emplace_back() = std::move(channel);
    }

    [[nodiscard]] std::size_t channelOf(std::size_t perception, std::uint64_t number) const
    {
        for (const Channel& known : channels)
            if (known.perception == perception && known.number == number)
                return known.index;
        return none;
    }

    void readBand(HmpgBitReader& bits)
    {
        HjifBand band;
        const std::uint64_t number = bits.take(8);
        const std::size_t owner = perceptions[bits.take(8)];
        const std::size_t channel = channelOf(owner, bits.take(16));
        bits.skip(8); // priority
        band.type = nameOf(hmpgBandTypes, bits.take(3), "type of band");
        if (band.type == "Curve")
            band.curve = nameOf(hmpgCurves, bits.take(4), "curve");
        else if (band.type == "WaveletWave")
            band.blockLength = static_cast<double>(bits.take(8));
        band.low = static_cast<double>(bits.take(16));
        band.high = static_cast<double>(bits.take(16));
        const std::uint64_t stated = bits.take(16);
        if (channel == none)
            return fail(place, "is a band of no channel");
        if (const Place& known = bands[number]; known.perception != none)
        {
            const HjifBand& first = file.perceptions[known.perception].channels[known.channel].bands[known.band];
            if (known.perception != owner || known.channel != channel || first.type != band.type ||
                first.low != band.low || first.high != band.high)
                leaveOut(place, "a second band of its number");
            return;
        }
        auto& siblings = file.perceptions[owner].channels[channel].bands;
        bands[number] = {owner, channel, siblings.size(), stated, {}};
        siblings.emplace_back() = std::move(band);
    }

    /// Tells of effects that a band states and no packet had: a file that ends between units is not cut off otherwise.
    void checkEffects()
    {
        constexpr std::uint64_t most = 65535; // which may stand for more
        for (std::size_t number = 0; number < bands.size(); ++number)
        {
            const Place& known = bands[number];
            if (known.perception == none || known.stated == most ||
                isSpatial(file.perceptions[known.perception].modality))
                continue;
            const auto& found = file.perceptions[known.perception].channels[known.channel].bands[known.band].effects;
            if (found.size() < known.stated)
                warnings.push_back(fmt::format("lacks {} of {} effects of band {}; it may be cut off",
                                               known.stated - found.size(), known.stated, number));
        }
    }

    void readLibrary(HmpgBitReader& bits)
    {
        const std::size_t owner = perceptions[bits.take(8)];
        if (owner == none)
            return fail(place, "is a library of no perception");
        auto& library = file.perceptions[owner].library;
        library.clear(); // again in each initialisation
        for (std::uint64_t n = bits.take(16); n > 0 && !bits.failed() && !error; --n)
            library.emplace_back() = libraryEffect(bits, 0);
    }

    HjifEffect libraryEffect(HmpgBitReader& bits, std::size_t depth)
    {
        HjifEffect effect;
        if (depth == mostTimelines)
        {
            fail(place, fmt::format("has more than {} timelines inside of each other", mostTimelines));
            return effect;
        }
        effect.id = static_cast<double>(bits.take(16));
        const std::uint64_t type = bits.take(2);
        effect.type = nameOf(hmpgEffects, type, "type of effect");
        skipMeaning(bits);
        effect.position = static_cast<double>(bits.take(25));
        if (type == 0)
            readWave(effect, bits);
        for (std::uint64_t n = bits.take(16); n > 0 && !bits.failed() && countKeyframe(); --n)
        {
            HjifKeyframe keyframe;
            const std::uint64_t has = bits.take(3);
            if ((has & 1u) != 0)
                keyframe.position = static_cast<double>(bits.take(16));
            if ((has & 2u) != 0)
                keyframe.amplitude = HmpgAmplitude::valueOf(bits.take(8));
            if ((has & 4u) != 0)
                keyframe.frequency = static_cast<double>(bits.take(16));
            effect.keyframes.emplace_back() = keyframe;
        }
        for (std::uint64_t n = bits.take(16); n > 0 && !bits.failed() && countEffect(); --n)
            libraryEffect(bits, depth + 1); // Composite effects are left out with a warning of the import
        return effect;
    }

    static void readWave(HjifEffect& effect, HmpgBitReader& bits)
    {
        effect.phase = hmpgPhase.valueOf(bits.take(hmpgPhase.bits));
        const std::uint64_t signal = bits.take(4);
        effect.baseSignal = signal < hmpgSignals.size() ? hmpgSignals[signal] : "Unknown";
    }

    static void skipMeaning(HmpgBitReader& bits)
    {
        if (bits.take(1) == 1)
            bits.skip(12);
    }

    void readData(HmpgBitReader& bits)
    {
        bits.skip(1 + 8 + 16); // kind of access, perception, channel: a band's number says them
        Place& target = bands[bits.take(8)];
        if (target.perception == none)
            return fail(place, "has data of no band");
        const HjifPerception& perception = file.perceptions[target.perception];
        HjifBand& band = file.perceptions[target.perception].channels[target.channel].bands[target.band];
        if (isSpatial(perception.modality))
        {
            isLeftOut = true; // has another layout, and the import leaves it out with a warning
            return;
        }
        for (std::uint64_t n = bits.take(16); n > 0 && !bits.failed() && countEffect(); --n)
            if (band.type == "WaveletWave")
                band.effects.emplace_back() = block(bits, band);
            else
                addEffect(bits, band, target);
    }

    HjifEffect block(HmpgBitReader& bits, const HjifBand& band)
    {
        HjifEffect effect;
        bits.skip(16); // number
        effect.type = nameOf(hmpgEffects, bits.take(2), "type of effect");
        skipMeaning(bits);
        effect.position = static_cast<double>(band.effects.size()) * band.blockLength.value_or(0.0);
        effect.stream = streamText(bits.takeBytes(bits.take(16)));
        return effect;
    }

    /// The keyframes of an effect that are in this unit; those of former ones are in `band`.
    void addEffect(HmpgBitReader& bits, HjifBand& band, Place& target)
    {
        const std::uint64_t number = bits.take(16), type = bits.take(2);
        HjifEffect effect;
        effect.type = nameOf(hmpgEffects, type, "type of effect");
        effect.position = time + static_cast<double>(bits.takeSigned(25));
        if (type != 0)
        {
            effect.id = static_cast<double>(number);
            band.effects.emplace_back() = std::move(effect);
            return;
        }
        skipMeaning(bits);
        const std::uint64_t here = bits.take(16);
        if (band.type == "VectorialWave")
            readWave(effect, bits);
        target.effects.resize(65536);
        std::uint32_t& known = target.effects[number];
        if (known == 0)
        {
            band.effects.emplace_back() = std::move(effect);
            known = static_cast<std::uint32_t>(band.effects.size());
        }
        HjifEffect& whole = band.effects[known - 1];
        for (std::uint64_t n = here; n > 0 && !bits.failed() && countKeyframe(); --n)
            whole.keyframes.emplace_back() = keyframe(bits, band.type);
    }

    static HjifKeyframe keyframe(HmpgBitReader& bits, std::string_view type)
    {
        HjifKeyframe made;
        const std::uint64_t has = type == "VectorialWave" ? bits.take(2) : type == "Transient" ? 3u : 1u;
        if ((has & 1u) != 0)
            made.amplitude = HmpgAmplitude::valueOf(bits.take(8));
        made.position = static_cast<double>(bits.take(16));
        if ((has & 2u) != 0)
            made.frequency = static_cast<double>(bits.take(16));
        return made;
    }

    std::string_view nameOf(std::span<const std::string_view> names, std::uint64_t code, const char* what)
    {
        if (code < names.size())
            return names[static_cast<std::size_t>(code)];
        fail(place, fmt::format("has the {} {}, and the last one known is {}", what, code, names.size() - 1));
        return {};
    }

    [[nodiscard]] bool countEffect() { return isWithin(++effects, mostEffectsRead, "effects"); }
    [[nodiscard]] bool countKeyframe() { return isWithin(++keyframes, mostKeyframesRead, "keyframes"); }

    [[nodiscard]] bool isWithin(std::size_t count, std::size_t most, const char* what)
    {
        if (count > most)
            fail(place, fmt::format("has more than {} {}", most, what), ErrorCode::tooLarge);
        return !error;
    }

    std::string_view bytes;
    std::vector<std::string>& warnings;
    HjifFile file;
    std::string version;
    std::optional<Error> error;
    std::vector<std::size_t> perceptions = std::vector<std::size_t>(256, none); ///< indices by number
    std::vector<Channel> channels;
    std::vector<Place> bands = std::vector<Place>(256); ///< by number
    std::vector<std::string> leftOut;
    bool isTimed = false;
    bool isLeftOut = false; ///< the packet that is read
    std::size_t place = 0, effects = 0, keyframes = 0;
    double time = 0.0; ///< ticks, of the unit
};
} // namespace

bool isHmpg(std::string_view bytes)
{
    if (bytes.size() < hmpgUnitHeader + hmpgPacketHeader + hmpgFirstTiming)
        return false;
    HmpgBitReader bits(bytes);
    const bool initialises = bits.take(6 + 2) == 0;
    bits.skip(4); // layer
    const bool takesNoTime = bits.take(24) == 0;
    bits.skip(32 + 4);
    return initialises && takesNoTime && bits.take(6) == static_cast<std::uint64_t>(HmpgPacket::firstTiming) &&
           bits.take(17) == hmpgFirstTiming;
}

Result<ImportedClip> readHmpg(std::string_view bytes)
{
    if (bytes.size() > largestForeignText)
        return Error{ErrorCode::tooLarge, "", fmt::format("is larger than {} MB", largestForeignText >> 20)};
    ImportedClip imported;
    const auto file = Reader(bytes, imported.warnings).read();
    if (!file)
        return file.error();
    if (auto error = importHjif(*file, imported))
        return *std::move(error);
    if (auto valid = validate(imported.clip); !valid)
        return valid.error();
    return imported;
}

} // namespace pacini
