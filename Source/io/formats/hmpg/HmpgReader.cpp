#include "io/formats/ForeignText.h"
#include "io/formats/hjif/HjifImport.h"
#include "io/formats/hmpg/HmpgBits.h"
#include "io/formats/hmpg/HmpgFields.h"
#include "io/formats/hmpg/HmpgFormat.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t mostEffectsRead = 1'000'000, mostKeyframesRead = 5'000'000;
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
            error = checkHjifVersion(version, warnings);
        if (error)
            return *std::move(error);
        return std::move(file);
    }

private:
    using Key = std::pair<std::size_t, std::size_t>;
    struct Place
    {
        std::size_t perception, channel, band;
        std::map<std::uint64_t, std::size_t> effects; ///< indices by number
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
        head.take(2 + 4);
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
        else if (kind != static_cast<std::uint64_t>(HmpgUnit::silent))
            leaveOut(at, kind == static_cast<std::uint64_t>(HmpgUnit::spatial) ? "a unit of spatial haptics"
                                                                               : "a unit of an unknown kind");
        time += static_cast<double>(ticks);
        return end;
    }

    void leaveOut(std::size_t at, const std::string& what)
    {
        if (leftOut.insert(what).second)
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
        case HmpgPacket::checksum32:
        case HmpgPacket::checksumOfAll16:
        case HmpgPacket::checksumOfAll32:
            break;
        default:
            leaveOut(at, fmt::format("a packet of kind {}", kind));
        }
        if (bits.failed())
            fail(at, "is a packet that ends before its content");
        return first + static_cast<std::size_t>(length);
    }

    void readFirstTiming(HmpgBitReader& bits)
    {
        time = static_cast<double>(bits.take(32));
        file.ticks = static_cast<double>(bits.take(32));
        if (!(file.ticks >= 1.0 && file.ticks <= 1e9))
            fail(place, fmt::format("has {} ticks per second, not 1 to 1000000000", file.ticks));
    }

    void readHead(HmpgBitReader& bits)
    {
        version = bits.takeText();
        bits.takeText(); // profile
        bits.take(8);    // level
        bits.takeText(); // date
        file.description = bits.takeText();
        // Perceptions come in packets of their own; nothing is played by avatars.
    }

    void readPerception(HmpgBitReader& bits)
    {
        HjifPerception perception;
        const std::uint64_t number = bits.take(8);
        bits.take(8); // priority
        bits.takeText();
        perception.modality = nameOf(hmpgModalities, bits.take(8), "modality");
        bits.take(8 + 16); // avatar, effects of the library
        if (bits.take(1) == 1)
            bits.takeText(); // scheme of meanings
        bits.take(8);        // exponent of the unit
        perception.unitExponent = static_cast<double>(bits.takeSigned(8));
        // Units of the reference devices that follow change nothing of what is played.
        if (perceptions.emplace(number, file.perceptions.size()).second) // again in each initialisation
            file.perceptions.push_back(std::move(perception));
    }

    void readChannel(HmpgBitReader& bits)
    {
        HjifChannel channel;
        const std::uint64_t number = bits.take(16);
        const auto owner = perceptions.find(bits.take(8));
        bits.take(8); // priority
        bits.takeText();
        bits.take(8); // reference device
        channel.gain = hmpgGain.valueOf(bits.take(hmpgGain.bits));
        bits.take(hmpgMixing.bits);
        const std::uint64_t has = bits.take(8);
        if ((has & 1u) != 0)
            bits.take(32); // mask of body parts
        else if ((has & 2u) != 0)
        {
            bits.take(3 * 8); // resolution
            bits.takeText();  // parts of the body, a byte each
            for (std::uint64_t n = bits.take(8); n > 0 && !bits.failed(); --n)
                bits.take(3 * 8);
        }
        if (const std::uint64_t rate = bits.take(32); rate > 0)
        {
            channel.rate = static_cast<double>(rate);
            channel.samples = static_cast<double>(bits.take(32));
        }
        // Direction and vertices follow.
        if (owner == perceptions.end())
            return fail(place, "is a channel of no perception");
        auto& siblings = file.perceptions[owner->second].channels;
        if (channels.emplace(Key{owner->second, number}, siblings.size()).second)
            siblings.push_back(std::move(channel));
    }

    void readBand(HmpgBitReader& bits)
    {
        HjifBand band;
        const std::uint64_t number = bits.take(8);
        const auto owner = perceptions.find(bits.take(8));
        const std::uint64_t channelNumber = bits.take(16);
        bits.take(8); // priority
        band.type = nameOf(hmpgBandTypes, bits.take(3), "type of band");
        if (band.type == "Curve")
            band.curve = nameOf(hmpgCurves, bits.take(4), "curve");
        else if (band.type == "WaveletWave")
            band.blockLength = static_cast<double>(bits.take(8));
        band.low = static_cast<double>(bits.take(16));
        band.high = static_cast<double>(bits.take(16));
        if (owner == perceptions.end() || !channels.contains({owner->second, channelNumber}))
            return fail(place, "is a band of no channel");
        const std::size_t channel = channels[{owner->second, channelNumber}];
        auto& siblings = file.perceptions[owner->second].channels[channel].bands;
        if (bands.emplace(number, Place{owner->second, channel, siblings.size(), {}}).second)
            siblings.push_back(std::move(band));
    }

    void readLibrary(HmpgBitReader& bits)
    {
        const auto owner = perceptions.find(bits.take(8));
        if (owner == perceptions.end())
            return fail(place, "is a library of no perception");
        auto& library = file.perceptions[owner->second].library;
        library.clear(); // again in each initialisation
        for (std::uint64_t n = bits.take(16); n > 0 && !bits.failed() && !error; --n)
            library.push_back(libraryEffect(bits, 0));
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
            effect.keyframes.push_back(keyframe);
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
            bits.take(12);
    }

    void readData(HmpgBitReader& bits)
    {
        bits.take(1 + 8 + 16); // kind of access, perception, channel: a band's number says them
        const auto found = bands.find(bits.take(8));
        if (found == bands.end())
            return fail(place, "has data of no band");
        Place& target = found->second;
        const HjifPerception& perception = file.perceptions[target.perception];
        HjifBand& band = file.perceptions[target.perception].channels[target.channel].bands[target.band];
        if (isSpatial(perception.modality))
            return; // has another layout, and the import leaves it out with a warning
        for (std::uint64_t n = bits.take(16); n > 0 && !bits.failed() && countEffect(); --n)
            if (band.type == "WaveletWave")
                band.effects.push_back(block(bits, band));
            else
                addEffect(bits, band, target);
    }

    HjifEffect block(HmpgBitReader& bits, const HjifBand& band)
    {
        HjifEffect effect;
        bits.take(16); // number
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
            band.effects.push_back(std::move(effect));
            return;
        }
        skipMeaning(bits);
        const std::uint64_t here = bits.take(16);
        if (band.type == "VectorialWave")
            readWave(effect, bits);
        const auto [known, isNew] = target.effects.emplace(number, band.effects.size());
        if (isNew)
            band.effects.push_back(std::move(effect));
        HjifEffect& whole = band.effects[known->second];
        for (std::uint64_t n = here; n > 0 && !bits.failed() && countKeyframe(); --n)
            whole.keyframes.push_back(keyframe(bits, band.type));
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

    template <std::size_t size>
    std::string nameOf(const std::array<std::string_view, size>& names, std::uint64_t code, const char* what)
    {
        if (code < size)
            return std::string(names[static_cast<std::size_t>(code)]);
        fail(place, fmt::format("has the {} {}, and the last one known is {}", what, code, size - 1));
        return {};
    }

    [[nodiscard]] bool countEffect()
    {
        if (++effects > mostEffectsRead)
            fail(place, fmt::format("has more than {} effects", mostEffectsRead), ErrorCode::tooLarge);
        return !error;
    }

    [[nodiscard]] bool countKeyframe()
    {
        if (++keyframes > mostKeyframesRead)
            fail(place, fmt::format("has more than {} keyframes", mostKeyframesRead), ErrorCode::tooLarge);
        return !error;
    }

    std::string_view bytes;
    std::vector<std::string>& warnings;
    HjifFile file;
    std::string version;
    std::optional<Error> error;
    std::map<std::uint64_t, std::size_t> perceptions; ///< indices by number
    std::map<Key, std::size_t> channels;              ///< likewise, by perception and number
    std::map<std::uint64_t, Place> bands;             ///< by number
    std::set<std::string> leftOut;
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
    bits.take(4); // layer
    const bool takesNoTime = bits.take(24) == 0;
    bits.take(32 + 4);
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
