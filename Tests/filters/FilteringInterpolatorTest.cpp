#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"

#include <pacini/filters/Butterworth.h>
#include <pacini/filters/FilteringInterpolator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

/// `count` sections of all kinds, with resonances.
BiquadCascadeCoefficients someSections(std::size_t count, double fs)
{
    BiquadCascadeCoefficients cascade;
    for (const auto& section : designButterworth({ButterworthType::highpass, 4, 20_Hz, 0_Hz}, fs).sections)
        if (cascade.sections.size() < count)
            cascade.sections.pushBack(section);
    while (cascade.sections.size() < count)
    {
        const auto i = static_cast<double>(cascade.sections.size());
        const Decibels gain(cascade.sections.size() % 2 == 0 ? 12.0 : -9.0);
        cascade.sections.pushBack(designStateVariable({BiquadType::peak, Hertz(30.0 * i), 4.0, gain}, fs));
    }
    return cascade;
}

/// What the interpolator and the cascade put out one after the other, in double.
std::vector<double> oneAfterTheOther(std::size_t factor, double pass, const BiquadCascadeCoefficients& cascade,
                                     const std::vector<float>& x, const std::vector<float>& added,
                                     FilteringInterpolator::Counted counted)
{
    PolyphaseInterpolator interpolator(factor, pass);
    std::vector<float> raised(x.size() * factor);
    interpolator.process(x, raised);
    std::vector<StateVariableState> states(cascade.sections.size());
    std::vector<double> out;
    for (std::size_t n = 0; n < raised.size(); ++n)
    {
        double y = n >= counted.from && n < counted.to ? static_cast<double>(raised[n]) : 0.0;
        if (!added.empty())
            y += static_cast<double>(added[n]);
        for (std::size_t k = 0; k < states.size(); ++k)
            y = states[k].tick(cascade.sections[k], y);
        out.push_back(y);
    }
    return out;
}

std::vector<float> filtered(FilteringInterpolator& interpolator, const std::vector<float>& x,
                            const std::vector<float>& added, FilteringInterpolator::Counted counted, std::size_t piece)
{
    const std::size_t factor = interpolator.factor();
    std::vector<float> out(x.size() * factor);
    for (std::size_t i = 0; i < x.size(); i += piece)
    {
        const std::size_t n = std::min(piece, x.size() - i);
        const std::size_t first = i * factor;
        const auto within = [&](std::size_t frame)
        {
            return std::clamp(frame, first, first + n * factor) - first;
        };
        interpolator.process(std::span(x).subspan(i, n),
                             added.empty() ? std::span<const float>{} : std::span(added).subspan(first, n * factor),
                             {within(counted.from), within(counted.to)}, std::span(out).subspan(first, n * factor));
    }
    return out;
}

} // namespace

TEST_CASE("An interpolator that filters puts out what an interpolator and a filter behind it do", "[filters]")
{
    for (const std::size_t factor : {1u, 2u, 5u, 12u, 48u})
        for (const std::size_t sections : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 9u})
        {
            CAPTURE(factor, sections);
            const double fs = 4000.0 * static_cast<double>(factor);
            const auto cascade = someSections(sections, fs);
            const auto x = noise(1500, 5 + factor);
            const FilteringInterpolator::Counted all{0, x.size() * factor};
            FilteringInterpolator interpolator(PolyphaseInterpolator(factor, 0.3), cascade);
            const auto found = filtered(interpolator, x, {}, all, x.size());
            const auto expected = oneAfterTheOther(factor, 0.3, cascade, x, {}, all);
            double most = 0.0, worst = 0.0;
            for (std::size_t n = 0; n < found.size(); ++n)
            {
                most = std::max(most, std::abs(expected[n]));
                worst = std::max(worst, std::abs(static_cast<double>(found[n]) - expected[n]));
            }
            CHECK(worst < 1.5e-6 * std::max(1.0, most));
        }
}

TEST_CASE("An interpolator that filters stays with the filter at stiff resonances and at the highest rate", "[filters]")
{
    // f0/fs down to 6.5e-7 and Q up to 1e4: a pole within 1e-10 of the unit circle.
    for (const double q : {10.0, 1e3, 1e4})
        for (const double frequency : {0.5, 65.9, 999.0})
        {
            CAPTURE(q, frequency);
            const std::size_t factor = 192;
            BiquadCascadeCoefficients cascade;
            cascade.sections.pushBack(
                designStateVariable({BiquadType::peak, Hertz(frequency), q, Decibels(24.0)}, 768000.0));
            cascade.sections.pushBack(
                designStateVariable({BiquadType::peak, Hertz(frequency), q, Decibels(-18.0)}, 768000.0));
            const auto x = noise(6000, 3);
            const FilteringInterpolator::Counted all{0, x.size() * factor};
            FilteringInterpolator interpolator(PolyphaseInterpolator(factor, 0.3), cascade);
            const auto found = filtered(interpolator, x, {}, all, 64);
            const auto expected = oneAfterTheOther(factor, 0.3, cascade, x, {}, all);
            double most = 0.0, worst = 0.0;
            for (std::size_t n = 0; n < found.size(); ++n)
            {
                REQUIRE(std::isfinite(found[n]));
                most = std::max(most, std::abs(expected[n]));
                worst = std::max(worst, std::abs(static_cast<double>(found[n]) - expected[n]));
            }
            CHECK(worst < 1.5e-6 * std::max(1.0, most));
        }
}

TEST_CASE("An interpolator that filters is cut and added to in any frame in front of the filter", "[filters]")
{
    for (const std::size_t factor : {1u, 3u, 12u})
    {
        const double fs = 4000.0 * static_cast<double>(factor);
        const auto cascade = someSections(5, fs);
        const auto x = noise(600, 9);
        std::vector<float> added(x.size() * factor, 0.0f);
        for (std::size_t n = 101; n < 140; ++n)
            added[n] = 0.5f;
        added[added.size() - 2 * factor - 1] = -1.0f;
        const FilteringInterpolator::Counted counted{4 * factor + 1, (x.size() - 100) * factor + factor / 2};
        FilteringInterpolator interpolator(PolyphaseInterpolator(factor, 0.3), cascade);
        const auto found = filtered(interpolator, x, added, counted, x.size());
        const auto expected = oneAfterTheOther(factor, 0.3, cascade, x, added, counted);
        for (std::size_t n = 0; n < found.size(); ++n)
        {
            CAPTURE(factor, n);
            REQUIRE(std::abs(static_cast<double>(found[n]) - expected[n]) < 3e-6);
        }
        // Neither pieces nor a reset show.
        for (const std::size_t piece : {1u, 7u, 64u})
        {
            interpolator.reset();
            CHECK((filtered(interpolator, x, added, counted, piece) == found));
        }
    }
}

TEST_CASE("An interpolator that filters rings to its end and is then silent, without heap traffic", "[filters]")
{
    const std::size_t factor = 12;
    const auto cascade = someSections(3, 48000.0);
    FilteringInterpolator interpolator(PolyphaseInterpolator(factor, 0.3), cascade);
    CHECK(interpolator.silent());
    CHECK(interpolator.latencyFrames() == PolyphaseInterpolator(factor, 0.3).latencyFrames());
    auto x = noise(64, 2);
    std::vector<float> out(x.size() * factor);
    const HeapGuard guard;
    interpolator.process(x, {}, {0, out.size()}, out);
    CHECK_FALSE(interpolator.silent());
    std::fill(x.begin(), x.end(), 0.0f);
    std::size_t calls = 0;
    for (; calls < 5000 && !interpolator.silent(); ++calls)
        interpolator.process(x, {}, {0, out.size()}, out);
    CHECK(calls > 2);
    CHECK(calls < 5000);
    interpolator.process(x, {}, {0, out.size()}, out);
    CHECK(guard.traffic() == 0);
    CHECK(std::all_of(out.begin(), out.end(), [](float y) { return y == 0.0f; }));
}
