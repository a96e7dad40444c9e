#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/filters/WholeDecimator.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
struct Decimated
{
    std::vector<float> frames, peaks;
    bool operator==(const Decimated&) const = default;
};

Decimated wholeDecimated(WholeDecimator& decimator, const std::vector<float>& in, std::size_t piece)
{
    Decimated result;
    for (std::size_t i = 0; i < in.size(); i += piece)
    {
        const std::size_t n = std::min(piece, in.size() - i);
        const std::size_t made = decimator.framesFor(n);
        std::vector<float> frames(made), peaks(made);
        decimator.process(std::span(in).subspan(i, n), frames, peaks);
        result.frames.insert(result.frames.end(), frames.begin(), frames.end());
        result.peaks.insert(result.peaks.end(), peaks.begin(), peaks.end());
    }
    return result;
}

/// The taps, by an impulse at each place between two frames.
std::vector<double> decimatorTaps(std::size_t factor, double fs, double pass)
{
    WholeDecimator decimator(factor, fs, pass);
    const std::size_t length = 2 * decimator.latencyFrames() + 1;
    std::vector<double> taps(length);
    for (std::size_t at = 0; at < factor; ++at)
    {
        decimator.reset();
        const auto found = wholeDecimated(decimator, test::impulse(at + length + factor, at), 512);
        for (std::size_t k = 0; k < found.frames.size(); ++k)
            if (k * factor >= at && k * factor - at < length)
                taps[k * factor - at] = static_cast<double>(found.frames[k]);
    }
    return taps;
}
} // namespace

TEST_CASE("a whole decimator passes what is asked for, and about 60 dB down lies what would fold onto it", "[realtime]")
{
    struct Rate
    {
        std::size_t factor;
        double fs, pass;
    };
    for (const auto& [factor, rate, pass] : {Rate{2, 12000.0, 1000.0},
                                             {7, 44100.0, 1000.0},
                                             {8, 48000.0, 1000.0},
                                             {3, 22050.0, 500.0},
                                             {128, 768000.0, 1000.0}})
    {
        const double fs = rate;
        CAPTURE(factor, fs, pass);
        const auto taps = decimatorTaps(factor, fs, pass);
        const std::size_t n = taps.size();
        REQUIRE(n % 2 == 1);
        double sum = 0.0;
        for (std::size_t i = 0; i < n; ++i)
        {
            CHECK(taps[i] == Approx(taps[n - 1 - i]).margin(1e-6)); // linear phase
            sum += taps[i];
        }
        CHECK(sum == Approx(1.0).epsilon(1e-6));
        const auto level = [&](double f)
        {
            return 20.0 * std::log10(std::abs(test::spectrumAt(std::span<const double>(taps), f, fs)));
        };
        const double inner = fs / static_cast<double>(factor);
        for (const double share : {0.1, 0.5, 0.9, 1.0})
        {
            CHECK(std::abs(level(share * pass)) < 0.05);
            for (double multiple = 1.0; multiple * inner + pass < 0.5 * fs && multiple < 5.0; multiple += 1.0)
            {
                CHECK(level(multiple * inner - share * pass) < -56.5);
                CHECK(level(multiple * inner + share * pass) < -56.5);
            }
        }
        CHECK(level(0.5 * inner) == Approx(-6.02).margin(0.1));
        // Kaiser's length, (A - 7.95) / (14.36 width) + 1, made odd.
        const double width = (inner - 2.0 * pass) / fs;
        CHECK(static_cast<double>(n) >= (60.0 - 7.95) / (14.36 * width));
        CHECK(static_cast<double>(n) < (60.0 - 7.95) / (14.36 * width) + 3.0);
    }
    checkPinned("realtime/whole decimator, taps at 48 kHz", decimatorTaps(8, 48000.0, 1000.0), 2e-6);
    checkPinned("realtime/whole decimator, taps at 12 kHz", decimatorTaps(2, 12000.0, 1000.0), 2e-6);
}

TEST_CASE("a whole decimator by one gives the input back, and as peaks its magnitudes", "[realtime]")
{
    WholeDecimator decimator;
    CHECK(decimator.factor() == 1);
    CHECK(decimator.latencyFrames() == 0);
    const auto x = test::noise(9000, 5);
    const auto found = wholeDecimated(decimator, x, 700);
    CHECK(found.frames == x);
    REQUIRE(found.peaks.size() == x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        REQUIRE(found.peaks[i] == std::abs(x[i]));
}

TEST_CASE("a whole decimator makes frame k when input k times its factor comes, however the input is cut", "[realtime]")
{
    for (const std::size_t factor : {1u, 2u, 5u, 8u})
    {
        const double fs = 6000.0 * static_cast<double>(factor);
        WholeDecimator decimator(factor, fs, 1000.0);
        CHECK(decimator.factor() == factor);
        CHECK(decimator.framesFor(0) == 0);
        CHECK(decimator.framesFor(1) == 1);
        CHECK(decimator.framesFor(factor) == 1);
        CHECK(decimator.framesFor(factor + 1) == 2);
        CHECK(decimator.framesFor(10 * factor + 1) == 11);
        const auto x = test::noise(12000, 5);
        const auto whole = wholeDecimated(decimator, x, 1024);
        CHECK(whole.frames.size() == (x.size() - 1) / factor + 1);
        for (const std::size_t piece : {1u, 3u, 7u, 64u, 1000u})
        {
            CAPTURE(factor, piece);
            decimator.reset();
            CHECK(wholeDecimated(decimator, x, piece) == whole);
        }
        // The definition: each frame is a sum over the newest inputs, each peak that of the inputs since the last
        // frame.
        const auto taps = decimatorTaps(factor, fs, 1000.0);
        for (std::size_t k = 0; k < whole.frames.size(); ++k)
        {
            double sum = 0.0;
            for (std::size_t i = 0; i < taps.size() && i <= k * factor; ++i)
                sum += taps[i] * static_cast<double>(x[k * factor - i]);
            REQUIRE(static_cast<double>(whole.frames[k]) == Approx(sum).margin(2e-6));
            float peak = 0.0f;
            for (std::size_t i = k == 0 ? 0 : (k - 1) * factor + 1; i <= k * factor; ++i)
                peak = std::max(peak, std::abs(x[i]));
            REQUIRE(whole.peaks[k] == peak);
        }
    }
}

TEST_CASE("a whole decimator takes what is not finite for 0, limits to 100, and makes exact zeros of silence",
          "[realtime]")
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    WholeDecimator one;
    const auto found = wholeDecimated(
        one, {nan, inf, -inf, 99.5f, 100.5f, -100.5f, -3e38f, 3e38f, 0.25f, std::numeric_limits<float>::max()}, 10);
    CHECK(found.frames == std::vector<float>{0.0f, 0.0f, 0.0f, 99.5f, 100.0f, -100.0f, -100.0f, 100.0f, 0.25f, 100.0f});
    CHECK(found.peaks == std::vector<float>{0.0f, 0.0f, 0.0f, 99.5f, 100.0f, 100.0f, 100.0f, 100.0f, 0.25f, 100.0f});

    // As long as one tap lies on a sound there is a frame of it, then none.
    const std::size_t factor = 4;
    WholeDecimator decimator(factor, 24000.0, 1000.0);
    const auto taps = decimatorTaps(factor, 24000.0, 1000.0);
    for (std::size_t at = 0; at < factor; ++at)
    {
        decimator.reset();
        auto x = std::vector<float>(40 * factor, 0.0f);
        x[20 + at] = 1.0f;
        const auto frames = wholeDecimated(decimator, x, 9).frames;
        for (std::size_t k = 0; k < frames.size(); ++k)
        {
            const std::size_t n = k * factor;
            const bool reached = n >= 20 + at && n - 20 - at < taps.size();
            CAPTURE(at, k);
            REQUIRE(static_cast<double>(frames[k]) == (reached ? taps[n - 20 - at] : 0.0));
        }
    }
}

TEST_CASE("what the filter removes has its power on demand, tones at multiples of the inner rate too", "[realtime]")
{
    for (const std::size_t factor : {2u, 7u, 8u, 16u, 32u})
    {
        const double fs = 6000.0 * static_cast<double>(factor);
        const auto powerOf = [&](const std::vector<float>& x, std::size_t piece)
        {
            WholeDecimator decimator(factor, fs, 1000.0);
            double sum = 0.0;
            std::size_t count = 0;
            for (std::size_t i = 0; i < x.size(); i += piece)
            {
                const std::size_t n = std::min(piece, x.size() - i);
                const std::size_t made = decimator.framesFor(n);
                std::vector<float> frames(made), peaks(made), highs(made);
                decimator.process(std::span(x).subspan(i, n), frames, peaks, highs);
                for (std::size_t k = 0; k < made; ++k)
                    if (++count > 100)
                        sum += static_cast<double>(highs[k]) * static_cast<double>(highs[k]);
            }
            return sum / static_cast<double>(count - 100);
        };
        for (const double f : {100.0, 900.0, 6000.0, 12000.0, 12003.0, 17000.0, 36000.0})
        {
            if (f > 0.45 * fs)
                continue;
            CAPTURE(factor, f);
            const auto x = test::sine(static_cast<std::size_t>(0.5 * fs), f, fs, 1.0);
            const double power = powerOf(x, 500);
            CHECK(power == (f < 1000.0 ? Approx(0.0).margin(2e-5) : Approx(0.5).epsilon(0.03)));
            CHECK(powerOf(x, 64) == Approx(power));
        }
    }
}

TEST_CASE("A short noise that the filter removes has the same energy wherever it falls among the frames", "[realtime]")
{
    for (const std::size_t factor : {2u, 7u, 8u, 32u})
    {
        const double fs = 6000.0 * static_cast<double>(factor);
        double weakest = 1e9, strongest = 0.0;
        for (std::size_t begin = 0; begin < 2 * factor; ++begin)
        {
            auto x = std::vector<float>(begin + 100 * factor, 0.0f);
            const auto burst = test::noise(30 * factor, 5);
            std::copy(burst.begin(), burst.end(), x.begin() + static_cast<std::ptrdiff_t>(begin + 20 * factor));
            WholeDecimator decimator(factor, fs, 1000.0);
            std::vector<float> frames(decimator.framesFor(x.size())), peaks(frames.size()), highs(frames.size());
            decimator.process(x, frames, peaks, highs);
            double energy = 0.0;
            for (const float level : highs)
                energy += static_cast<double>(level) * static_cast<double>(level);
            weakest = std::min(weakest, energy);
            strongest = std::max(strongest, energy);
        }
        CAPTURE(factor, weakest, strongest);
        CHECK(strongest < 1.0001 * weakest);
    }
}

TEST_CASE("a reset whole decimator is a new one, and processing makes no heap traffic", "[realtime]")
{
    const auto x = test::noise(5000, 5);
    WholeDecimator fresh(6, 36000.0, 1000.0);
    const auto expected = wholeDecimated(fresh, x, 512);
    for (const std::size_t before : {1u, 5u, 6u, 400u, 4400u})
    {
        WholeDecimator decimator(6, 36000.0, 1000.0);
        (void)wholeDecimated(decimator, std::vector<float>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(before)),
                             512);
        decimator.reset();
        CHECK(wholeDecimated(decimator, x, 512) == expected);
    }
    std::vector<float> frames(fresh.framesFor(1024)), peaks(frames.size());
    const test::HeapGuard guard;
    fresh.process(std::span(x).first(1024), frames, peaks);
    fresh.reset();
    CHECK(guard.traffic() == 0);
}
