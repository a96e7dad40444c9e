// The figures of a report on simulated rigs, whose truth is known by their equations of motion or in closed form.

#include "support/Catch.h"

#include <pacini/linearize/ActuatorFigures.h>
#include <pacini/linearize/ResponseSmoothing.h>
#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepAnalysis.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

using namespace pacini;

namespace
{
constexpr double rate = 16000.0; // Hz

SweepParams sweepOf(double level)
{
    SweepParams sweep;
    sweep.sampleRate = rate;
    sweep.duration = 6.0;
    sweep.levels = {level};
    return sweep;
}

SweepMeasurement measuredOn(const RigParams& rig, const SweepParams& sweep)
{
    MeasurementParams measurement;
    measurement.fullScale = {rig.range};
    const auto result =
        analyseSweeps(recordOnRig(makeSweepSignal(sweep).value(), rig), rig.sampleRate, sweep, measurement);
    REQUIRE(result.ok());
    return *result;
}

/// One recording of a rig, and what the report has of it.
struct Reported
{
    FrequencyResponse response;
    ActuatorFigures figures;
};

Reported reportOn(const RigParams& rig, double level = -6.0, std::optional<double> volts = {})
{
    const SweepMeasurement measured = measuredOn(rig, sweepOf(level));
    const auto average = averagePlacements(std::vector{measured.response()}).value();
    const SweepMeasurement* const placements[] = {&measured};
    const auto findings = findingsOf(placements, average, 1.0 / 12.0, 10.0).value();
    return {average.response, actuatorFigures(placements, average, findings, volts, true)};
}

/// An actuator on a device that moves freely.
RigParams freeRig(double f, double q)
{
    RigParams rig;
    rig.sampleRate = rate;
    rig.resonance = {f, q};
    rig.body = BodyParams{1.0, 0.012, 0.04, 1e9, 10.0, 1e-6, 0.0, 0.0};
    rig.range = 2.0 * standardGravity * std::max(1.0, q);
    rig.noiseDensity = rig.range * 20e-6;
    rig.bits = 0;
    return rig;
}

/// The level of a rig, the mean power over a twelfth of an octave as measurements have it.
double smoothLevel(const RigParams& rig, double f)
{
    double power = 0.0;
    for (int i = -8; i <= 8; ++i)
        power += Decibels(rigLevel(rig, f * std::exp2(i / (24.0 * 8.0)))).power() / 17.0;
    return Decibels::fromPower(power).value;
}

/// The largest level of a rig, and the frequencies around it at which it is `below` dB less.
struct TrueWidth
{
    double strongest = -1e300;
    double low = 0.0, high = 0.0;
};

TrueWidth widthOf(const RigParams& rig, double below)
{
    TrueWidth width;
    double peak = 0.0;
    for (double f = 20.0; f < 1000.0; f *= 1.001)
        if (const double level = smoothLevel(rig, f); level > width.strongest)
        {
            width.strongest = level;
            peak = f;
        }
    for (width.low = peak; smoothLevel(rig, width.low) > width.strongest - below;)
        width.low /= 1.001;
    for (width.high = peak; width.high < 1000.0 && smoothLevel(rig, width.high) > width.strongest - below;)
        width.high *= 1.001;
    return width;
}
} // namespace

TEST_CASE("Edges of a burst on a resonator are q ln 9 / (pi f), as in closed form", "[linearize]")
{
    for (const double f : {40.0, 67.0, 230.0})
        for (const double q : {5.0, 12.0, 30.0})
        {
            CAPTURE(f, q);
            const double tau = q / (std::numbers::pi * f);
            ImpulseResponse response{rate, 40, std::vector<double>(40, 0.0)};
            for (double t = 0.0; t < 20.0 * tau; t += 1.0 / rate)
                response.samples.push_back(std::exp(-t / tau) * std::sin(2.0 * std::numbers::pi * f * t));
            const auto edges = burstEdges(response, f);
            REQUIRE(edges);
            // Not exactly: the wave and its mirror at -f meet within a cycle.
            CHECK(edges->rise == Approx(tau * std::log(9.0)).epsilon(0.25 / q + 0.01));
            CHECK(edges->fall == Approx(tau * std::log(9.0)).epsilon(0.25 / q + 0.01));
        }
    CHECK_FALSE(burstEdges({8000.0, 0, {}}, 67.0));
    CHECK_FALSE(burstEdges({8000.0, 0, {1.0}}, 5000.0));
}

TEST_CASE("The bandwidth of a band-pass is that of its half powers, in closed form", "[linearize]")
{
    for (const double q : {0.7, 2.0, 10.0})
    {
        CAPTURE(q);
        FrequencyResponse response;
        response.frequency = logSpaced(20.0, 1000.0, 400);
        for (const double f : response.frequency)
        {
            const double x = q * (f / 100.0 - 100.0 / f);
            response.level.push_back(7.0 - 10.0 * std::log10(1.0 + x * x));
        }
        const Bandwidth width = bandwidthOf(response, 10.0 * std::log10(2.0));
        const double half = 0.5 / q;
        CHECK(width.range.low == Approx(100.0 * (std::sqrt(1.0 + half * half) - half)).epsilon(0.003));
        CHECK(width.range.high == Approx(100.0 * (std::sqrt(1.0 + half * half) + half)).epsilon(0.003));
        CHECK_FALSE(width.lowOpen);
        CHECK_FALSE(width.highOpen);
        const Bandwidth all = bandwidthOf(response, 100.0);
        CHECK(all.lowOpen);
        CHECK(all.highOpen);
        CHECK(all.range == FrequencyRange{response.frequency.front(), response.frequency.back()});
    }
}

TEST_CASE("Figures of a measured actuator are those of its equations of motion", "[linearize]")
{
    for (const auto& [f, q] : {std::pair{67.0, 8.0}, std::pair{150.0, 15.0}, std::pair{90.0, 5.0}})
    {
        CAPTURE(f, q);
        const RigParams rig = freeRig(f, q);
        const double share = 0.012 / 0.040001;
        const double f0 = f * std::sqrt(1.0 + share);
        const double q0 = q / std::sqrt(1.0 + share);
        const auto figures = reportOn(rig, -6.0, 2.5).figures;
        CHECK(figures.resonance.frequency == Approx(f0).epsilon(0.01));
        CHECK(figures.resonance.q == Approx(q0).epsilon(0.05));
        REQUIRE(figures.edges);
        const double edge = q0 * std::log(9.0) / (std::numbers::pi * f0);
        CHECK(figures.edges->rise == Approx(edge).epsilon(0.1));
        CHECK(figures.edges->fall == Approx(edge).epsilon(0.1));
        const TrueWidth width3 = widthOf(rig, 3.0);
        const TrueWidth width10 = widthOf(rig, 10.0);
        CHECK(Decibels::fromGain(figures.strongest.value()).value == Approx(width3.strongest).margin(0.3));
        CHECK(*figures.perVolt == Approx(*figures.strongest / 2.5));
        CHECK(figures.within3.range.low == Approx(width3.low).epsilon(0.02));
        CHECK(figures.within3.range.high == Approx(width3.high).epsilon(0.02));
        CHECK(figures.within10.range.low == Approx(width10.low).epsilon(0.02));
        CHECK(figures.within10.range.high == Approx(width10.high).epsilon(0.03));
        CHECK(figures.drive == -6.0);
        CHECK_FALSE(reportOn(rig).figures.perVolt);
    }
}

TEST_CASE("Distortion of a cubic amplifier is that of its Chebyshev polynomial", "[linearize]")
{
    for (const double cube : {0.05, 0.2, -0.1})
    {
        CAPTURE(cube);
        RigParams rig;
        rig.sampleRate = rate;
        rig.body.reset();
        rig.polynomial = {0.0, 1.0, 0.0, cube};
        rig.range = 4.0;
        rig.noiseDensity = 1e-6;
        rig.bits = 0;
        rig.axes = 1;
        const double level = -3.0;
        const SweepMeasurement measured = measuredOn(rig, sweepOf(level));
        const double a = Decibels(level).gain();
        const double expected = 100.0 * std::abs(0.25 * cube * a * a / (1.0 + 0.75 * cube * a * a));
        MeasurementFindings findings; // a flat response has no resonance
        findings.features.resonance.frequency = 120.0;
        const auto average = averagePlacements(std::vector{measured.response()}).value();
        const SweepMeasurement* const placements[] = {&measured};
        const auto figures = actuatorFigures(placements, average, findings, {}, true);
        CHECK(figures.distortionAtResonance == Approx(expected).epsilon(0.02));
    }
}

TEST_CASE("Twice the noise of the sensor is 6 dB more of it in the report", "[linearize]")
{
    RigParams rig = freeRig(80.0, 6.0);
    rig.noiseDensity = 2e-3;
    const auto quiet = reportOn(rig).figures;
    rig.noiseDensity *= 2.0;
    const auto loud = reportOn(rig).figures;
    CHECK(quiet.noiseAtResonance - loud.noiseAtResonance == Approx(6.02).margin(1.0));
    CHECK(quiet.noiseAtWorst - loud.noiseAtWorst == Approx(6.02).margin(1.5));
    CHECK(quiet.noiseAtWorst <= quiet.noiseAtResonance);
    CHECK(reportOn(rig, -16.0).figures.noiseAtResonance == Approx(loud.noiseAtResonance - 10.0).margin(1.0));
}

TEST_CASE("The drop with a mass is that of the equations of motion", "[linearize]")
{
    for (const double mass : {0.02, 0.1})
    {
        CAPTURE(mass);
        const RigParams free = freeRig(80.0, 6.0);
        RigParams heavy = free;
        heavy.body->deviceMass += mass;
        const Reported one = reportOn(free);
        const Reported other = reportOn(heavy);
        const auto drop = wornDrop(one.figures, one.response, other.response, 1.0 / 12.0);
        REQUIRE(drop);
        const double f = one.figures.resonance.frequency;
        CHECK(drop->atResonance == Approx(rigLevel(free, f) - rigLevel(heavy, f)).margin(0.6));
        CHECK(drop->atStrongest == Approx(widthOf(free, 3.0).strongest - widthOf(heavy, 3.0).strongest).margin(0.5));
        CHECK(drop->atStrongest > 2.0);
        const double share = 0.012 / (heavy.body->deviceMass + 1e-6);
        CHECK(drop->resonance.frequency == Approx(80.0 * std::sqrt(1.0 + share)).epsilon(0.015));
        double mean = 0.0;
        const FrequencyRange range = one.figures.within10.range;
        for (int i = 0; i <= 200; ++i)
        {
            const double at = range.low * std::pow(range.high / range.low, i / 200.0);
            mean += (rigLevel(free, at) - rigLevel(heavy, at)) / 201.0;
        }
        CHECK(drop->mean == Approx(mean).margin(0.5));
    }
}
