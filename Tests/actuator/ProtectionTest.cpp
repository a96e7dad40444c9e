#include "actuator/SimulatedActuator.h"
#include "actuator/Witness.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/ExcursionGuard.h>
#include <pacini/actuator/Protection.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{

Profile profileOf(double frequency, double q, double lowFrequency, double excursion, double maxExcursion)
{
    Profile profile;
    profile.resonance = {frequency, q};
    profile.range.lowFrequency = lowFrequency;
    profile.drive.excursion = excursion;
    profile.drive.maxExcursion = maxExcursion;
    return profile;
}

/// A coil of 8 ohm at 1 V rms that bears 0.03 W; full drive is 0.125 W for sinusoids.
Profile withCoil(Profile profile, double thermalTime)
{
    profile.drive.impedance = 8.0;
    profile.drive.maxVoltageRms = 1.0;
    profile.drive.maxPower = 0.03;
    profile.drive.thermalTime = thermalTime;
    return profile;
}

/// The L5 coil on a wristband, in which it resonates at 75 Hz and not at 67.
Profile onWristband(Profile profile)
{
    profile.technology = Technology::vca;
    profile.body = BodyParams{1.342, 0.012, 0.040, 4.0e4, 5.0, 0.010, 800.0, 2.5};
    return profile;
}

struct NamedProfile
{
    std::string name;
    Profile profile;
};

std::vector<NamedProfile> actuators()
{
    return {
        {"L5", withCoil(profileOf(67.0, 3.97, 20.0, 1e-3, 1.5e-3), 2.0)},
        {"LRA 175", withCoil(profileOf(175.0, 15.0, 100.0, 1e-4, 5e-4), 0.3)},
        {"LRA 235, q 30", profileOf(235.0, 30.0, 100.0, 1e-4, 4e-4)},
        {"piezo", profileOf(700.0, 10.0, 20.0, 5e-5, 6e-5)},
        {"overdamped", profileOf(90.0, 0.2, 20.0, 2e-3, 1e-3)},
        {"20 dB too much", withCoil(profileOf(67.0, 3.97, 20.0, 1e-2, 1e-3), 0.05)},
        {"a coil that heats within a period", withCoil(profileOf(67.0, 3.97, 20.0, 1e-3, 1.5e-3), 0.01)},
    };
}

using Signal = std::function<double(double time)>;

struct NamedSignal
{
    std::string name;
    Signal at;
};

/// The worst cases of each actuator, at full scale and 20 dB over it.
std::vector<NamedSignal> worstSignals(const Profile& profile)
{
    const double f0 = profile.resonance.frequency;
    const double low = profile.range.lowFrequency;
    const auto tone = [](double f)
    {
        return [f](double t)
        {
            return std::sin(2.0 * std::numbers::pi * f * t);
        };
    };
    const auto square = [tone](double f)
    {
        return [=](double t)
        {
            return tone(f)(t) < 0.0 ? -1.0 : 1.0;
        };
    };
    const auto noise = [](double t)
    {
        Random random(static_cast<std::uint64_t>(std::llround(t * 768000.0)));
        return random.uniform(-1.0, 1.0);
    };
    const auto times = [](double gain, Signal signal)
    {
        return [=](double t)
        {
            return gain * signal(t);
        };
    };
    const auto bursts = [=](double t)
    {
        return std::fmod(t, 0.2) < 0.05 ? 10.0 * tone(f0)(t) : 0.0;
    };
    const auto rectified = [=](double t)
    {
        return std::abs(tone(f0)(t));
    };
    const auto detuned = [=](double t)
    {
        return tone(f0)(t) + tone(1.03 * f0)(t) + tone(4.7 * f0)(t);
    };
    return {
        {"sine at resonance", tone(f0)},
        {"sine at resonance + 20 dB", times(10.0, tone(f0))},
        {"lowest sine + 20 dB", times(10.0, tone(low))},
        {"square at resonance", square(f0)},
        {"square at resonance + 20 dB", times(10.0, square(f0))},
        {"step",
         [](double)
         {
             return 1.0;
         }},
        {"step + 20 dB",
         [](double)
         {
             return -10.0;
         }},
        {"slow square + 20 dB", times(10.0, square(3.0))},
        {"noise + 20 dB", times(10.0, noise)},
        {"bursts", bursts},
        {"rectified + 20 dB", times(10.0, rectified)},
        {"beats + 20 dB", times(10.0, detuned)},
    };
}

std::vector<float> sampled(const Signal& signal, double seconds, double fs)
{
    std::vector<float> x(static_cast<std::size_t>(seconds * fs));
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] = static_cast<float>(signal(static_cast<double>(n) / fs));
    return x;
}

Protection prepared(const ProtectionParams& params, double fs)
{
    Protection protection;
    protection.setParams(params);
    protection.prepare({fs, 512});
    return protection;
}

/// Checks all limits of the profile on a drive, by simulations of the actuator.
void checkUnharmed(const Profile& profile, const std::vector<float>& drive, double fs)
{
    double largest = 0.0;
    for (float u : drive)
        largest = std::max(largest, std::abs(static_cast<double>(u)));
    CHECK(largest <= 1.0);
    if (profile.drive.maxExcursion)
    {
        test::Witness<test::SimulatedResonator> witness(profile, fs);
        witness.hold(drive);
        CHECK(witness.strain().travel <= 1.0 + 1e-6);
        CHECK(witness.strain().worn <= 1.0 + 1e-6);
    }
    if (profile.drive.maxPower)
    {
        const double full =
            2.0 * *profile.drive.maxVoltageRms * *profile.drive.maxVoltageRms / *profile.drive.impedance;
        CHECK(test::hottest(drive, full, *profile.drive.thermalTime, fs) <= *profile.drive.maxPower * (1.0 + 1e-6));
    }
}

double mean(std::span<const float> x)
{
    double sum = 0.0;
    for (float v : x)
        sum += static_cast<double>(v);
    return sum / static_cast<double>(x.size());
}

/// The power of a signal beside its tone of f Hz, relative to the tone, dB; over whole periods of both.
double distortion(std::span<const float> y, double f, double fs)
{
    const double n = static_cast<double>(y.size());
    const double tone = 2.0 * std::norm(test::spectrumAt(y, f, fs)) / n;
    double all = 0.0;
    for (float v : y)
        all += static_cast<double>(v) * static_cast<double>(v);
    return 10.0 * std::log10(std::max(all - tone, 1e-30) / tone);
}

} // namespace

TEST_CASE("Protection keeps the block contract", "[actuator][protection]")
{
    test::ContractOptions options;
    options.bound = 1.0;
    options.delay = test::MeasuredDelay::firstFrame;
    auto all = actuators();
    all.push_back({"L5 as worn", onWristband(all.front().profile)});
    for (const auto& [name, profile] : all)
        for (const double lookAhead : {0.0, 0.001})
        {
            CAPTURE(name, lookAhead);
            test::checkBlockContract<Protection>(protectionParams(profile, Seconds(lookAhead)), options);
        }
    const Profile l5 = actuators()[0].profile;
    const Profile lra = actuators()[1].profile;
    test::checkSilenceIsCheap<Protection>(protectionParams(l5, 1_ms));
    const Profile worn = onWristband(l5);
    test::checkSilenceIsCheap<Protection>(protectionParams(worn, 1_ms));
    test::checkModulation<Protection>(
        {protectionParams(l5, 0_s), protectionParams(worn, 0_s), protectionParams(lra, 0_s), {}}, 1.0);
}

TEST_CASE("No worst-case signal takes an actuator beyond its limits", "[actuator][protection][slow]")
{
    auto all = actuators();
    all.push_back({"L5 as worn", onWristband(all.front().profile)});
    for (const auto& [name, profile] : all)
        for (const double fs : {8000.0, 48000.0, 192000.0})
            for (const auto& signal : worstSignals(profile))
            {
                CAPTURE(name, fs, signal.name);
                const auto x = sampled(signal.at, fs > 100000.0 ? 0.15 : 0.35, fs);
                for (const double lookAhead : {0.0, 0.001})
                {
                    CAPTURE(lookAhead);
                    auto protection = prepared(protectionParams(profile, Seconds(lookAhead)), fs);
                    checkUnharmed(profile, test::runInBlocks(protection, x, 512), fs);
                }
            }
}

TEST_CASE("The worst-case signals do reach the limits without protection", "[actuator][protection]")
{
    const double fs = 48000.0;
    for (const auto& [name, profile] : actuators())
    {
        CAPTURE(name);
        test::SimulatedResonator mass(profile.resonance.frequency, profile.resonance.q, *profile.drive.excursion, fs);
        const bool overdamped = profile.resonance.q < 0.5;
        const auto signals = worstSignals(profile);
        const auto worst =
            std::find_if(signals.begin(), signals.end(),
                         [=](const NamedSignal& s) { return s.name == (overdamped ? "step" : "square at resonance"); });
        for (float u : sampled(worst->at, 0.5, fs))
            mass.hold(static_cast<double>(u));
        CHECK(mass.peak() > *profile.drive.maxExcursion);
        CHECK(mass.peak() <= worstExcursion(*excursionParams(profile)) * 1.001);
    }
}

TEST_CASE("An adversary who sees the mass cannot push it beyond its travel", "[actuator][protection]")
{
    for (const auto& [name, profile] : actuators())
        for (const double fs : {8000.0, 48000.0})
        {
            CAPTURE(name, fs);
            auto protection = prepared(protectionParams(profile, 0_s), fs);
            test::SimulatedResonator mass(profile.resonance.frequency, profile.resonance.q, *profile.drive.excursion,
                                          fs);
            // with the velocity; against it to gather way for a turn; from either end of the travel
            std::vector<float> drive;
            for (std::size_t n = 0; n < 8000; ++n)
            {
                const double pushed = n % 4000 < 3000 ? mass.velocity() : mass.displacement();
                float u = pushed < 0.0 ? -10.0f : 10.0f;
                protection.process(std::span(&u, 1), std::span(&u, 1));
                mass.hold(static_cast<double>(u));
                drive.push_back(u);
            }
            checkUnharmed(profile, drive, fs);
            if (profile.drive.maxPower.value_or(1.0) > 0.1) // where heat is no issue the travel is really used
                CHECK(mass.peak() > 0.98 * *profile.drive.maxExcursion);
        }
}

TEST_CASE("Random actuators stay unharmed by random signals", "[actuator][protection]")
{
    for (std::uint64_t seed = 1; seed <= 150; ++seed)
    {
        CAPTURE(seed);
        Random random(seed);
        const auto logarithmic = [&](double low, double high)
        {
            return low * std::pow(high / low, random.uniform());
        };
        const double fs = logarithmic(8000.0, 192000.0);
        Profile profile = profileOf(logarithmic(5.0, 0.3 * fs), logarithmic(0.05, 60.0), logarithmic(5.0, 200.0),
                                    logarithmic(1e-5, 1e-2), 1e-3);
        if (random.uniform() < 0.5)
            profile = withCoil(profile, logarithmic(0.01, 10.0));

        // pieces of steps, tones, noise and silence, each of a level of its own
        std::vector<float> x;
        while (x.size() < 6000)
        {
            const auto length = static_cast<std::size_t>(logarithmic(1.0, 2000.0));
            const double level = logarithmic(1e-3, 1e3) * (random.uniform() < 0.5 ? -1.0 : 1.0);
            const double f = random.uniform() < 0.5 ? profile.resonance.frequency : logarithmic(5.0, 0.5 * fs);
            const double kind = random.uniform();
            for (std::size_t n = 0; n < length; ++n)
            {
                const double phase = 2.0 * std::numbers::pi * f / fs * static_cast<double>(n);
                x.push_back(static_cast<float>(kind < 0.2   ? level
                                               : kind < 0.5 ? level * std::sin(phase)
                                               : kind < 0.7 ? std::copysign(level, std::sin(phase))
                                               : kind < 0.9 ? level * random.uniform(-1.0, 1.0)
                                                            : 0.0));
            }
        }
        x[x.size() / 2] = std::numeric_limits<float>::infinity();
        x[x.size() / 3] = std::numeric_limits<float>::max();
        auto protection =
            prepared(protectionParams(profile, Seconds(random.uniform() < 0.5 ? 0.0 : random.uniform(0.0, 1e-3))), fs);
        checkUnharmed(profile, test::runInBlocks(protection, x, 100), fs);
    }
}

TEST_CASE("A resonance above the sample rate is guarded between the samples", "[actuator][protection]")
{
    const Profile profile = profileOf(19000.0, 20.0, 20.0, 1e-3, 1e-3);
    const auto x = test::noise(4000, 5);
    auto protection = prepared(protectionParams(profile, 0_s), 8000.0);
    checkUnharmed(profile, test::runInBlocks(protection, x, 512), 8000.0);
}

TEST_CASE("Limits may narrow while the mass moves", "[actuator][protection]")
{
    const double fs = 48000.0;
    Profile profile = profileOf(175.0, 15.0, 100.0, 1e-4, 5e-4);
    auto protection = prepared(protectionParams(profile, 0_s), fs);
    auto x = test::sine(48000, 175.0, fs);
    protection.process(std::span(x).first(24000), std::span(x).first(24000));
    test::SimulatedResonator mass(175.0, 15.0, 1e-4, fs);
    for (std::size_t n = 0; n < 24000; ++n)
        mass.hold(static_cast<double>(x[n]));
    const double before = mass.amplitude();
    CHECK(before > 4.8e-4);
    profile.drive.maxExcursion = 1e-4;
    protection.setParams(protectionParams(profile, 0_s));
    const auto rest = std::span(x).subspan(24000);
    protection.process(rest, rest);
    const double decay = 2.0 * 15.0 / (2.0 * std::numbers::pi * 175.0); // s
    for (std::size_t n = 0; n < rest.size(); ++n)
    {
        mass.hold(static_cast<double>(rest[n]));
        const double free = before * std::exp(-static_cast<double>(n) / (decay * fs));
        REQUIRE(mass.amplitude() <= std::max(1e-4, 1.04 * free));
    }
    CHECK(mass.amplitude() > 0.9e-4);
}

TEST_CASE("The protection gives the same numbers frame by frame and by the way around far limits",
          "[actuator][protection]")
{
    // Swells from far below all limits to beyond them and back, so that every way is entered and left many times.
    // Calls of 1 and 3 frames never hold a whole group of frames.
    const double fs = 48000.0;
    auto all = actuators();
    all.push_back({"no limits", Profile{}});
    all.push_back({"coil alone", withCoil(Profile{}, 0.1)});
    all.push_back({"L5 as worn", onWristband(all.front().profile)});
    for (const auto& [name, profile] : all)
        for (const auto& [top, lookAhead] : {std::pair(3.0, 0.0), std::pair(3.0, 0.001), std::pair(0.8, 0.0003)})
        {
            CAPTURE(name, top, lookAhead);
            Random random(11);
            std::vector<float> x(96000);
            for (std::size_t n = 0; n < x.size(); ++n)
            {
                const double t = static_cast<double>(n) / fs;
                const double swell = top * std::pow(10.0, 1.75 * (std::sin(2.0 * std::numbers::pi * 0.75 * t) - 1.0));
                x[n] = static_cast<float>(swell * (std::sin(2.0 * std::numbers::pi * profile.resonance.frequency * t) +
                                                   0.1 * random.uniform(-1.0, 1.0)));
            }
            const ProtectionParams params = protectionParams(profile, Seconds(lookAhead));
            const auto run = [&](std::size_t blockFrames)
            {
                auto protection = prepared(params, fs);
                ProtectionMeter whole;
                std::vector<float> y(x.size());
                std::size_t i = 0;
                for (const std::size_t end : {std::size_t(47001), x.size()}) // new parameters come within a group
                {
                    for (; i < end; i += std::min(blockFrames, end - i))
                    {
                        const auto n = std::min(blockFrames, end - i);
                        protection.process(std::span(x).subspan(i, n), std::span(y).subspan(i, n));
                        const ProtectionMeter& meter = protection.meter();
                        whole.gainReduction = std::max(whole.gainReduction, meter.gainReduction);
                        whole.level |= meter.level;
                        whole.excursion |= meter.excursion;
                        whole.heat |= meter.heat;
                        whole.guardedFrames += meter.guardedFrames;
                    }
                    protection.setParams(params);
                }
                return std::pair(y, whole);
            };
            const auto [each, eachMeter] = run(1);
            CHECK((eachMeter.gainReduction > 3.0 || top < 1.0));
            CHECK((eachMeter.heat || name != "coil alone"));
            for (const std::size_t blockFrames : {std::size_t(3), std::size_t(10), std::size_t(64), std::size_t(500)})
            {
                CAPTURE(blockFrames);
                const auto [y, meter] = run(blockFrames);
                CHECK(y == each);
                CHECK(meter == eachMeter);
            }
        }
}

TEST_CASE("Below its limits the protection is two first-order high-passes and a delay", "[actuator][protection]")
{
    const double fs = 48000.0;
    const Profile profile = withCoil(profileOf(67.0, 3.97, 20.0, 1e-3, 1.5e-3), 2.0);
    for (const double lookAhead : {0.0, 0.0005, 0.001})
    {
        CAPTURE(lookAhead);
        auto protection = prepared(protectionParams(profile, Seconds(lookAhead)), fs);
        CHECK(protection.latencyFrames() == static_cast<std::size_t>(lookAhead * fs));
        Random random(3);
        std::vector<float> x(96000);
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] = static_cast<float>(0.25 * std::sin(2.0 * std::numbers::pi * 120.0 * static_cast<double>(n) / fs) +
                                      random.uniform(-0.15, 0.15));
        const auto y = test::runInBlocks(protection, x, 512);
        CHECK(protection.gainReduction() == 0.0);

        const long double keep = std::exp(-2.0L * std::numbers::pi_v<long double> * 2.0L / fs);
        long double x1 = 0, y1 = 0, z1 = 0, largest = 0;
        for (std::size_t n = 0; n + protection.latencyFrames() < x.size(); ++n)
        {
            const long double once = keep * y1 + x[n] - x1;
            const long double twice = keep * z1 + once - y1;
            x1 = x[n];
            y1 = once;
            z1 = twice;
            largest = std::max(largest, std::abs(twice - y[n + protection.latencyFrames()]));
        }
        CHECK(static_cast<double>(largest) < 1e-6);
    }
}

TEST_CASE("The high-passes cost a tenth of a decibel at the low end of the range", "[actuator][protection]")
{
    const double fs = 8000.0;
    Profile profile;
    for (const double low : {5.0, 20.0, 100.0})
    {
        CAPTURE(low);
        profile.range.lowFrequency = low;
        auto protection = prepared(protectionParams(profile, 1_ms), fs);
        const auto x = test::sine(80000, low, fs, 0.5);
        const auto y = test::runInBlocks(protection, x, 512);
        const double level =
            20.0 * std::log10(test::rms(std::span(y).last(40000)) / test::rms(std::span(x).last(40000)));
        CHECK(level > -0.1);
        CHECK(level < 0.03);
    }
}

TEST_CASE("No input leaves a mean in the output", "[actuator][protection]")
{
    const double fs = 8000.0;
    const auto half = [](double t)
    {
        return std::max(0.0, std::sin(2.0 * std::numbers::pi * 60.0 * t));
    };
    const auto pulses = [](double t)
    {
        return std::fmod(t, 0.05) < 0.002 ? 1.0 : 0.0;
    };
    const auto blips = [](double t) // so far apart that the limiter lets go between them
    {
        return std::fmod(t, 0.5) < 0.01 ? 1.0 : -0.02;
    };
    const std::vector<NamedSignal> signals{{"step",
                                            [](double)
                                            {
                                                return 1.0;
                                            }},
                                           {"half waves", half},
                                           {"pulses", pulses},
                                           {"blips", blips}};
    for (const auto& [name, profile] : actuators())
        for (const auto& signal : signals)
            for (const double gain : {0.3, 1.0, 10.0})
                for (const double lookAhead : {0.0, 0.001})
                {
                    CAPTURE(name, signal.name, gain, lookAhead);
                    auto protection = prepared(protectionParams(profile, Seconds(lookAhead)), fs);
                    const auto x = sampled([&](double t) { return gain * signal.at(t); }, 4.0, fs);
                    const auto y = test::runInBlocks(protection, x, 512);
                    CHECK(std::abs(mean(std::span(y).last(8000))) < 0.01);
                    CHECK(std::abs(mean(std::span(y).last(16000))) < 0.005);
                }
}

TEST_CASE("A sinusoid 6 dB over a limit stays a sinusoid at the limit", "[actuator][protection]")
{
    const double fs = 48000.0;
    struct Case
    {
        Profile profile;
        double frequency;
        double amplitude;
    };
    const Profile l5 = profileOf(67.0, 3.97, 20.0, 1e-3, 1.5e-3);
    const Profile lra = profileOf(175.0, 15.0, 100.0, 1e-4, 5e-4);
    Profile coil = withCoil(Profile{}, 0.5);
    const std::vector<Case> cases{
        {l5, 67.0, 2.0 * 1.5 / 3.97}, {l5, 20.0, 2.0},         {lra, 175.0, 2.0 * 5.0 / 15.0},
        {coil, 40.0, 0.98},           {Profile{}, 100.0, 2.0},
    };
    for (const auto& c : cases)
        for (const double lookAhead : {0.0, 0.001})
        {
            CAPTURE(c.profile.resonance.frequency, c.frequency, lookAhead);
            auto protection = prepared(protectionParams(c.profile, Seconds(lookAhead)), fs);
            const auto x = test::sine(6 * 48000, c.frequency, fs, c.amplitude);
            const auto y = test::runInBlocks(protection, x, 512);
            const double harmonics = distortion(std::span(y).last(48000), c.frequency, fs);
            const double level =
                20.0 * std::log10(test::rms(std::span(y).last(48000)) / test::rms(std::span(x).last(48000)));
            CAPTURE(level);
            CHECK(harmonics < -60.0);
            CHECK(level == Approx(-6.2).margin(0.6));
            CHECK(protection.gainReduction() == Approx(-level).margin(0.2));
            CHECK(protection.meter().excursion == c.profile.drive.maxExcursion.has_value());
            CHECK(protection.meter().heat == c.profile.drive.maxPower.has_value());
            CHECK(protection.meter().guardedFrames == 0);
        }
}

TEST_CASE("A cold coil lets bursts pass", "[actuator][protection]")
{
    const double fs = 8000.0;
    const Profile profile = withCoil(Profile{}, 2.0);
    auto protection = prepared(protectionParams(profile, 1_ms), fs);
    const auto x = test::sine(32000, 150.0, fs, 0.85);
    const auto y = test::runInBlocks(protection, x, 512);
    CHECK(test::rms(std::span(y).first(1600)) > 0.98 * test::rms(std::span(x).first(1600)));
    CHECK(test::rms(std::span(y).last(1600)) < 0.6 * test::rms(std::span(x).last(1600)));
    // and warm it is played nearly as loud as it may be: 0.03 W of 0.25 W at a standing drive of 1
    CHECK(test::rms(std::span(y).last(1600)) > 0.95 * std::sqrt(0.03 / 0.25));
    protection.reset(); // it is cold again
    CHECK(test::runInBlocks(protection, x, 512) == y);
}

TEST_CASE("A coil that cooled while nobody worked is guarded as one that was followed", "[actuator][protection]")
{
    const double fs = GENERATE(8000.0, 48000.0, 192000.0);
    const double silence = GENERATE(0.0, 0.3, 2.0, 60.0); // s, after those at which all else rests
    Protection followed, passed;
    for (Protection* protection : {&followed, &passed})
    {
        protection->prepare({fs, 512});
        protection->setParams(protectionParams(withCoil(profileOf(67.0, 3.0, 20.0, 1e-4, 1e-3), 20.0), Seconds(0.0)));
    }
    const auto tone = [fs](double seconds)
    {
        std::vector<float> samples(static_cast<std::size_t>(seconds * fs));
        for (std::size_t i = 0; i < samples.size(); ++i)
            samples[i] =
                static_cast<float>(0.99 * std::sin(2.0 * std::numbers::pi * 150.0 * static_cast<double>(i) / fs));
        return samples;
    };
    const auto run = [](Protection& protection, std::vector<float> samples)
    {
        protection.process(samples, samples);
        return samples;
    };
    const auto hot = tone(20.0); // which the coil bears for some seconds only
    const std::vector<float> still(static_cast<std::size_t>(3.0 * fs) + 5),
        skipped(static_cast<std::size_t>(silence * fs));
    for (Protection* protection : {&followed, &passed})
    {
        const auto driven = run(*protection, hot);
        CHECK(std::abs(driven.back()) < 0.9f);
        (void)run(*protection, still);
    }
    (void)run(followed, skipped);
    passed.pass(static_cast<double>(skipped.size()));
    const auto again = tone(5.0);
    const auto a = run(followed, again), b = run(passed, again);
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    CHECK(largest <= 1e-7);
    if (silence > 1.0) // and the time did matter
    {
        Protection hotter;
        hotter.prepare({fs, 512});
        hotter.setParams(protectionParams(withCoil(profileOf(67.0, 3.0, 20.0, 1e-4, 1e-3), 20.0), Seconds(0.0)));
        (void)run(hotter, hot);
        (void)run(hotter, still);
        CHECK(run(hotter, again) != a);
    }
}

TEST_CASE("Limits that no drive can reach are left out", "[actuator][protection]")
{
    using Limit = ProtectionNeeds::Limit;
    Profile profile;
    CHECK(protectionNeeds(profile).excursion == Limit::unknown);
    CHECK(protectionNeeds(profile).heat == Limit::unknown);
    CHECK_FALSE(protectionParams(profile, 0_s).excursion.has_value());

    profile = withCoil(profileOf(67.0, 3.97, 20.0, 1e-3, 1e-3), 1.0);
    auto needs = protectionNeeds(profile);
    CHECK(needs.excursion == Limit::guarded);
    CHECK(needs.heat == Limit::guarded);
    CHECK(needs.worstPower == Approx(0.25));
    CHECK(protectionParams(profile, 0_s).heat->thermalTime == 1_s);
    profile.drive.thermalTime.reset();
    CHECK(protectionParams(profile, 0_s).heat->thermalTime == Seconds(defaultThermalTime));

    // The worst drive follows the velocity of the mass: what it reaches is the bound.
    for (const double q : {0.3, 0.5, 0.8, 3.97, 30.0})
    {
        CAPTURE(q);
        const double fs = 48000.0;
        const ExcursionParams params{67_Hz, q, 1e-3, 1e-3};
        test::SimulatedResonator mass(67.0, q, 1e-3, fs);
        for (int n = 0; n < 96000; ++n)
            mass.hold(mass.velocity() < 0.0 ? -1.0 : 1.0);
        CHECK(mass.peak() <= worstExcursion(params) * (1.0 + 1e-9));
        if (q > 0.5)
            CHECK(mass.peak() > 0.98 * worstExcursion(params));
    }

    profile.drive.maxPower = 0.25;
    profile.drive.maxExcursion = protectionNeeds(profile).worstExcursion;
    needs = protectionNeeds(profile);
    CHECK(needs.excursion == Limit::unharmed);
    CHECK(needs.heat == Limit::unharmed);
    CHECK(protectionParams(profile, 0_s) == ProtectionParams{std::nullopt, std::nullopt, Hertz(20.0), Seconds(0.0)});
}

TEST_CASE("Limits are judged at the largest drive, overdrive included", "[actuator][protection]")
{
    using Limit = ProtectionNeeds::Limit;
    // 2 % above what the rated drive can do at worst
    Profile profile =
        withCoil(profileOf(175.0, 15.0, 100.0, 1e-4, 1.02 * worstExcursion({175_Hz, 15.0, 1e-4, 1.0})), 0.3);
    profile.drive.maxPower = 1.02 * 0.25;
    CHECK(protectionNeeds(profile).excursion == Limit::unharmed);
    CHECK(protectionNeeds(profile).heat == Limit::unharmed);
    CHECK(protectionText(profile) == "no drive reaches the limit of travel; no drive reaches the limit of heat");
    for (const double overdrive : {1.05, 3.0, 10.0})
    {
        CAPTURE(overdrive);
        profile.drive.overdrive = overdrive;
        const auto needs = protectionNeeds(profile);
        CHECK(needs.excursion == Limit::guarded);
        CHECK(needs.heat == Limit::guarded);
        CHECK(needs.worstExcursion == Approx(overdrive / 1.02 * *profile.drive.maxExcursion));
        CHECK(needs.worstPower == Approx(overdrive * overdrive * 0.25));
    }
    CHECK(protectionText(profile) == "travel is kept within its limit; heat is kept within its limit");
    profile.drive.maxPower.reset();
    CHECK(protectionText(profile) == "travel is kept within its limit; the profile names no limit of heat");
    // The largest of all valid profiles is not clamped away.
    profile.drive.excursion = 1.0;
    profile.drive.overdrive = 10.0;
    profile.drive.maxExcursion = 0.1;
    auto protection = prepared(protectionParams(profile, 0_s), 48000.0);
    const auto y = test::runInBlocks(protection, test::sine(48000, 175.0, 48000.0), 512);
    test::SimulatedResonator mass(175.0, 15.0, 10.0, 48000.0);
    for (float u : y)
        mass.hold(static_cast<double>(u));
    CHECK(mass.peak() <= 0.1 * (1.0 + 1e-6));
    CHECK(mass.peak() > 0.09);
}

TEST_CASE("Bounds alone leave a direct voltage as it is and keep the heat of one that stays", "[actuator][protection]")
{
    const double fs = 8000.0;
    ProtectionParams params;
    params.heat = CoilHeatParams{1.0, 0.25, 100_ms};
    auto protection = prepared(params, fs);
    params.boundsAlone = true;
    params.lookAhead = 0_s;
    // A mean that was followed before is forgotten.
    (void)test::runInBlocks(protection, std::vector<float>(8000, 0.4f), 512);
    protection.setParams(params);
    const std::vector<float> half(8000, 0.5f);
    CHECK(test::runInBlocks(protection, half, 512) == half);
    const auto full = test::runInBlocks(protection, std::vector<float>(8000, 1.0f), 512);
    CHECK(full.back() == Approx(0.5).epsilon(1e-4));
    CHECK(test::hottest(full, 1.0, 0.1, fs) <= 0.25 * (1.0 + 1e-6));
}

TEST_CASE("The held step is exact for any damping and rate", "[actuator][protection]")
{
    for (const double q : {0.01, 0.3, 0.5, 0.5000001, 4.0, 100.0})
        for (const double duration : {1.0 / 768000.0, 1.0 / 48000.0, 1.0 / 2000.0})
        {
            CAPTURE(q, duration);
            const double f = 150.0;
            const HeldStep step = designHeldStep(f, q, 1.0, duration);
            // x and v/w0 from roots of the characteristic polynomial, in long double
            using Complex = std::complex<long double>;
            const long double angle = 2.0L * std::numbers::pi_v<long double> * f * duration;
            const Complex root = std::sqrt(Complex(1.0L / (4.0L * q * q) - 1.0L));
            const Complex r1 = -1.0L / (2.0L * q) + root;
            const Complex r2 = -1.0L / (2.0L * q) - root;
            if (std::abs(root) < 1e-9L)
                continue;                    // the formula divides by it
            const auto expm1 = [](Complex z) // without cancellation
            {
                const Complex half = z / 2.0L;
                return 2.0L * std::exp(half) * std::sinh(half);
            };
            const Complex e1 = expm1(r1 * angle);
            const Complex e2 = expm1(r2 * angle);
            const auto xx = static_cast<double>(((r1 * e2 - r2 * e1) / (r1 - r2)).real());
            const auto vx = static_cast<double>((r1 * r2 * (e2 - e1) / (r1 - r2)).real());
            CHECK(step.xx == Approx(xx).epsilon(1e-9));
            CHECK(step.vx == Approx(vx).epsilon(1e-9));
            CHECK(step.driveToX == Approx(-xx).epsilon(1e-9));
            CHECK(step.driveToV == Approx(-vx).epsilon(1e-9));
        }
}

TEST_CASE("Parameters of the excursion limiter beyond their ranges count as the ends", "[actuator][protection]")
{
    const double fs = 48000.0;
    const auto measures = [&](const ExcursionParams& params)
    {
        ExcursionGuard guard;
        guard.design(params, fs);
        Random random(5);
        std::vector<double> numbers;
        for (int n = 0; n < 400; ++n)
        {
            const double drive = n < 100 ? 1.0 : random.uniform(-1.0, 1.0);
            numbers.push_back(guard.measure(drive));
            numbers.push_back(guard.admit(drive));
            guard.advance(numbers.back());
        }
        return numbers;
    };
    struct Range
    {
        double low, high;
        std::function<void(ExcursionParams&, double)> set;
    };
    const Range ranges[] = {
        {1.0, 20000.0,
         [](ExcursionParams& p, double v)
         {
             p.frequency = Hertz(v);
         }},
        {0.01, 1000.0,
         [](ExcursionParams& p, double v)
         {
             p.q = v;
         }},
        {1e-9, 10.0,
         [](ExcursionParams& p, double v)
         {
             p.excursion = v;
         }},
        {1e-7, 0.1,
         [](ExcursionParams& p, double v)
         {
             p.maxExcursion = v;
         }},
    };
    for (const Range& range : ranges)
    {
        CAPTURE(range.low);
        ExcursionParams params{Hertz(100.0), 2.0, 1e-3, 1e-3, {}};
        const auto same = [&](double a, double b)
        {
            range.set(params, a);
            const auto numbers = measures(params);
            range.set(params, b);
            return numbers == measures(params);
        };
        CHECK(same(0.3 * range.low, range.low));
        CHECK(same(3.0 * range.high, range.high));
        CHECK_FALSE(same(1.01 * range.low, range.low));
        CHECK_FALSE(same(0.99 * range.high, range.high));
    }
    // A mass that hardly moves while the base is held still, so that only the worn one counts.
    const auto worn = wornChain(onWristband(actuators().front().profile));
    const auto wornMeasures = [&](double travel, double force)
    {
        ExcursionParams params{Hertz(100.0), 2.0, 1e-9, travel, worn};
        params.worn->force *= force;
        return measures(params);
    };
    CHECK((wornMeasures(1e-8, 1e-3) == wornMeasures(1e-7, 1e-3)));
    CHECK((wornMeasures(1.01e-7, 1e-3) != wornMeasures(1e-7, 1e-3)));
    CHECK((wornMeasures(1.0, 1000.0) == wornMeasures(0.1, 1000.0)));
    CHECK((wornMeasures(0.099, 1000.0) != wornMeasures(0.1, 1000.0)));
}

TEST_CASE("An excursion limiter that nobody designed is that of the default parameters", "[actuator][protection]")
{
    ExcursionGuard fresh, designed;
    designed.design({}, ProcessSpec{}.sampleRate);
    for (int n = 0; n < 100; ++n)
    {
        REQUIRE(fresh.measure(0.5) == designed.measure(0.5));
        REQUIRE(fresh.admit(0.5) == designed.admit(0.5));
        fresh.advance(0.5);
        designed.advance(0.5);
    }
}

TEST_CASE("The excursion limiter admits all that it could, and its room between points is that of a turn",
          "[actuator][protection]")
{
    for (const ExcursionParams& params :
         {ExcursionParams{Hertz(100.0), 2.0, 3e-3, 1e-3, {}}, ExcursionParams{Hertz(90.0), 0.2, 5e-3, 1e-3, {}},
          ExcursionParams{Hertz(700.0), 20.0, 1e-3, 1e-3, {}}, ExcursionParams{Hertz(3000.0), 5.0, 1.0, 1e-3, {}},
          ExcursionParams{Hertz(15000.0), 5.0, 1.0, 1e-3, {}}})
    {
        const double frequency = params.frequency.value, fs = 8000.0;
        CAPTURE(frequency);
        ExcursionGuard guard;
        guard.design(params, fs);
        const auto& c = guard.coefficients();
        const auto points = static_cast<double>(c.steps.size());
        const double turn = 2.0 * std::numbers::pi * frequency / fs;
        CHECK((turn <= 0.05 * points || points == 64.0));
        CHECK((points == 1.0 || turn > 0.05 * (points - 1.0)));
        CHECK(c.groupReach == Approx(static_cast<double>(groupFrames) * turn * params.excursion));
        const double d = turn / points;
        const double radius = std::sqrt(c.energyLimit);
        const double rest = c.driveLimit * params.excursion;
        CHECK(radius == Approx(params.maxExcursion - 0.5 * d * d * (params.maxExcursion + rest)).epsilon(1e-7));
        CHECK(radius < params.maxExcursion);
        if (c.driveLimit < 1.0)
            CHECK(radius == Approx(0.95 * params.maxExcursion).epsilon(1e-6));
        else
            CHECK(radius >= 0.95 * params.maxExcursion * (1.0 - 1e-6));

        Random random(3);
        ResonatorState state;
        bool held = false;
        for (int n = 0; n < 600; ++n)
        {
            const double wanted = random.uniform(-1.0, 1.0) > 0.98 * std::cos(turn * n) ? 1.0 : -1.0;
            const auto highest = [&](double drive)
            {
                double energy = 0.0;
                for (const HeldStep& step : c.steps)
                    energy = std::max(energy, step.next(state, drive).energy());
                return energy;
            };
            // The end of what is admissible, by halving.
            double low = 0.0, high = wanted * c.driveLimit;
            for (int i = 0; i < 60; ++i)
                (highest(0.5 * (low + high)) <= c.energyLimit ? low : high) = 0.5 * (low + high);
            const double admitted = guard.admit(wanted);
            REQUIRE(admitted == Approx(low).margin(1e-6));
            held |= std::abs(admitted) < 0.99 * c.driveLimit;
            guard.advance(admitted);
            state = c.steps.back().next(state, admitted);
        }
        CHECK(held);
    }
}

TEST_CASE("Where the excursion limiter goes ahead freely it would have admitted every frame", "[actuator][protection]")
{
    const auto body = wornChain(onWristband(actuators().front().profile));
    for (const bool worn : {false, true})
        for (const double excursion : {1e-7, 1.5e-3, 0.01})
        {
            CAPTURE(worn, excursion);
            const double fs = 8000.0;
            ExcursionParams params{Hertz(67.0), 3.97, excursion, 1.5e-3, {}};
            if (worn)
                params.worn = body;
            ExcursionGuard guard;
            guard.design(params, fs);
            Random random(11);
            int freely = 0;
            for (int block = 0; block < 400; ++block)
            {
                std::vector<double> wanted(16), played(16);
                const double level = std::pow(10.0, random.uniform(-4.0, 0.0));
                double wantedPeak = 0.0, playedPeak = 0.0;
                for (std::size_t n = 0; n < wanted.size(); ++n)
                {
                    const double swing = std::sin(2.0 * std::numbers::pi * 67.0 / fs * (16.0 * block + double(n)));
                    wanted[n] = level * swing;
                    played[n] = (block % 3 == 0 ? 0.5 : 1.0) * wanted[n];
                    wantedPeak = std::max(wantedPeak, std::abs(wanted[n]));
                    playedPeak = std::max(playedPeak, std::abs(played[n]));
                }
                const double most = block % 2 == 0 ? 1.0 : 0.25;
                ExcursionGuard single = guard;
                const ExcursionGuard before = guard;
                double highest = 0.0;
                bool admitted = true;
                for (std::size_t n = 0; n < wanted.size(); ++n)
                {
                    highest = std::max(highest, single.measure(wanted[n]));
                    const double drive = single.admit(played[n]);
                    admitted = admitted && drive == played[n];
                    single.advance(drive);
                }
                if (guard.advanceFreely(wanted, wantedPeak, played, playedPeak, most))
                {
                    ++freely;
                    REQUIRE(highest <= most);
                    REQUIRE(admitted);
                }
                else
                {
                    // Nothing happened.
                    REQUIRE(guard.admit(1.0) == before.admit(1.0));
                    REQUIRE(ExcursionGuard(guard).measure(0.0) == ExcursionGuard(before).measure(0.0));
                    guard = single;
                }
                REQUIRE(guard.admit(1.0) == single.admit(1.0));
                REQUIRE(guard.admit(-1.0) == single.admit(-1.0));
                REQUIRE(ExcursionGuard(guard).measure(0.0) == ExcursionGuard(single).measure(0.0));
            }
            CHECK(freely > 10);
            CHECK((freely < 400 || excursion < 1e-6));
        }
}

TEST_CASE("A guard follows what is wanted and what is played apart as it does frame by frame", "[actuator][protection]")
{
    for (const bool wears : {false, true})
        for (const double fs : {8000.0, 48000.0})
        {
            CAPTURE(wears, fs);
            ExcursionParams params{Hertz(67.0), 3.97, 1e-3, 1.5e-3, {}};
            if (wears)
            {
                params.worn = makeBodyChain(BodyParams{1.342, 0.012, 0.040, 4.0e4, 5.0, 0.010, 800.0, 2.5},
                                            Resonance{67.0, 3.97});
                params.worn->force = 1e-3 * params.worn->suspensionStiffness;
            }
            ExcursionGuard guard;
            guard.design(params, fs);
            Random random(3);
            int measured = 0, freely = 0;
            for (int block = 0; block < 300; ++block)
            {
                std::vector<double> wanted(32), played(32), levels(32, 0.125);
                const double level = std::pow(10.0, random.uniform(-2.0, 0.3));
                double wantedPeak = 0.0, playedPeak = 0.0;
                for (std::size_t n = 0; n < wanted.size(); ++n)
                {
                    wanted[n] = level * std::sin(2.0 * std::numbers::pi * 67.0 / fs * (32.0 * block + double(n)));
                    played[n] = 0.7 * wanted[n];
                    wantedPeak = std::max(wantedPeak, std::abs(wanted[n]));
                    playedPeak = std::max(playedPeak, std::abs(played[n]));
                }
                ExcursionGuard single = guard;
                double highest = 0.0;
                bool admitted = true;
                std::vector<double> expected;
                for (std::size_t n = 0; n < wanted.size(); ++n)
                {
                    expected.push_back(single.measure(wanted[n]));
                    highest = std::max(highest, expected.back());
                }
                const double largest = guard.measure(wanted, wantedPeak, 0.8, levels);
                if (largest > 0.0)
                {
                    ++measured;
                    REQUIRE(largest <= highest);
                    REQUIRE((highest <= 0.8 || largest == highest));
                    for (std::size_t n = 0; n < wanted.size(); ++n)
                        REQUIRE((levels[n] == std::max(expected[n], 0.125) ||
                                 (expected[n] <= 0.8 && levels[n] <= std::max(expected[n], 0.125))));
                }
                else
                {
                    REQUIRE(highest <= 0.8);
                    REQUIRE(levels == std::vector<double>(32, 0.125));
                }
                REQUIRE(ExcursionGuard(guard).measure(0.0) == ExcursionGuard(single).measure(0.0));

                const ExcursionGuard before = guard;
                for (const double drive : played)
                {
                    const double most = single.admit(drive);
                    admitted = admitted && most == drive;
                    single.advance(most);
                }
                if (guard.advanceFreely(played, playedPeak))
                {
                    ++freely;
                    REQUIRE(admitted);
                }
                else
                {
                    REQUIRE(guard.admit(1.0) == before.admit(1.0));
                    guard = single;
                }
                REQUIRE(guard.admit(1.0) == single.admit(1.0));
                REQUIRE(guard.admit(-1.0) == single.admit(-1.0));
            }
            CHECK(measured > 10);
            CHECK(measured < 300);
            CHECK(freely > 10);
            CHECK(freely < 300);
        }
}

TEST_CASE("What a protection leaves out for whole groups of frames changes no sample", "[actuator][protection]")
{
    ExcursionParams travel{Hertz(67.0), 3.97, 1e-3, 1.5e-3, {}};
    ExcursionParams worn = travel;
    worn.worn = makeBodyChain(BodyParams{1.342, 0.012, 0.040, 4.0e4, 5.0, 0.010, 800.0, 2.5}, Resonance{67.0, 3.97});
    worn.worn->force = 1e-3 * worn.worn->suspensionStiffness;
    const CoilHeatParams slow{0.3, 0.1, Seconds(20.0)}, fast{1.0, 0.1, Seconds(0.05)};
    const std::vector<ProtectionParams> all = {
        {{}, {}, Hertz(20.0), Seconds(0.001), false},       {travel, {}, Hertz(40.0), Seconds(0.0), false},
        {worn, {}, Hertz(20.0), Seconds(0.0007), false},    {worn, slow, Hertz(60.0), Seconds(0.001), false},
        {travel, fast, Hertz(60.0), Seconds(0.001), false}, {worn, fast, Hertz(20.0), Seconds(0.0), true}};
    Random random(17);
    std::vector<float> x(48000);
    double level = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        if (n % 1500 == 0) // from far below all limits to far beyond
            level = std::pow(10.0, random.uniform(-2.5, 0.5));
        const double t = 2.0 * std::numbers::pi * static_cast<double>(n) / 48000.0;
        x[n] = static_cast<float>(level * (std::sin(67.0 * t) + 0.4 * std::sin(211.0 * t)));
    }
    for (const ProtectionParams& params : all)
    {
        const auto played = [&](std::size_t block)
        {
            Protection protection;
            protection.setParams(params);
            protection.prepare({48000.0, 1024});
            std::vector<float> y = x;
            double reduction = 0.0;
            std::size_t guarded = 0;
            for (std::size_t i = 0; i < y.size(); i += block)
            {
                const auto part = std::span(y).subspan(i, std::min(block, y.size() - i));
                protection.process(part, part);
                reduction = std::max(reduction, protection.meter().gainReduction);
                guarded += protection.meter().guardedFrames;
            }
            return std::tuple(y, reduction, guarded);
        };
        const auto single = played(1); // no whole group: nothing is left out
        CHECK((params.boundsAlone || std::get<1>(single) > 1.0));
        for (const std::size_t block : {8u, 24u, 1000u, 1024u})
        {
            CAPTURE(&params - all.data(), block);
            CHECK(played(block) == single);
        }
    }
}

TEST_CASE("The lowest tone of a protection is 1 Hz to 20 kHz", "[actuator][protection]")
{
    const auto afterStep = [](double low)
    {
        ProtectionParams params;
        params.excursion = ExcursionParams{Hertz(67.0), 1.0, 1e-3, 1e-3, std::nullopt};
        params.lowFrequency = Hertz(low);
        Protection protection;
        protection.prepare({8000.0, 8000});
        protection.setParams(params);
        std::vector<float> y(8000, 0.01f);
        protection.process(y, y);
        return y;
    };
    CHECK(afterStep(0.25) == afterStep(1.0));
    CHECK(afterStep(0.0) == afterStep(1.0));
    CHECK(afterStep(2.0) != afterStep(1.0));
    CHECK(afterStep(1e9) == afterStep(20000.0));
}
