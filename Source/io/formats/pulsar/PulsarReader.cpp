#include "io/formats/pulsar/PulsarFormat.h"

#ifdef PACINI_HAS_LIBZIP

#include "io/JsonTree.h"
#include "io/ReadWarnings.h"
#include "io/formats/ForeignText.h"
#include "io/formats/ImportReport.h"
#include "io/formats/JsonEntry.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/pulsar/ZipArchive.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
/// The preset of a bundle.
struct Preset
{
    std::string name;
    std::string path; ///< of its haptics, in the archive
};

Result<Preset> presetOf(const nlohmann::json& manifest, ImportReport& report)
{
    const JsonEntry root(&manifest, "", report.error);
    const JsonEntry schema = root.required("schema");
    if (const auto said = schema.text(); !report.error && said != pulsarSchema)
        schema.fail(fmt::format("is \"{}\", but only {} is read", shownText(said), pulsarSchema),
                    ErrorCode::unsupportedVersion);
    const JsonEntry presets = root.required("presets");
    Preset found;
    std::string names;
    presets.forEach(
        [&](const JsonEntry& preset, std::size_t i)
        {
            constexpr std::size_t mostNamed = 5;
            std::string name = preset.optional("name").text();
            if (name.empty())
                name = preset.optional("id").text();
            if (i < mostNamed)
                names += fmt::format("{}'{}'", i > 0 ? ", " : "", shownText(name));
            found = {importedName(name), preset.required("haptics").text()};
            if (preset.optional("audio").exists())
                report.warn(preset.path(), "its sound is not kept");
            if (preset.optional("animation").exists())
                report.warn(preset.path(), "its animation is not kept");
        });
    if (!report.error && presets.size() == 0)
        presets.fail("has no preset");
    if (presets.size() > 1)
        presets.fail(
            fmt::format("has {} presets ({}{}), but a clip is one; unpack the bundle and put each in one of its "
                        "own",
                        presets.size(), names, presets.size() > 5 ? ", ..." : ""));
    if (report.error)
        return *report.error;
    return found;
}

class PulsarPattern
{
public:
    PulsarPattern(const nlohmann::json& toRead, ImportReport& toFill)
        : tree(toRead), report(toFill), root(&toRead, "", report.error)
    {
    }

    Clip read()
    {
        const JsonEntry continuous = root.required("continuousPattern");
        warnOfOthers(tree, {"continuousPattern", "discretePattern"}, "");
        if (const auto found = tree.find("continuousPattern"); found != tree.end())
            warnOfOthers(*found, {"amplitude", "frequency"}, "continuousPattern.");
        Curve amplitude = curveOf(continuous.optional("amplitude"));
        Curve pitch = curveOf(continuous.optional("frequency"));
        Clip clip;
        root.required("discretePattern")
            .forEach(
                [&](const JsonEntry& event, std::size_t)
                {
                    clip.transients.push_back(
                        {timeOf(event), share(event.required("amplitude")), share(event.required("frequency"))});
                    clip.duration = std::max(clip.duration, clip.transients.back().time);
                });
        if (!report.error && amplitude.empty() && !pitch.empty())
            report.warn("continuousPattern", "has frequencies, but no amplitude, and is left out");
        if (!report.error && amplitude.empty() && clip.transients.empty())
            root.required("continuousPattern").fail("has no point of amplitude, and there is no discrete event either");
        if (report.error)
            return clip;
        if (!amplitude.empty())
        {
            if (pitch.empty())
                report.warn("continuousPattern", "has no frequency, for which iOS leaves it out; it is read as 0.5");
            for (const Curve* curve : {&amplitude, &pitch})
                if (!curve->empty())
                    clip.duration = std::max(clip.duration, curve->back().time);
            const NormalisedRange& range = sharpnessRange;
            for (Breakpoint& point : pitch)
                point.value = range.hertzOf(point.value);
            clip.bands.push_back(
                {range.low, range.hertzOf(0.5), range.high, 0, std::move(amplitude), std::move(pitch)});
        }
        finishImported(clip);
        return clip;
    }

private:
    /// Tells of entries that are not read: a curve under a name that is misspelt would be missing without a word.
    void warnOfOthers(const nlohmann::json& object, std::initializer_list<std::string_view> known,
                      std::string_view place)
    {
        if (object.is_object())
            for (const auto& entry : object.items())
                if (std::find(known.begin(), known.end(), entry.key()) == known.end() && !isRemark(entry.key()))
                    report.warn(fmt::format("{}{}", place, shownText(entry.key())), "is unknown and left out");
    }

    [[nodiscard]] double timeOf(const JsonEntry& point) const
    {
        const JsonEntry time = point.required("time");
        const double ms = time.number();
        if (!(ms >= 0.0 && ms <= limits::duration * 1000.0))
            time.fail("must be 0 ms to 24 hours");
        return ms / 1000.0;
    }

    /// 0 to 1.
    [[nodiscard]] double share(const JsonEntry& entry) const
    {
        const double value = entry.number();
        if (!(value >= 0.0 && value <= 1.0))
            report.warn(entry.path(), "is outside of 0 to 1 and is limited to this range");
        return value > 0.0 ? std::min(value, 1.0) : 0.0;
    }

    [[nodiscard]] Curve curveOf(const JsonEntry& list) const
    {
        Curve curve;
        list.forEach(
            [&](const JsonEntry& point, std::size_t)
            {
                const double time = timeOf(point);
                if (!curve.empty() && time < curve.back().time)
                    point.fail("is earlier than the point before it");
                curve.push_back({time, share(point.required("value"))});
            });
        return curve;
    }

    const nlohmann::json& tree;
    ImportReport& report;
    JsonEntry root;
};

Error within(const std::string& file, Error error)
{
    error.where = file + (error.where.empty() ? "" : ": " + error.where);
    return error;
}

/// A file of the archive as JSON.
Result<nlohmann::json> treeIn(const ZipArchive& archive, const std::string& file, std::vector<std::string>& warnings)
{
    const auto text = archive.content(file, largestForeignText);
    if (!text)
        return text.error();
    auto tree = readForeignTree(*text, warnings);
    return tree ? std::move(tree) : within(file, tree.error());
}
} // namespace

Result<ImportedClip> readPulsar(std::string_view bytes)
{
    const auto archive = ZipArchive::open(bytes);
    if (!archive)
        return archive.error();
    ImportedClip imported;
    const auto manifest = treeIn(*archive, "manifest.json", imported.warnings);
    if (!manifest)
        return manifest.error();
    ImportReport ofManifest(imported.warnings);
    const auto preset = presetOf(*manifest, ofManifest);
    if (!preset)
        return within("manifest.json", preset.error());
    const auto pattern = treeIn(*archive, preset->path, imported.warnings);
    if (!pattern)
        return pattern.error();
    ImportReport ofPattern(imported.warnings);
    imported.clip = PulsarPattern(*pattern, ofPattern).read();
    if (ofPattern.error)
        return within(preset->path, *ofPattern.error);
    imported.clip.name = preset->name;
    if (auto valid = validate(imported.clip); !valid)
        return valid.error();
    return imported;
}

} // namespace pacini

#endif
