#include "io/formats/android/VibrationXml.h"

#ifdef PACINI_HAS_EXPAT

#include "io/JsonText.h"
#include "io/formats/ForeignText.h"
#include "io/formats/ImportReport.h"
#include "io/formats/android/AndroidEffects.h"

#include <pacini/foundation/ParseNumber.h>

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
constexpr std::size_t mostXmlPoints = 5'000'000;
constexpr double longestXmlMs = limits::duration * 1000.0;
constexpr std::int64_t tapMs = 20; // how long an effect of the device counts

/// An effect that each device has of its own, read as an event.
struct DeviceEffect
{
    std::string_view name;
    double amplitude;
    double sharpness;
};

constexpr std::array predefinedEffects{DeviceEffect{"click", 0.8, 0.7},       DeviceEffect{"double_click", 0.8, 0.7},
                                       DeviceEffect{"tick", 0.5, 1.0},        DeviceEffect{"heavy_click", 1.0, 0.4},
                                       DeviceEffect{"pop", 0.6, 0.8},         DeviceEffect{"thud", 1.0, 0.1},
                                       DeviceEffect{"texture_tick", 0.3, 1.0}};
constexpr std::array primitiveEffects{DeviceEffect{"click", 1.0, 0.7}, DeviceEffect{"tick", 0.5, 1.0},
                                      DeviceEffect{"low_tick", 0.5, 0.4}, DeviceEffect{"thud", 1.0, 0.1}};

/// One vibration-effect as it is being read.
struct XmlEffect
{
    std::string kind; ///< the name of its element; empty: none yet
    std::vector<AndroidStep> steps;
    AndroidEnvelope envelope;
    std::vector<Transient> events;
    double ms = 0.0; ///< of all so far
};

class VibrationXml
{
public:
    explicit VibrationXml(std::vector<std::string>& warnings) : report(warnings) {}

    Result<Clip> read(std::string_view text)
    {
        const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> opened(
            XML_ParserCreate(nullptr), XML_ParserFree);
        parser = opened.get();
        if (parser == nullptr)
            return Error{ErrorCode::io, "", "out of memory"};
        XML_SetUserData(parser, this);
        XML_SetElementHandler(parser, start, end);
        // A document type could name entities that expand without end.
        XML_SetStartDoctypeDeclHandler(parser, [](void* self, const char*, const char*, const char*, int)
                                       { static_cast<VibrationXml*>(self)->fail("has a document type; remove it"); });
        const auto status = XML_Parse(parser, text.data(), static_cast<int>(text.size()), XML_TRUE);
        if (report.error)
            return *report.error;
        if (status != XML_STATUS_OK)
        {
            fail(fmt::format("is no XML: {}", XML_ErrorString(XML_GetErrorCode(parser))));
            return *report.error;
        }
        if (effects == 0)
            fail("has no vibration-effect");
        else if (done.kind.empty())
            fail("has no effect that can be read");
        if (report.error)
            return *report.error;
        return clipOfEffect();
    }

private:
    using Attributes = const char**;

    [[nodiscard]] std::string line() const { return fmt::format("line {}", XML_GetCurrentLineNumber(parser)); }

    void fail(std::string message, ErrorCode code = ErrorCode::invalidData)
    {
        report.fail(line(), std::move(message), code);
        XML_StopParser(parser, XML_FALSE);
    }

    /// Once for each text.
    void warn(const std::string& message)
    {
        if (told.size() < 100 && told.insert(message).second)
            report.warn(line(), message);
    }

    static void start(void* self, const char* name, Attributes attributes)
    {
        static_cast<VibrationXml*>(self)->startElement(name, attributes);
    }

    static void end(void* self, const char* name) { static_cast<VibrationXml*>(self)->endElement(name); }

    /// Leaves out the element that begins now, with all in it.
    void skip() { skipped = 1; }

    void startElement(const std::string& name, Attributes attributes)
    {
        if (report.error)
            return;
        if (skipped > 0)
        {
            ++skipped;
            return;
        }
        const std::string parent = path.empty() ? "" : path.back();
        if (path.empty() && name != "vibration-effect" && name != "vibration-select")
            return fail(fmt::format("the root is {}, but must be vibration-effect", shownText(name)));
        if (parent.empty() || parent == "vibration-select")
            startEffect(name);
        else if (parent == "vibration-effect")
            startKind(name, attributes);
        else if (parent == "waveform-effect" || (parent == "repeating" && effect.kind == "waveform-effect"))
            startInWaveform(name, attributes);
        else if (parent == "repeating-effect" || parent == "preamble" || parent == "repeating")
            startInRepeating(name, attributes);
        else if (name == "control-point")
            addPoint(attributes);
        else
            leaveOut(name);
        if (skipped == 0)
            path.push_back(name);
    }

    void endElement(const std::string& name)
    {
        if (report.error)
            return;
        if (skipped > 0)
        {
            --skipped;
            return;
        }
        if (name == "vibration-effect" && done.kind.empty() && checkEffect())
            done = std::move(effect);
        path.pop_back();
    }

    void leaveOut(const std::string& name)
    {
        warn(fmt::format("{} cannot be read and is left out", shownText(name)));
        skip();
    }

    void startEffect(const std::string& name)
    {
        if (name == "vibration-select")
            return;
        if (name != "vibration-effect")
            return leaveOut(name);
        ++effects;
        effect = {};
        hasInitial = false;
        if (done.kind.empty())
            return;
        warn("of several vibration-effects the first that can be read is taken");
        skip();
    }

    /// Whether the effect of this kind may begin: a vibration-effect has one, or several primitives.
    bool beginKind(const std::string& name)
    {
        const bool goesOn = effect.kind == name && (name == "primitive-effect" || path.back() != "vibration-effect");
        if (!effect.kind.empty() && !goesOn)
        {
            fail(
                fmt::format("{} follows {}, but a vibration-effect has only one effect", shownText(name), effect.kind));
            return false;
        }
        effect.kind = name;
        return true;
    }

    void startKind(const std::string& name, Attributes attributes)
    {
        if (name == "waveform-effect")
        {
            if (beginKind(name))
                check(name, attributes, {});
        }
        else if (name == "waveform-envelope-effect" || name == "basic-envelope-effect")
            startEnvelope(name, attributes);
        else if (name == "predefined-effect")
            addPredefined(name, attributes);
        else if (name == "primitive-effect")
            addPrimitive(name, attributes);
        else if (name == "repeating-effect")
            warn("what repeats is read once");
        else
            leaveOut(name);
    }

    void startInWaveform(const std::string& name, Attributes attributes)
    {
        if (name == "waveform-entry")
            addStep(attributes);
        else if (name == "repeating")
            warn("what repeats is read once");
        else
            leaveOut(name);
    }

    void startInRepeating(const std::string& name, Attributes attributes)
    {
        if (path.back() == "repeating-effect" && (name == "preamble" || name == "repeating"))
            return;
        startKind(name, attributes);
    }

    void startEnvelope(const std::string& name, Attributes attributes)
    {
        const bool isFirst = effect.kind.empty();
        if (!beginKind(name))
            return;
        const char* const initial = isBasic() ? "initialSharpness" : "initialFrequencyHz";
        check(name, attributes, {initial});
        const auto value = find(attributes, initial);
        if (value.empty())
            return;
        const double frequency = number(initial, value, isBasic() ? 0.0 : 0.001, isBasic() ? 1.0 : 20000.0);
        if (isFirst)
            effect.envelope.initialFrequency = frequency;
        else
            warn(fmt::format("{} of what repeats is left out", initial));
        hasInitial = true;
    }

    void addPoint(Attributes attributes)
    {
        const char* const level = isBasic() ? "intensity" : "amplitude";
        const char* const frequency = isBasic() ? "sharpness" : "frequencyHz";
        check("control-point", attributes, {level, frequency, "durationMs"});
        AndroidPoint point;
        point.amplitude = required(attributes, level, 0.0, 1.0);
        point.frequency = required(attributes, frequency, isBasic() ? 0.0 : 0.001, isBasic() ? 1.0 : 20000.0);
        point.duration = duration(attributes, 1.0);
        if (report.error)
            return;
        if (effect.envelope.points.empty() && !std::exchange(hasInitial, false))
            effect.envelope.initialFrequency = point.frequency;
        effect.envelope.points.push_back(point);
        countPoint(effect.envelope.points.size());
    }

    void addStep(Attributes attributes)
    {
        check("waveform-entry", attributes, {"durationMs", "amplitude"});
        AndroidStep step;
        step.duration = duration(attributes, 0.0);
        const auto amplitude = find(attributes, "amplitude");
        if (amplitude.empty() || amplitude == "default")
        {
            step.amplitude = 255;
            warn("the device's default amplitude becomes 255");
        }
        else
            step.amplitude = static_cast<int>(whole("amplitude", amplitude, 0.0, 255.0));
        if (report.error)
            return;
        effect.kind = "waveform-effect";
        if (step.duration > 0)
            effect.steps.push_back(step);
        countPoint(effect.steps.size());
    }

    template <std::size_t n>
    void addTap(const std::array<DeviceEffect, n>& known, const std::string& name, double scale)
    {
        const auto found =
            std::find_if(known.begin(), known.end(), [&](const DeviceEffect& one) { return one.name == name; });
        if (found == known.end())
            return warn(fmt::format("the effect \"{}\" is each device's own and is left out", shownText(name)));
        warn(fmt::format("the effect \"{}\" is each device's own and is read as an event", name));
        effect.events.push_back({effect.ms / 1000.0, found->amplitude * scale, found->sharpness});
        addMs(static_cast<double>(tapMs));
        countPoint(effect.events.size());
    }

    void addPredefined(const std::string& name, Attributes attributes)
    {
        if (!beginKind(name))
            return;
        check(name, attributes, {"name", "fallback"});
        const std::string effectName(find(attributes, "name"));
        if (effectName.empty())
            return fail("predefined-effect has no name");
        addTap(predefinedEffects, effectName, 1.0);
        if (effectName != "double_click" || report.error)
            return;
        constexpr double apart = 100.0; // ms
        addMs(apart - static_cast<double>(tapMs));
        addTap(predefinedEffects, effectName, 1.0);
    }

    void addPrimitive(const std::string& name, Attributes attributes)
    {
        if (!beginKind(name))
            return;
        check(name, attributes, {"name", "scale", "delayMs", "delayType"});
        const std::string effectName(find(attributes, "name"));
        if (effectName.empty())
            return fail("primitive-effect has no name");
        const auto scaleText = find(attributes, "scale");
        const double scale = scaleText.empty() ? 1.0 : number("scale", scaleText, 0.0, 1.0);
        const auto delayText = find(attributes, "delayMs");
        const double delay = delayText.empty() ? 0.0 : whole("delayMs", delayText, 0.0, longestXmlMs);
        const auto type = find(attributes, "delayType");
        if (!type.empty() && type != "pause" && type != "relative_start_offset")
            return fail(
                fmt::format("delayType is \"{}\", but must be pause or relative_start_offset", shownText(type)));
        // A pause begins where the effect before it ends, the other delay where that begins.
        const bool fromStart = type == "relative_start_offset" && !effect.events.empty();
        const double begin = fromStart ? effect.events.back().time * 1000.0 + delay : effect.ms + delay;
        if (report.error)
            return;
        effect.ms = begin;
        addMs(0.0);
        addTap(primitiveEffects, effectName, scale);
    }

    [[nodiscard]] bool isBasic() const { return effect.kind == "basic-envelope-effect"; }

    /// Whether anything was read of an effect that has ended; what is missing is an error where something began.
    bool checkEffect()
    {
        if (effect.kind == "waveform-effect" && effect.steps.empty())
            fail("waveform-effect has no entry that lasts");
        else if (effect.kind.ends_with("envelope-effect") && effect.envelope.points.empty())
            fail(fmt::format("{} has no control point", effect.kind));
        else if (effect.kind == "basic-envelope-effect" && effect.envelope.points.back().amplitude != 0.0)
            warn("the last intensity is not 0; Android rejects such effects");
        const bool hasTaps = effect.kind != "predefined-effect" && effect.kind != "primitive-effect";
        return !report.error && !effect.kind.empty() && (hasTaps || !effect.events.empty());
    }

    [[nodiscard]] Clip clipOfEffect() const
    {
        if (done.kind == "waveform-effect")
            return clipOfWaveform(done.steps);
        if (done.kind.ends_with("envelope-effect"))
            return clipOfEnvelope(done.envelope, done.kind == "basic-envelope-effect");
        Clip clip;
        clip.transients = done.events;
        sortByTime(clip.transients);
        clip.duration = clip.transients.back().time;
        finishImported(clip);
        return clip;
    }

    void countPoint(std::size_t points)
    {
        if (points > mostXmlPoints)
            fail("has more than 5 million points", ErrorCode::tooLarge);
    }

    void addMs(double ms)
    {
        effect.ms += ms;
        if (!(effect.ms <= longestXmlMs) && !report.error)
            fail("ends later than 24 hours", ErrorCode::tooLarge);
    }

    std::int64_t duration(Attributes attributes, double least)
    {
        const auto text = find(attributes, "durationMs");
        if (text.empty() && !report.error)
            fail("has no durationMs");
        const double ms = report.error ? 0.0 : whole("durationMs", text, least, longestXmlMs);
        if (!report.error)
            addMs(ms);
        return report.error ? 0 : std::llround(ms);
    }

    double required(Attributes attributes, const char* name, double low, double high)
    {
        const auto text = find(attributes, name);
        if (text.empty() && !report.error)
            fail(fmt::format("has no {}", name));
        return report.error ? 0.0 : number(name, text, low, high);
    }

    double number(const char* name, std::string_view text, double low, double high)
    {
        const auto value = parseNumber(text.substr(text.starts_with('+') ? 1 : 0));
        if (!report.error && !(value && *value >= low && *value <= high))
            fail(fmt::format("{} is \"{}\", but must be a number from {} to {}", name, shownText(text), low, high));
        return report.error ? low : *value;
    }

    double whole(const char* name, std::string_view text, double low, double high)
    {
        const double value = number(name, text, low, high);
        if (!report.error && value != std::floor(value))
            fail(fmt::format("{} is \"{}\", but must be a whole number", name, shownText(text)));
        return value;
    }

    [[nodiscard]] static std::string_view find(Attributes attributes, std::string_view name)
    {
        for (; attributes[0] != nullptr; attributes += 2)
            if (name == attributes[0])
                return attributes[1];
        return {};
    }

    /// Names the attributes that are not read.
    void check(std::string_view element, Attributes attributes, const std::vector<std::string_view>& known)
    {
        for (; attributes[0] != nullptr; attributes += 2)
            if (std::find(known.begin(), known.end(), attributes[0]) == known.end())
                warn(fmt::format("{} of {} cannot be read and is left out", shownText(attributes[0]), element));
    }

    XML_Parser parser = nullptr;
    ImportReport report;
    std::set<std::string> told;
    std::vector<std::string> path; ///< of elements that are open
    int skipped = 0;               ///< open elements that are left out
    std::size_t effects = 0;
    XmlEffect effect;        ///< that is open
    XmlEffect done;          ///< that is taken
    bool hasInitial = false; ///< the envelope says its first frequency
};
} // namespace

Result<ImportedClip> readVibrationXml(std::string_view bytes)
{
    ImportedClip imported;
    const auto text = foreignText(bytes, imported.warnings);
    if (!text)
        return text.error();
    auto clip = VibrationXml(imported.warnings).read(*text);
    if (!clip)
        return clip.error();
    imported.clip = std::move(*clip);
    if (auto valid = validate(imported.clip); !valid)
        return valid.error();
    return imported;
}

} // namespace pacini

#endif
