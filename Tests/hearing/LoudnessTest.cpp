#include "evaluate/SyntheticSignal.h"
#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/hearing/Loudness.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// What is heard of a whole sound.
struct HeardSound
{
    std::vector<double> total;
    std::vector<LoudnessPattern> patterns;
};

HeardSound loudnessOf(const std::vector<float>& pressure)
{
    HeardSound heard;
    const auto keep = [&](double total, const LoudnessPattern& pattern)
    {
        heard.total.push_back(total);
        heard.patterns.push_back(pattern);
    };
    LoudnessMeter meter;
    meter.process(pressure, keep);
    meter.finish(keep);
    return heard;
}

/// A sine of `hertz` at `level` dB SPL for `seconds`.
std::vector<float> loudnessTone(double hertz, double level, double seconds)
{
    std::vector<float> pressure(static_cast<std::size_t>(48000.0 * seconds));
    const double amplitude = std::numbers::sqrt2 * 20e-6 * std::pow(10.0, level / 20.0);
    for (std::size_t i = 0; i < pressure.size(); ++i)
        pressure[i] =
            static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * hertz * static_cast<double>(i) / 48000.0));
    return pressure;
}

/// Loudness of the steady part.
double steadyLoudness(double hertz, double level)
{
    return loudnessOf(loudnessTone(hertz, level, 0.8)).total.back();
}
} // namespace

TEST_CASE("Loudness over time is that of an independent implementation of ISO 532-1", "[loudness]")
{
    const auto file = test::golden("loudness");
    for (const auto& entry : file["cases"])
    {
        INFO(entry["name"].get<std::string>());
        const auto signal = test::syntheticSignal(entry["signal"]);
        const auto track = loudnessOf(std::vector<float>(signal.begin(), signal.end()));
        REQUIRE(track.total.size() == (signal.size() + 95) / 96);
        REQUIRE(track.patterns.size() == track.total.size());
        for (std::size_t i = 0; i < entry["at"].size(); ++i)
            CHECK(track.total[entry["at"][i].get<std::size_t>()] ==
                  Approx(entry["loudness"][i].get<double>()).epsilon(0.003).margin(0.007));
        // The reference takes ten points of each Bark, this the area.
        const auto& specific = track.patterns[entry["specific"]["at"].get<std::size_t>()].specific;
        const auto bark = entry["specific"]["bark"].get<std::vector<double>>();
        const double largest = *std::max_element(bark.begin(), bark.end());
        for (std::size_t k = 0; k < specific.size(); ++k)
            CHECK(specific[k] == Approx(bark[k]).margin(0.06 * largest));
    }
}

TEST_CASE("1 kHz at 40 dB is 1 sone, and 10 dB more twice as loud", "[loudness]")
{
    // The definition of the sone; the standard allows 5 %.
    CHECK(steadyLoudness(1000.0, 40.0) == Approx(1.0).epsilon(0.02));
    CHECK(steadyLoudness(1000.0, 50.0) == Approx(2.0).epsilon(0.05));
    CHECK(steadyLoudness(1000.0, 60.0) == Approx(4.0).epsilon(0.05));
    CHECK(steadyLoudness(1000.0, 80.0) == Approx(16.0).epsilon(0.05));
}

TEST_CASE("What lies below the threshold of hearing has no loudness", "[loudness]")
{
    CHECK(steadyLoudness(1000.0, 0.0) == 0.0);
    CHECK(steadyLoudness(50.0, 30.0) == 0.0);
    CHECK(steadyLoudness(50.0, 70.0) > 0.5);
    const auto silence = loudnessOf(std::vector<float>(4800));
    CHECK(std::all_of(silence.total.begin(), silence.total.end(), [](double sone) { return sone == 0.0; }));
    CHECK(silence.patterns.front().sharpness == 0.0);
    CHECK(loudnessOf({}).total.empty());
    CHECK(loudnessOf({}).patterns.empty());
}

TEST_CASE("A band of noise at 1 kHz has a sharpness of 1 acum, higher sounds more", "[loudness]")
{
    // DIN 45692: one critical band wide, 60 dB; here eight partials from 920 to 1080 Hz.
    std::vector<float> band(48000);
    for (int k = 0; k < 8; ++k)
    {
        const auto partial = loudnessTone(920.0 + 22.9 * k, 60.0 - 9.0, 1.0);
        for (std::size_t i = 0; i < band.size(); ++i)
            band[i] += partial[(i + 997u * static_cast<std::size_t>(k * k)) % band.size()];
    }
    CHECK(loudnessOf(band).patterns.back().sharpness == Approx(1.0).margin(0.06));
    const auto high = loudnessOf(loudnessTone(8000.0, 60.0, 0.5)).patterns.back();
    CHECK(high.sharpness > 3.0);
    const auto low = loudnessOf(loudnessTone(100.0, 70.0, 0.5)).patterns.back();
    CHECK(low.sharpness < 0.5);
    CHECK(low.specific[0] + low.specific[1] > 0.4 * low.total);
}

TEST_CASE("Specific loudness sums to loudness", "[loudness]")
{
    for (const double hertz : {30.0, 250.0, 1000.0, 4000.0, 12500.0})
    {
        const auto pattern = loudnessOf(loudnessTone(hertz, 75.0, 0.3)).patterns.back();
        double sum = 0.0;
        for (const double bark : pattern.specific)
            sum += bark;
        CHECK(sum == Approx(pattern.total).epsilon(1e-12));
        CHECK(pattern.total > 0.5);
    }
}

TEST_CASE("Loudness fades slower after a long sound than after a short one", "[loudness]")
{
    const auto left = [](double seconds)
    {
        auto pressure = loudnessTone(1000.0, 70.0, seconds);
        pressure.resize(pressure.size() + 4800);
        const auto track = loudnessOf(pressure);
        const auto end = static_cast<std::size_t>(seconds * LoudnessMeter::rate);
        double loudest = 0.0;
        for (const auto& pattern : track.patterns)
            loudest = std::max(loudest, pattern.total);
        return track.patterns[end + 12].total / loudest; // 24 ms after its end
    };
    CHECK(left(0.2) > 1.6 * left(0.005));
    CHECK(left(0.005) < 0.35);
    // The total is heard as shorter sounds being softer.
    const auto loudest = [](double seconds)
    {
        auto pressure = loudnessTone(1000.0, 70.0, seconds);
        pressure.resize(pressure.size() + 4800);
        const auto totals = loudnessOf(pressure).total;
        return *std::max_element(totals.begin(), totals.end());
    };
    CHECK(loudest(0.01) < 0.8 * loudest(0.1));
    CHECK(loudest(0.1) < loudest(1.0));
}

TEST_CASE("The total of a pattern is the same where nothing else of it is asked for", "[loudness]")
{
    for (int seed = 0; seed < 300; ++seed)
    {
        CoreLoudness core{};
        for (std::size_t band = 0; band + 1 < core.size(); ++band)
            core[band] =
                std::max(0.0, std::pow(10.0, std::sin(1.7 * seed + 2.3 * static_cast<double>(band * band))) - 0.5);
        CAPTURE(seed);
        CHECK(totalLoudness(core) == Approx(loudnessPattern(core).total).epsilon(1e-12));
    }
    CHECK(totalLoudness({}) == 0.0);
}

TEST_CASE("Loudness falls and rises between two sets as step after step of the circuit would", "[loudness]")
{
    // The circuit of ISO 532-1, 6.4, as two capacitors that every substep charges or discharges.
    for (const double rate : {1000.0, 2000.0})
    {
        const int substeps = rate < 2000.0 ? 12 : 24;
        const double step = 1.0 / (rate * substeps);
        const double p = (0.075 + 0.015) / (0.075 * 0.005);
        const double q = 1.0 / (0.075 * 0.005);
        const double l1 = -0.5 * p + std::sqrt(0.25 * p * p - q);
        const double l2 = -0.5 * p - std::sqrt(0.25 * p * p - q);
        const double den = 0.075 * (l1 - l2);
        const double e1 = std::exp(l1 * step);
        const double e2 = std::exp(l2 * step);
        const double b[] = {(e1 - e2) / den,
                            ((0.075 * l2 + 1.0) * e1 - (0.075 * l1 + 1.0) * e2) / den,
                            ((0.075 * l1 + 1.0) * e1 - (0.075 * l2 + 1.0) * e2) / den,
                            (0.075 * l1 + 1.0) * (0.075 * l2 + 1.0) * (e1 - e2) / den,
                            std::exp(-step / 0.015),
                            std::exp(-step / 0.075)};
        double output = 0.0;
        double memory = 0.0;
        const auto substep = [&](double input)
        {
            const double last = output;
            if (input < last && last > memory)
            {
                output = std::max(input, last * b[2] - memory * b[3]);
                memory = std::min(output, last * b[0] - memory * b[1]);
            }
            else if (input < last)
                memory = output = std::max(input, last * b[4]);
            else
            {
                output = input;
                memory = input - last < 1e-5 && input <= memory ? input : (memory - input) * b[5] + input;
            }
        };
        LoudnessDecay decay(rate);
        std::vector<double> values;
        for (int i = 0; i < 400; ++i) // rises, falls, level pieces, silence, and rises below what is left of before
            values.push_back(i % 90 > 70  ? 0.0
                             : i % 13 > 9 ? 2.0
                                          : std::abs(3.0 * std::sin(0.9 * i) * std::sin(0.013 * i * i)));
        // Falls of 1 to 30 % from one set to the next, with a full memory and with an empty one, and falls behind which
        // a little is heard.
        for (int fall = 1; fall <= 30; ++fall)
            for (const int before : {1, 30, 300})
            {
                values.insert(values.end(), static_cast<std::size_t>(before), 2.5);
                for (double value = 2.5; value > 0.02; value *= 1.0 - 0.01 * fall)
                    values.push_back(value);
                values.insert(values.end(), 60, 0.01);
                values.insert(values.end(), 200, 0.0);
            }
        for (std::size_t i = 0; i + 1 < values.size(); ++i)
        {
            CoreLoudness now{};
            CoreLoudness next{};
            now[7] = values[i];
            next[7] = values[i + 1];
            const double found = decay.step(now, next)[7];
            for (int m = 0; m < substeps; ++m)
            {
                substep(values[i] + (values[i + 1] - values[i]) * m / substeps);
                if (m == 0)
                    CHECK(found == Approx(output).epsilon(1e-12).margin(1e-15));
            }
        }
    }
}

TEST_CASE("Straight lines are smoothed as a fine grid of steps would be", "[loudness]")
{
    const std::vector<double> values{1.0, 3.0, 0.0, 0.5, 7.0, 7.0, 7.0, 0.0};
    for (const double tau : {0.0002, 0.0035, 0.07})
    {
        LoudnessSmoothing smoothing(tau, 2000.0);
        const double a = std::exp(-1.0 / (48000.0 * tau));
        double y = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            const double smoothed = smoothing.next(values[i]);
            const double next = i + 1 < values.size() ? values[i + 1] : 0.0;
            for (int m = 0; m < 24; ++m)
            {
                y = a * y + (1.0 - a) * (values[i] + (next - values[i]) * m / 24.0);
                if (m == 0)
                    CHECK(smoothed == Approx(y).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("A sound in pieces is as loud as in one", "[loudness]")
{
    const auto sound = loudnessTone(440.0, 65.0, 0.31);
    const auto whole = loudnessOf(sound);
    for (const std::size_t piece : {1u, 23u, 24u, 777u})
    {
        std::vector<double> total;
        const auto keep = [&](double sone, const LoudnessPattern&)
        {
            total.push_back(sone);
        };
        LoudnessMeter meter;
        for (std::size_t done = 0; done < sound.size(); done += piece)
            meter.process(std::span(sound).subspan(done).first(std::min(piece, sound.size() - done)), keep);
        meter.finish(keep);
        CHECK(total == whole.total);
    }
}

TEST_CASE("Samples that are no numbers, and pressures beyond the tables, leave loudness finite", "[loudness]")
{
    auto pressure = loudnessTone(1000.0, 60.0, 0.2);
    const auto clean = loudnessOf(pressure).total;
    pressure[100] = std::numeric_limits<float>::quiet_NaN();
    pressure[2000] = std::numeric_limits<float>::infinity();
    const auto total = loudnessOf(pressure).total;
    CHECK(std::all_of(total.begin(), total.end(), [](double sone) { return std::isfinite(sone); }));
    CHECK(total.back() == Approx(clean.back()).epsilon(0.01));
    const auto loud = loudnessOf(std::vector<float>(9600, 1e12f));
    CHECK(std::all_of(loud.total.begin(), loud.total.end(),
                      [](double sone) { return std::isfinite(sone) && sone >= 0.0; }));
    const auto mute = loudnessOf(std::vector<float>(9600, 1e-30f));
    CHECK(*std::max_element(mute.total.begin(), mute.total.end()) == 0.0);
}
