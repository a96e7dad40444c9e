#include "io/formats/hjif/HjifVoices.h"

#include "io/formats/hjif/BakedClip.h"
#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFit.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifLikeness.h"

#include <pacini/synthesis/DecoderChoice.h>
#include <pacini/synthesis/VoiceMerge.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
constexpr double fineStep = 0.001;           // s: that of the levelling gain
constexpr double usualPrice = 12.0;          // dB^2 steps
constexpr double floorBelowLoudest = 0.018;  // -35 dB
constexpr double bytesPerPoint = 58.0;       // about
constexpr double pointsPerKilobyte = 0.6;    // of HjifDistance: what a kilobyte per second must gain
constexpr double longestSearched = 120.0;    // s: it takes 50 ms a second
constexpr std::size_t candidatesRefined = 2; // of the ways to make few voices

/// A way to make few voices of a clip.
struct Reduction
{
    std::size_t voices = 5;
    double semitones = 2.0; ///< within which pitch stays
};

/// As few points as a walk along the curve finds that keep every point within `share` of its value, or within
/// `floor`: a limit that follows the level keeps the rise of an event out of silence. The cone of slopes from the last
/// kept point to all points since is that of J. O'Rourke, "An on-line algorithm for fitting straight lines between data
/// ranges" (1981), with the line starting at a point.
Curve withinShare(const Curve& curve, double share, double floor)
{
    if (curve.size() < 3)
        return curve;
    constexpr double any = std::numeric_limits<double>::infinity();
    Curve kept{curve.front()};
    // The last kept point is asked for anew each time: keeping one moves it.
    const auto slopeTo = [&kept](double value, const Breakpoint& point)
    {
        const Breakpoint& from = kept.back();
        return point.time > from.time ? (value - from.value) / (point.time - from.time) : any;
    };
    double least = -any, most = any;
    for (std::size_t i = 1; i < curve.size(); ++i)
    {
        const double slope = slopeTo(curve[i].value, curve[i]);
        if (curve[i].time <= kept.back().time || slope < least || slope > most)
        {
            if (!(kept.back() == curve[i - 1]))
                kept.push_back(curve[i - 1]);
            least = -any;
            most = any;
            if (curve[i].time <= kept.back().time)
            {
                kept.push_back(curve[i]);
                continue;
            }
        }
        const double tolerance = std::max(floor, share * curve[i].value);
        least = std::max(least, slopeTo(curve[i].value - tolerance, curve[i]));
        most = std::min(most, slopeTo(curve[i].value + tolerance, curve[i]));
    }
    if (!(kept.back() == curve.back()))
        kept.push_back(curve.back());
    return kept;
}

/// Few points that stay within some semitones. It comes before the levelling, which undoes the beats of the waves that
/// are really played.
Curve fewPitches(Curve pitch, double semitones)
{
    for (Breakpoint& point : pitch)
        point.value = std::log2(point.value);
    pitch = withinShare(pitch, 0.0, semitones / 12.0);
    for (Breakpoint& point : pitch)
        point.value = std::exp2(point.value);
    return pitch;
}

/// Gives events that the bands reach by themselves a pulse that is hardly there.
void markCovered(Clip& played, const Clip& clip)
{
    constexpr double markBelowBands = 0.055; // -25 dB
    for (std::size_t i = 0; i < played.transients.size(); ++i)
    {
        Transient& event = played.transients[i];
        const double mark = markBelowBands * hjifLevelAt(played, event.time) / hjifTransientLevel(event.sharpness);
        event.amplitude = std::max(event.amplitude, std::min(mark, clip.transients[i].amplitude));
    }
}

/// The clip on few bands, levelled, with a point every millisecond.
Clip reduced(const Clip& clip, CarrierMode carriers, const Reduction& how)
{
    Clip few = clip;
    if (carriers == CarrierMode::pitch)
    {
        mergeVoices(few, how.voices);
        for (Band& band : few.bands)
            band.pitch = fewPitches(std::move(band.pitch), how.semitones);
    }
    Clip played = bakedClip(few, 1.0, fineStep);
    markCovered(played, clip);
    return played;
}

double leastFelt(const Clip& clip)
{
    return floorBelowLoudest * hjifHighestLevel(clip);
}

Clip withCurves(Clip clip, std::vector<Curve> curves)
{
    for (std::size_t i = 0; i < curves.size(); ++i)
        clip.bands[i].amplitude = std::move(curves[i]);
    return clip;
}

/// What is to be written, and what it was made of.
struct Written
{
    Clip all;
    std::vector<Curve> curves;
};

/// Looks for the file that is most like the clip for its bytes.
class Search
{
public:
    Search(const Clip& clipToWrite, const DecoderParams& decoder)
        : clip(clipToWrite), carriers(decoder.carriers), likeness(clip, decoder)
    {
    }

    Written best()
    {
        constexpr std::array ways{Reduction{4, 1.0}, Reduction{4, 2.0}, Reduction{5, 1.0},
                                  Reduction{5, 2.0}, Reduction{6, 1.0}, Reduction{6, 2.0}};
        std::vector<Candidate> candidates;
        for (const Reduction& way : ways)
        {
            candidates.emplace_back(reduced(clip, carriers, way));
            candidates.back().cost = refine(candidates.back(), usualPrice, 1);
            if (carriers != CarrierMode::pitch)
                break; // they are the bands that the clip has
        }
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
        candidates.resize(std::min(candidates.size(), candidatesRefined));
        for (const Candidate& candidate : candidates)
            for (const double price : {5.0, 8.0, 12.0, 18.0, 27.0})
                refine(candidate, price, 2);
        return std::move(found);
    }

private:
    struct Candidate
    {
        Candidate() = default;
        explicit Candidate(Clip wanted) : exact(std::move(wanted)), fit(exact, leastFelt(exact), true) {}

        Clip exact;
        HjifFit fit;
        double cost = 0.0;
    };

    /// Fits with `price` and then, `rounds` times, better around the events that are felt in one of both only. The
    /// least cost; the best of all is kept.
    double refine(const Candidate& candidate, double price, int rounds)
    {
        std::vector<double> need(candidate.fit.steps(), 1.0);
        double least = std::numeric_limits<double>::infinity();
        for (int round = 0; round <= rounds; ++round)
        {
            std::vector<Curve> curves = candidate.fit.curves(price, need);
            std::size_t points = 0;
            for (const Curve& curve : curves)
                points += curve.size();
            const HjifDistance distance = likeness.distanceTo(withCurves(candidate.exact, curves));
            const double kilobytes =
                1e-3 * bytesPerPoint * static_cast<double>(points) / std::max(clip.duration, HjifFit::step);
            const double cost = distance.value + pointsPerKilobyte * kilobytes;
            least = std::min(least, cost);
            if (found.curves.empty() || cost < leastOfAll)
            {
                leastOfAll = cost;
                found = {candidate.exact, std::move(curves)};
            }
            for (const double time : distance.events)
                raiseAround(need, time);
        }
        return least;
    }

    /// An event is a rise of the last 10 ms; what is before it has to stay low.
    static void raiseAround(std::vector<double>& need, double event)
    {
        constexpr double before = 0.025, after = 0.015; // s
        const auto stepOf = [](double time)
        {
            return static_cast<std::size_t>(std::max(time, 0.0) / HjifFit::step);
        };
        for (std::size_t i = stepOf(event - before); i < std::min(stepOf(event + after) + 1, need.size()); ++i)
            need[i] *= 3.0;
    }

    const Clip& clip;
    CarrierMode carriers;
    HjifLikeness likeness;
    Written found;
    double leastOfAll = std::numeric_limits<double>::infinity();
};

/// What is mostly the best.
Written usual(const Clip& clip, CarrierMode carriers)
{
    Written written{reduced(clip, carriers, {}), {}};
    const HjifFit fit(written.all, leastFelt(written.all), false);
    written.curves = fit.curves(usualPrice, std::vector<double>(fit.steps(), 1.0));
    return written;
}
} // namespace

Clip hjifVoicesOf(const Clip& clip, LossList& losses, HjifEffort effort)
{
    const DecoderParams decoder = decoderParamsFor(clip, {}, {}, 67.0);
    if (clip.envelope.empty() || clip.bands.empty() || !decoder.followEnvelope)
        return bakedClip(clip, 1.0, fineStep);
    const bool search = effort == HjifEffort::search && clip.duration <= longestSearched;
    Written written = search ? Search(clip, decoder).best() : usual(clip, decoder.carriers);
    if (clip.bands.size() > written.all.bands.size())
        losses.add(LossKind::bands, 0.0, clip.duration, 0.0,
                   fmt::format("{} bands share {}", clip.bands.size(), written.all.bands.size()));
    for (std::size_t i = 0; i < written.curves.size(); ++i)
        if (!written.curves[i].empty() && !written.all.bands[i].amplitude.empty())
            losses.addThinned(written.all.bands[i].amplitude, written.curves[i]);
    return withCurves(std::move(written.all), std::move(written.curves));
}

} // namespace pacini
