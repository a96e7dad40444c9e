#include "io/Settings.h"

#include "io/EncoderPresets.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"
#include "io/ParameterFields.h"
#include "io/formats/ExportParameters.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <pacini/analysis/methods/Method.h>

#include <string>

using namespace pacini;

namespace
{
Result<Settings> read(const std::string& encode, ReadWarnings* warnings = nullptr)
{
    return readSettings(R"({"format": "pacini.settings", "version": 1, "encode": )" + encode + "}", warnings);
}

std::string messageOf(const std::string& encode)
{
    const auto settings = read(encode);
    if (!settings)
        return settings.error().text();
    const auto translation = translationOf(*settings);
    return translation ? std::string() : translation.error().text();
}
} // namespace

TEST_CASE("Settings of every method come back as they were written", "[settings]")
{
    for (const MethodInfo& info : methodTable)
    {
        TranslationParams translation;
        translation.method = info.method;
        CAPTURE(std::string(info.name));
        // Each value that the method has is another than usual.
        for (const ParameterInfo* parameter : translationParameters())
            if (hasParameter(info.method, parameter->name))
            {
                const double other = parameter->kind == ParameterKind::number
                                         ? 0.5 * (parameter->range.lowest + parameter->range.highest)
                                         : parameter->range.highest;
                REQUIRE(setParameter(translation, *parameter, parameter->name == "low" ? 2.0 : other));
            }
        const auto document = settingsJson(translation, usualChoices(info.method));
        const auto settings = readSettings(document.dump());
        REQUIRE(settings);
        const auto back = translationOf(*settings);
        REQUIRE(back);
        CHECK(*back == translation);
    }
}

TEST_CASE("A preset gives its parameters under each of its names, and values beside it override it", "[settings]")
{
    for (const EncoderPreset& preset : encoderPresets())
    {
        CAPTURE(std::string(preset.name));
        for (const std::string& name : {std::string(preset.name), optionName(preset)})
        {
            // Whatever stood there before: all that presets differ in is as this one has it.
            Settings settings = read(R"({"preset": "low-rumble", "bands": 3, "audible": 0.25})").value();
            REQUIRE(usePreset(settings, name));
            CHECK(translationOf(settings).value().params == preset.params);
            const auto beside =
                translationOf(read(R"({"maskLimit": 5, "bands": 7, "preset": ")" + name + "\"}").value());
            EncoderParams wanted = preset.params;
            wanted.bands = 7;
            wanted.onsets.maskLimit = Decibels(5.0);
            CHECK(beside.value().params == wanted);
        }
    }
    CHECK(messageOf(R"({"preset": "musics"})").find("did you mean music?") != std::string::npos);
    CHECK(messageOf(R"({"preset": ""})").find("is not one of effects") != std::string::npos);
    CHECK(messageOf(R"({"preset": 3})").find("encode.preset") != std::string::npos);
    CHECK(messageOf(R"({"preset": "effects", "method": "lowpass"})").find("preset: is for the method a2vt") !=
          std::string::npos);
}

TEST_CASE("Settings that are printed without a choice change nothing", "[settings]")
{
    const std::vector<float> sound(8000, 0.25f);
    for (const MethodInfo& info : methodTable)
    {
        TranslationParams translation;
        translation.method = info.method;
        const auto settings = readSettings(settingsJson(translation, usualChoices(info.method)).dump());
        REQUIRE(settings);
        const auto back = translationOf(*settings);
        REQUIRE(back);
        CHECK(back->params == EncoderParams());
        if (info.output == MethodOutput::clip && info.method != Method::a2vt)
        {
            Clip plain = translateToClip(info.method, sound, 8000.0);
            Clip chosen = translateToClip(info.method, sound, 8000.0, back->choices);
            plain.encoder.clear(); // that of `chosen` names more
            chosen.encoder.clear();
            CHECK(chosen == plain);
        }
    }
}

TEST_CASE("A choice of a method is in the record of its clip", "[settings][methods]")
{
    const std::vector<float> sound(8000, 0.25f);
    MethodChoices choices;
    choices.crestAdaptive = true;
    choices.lowLimit = 20.0;
    const Clip clip = translateToClip(Method::envelopeSine, sound, 8000.0, choices);
    const auto recorded = [&](const EncoderParameter& parameter)
    {
        return std::find(clip.encoder.begin(), clip.encoder.end(), parameter) != clip.encoder.end();
    };
    CHECK(recorded({"crestAdaptive", true}));
    CHECK(recorded({"lowLimit", 20.0}));
}

TEST_CASE("What is wrong with settings is told with its place", "[settings]")
{
    CHECK(messageOf(R"({"bands": 8, "minimumGap": 0.02})").empty());
    CHECK(messageOf(R"({"bands": 99})") == "encode.bands: must be 1 to 32");
    CHECK(messageOf(R"({"bands": 1.5})") == "encode.bands: must be a whole number, 1 to 32");
    CHECK(messageOf(R"({"bands": "many"})") == "encode.bands: must be a number");
    CHECK(messageOf(R"({"keepLevel": 1})") == "encode.keepLevel: must be true or false");
    CHECK(messageOf(R"({"spacing": "linaer"})") ==
          "encode.spacing: must be log or linear, not 'linaer'; did you mean linear?");
    CHECK(messageOf(R"({"method": "tehsis"})").ends_with("did you mean thesis?"));
    CHECK(messageOf(R"({"method": "thesis", "audible": 0.5})") ==
          "audible: is no option of the method thesis; leave it out");
    CHECK(messageOf(R"({"low": 500, "high": 100})") == "low: must be lower than high");

    ReadWarnings warnings;
    REQUIRE(read(R"({"bnads": 8})", &warnings));
    REQUIRE(warnings.texts().size() == 1);
    CHECK(warnings.texts().front() == "encode.bnads: is unknown; did you mean \"bands\"?");
    ReadWarnings strict(true);
    CHECK(!read(R"({"bnads": 8})", &strict));

    CHECK(readSettings(R"({"format": "pacini.clip", "version": 1})").error().where == "format");
    CHECK(readSettings(R"({"format": "pacini.settings", "version": 2})").error().code == ErrorCode::unsupportedVersion);
}

TEST_CASE("Parts that say how clips are played come back, are no unknown keys, and are checked", "[settings]")
{
    PlaybackSettings wanted;
    wanted.outputs = OutputSettings{{{2, "", -3.5, 0.0, 0.0}, {-1, "erm-coin", 0.0, 0.012, 0.75}}, PanLaw::delay};
    wanted.character = CharacterSettings{-6.5, 0.7, 7.0, 0.5};
    wanted.live.emplace().attack = 12.5;
    wanted.live->texture = {-6.25, true};
    auto document = playbackSettingsJson(wanted);
    ReadWarnings strict(true);
    const auto read = readSettings(document.dump(), &strict);
    REQUIRE(read);
    CHECK(read->playback == wanted);
    CHECK(translationOf(*read)->params == EncoderParams());
    CHECK_FALSE(read->hasEncode);
    wanted.outputs->pan.reset();
    CHECK(readSettings(playbackSettingsJson(wanted).dump(), &strict)->playback == wanted);

    const auto message = [](const std::string& parts)
    {
        const auto settings = readSettings(R"({"format": "pacini.settings", "version": 1, )" + parts + "}");
        return settings ? std::string() : settings.error().text();
    };
    CHECK(message(R"("outputs": [{"channel": 1}], "character": {})").empty());
    CHECK(message(R"("outputs": {})") == "outputs: must be a list of outputs");
    CHECK(message(R"("outputs": [{"channel": 1}, {"gain": "loud"}])") == "outputs[1].gain: must be a number");
    CHECK(message(R"("outputs": [{"channel": 1.5}])") == "outputs[0].channel: must be a whole number, 0 to 256");
    CHECK(message(R"("outputs": [{"actuator": 3}])") == "outputs[0].actuator: must be a text in quotes");
    CHECK(message(R"("pan": "dealy")") ==
          "pan: must be off, constantPower, delay or both, not 'dealy'; did you mean delay?");
    CHECK(message(R"("character": {"speed": 9})") == "character.speed: must be 0.25 to 4");
    CHECK(message(R"("character": [])") == "character: must be an object in braces");
    CHECK(message(R"("live": {"attack": 201})") == "live.attack: must be 0 to 200 ms");
    CHECK(message(R"("live": {"textureMuted": 1})") == "live.textureMuted: must be true or false");

    // The schema has all that is written.
    const auto schema = nlohmann::json::parse(
        *readWholeFile(sourceFolder() / "Resources/schema/pacini.settings.schema.json", largestSettingsText));
    const auto& properties = schema["properties"];
    for (const auto& [name, entry] : document.items())
        CHECK(properties.contains(name));
    for (const auto& [name, entry] : document["outputs"][0].items())
        CHECK(properties["outputs"]["items"]["properties"].contains(name));
    for (const auto& [name, entry] : document["character"].items())
        CHECK(properties["character"]["properties"].contains(name));
    for (const auto& [name, entry] : document["live"].items())
        CHECK(properties["live"]["properties"].contains(name));
}

TEST_CASE("Exports take what changes something in their format, within one range", "[settings][formats]")
{
    const auto message = [](const char* format, const char* name, double value)
    {
        GivenParameters given;
        given.set(parameterNamed(exportParameters, name), value);
        const auto params = exportParamsOf(*clipFormatNamed(format), given);
        return params ? std::string() : params.error().text();
    };
    CHECK(message("haptic", "points", 0.5).empty());
    CHECK(message("haptic", "points", 0.0) == "points: must be 0.5 to 10000 per second");
    CHECK(message("openxr", "sampleRate", 48000.0).empty());
    CHECK(message("openxr", "sampleRate", 100.0) == "sampleRate: must be 2000 to 48000 Hz");
    CHECK(message("wav16", "strength", 0.5) == "strength: needs a profile; leave it out, or name one");
    CHECK(message("haptic", "strength", 0.5).starts_with("strength: has no effect in haptic"));
    CHECK(message("haptic", "sampleRate", 8000.0).starts_with("sampleRate: has no effect in haptic; leave it out, or"));
    CHECK(message("json", "points", 10.0).starts_with("points: is for formats of other programs, but json keeps the"));

    GivenParameters given;
    given.set(parameterNamed(exportParameters, "points"), 40.0);
    CHECK(exportParamsOf(*clipFormatNamed("haptic"), given)->frequencyPoints == 30.0);
    given.set(parameterNamed(exportParameters, "frequencyPoints"), 8.0);
    CHECK(exportParamsOf(*clipFormatNamed("haptic"), given)->frequencyPoints == 8.0);
}

namespace
{
/// Parameters with one more: two edits, as if the encoder had got it.
struct MoreParams
{
    double shimmer = 0.5;
};
constexpr std::array moreParameters{described<&MoreParams::shimmer>(
    {.name = "shimmerDepth", .member = "shimmer", .text = "How much it shimmers", .unit = "dB", .range = {0, 6}})};
} // namespace

TEST_CASE("A parameter that is described is in settings, documents and descriptions", "[settings]")
{
    const std::array<const ParameterInfo*, 1> infos{&moreParameters[0]};
    const auto entries = nlohmann::json::parse(R"({"shimmerDepth": 3})");
    FieldsReader reader(entries);
    GivenParameters given;
    readParameters(reader, infos, given);
    CHECK(!reader.error);
    CHECK(given.find("shimmerDepth") == 3.0);

    MoreParams params;
    const auto stored = nlohmann::json::parse(R"({"shimmer": 2})");
    FieldsReader document(stored);
    visitParameters(moreParameters, params, document);
    CHECK(params.shimmer == 2.0);
    CHECK(!checkParameters(moreParameters, MoreParams{7.0}));

    const auto told = descriptionJson(moreParameters[0]);
    CHECK(told["option"] == "--shimmer-depth");
    CHECK(told["default"] == 0.5);
    CHECK(told["highest"] == 6.0);
    CHECK(told["unit"] == "dB");
}
