#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/analysis/OnsetDecimator.h>
#include <pacini/analysis/OnsetOctaves.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
std::vector<double> allOf(const SlidingBuffer<float>& buffer, std::int64_t begin = 0)
{
    return {buffer.at(begin), buffer.at(begin) + (buffer.end() - begin)};
}

std::vector<float> toneAt(double f, double fs, std::size_t count)
{
    std::vector<float> x(count);
    for (std::size_t n = 0; n < count; ++n)
        x[n] = static_cast<float>(std::cos(2.0 * std::numbers::pi * f * static_cast<double>(n) / fs));
    return x;
}
} // namespace

TEST_CASE("The rate of the highest band is halved until it is below 40 kHz", "[analysis][onsets]")
{
    for (const auto& [fs, stage] : {std::pair{2000.0, 2000.0},
                                    {39999.0, 39999.0},
                                    {40000.0, 20000.0},
                                    {44100.0, 22050.0},
                                    {79998.0, 39999.0},
                                    {80000.0, 20000.0},
                                    {768000.0, 24000.0}})
        CHECK(OnsetDecimator(fs, 0).stageRate() == stage);
}

TEST_CASE("Impulses and noise come out of the decimation as they did", "[analysis][onsets]")
{
    for (const double fs : {2000.0, 7200.0, 16000.0, 39000.0, 44100.0, 96000.0, 384000.0})
    {
        const std::string name = "analysis/decimation from " + std::to_string(static_cast<int>(fs));
        for (const std::size_t at : {0u, 301u})
        {
            OnsetDecimator decimator(fs, 1000000);
            std::vector<float> impulse(700);
            impulse[at] = 1.0f;
            decimator.push(impulse.data(), 1, std::ssize(impulse), 0.0f);
            CHECK(decimator.input().end() == 700);
            checkPinned(name + ", base of an impulse at " + std::to_string(at), allOf(decimator.base()), 1e-5);
            checkPinned(name + ", stage of an impulse at " + std::to_string(at), allOf(decimator.stage()), 1e-5);
        }
        OnsetDecimator decimator(fs, 1000000);
        const auto x = test::noise(4000, 15);
        decimator.push(x.data(), 1, std::ssize(x), 0.0f);
        checkPinned(name + ", base of noise", allOf(decimator.base()), 1e-5);
        checkPinned(name + ", stage of noise", allOf(decimator.stage()), 1e-5);
    }
}

TEST_CASE("Decimated tones stay where they are in time and as strong as they were", "[analysis][onsets]")
{
    for (const double fs : {7200.0, 22050.0, 48000.0, 192000.0})
    {
        OnsetDecimator decimator(fs, 1000000);
        const auto x = toneAt(300.0, fs, static_cast<std::size_t>(0.1 * fs));
        decimator.push(x.data(), 1, std::ssize(x), 0.0f);
        CAPTURE(fs);
        REQUIRE(decimator.base().end() > 650);
        for (std::int64_t i = 40; i < decimator.base().end() - 10; ++i)
            REQUIRE(*decimator.base().at(i) ==
                    Approx(std::cos(2.0 * std::numbers::pi * 300.0 * static_cast<double>(i) / 7200.0)).margin(0.02));
        for (std::int64_t i = 40; i < decimator.stage().end(); ++i)
            REQUIRE(*decimator.stage().at(i) ==
                    Approx(std::cos(2.0 * std::numbers::pi * 300.0 * static_cast<double>(i) / decimator.stageRate()))
                        .margin(0.01));
    }
}

TEST_CASE("Strided samples and offsets are taken as they are told", "[analysis][onsets]")
{
    const auto x = test::noise(900, 15);
    OnsetDecimator strided(16000.0, 100000), plain(16000.0, 100000);
    strided.push(x.data() + 1, 3, 300, 0.25f);
    std::vector<float> own;
    for (std::size_t i = 0; i < 300; ++i)
        own.push_back(x[3 * i + 1] - 0.25f);
    plain.push(own.data(), 1, 300, 0.0f);
    CHECK(allOf(strided.input()) == allOf(plain.input()));
    CHECK(allOf(strided.base()) == allOf(plain.base()));
    OnsetDecimator offset(16000.0, 100000);
    offset.push(x.data(), 1, 900, -0.5f);
    CHECK(*offset.input().at(7) == x[7] + 0.5f);
}

TEST_CASE("What is forgotten in time does not show in the decimation, whatever the pieces", "[analysis][onsets]")
{
    for (const double fs : {2000.0, 30000.0, 48000.0, 200000.0})
    {
        const auto x = test::noise(20000, 15);
        OnsetDecimator whole(fs, 1000000);
        whole.push(x.data(), 1, std::ssize(x), 0.0f);
        for (const std::ptrdiff_t piece : {1, 333, 2500})
        {
            OnsetDecimator decimator(fs, 50);
            std::vector<double> base, stage;
            std::int64_t baseRead = 0;
            std::int64_t stageRead = 0;
            for (std::ptrdiff_t i = 0; i < std::ssize(x); i += piece)
            {
                decimator.push(x.data() + i, 1, std::min(piece, std::ssize(x) - i), 0.0f);
                const auto more = allOf(decimator.base(), baseRead);
                base.insert(base.end(), more.begin(), more.end());
                const auto moreStage = allOf(decimator.stage(), stageRead);
                stage.insert(stage.end(), moreStage.begin(), moreStage.end());
                baseRead = decimator.base().end();
                stageRead = decimator.stage().end();
                decimator.forget(decimator.input().end(), stageRead, baseRead);
            }
            CAPTURE(fs, piece);
            CHECK(base == allOf(whole.base()));
            CHECK(stage == allOf(whole.stage()));
            // The last samples of the input are there for whoever mirrors them.
            for (std::ptrdiff_t i = 0; i < 50; ++i)
                CHECK(*decimator.input().at(decimator.input().end() - 1 - i) ==
                      x[x.size() - 1 - static_cast<std::size_t>(i)]);
        }
    }
}

TEST_CASE("Octaves of an impulse and of noise are what they were", "[analysis][onsets]")
{
    SlidingBuffer<float> base(32);
    OnsetOctaves octaves;
    const auto x = test::noise(3001, 15);
    std::copy(x.begin(), x.end(), base.extend(3001));
    octaves.extend(base);
    for (std::size_t i = 0; i < OnsetOctaves::splits; ++i)
        checkPinned("analysis/octave " + std::to_string(i) + " of noise", allOf(octaves.high(i)), 1e-5);
    checkPinned("analysis/octaves, low of noise", allOf(octaves.low()), 1e-5);
    checkPinned("analysis/octaves, lowest of noise", allOf(octaves.lowest()), 1e-5);

    SlidingBuffer<float> impulse(32);
    OnsetOctaves split;
    impulse.extend(100)[50] = 1.0f;
    split.extend(impulse);
    // The maximally flat half-band low-pass and its complement.
    const double taps[] = {-1.0, 0.0, 9.0, 16.0, 9.0, 0.0, -1.0};
    for (std::ptrdiff_t i = 0; i < 7; ++i)
    {
        CHECK(*split.low().at(47 + i) == Approx(taps[i] / 32.0).margin(1e-9));
        CHECK(*split.high(0).at(47 + i) == Approx((i == 3 ? 1.0 : 0.0) - taps[i] / 32.0).margin(1e-9));
    }
    CHECK(split.low().end() == 97);
}

TEST_CASE("Low and high parts of every octave add up, and pieces do not show", "[analysis][onsets]")
{
    const auto x = test::noise(6000, 15);
    SlidingBuffer<float> whole(32);
    OnsetOctaves expected;
    std::copy(x.begin(), x.end(), whole.extend(6000));
    expected.extend(whole);
    for (std::int64_t i = 0; i < expected.high(0).end(); ++i)
        REQUIRE(*expected.high(0).at(i) + *expected.low().at(i) == Approx(x[static_cast<std::size_t>(i)]).margin(1e-6));

    for (const std::ptrdiff_t piece : {8, 100, 1111})
    {
        SlidingBuffer<float> base(32);
        OnsetOctaves octaves;
        std::int64_t next = 0;
        bool same = true;
        for (std::ptrdiff_t i = 0; i < 6000; i += piece)
        {
            const auto n = std::min<std::ptrdiff_t>(piece, 6000 - i);
            std::copy_n(x.begin() + i, n, base.extend(n));
            octaves.extend(base);
            for (; next + 18 <= octaves.lowest().end(); ++next)
            {
                same = same && *octaves.lowest().at(next) == *expected.lowest().at(next);
                same = same && *octaves.lowest().at(next - 1) == *expected.lowest().at(next - 1);
                for (std::size_t b = 0; b < OnsetOctaves::splits; ++b)
                {
                    const auto at = OnsetOctaves::samplesPerFrame[b] * next;
                    same = same && *octaves.high(b).at(at) == *expected.high(b).at(at) &&
                           *octaves.high(b).at(at - 1) == *expected.high(b).at(at - 1);
                }
                same = same && *octaves.low().at(8 * next) == *expected.low().at(8 * next);
            }
            const auto before = octaves.forget(next);
            CHECK(before <= 8 * next);
            base.forget(before);
        }
        CAPTURE(piece);
        CHECK(same);
        CHECK(octaves.lowest().end() == expected.lowest().end());
    }
}

TEST_CASE("Short sums are the sums of all their terms", "[analysis][onsets]")
{
    const auto x = test::noise(70, 15);
    for (std::ptrdiff_t count = 0; count <= 53; ++count)
    {
        double squares = 0.0;
        double bends = 0.0;
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            const auto at = [&](std::ptrdiff_t j)
            {
                return static_cast<double>(x[static_cast<std::size_t>(j + 1)]);
            };
            squares += at(i) * at(i);
            const double bend = at(i - 1) - 2.0 * at(i) + at(i + 1);
            bends += bend * bend;
        }
        CHECK(static_cast<double>(detail::sumOfSquares(x.data() + 1, count)) ==
              Approx(squares).epsilon(1e-5).margin(0.0));
        CHECK(static_cast<double>(detail::sumOfSquaredBends(x.data() + 1, count)) ==
              Approx(bends).epsilon(1e-5).margin(0.0));
        if (count % 4 == 0)
        {
            double product = 0.0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                product += static_cast<double>(x[i]) * static_cast<double>(x[i + 9]);
            CHECK(static_cast<double>(detail::dotOfFours(x.data(), x.data() + 9, count)) ==
                  Approx(product).margin(1e-5));
        }
    }
    double eight = 0.0;
    for (std::size_t i = 0; i < 8; ++i)
        eight += static_cast<double>(x[i]);
    CHECK(static_cast<double>(detail::sumOfEight(x.data())) == Approx(eight).margin(1e-5));
}
