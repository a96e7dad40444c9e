#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/CarrierBank.h>
#include <pacini/synthesis/Decoder.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace pacini::cli
{

namespace
{
constexpr double synthesisExcerpt = 10.0; // s of each sound
constexpr double outputRate = 8000.0;     // Hz, of the oscillators
using Signal = std::vector<double>;

double snr(const Signal& wanted, const Signal& found)
{
    double energy = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
        energy += wanted[i] * wanted[i];
        difference += (wanted[i] - found[i]) * (wanted[i] - found[i]);
    }
    return energy > 0.0 ? std::min(300.0, Decibels::fromPower(energy / std::max(difference, 1e-300)).value) : 300.0;
}

/// The sinusoids of a clip over frames of the output rate.
std::vector<Carrier> carriersOf(const Clip& clip)
{
    std::vector<Carrier> carriers;
    for (const Band& band : clip.bands)
    {
        if (band.amplitude.empty())
            continue;
        Carrier carrier;
        for (const Breakpoint& point : band.amplitude)
            carrier.amplitude.push_back({point.time * outputRate, point.value});
        for (const Breakpoint& point : band.pitch)
            carrier.frequency.push_back({point.time * outputRate, point.value / outputRate});
        if (carrier.frequency.empty())
            carrier.frequency.push_back({0.0, band.centreFrequency / outputRate});
        carriers.push_back(std::move(carrier));
    }
    return carriers;
}

/// Calls tone(frame, amplitude, frequency) for every frame of a carrier.
template <typename Tone>
void forEachFrame(const Carrier& carrier, std::size_t frames, Tone&& tone)
{
    CurveReader amplitude(carrier.amplitude);
    CurveReader frequency(carrier.frequency);
    for (std::size_t n = 0; n < frames; ++n)
        tone(n, amplitude.at(static_cast<double>(n)), frequency.at(static_cast<double>(n)));
}

/// The sine of an accumulated phase for every frame, in the precision of `Real`.
template <typename Real>
Signal sines(const std::vector<Carrier>& carriers, std::size_t frames)
{
    Signal signal(frames);
    for (const Carrier& carrier : carriers)
    {
        Real phase = 0; // cycles
        forEachFrame(carrier, frames,
                     [&](std::size_t n, double a, double f)
                     {
                         signal[n] += a * static_cast<double>(std::sin(2 * std::numbers::pi_v<Real> * phase));
                         phase += static_cast<Real>(f);
                         phase -= std::floor(phase);
                     });
    }
    return signal;
}

/// A complex number that rotates once per frame, by an angle that is updated every 64 frames.
template <typename Real>
Signal rotations(const std::vector<Carrier>& carriers, std::size_t frames)
{
    Signal signal(frames);
    for (const Carrier& carrier : carriers)
    {
        Real re = 1, im = 0, turnRe = 1, turnIm = 0;
        forEachFrame(carrier, frames,
                     [&](std::size_t n, double a, double f)
                     {
                         if (n % 64 == 0)
                         {
                             const Real angle = 2 * std::numbers::pi_v<Real> * static_cast<Real>(f);
                             turnRe = std::cos(angle);
                             turnIm = std::sin(angle);
                         }
                         signal[n] += a * static_cast<double>(im);
                         const Real next = re * turnRe - im * turnIm;
                         im = re * turnIm + im * turnRe;
                         re = next;
                     });
    }
    return signal;
}

/// The decoder's oscillators, in its blocks.
Signal carrierBank(CarrierBank& bank, std::size_t frames)
{
    Signal re(frames), im(frames);
    bank.reset();
    for (std::size_t i = 0; i < frames; i += 64)
    {
        const std::size_t n = std::min<std::size_t>(64, frames - i);
        bank.process(std::span(re).subspan(i, n), std::span(im).subspan(i, n));
    }
    return im;
}

Signal decoded(const Clip& clip, const DecoderParams& params)
{
    Decoder decoder(clip, params);
    std::vector<float> out(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(out);
    return Signal(out.begin(), out.end());
}

void measureSynthesis(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    const auto mono = sound.beginning(synthesisExcerpt);
    Encoder usual{EncoderParams{}};
    const Clip clip = encodePrecisely(usual, {sound.sampleRate, 1}, SoundParts(mono, 1)).value();
    EncoderParams manyPoints;
    manyPoints.breakpoints = 200.0;
    Encoder detailed(manyPoints);
    const auto carriers = carriersOf(encodePrecisely(detailed, {sound.sampleRate, 1}, SoundParts(mono, 1)).value());
    if (carriers.empty())
        return;
    const auto add =
        [&](const std::string& part, const std::string& variant, double rate, const Signal& wanted, auto&& work)
    {
        const auto run = timed(settings.repeats, work);
        const double ratio = snr(wanted, run.result);
        rows.add(
            {sound.name, part, variant, clip.duration, rate * clip.duration, run.seconds, ratio, errorShare(ratio)});
    };

    const auto frames = static_cast<std::size_t>(clip.duration * outputRate);
    const Signal exact = sines<long double>(carriers, frames);
    const double tones = outputRate * static_cast<double>(carriers.size());
    CarrierBank bank(carriers);
    add("oscillators", "carrier bank", tones, exact, [&] { return carrierBank(bank, frames); });
    add("oscillators", "sine, double", tones, exact, [&] { return sines<double>(carriers, frames); });
    add("oscillators", "sine, float", tones, exact, [&] { return sines<float>(carriers, frames); });
    add("oscillators", "rotation, double", tones, exact, [&] { return rotations<double>(carriers, frames); });
    add("oscillators", "rotation, float", tones, exact, [&] { return rotations<float>(carriers, frames); });

    DecoderParams fast;
    DecoderParams full;
    full.fullRate = true;
    const Signal best = decoded(clip, full);
    add("decoder at 48 kHz", "low inner rate", fast.sampleRate, best, [&] { return decoded(clip, fast); });
    add("decoder at 48 kHz", "full inner rate", full.sampleRate, best, [&] { return decoded(clip, full); });
    DecoderParams unlevelled;
    unlevelled.followEnvelope = false;
    add("decoder at 48 kHz", "low inner rate, not levelled", unlevelled.sampleRate, best,
        [&] { return decoded(clip, unlevelled); });
}
} // namespace

Bench synthesisBench()
{
    return {"synthesis",
            "Oscillators and decoder",
            "The sinusoids of the clip that the encoder makes of each sound (first 10 s): for the oscillators with up "
            "to 200 points per second and band, so that pitches move; for the decoder with the default settings. "
            "Oscillators at 8 kHz against "
            "sines of a phase accumulated in long double, time per frame and sinusoid; the decoder at 48 kHz against "
            "itself with its sinusoids computed at the full rate, time per frame.",
            columnsOf({"part", "variant"}, {summed("duration", "s"),
                                            summed("frames"),
                                            summed("seconds", "s"),
                                            {"snr", "dB"},
                                            {"error", "%"},
                                            {"time", "ns/frame", Reduction::ratio, "seconds", "frames", 1e9},
                                            {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                                            {"relativeTime", "", Reduction::relative, "time", "part"}}),
            {{"", "Oscillators", "variant", "time", "error", "variant", "part", "oscillators"}},
            {},
            measureSynthesis};
}

} // namespace pacini::cli
