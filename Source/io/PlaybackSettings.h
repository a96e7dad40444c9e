#pragma once

// Parts of settings files that say how clips are played, haptic outputs and live character, and how a sound is
// translated while it plays.

#include "io/GivenParameters.h"
#include "io/SceneFields.h"

#include <pacini/foundation/Description.h>
#include <pacini/realtime/TranslatorParams.h>
#include <pacini/synthesis/PanLaw.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// A haptic output that clips play on.
struct HapticOutput
{
    int channel = 2;      ///< of the device, from 0; see HapticOutputs::channelOf(); -1: none
    std::string actuator; ///< the name of a profile; empty: that of the project
    double gain = 0.0;    ///< dB, -60 (silent) to 0
    double delay = 0.0;   ///< s, 0 to 0.5
    double place = 0.0;   ///< 0 to 1, for the pan
    bool operator==(const HapticOutput&) const = default;
};

/// Haptic outputs beside each other, and how a clip's position counts over them.
struct OutputSettings
{
    static constexpr std::size_t most = 8;

    std::vector<HapticOutput> outputs;
    std::optional<PanLaw> pan; ///< none: every output plays all of it
    bool operator==(const OutputSettings&) const = default;
};

/// How clips are played: what changes at once, while the clip stays as it is.
struct CharacterSettings
{
    static constexpr double leastGain = -40.0, mostGain = 12.0; ///< dB; the least is silence
    static constexpr double mostTransposition = 24.0;           ///< semitones, up and down
    static constexpr double leastSpeed = 0.25, mostSpeed = 4.0;

    double gain = 0.0;          ///< dB
    double intensity = 1.0;     ///< 0 to 1
    double transposition = 0.0; ///< semitones
    double speed = 1.0;         ///< 1: as the clip is
    bool operator==(const CharacterSettings&) const = default;
};

/// Entries of the part `character`.
inline constexpr std::array characterParameters{
    described<&CharacterSettings::gain>({.name = "gain",
                                         .text = "Level of all that is felt; the least is silence",
                                         .unit = "dB",
                                         .range = {CharacterSettings::leastGain, CharacterSettings::mostGain}}),
    described<&CharacterSettings::intensity>(
        {.name = "intensity", .text = "Share of the clip's amplitude", .range = {0.0, 1.0}}),
    described<&CharacterSettings::transposition>(
        {.name = "transposition",
         .text = "Shift of all frequencies",
         .unit = "semitones",
         .range = {-CharacterSettings::mostTransposition, CharacterSettings::mostTransposition}}),
    described<&CharacterSettings::speed>({.name = "speed",
                                          .text = "Speed, 1 as the clip is",
                                          .range = {CharacterSettings::leastSpeed, CharacterSettings::mostSpeed}}),
};

/// Entries of each of the `outputs`, except for the name of its actuator.
inline constexpr std::array outputParameters = []
{
    std::array parameters{
        described<&HapticOutput::channel>(
            {.name = "channel", .text = "Channel of the device, from 1; 0: none", .range = {0.0, 256.0}}),
        described<&HapticOutput::gain>({.name = "gain", .text = "Level", .unit = "dB", .range = {-60.0, 0.0}}),
        described<&HapticOutput::delay>({.name = "delay", .text = "Delay", .unit = "s", .range = {0.0, 0.5}}),
        described<&HapticOutput::place>(
            {.name = "position", .text = "Place in the row, for the pan", .range = {0.0, 1.0}}),
    };
    // Files count channels as people do.
    parameters[0].get = [](const HapticOutput& output)
    {
        return output.channel + 1.0;
    };
    parameters[0].set = [](HapticOutput& output, double value)
    {
        output.channel = static_cast<int>(value) - 1;
    };
    parameters[0].usual = []
    {
        return HapticOutput().channel + 1.0;
    };
    return parameters;
}();

inline constexpr std::string_view outputActuatorText = "Name of the actuator's profile; empty: that of the project";

inline constexpr auto panNames = []
{
    std::array<std::string_view, sceneFields::panLaws.size() + 1> names{"off"};
    for (std::size_t i = 0; i < sceneFields::panLaws.size(); ++i)
        names[i + 1] = sceneFields::panLaws[i].name;
    return names;
}();

/// The entry `pan` beside the `outputs`.
inline constexpr std::array panParameters{
    []
    {
        auto pan = described<&OutputSettings::pan>(
            {.name = "pan", .text = "How a clip's position counts over the outputs", .choices = panNames});
        pan.optional = false; // `off` is a choice
        pan.get = [](const OutputSettings& settings)
        {
            double index = 0.0;
            for (std::size_t i = 0; i < sceneFields::panLaws.size(); ++i)
                if (settings.pan == sceneFields::panLaws[i].value)
                    index = static_cast<double>(i + 1);
            return index;
        };
        pan.set = [](OutputSettings& settings, double value)
        {
            const auto index = static_cast<std::size_t>(value);
            settings.pan = index == 0 ? std::nullopt : std::optional(sceneFields::panLaws[index - 1].value);
        };
        pan.usual = []
        {
            return 0.0;
        };
        return pan;
    }()};

/// The character that plays clips as live parameters play a sound, as far as there is one: gain and transposition,
/// within their ranges.
[[nodiscard]] CharacterSettings characterOf(const TranslatorParams& params);

/// Parts of a settings document that say how something is played; none where the document has none.
struct PlaybackSettings
{
    std::optional<OutputSettings> outputs;
    std::optional<CharacterSettings> character;
    std::optional<TranslatorParams> live; ///< entries by translatorParameters
    bool operator==(const PlaybackSettings&) const = default;
};

/// The entries `pan`, `outputs`, `character` and `live` of a settings document; errors are stored in the reader.
void readPlaybackSettings(FieldsReader& reader, PlaybackSettings& settings);

/// A settings document with these entries.
[[nodiscard]] nlohmann::ordered_json playbackSettingsJson(const PlaybackSettings& settings);

/// Descriptions of `pan`, and of the entries of `outputs`, `character` and `live`.
[[nodiscard]] nlohmann::ordered_json playbackDescriptionsJson();

} // namespace pacini
