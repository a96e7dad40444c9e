#include "io/formats/ForeignText.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifModel.h"

#include <pacini/foundation/NumberText.h>

#include <fmt/format.h>

#include <utility>

namespace pacini
{

namespace
{
/// An amplitude of 1 or less to within half a percent of itself: keyframes are many.
std::string threeDigits(double amplitude)
{
    return shortDecimalText(amplitude, amplitude >= 0.1 ? 3 : amplitude >= 0.01 ? 4 : 5);
}

std::string effectText(const HjifEffect& effect)
{
    std::string text = fmt::format(R"({{"effect_type":"{}","position":{},)", effect.type, effect.position);
    if (effect.phase)
        text += fmt::format(R"("phase":{},)", shortDecimalText(*effect.phase, 3));
    text += R"("keyframes":[)";
    const char* separator = "";
    for (const HjifKeyframe& keyframe : effect.keyframes)
    {
        text += fmt::format(R"({}{{"relative_position":{})", separator, keyframe.position);
        if (keyframe.amplitude)
            text += fmt::format(R"(,"amplitude_modulation":{})", threeDigits(*keyframe.amplitude));
        if (keyframe.frequency)
            text += fmt::format(R"(,"frequency_modulation":{})", *keyframe.frequency);
        text += '}';
        separator = ",";
    }
    return text + "]}";
}

std::string bandText(const HjifBand& band)
{
    std::string text =
        fmt::format("\n"
                    R"({{"band_type":"{}","lower_frequency_limit":{},"upper_frequency_limit":{},"effects":[)",
                    band.type, band.low, band.high);
    const char* separator = "";
    for (const HjifEffect& effect : band.effects)
    {
        text += separator + effectText(effect);
        separator = ",";
    }
    return text + "]}";
}
} // namespace

Result<ExportedClip> writeHjif(const Clip& clip, const ExportParams& params)
{
    LossList losses;
    const HjifFile file = hjifModelOf(clip, params, losses);
    const HjifChannel& channel = file.perceptions.front().channels.front();
    std::vector<std::string> bands;
    for (const HjifBand& band : channel.bands)
        bands.push_back(bandText(band));
    const HjifProfile profile = hjifProfileOf(file);
    const std::string name = inQuotes(file.description);
    // A line for the file and for each band: the rest of the keyframes' long names is enough.
    std::string text =
        fmt::format(R"({{"version":"2023","profile":{},"level":{},"date":"2023-01-01","description":{},"timescale":{},)"
                    R"("avatars":[],"syncs":[],"perceptions":[{{"id":0,"avatar_id":0,"description":{},)"
                    R"("perception_modality":"{}","effect_library":[],"channels":[{{"id":0,"description":{},)"
                    R"("gain":{},"mixing_coefficient":1,"body_part_mask":0,"frequency_sampling":{},"sample_count":{},)"
                    R"("bands":[{}]}}]}}]}})"
                    "\n",
                    inQuotes(profile.name), profile.level, name, file.ticks, name, file.perceptions.front().modality,
                    name, shortDecimalText(channel.gain, 3), *channel.rate, *channel.samples, fmt::join(bands, ","));
    return oneFile(std::move(text), std::move(losses));
}

} // namespace pacini
