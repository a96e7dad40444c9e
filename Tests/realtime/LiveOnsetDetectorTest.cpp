#include "support/Catch.h"

#include <pacini/realtime/LiveOnsetDetector.h>

#include <algorithm>
#include <cstddef>
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
