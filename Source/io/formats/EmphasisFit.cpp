#include "io/formats/EmphasisFit.h"

#include "io/formats/LossList.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace pacini
{

namespace
{
constexpr double train = 0.06; // s: nearer events are a train for the decoder, see makePulse

double square(double x)
{
    return x * x;
}

/// The power of the player's oscillator over that of a sine of the same amplitude.
double powerOf(double sharpness)
{
    const double sine = 1.0 - sharpness;
    constexpr double both = 4.0 / std::numbers::pi; // twice the mean of |sin|
    return 2.0 * (0.5 * sine * sine + both * sine * sharpness + sharpness * sharpness);
}

double nearestGap(const std::vector<Transient>& events, std::size_t i)
{
    double gap = std::numeric_limits<double>::infinity();
    if (i > 0)
        gap = events[i].time - events[i - 1].time;
    if (i + 1 < events.size())
        gap = std::min(gap, events[i + 1].time - events[i].time);
    return gap;
}

/// The voice's power around a pulse from `start` on, in steps of 1 ms.
class VoicePower
{
public:
    VoicePower(const Curve& amplitude, double start, double seconds)
        : steps(static_cast<std::size_t>(std::max(1.0, std::round(seconds / step))))
    {
        const double first = start - (margin - 0.5) * step;
        const auto next = std::upper_bound(amplitude.begin(), amplitude.end(), first,
                                           [](double time, const Breakpoint& point) { return time < point.time; });
        // Not from the clip's start for each event.
        CurveReader reader({next == amplitude.begin() ? next : std::prev(next), amplitude.end()});
        for (std::size_t n = 0; n < steps + 2 * margin; ++n)
            power.push_back(square(std::min(reader.at(first + static_cast<double>(n) * step), 1.0)));
    }

    [[nodiscard]] double meanOfPulse() const
    {
        double sum = 0.0;
        for (std::size_t n = margin; n < margin + steps; ++n)
            sum += power[n];
        return sum / static_cast<double>(steps);
    }

    /// Mean deviation in dB where a pulse of `pulse` plays beside the ducked voice, as levels over 11 ms: skin does not
    /// resolve less.
    [[nodiscard]] double deviation(double pulse, double ducking) const
    {
        constexpr std::size_t half = 5;
        const double least = 1e-3 * *std::max_element(power.begin(), power.end());
        double sum = 0.0;
        std::size_t count = 0;
        for (std::size_t centre = half; centre + half < power.size(); ++centre, ++count)
        {
            double voice = 0.0, played = 0.0;
            for (std::size_t n = centre - half; n <= centre + half; ++n)
            {
                const bool inPulse = n >= margin && n < margin + steps;
                voice += power[n];
                played += inPulse ? square(ducking) * power[n] + pulse : power[n];
            }
            constexpr double width = 2 * half + 1;
            sum += std::abs(Decibels::fromPower((played / width + least) / (voice / width + least)).value);
        }
        return sum / static_cast<double>(count);
    }

private:
    static constexpr double step = 0.001;     // s
    static constexpr std::size_t margin = 10; // steps before and after
    std::size_t steps;
    std::vector<double> power;
};

/// Without those that the voice reaches by itself: played on top of it they hide the onset that is there already, which
/// cost up to 9 points of HTS in single sounds.
std::vector<Transient> playedOnTop(std::vector<Transient> events, const Curve& amplitude)
{
    std::erase_if(events, [](const Transient& event) { return event.amplitude <= 0.0; });
    for (Transient& event : events)
    {
        // Players must not show an event weaker than the voice around it.
        event.amplitude = std::max(event.amplitude, valueAt(amplitude, event.time));
    }
    return events;
}

/// Makes the sharpness of events that at which a player shows their frequency.
void fitSharpness(std::vector<Transient>& events, const NormalisedRange& range)
{
    for (Transient& event : events)
        event.sharpness = range.normalisedOf(100.0 * std::pow(2.8, event.sharpness));
}

/// `own`, or the sharpness at which an event is over in time where the next one is `gap` s away.
double sharpnessFor(const EmphasisPlayer& player, double own, double gap)
{
    return gap < train ? std::max(own, player.sharpnessOfLength(std::clamp(0.6 * gap, 0.006, 0.015))) : own;
}
} // namespace

double EmphasisPlayer::lengthOf(double sharpness) const noexcept
{
    if (periods > 0.0)
        return periods / range.hertzOf(sharpness);
    return dullLength + (crispLength - dullLength) * sharpness;
}

double EmphasisPlayer::sharpnessOfLength(double length) const noexcept
{
    if (periods > 0.0)
        return range.normalisedOf(periods / length);
    return std::clamp((dullLength - length) / (dullLength - crispLength), 0.0, 1.0);
}

std::vector<Transient> emphasesOf(std::vector<Transient> events, const Curve& amplitude, const EmphasisPlayer& player)
{
    fitSharpness(events, player.range);
    if (player.ducking == 1.0)
        return playedOnTop(std::move(events), amplitude);
    constexpr double noticeable = 1.5; // dB: the difference of levels from which on HTS counts
    std::vector<Transient> emphases;
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        Transient emphasis = events[i];
        const double gap = nearestGap(events, i);
        emphasis.sharpness = sharpnessFor(player, emphasis.sharpness, gap);
        const VoicePower voice(amplitude, emphasis.time, std::min(player.lengthOf(emphasis.sharpness), gap));
        const double beside = (1.0 - square(player.ducking)) * voice.meanOfPulse();
        if (events[i].amplitude <= 0.0 &&
            (beside < square(leastAmplitude) || voice.deviation(beside, player.ducking) > noticeable))
            continue;
        emphasis.amplitude =
            std::min(std::sqrt((square(events[i].amplitude) + beside) / powerOf(emphasis.sharpness)), 1.0);
        emphases.push_back(emphasis);
    }
    return emphases;
}

std::vector<std::size_t> separated(const std::vector<Transient>& events, double separation)
{
    std::vector<std::size_t> byStrength(events.size());
    std::iota(byStrength.begin(), byStrength.end(), std::size_t{0});
    std::stable_sort(byStrength.begin(), byStrength.end(),
                     [&](std::size_t a, std::size_t b) { return events[a].amplitude > events[b].amplitude; });
    std::vector<bool> isKept(events.size(), true);
    const auto isNear = [&](std::size_t a, std::size_t b)
    {
        return std::abs(events[a].time - events[b].time) < separation;
    };
    for (const std::size_t strong : byStrength)
    {
        if (!isKept[strong])
            continue;
        for (std::size_t i = strong; i-- > 0 && isNear(i, strong);)
            isKept[i] = false;
        for (std::size_t i = strong + 1; i < events.size() && isNear(i, strong); ++i)
            isKept[i] = false;
    }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < events.size(); ++i)
        if (isKept[i])
            kept.push_back(i);
    return kept;
}

std::vector<Transient> emphasisOfEach(std::vector<Transient> events, const std::vector<double>& beyond,
                                      const Curve& amplitude, const EmphasisPlayer& player)
{
    constexpr double comesBack = 0.010;   // s after a pulse in which a rise of the voice is felt as another event
    constexpr double sharpnessStep = 0.1; // finer ones gain nothing
    const double ducked = square(player.ducking);
    fitSharpness(events, player.range);
    std::vector<Transient> emphases;
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        const double gap = nearestGap(events, i);
        Transient emphasis = events[i];
        double least = -1.0; // none yet; in silence no deviation is a number
        for (double sharpness = sharpnessFor(player, events[i].sharpness, gap);;
             sharpness = std::min(sharpness + sharpnessStep, 1.0))
        {
            const double length = std::min(player.lengthOf(sharpness), gap);
            const VoicePower voice(amplitude, events[i].time, length);
            const double mean = voice.meanOfPulse();
            const double after = VoicePower(amplitude, events[i].time + length, comesBack).meanOfPulse();
            const double pulse = std::max((1.0 - ducked) * mean, after - ducked * mean);
            if (const double deviation = voice.deviation(pulse, player.ducking); least < 0.0 || deviation < least)
            {
                least = std::isfinite(deviation) ? deviation : 0.0;
                const double wave = player.periods > 0.0 ? 1.0 : powerOf(sharpness);
                emphasis.sharpness = sharpness;
                emphasis.amplitude = std::clamp(std::sqrt((square(beyond[i]) + pulse) / wave), leastAmplitude, 1.0);
            }
            if (sharpness >= 1.0)
                break;
        }
        emphases.push_back(emphasis);
    }
    return emphases;
}

} // namespace pacini
