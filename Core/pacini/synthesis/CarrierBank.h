#pragma once

// Additive synthesis: the sum of a clip's sinusoids as an analytic signal, at the decoder's inner rate.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Portable.h>
#include <pacini/synthesis/PlayClock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// One sinusoid: amplitude and frequency as curves over the frames of the clip at the inner rate.
struct Carrier
{
    Curve amplitude;    ///< time in frames, linear amplitude
    Curve frequency;    ///< time in frames, cycles per frame; never empty
    double phase = 0.0; ///< cycles at frame 0
};

/// Oscillator bank. Sums sinusoids a(n) exp(2 pi i phi(n)), phi(n + 1) = phi(n) + f(n), where a and f are linear
/// between breakpoints (Weber 2020, Eq. 4.13 with accumulated phase). Between two breakpoints the phase is a quadratic,
/// so samples follow from two complex products each (a chirp recursion) instead of sine and cosine; it is restarted
/// from the exact phase every 256 frames, which keeps the error below 1e-12, and the phase itself is carried in cycles
/// modulo 1, so that 24 hours lose nothing. Four neighbouring samples run side by side to fill vector registers.
class CarrierBank
{
public:
    CarrierBank() = default;
    explicit CarrierBank(std::vector<Carrier> carriersToPlay) : carriers(std::move(carriersToPlay)) { reset(); }

    void reset() noexcept
    {
        states.resize(carriers.size()); // no allocation after the first call
        for (std::size_t i = 0; i < carriers.size(); ++i)
            states[i] = {carriers[i].phase, 0, 0};
        frame = 0;
        clock = {};
    }

    /// From the next frame on, clip and pitch go by `piece`, whose clip frames must not lie before those played.
    /// Frequencies that end above 0.45 cycles per frame stay there. [audio]
    void follow(const ClockPiece& piece) noexcept { clock = piece; }

    /// Adds the next re.size() frames of every carrier to re (cosines) and im (sines). [audio]
    void process(std::span<double> re, std::span<double> im) noexcept
    {
        const auto frames = static_cast<std::int64_t>(re.size());
        for (std::size_t i = 0; i < carriers.size(); ++i)
        {
            std::int64_t done = 0;
            while (done < frames)
            {
                const std::int64_t from = frame + done;
                const Segment segment = segmentAt(carriers[i], states[i], from);
                const std::int64_t boundary = (from / restart + 1) * restart;
                const std::int64_t end = std::min({segment.end, boundary, frame + frames});
                const auto length = static_cast<std::size_t>(end - from);
                run(segment, states[i], length, re.data() + done, im.data() + done);
                done += static_cast<std::int64_t>(length);
            }
        }
        frame += frames;
    }

    /// Skips `frames` without output. The time depends on the number of breakpoints, not of frames.
    void skip(std::int64_t frames) noexcept
    {
        for (std::size_t i = 0; i < carriers.size(); ++i)
            for (std::int64_t done = 0; done < frames;)
            {
                const Segment segment = segmentAt(carriers[i], states[i], frame + done);
                const std::int64_t length = std::min(segment.end - frame, frames) - done;
                advancePhase(segment, states[i], static_cast<double>(length));
                done += length;
            }
        frame += frames;
    }

private:
    static constexpr std::int64_t restart = 256; // frames
    static constexpr std::size_t lanes = 4;
    static constexpr double highest = 0.45; // cycles per frame

    struct State
    {
        double phase = 0.0;            // cycles, modulo 1, at the next frame
        std::size_t nextAmplitude = 0; // first breakpoint after the current frame
        std::size_t nextFrequency = 0;
    };

    /// Straight pieces of both curves from the current frame on.
    struct Segment
    {
        double amplitude = 0.0;
        double amplitudeStep = 0.0;
        double frequency = 0.0;
        double frequencyStep = 0.0;
        std::int64_t end = 0; // first frame that needs another segment
    };

    struct Piece
    {
        double value = 0.0;
        double step = 0.0;
        std::int64_t end = 0;
    };

    [[nodiscard]] Piece pieceAt(const Curve& curve, std::size_t& next, std::int64_t at) const noexcept
    {
        constexpr auto forever = std::numeric_limits<std::int64_t>::max();
        const double t = clock.clipAt(static_cast<double>(at));
        while (next < curve.size() && curve[next].time <= t)
            ++next;
        if (curve.empty())
            return {0.0, 0.0, forever};
        if (next == curve.size())
            return {curve.back().value, 0.0, forever};
        const double reached = std::ceil(std::min(clock.frameOf(curve[next].time), 9e18));
        const auto end = std::max(at + 1, static_cast<std::int64_t>(reached));
        if (next == 0)
            return {curve.front().value, 0.0, end};
        const Breakpoint& a = curve[next - 1];
        const Breakpoint& b = curve[next];
        const double slope = (b.value - a.value) / (b.time - a.time);
        return {a.value + slope * (t - a.time), slope * clock.rate, end};
    }

    Segment segmentAt(const Carrier& carrier, State& state, std::int64_t at) const noexcept
    {
        const Piece a = pieceAt(carrier.amplitude, state.nextAmplitude, at);
        const Piece f = pieceAt(carrier.frequency, state.nextFrequency, at);
        Segment segment{a.value, a.step, f.value, f.step, std::min(a.end, f.end)};
        if (clock.pitch != 1.0)
        {
            segment.frequency *= clock.pitch;
            segment.frequencyStep *= clock.pitch;
            const double length = static_cast<double>(std::min(segment.end - at, restart));
            if (std::max(segment.frequency, segment.frequency + segment.frequencyStep * length) > highest)
            {
                segment.frequency = std::min(segment.frequency, highest);
                segment.frequencyStep = 0.0;
            }
        }
        return segment;
    }

    /// The phase `n` frames on: sum of the frequencies until then, modulo one cycle.
    static void advancePhase(const Segment& s, State& state, double n) noexcept
    {
        const double advanced = state.phase + s.frequency * n + 0.5 * s.frequencyStep * n * (n - 1.0);
        state.phase = advanced - std::floor(advanced);
    }

    /// Without the checks for infinities of operator*, which cost more than the product.
    static std::complex<double> product(std::complex<double> a, std::complex<double> b) noexcept
    {
        return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }

    static void run(const Segment& s, State& state, std::size_t length, double* re, double* im) noexcept
    {
        const double start = state.phase;
        advancePhase(s, state, static_cast<double>(length));
        if (s.amplitude == 0.0 && s.amplitudeStep == 0.0)
            return;

        // phi(m) = start + f m + d m (m - 1) / 2. Four samples side by side: lane m starts at phi(m), its next sample
        // is four frames on, 4 f + d (4 m + 6) further, and each step of four turns by 16 d more than the one before.
        using Complex = std::complex<double>;
        const Complex w = portable::turnBy(s.frequency);
        Complex d = 1.0;
        if (s.frequencyStep != 0.0)
            d = portable::turnBy(s.frequencyStep);
        const Complex d2 = product(d, d);
        const Complex d4 = product(d2, d2);
        const Complex d16 = product(product(d4, d4), product(d4, d4));
        const Complex w2 = product(w, w);
        Complex z = portable::turnBy(start);
        Complex step = product(product(w2, w2), product(d4, d2));
        Complex toNext = w;
        std::array<double, lanes> zr, zi, rr, ri, a;
        for (std::size_t k = 0; k < lanes; ++k)
        {
            zr[k] = z.real();
            zi[k] = z.imag();
            rr[k] = step.real();
            ri[k] = step.imag();
            a[k] = s.amplitude + s.amplitudeStep * static_cast<double>(k);
            z = product(z, toNext);
            toNext = product(toNext, d);
            step = product(step, d4);
        }
        const double qr = d16.real();
        const double qi = d16.imag();
        const double rise = s.amplitudeStep * static_cast<double>(lanes);

        std::size_t i = 0;
        const auto advance = [&](bool bends)
        {
            for (; i + lanes <= length; i += lanes)
                for (std::size_t k = 0; k < lanes; ++k)
                {
                    re[i + k] += a[k] * zr[k];
                    im[i + k] += a[k] * zi[k];
                    const double nextR = zr[k] * rr[k] - zi[k] * ri[k];
                    zi[k] = zr[k] * ri[k] + zi[k] * rr[k];
                    zr[k] = nextR;
                    a[k] += rise;
                    if (bends)
                    {
                        const double turnR = rr[k] * qr - ri[k] * qi;
                        ri[k] = rr[k] * qi + ri[k] * qr;
                        rr[k] = turnR;
                    }
                }
        };
        // Two loops, so that a steady pitch does not pay for a gliding one.
        if (s.frequencyStep == 0.0)
            advance(false);
        else
            advance(true);
        for (std::size_t k = 0; i < length; ++i, ++k)
        {
            re[i] += a[k] * zr[k];
            im[i] += a[k] * zi[k];
        }
    }

    std::vector<Carrier> carriers;
    std::vector<State> states;
    std::int64_t frame = 0;
    ClockPiece clock;
};

} // namespace pacini
