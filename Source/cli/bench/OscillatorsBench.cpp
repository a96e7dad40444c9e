#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"

#include <pacini/synthesis/CarrierBank.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr double oscillatorRate = 4000.0;     // Hz, the decoder's lowest inner rate
constexpr std::size_t windowFrames = 1 << 14; // at the end of each duration
constexpr double low = 100.1, high = 200.7;   // Hz; a glide takes one second from one to the other
constexpr auto second = static_cast<std::int64_t>(oscillatorRate);

/// Frequency at a frame and its step there, cycles per frame.
struct Motion
{
    bool glides = false;

    [[nodiscard]] double frequency(std::int64_t frame) const noexcept
    {
        if (!glides)
            return low / oscillatorRate;
        const auto into = static_cast<double>(frame % second) / oscillatorRate;
        return (frame / second % 2 == 0 ? low + (high - low) * into : high - (high - low) * into) / oscillatorRate;
    }
    [[nodiscard]] double step(std::int64_t frame) const noexcept
    {
        return !glides ? 0.0 : (frame / second % 2 == 0 ? high - low : low - high) / (oscillatorRate * oscillatorRate);
    }
    /// Cycles at a frame, modulo 1: the sum of all frequencies before it.
    [[nodiscard]] long double cycles(std::int64_t frame) const noexcept
    {
        const long double from = low, rise = glides ? static_cast<long double>(high) - from : 0.0L;
        const long double rate = oscillatorRate;
        const auto whole = static_cast<long double>(frame / second);
        const auto n = static_cast<long double>(frame % second);
        const bool down = frame / second % 2 == 1;
        // A second upwards sums to rate from + rise (rate - 1) / 2, one downwards to `rise` more.
        const long double seconds =
            whole * from * rate + rise * (whole * (rate - 1.0L) / 2.0L + std::floor(whole / 2.0L));
        const long double start = down ? from + rise : from;
        const long double slope = (down ? -rise : rise) / rate;
        const long double sum = (seconds + start * n + slope * n * (n - 1.0L) / 2.0L) / rate;
        return sum - std::floor(sum);
    }
    [[nodiscard]] Curve curve(std::int64_t frames) const
    {
        Curve points{{0.0, low / oscillatorRate}};
        if (glides)
            for (std::int64_t k = 1; k <= frames / second + 1; ++k)
                points.push_back({static_cast<double>(k * second), (k % 2 == 1 ? high : low) / oscillatorRate});
        return points;
    }
};

template <typename T>
T wrapped(T cycles) noexcept
{
    return cycles >= T(1) ? cycles - T(1) : cycles;
}

/// Adds the frequency up in T, frame by frame.
template <typename T>
struct Accumulator
{
    explicit Accumulator(Motion motionToFollow, std::int64_t) : motion(motionToFollow) {}
    Motion motion;
    std::int64_t frame = 0;
    T phase = 0;

    /// visit(phase) at each of the next frames.
    template <typename Visit>
    void forEach(std::int64_t frames, Visit&& visit)
    {
        while (frames > 0)
        {
            const std::int64_t n = std::min(frames, second - frame % second);
            auto f = static_cast<T>(motion.frequency(frame));
            const auto step = static_cast<T>(motion.step(frame));
            for (std::int64_t i = 0; i < n; ++i)
            {
                visit(phase);
                phase = wrapped(phase + f);
                f += step;
            }
            frame += n;
            frames -= n;
        }
    }
    void skip(std::int64_t frames)
    {
        forEach(frames, [](T) {});
    }
};

template <typename T>
struct AccumulatorAndSine : Accumulator<T>
{
    using Accumulator<T>::Accumulator;
    void play(std::span<double> out)
    {
        auto* at = out.data();
        this->forEach(static_cast<std::int64_t>(out.size()), [&at](T cycles)
                      { *at++ = static_cast<double>(std::sin(T(2) * std::numbers::pi_v<T> * cycles)); });
    }
};

/// 4096 sines, straight lines between them.
struct AccumulatorAndTable : Accumulator<double>
{
    AccumulatorAndTable(Motion motionToFollow, std::int64_t frames) : Accumulator(motionToFollow, frames)
    {
        for (std::size_t i = 0; i < sines.size(); ++i)
            sines[i] = std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size));
    }
    void play(std::span<double> out)
    {
        auto* at = out.data();
        forEach(static_cast<std::int64_t>(out.size()),
                [this, &at](double cycles)
                {
                    const double place = cycles * static_cast<double>(size);
                    const auto i = static_cast<std::size_t>(place);
                    *at++ = sines[i] + (sines[i + 1] - sines[i]) * (place - static_cast<double>(i));
                });
    }

private:
    static constexpr std::size_t size = 4096;
    std::array<double, size + 2> sines{};
};

/// Turns a unit vector by the frequency, and that by its step, and never looks back.
template <typename T>
struct Rotation
{
    Rotation(Motion motionToFollow, std::int64_t) : motion(motionToFollow) {}
    Motion motion;
    std::int64_t frame = 0;
    T re = 1, im = 0;

    template <typename Visit>
    void forEach(std::int64_t frames, Visit&& visit)
    {
        while (frames > 0)
        {
            const std::int64_t n = std::min(frames, second - frame % second);
            const auto turn = std::polar(1.0, 2.0 * std::numbers::pi * motion.frequency(frame));
            const auto bend = std::polar(1.0, 2.0 * std::numbers::pi * motion.step(frame));
            auto wr = static_cast<T>(turn.real()), wi = static_cast<T>(turn.imag());
            const auto dr = static_cast<T>(bend.real()), di = static_cast<T>(bend.imag());
            for (std::int64_t i = 0; i < n; ++i)
            {
                visit(im);
                const T next = re * wr - im * wi;
                im = re * wi + im * wr;
                re = next;
                if (motion.glides)
                {
                    const T turned = wr * dr - wi * di;
                    wi = wr * di + wi * dr;
                    wr = turned;
                }
            }
            frame += n;
            frames -= n;
        }
    }
    void skip(std::int64_t frames)
    {
        forEach(frames, [](T) {});
    }
    void play(std::span<double> out)
    {
        auto* at = out.data();
        forEach(static_cast<std::int64_t>(out.size()), [&at](T sine) { *at++ = static_cast<double>(sine); });
    }
};

/// Pacini's. Silent until the window: its phase then goes on in the same pieces, but no sines are made.
struct Bank
{
    Bank(Motion motion, std::int64_t frames)
        : bank({{{{0.0, 0.0}, {static_cast<double>(frames), 0.0}, {static_cast<double>(frames), 1.0}},
                 motion.curve(frames + static_cast<std::int64_t>(windowFrames)),
                 0.0}}),
          unused(windowFrames)
    {
    }
    CarrierBank bank;
    std::vector<double> unused;

    void skip(std::int64_t frames)
    {
        for (std::int64_t done = 0; done < frames;)
        {
            const auto n = std::min<std::int64_t>(frames - done, static_cast<std::int64_t>(windowFrames));
            const auto part = std::span(unused).first(static_cast<std::size_t>(n));
            bank.process(part, part);
            done += n;
        }
    }
    void play(std::span<double> out)
    {
        std::fill(out.begin(), out.end(), 0.0);
        bank.process(unused, out);
    }
};

/// The window after `frames`, and the time that it took.
template <typename Oscillator>
Timed<std::vector<double>> play(Motion motion, std::int64_t frames, int repeats)
{
    Oscillator played(motion, frames);
    played.skip(frames);
    Timed<std::vector<double>> best{{}, std::numeric_limits<double>::infinity()};
    for (int i = 0; i < repeats; ++i)
    {
        Oscillator copy = played;
        auto window = timed(1,
                            [&copy]
                            {
                                std::vector<double> out(windowFrames);
                                copy.play(out);
                                return out;
                            });
        if (window.seconds < best.seconds)
            best = std::move(window);
    }
    return best;
}

struct OscillatorForm
{
    const char* name;
    Timed<std::vector<double>> (*play)(Motion motion, std::int64_t frames, int repeats);
};

constexpr std::array oscillatorForms = {
    OscillatorForm{"carrier bank", play<Bank>},
    OscillatorForm{"accumulator and sine", play<AccumulatorAndSine<double>>},
    OscillatorForm{"accumulator and sine, float", play<AccumulatorAndSine<float>>},
    OscillatorForm{"accumulator and table", play<AccumulatorAndTable>},
    OscillatorForm{"rotation", play<Rotation<double>>},
    OscillatorForm{"rotation, float", play<Rotation<float>>},
};

/// Fit of a window by a sin(2 pi (phi + error)) + noise.
struct WindowError
{
    double phase, amplitude, noise, whole;
};

WindowError errorOf(std::span<const double> found, Motion motion, std::int64_t first)
{
    using Number = long double;
    std::vector<Number> sines(found.size()), cosines(found.size());
    Number ss = 0, sc = 0, cc = 0, ys = 0, yc = 0, difference = 0;
    for (std::size_t n = 0; n < found.size(); ++n)
    {
        const Number angle = 2 * std::numbers::pi_v<Number> * motion.cycles(first + static_cast<std::int64_t>(n));
        const Number y = static_cast<Number>(found[n]);
        sines[n] = std::sin(angle);
        cosines[n] = std::cos(angle);
        ss += sines[n] * sines[n];
        sc += sines[n] * cosines[n];
        cc += cosines[n] * cosines[n];
        ys += y * sines[n];
        yc += y * cosines[n];
        difference += (y - sines[n]) * (y - sines[n]);
    }
    // Least squares.
    const Number determinant = ss * cc - sc * sc;
    const Number a = (ys * cc - yc * sc) / determinant;
    const Number b = (yc * ss - ys * sc) / determinant;
    Number noise = 0;
    for (std::size_t n = 0; n < found.size(); ++n)
        noise += std::pow(static_cast<Number>(found[n]) - a * sines[n] - b * cosines[n], Number(2));
    return {static_cast<double>(std::abs(std::atan2(b, a)) / (2 * std::numbers::pi_v<Number>)),
            static_cast<double>(std::abs(std::hypot(a, b) - 1)),
            static_cast<double>(10 * std::log10(noise / ((a * a + b * b) * ss) + Number(1e-40))),
            static_cast<double>(100 * std::sqrt(difference / ss))};
}

struct Span
{
    const char* name;
    std::int64_t seconds;
};

void measureOscillators(const BenchSound&, const BenchSettings& settings, BenchTable& rows)
{
    for (const bool glides : {false, true})
        for (const Span& span : {Span{"1 s", 1}, Span{"1 h", 3600}, Span{"24 h", 86400}})
            for (const OscillatorForm& form : oscillatorForms)
            {
                const Motion motion{glides};
                const std::int64_t frames = span.seconds * second;
                const auto played = form.play(motion, frames, settings.repeats);
                const WindowError error = errorOf(played.result, motion, frames);
                const auto cell = [](double value) -> BenchCell
                {
                    if (std::isfinite(value))
                        return value;
                    return {}; // the output has no bounds
                };
                rows.add({"one sinusoid", glides ? "gliding" : "steady", span.name, form.name,
                          static_cast<double>(windowFrames), played.seconds, cell(error.whole), cell(error.phase),
                          cell(error.amplitude), cell(error.noise)});
            }
}
} // namespace

Bench oscillatorsBench()
{
    const auto figure = [](const char* name, const char* pitch)
    {
        return BenchFigure{
            name, fmt::format("Oscillators over a day, {}", pitch), "form", "time", "error", "after", "pitch", pitch};
    };
    return {
        "oscillators",
        "Oscillators over a day",
        "One sinusoid at 4 kHz, steady at 100.1 Hz or gliding to 200.7 Hz and back in two seconds, in the 4 s after "
        "the time in the third column, which every form has played frame by frame. The error is the RMS "
        "difference from sines of the phase summed in closed form in long double; phase, amplitude and noise are "
        "those of the sinusoid that fits best and of what it leaves. The carrier bank makes a cosine as well.",
        columnsOf({"pitch", "after", "form"}, {summed("frames"),
                                               summed("seconds", "s"),
                                               {"error", "%"},
                                               {"phase", "cycles"},
                                               {"amplitude", ""},
                                               {"noise", "dB"},
                                               {"time", "ns/frame", Reduction::ratio, "seconds", "frames", 1e9},
                                               {"relativeTime", "", Reduction::relative, "time", "pitch"}}),
        {figure("steady", "steady"), figure("gliding", "gliding")},
        {},
        measureOscillators,
        false};
}

} // namespace pacini::cli
