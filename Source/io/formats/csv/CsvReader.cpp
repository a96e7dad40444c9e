#include "io/JsonText.h"
#include "io/TextLines.h"
#include "io/formats/ForeignText.h"
#include "io/formats/ImportReport.h"
#include "io/formats/csv/CsvFormat.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
constexpr double plainFrequency = 150.0; // Hz, of an amplitude without frequency
constexpr std::size_t maxColumns = 2 * limits::bands + 64;

std::string_view trimmed(std::string_view text)
{
    const auto blank = [](char c)
    {
        return c == ' ' || c == '\r' || c == '"';
    };
    while (!text.empty() && blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && blank(text.back()))
        text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> parts(std::string_view line, char separator)
{
    std::vector<std::string_view> cells;
    for (std::size_t from = 0; from <= line.size();)
    {
        const std::size_t to = std::min(line.find(separator, from), line.size());
        cells.push_back(trimmed(line.substr(from, to - from)));
        from = to + 1;
    }
    return cells;
}

/// Kind of a column.
enum class Column
{
    ignored,
    time,
    envelope,
    centroid,
    amplitude,
    pitch,
    phase, ///< at time 0 only
    noise,
    event,
    sharpness
};

struct ColumnPlace
{
    Column kind = Column::ignored;
    std::size_t index = 0; ///< of the band
};

class CsvReader
{
public:
    explicit CsvReader(std::vector<std::string>& warningsToFill) : warnings(warningsToFill) {}

    Clip clip;
    std::optional<Error> error;

    void read(std::string_view text)
    {
        std::size_t number = takeSeparatorLine(text) ? 1 : 0;
        while (!text.empty() && !error)
        {
            const std::string_view line = takeLine(text);
            ++number;
            if (trimmed(line).empty() || line.starts_with('#'))
                continue;
            if (columns.empty())
                readTitles(line, number);
            else
                readRow(line, number);
        }
        if (!error && columns.empty())
            error = Error{ErrorCode::invalidData, "", "has no header line with the names of its columns"};
        if (!error)
            finish();
    }

private:
    void fail(std::size_t line, std::size_t column, std::string message)
    {
        if (!error)
            error =
                Error{ErrorCode::invalidData, fmt::format("line {}, column {}", line, column + 1), std::move(message)};
    }

    void readTitles(std::string_view line, std::size_t number)
    {
        for (const char candidate : {';', '\t', ','})
            if (line.find(candidate) != std::string_view::npos)
                separator = candidate;
        const auto titles = parts(line, separator);
        if (titles.size() > maxColumns)
            return fail(number, maxColumns, fmt::format("there are more than {} columns", maxColumns));
        for (std::size_t i = 0; i < titles.size() && !error; ++i)
        {
            columns.push_back(placeOf(titles[i], number, i));
            for (std::size_t k = 0; k < i; ++k)
                if (columns[i].kind != Column::ignored && columns[k].kind == columns[i].kind &&
                    columns[k].index == columns[i].index)
                    fail(number, i, fmt::format("'{}' is given twice", shownText(titles[i])));
        }
        const auto kindIs = [](Column kind)
        {
            return [kind](const ColumnPlace& place)
            {
                return place.kind == kind;
            };
        };
        if (!error && std::none_of(columns.begin(), columns.end(), kindIs(Column::time)))
            fail(number, 0, "no column is called 'time'");
    }

    ColumnPlace placeOf(std::string_view title, std::size_t line, std::size_t column)
    {
        const auto words = parts(title, ' ');
        std::vector<double> numbers;
        for (std::size_t i = 1; i < words.size(); ++i)
        {
            const auto value = parseNumber(words[i]);
            if (!value || !(*value >= 0.0 && *value <= limits::frequency))
                return ignored(title);
            numbers.push_back(*value);
        }
        const std::string_view name = words.front();
        if (numbers.empty())
        {
            if (name == "time")
                return {Column::time, 0};
            if (name == "envelope")
                return {Column::envelope, 0};
            if (name == "centroid")
                return {Column::centroid, 0};
            if (name == "event")
                return {Column::event, 0};
            if (name == "sharpness")
                return {Column::sharpness, 0};
            if (name == "amplitude" || name == "frequency" || name == "pitch")
                return {name == "amplitude" ? Column::amplitude : Column::pitch,
                        bandOf({plainFrequency, plainFrequency, plainFrequency})};
        }
        if (numbers.size() == 3 && (name == "amplitude" || name == "pitch" || name == "phase"))
        {
            if (!(numbers[0] <= numbers[1] && numbers[1] <= numbers[2]))
                fail(line, column, "needs low <= centre <= high");
            return {name == "amplitude" ? Column::amplitude
                    : name == "pitch"   ? Column::pitch
                                        : Column::phase,
                    bandOf(numbers)};
        }
        if (numbers.size() == 2 && name == "noise")
        {
            if (!(numbers[0] <= numbers[1]))
                fail(line, column, "needs low <= high");
            clip.noise.push_back({numbers[0], numbers[1], {}});
            return {Column::noise, clip.noise.size() - 1};
        }
        return ignored(title);
    }

    ColumnPlace ignored(std::string_view title)
    {
        warnings.push_back(fmt::format("line 1: the column '{}' is left out", shownText(title)));
        return {};
    }

    /// The last band with these frequencies, so that its pitch follows its amplitude, or a new one.
    std::size_t bandOf(const std::vector<double>& numbers)
    {
        for (std::size_t i = 0; i < clip.bands.size(); ++i)
            if (clip.bands[i].lowFrequency == numbers[0] && clip.bands[i].centreFrequency == numbers[1] &&
                clip.bands[i].highFrequency == numbers[2])
                return i;
        Band band;
        band.lowFrequency = numbers[0];
        band.centreFrequency = numbers[1];
        band.highFrequency = numbers[2];
        clip.bands.push_back(band);
        return clip.bands.size() - 1;
    }

    void readRow(std::string_view line, std::size_t number)
    {
        const auto cells = parts(line, separator);
        if (cells.size() > columns.size())
            return fail(number, columns.size(), "has more cells than columns");
        std::vector<std::optional<double>> values(columns.size());
        std::optional<double> time;
        for (std::size_t i = 0; i < cells.size(); ++i)
        {
            if (cells[i].empty() || columns[i].kind == Column::ignored)
                continue;
            values[i] = parseNumber(cells[i]);
            if (!values[i])
                return fail(number, i, fmt::format("'{}' is not a number", shownText(cells[i])));
            if (!std::isfinite(*values[i]))
                return fail(number, i, "is not a finite number");
            if (columns[i].kind == Column::time)
            {
                time = values[i];
                timeColumn = i;
            }
        }
        if (!time)
            return fail(number, timeColumn, "the time is missing");
        if (!(*time >= lastTime && *time <= limits::duration))
            return fail(number, timeColumn,
                        *time > limits::duration ? "is later than 24 hours"
                        : *time < 0.0            ? "is negative"
                                                 : "is earlier than the row before");
        lastTime = *time;
        std::optional<Transient> event;
        for (std::size_t i = 0; i < values.size() && !error; ++i)
            if (values[i])
                store(columns[i], *time, *values[i], event, number, i);
        if (event && event->amplitude >= 0.0)
            clip.transients.push_back(*event);
        else if (event)
            fail(number, timeColumn, "a sharpness needs an event in the same line");
    }

    void store(ColumnPlace place, double time, double value, std::optional<Transient>& event, std::size_t line,
               std::size_t column)
    {
        constexpr double plainSharpness = 0.5;
        const bool isFrequency = place.kind == Column::pitch || place.kind == Column::centroid;
        const bool isShare = place.kind == Column::sharpness || place.kind == Column::phase;
        const double most = isFrequency ? limits::frequency : isShare ? 1.0 : limits::amplitude;
        const double least = place.kind == Column::pitch ? 1e-3 : 0.0;
        if (place.kind != Column::time && !(value >= least && value <= most))
            return fail(line, column, fmt::format("must be {} to {}", least, most));
        switch (place.kind)
        {
        case Column::envelope:
            clip.envelope.push_back({time, value});
            break;
        case Column::centroid:
            clip.centroid.push_back({time, value});
            break;
        case Column::amplitude:
            clip.bands[place.index].amplitude.push_back({time, value});
            break;
        case Column::pitch:
            clip.bands[place.index].pitch.push_back({time, value});
            break;
        case Column::phase:
            if (time != 0.0)
                return fail(line, column, "must be at time 0");
            clip.bands[place.index].phase = value;
            break;
        case Column::noise:
            clip.noise[place.index].amplitude.push_back({time, value});
            break;
        case Column::event:
            event = Transient{time, value, event ? event->sharpness : plainSharpness};
            break;
        case Column::sharpness:
            event = Transient{time, event ? event->amplitude : -1.0, value};
            break;
        case Column::time:
        case Column::ignored:
            break;
        }
    }

    void finish()
    {
        clip.duration = lastTime;
        const bool endsWithEvent = !clip.transients.empty() && clip.transients.back().time == lastTime;
        finishImported(clip, !endsWithEvent);
    }

    std::vector<std::string>& warnings;
    std::vector<ColumnPlace> columns;
    char separator = ',';
    double lastTime = 0.0;
    std::size_t timeColumn = 0;
};
} // namespace

bool isCsv(std::string_view bytes)
{
    return bytes.starts_with("time,") || bytes.starts_with("time;") || bytes.starts_with("time\t");
}

Result<ImportedClip> readCsv(std::string_view bytes)
{
    ImportedClip result;
    const auto text = foreignText(bytes, result.warnings);
    if (!text)
        return text.error();
    CsvReader reader(result.warnings);
    reader.read(*text);
    if (reader.error)
        return *reader.error;
    result.clip = std::move(reader.clip);
    if (auto valid = validate(result.clip); !valid)
        return valid.error();
    return result;
}

} // namespace pacini
