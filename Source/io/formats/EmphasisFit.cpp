#include "io/formats/EmphasisFit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

namespace pacini
{

namespace
{
constexpr const char* leftOut = "events are left out where the amplitude curve alone is as strong";

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
            sum += std::abs(10.0 * std::log10((played / width + least) / (voice / width + least)));
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
std::vector<Transient> playedOnTop(std::vector<Transient> events, const Curve& amplitude, const NormalisedRange& range,
                                   LossList& losses)
{
    for (Transient& event : events)
    {
        if (event.amplitude <= 0.0)
            losses.add(LossKind::event, event.time, 0.0, 0.0, leftOut);
        else // players must not show an event weaker than the voice around it
            event.amplitude = std::max(event.amplitude, valueAt(amplitude, event.time));
        event.sharpness = range.normalisedOf(100.0 * std::pow(2.8, event.sharpness));
    }
    std::erase_if(events, [](const Transient& event) { return event.amplitude <= 0.0; });
    return events;
}
} // namespace

std::vector<Transient> emphasesOf(std::vector<Transient> events, const Curve& amplitude, const EmphasisPlayer& player,
                                  LossList& losses)
{
    if (player.ducking == 1.0)
        return playedOnTop(std::move(events), amplitude, player.range, losses);
    constexpr double train = 0.06;     // s: nearer events are a train for the decoder, see makePulse
    constexpr double noticeable = 1.5; // dB: the difference of levels from which on HTS counts
    std::vector<Transient> emphases;
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        Transient emphasis = events[i];
        const double gap = nearestGap(events, i);
        emphasis.sharpness = player.range.normalisedOf(100.0 * std::pow(2.8, emphasis.sharpness));
        if (gap < train)
            emphasis.sharpness =
                std::max(emphasis.sharpness, player.sharpnessOfLength(std::clamp(0.6 * gap, 0.006, 0.015)));
        const VoicePower voice(amplitude, emphasis.time, std::min(player.lengthOf(emphasis.sharpness), gap));
        const double beside = (1.0 - square(player.ducking)) * voice.meanOfPulse();
        if (events[i].amplitude <= 0.0 &&
            (beside < square(leastAmplitude) || voice.deviation(beside, player.ducking) > noticeable))
        {
            losses.add(LossKind::event, emphasis.time, 0.0, 0.0, leftOut);
            continue;
        }
        emphasis.amplitude =
            std::min(std::sqrt((square(events[i].amplitude) + beside) / powerOf(emphasis.sharpness)), 1.0);
        emphases.push_back(emphasis);
    }
    return emphases;
}

} // namespace pacini
