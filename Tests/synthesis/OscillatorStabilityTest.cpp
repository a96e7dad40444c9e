#include "support/Catch.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/CarrierBank.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
using Number = long double;
constexpr double day = 86400.0; // s
constexpr std::size_t windowFrames = 4096;

/// Sums a frequency curve frame by frame, in closed form: cycles modulo 1. The clip may run at any rate and pitch.
class ExactPhase
{
public:
    ExactPhase(const Curve& frequencyCurve, Number start) : curve(frequencyCurve), phase(start) {}

    void follow(Number newRate, Number newPitch)
    {
        rate = newRate;
        pitch = newPitch;
    }

    void advance(std::int64_t frames)
    {
        while (frames > 0)
        {
            while (next < curve.size() && Number(curve[next].time) <= clip)
                ++next;
            std::int64_t n = frames;
            Number value = Number(curve.back().value), slope = 0;
            if (next == 0)
                value = Number(curve.front().value);
            if (next < curve.size())
                n = std::clamp<std::int64_t>(
                    static_cast<std::int64_t>(std::ceil((Number(curve[next].time) - clip) / rate)), 1, frames);
            if (next > 0 && next < curve.size())
            {
                const auto& a = curve[next - 1];
                const auto& b = curve[next];
                slope = (Number(b.value) - Number(a.value)) / (Number(b.time) - Number(a.time));
                value = Number(a.value) + slope * (clip - Number(a.time));
            }
            const auto count = static_cast<Number>(n);
            phase += pitch * (value * count + slope * rate * count * (count - 1) / 2);
            phase -= std::floor(phase);
            clip += rate * count;
            frames -= n;
        }
    }

    [[nodiscard]] Number cycles() const { return phase; }

private:
    const Curve& curve;
    Number phase, clip = 0, rate = 1, pitch = 1;
    std::size_t next = 0;
};

/// What a window of the bank's output is beside the ideal one.
struct WindowError
{
    double phase = 0.0;     ///< cycles
    double amplitude = 0.0; ///< relative
    double noise = 0.0;     ///< dB: what is not the sinusoid, whatever its amplitude and phase
};

/// Plays the next frames and compares them with exp(2 pi i phi); `ideal` ends where the bank does.
WindowError compareWindow(CarrierBank& bank, ExactPhase& ideal, double amplitude)
{
    std::vector<double> re(windowFrames, 0.0), im(windowFrames, 0.0);
    for (std::size_t done = 0; done < windowFrames; done += 64) // the decoder's hop
        bank.process(std::span(re).subspan(done, 64), std::span(im).subspan(done, 64));
    std::vector<std::complex<Number>> turned(windowFrames);
    std::complex<Number> mean = 0;
    for (std::size_t n = 0; n < windowFrames; ++n)
    {
        const Number angle = -2 * std::numbers::pi_v<Number> * ideal.cycles();
        turned[n] =
            std::complex<Number>(Number(re[n]), Number(im[n])) * std::complex<Number>(std::cos(angle), std::sin(angle));
        mean += turned[n] / static_cast<Number>(windowFrames);
        ideal.advance(1);
    }
    Number noise = 0;
    for (const auto& z : turned)
        noise += std::norm(z - mean) / static_cast<Number>(windowFrames);
    return {static_cast<double>(std::arg(mean) / (2 * std::numbers::pi_v<Number>)),
            static_cast<double>(std::abs(mean)) / amplitude - 1.0,
            static_cast<double>(10 * std::log10(noise / std::norm(mean) + Number(1e-40)))};
}

void check(const WindowError& error)
{
    CHECK(std::abs(error.phase) <= 1e-6);
    CHECK(std::abs(error.amplitude) <= 1e-5);
    CHECK(error.noise <= -120.0);
}

/// Loud for 4096 frames every hour, silent between: the carrier goes on in its usual pieces without being computed.
Curve loudEveryHour(double fs)
{
    Curve amplitude{{0.0, 0.0}};
    for (int hour = 1; hour <= 24; ++hour)
    {
        const double begin = hour * 3600.0 * fs;
        const double end = begin + static_cast<double>(windowFrames);
        for (const Breakpoint& point : {Breakpoint{begin, 0.0}, {begin, 0.5}, {end, 0.5}, {end, 0.0}})
            amplitude.push_back(point);
    }
    return amplitude;
}
} // namespace

TEST_CASE("A steady sinusoid keeps its phase over 24 hours played in hops at 48 kHz", "[synthesis][stability]")
{
    const double fs = 48000.0;
    const double hertz = 997.3;
    const Curve frequency{{0.0, hertz / fs}};
    CarrierBank bank({{loudEveryHour(fs), frequency, 0.2}});
    // The frequency asked for, not the double next to it.
    const Number perFrame = Number(hertz) / Number(fs);
    std::vector<double> re(1 << 16), im(1 << 16);
    std::int64_t played = 0;
    for (int hour = 1; hour <= 24; ++hour)
    {
        const auto begin = static_cast<std::int64_t>(hour * 3600.0 * fs);
        for (; played < begin; played += std::min<std::int64_t>(1 << 16, begin - played))
        {
            const auto n = static_cast<std::size_t>(std::min<std::int64_t>(1 << 16, begin - played));
            bank.process(std::span(re).first(n), std::span(im).first(n));
        }
        const Number cycles = Number(0.2) + perFrame * static_cast<Number>(played);
        ExactPhase ideal(frequency, cycles - std::floor(cycles));
        CAPTURE(hour);
        check(compareWindow(bank, ideal, 0.5));
        played += static_cast<std::int64_t>(windowFrames);
    }
    CHECK(std::all_of(im.begin(), im.end(), [](double v) { return v == 0.0; }));
}

TEST_CASE("Gliding sinusoids with many breakpoints keep their phase over 24 hours", "[synthesis][stability]")
{
    Random random(21);
    for (const double fs : {4000.0, 8000.0, 48000.0, 192000.0})
        for (const double longestSegment : {0.5, 3600.0}) // s
        {
            CAPTURE(fs, longestSegment);
            Curve frequency;
            for (double t = 0.0; t < day; t += random.uniform(1e-3, longestSegment))
                frequency.push_back({t * fs, random.uniform(20.0, 1000.0) / fs});
            CarrierBank bank({{{{0.0, 0.7}}, frequency, 0.1}});
            ExactPhase ideal(frequency, 0.1L);
            const auto part = static_cast<std::int64_t>(day * fs / 12.0) - static_cast<std::int64_t>(windowFrames);
            for (int i = 0; i < 12; ++i)
            {
                bank.skip(part);
                ideal.advance(part);
                check(compareWindow(bank, ideal, 0.7));
            }
        }
}

TEST_CASE("Sinusoids keep their phase over 24 hours of changes of speed and pitch", "[synthesis][stability]")
{
    Random random(22);
    for (const double fs : {4000.0, 48000.0})
        for (const bool glides : {false, true})
        {
            CAPTURE(fs, glides);
            Curve frequency{{0.0, 150.0 / fs}};
            if (glides)
                for (double t = 1.0; t < 2.0 * day; t += random.uniform(0.01, 20.0))
                    frequency.push_back({t * fs, random.uniform(20.0, 400.0) / fs});
            CarrierBank bank({{{{0.0, 1.0}}, frequency, 0.0}});
            ExactPhase ideal(frequency, 0.0L);
            PlayClock clock;
            std::int64_t frame = 0;
            int changes = 0;
            while (static_cast<double>(frame) < day * fs)
            {
                const auto at = static_cast<double>(frame);
                const double rate = random.uniform(0.5, 2.0);
                const double pitch = random.uniform(0.5, 2.0);
                clock.change(at, rate, pitch);
                clock.forgetBefore(at);
                bank.follow(clock.pieceAt(at));
                ideal.follow(Number(rate), Number(pitch));
                const auto hold = static_cast<std::int64_t>(random.uniform(0.1, 60.0) * fs);
                bank.skip(hold);
                ideal.advance(hold);
                frame += hold;
                if (++changes % 100 == 0)
                {
                    check(compareWindow(bank, ideal, 1.0));
                    frame += static_cast<std::int64_t>(windowFrames);
                }
            }
            CHECK(changes > 2000);
        }
}

TEST_CASE("Breakpoints from 1 ms to 1 h apart are joined to 2e-7 of their range", "[synthesis][stability]")
{
    for (const double fs : {8000.0, 48000.0, 192000.0})
        for (const double seconds : {0.001, 0.0123, 0.5, 60.0, 3600.0})
            for (const double start : {0.0, 0.7, day - 1.0})
                for (const double level : {0.0, 0.9})
                {
                    CAPTURE(fs, seconds, start, level);
                    const double range = 0.1;
                    const Curve curve{{0.0, level},
                                      {start * fs, level},
                                      {(start + seconds) * fs, level + range},
                                      {(start + 2.0 * seconds) * fs, level}};
                    // At 0 Hz and a quarter of a cycle the sine is the amplitude.
                    CarrierBank bank({{curve, {{0.0, 0.0}}, 0.25}});
                    CurveReader reader(curve);
                    const auto first = static_cast<std::int64_t>(start * fs);
                    const auto last = static_cast<std::int64_t>((start + 2.0 * seconds) * fs) + 64;
                    const std::int64_t step = std::max<std::int64_t>(0, (last - first) / 200 - 64);
                    bank.skip(first);
                    double worst = 0.0;
                    for (std::int64_t at = first; at < last; at += step)
                    {
                        std::vector<double> re(64, 0.0), im(64, 0.0);
                        bank.process(re, im);
                        for (const double v : im)
                        {
                            const auto frame = static_cast<double>(at);
                            // Seconds, as the breakpoints were asked for.
                            const Number t = Number(frame) / Number(fs) - Number(start);
                            const Number rise = std::max(Number(0), Number(1) - std::abs(t / Number(seconds) - 1));
                            const Number right = Number(level) + (t > 0 ? rise : Number(0)) * Number(range);
                            worst = std::max(worst, static_cast<double>(std::abs(Number(v) - right)));
                            worst = std::max(worst, static_cast<double>(std::abs(Number(reader.at(frame)) - right)));
                            worst =
                                std::max(worst, static_cast<double>(std::abs(Number(valueAt(curve, frame)) - right)));
                            ++at;
                        }
                        bank.skip(step);
                    }
                    CHECK(worst <= 2e-7 * range);
                }
}
