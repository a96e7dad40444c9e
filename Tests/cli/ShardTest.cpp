#include "cli/Shard.h"

#include "support/Catch.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

using namespace pacini::cli;

TEST_CASE("A shard is read as it is written", "[cli]")
{
    const auto shard = parseShard("3/8");
    REQUIRE(shard.ok());
    CHECK(shard->number == 3);
    CHECK(shard->count == 8);
    for (const char* text :
         {"", "3", "/", "3/", "/8", "0/8", "9/8", "-1/8", "1/0", "1/8/2", "a/b", "1/1000001", "1.5/2"})
    {
        CAPTURE(text);
        CHECK_FALSE(parseShard(text).ok());
    }
}

TEST_CASE("Every file is in exactly one shard, and shards are as even as the largest file allows", "[cli]")
{
    std::mt19937_64 random(7);
    std::lognormal_distribution<double> lengths(12.0, 1.5);
    for (const unsigned count : {1u, 2u, 3u, 8u, 64u})
        for (const std::size_t files : {std::size_t(0), std::size_t(1), std::size_t(7), std::size_t(1000)})
        {
            CAPTURE(count, files);
            std::vector<std::uint64_t> sizes(files);
            for (auto& size : sizes)
                size = static_cast<std::uint64_t>(lengths(random));
            std::vector<unsigned> times(files, 0);
            std::vector<std::uint64_t> loads;
            for (unsigned number = 1; number <= count; ++number)
            {
                const auto chosen = filesOfShard(sizes, {number, count});
                REQUIRE(chosen.size() == files);
                CHECK(chosen == filesOfShard(sizes, {number, count}));
                std::uint64_t load = 0;
                for (std::size_t i = 0; i < files; ++i)
                    if (chosen[i])
                    {
                        ++times[i];
                        load += sizes[i] + 4096;
                    }
                loads.push_back(load);
            }
            CHECK(std::all_of(times.begin(), times.end(), [](unsigned n) { return n == 1; }));
            // Graham (1969): no division is better than the mean and the largest file, and this one is within 4/3 of
            // it.
            const auto total = std::accumulate(loads.begin(), loads.end(), std::uint64_t(0));
            std::uint64_t largest = 0;
            for (const auto size : sizes)
                largest = std::max(largest, size + 4096);
            const double bound = std::max(static_cast<double>(total) / count, static_cast<double>(largest));
            CHECK(static_cast<double>(*std::max_element(loads.begin(), loads.end())) <=
                  bound + static_cast<double>(files > count ? largest : 0) / 3.0 + 1.0);
        }
}
