#include "io/formats/hjif/HjifEvents.h"

#include "io/formats/hjif/HjifFormat.h"

#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pacini
{

double hjifLevelAt(const Clip& clip, double time)
{
    double power = 0.0;
    for (const Band& band : clip.bands)
        power += std::pow(valueAt(band.amplitude, time), 2.0);
    return std::sqrt(power);
}

double hjifHighestLevel(const Clip& clip)
{
    double highest = 0.0;
    for (const Band& band : clip.bands)
        for (const Breakpoint& point : band.amplitude)
            highest = std::max(highest, point.value);
    return highest;
}

namespace
{
/// Correlation of the pulse of an event that stands alone with the Transient of the reference player that begins with
/// it: sines under a window and without one.
double overlap(double sharpness)
{
    constexpr double tau = 2.0 * std::numbers::pi;
    const double frequency = 100.0 * std::pow(2.8, sharpness), length = 2.0 / frequency;
    const auto sineIntegral = [length](double omega)
    {
        return std::abs(omega) * length < 1e-6 ? length : std::sin(omega * length) / omega;
    };
    const auto underWindow = [&](double omega)
    {
        return 0.5 * sineIntegral(omega) -
               0.25 * (sineIntegral(omega + tau / length) + sineIntegral(omega - tau / length));
    };
    const double pulse = tau * frequency, tap = 2.0 * tau / hjifTransientLength;
    const double product = 0.5 * (underWindow(pulse - tap) - underWindow(pulse + tap));
    return product * hjifTransientLevel(sharpness) / (3.0 / 16.0 * length);
}
} // namespace

double hjifTogether(const Transient& tap, double wave)
{
    const double power =
        tap.amplitude * tap.amplitude + 2.0 * overlap(tap.sharpness) * tap.amplitude * wave + wave * wave;
    return std::sqrt(std::max(power, 0.0));
}

std::vector<HjifEvent> hjifEventsOf(const Clip& clip)
{
    constexpr double dull = 0.2;   // its pulse has 123 Hz
    constexpr double train = 0.06; // s: from here on the decoder's pulses are short
    constexpr double tapBesideWave = 0.5;
    constexpr double fine = 1e6; // Hz: the pulse as if continuous
    std::vector<HjifEvent> events;
    for (std::size_t i = 0; i < clip.transients.size(); ++i)
    {
        const Transient& event = clip.transients[i];
        double gap = limits::duration;
        if (i > 0)
            gap = event.time - clip.transients[i - 1].time;
        if (i + 1 < clip.transients.size())
            gap = std::min(gap, clip.transients[i + 1].time - event.time);
        const double level = hjifTransientLevel(event.sharpness);
        const bool covered = level * event.amplitude < 0.1 * hjifLevelAt(clip, event.time);
        HjifEvent& told = events.emplace_back();
        told.inTrain = gap < train && !covered;
        if (covered || (!told.inTrain && event.sharpness <= dull))
        {
            told.tap = level * event.amplitude;
            continue;
        }
        const Pulse pulse = makePulse({}, event.sharpness, gap, fine, 1.0);
        told.frequency = std::round(pulse.cyclesPerFrame * fine);
        told.length = static_cast<double>(pulse.frames) / fine;
        told.tap = told.inTrain ? 0.0 : tapBesideWave * level * event.amplitude;
        // Both together have the power of the pulse (see hjifTogether).
        const double shared = tapBesideWave * overlap(event.sharpness);
        const double wave = std::sqrt(shared * shared + 1.0 - tapBesideWave * tapBesideWave) - shared;
        told.wave = told.inTrain ? event.amplitude : wave * event.amplitude;
    }
    return events;
}

} // namespace pacini
