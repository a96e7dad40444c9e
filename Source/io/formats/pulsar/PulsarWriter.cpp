#include "io/formats/pulsar/PulsarFormat.h"

#ifdef PACINI_HAS_LIBZIP

#include "io/formats/ForeignText.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/pulsar/ZipArchive.h"

#include <pacini/foundation/NumberText.h>

#include <fmt/format.h>

#include <string>
#include <utility>

namespace pacini
{

namespace
{
constexpr int msDigits = 1, shareDigits = 4;

/// Players of Pulsar play events on top of the curves, as Core Haptics does.
constexpr EmphasisPlayer pulsarPlayer{{sharpnessRange.low, sharpnessRange.high}, 0.016, 0.016, 1.0, 0.01};

std::string msText(double seconds)
{
    return shortDecimalText(seconds * 1000.0, msDigits);
}

std::string curveText(const Curve& curve)
{
    std::string text;
    for (const Breakpoint& point : curve)
        text += fmt::format("{}\n      {{\"time\": {}, \"value\": {}}}", text.empty() ? "" : ",", msText(point.time),
                            shortDecimalText(point.value, shareDigits));
    return text;
}

std::string patternText(const NormalisedVoice& voice)
{
    std::string events;
    for (const Transient& event : voice.events)
        events +=
            fmt::format("{}\n    {{\"time\": {}, \"amplitude\": {}, \"frequency\": {}}}", events.empty() ? "" : ",",
                        msText(event.time), shortDecimalText(event.amplitude, shareDigits),
                        shortDecimalText(event.sharpness, shareDigits));
    return fmt::format(
        "{{\n  \"continuousPattern\": {{\n    \"amplitude\": [{}\n    ],\n    \"frequency\": [{}\n    ]\n"
        "  }},\n  \"discretePattern\": [{}\n  ]\n}}\n",
        curveText(voice.level), curveText(voice.frequency), events);
}
} // namespace

Result<ExportedClip> writePulsar(const Clip& clip, const ExportParams& params)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    NormalisedVoice voice = normalisedVoice(clip, params, {.range = sharpnessRange, .events = pulsarPlayer});
    const std::string name = nameOfClip(clip, params.name);
    // No word that JavaScript has reserved begins so.
    const std::string id = "clip_" + identifierOf(name);
    const std::string path = fmt::format("haptics/{}.json", id);
    const std::string manifest = fmt::format(
        "{{\n  \"schema\": \"{}\",\n  \"id\": \"pacini.{}\",\n  \"name\": {},\n  \"generator\": \"Pacini\",\n"
        "  \"presets\": [\n    {{\"id\": \"{}\", \"name\": {}, \"haptics\": \"{}\", \"duration\": {}}}\n  ]\n}}\n",
        pulsarSchema, id, inQuotes(name), id, inQuotes(name), path, msText(voice.duration));
    auto bytes = zipOf({{"manifest.json", manifest}, {path, patternText(voice)}});
    if (!bytes)
        return bytes.error();
    return oneFile(std::move(*bytes), std::move(voice.losses));
}

} // namespace pacini

#endif
