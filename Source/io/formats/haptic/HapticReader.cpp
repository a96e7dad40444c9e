#include "io/JsonTree.h"
#include "io/formats/ImportReport.h"
#include "io/formats/JsonEntry.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/haptic/HapticFormat.h"

#include <cmath>
#include <limits>

namespace pacini
{

namespace
{
/// The format's numbers are 32-bit floats, and its rules hold for them.
double asFloat(double value)
{
    return static_cast<double>(static_cast<float>(value));
}

class Reader
{
public:
    explicit Reader(const nlohmann::json& tree) : root(&tree, "", error) {}

    Result<ImportedClip> read()
    {
        readVersion();
        const JsonEntry envelopes = root.required("signals").required("continuous").required("envelopes");
        if (!error)
            readMetadata(root.optional("metadata"));
        readAmplitude(envelopes.required("amplitude"));
        if (const JsonEntry frequency = envelopes.optional("frequency"); frequency.exists())
            readFrequency(frequency);
        if (error)
            return *error;
        finish();
        if (auto valid = validate(clip); !valid)
            return valid.error();
        return ImportedClip{std::move(clip), std::move(warnings)};
    }

private:
    void readVersion()
    {
        const JsonEntry version = root.required("version");
        if (version.isText())
        {
            // Some programs write "1.0.0".
            const std::string text = version.text();
            if (text.substr(0, text.find('.')) != "1")
                version.fail("must begin with 1, the only version that is read", ErrorCode::unsupportedVersion);
            warnings.emplace_back("version: is a text; it is read as numbers");
            return;
        }
        for (const char* part : {"major", "minor", "patch"})
        {
            const JsonEntry entry = part == std::string_view("major") ? version.required(part) : version.optional(part);
            const double number = entry.number();
            if (number != std::floor(number) || number < 0.0 || number > std::numeric_limits<std::uint32_t>::max())
                entry.fail("must be a whole number from 0");
            else if (part == std::string_view("major") && entry.exists() && number != 1.0)
                entry.fail(fmt::format("is {}, but only version 1 is read", number), ErrorCode::unsupportedVersion);
            else if (part == std::string_view("minor") && number > 0.0)
                warnings.push_back(
                    fmt::format("version.minor: is {:.0f}; entries newer than version 1.0 are not kept", number));
        }
    }

    void readMetadata(const JsonEntry& metadata)
    {
        if (!metadata.exists())
            return;
        clip.name = metadata.optional("project").text();
        // Other programs' paths may have either slash.
        const std::string source = metadata.optional("source").text();
        const auto folder = source.find_last_of("/\\");
        clip.source.file = folder == std::string::npos ? source : source.substr(folder + 1);
        bool dropped = !metadata.optional("author").text().empty();
        dropped = !metadata.optional("description").text().empty() || dropped;
        static_cast<void>(metadata.optional("editor").text());
        metadata.optional("tags").forEach([&](const JsonEntry& tag, std::size_t)
                                          { dropped = !tag.text().empty() || dropped; });
        if (dropped)
            warnings.emplace_back("metadata: author, description and tags are not kept");
    }

    /// A point's time; they must not go back from `before`.
    double timeOf(const JsonEntry& point, double before) const
    {
        const JsonEntry entry = point.required("time");
        const double time = asFloat(entry.number());
        if (time < 0.0)
            entry.fail("is before 0");
        else if (time < before)
            entry.fail("is earlier than the point before it");
        else if (!std::isfinite(time) || time > limits::duration)
            entry.fail("is later than 24 hours", ErrorCode::tooLarge);
        return time;
    }

    static double unitValue(const JsonEntry& entry)
    {
        const double value = asFloat(entry.number());
        if (!(value >= 0.0 && value <= 1.0))
            entry.fail("is outside of 0 to 1");
        return value;
    }

    /// An emphasis of a point at `time` of amplitude `value`.
    void readEmphasis(const JsonEntry& emphasis, double time, double value)
    {
        constexpr double plain = 0.5;
        const JsonEntry strength = emphasis.optional("amplitude"), frequency = emphasis.optional("frequency");
        if (!strength.exists() && !frequency.exists())
        {
            firstEmpty = emptyEmphases++ == 0 ? emphasis.path() : firstEmpty;
            return;
        }
        if (!strength.exists())
            report.warn(strength.path(), "is missing; that of its point is taken");
        if (!frequency.exists())
            report.warn(frequency.path(), "is missing; 0.5 is taken");
        const Transient event{time, strength.exists() ? unitValue(strength) : value,
                              frequency.exists() ? unitValue(frequency) : plain};
        if (event.amplitude < value)
            strength.fail("is below the amplitude of its point");
        clip.transients.push_back(event);
    }

    void readAmplitude(const JsonEntry& amplitude)
    {
        double before = 0.0;
        amplitude.forEach(
            [&](const JsonEntry& point, std::size_t)
            {
                const double time = before = timeOf(point, before);
                const double value = unitValue(point.required("amplitude"));
                band.amplitude.push_back({time, value});
                if (const JsonEntry emphasis = point.optional("emphasis"); emphasis.exists())
                    readEmphasis(emphasis, time, value);
            });
        if (emptyEmphases > 0)
            warnings.push_back(fmt::format("{}: has neither amplitude nor frequency and is left out{}", firstEmpty,
                                           emptyEmphases > 1 ? fmt::format(", like {} more", emptyEmphases - 1) : ""));
        if (!error && band.amplitude.empty())
            amplitude.fail("has no point");
    }

    void readFrequency(const JsonEntry& frequency)
    {
        double before = 0.0;
        frequency.forEach(
            [&](const JsonEntry& point, std::size_t)
            {
                before = timeOf(point, before);
                band.pitch.push_back({before, range.hertzOf(unitValue(point.required("frequency")))});
            });
    }

    /// The clip of points that are all right by themselves.
    void finish()
    {
        const double first = band.amplitude.front().time;
        clip.duration = band.amplitude.back().time;
        if (clip.duration <= first)
            warnings.emplace_back("signals.continuous.envelopes.amplitude: has no duration; strict readers refuse it");
        if (!band.pitch.empty() && (band.pitch.front().time < first || band.pitch.back().time > clip.duration))
            warnings.emplace_back("signals.continuous.envelopes.frequency: is longer than the amplitudes and is cut "
                                  "off; strict readers refuse it");
        if (!band.pitch.empty() && band.pitch.front().time > clip.duration)
            band.pitch = {{clip.duration, band.pitch.front().value}};
        cutAfter(band.pitch, clip.duration);
        band.lowFrequency = range.low;
        band.highFrequency = range.high;
        band.centreFrequency = range.hertzOf(0.5);
        clip.bands.push_back(std::move(band));
        lastUntilSounded(clip);
    }

    std::optional<Error> error;
    JsonEntry root;
    Clip clip;
    Band band;
    NormalisedRange range = questRange;
    std::vector<std::string> warnings;
    ImportReport report{warnings};
    std::size_t emptyEmphases = 0;
    std::string firstEmpty; ///< place of the first of them
};
} // namespace

bool isHaptic(std::string_view bytes)
{
    // Enough to tell it from other JSON and from projects with such clips; what is wrong inside, the reader says.
    const auto has = [bytes](std::string_view word)
    {
        return bytes.find(word) != std::string_view::npos;
    };
    return has("\"signals\"") && has("\"envelopes\"") && !has("\"clipId\"");
}

Result<ImportedClip> readHaptic(std::string_view text)
{
    const auto tree = readJsonTree(text, largestHapticText);
    if (!tree)
        return tree.error();
    return Reader(*tree).read();
}

} // namespace pacini
