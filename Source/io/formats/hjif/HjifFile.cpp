#include "io/formats/hjif/HjifFile.h"

#include "io/FieldsReader.h"

#include <fmt/format.h>

#include <algorithm>

namespace pacini
{

namespace
{
constexpr std::size_t maxElements = 5'000'000;

void readEffects(FieldsReader& reader, const char* name, std::vector<HjifEffect>& effects)
{
    reader.list(name, effects, maxElements, "effects",
                [&](HjifEffect& effect)
                {
                    reader.text("effect_type", effect.type);
                    reader.number("position", effect.position, Need::required);
                    reader.optionalNumber("id", effect.id);
                    reader.optionalNumber("phase", effect.phase);
                    reader.optionalText("base_signal", effect.baseSignal);
                    reader.optionalText("wavelet_stream", effect.stream);
                    reader.list("keyframes", effect.keyframes, maxElements, "keyframes",
                                [&](HjifKeyframe& keyframe)
                                {
                                    reader.number("relative_position", keyframe.position, Need::optional);
                                    reader.optionalNumber("amplitude_modulation", keyframe.amplitude);
                                    reader.optionalNumber("frequency_modulation", keyframe.frequency);
                                });
                });
}

void readPerception(FieldsReader& reader, HjifPerception& perception)
{
    reader.text("perception_modality", perception.modality);
    reader.number("perception_unit_exponent", perception.unitExponent, Need::optional);
    readEffects(reader, "effect_library", perception.library);
    reader.list("channels", perception.channels, 65535, "channels",
                [&](HjifChannel& channel)
                {
                    reader.number("gain", channel.gain, Need::required);
                    reader.optionalNumber("frequency_sampling", channel.rate);
                    reader.optionalNumber("sample_count", channel.samples);
                    reader.list("bands", channel.bands, 65535, "bands",
                                [&](HjifBand& band)
                                {
                                    reader.text("band_type", band.type);
                                    reader.optionalText("curve_type", band.curve);
                                    reader.number("lower_frequency_limit", band.low, Need::required);
                                    reader.number("upper_frequency_limit", band.high, Need::required);
                                    reader.optionalNumber("block_length", band.blockLength);
                                    readEffects(reader, "effects", band.effects);
                                });
                });
}
} // namespace

std::optional<Error> checkHjifVersion(const std::string& version, std::vector<std::string>& warnings)
{
    constexpr int firstYear = 2023, knownYear = 2025;
    const bool wellFormed = version.size() >= 4 && std::all_of(version.begin(), version.begin() + 4,
                                                               [](char c) { return c >= '0' && c <= '9'; });
    const int year = wellFormed ? std::stoi(version.substr(0, 4)) : 0;
    if (year < firstYear || (version.size() > 4 && version[4] != '-'))
        return Error{ErrorCode::invalidData, "version", "must be a year from 2023, such as \"2023\" or \"2023-1\""};
    if (year > knownYear)
        warnings.push_back(
            fmt::format("version: {} is newer than the versions that this program supports", shownText(version)));
    return {};
}

Result<HjifFile> readHjifFile(const nlohmann::json& tree, std::vector<std::string>& warnings)
{
    FieldsReader reader(tree);
    HjifFile file;
    std::string version, profile;
    reader.text("version", version);
    reader.optionalText("profile", profile);
    reader.optionalText("description", file.description);
    reader.number("timescale", file.ticks, Need::optional);
    if (!(file.ticks >= 1.0 && file.ticks <= 1e9))
        reader.fail("timescale", "must be 1 to 1000000000 ticks per second");
    const auto isMissing = [&](const char* name)
    {
        const auto entry = tree.find(name);
        return entry == tree.end() || entry->is_null();
    };
    if (isMissing("perceptions"))
        reader.fail("perceptions", "is missing");
    reader.list("perceptions", file.perceptions, 65535, "perceptions",
                [&](HjifPerception& perception) { readPerception(reader, perception); });
    if (reader.error)
        return *reader.error;
    if (auto error = checkHjifVersion(version, warnings))
        return *error;
    for (const char* name : {"profile", "level", "date", "avatars", "syncs"})
        if (isMissing(name))
            warnings.push_back(fmt::format("{}: is missing; other players refuse the file", name));
    return file;
}

} // namespace pacini
