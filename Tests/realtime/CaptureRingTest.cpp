#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/realtime/CaptureRing.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

using namespace pacini;

namespace
{
std::vector<float> counted(std::size_t first, std::size_t frames)
{
    std::vector<float> x(frames);
    for (std::size_t i = 0; i < frames; ++i)
        x[i] = static_cast<float>((first + i) % 1000003 % 65536);
    return x;
}
} // namespace

TEST_CASE("a capture ring gives back the newest frames in order", "[realtime]")
{
    CaptureRing ring;
    CHECK(ring.newest(10).samples.empty());
    ring.prepare(100);
    CHECK(ring.newest(10).samples.empty());
    std::size_t pushed = 0;
    for (std::size_t block : {0u, 1u, 7u, 64u, 99u, 100u, 250u, 3u})
    {
        ring.push(counted(pushed, block));
        pushed += block;
        for (std::size_t wanted : {0u, 1u, 50u, 100u, 1000u})
        {
            const auto capture = ring.newest(wanted);
            const std::size_t expected = std::min({wanted, pushed, std::size_t(100)});
            REQUIRE(capture.samples.size() == expected);
            CHECK(capture.firstFrame == pushed - expected);
            CHECK(capture.samples == counted(pushed - expected, expected));
        }
    }
}

TEST_CASE("pushing to a capture ring does not touch the heap", "[realtime]")
{
    CaptureRing ring;
    ring.prepare(1000);
    const auto x = counted(0, 2500);
    const test::HeapGuard guard;
    ring.push(x);
    ring.reset();
    CHECK(guard.traffic() == 0);
}

TEST_CASE("copies made while the ring is written hold no torn frame", "[realtime]")
{
    // So large that the writer is faster than a copy now and then, on one processor too.
    constexpr std::size_t frames = 100'000;
    constexpr int wantedRaces = 30;
    CaptureRing ring;
    ring.prepare(frames);
    std::atomic<bool> stop{false};
    std::atomic<std::size_t> pushed{0};
    std::thread writer(
        [&]
        {
            std::size_t position = 0;
            while (!stop.load(std::memory_order_relaxed))
            {
                ring.push(counted(position, 512));
                pushed.store(position += 512);
            }
        });
    int torn = 0;
    int races = 0; // copies whose beginning was overwritten before they were complete
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (races < wantedRaces && torn == 0 && std::chrono::steady_clock::now() < deadline)
    {
        const bool full = pushed.load() >= frames;
        const auto capture = ring.newest(frames);
        torn += capture.samples != counted(static_cast<std::size_t>(capture.firstFrame), capture.samples.size());
        races += full && capture.samples.size() < frames;
    }
    stop.store(true);
    writer.join();
    CHECK(torn == 0);
    CHECK(races == wantedRaces);
}

TEST_CASE("a capture ring has room for one frame at least, and counts from its reset", "[realtime]")
{
    CaptureRing ring;
    CHECK(ring.capacityFrames() == 0);
    ring.push(counted(0, 3)); // nowhere to go yet
    CHECK(ring.newest(3).samples.empty());
    CHECK(ring.newest(3).firstFrame == 0);
    ring.prepare(0);
    CHECK(ring.capacityFrames() == 1);
    ring.push(counted(7, 1));
    CHECK(ring.newest(5).samples == counted(7, 1));
    ring.prepare(50);
    CHECK(ring.capacityFrames() == 50);
    CHECK(ring.newest(50).samples.empty());
    for (int round = 0; round < 3; ++round)
    {
        ring.push(counted(100, 30));
        ring.push(counted(130, 49));
        const auto capture = ring.newest(50);
        CHECK(capture.firstFrame == 29);
        CHECK(capture.samples == counted(129, 50));
        ring.reset();
        CHECK(ring.newest(50).samples.empty());
        CHECK(ring.newest(50).firstFrame == 0);
        ring.push(counted(3, 4));
        CHECK(ring.newest(50).firstFrame == 0);
        CHECK(ring.newest(50).samples == counted(3, 4));
        CHECK(ring.newest(3).firstFrame == 1);
        ring.reset();
    }
}
