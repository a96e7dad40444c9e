#include "io/formats/ForeignText.h"
#include "io/formats/hjif/HjifModel.h"
#include "io/formats/hmpg/HmpgBits.h"
#include "io/formats/hmpg/HmpgFields.h"
#include "io/formats/hmpg/HmpgFormat.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
constexpr std::size_t mostEffects = 65536; // of one file: each has a number of 16 bits
constexpr std::size_t longestText = 255;   // bytes

/// A float of the reference reader tells gains apart that differ by this much.
constexpr HjifModelParams limitsOfFile{.lowestGain = 0.125, .gainSteps = 1024.0, .longestEffect = 60.0};

std::uint64_t whole(double value)
{
    return static_cast<std::uint64_t>(std::llround(value));
}

void addPacket(std::string& unit, HmpgPacket kind, const HmpgBitWriter& payload)
{
    HmpgBitWriter header;
    header.put(static_cast<std::uint64_t>(kind), 6);
    header.put(payload.bytes().size(), 17);
    header.put(0, 1);
    unit += header.bytes() + payload.bytes();
}

std::string unitOf(HmpgUnit kind, bool isIndependent, std::uint64_t ticks, const std::string& packets)
{
    HmpgBitWriter header;
    header.put(static_cast<std::uint64_t>(kind), 6);
    header.put(isIndependent ? 0 : 1, 2);
    header.put(0, 4); // layer
    header.put(ticks, 24);
    header.put(packets.size(), 32);
    header.put(0, 4);
    return header.bytes() + packets;
}

std::string initialisation(const HjifFile& file)
{
    const HjifPerception& perception = file.perceptions.front();
    const HjifChannel& channel = perception.channels.front();
    std::string packets;
    HmpgBitWriter timing;
    timing.put(0, 32);
    timing.put(whole(file.ticks), 32);
    timing.put(hmpgUnitLength, 24);
    timing.put(0, 24); // all units are of that length
    timing.put(0, 1);  // and do not overlap
    addPacket(packets, HmpgPacket::firstTiming, timing);

    HmpgBitWriter head;
    const HjifProfile profile = hjifProfileOf(file);
    head.putText("2023");
    head.putText(profile.name);
    head.put(static_cast<std::uint64_t>(profile.level), 8);
    head.putText("2023-01-01");
    head.putText(file.description);
    head.put(1, 8); // perceptions
    head.put(0, 8); // avatars
    addPacket(packets, HmpgPacket::file, head);

    HmpgBitWriter touch;
    touch.put(0, 8); // number
    touch.put(0, 8); // priority
    touch.putText(file.description);
    touch.put(hmpgCodeOf(hmpgModalities, perception.modality), 8);
    touch.put(0, 8);   // avatar
    touch.put(0, 16);  // effects of a library
    touch.put(0, 1);   // no meanings of effects
    touch.put(253, 8); // exponent of the unit: -3, as where none is given
    touch.put(0, 8);   // of the perception's unit
    touch.put(0, 8);   // reference devices
    touch.put(1, 16);  // channels
    addPacket(packets, HmpgPacket::perception, touch);

    HmpgBitWriter line;
    line.put(0, 16); // number
    line.put(0, 8);  // perception
    line.put(0, 8);  // priority
    line.putText(file.description);
    line.put(255, 8); // no reference device
    line.put(hmpgGain.codeOf(channel.gain), hmpgGain.bits);
    line.put(hmpgMixing.codeOf(1.0), hmpgMixing.bits);
    line.put(1, 8);  // a mask of body parts follows
    line.put(0, 32); // of none
    line.put(whole(channel.rate.value_or(0.0)), 32);
    line.put(whole(channel.samples.value_or(0.0)), 32);
    line.put(0, 16); // vertices
    line.put(channel.bands.size(), 8);
    addPacket(packets, HmpgPacket::channel, line);

    for (std::size_t i = 0; i < channel.bands.size(); ++i)
    {
        const HjifBand& band = channel.bands[i];
        HmpgBitWriter bits;
        bits.put(i, 8);
        bits.put(0, 8);  // perception
        bits.put(0, 16); // channel
        bits.put(0, 8);  // priority
        bits.put(hmpgCodeOf(hmpgBandTypes, band.type), 3);
        bits.put(std::min<std::uint64_t>(whole(band.low), 65535), 16);
        bits.put(std::min<std::uint64_t>(whole(band.high), 65535), 16);
        bits.put(std::min<std::size_t>(band.effects.size(), 65535), 16);
        addPacket(packets, HmpgPacket::band, bits);
    }
    return unitOf(HmpgUnit::initialisation, true, 0, packets);
}

/// The keyframes of an effect that lie in one unit.
struct Part
{
    const HjifEffect* effect;
    std::uint64_t number; ///< of the effect
    std::size_t first, end;
};

/// The parts in each band, by number of the unit.
using Units = std::map<std::uint64_t, std::map<std::size_t, std::vector<Part>>>;

Units unitsOf(const HjifChannel& channel)
{
    Units units;
    std::uint64_t number = 0;
    for (std::size_t b = 0; b < channel.bands.size(); ++b)
        for (const HjifEffect& effect : channel.bands[b].effects)
        {
            const auto unitAt = [&](std::size_t k)
            {
                return whole(effect.position + effect.keyframes[k].position) / hmpgUnitLength;
            };
            for (std::size_t first = 0, end = 0; first < effect.keyframes.size(); first = end)
            {
                while (end < effect.keyframes.size() && unitAt(end) == unitAt(first))
                    ++end;
                units[unitAt(first)][b].push_back({&effect, number, first, end});
            }
            ++number;
        }
    return units;
}

void putKeyframe(HmpgBitWriter& bits, const HjifKeyframe& keyframe, bool isWave)
{
    const auto frequency = std::min<std::uint64_t>(whole(keyframe.frequency.value_or(0.0)), 65535);
    if (isWave)
        bits.put((keyframe.frequency ? 2u : 0u) | (keyframe.amplitude ? 1u : 0u), 2);
    if (keyframe.amplitude)
        bits.put(HmpgAmplitude::codeOf(*keyframe.amplitude), 8);
    bits.put(whole(keyframe.position), 16);
    if (keyframe.frequency)
        bits.put(frequency, 16);
}

/// A packet with what a band plays in the unit that begins at `start` ticks.
HmpgBitWriter dataOf(const HjifBand& band, std::size_t number, const std::vector<Part>& parts, std::uint64_t start)
{
    const bool isWave = band.type == "VectorialWave";
    HmpgBitWriter bits;
    bits.put(parts.back().first == 0 ? 0 : 1, 1); // whether a player may begin here, as the reference program tells it
    bits.put(0, 8);                               // perception
    bits.put(0, 16);                              // channel
    bits.put(number, 8);
    bits.put(parts.size(), 16);
    for (const Part& part : parts)
    {
        bits.put(part.number, 16);
        bits.put(hmpgCodeOf(hmpgEffects, part.effect->type), 2);
        bits.put(whole(part.effect->position) - start, 25); // may be negative
        bits.put(0, 1);                                     // no meaning
        bits.put(part.end - part.first, 16);
        if (isWave)
        {
            bits.put(hmpgPhase.codeOf(part.effect->phase.value_or(0.0)), hmpgPhase.bits);
            bits.put(hmpgCodeOf(hmpgSignals, part.effect->baseSignal), 4);
        }
        for (std::size_t k = part.first; k < part.end; ++k)
            putKeyframe(bits, part.effect->keyframes[k], isWave);
    }
    return bits;
}

/// Units without content from one time to another, ticks.
std::string silence(std::uint64_t from, std::uint64_t until)
{
    constexpr std::uint64_t longest = (std::uint64_t{1} << 24) / hmpgUnitLength * hmpgUnitLength - hmpgUnitLength;
    std::string units;
    for (; from < until; from += std::min(until - from, longest))
        units += unitOf(HmpgUnit::silent, true, std::min(until - from, longest), {});
    return units;
}
} // namespace

Result<ExportedClip> writeHmpg(const Clip& clip, const ExportParams& params)
{
    LossList losses;
    HjifFile file = hjifModelOf(clip, params, losses, limitsOfFile);
    if (file.description.size() > longestText)
    {
        losses.add(LossKind::text, 0.0, clip.duration, 0.0, fmt::format("the name is cut to {} bytes", longestText));
        file.description = wholeCharacters(file.description, longestText);
    }
    const HjifChannel& channel = file.perceptions.front().channels.front();
    std::size_t effects = 0;
    for (const HjifBand& band : channel.bands)
        effects += band.effects.size();
    if (effects > mostEffects)
        return Error{ErrorCode::tooLarge, "",
                     fmt::format("has {} effects, and a file has room for {}: cut the clip into parts, or write .hjif",
                                 effects, mostEffects)};
    std::string bytes = initialisation(file);
    std::uint64_t time = 0;
    for (const auto& [number, bands] : unitsOf(channel))
    {
        const std::uint64_t start = number * hmpgUnitLength;
        bytes += silence(time, start);
        std::string packets;
        bool isIndependent = true;
        for (const auto& [band, parts] : bands)
        {
            addPacket(packets, HmpgPacket::data, dataOf(channel.bands[band], band, parts, start));
            isIndependent = isIndependent && parts.back().first == 0;
        }
        bytes += unitOf(HmpgUnit::temporal, isIndependent, hmpgUnitLength, packets);
        time = start + hmpgUnitLength;
    }
    return oneFile(std::move(bytes), std::move(losses));
}

} // namespace pacini
