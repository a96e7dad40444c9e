#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/actuator/EqualizerPruning.h>
#include <pacini/actuator/OutputFilter.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{

std::vector<double> numbersOf(const BiquadCoefficients& c)
{
    return {c.b0, c.b1, c.b2, c.a1, c.a2};
}

std::vector<Resonance> inverseExamples()
{
    return {{67.0, 3.97}, {175.0, 30.0}, {90.0, 0.2}, {50.0, 0.5}, {3900.0, 0.9}, {0.5, 1.2}, {60.0, 0.5000001}};
}

} // namespace

TEST_CASE("The pole pair of a resonance is its centre and spread, clamped to what can be reckoned", "[actuator]")
{
    const double w = 2.0 * std::numbers::pi * 50.0;
    CHECK(polePairOf({50.0, 4.0}).centre == Approx(-w / 8.0).epsilon(1e-14));
    CHECK(polePairOf({50.0, 4.0}).spread == Approx(w * w / 64.0 - w * w).epsilon(1e-14));
    CHECK_FALSE(polePairOf({50.0, 4.0}).single);
    CHECK(polePairOf({50.0, 0.25}).spread == Approx(3.0 * w * w).epsilon(1e-14));
    const auto same = [](const Resonance& a, const Resonance& b)
    {
        const Resonance other{70.0, 0.8};
        return polePairOf(a) == polePairOf(b) &&
               numbersOf(designPolePairInverse(a, other, 1e6)) == numbersOf(designPolePairInverse(b, other, 1e6)) &&
               numbersOf(designPolePairInverse(other, a, 1e6)) == numbersOf(designPolePairInverse(other, b, 1e6));
    };
    for (const double q : {0.3, 4.0}) // real and conjugate poles
    {
        CHECK(same({0.01, q}, {0.1, q}));
        CHECK_FALSE(same({0.11, q}, {0.1, q}));
        CHECK(same({1e6, q}, {1e5, q}));
        CHECK_FALSE(same({0.9e5, q}, {1e5, q}));
    }
    CHECK(same({50.0, 1e-4}, {50.0, 1e-3}));
    CHECK_FALSE(same({50.0, 1.1e-3}, {50.0, 1e-3}));
    CHECK(same({50.0, 1e5}, {50.0, 1e4}));
    CHECK_FALSE(same({50.0, 0.9e4}, {50.0, 1e4}));
}

TEST_CASE("The inverse of a resonance has its zeros and poles where sampling puts them, exactly", "[actuator]")
{
    for (const double fs : {8000.0, 48000.0})
    {
        std::vector<double> gains;
        for (const Resonance& actuator : inverseExamples())
            for (const Resonance& target : inverseExamples())
            {
                CAPTURE(fs, actuator.frequency, actuator.q, target.frequency, target.q);
                const auto c = designPolePairInverse(actuator, target, fs);
                using Complex = std::complex<long double>;
                const auto factor = [&](const Resonance& r)
                {
                    const long double w = 2.0L * std::numbers::pi_v<long double> * r.frequency / fs;
                    const Complex root = std::sqrt(Complex(0.25L / (static_cast<long double>(r.q) * r.q) - 1.0L));
                    const Complex one = std::exp(w * (-0.5L / static_cast<long double>(r.q) + root));
                    const Complex two = std::exp(w * (-0.5L / static_cast<long double>(r.q) - root));
                    return std::pair(static_cast<double>((-one - two).real()), static_cast<double>((one * two).real()));
                };
                CHECK(c.a1 == Approx(factor(target).first).margin(1e-12));
                CHECK(c.a2 == Approx(factor(target).second).margin(1e-12));
                CHECK(c.b1 / c.b0 == Approx(factor(actuator).first).margin(1e-12));
                CHECK(c.b2 / c.b0 == Approx(factor(actuator).second).margin(1e-12));
                gains.push_back(std::log(c.b0));
            }
        checkPinned("actuator/pole pair inverse, " + std::to_string(static_cast<int>(fs)), gains);
    }
}

TEST_CASE("The highest gain of an inverse is where searching finds it", "[actuator]")
{
    for (const Resonance& actuator : inverseExamples())
        for (const Resonance& target : {Resonance{40.0, 1.0}, Resonance{120.0, 0.3}, Resonance{67.0, 3.0},
                                        Resonance{67.0, 3.97}, Resonance{20.0, 12.0}, Resonance{175.0, 0.4}})
        {
            CAPTURE(actuator.frequency, actuator.q, target.frequency, target.q);
            const auto gain = [&](double f)
            {
                const auto size = [f](const Resonance& r)
                {
                    return std::hypot(r.frequency * r.frequency - f * f, r.frequency * f / r.q);
                };
                return size(actuator) / size(target);
            };
            double highest = std::max(1.0, gain(0.0));
            for (double octaves = -6.0; octaves < 16.0; octaves += 1e-3)
                highest = std::max(highest, gain(std::exp2(octaves)));
            CHECK(detail::highestGain(actuator, target) == Approx(highest).epsilon(1e-4));
            CHECK(detail::highestGain(actuator, target) >= highest * (1.0 - 1e-12));
            // Where it turns, a little to either side is nearly as much.
            for (const double f : detail::turningPoints(actuator, target))
                if (f > 0.0)
                {
                    const double at = gain(f), near = gain(f * 1.0001), far = gain(f * 1.01);
                    CHECK(std::abs(near - at) <= 0.05 * std::abs(far - at) + 1e-12 * at);
                }
        }
}

TEST_CASE("The flattening of an actuator stays as it was", "[actuator]")
{
    CHECK(Flattening{}.gain == 1.0);
    CHECK(Flattening{}.most == 1e6);
    CHECK(Flattening{}.octaves == 0.0);
    CHECK(Flattening{}.actuator == Resonance{});
    int index = 0;
    for (const Resonance& resonance : {Resonance{67.0, 3.97}, Resonance{175.0, 15.0}, Resonance{235.0, 60.0},
                                       Resonance{90.0, 0.2}, Resonance{150.0, 1e3}})
        for (const bool worn : {false, true})
        {
            std::vector<double> numbers;
            for (const double boost : {0.5, 6.0, 12.0, 40.0, 50.0})
            {
                Profile profile;
                profile.technology = Technology::lra;
                profile.resonance = resonance;
                if (worn)
                    profile.body = BodyParams{};
                const auto flattening = flatteningOf(profile, Decibels(boost));
                REQUIRE(flattening.has_value());
                const double within = std::min(boost, 40.0);
                CHECK(flattening->gain == Approx(std::pow(10.0, -within / 40.0)));
                CHECK(flattening->most == Approx(std::pow(10.0, within / 20.0)));
                for (const double number :
                     {flattening->actuator.frequency, flattening->actuator.q, flattening->target.frequency,
                      flattening->target.q, 1.0 + flattening->octaves})
                    numbers.push_back(std::log(number));
                for (const double fs : {2000.0, 48000.0})
                {
                    OutputFilterParams params;
                    params.flattening = flattening;
                    params.equalizer = {{EqualizerType::peak, 100.0, 3.0, 1.0, 2}};
                    const auto filter = designOutputFilter(params, fs);
                    REQUIRE(filter.sections.size() == 2);
                    double highest = 0.0;
                    const auto alone = designOutputFilter({{}, flattening}, fs);
                    for (const double f : {0.0, 10.0, 60.0, 100.0, 180.0, 240.0, 700.0, 1000.0})
                        numbers.push_back(std::log(std::abs(filter.response(Hertz(f), fs))));
                    for (double f = 0.5; f < 0.5 * fs; f *= 1.01)
                        highest = std::max(highest, std::abs(alone.response(Hertz(f), fs)));
                    CHECK(highest <= flattening->most * (1.0 + 1e-6));
                }
            }
            checkPinned("actuator/flattening " + std::to_string(index++), numbers, 1e-6);
        }
}

TEST_CASE("Nothing is flattened where nothing is known, nothing resonates, or nothing is wanted", "[actuator]")
{
    Profile profile;
    for (const Technology technology :
         {Technology::erm, Technology::lra, Technology::piezo, Technology::eap, Technology::vca, Technology::pcm})
    {
        profile.technology = technology;
        CHECK(flatteningOf(profile, Decibels(6.0)).has_value() ==
              (technology != Technology::erm && technology != Technology::pcm));
        CHECK_FALSE(flatteningOf(profile, Decibels(0.0)).has_value());
        CHECK_FALSE(flatteningOf(profile, Decibels(-1.0)).has_value());
        CHECK_FALSE(flatteningOf(profile, Decibels(std::nan(""))).has_value());
    }
    profile.technology = Technology::lra;
    CHECK(flatteningOf(profile, Decibels(1e-3)).has_value());
    profile.equalizer = {EqualizerSection{}};
    CHECK_FALSE(flatteningOf(profile, Decibels(6.0)).has_value());
    CHECK(designOutputFilter({}, 48000.0).sections.empty());
    CHECK(designOutputFilter({{EqualizerSection{}}, {}}, 48000.0).sections.size() == 1);
}

TEST_CASE("The sampled inverse's highest gain is where searching finds it, and what is beyond the bound is taken off",
          "[actuator]")
{
    for (const double fs : {2000.0, 8000.0, 48000.0})
        for (const Resonance& actuator : {Resonance{67.0, 3.97}, Resonance{900.0, 3.0}, Resonance{990.0, 30.0},
                                          Resonance{1500.0, 2.0}, Resonance{300.0, 0.3}})
            for (const Resonance& target : {Resonance{40.0, 1.0}, Resonance{700.0, 8.0}, Resonance{980.0, 0.6}})
            {
                CAPTURE(fs, actuator.frequency, actuator.q, target.frequency, target.q);
                const auto inverse = designPolePairInverse(actuator, target, fs);
                const Flattening flattening{actuator, target, 1.0, 2.0, 0.0};
                double highest = std::max(std::abs(inverse.response(Hertz(0.0), fs)),
                                          std::abs(inverse.response(Hertz(0.5 * fs), fs)));
                for (double f = 0.0; f < 0.5 * fs; f += fs / 40000.0)
                    highest = std::max(highest, std::abs(inverse.response(Hertz(f), fs)));
                CHECK(detail::highestGain(inverse, flattening, fs) == Approx(highest).epsilon(1e-3));
                CHECK(detail::highestGain(inverse, flattening, fs) >= highest * (1.0 - 1e-9));
                const auto filter = designOutputFilter({{}, flattening}, fs);
                const double wanted = highest > 2.0 ? 2.0 / highest : 1.0;
                for (const double f : {0.0, 300.0, 900.0})
                    CHECK(std::abs(filter.response(Hertz(f), fs)) ==
                          Approx(wanted * std::abs(inverse.response(Hertz(f), fs))).epsilon(1e-3));
            }
}

TEST_CASE("The loaded resonance of a body stays as it was", "[actuator]")
{
    for (const double q : {0.2, 0.5, 4.0, 100.0})
    {
        std::vector<double> numbers;
        for (const double stiffness : {500.0, 4e4, 1e9})
            for (const bool light : {false, true})
            {
                BodyParams body;
                body.jointStiffness = stiffness;
                if (light)
                {
                    body.deviceMass = 0.001;
                    body.movingMass = 0.03;
                }
                const Resonance loaded = loadedResonance(body, {80.0, q});
                numbers.push_back(std::log(loaded.frequency));
                numbers.push_back(std::log(loaded.q));
            }
        checkPinned("actuator/loaded resonance, " + std::to_string(q), numbers, 1e-6);
    }
}

TEST_CASE("Pruning judges 20 to 1000 Hz by a tenth of a decibel, up to 0.49 of the sample rate", "[actuator]")
{
    CHECK(PruningParams{}.lowFrequency == Hertz(20.0));
    CHECK(PruningParams{}.highFrequency == Hertz(1000.0));
    CHECK(PruningParams{}.tolerance == Decibels(0.1));
    CHECK(PrunedEqualizer{}.predictedError == 0.0);
    CHECK(DroppedSection{} == DroppedSection{0, 0.0});
    const auto deviations = [](const EqualizerSections& sections, const PruningParams& params, double fs)
    {
        std::vector<double> numbers;
        const auto pruned = pruneEqualizer(sections, params, fs);
        for (const auto& one : pruned.dropped)
        {
            numbers.push_back(static_cast<double>(one.index));
            numbers.push_back(one.deviation);
        }
        numbers.push_back(pruned.predictedError);
        return numbers;
    };
    const EqualizerSections sections{
        {EqualizerType::highpass, 5.0, 0.0, 1.0, 2},     {EqualizerType::lowShelf, 12.0, 3.0, 0.7, 2},
        {EqualizerType::highShelf, 900.0, -2.0, 0.7, 2}, {EqualizerType::peak, 1500.0, 4.0, 5.0, 2},
        {EqualizerType::peak, 333.0, -1.5, 40.0, 2},     {EqualizerType::peak, 15.0, 5.0, 9.0, 2}};
    int index = 0;
    for (const PruningParams& params : {PruningParams{}, PruningParams{Hertz(100.0), Hertz(400.0), Decibels(2.0)},
                                        PruningParams{Hertz(900.0), Hertz(5000.0), Decibels(100.0)},
                                        PruningParams{Hertz(3000.0), Hertz(100.0), Decibels(100.0)}})
        for (const double fs : {2000.0, 48000.0})
            checkPinned("actuator/pruning " + std::to_string(index++), deviations(sections, params, fs), 1e-6);
    // Exactly the tolerance is little enough.
    const EqualizerSections peak{{EqualizerType::peak, 333.0, 0.5, 1.0, 2}};
    const double deviation =
        pruneEqualizer(peak, {Hertz(20.0), Hertz(1000.0), Decibels(1.0)}, 48000.0).dropped[0].deviation;
    CHECK(deviation == Approx(0.5).epsilon(1e-9));
    CHECK(pruneEqualizer(peak, {Hertz(20.0), Hertz(1000.0), Decibels(deviation)}, 48000.0).kept.empty());
    CHECK(pruneEqualizer(peak, {Hertz(20.0), Hertz(1000.0), Decibels(deviation - 1e-9)}, 48000.0).kept == peak);
}
