#include "io/formats/LossList.h"
#include "io/formats/csv/CsvFormat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
/// The table to write: values of column `c` at a time; the n-th value of a column at one time is in the n-th row of
/// that time.
class Table
{
public:
    void add(std::string title, const Curve& curve)
    {
        const std::size_t column = titles.size();
        titles.push_back(std::move(title));
        std::size_t repeat = 0;
        for (std::size_t i = 0; i < curve.size(); ++i)
        {
            repeat = i > 0 && curve[i].time == curve[i - 1].time ? repeat + 1 : 0;
            rows[{curve[i].time, repeat}].emplace_back(column, curve[i].value);
        }
    }

    void addTime(double time) { rows[{time, 0}]; }

    [[nodiscard]] std::string text() const
    {
        std::string out = "time";
        for (const std::string& title : titles)
            out += "," + title;
        for (const auto& [at, cells] : rows)
        {
            out += fmt::format("\n{}", at.first == 0.0 ? 0.0 : at.first);
            std::size_t column = 0;
            for (const auto& [place, value] : cells)
            {
                for (; column <= place; ++column)
                    out += ',';
                out += fmt::format("{}", value == 0.0 ? 0.0 : value);
            }
            for (; column < titles.size(); ++column)
                out += ',';
        }
        return out + "\n";
    }

private:
    std::vector<std::string> titles;
    std::map<std::pair<double, std::size_t>, std::vector<std::pair<std::size_t, double>>> rows;
};
} // namespace

Result<ExportedClip> writeCsv(const Clip& clip, const ExportParams&)
{
    Table table;
    LossList losses;
    losses.addText(clip, false);
    if (!clip.envelope.empty())
        table.add("envelope", clip.envelope);
    if (!clip.centroid.empty())
        table.add("centroid", clip.centroid);
    for (std::size_t i = 0; i < clip.bands.size(); ++i)
    {
        Band band = clip.bands[i];
        // Columns are told apart by their frequencies.
        const auto same = [&](const Band& other)
        {
            return other.lowFrequency == band.lowFrequency && other.centreFrequency == band.centreFrequency &&
                   other.highFrequency == band.highFrequency;
        };
        const auto place = clip.bands.begin() + static_cast<std::ptrdiff_t>(i);
        const auto repeats = std::count_if(clip.bands.begin(), place, same);
        if (repeats > 0)
        {
            const double factor = 1.0 + 1e-6 * static_cast<double>(repeats);
            losses.add(LossKind::frequency, 0.0, clip.duration, std::log2(factor),
                       "bands of the same frequencies are moved apart");
            band.highFrequency =
                std::min(band.highFrequency * factor + 1e-6 * static_cast<double>(repeats), limits::frequency);
        }
        const std::string range = fmt::format("{} {} {}", band.lowFrequency, band.centreFrequency, band.highFrequency);
        table.add("amplitude " + range, band.amplitude);
        if (!band.pitch.empty())
            table.add("pitch " + range, band.pitch);
        if (band.phase != 0.0)
            table.add("phase " + range, Curve{{0.0, band.phase}});
    }
    for (const NoiseBand& band : clip.noise)
        table.add(fmt::format("noise {} {}", band.lowFrequency, band.highFrequency), band.amplitude);
    if (!clip.transients.empty())
    {
        Curve levels, sharpness;
        for (const Transient& event : clip.transients)
        {
            levels.push_back({event.time, event.amplitude});
            sharpness.push_back({event.time, event.sharpness});
        }
        table.add("event", levels);
        table.add("sharpness", sharpness);
    }
    table.addTime(0.0);
    table.addTime(clip.duration);
    return oneFile(table.text(), std::move(losses));
}

} // namespace pacini
