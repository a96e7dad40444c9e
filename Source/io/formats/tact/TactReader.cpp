#include "io/FieldsReader.h"
#include "io/formats/ForeignText.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/tact/TactFormat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t maxElements = 5'000'000;
constexpr double longestMs = limits::duration * 1000.0;

/// A straight piece of strength.
struct Piece
{
    double from = 0.0, to = 0.0; ///< ms
    double first = 0.0, last = 0.0;
};

struct Feedback
{
    double start = 0.0, end = 0.0; ///< ms
    std::string playback;
    std::vector<std::pair<double, double>> points; ///< ms from the start (paths), intensity
};

class TactReader
{
public:
    FieldsReader reader;
    std::vector<std::string>& warnings;
    std::string name = {};
    std::vector<Piece> pieces = {};
    double duration = 0.0; ///< ms

    void read()
    {
        int unused = 0;
        reader.object("project", unused, Need::required,
                      [&](int&)
                      {
                          reader.optionalText("name", name);
                          std::optional<double> seconds;
                          reader.optionalNumber("mediaFileDuration", seconds);
                          std::vector<int> tracks;
                          reader.list("tracks", tracks, 10'000, "tracks", [&](int&) { readTrack(); });
                      });
        std::optional<double> ms;
        reader.optionalNumber("durationMillis", ms);
        if (ms && !(*ms >= 0.0 && *ms <= longestMs))
            reader.fail("durationMillis", "must be 0 to 24 hours");
        else if (ms)
            duration = std::max(duration, *ms);
    }

private:
    void readTrack()
    {
        bool enabled = true;
        reader.truth("enable", enabled);
        std::vector<int> effects;
        reader.list("effects", effects, maxElements, "effects", [&](int&) { readEffect(enabled); });
    }

    void readEffect(bool enabled)
    {
        double start = 0.0, length = 0.0;
        reader.number("startTime", start, Need::required);
        reader.number("offsetTime", length, Need::optional);
        if (!(start >= 0.0 && start <= longestMs))
            reader.fail("startTime", "must be 0 to 24 hours");
        if (!(length >= 0.0 && start + length <= longestMs))
            reader.fail("offsetTime", "must be 0 to 24 hours");
        int unused = 0;
        reader.object("modes", unused, Need::optional,
                      [&](int&)
                      {
                          for (const std::string& position : reader.names())
                              reader.object(position.c_str(), unused, Need::optional,
                                            [&](int&) { readMode(start, enabled); });
                      });
        if (enabled && !reader.error)
            duration = std::max(duration, start + length);
    }

    void readMode(double start, bool enabled)
    {
        std::string mode = "DOT_MODE";
        reader.optionalText("mode", mode);
        const bool isPath = mode == "PATH_MODE";
        if (!isPath && mode != "DOT_MODE")
            reader.fail("mode", fmt::format("must be DOT_MODE or PATH_MODE, not '{}'", shownText(mode)));
        int unused = 0;
        reader.object(isPath ? "pathMode" : "dotMode", unused, Need::optional,
                      [&](int&)
                      {
                          std::vector<Feedback> feedback;
                          reader.list("feedback", feedback, maxElements, "feedback",
                                      [&](Feedback& one) { readFeedback(one, isPath, start, enabled); });
                      });
    }

    void readFeedback(Feedback& feedback, bool isPath, double start, bool enabled)
    {
        feedback.playback = "NONE";
        reader.number("startTime", feedback.start, isPath ? Need::optional : Need::required);
        reader.number("endTime", feedback.end, isPath ? Need::optional : Need::required);
        reader.optionalText("playbackType", feedback.playback);
        reader.list("pointList", feedback.points, maxElements, "points",
                    [&](std::pair<double, double>& point)
                    {
                        reader.number("time", point.first, isPath ? Need::required : Need::optional);
                        reader.number("intensity", point.second, Need::required);
                        if (!(point.second >= 0.0 && point.second <= 1.0))
                            reader.fail("intensity", "must be 0 to 1");
                        if (!(point.first >= 0.0 && start + point.first <= longestMs))
                            reader.fail("time", "must be 0 to 24 hours");
                    });
        if (!(feedback.start >= 0.0 && feedback.start <= feedback.end && start + feedback.end <= longestMs))
            reader.fail("endTime", "must be from startTime on, within 24 hours");
        if (reader.error || !enabled || feedback.points.empty())
            return;
        if (isPath)
        {
            for (std::size_t i = 0; i + 1 < feedback.points.size(); ++i)
            {
                const auto& [time, level] = feedback.points[i];
                const auto& [next, nextLevel] = feedback.points[i + 1];
                if (next >= time)
                    addPiece({start + time, start + next, level, nextLevel});
            }
            return;
        }
        double level = 0.0;
        for (const auto& point : feedback.points)
            level = std::max(level, point.second);
        const bool fadesIn = feedback.playback == "FADE_IN" || feedback.playback == "FADE_IN_OUT";
        const bool fadesOut = feedback.playback == "FADE_OUT" || feedback.playback == "FADE_IN_OUT";
        const double from = start + feedback.start, to = start + feedback.end;
        if (fadesIn && fadesOut)
        {
            addPiece({from, 0.5 * (from + to), 0.0, level});
            addPiece({0.5 * (from + to), to, level, 0.0});
        }
        else
            addPiece({from, to, fadesIn ? 0.0 : level, fadesOut ? 0.0 : level});
    }

    void addPiece(const Piece& piece)
    {
        if (piece.to > piece.from)
            pieces.push_back(piece);
        duration = std::max(duration, piece.to);
    }
};

/// The largest of pieces at each time. Pieces that overlap are sampled every frame where they do.
Curve largestOf(std::vector<Piece> pieces, double duration)
{
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
    Curve curve;
    const auto put = [&](double ms, double level)
    {
        curve.push_back({ms / 1000.0, level});
    };
    double reached = 0.0;
    for (std::size_t i = 0; i < pieces.size();)
    {
        double end = pieces[i].to;
        std::size_t next = i + 1;
        bool same = true; // several motors or places that do the same are one
        while (next < pieces.size() && pieces[next].from < end)
        {
            same = same && pieces[next].from == pieces[i].from && pieces[next].to == pieces[i].to;
            end = std::max(end, pieces[next].to);
            ++next;
        }
        const double start = pieces[i].from;
        if (start > reached && (curve.empty() || curve.back().value > 0.0))
            put(reached, 0.0);
        if (start > reached)
            put(start, 0.0);
        if (same)
        {
            Piece largest = pieces[i];
            for (std::size_t k = i; k < next; ++k)
            {
                largest.first = std::max(largest.first, pieces[k].first);
                largest.last = std::max(largest.last, pieces[k].last);
            }
            put(start, largest.first);
            put(end, largest.last);
        }
        else
        {
            // The frames of the run, each at the largest of the pieces that sound in it.
            const auto count = static_cast<std::size_t>(std::ceil((end - start) / static_cast<double>(tactFrame)));
            std::vector<double> levels(count, 0.0);
            for (std::size_t k = i; k < next; ++k)
            {
                const Piece& piece = pieces[k];
                auto n = static_cast<std::size_t>((piece.from - start) / static_cast<double>(tactFrame));
                for (; n < count; ++n)
                {
                    const double middle = start + (static_cast<double>(n) + 0.5) * static_cast<double>(tactFrame);
                    if (start + static_cast<double>(n) * static_cast<double>(tactFrame) >= piece.to)
                        break;
                    const double place = std::clamp((middle - piece.from) / (piece.to - piece.from), 0.0, 1.0);
                    levels[n] = std::max(levels[n], piece.first + place * (piece.last - piece.first));
                }
            }
            for (std::size_t n = 0; n < count; ++n)
            {
                put(start + static_cast<double>(n) * static_cast<double>(tactFrame), levels[n]);
                put(std::min(start + static_cast<double>(n + 1) * static_cast<double>(tactFrame), end), levels[n]);
            }
        }
        reached = end;
        i = next;
    }
    if (!curve.empty() && reached < duration)
    {
        put(reached, 0.0);
        put(duration, 0.0);
    }
    return curve;
}

std::optional<Error> readTactProject(const nlohmann::json& tree, ImportedClip& imported)
{
    TactReader reader{FieldsReader(tree), imported.warnings};
    reader.reader.takeTextsAsNumbers();
    reader.read();
    if (reader.reader.error)
        return reader.reader.error;
    if (const std::size_t texts = reader.reader.textsTaken(); texts > 0)
        imported.warnings.push_back(
            fmt::format("project.tracks: {} in quotes and read as numbers",
                        texts == 1 ? std::string("a number is") : fmt::format("{} numbers are", texts)));
    SingleVoice voice;
    voice.duration = reader.duration / 1000.0;
    voice.amplitude = largestOf(std::move(reader.pieces), reader.duration);
    voice.frequency = {{0.0, tactMotorFrequency}};
    imported.clip = clipOfVoice(std::move(voice));
    imported.clip.name = importedName(reader.name);
    imported.warnings.emplace_back("project.tracks: the strongest of all motors is read as one amplitude");
    return {};
}
} // namespace

bool isTact(std::string_view bytes)
{
    constexpr auto none = std::string_view::npos;
    return bytes.find("\"project\"") != none && bytes.find("\"tracks\"") != none;
}

Result<ImportedClip> readTact(std::string_view bytes)
{
    return importForeign(bytes, readTactProject);
}

} // namespace pacini
