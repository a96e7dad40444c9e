#include "io/formats/hjif/HjifVoices.h"

#include "io/formats/hjif/BakedClip.h"
#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFit.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifLikeness.h"
#include "io/formats/hjif/HjifTaps.h"

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
constexpr double pointsPerEvent = 2.0;       // of HjifDistance: what an event as a Transient is worth
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

/// Share of the waves for each event; none: events are merged.
using TapShares = std::vector<HjifTapShare>;

constexpr double usualShare = 0.25; // of the waves
constexpr double nearlyAll = 0.95;  // better for hits with little else around them

TapShares sharesOfAll(const Clip& clip, double share)
{
    constexpr double rounding = 1.01; // amplitudes have three digits in the file
    TapShares shares;
    for (const Transient& event : clip.transients)
        shares.push_back({share, rounding * hjifLeastTap * event.amplitude});
    return shares;
}

/// The clip on few bands, levelled, with a point every millisecond.
HjifVoices reduced(const Clip& clip, CarrierMode carriers, const Reduction& how, const TapShares& shares)
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
    std::vector<HjifEvent> events = hjifEventsOf(played);
    if (!shares.empty())
        hjifMakeRoom(played, events, shares, clip.envelope);
    return {std::move(played), std::move(events)};
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

/// The content to write, and its source.
struct Written
{
    HjifVoices all;
    std::vector<Curve> curves;
};

/// What is mostly the best.
Written usual(const Clip& clip, CarrierMode carriers, const TapShares& shares)
{
    Written written{reduced(clip, carriers, {}, shares), {}};
    const HjifFit fit(written.all.clip, leastFelt(written.all.clip), false);
    written.curves = fit.curves(usualPrice, std::vector<double>(fit.steps(), 1.0));
    return written;
}

/// Chooses the share of the waves that events take.
class TapChoice
{
public:
    TapChoice(const Clip& clipToWrite, CarrierMode carrierMode, HjifLikeness& measure)
        : clip(clipToWrite), carriers(carrierMode), likeness(measure)
    {
        const HjifVoices merged = reduced(clip, carriers, {}, {});
        without = likeness.distancesAround(merged.clip, merged.events);
    }

    /// Every event a quarter, but those where that costs more than the event is worth.
    [[nodiscard]] TapShares quick() const
    {
        TapShares shares = sharesOfAll(clip, usualShare);
        const std::vector<double> costs = costsOf(shares);
        for (std::size_t i = 0; i < shares.size(); ++i)
            if (costs[i] > pointsPerEvent)
                shares[i] = {};
        return shares;
    }

    /// The best of some ways, as a whole file each.
    [[nodiscard]] TapShares searched() const
    {
        TapShares best(clip.transients.size());
        double least = costOf(best);
        for (const double share : {usualShare, nearlyAll})
        {
            const TapShares every = sharesOfAll(clip, share);
            const std::vector<double> costs = costsOf(every);
            std::vector<double> sorted = costs;
            std::sort(sorted.begin(), sorted.end());
            for (const double part : {1.0, 0.9, 0.75, 0.5, 0.25})
            {
                const double count = std::ceil(part * static_cast<double>(sorted.size()));
                TapShares some = every;
                for (std::size_t i = 0; i < some.size(); ++i)
                    if (costs[i] > sorted[static_cast<std::size_t>(count) - 1])
                        some[i] = {};
                if (const double cost = costOf(some); cost < least)
                {
                    least = cost;
                    best = std::move(some);
                }
            }
        }
        return best;
    }

private:
    /// What each event costs more than a merged one.
    [[nodiscard]] std::vector<double> costsOf(const TapShares& shares) const
    {
        const HjifVoices with = reduced(clip, carriers, {}, shares);
        std::vector<double> costs = likeness.distancesAround(with.clip, with.events);
        for (std::size_t i = 0; i < costs.size(); ++i)
            costs[i] -= without[i];
        return costs;
    }

    /// The distance of the whole file, and what the events that are no Transients are worth.
    [[nodiscard]] double costOf(const TapShares& shares) const
    {
        const Written file = usual(clip, carriers, shares);
        double cost = likeness.distanceTo(withCurves(file.all.clip, file.curves), file.all.events).value;
        for (const HjifTapShare& share : shares)
            cost += share.least > 0.0 ? 0.0 : pointsPerEvent;
        return cost;
    }

    const Clip& clip;
    CarrierMode carriers;
    HjifLikeness& likeness;
    std::vector<double> without;
};

/// Looks for the file that is most like the clip for its bytes.
class Search
{
public:
    Search(const Clip& clipToWrite, CarrierMode carrierMode, HjifLikeness& measure, const TapShares& eventShares)
        : clip(clipToWrite), carriers(carrierMode), likeness(measure), shares(eventShares)
    {
    }

    Written best()
    {
        constexpr std::array ways{Reduction{4, 1.0}, Reduction{4, 2.0}, Reduction{5, 1.0},
                                  Reduction{5, 2.0}, Reduction{6, 1.0}, Reduction{6, 2.0}};
        std::vector<Candidate> candidates;
        for (const Reduction& way : ways)
        {
            candidates.emplace_back(reduced(clip, carriers, way, shares));
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
        explicit Candidate(HjifVoices wanted) : exact(std::move(wanted)), fit(exact.clip, leastFelt(exact.clip), true)
        {
        }

        HjifVoices exact;
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
            const Clip file = withCurves(candidate.exact.clip, curves);
            const HjifDistance distance =
                likeness.distanceTo(file, shares.empty() ? hjifEventsOf(file) : candidate.exact.events);
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
    HjifLikeness& likeness;
    const TapShares& shares;
    Written found;
    double leastOfAll = std::numeric_limits<double>::infinity();
};

/// Events that are no Transients of the file.
void addMerged(LossList& losses, const Clip& clip, const std::vector<HjifEvent>& events, EventExport how)
{
    for (std::size_t i = 0; i < events.size(); ++i)
        if (!isHjifTap(events[i], clip.transients[i].amplitude))
            losses.add(LossKind::transient, clip.transients[i].time, 0.0, clip.transients[i].amplitude,
                       how == EventExport::merged
                           ? "dropped as a transient: its wave and the bands are as strong"
                           : "dropped as a transient: two periods of 91 Hz would differ too much");
}
} // namespace

HjifVoices hjifVoicesOf(const Clip& clip, LossList& losses, HjifEffort effort, EventExport events)
{
    const DecoderParams decoder = decoderParamsFor(clip, {}, {}, 67.0);
    if (clip.envelope.empty() || clip.bands.empty() || !decoder.followEnvelope)
    {
        HjifVoices all{bakedClip(clip, 1.0, fineStep), {}};
        all.events = hjifEventsOf(all.clip);
        if (events == EventExport::transients)
            hjifMakeRoom(all.clip, all.events, sharesOfAll(clip, 0.0), {});
        addMerged(losses, clip, all.events, events);
        return all;
    }
    const bool isShort = clip.duration <= longestSearched;
    const bool search = isShort && effort == HjifEffort::search;
    const bool taps = events == EventExport::transients && !clip.transients.empty();
    Written written;
    if (search || (isShort && taps))
    {
        HjifLikeness likeness(clip, decoder);
        TapShares shares;
        if (taps)
        {
            const TapChoice choice(clip, decoder.carriers, likeness);
            shares = search ? choice.searched() : choice.quick();
        }
        written =
            search ? Search(clip, decoder.carriers, likeness, shares).best() : usual(clip, decoder.carriers, shares);
    }
    else
        written = usual(clip, decoder.carriers, taps ? sharesOfAll(clip, usualShare) : TapShares{});
    HjifVoices& all = written.all;
    if (clip.bands.size() > all.clip.bands.size())
        losses.addShared(clip, clip.bands.size(), all.clip.bands.size());
    for (std::size_t i = 0; i < written.curves.size(); ++i)
        if (!written.curves[i].empty() && !all.clip.bands[i].amplitude.empty())
            losses.addThinned(all.clip.bands[i].amplitude, written.curves[i]);
    all.clip = withCurves(std::move(all.clip), std::move(written.curves));
    if (!taps)
        all.events = hjifEventsOf(all.clip);
    addMerged(losses, clip, all.events, events);
    return std::move(all);
}

} // namespace pacini
