#pragma once

// Carrier of one band: a sinusoid of the band's own strength and pitch.

#include <pacini/filters/DesignLimits.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/realtime/ControlHop.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

namespace pacini
{

/// Level and pitch tracker of one band. Listens to one band. The band is cut out by Linkwitz-Riley slopes of fourth
/// order at its edges, as in FilterBank but without the all-passes of the other bands, which only a sum of bands needs
/// and which would delay it. Of the band's samples x and their differences d, taken half-way between two frames, a tone
/// of w radians per frame has
///
///     mean of ((x + x') / 2)^2 = A^2 cos^2(w / 2) / 2,   mean of d^2 = 4 A^2 sin^2(w / 2) / 2
///
/// so that tan^2(w / 2) is a quarter of the ratio of the two: the power-weighted RMS frequency of the band, exact for
/// a tone wherever it lies in the band (90 Hz come out as 90 Hz). Both means ripple at twice the frequency, oppositely:
/// with the right w their weighted sum is A^2 without any ripple, over as little as a hop.
class BandListener
{
public:
    /// Real-time safe; silence follows.
    void design(Hertz low, Hertz high, double fs) noexcept
    {
        lower = StateVariableLoop::design(clampedFrequency(low, fs), std::numbers::sqrt2, fs);
        upper = StateVariableLoop::design(clampedFrequency(high, fs), std::numbers::sqrt2, fs);
        const double turn = std::numbers::pi / fs;
        centre = std::sqrt(low.value * high.value) * turn;
        lowest = std::tan(std::min(0.6 * low.value * turn, 1.4));
        highest = std::tan(std::min(1.6 * high.value * turn, 1.5));
        // A sixth of the band's frequency, at most 40 Hz: the ripple of the means stays below 1 %.
        const double corner = std::clamp(std::sqrt(low.value * high.value) / 6.0, 8.0, 40.0);
        pitchShare = hopShare(1.0 / (2.0 * std::numbers::pi * corner), fs);
        reset();
    }

    void reset() noexcept
    {
        states = {};
        before = mean = difference = means = differences = 0.0;
        slow = {};
        tangent = std::tan(centre);
    }

    void process(std::span<const double> in) noexcept
    {
        for (const double x : in)
        {
            double band = states[0].tick(lower, x).high;
            band = states[1].tick(lower, band).high;
            band = states[2].tick(upper, band).low;
            band = states[3].tick(upper, band).low;
            mean = 0.5 * (band + before);
            difference = band - before;
            before = band;
            means += mean * mean;
            differences += difference * difference;
        }
    }

    /// Measurements of a whole hop.
    struct Heard
    {
        double power = 0.0;     ///< A^2
        double frequency = 0.0; ///< cycles per frame
        double sine = 0.0;      ///< A sin and A cos of the band's phase at its newest frames
        double cosine = 0.0;
    };

    /// Ends a hop and returns its measurements.
    [[nodiscard]] Heard hear() noexcept
    {
        slow[0] += pitchShare * (means - slow[0]);
        slow[1] += pitchShare * (slow[0] - slow[1]);
        slow[2] += pitchShare * (differences - slow[2]);
        slow[3] += pitchShare * (slow[2] - slow[3]);
        if (slow[1] > 1e-24)
            tangent = std::clamp(0.5 * std::sqrt(slow[3] / slow[1]), lowest, highest);
        const double square = tangent * tangent;
        const double power = (means + 0.25 * differences / square) * (1.0 + square) / static_cast<double>(controlHop);
        means = differences = 0.0;
        return {power, std::atan(tangent) / std::numbers::pi, mean, 0.5 * difference / tangent};
    }

    void flush() noexcept
    {
        for (StateVariableState& state : states)
            state.flush();
        for (double& average : slow)
            flushTiny(average);
    }

private:
    StateVariableLoop lower, upper;
    double centre = 0.1;
    double lowest = 0.0, highest = 1.0; // tan(w / 2)
    double pitchShare = 1.0;
    std::array<StateVariableState, 4> states{};
    double before = 0.0;
    double mean = 0.0, difference = 0.0;   // of the two newest frames
    double means = 0.0, differences = 0.0; // sums of squares over the hop
    std::array<double, 4> slow{};
    double tangent = 0.1;
};

/// A sinusoid whose amplitude moves along smooth curves and whose phase never jumps while it sounds.
class CarrierOscillator
{
public:
    CarrierOscillator() noexcept { reset(); }

    void reset() noexcept
    {
        re = 1.0;
        im = 0.0;
        sinceEvent = 0.0;
        turnTo(1.0, 0.0);
        amplitude.jump(0.0);
    }

    /// Starts a hop: the amplitude moves by the fraction `share` of the distance to `target`. The pitch moves to
    /// `frequency` (cycles per frame, below 0.5) within the hop, from silence at once.
    void aim(double target, double share, double frequency) noexcept
    {
        const bool begins = amplitude.silent();
        amplitude.aim(target, share);
        if (amplitude.silent())
        {
            waitForLevel();
            return;
        }
        const double wanted = 2.0 * std::numbers::pi * frequency;
        const double from = begins ? wanted : angle;
        if (const double frames = std::exchange(sinceEvent, 0.0); frames > 0.0)
            beginAgain(frames * from, begins);
        turnCosine.aim(1.0, turnShare);
        turnSine.aim(0.0, turnShare);
        turning = turnSine.start() != 0.0 || turnCosine.start() != 1.0;
        const double bend = (wanted - from) / static_cast<double>(controlHop);
        angle = wanted;
        stepRe = std::cos(from);
        stepIm = std::sin(from);
        bendRe = std::cos(bend);
        bendIm = std::sin(bend);
        const double norm = 1.5 - 0.5 * (re * re + im * im); // rounding must not let it grow or shrink
        re *= norm;
        im *= norm;
    }

    /// Before aim(): an event was `frames` frames before the coming hop, more than 0. The sinusoid crosses over, within
    /// about 20 ms, to a sine that began with the event, or begins as that, so that its phase afterwards depends on the
    /// sound and not on what was before: an event feels the same each time.
    void noteEvent(double frames) noexcept { sinceEvent = frames; }

    /// While it is silent: begins at the phase of a sinusoid with this sine and cosine, of any amplitude, so that bands
    /// which share a tone begin together as the tone does.
    void begin(double sine, double cosine) noexcept
    {
        const double size = std::hypot(sine, cosine);
        if (!(size > 1e-12))
            return;
        re = cosine / size;
        im = sine / size;
        turnTo(1.0, 0.0);
    }

    /// For a silent voice: continues from the phase of another voice, so that a hand-over between two voices of one
    /// pitch does not cancel.
    void follow(const CarrierOscillator& other) noexcept
    {
        re = other.re;
        im = other.im;
        turnTo(other.turnCosine.end(), other.turnSine.end());
    }

    /// Returns the lag of its phase at the newest frame behind `phase`, -pi to pi.
    [[nodiscard]] double behind(double phase) const noexcept
    {
        const double sine = std::sin(phase), cosine = std::cos(phase);
        return std::atan2(sine * re - cosine * im, cosine * re + sine * im);
    }

    [[nodiscard]] bool silent() const noexcept { return amplitude.silent(); }
    [[nodiscard]] double level() const noexcept { return amplitude.end(); }

    /// Adds frames `at` and on of the hop.
    void addTo(std::span<double> out, std::size_t at) noexcept
    {
        for (std::size_t n = 0; n < out.size(); ++n)
        {
            const double step = stepRe * bendRe - stepIm * bendIm;
            stepIm = stepRe * bendIm + stepIm * bendRe;
            stepRe = step;
            const double next = re * stepRe - im * stepIm;
            im = re * stepIm + im * stepRe;
            re = next;
            const std::size_t i = at + n;
            out[n] += amplitude.at(i) * (turning ? im * turnCosine.at(i) + re * turnSine.at(i) : im);
        }
    }

private:
    static constexpr double turnShare = 0.2;     // of the way to the event's phase, in a hop
    static constexpr double longestWait = 300.0; // frames that an event counts for a sinusoid that is silent

    void turnTo(double cosine, double sine) noexcept
    {
        turnCosine.jump(cosine);
        turnSine.jump(sine);
    }

    void waitForLevel() noexcept
    {
        if (sinceEvent > 0.0)
            sinceEvent += static_cast<double>(controlHop);
        if (sinceEvent > longestWait)
            sinceEvent = 0.0;
    }

    /// The phasor goes to `phase` at once; the turn, which leads back to the one before, then fades.
    void beginAgain(double phase, bool silent) noexcept
    {
        const double cosine = std::cos(phase), sine = std::sin(phase);
        const double c = re * turnCosine.end() - im * turnSine.end();
        const double s = im * turnCosine.end() + re * turnSine.end();
        if (silent)
            turnTo(1.0, 0.0);
        else
            turnTo(c * cosine + s * sine, s * cosine - c * sine);
        re = cosine;
        im = sine;
    }

    double re = 1.0, im = 0.0;
    HopRamp turnCosine, turnSine; // of the phasor, from (re, im) to what is played
    bool turning = false;
    double sinceEvent = 0.0; // frames from an event to the coming hop; 0: none
    double angle = 0.0;      // of a frame, at the end of the hop
    double stepRe = 1.0, stepIm = 0.0;
    double bendRe = 1.0, bendIm = 0.0;
    HopCurve amplitude;
};

} // namespace pacini
