#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/analysis/SlidingBuffer.h>

#include <cstdint>
#include <numeric>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("A sliding buffer begins with zeros and keeps every index while it slides", "[analysis]")
{
    SlidingBuffer<int> buffer(3, 10);
    CHECK(buffer.end() == 10);
    for (std::int64_t i = 7; i < 10; ++i)
        CHECK(*buffer.at(i) == 0);

    Random random(6);
    std::int64_t kept = 7;
    for (int round = 0; round < 2000; ++round)
    {
        const std::int64_t begin = buffer.end();
        const auto count = static_cast<std::ptrdiff_t>(random.next() % 50);
        int* added = buffer.extend(count);
        CHECK(std::all_of(added, added + count, [](int v) { return v == 0; }));
        std::iota(added, added + count, static_cast<int>(begin));
        REQUIRE(buffer.end() == begin + count);
        kept = std::max(kept, buffer.end() - static_cast<std::int64_t>(random.next() % 80));
        buffer.forget(kept);
        for (std::int64_t i = kept; i < buffer.end(); ++i)
            REQUIRE(*buffer.at(i) == (i < 10 ? 0 : static_cast<int>(i)));
    }
    buffer.forget(kept - 1000); // what is gone already
    CHECK(*buffer.at(buffer.end() - 1) == static_cast<int>(buffer.end() - 1));
}

TEST_CASE("A sliding buffer that forgets stops allocating", "[analysis]")
{
    SlidingBuffer<float> buffer(16);
    const auto slide = [&buffer](int rounds)
    {
        for (int i = 0; i < rounds; ++i)
        {
            buffer.extend(100);
            buffer.forget(buffer.end() - 250);
        }
    };
    slide(20);
    const HeapGuard guard;
    slide(10000);
    CHECK(guard.traffic() == 0);
    CHECK(buffer.end() == 1002000);
}

TEST_CASE("A sliding buffer counts on beyond 32 bits", "[analysis]")
{
    for (const std::int64_t start : {std::int64_t{1} << 31, std::int64_t{1} << 32, std::int64_t{1} << 50})
    {
        SlidingBuffer<int> buffer(4, start - 10);
        CAPTURE(start);
        CHECK(buffer.missingTo(start + 90) == 100);
        CHECK(buffer.missingTo(start - 11) == 0);
        int* added = buffer.extend(100);
        std::iota(added, added + 100, 0);
        CHECK(buffer.end() == start + 90);
        CHECK(*buffer.at(start - 11) == 0);
        CHECK(*buffer.at(start + 7) == 17);
        buffer.forget(start + 80);
        CHECK(buffer.end() == start + 90);
        CHECK(*buffer.at(start + 80) == 90);
        CHECK(buffer.missingTo(start + 90) == 0);
    }
}
