#include "document/SettingsPresets.h"

#include "io/AtomicFile.h"
#include "io/FieldsReader.h"
#include "io/FieldsWriter.h"
#include "io/FileNames.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"
#include "io/SceneFields.h"
#include "io/SettingsFile.h"

#include <pacini/analysis/methods/MethodChoices.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <type_traits>
#include <utility>

namespace pacini
{

std::vector<std::string> SettingsPresets::names() const
{
    std::vector<std::string> found;
    std::error_code failed;
    for (std::filesystem::directory_iterator at(home, failed), end; !failed && at != end; at.increment(failed))
        if (const auto& path = at->path(); path.extension() == ".json")
        {
            const std::u8string stem = path.stem().u8string();
            if (std::string name(stem.begin(), stem.end()); !presetNameDefect(name, longestName))
                found.push_back(std::move(name));
        }
    std::sort(found.begin(), found.end());
    found.resize(std::min(found.size(), most));
    return found;
}

std::filesystem::path SettingsPresets::pathOf(const std::string& name) const
{
    return home / std::filesystem::path(std::u8string(name.begin(), name.end()) + u8".json");
}

Result<void> SettingsPresets::save(const std::string& name, const std::string& settings, bool replace) const
{
    if (auto defect = presetNameDefect(name, longestName))
        return *std::move(defect);
    std::error_code failed;
    std::filesystem::create_directories(home, failed);
    if (failed)
        return Error{ErrorCode::io, home.string(), failed.message()};
    const auto written = writeFileAtomically(pathOf(name), settings, replace ? Existing::replace : Existing::keep);
    if (!written)
        return written.error();
    return {};
}

std::string analysisSettings(const EncoderParams& params)
{
    return settingsJson({Method::a2vt, params, {}}, {}).dump(2) + "\n";
}

Result<EncoderParams> readAnalysisSettings(const std::filesystem::path& path)
{
    const auto settings = readSettingsFile(path);
    if (!settings)
        return settings.error();
    const auto translation = translationOf(*settings);
    if (!translation)
        return translation.error();
    if (translation->method != Method::a2vt)
        return Error{ErrorCode::invalidArgument, "method", "is not one of the editor's; it analyses with a2vt"};
    return translation->params;
}

namespace
{
/// The laws of scenes, and none.
constexpr int noLaw = -1;
constexpr auto panChoices = []
{
    using sceneFields::panLaws;
    std::array<Choice<int>, panLaws.size() + 1> choices{};
    choices[0] = {"off", noLaw};
    for (std::size_t i = 0; i < panLaws.size(); ++i)
        choices[i + 1] = {panLaws[i].name, static_cast<int>(panLaws[i].value)};
    return choices;
}();

template <typename Visitor>
void checkRange(Visitor& visitor, const char* name, double value, double lowest, double highest)
{
    if (!(value >= lowest && value <= highest))
        visitor.fail(name, fmt::format("must be {:g} to {:g}", lowest, highest), ErrorCode::invalidArgument);
}

template <typename Character, typename Visitor>
void visitCharacter(Character& character, Visitor& visitor)
{
    visitor.number("gain", character.gain, Need::usual);
    visitor.number("intensity", character.intensity, Need::usual);
    visitor.number("transposition", character.transposition, Need::usual);
    visitor.number("speed", character.speed, Need::usual);
    if constexpr (!std::is_const_v<Character>)
    {
        using C = CharacterSettings;
        checkRange(visitor, "gain", character.gain, C::leastGain, C::mostGain);
        checkRange(visitor, "intensity", character.intensity, 0.0, 1.0);
        checkRange(visitor, "transposition", character.transposition, -C::mostTransposition, C::mostTransposition);
        checkRange(visitor, "speed", character.speed, C::leastSpeed, C::mostSpeed);
    }
}

/// The object of a settings file.
Result<nlohmann::json> readSettingsObject(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestSettingsText);
    return text ? readJsonObject(*text, largestSettingsText, "must be an object in braces")
                : Result<nlohmann::json>(text.error());
}

template <typename Output, typename Visitor>
void visitOutput(Output& output, Visitor& visitor)
{
    int channel = output.channel + 1; // as people count; 0: none
    visitor.integer("channel", channel, "must be a whole number");
    visitor.optionalText("actuator", output.actuator);
    visitor.number("gain", output.gain, Need::usual);
    visitor.number("delay", output.delay, Need::usual);
    visitor.number("position", output.place, Need::usual);
    if constexpr (!std::is_const_v<Output>)
    {
        output.channel = channel - 1;
        checkRange(visitor, "channel", channel, 0.0, 256.0);
        checkRange(visitor, "gain", output.gain, -60.0, 0.0);
        checkRange(visitor, "delay", output.delay, 0.0, 0.5);
        checkRange(visitor, "position", output.place, 0.0, 1.0);
    }
}
} // namespace

std::string outputSettings(const OutputSettings& settings)
{
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({settingsFormat.name, settingsFormat.version});
    writer.choice("pan", settings.pan ? static_cast<int>(*settings.pan) : noLaw, panChoices, Need::usual);
    writer.list("outputs", settings.outputs, OutputSettings::most, "outputs",
                [&](const HapticOutput& output) { visitOutput(output, writer); });
    return std::move(writer).document();
}

Result<OutputSettings> readOutputSettings(const std::filesystem::path& path)
{
    const auto document = readSettingsObject(path);
    if (!document)
        return document.error();
    FieldsReader reader(*document);
    reader.format(settingsFormat.name, settingsFormat.version);
    OutputSettings settings;
    int pan = noLaw;
    reader.choice("pan", pan, panChoices, Need::usual);
    reader.list("outputs", settings.outputs, OutputSettings::most, "outputs",
                [&](HapticOutput& output) { visitOutput(output, reader); });
    if (!reader.error && settings.outputs.empty())
        reader.fail("outputs", "is missing: these are no settings of outputs");
    if (reader.error)
        return *reader.error;
    if (pan != noLaw)
        settings.pan = static_cast<PanLaw>(pan);
    return settings;
}

std::string characterSettings(const CharacterSettings& settings)
{
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({settingsFormat.name, settingsFormat.version});
    writer.object("character", settings, Need::usual,
                  [&](const CharacterSettings& character) { visitCharacter(character, writer); });
    return std::move(writer).document();
}

Result<CharacterSettings> readCharacterSettings(const std::filesystem::path& path)
{
    const auto document = readSettingsObject(path);
    if (!document)
        return document.error();
    FieldsReader reader(*document);
    reader.format(settingsFormat.name, settingsFormat.version);
    CharacterSettings settings;
    if (!reader.error && !document->contains("character"))
        reader.fail("character", "is missing: these are no settings of the character");
    reader.object("character", settings, Need::optional,
                  [&](CharacterSettings& character) { visitCharacter(character, reader); });
    if (reader.error)
        return *reader.error;
    return settings;
}

} // namespace pacini
