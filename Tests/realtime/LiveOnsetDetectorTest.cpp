#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/realtime/LiveOnsetDetector.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
struct Report
{
    std::size_t frame;
    HeardEvent event;
};

std::vector<Report> reports(LiveOnsetDetector& detector, const std::vector<double>& levels)
{
    std::vector<Report> found;
    HeardEvent event;
    for (std::size_t n = 0; n < levels.size(); ++n)
        if (detector.tick(levels[n], 1.0, event))
            found.push_back({n, event});
    return found;
}
} // namespace

TEST_CASE("an onset is reported a millisecond late with its peak until then and the gap before it", "[realtime]")
{
    for (const double fs : {6000.0, 8000.0, 12000.0})
    {
        CAPTURE(fs);
        LiveOnsetDetector detector;
        detector.prepare(fs);
        const auto wait = static_cast<std::size_t>(0.001 * fs);
        CHECK(detector.delayFrames() == wait + 1);
        // Silence, then clicks that rise and fall; what comes later than the wait belongs to none.
        const std::size_t first = 1000, second = first + 3001;
        std::vector<double> levels(second + 100, 0.0);
        for (const std::size_t at : {first, second})
        {
            const double size = at == first ? 1.0 : 0.5;
            levels[at] = 0.4 * size;
            levels[at + 1] = 0.6 * size;
            levels[at + 3] = 0.9 * size;
            levels[at + 4] = 0.3 * size;
            levels[at + wait + 2] = size;
        }
        const auto found = reports(detector, levels);
        REQUIRE(found.size() == 2);
        CHECK(found[0].frame == first + detector.delayFrames());
        CHECK(found[0].event.amplitude == 0.9);
        CHECK(found[0].event.gap > 60.0); // none before it
        CHECK(found[1].frame == second + detector.delayFrames());
        CHECK(found[1].event.amplitude == 0.45);
        CHECK(found[1].event.gap == 3001.0 / fs);

        detector.reset();
        const auto again = reports(detector, levels);
        REQUIRE(again.size() == 2);
        CHECK(again[0].event.gap == found[0].event.gap);
        CHECK(again[1].event.gap == found[1].event.gap);
    }
}

TEST_CASE("an onset within ten milliseconds of another one waits until they are over", "[realtime]")
{
    const double fs = 6000.0;
    for (const std::size_t apart : {50u, 59u, 60u, 61u, 90u})
    {
        CAPTURE(apart);
        LiveOnsetDetector detector;
        detector.prepare(fs);
        std::vector<double> levels(300, 0.2);
        std::fill_n(levels.begin(), 100, 0.0);
        std::fill(levels.begin() + static_cast<std::ptrdiff_t>(100 + apart), levels.end(), 50.0);
        const auto found = reports(detector, levels);
        REQUIRE(found.size() == 2);
        CHECK(found[0].frame == 100 + detector.delayFrames());
        const std::size_t begins = std::max<std::size_t>(apart, 60);
        CHECK(found[1].frame == 100 + begins + detector.delayFrames());
        CHECK(found[1].event.gap == static_cast<double>(begins) / fs);
    }
}

TEST_CASE("a level that stays is no onset, nor is one that comes slowly", "[realtime]")
{
    LiveOnsetDetector detector;
    detector.prepare(6000.0);
    CHECK(reports(detector, std::vector<double>(6000, 0.5)).size() == 1);
    detector.reset();
    std::vector<double> slow(60000);
    for (std::size_t n = 0; n < slow.size(); ++n)
        slow[n] = static_cast<double>(n) / static_cast<double>(slow.size());
    CHECK(reports(detector, slow).empty());
}

TEST_CASE("the onsets of an uneven level are where they were before, at every threshold", "[realtime]")
{
    for (const double fs : {6000.0, 11025.0})
    {
        // Rises of many heights and slopes above a ground that moves.
        Random random(31);
        std::vector<double> levels(static_cast<std::size_t>(2.0 * fs));
        double rise = 0.0, ground = 0.1, slope = 0.0;
        for (std::size_t n = 0; n < levels.size(); ++n)
        {
            if (n % static_cast<std::size_t>(0.023 * fs) == 0)
            {
                rise = random.uniform(0.0, 1.0);
                slope = std::exp(-1.0 / (fs * std::exp(random.uniform(std::log(0.0003), std::log(0.02)))));
                ground = random.uniform(0.001, 0.1);
            }
            const double before = n > 0 ? levels[n - 1] : 0.0;
            const double to =
                n % static_cast<std::size_t>(0.023 * fs) < static_cast<std::size_t>(0.009 * fs) ? rise : ground;
            levels[n] = to + slope * (before - to);
        }
        LiveOnsetDetector detector;
        detector.prepare(fs);
        std::vector<double> all;
        for (const double threshold : {0.15, 0.3, 0.5, 0.8, 1.2, 2.0, 3.5, 6.0, 10.0})
        {
            detector.reset();
            HeardEvent event;
            for (std::size_t n = 0; n < levels.size(); ++n)
            {
                if (detector.tick(levels[n], threshold, event))
                {
                    all.push_back(static_cast<double>(n));
                    all.push_back(1000.0 * event.amplitude);
                    all.push_back(1000.0 * std::min(event.gap, 1.0));
                }
                if (n % 8 == 7)
                    detector.flush();
            }
        }
        CHECK(all.size() > 300);
        checkPinned("realtime/onsets at " + std::to_string(static_cast<int>(fs)) + " Hz", all, 1e-7);
    }
}

TEST_CASE("a reset onset detector is a new one", "[realtime]")
{
    std::vector<double> levels(2000);
    for (std::size_t n = 0; n < levels.size(); ++n)
        levels[n] = n % 170 < 20 ? 0.6 : 0.02;
    LiveOnsetDetector fresh;
    fresh.prepare(6000.0);
    const auto expected = reports(fresh, levels);
    REQUIRE(expected.size() > 5);
    for (const std::size_t before : {1u, 3u, 8u, 25u, 171u, 500u})
    {
        LiveOnsetDetector used;
        used.prepare(6000.0);
        (void)reports(used, std::vector<double>(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(before)));
        used.reset();
        const auto found = reports(used, levels);
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i)
        {
            CHECK(found[i].frame == expected[i].frame);
            CHECK(found[i].event.amplitude == expected[i].event.amplitude);
            CHECK(found[i].event.gap == expected[i].event.gap);
        }
    }
    CHECK(LiveOnsetDetector::peakWait == 0.001);
    CHECK(LiveOnsetDetector::deadTime == 0.010);
}
