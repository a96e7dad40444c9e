#include "linearize/QuickSweep.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/linearize/LevelAnalysis.h>
#include <pacini/linearize/SimulatedRig.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
RecordedChannels analysedNoise(std::size_t frames, double rate, double amplitude)
{
    Random random(21);
    RecordedChannels recording{rate, {std::vector<double>(frames)}};
    for (double& v : recording.channels[0])
        v = amplitude * random.uniform(-1.0, 1.0);
    return recording;
}

NoisyPower analysedPower(double power, double noise)
{
    NoisyPower out;
    for (int k = 1; k <= 400; ++k)
    {
        out.frequency.push_back(5.0 * k);
        out.power.push_back(power);
        out.noise.push_back(noise);
    }
    return out;
}
} // namespace

TEST_CASE("The noise spectrum of white noise is its power, of nothing 0", "[linearize]")
{
    const auto recording = analysedNoise(40000, 1000.0, 0.3);
    const std::pair<double, double> spans[] = {{0.0, 15.0}, {20.0, 40.0}};
    const NoiseSpectrum spectrum(recording, 0, spans);
    double mean = 0.0;
    for (int f = 10; f < 490; f += 10)
        mean += spectrum.at(f) / 48.0;
    CHECK(mean == Approx(0.09 / 3.0).epsilon(0.03));
    std::vector<double> values;
    for (const double f : {0.0, 1.0, 3.9, 5.0, 100.3, 250.0, 499.0, 500.0, 900.0})
        values.push_back(spectrum.at(f));
    checkPinned("linearize/noise spectrum", values, 1e-6);
    // half of a second: 256 frames; below the third bin and from the last but one on it is that bin's
    CHECK(spectrum.at(0.0) == spectrum.at(2.0 * 1000.0 / 256.0));
    CHECK(spectrum.at(900.0) == spectrum.at(127.0 * 1000.0 / 256.0));

    // the length of the longest span, if that is shorter
    const std::pair<double, double> shorter[] = {{1.0, 1.02}, {2.0, 2.0645}, {3.0, 3.1}, {5.0, 4.0}};
    const NoiseSpectrum coarse(recording, 0, shorter);
    std::vector<double> short_;
    for (const double f : {10.0, 60.0, 100.0, 211.0, 400.0})
        short_.push_back(coarse.at(f));
    checkPinned("linearize/noise spectrum of short spans", short_, 1e-6);
    const std::pair<double, double> tiny[] = {{1.0, 1.0159}};
    CHECK(NoiseSpectrum(recording, 0, tiny).at(100.0) == 0.0);
    const std::pair<double, double> least[] = {{1.0, 1.016001}};
    CHECK(NoiseSpectrum(recording, 0, least).at(100.0) > 0.0);
    CHECK(NoiseSpectrum(recording, 0, {}).at(100.0) == 0.0);
}

TEST_CASE("The noise spectrum of a sinusoid lies in its bin", "[linearize]")
{
    RecordedChannels recording{1024.0, {{}, {}}};
    recording.channels[0].assign(2000, 0.0);
    for (int i = 0; i < 2000; ++i)
        recording.channels[1].push_back(std::cos(2.0 * std::numbers::pi * 100.0 * i / 1024.0));
    const std::pair<double, double> spans[] = {{0.1, 1.8}};
    const NoiseSpectrum spectrum(recording, 1, spans);
    // 512 samples, bins of 2 Hz; |FFT|^2 of a Hann window is (n / 4)^2, its energy 3 n / 8
    CHECK(spectrum.at(100.0) == Approx(512.0 / 6.0).epsilon(1e-3));
    CHECK(spectrum.at(98.0) == Approx(512.0 / 24.0).epsilon(1e-3));
    CHECK(spectrum.at(99.0) == Approx(0.5 * (512.0 / 6.0 + 512.0 / 24.0)).epsilon(1e-3));
    CHECK(spectrum.at(300.0) == Approx(0.0).margin(1e-6));
    CHECK(NoiseSpectrum(recording, 0, spans).at(100.0) == 0.0);
}

TEST_CASE("The windows of the orders do not meet, and end with the reverberation", "[linearize]")
{
    const double growth = 4.0;
    for (const double reverberation : {0.05, 0.5, 2.0, 100.0})
        for (int order = 2; order <= 9; ++order)
        {
            CAPTURE(order, reverberation);
            const auto window = harmonicWindow(order, growth, reverberation);
            const double arrival = -growth * std::log(order);
            const double before = std::min(0.3 * growth * std::log((order + 1.0) / order), reverberation);
            const double after = std::min(0.65 * growth * std::log(order / (order - 1.0)), reverberation);
            CHECK(window.begin == Approx(arrival - before));
            CHECK(window.flatBegin == Approx(arrival - 0.3 * before));
            CHECK(window.flatEnd == Approx(arrival + 0.6 * after));
            CHECK(window.end == Approx(arrival + after));
            const auto next = harmonicWindow(order + 1, growth, reverberation);
            CHECK(next.end < window.begin);
        }
    const auto linear = linearWindow(4.0, 100.0);
    CHECK(linear.begin == Approx(-1.2 * std::numbers::ln2));
    CHECK(linear.flatBegin == Approx(-0.6 * std::numbers::ln2));
    CHECK(linear.flatEnd == Approx(70.0));
    CHECK(linear.end == Approx(100.0));
    CHECK(linearWindow(4.0, 0.2).begin == Approx(-0.2));
}

TEST_CASE("The inverse of the endless sweep is 0 below half of its lowest frequency and above the highest",
          "[linearize]")
{
    const ExponentialSweep sweep(20.0, 400.0, 2.0, 0.0, 0.0);
    const auto inverse = endlessSweepInverse(1001, sweep, 2000.0, 0.013, 700.0); // bins of 1 Hz
    for (std::size_t k = 0; k < 1001; ++k)
    {
        const double f = static_cast<double>(k);
        const auto wanted = k < 10 || k > 700 ? std::complex<double>() : endlessSweepInverse(f, sweep, 2000.0, 0.013);
        CHECK(inverse.re[k] == Approx(wanted.real()).margin(1e-15));
        CHECK(inverse.im[k] == Approx(wanted.imag()).margin(1e-15));
    }
    CHECK(std::abs(endlessSweepInverse(50.0, sweep, 2000.0, 0.0)) ==
          Approx(2.0 / 2000.0 * std::sqrt(50.0 / (2.0 / std::log(20.0)))));
}

TEST_CASE("Powers of channels add up", "[linearize]")
{
    NoisyPower sum;
    sum.add(analysedPower(2.0, 0.5));
    CHECK(sum.frequency.size() == 400);
    CHECK(sum.power[7] == 2.0);
    sum.add(analysedPower(3.0, 0.25));
    CHECK(sum.power == std::vector<double>(400, 5.0));
    CHECK(sum.noise == std::vector<double>(400, 0.75));
    CHECK(sum.frequency == analysedPower(0.0, 0.0).frequency);
}

TEST_CASE("The power of a cut is that of its spectrum up to the highest frequency", "[linearize]")
{
    ResponseCut cut;
    for (int i = 0; i < 37; ++i)
        cut.samples.push_back(std::sin(0.9 * i) * std::exp(-0.1 * i));
    cut.windowEnergy = 7.0;
    const auto power = detail::cutPower(cut, 1000.0, 200.0, [](double f) { return 2.0 * f; });
    // at least 74 samples: 75 have factors up to 5 only, an even number 80
    const double perBin = power.frequency[0];
    CHECK(perBin <= 1000.0 / 74.0);
    REQUIRE(power.power.size() == power.frequency.size());
    REQUIRE(power.noise.size() == power.frequency.size());
    CHECK(power.frequency.back() > 200.0);
    CHECK(power.frequency[power.frequency.size() - 2] <= 200.0);
    for (std::size_t k = 0; k < power.power.size(); ++k)
    {
        CHECK(power.frequency[k] == Approx(perBin * static_cast<double>(k + 1)));
        CHECK(power.power[k] ==
              Approx(std::norm(test::spectrumAt<double>(cut.samples, power.frequency[k], 1000.0))).margin(1e-9));
        CHECK(power.noise[k] == Approx(14.0 * power.frequency[k]));
    }
    const auto all = detail::cutPower(cut, 1000.0, 9000.0, [](double) { return 0.0; });
    CHECK(all.frequency.back() == Approx(500.0));
}

TEST_CASE("Levels are those of the signal, without the noise that is expected in them", "[linearize]")
{
    const std::vector<double> frequency{50.0, 100.0, 400.0, 900.0};
    LevelResponses responses;
    responses.linear = {analysedPower(5.0, 0.5), analysedPower(3.0, 0.5)};
    // at the drive played, -20 dB, the fundamental is 0.07
    responses.harmonics = {{analysedPower(0.004, 0.0005), analysedPower(0.001, 0.0005)},
                           {analysedPower(0.0011, 0.0003), analysedPower(0.0, 0.0)}};
    const auto level = summariseLevel(responses, -20.0, frequency, 1.0 / 6.0, 1800.0);
    CHECK(level.level == -20.0);
    CHECK(level.response.frequency == frequency);
    CHECK(level.noise.frequency == frequency);
    CHECK(level.snr.frequency == frequency);
    const double harmonic2 = 0.004 / 0.07, harmonic3 = 0.0008 / 0.07;
    REQUIRE(level.harmonics.size() == 2);
    CHECK(level.harmonics[0].order == 2);
    CHECK(level.harmonics[1].order == 3);
    CHECK(level.harmonics[0].response.frequency == frequency); // 1800 Hz belongs to it
    CHECK(level.harmonics[1].response.frequency == std::vector<double>{50.0, 100.0, 400.0});
    for (std::size_t k = 0; k < 4; ++k)
    {
        CHECK(level.response.level[k] == Approx(10.0 * std::log10(7.0)));
        CHECK(level.noise.level[k] == Approx(0.0).margin(1e-9));
        CHECK(level.snr.level[k] == Approx(10.0 * std::log10(7.0)));
        CHECK(level.harmonics[0].response.level[k] == Approx(10.0 * std::log10(harmonic2)));
    }
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(level.harmonics[1].response.level[k] == Approx(10.0 * std::log10(harmonic3)));
    // The second harmonic is five times its noise and counts, the third less than four times.
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(level.distortion[k] == Approx(100.0 * std::sqrt(harmonic2)));
    responses.harmonics[1][0].noise.assign(400, 0.00027);
    CHECK(summariseLevel(responses, -20.0, frequency, 1.0 / 6.0, 1800.0).distortion[0] ==
          Approx(100.0 * std::sqrt(harmonic2 + 0.00083 / 0.07)));
    CHECK(summariseLevel(responses, -20.0, frequency, 1.0 / 6.0, 1800.0).distortion[3] ==
          Approx(100.0 * std::sqrt(harmonic2)));

    // The harmonic of a frequency is taken at its multiple.
    for (std::size_t k = 0; k < 400; ++k)
        responses.harmonics[1][0].power[k] = 1e-4 * responses.harmonics[1][0].frequency[k];
    responses.harmonics[1][0].noise.assign(400, 0.0);
    const auto sloped = summariseLevel(responses, -20.0, frequency, 0.0, 1800.0);
    CHECK(sloped.harmonics[1].response.level[0] == Approx(10.0 * std::log10(0.015 / 0.07)));
    CHECK(sloped.harmonics[1].response.level[2] == Approx(10.0 * std::log10(0.12 / 0.07)));

    // Where all is noise a tenth is left; digital silence is -300 dB.
    responses.linear = {analysedPower(2.0, 1.99)};
    responses.harmonics = {{analysedPower(0.5, 0.6)}};
    const auto noisy = summariseLevel(responses, 0.0, frequency, 1.0 / 6.0, 1800.0);
    CHECK(noisy.response.level[1] == Approx(10.0 * std::log10(0.2)));
    CHECK(noisy.harmonics[0].response.level[1] == Approx(10.0 * std::log10(0.05 / 0.2)));
    CHECK(noisy.distortion[1] == 0.0);
    responses.linear = {analysedPower(0.0, 0.0)};
    responses.harmonics = {{analysedPower(0.0, 0.0)}};
    const auto silent = summariseLevel(responses, 0.0, frequency, 1.0 / 6.0, 1800.0);
    CHECK(silent.response.level[0] == Approx(-300.0));
    CHECK(silent.noise.level[0] == Approx(-300.0));
    CHECK(silent.snr.level[0] == Approx(0.0).margin(1e-9));
    CHECK(silent.harmonics[0].response.level[0] == Approx(-300.0));
    CHECK(silent.distortion[0] == 0.0);
}

TEST_CASE("The responses of a level are those that they were, channel by channel and order by order", "[linearize]")
{
    SweepParams params = test::quickSweep(1.0, 0.25, {-3.0, -9.0});
    params.lowFrequency = 30.0;
    params.highFrequency = 600.0;
    params.markerDuration = 0.0;
    params.repeats = 2;
    RigParams rig = test::quickRig(4.0, 1e-4);
    rig.axes = 2;
    rig.polynomial = {0.0, 1.0, 0.1, 0.08};
    RecordedChannels recording{4000.0, {}};
    for (const auto& channel : recordOnRig(makeSweepSignal(params).value(), rig))
    {
        recording.channels.emplace_back(channel.begin(), channel.end());
        for (double& v : recording.channels.back())
            v *= 4.0;
    }
    const auto schedule = makeSweepSchedule(params);
    SweepTiming timing;
    timing.start = rig.latency;
    timing.drift = 50e-6;
    const auto quiet = quietTimes(params, schedule, timing, recording.seconds());
    std::vector<NoiseSpectrum> noise;
    for (std::size_t c = 0; c < 2; ++c)
        noise.emplace_back(recording, c, quiet);
    for (const std::size_t level : {0u, 1u})
    {
        const auto responses = analyseLevel(recording, params, schedule, timing, noise, level, 3, 1800.0);
        REQUIRE(responses.linear.size() == 2);
        REQUIRE(responses.impulses.size() == 2);
        REQUIRE(responses.harmonics.size() == 2);
        REQUIRE(responses.harmonics[0].size() == 2);
        const std::string at = "linearize/level " + std::to_string(level) + ", ";
        for (std::size_t c = 0; c < 2; ++c)
        {
            const std::string of = at + "channel " + std::to_string(c) + ", ";
            checkPinned(of + "power", responses.linear[c].power, 1e-5);
            checkPinned(of + "noise", responses.linear[c].noise, 1e-4);
            checkPinned(of + "frequency", responses.linear[c].frequency);
            checkPinned(of + "impulse", responses.impulses[c].samples, 1e-5);
            checkPinned(of + "lag and energy",
                        {static_cast<double>(responses.impulses[c].firstLag), responses.impulses[c].windowEnergy});
            for (std::size_t order = 0; order < 2; ++order)
            {
                const auto& harmonic = responses.harmonics[order][c];
                checkPinned(of + "power of order " + std::to_string(order + 2), harmonic.power, 1e-4);
                checkPinned(of + "noise of order " + std::to_string(order + 2), harmonic.noise, 1e-4);
            }
        }
    }
    const auto plain = analyseLevel(recording, params, schedule, timing, noise, 0, 1, 600.0);
    CHECK(plain.harmonics.empty());
    CHECK(plain.impulses[0].samples.size() > 100);
    checkPinned("linearize/level without harmonics", plain.linear[0].power, 1e-5);
}
