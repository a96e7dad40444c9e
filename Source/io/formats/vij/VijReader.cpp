#include "io/formats/ForeignText.h"
#include "io/formats/ImportReport.h"
#include "io/formats/JsonEntry.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/vij/VijFormat.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
class VijReader
{
public:
    VijReader(const nlohmann::json& tree, std::vector<std::string>& warnings) : root(&tree, "", error), report(warnings)
    {
    }

    std::optional<Error> read(Clip& filled)
    {
        const JsonEntry voices = root.required("voices");
        const JsonEntry envelopes = voices.required("envelopes");
        const Curve amplitude = curveOf(voices, "envelopes", 0);
        const Curve frequency = curveOf(voices, "envelopes", 1);
        const Curve strengths = curveOf(voices, "transients", 0);
        const Curve sharpnesses = curveOf(voices, "transients", 1);
        if (!error && amplitude.empty())
            envelopes.fail("has no point of amplitude");
        if (const JsonEntry bands = voices.optional("bands"); bands.size() > 0)
            report.warn(bands.path(), "is not kept");
        const double stated = statedDuration();
        if (error)
            return error;
        addBand(amplitude, frequency);
        addEvents(strengths, sharpnesses);
        clip.duration =
            std::max({stated, amplitude.back().time, clip.transients.empty() ? 0.0 : clip.transients.back().time});
        for (Breakpoint& point : clip.bands.front().pitch)
            point.time = std::min(point.time, clip.duration);
        lastUntilSounded(clip);
        filled = std::move(clip);
        return {};
    }

private:
    double statedDuration() const
    {
        const JsonEntry metadata = root.optional("metadata");
        if (!metadata.exists())
            return 0.0;
        const JsonEntry duration = metadata.optional("duration");
        const double seconds = duration.number();
        if (!(seconds >= 0.0 && seconds <= limits::duration))
            duration.fail("must be 0 to 24 hours");
        return seconds;
    }

    /// One of the lists of `voices.NAME`; empty when that has fewer.
    Curve curveOf(const JsonEntry& voices, std::string_view name, std::size_t which)
    {
        Curve curve;
        voices.optional(name).forEach(
            [&](const JsonEntry& list, std::size_t i)
            {
                if (i == which)
                    list.forEach([&](const JsonEntry& point, std::size_t) { addPoint(curve, point); });
            });
        return curve;
    }

    void addPoint(Curve& curve, const JsonEntry& point)
    {
        const JsonEntry time = point.required("time"), value = point.required("amplitude");
        const Breakpoint read{time.number(), value.number()};
        if (read.time < 0.0)
            time.fail("is before 0");
        else if (!curve.empty() && read.time < curve.back().time)
            time.fail("is earlier than the point before it");
        else if (!(read.time <= limits::duration))
            time.fail("is later than 24 hours", ErrorCode::tooLarge);
        if (!(read.value >= 0.0 && read.value <= 1.0))
            report.warn(value.path(), "is outside of 0 to 1 and is limited to this range");
        curve.push_back({read.time, std::clamp(read.value, 0.0, 1.0)});
    }

    void addBand(const Curve& amplitude, const Curve& frequency)
    {
        const NormalisedRange& range = questRange;
        Band band{range.low, range.hertzOf(0.5), range.high, 0, amplitude, frequency};
        for (Breakpoint& point : band.pitch)
            point.value = range.hertzOf(point.value);
        clip.bands.push_back(std::move(band));
    }

    void addEvents(const Curve& strengths, const Curve& sharpnesses)
    {
        constexpr double plain = 0.5;
        if (sharpnesses.size() != strengths.size())
            report.warn("voices.transients",
                        "the number of sharpnesses differs from that of the strengths; the nearest one is used");
        for (const Breakpoint& strength : strengths)
            clip.transients.push_back(
                {strength.time, strength.value, sharpnesses.empty() ? plain : valueAt(sharpnesses, strength.time)});
    }

    std::optional<Error> error;
    JsonEntry root;
    ImportReport report;
    Clip clip;
};
} // namespace

bool isVij(std::string_view bytes)
{
    return bytes.find("\"voices\"") != std::string_view::npos && bytes.find("\"envelopes\"") != std::string_view::npos;
}

Result<ImportedClip> readVij(std::string_view bytes)
{
    return importForeign(bytes, [](const nlohmann::json& tree, ImportedClip& imported)
                         { return VijReader(tree, imported.warnings).read(imported.clip); });
}

} // namespace pacini
