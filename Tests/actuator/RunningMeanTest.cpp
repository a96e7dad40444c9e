#include "support/Catch.h"

#include <pacini/actuator/RunningMean.h>
#include <pacini/foundation/Random.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;

namespace
{

std::vector<double> powers(std::size_t count)
{
    Random random(4);
    std::vector<double> x(count);
    for (double& v : x)
        v = random.uniform();
    return x;
}

} // namespace

TEST_CASE("A running mean follows by groups to the very numbers of single steps", "[actuator][protection]")
{
    const auto x = powers(4000);
    for (const double leak : {0.3, 1e-3, 1e-9})
    {
        CAPTURE(leak);
        RunningMean single;
        RunningMean grouped;
        single.design(leak);
        grouped.design(leak);
        for (std::size_t i = 0; i < x.size(); i += groupFrames)
        {
            FrameGroup means = grouped.followGroup(groupAt(x, i));
            for (std::size_t k = 0; k < groupFrames; ++k)
            {
                single.follow(x[i + k]);
                REQUIRE(single.value() == means[k]);
            }
        }
    }
}

TEST_CASE("Two running means side by side have the very numbers of each alone", "[actuator][protection]")
{
    const auto x = powers(2000), y = powers(4000);
    for (const double leak : {0.3, 1e-3, 0.0})
    {
        CAPTURE(leak);
        RunningMean first, second, together, beside;
        for (RunningMean* mean : {&first, &second, &together, &beside})
            mean->design(leak);
        for (std::size_t i = 0; i < x.size(); i += groupFrames)
        {
            std::array<Pair, groupFrames> pairs;
            for (std::size_t k = 0; k < groupFrames; ++k)
                pairs[k] = Pair(x[i + k], -y[2000 + i + k]);
            const auto means = RunningMean::followGroups(together, beside, pairs);
            for (std::size_t k = 0; k < groupFrames; ++k)
            {
                first.follow(x[i + k]);
                second.follow(-y[2000 + i + k]);
                REQUIRE(means[k].first() == first.value());
                REQUIRE(means[k].second() == second.value());
            }
            REQUIRE(together.value() == first.value());
            REQUIRE(beside.value() == second.value());
        }
    }
}

TEST_CASE("A running mean is exact for leaks of any size", "[actuator][protection]")
{
    const auto x = powers(40000);
    for (const double leak : {0.5, 1e-2, 1e-6, 1e-10})
    {
        CAPTURE(leak);
        RunningMean mean;
        mean.design(leak);
        long double expected = 0.0L;
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            mean.follow(x[i]);
            expected += static_cast<long double>(leak) * (static_cast<long double>(x[i]) - expected);
            REQUIRE(std::abs(static_cast<double>(static_cast<long double>(mean.value()) / expected - 1.0L)) < 1e-12);
        }
    }
}

TEST_CASE("A running mean goes on where a new leak finds it", "[actuator][protection]")
{
    RunningMean mean;
    mean.design(0.1);
    mean.follow(1.0);
    mean.follow(0.5);
    const double before = mean.value();
    CHECK(before == Approx(0.14).epsilon(1e-14));
    mean.design(0.01);
    CHECK(mean.value() == before);
    mean.follow(1.0);
    CHECK(mean.value() == Approx(0.14 + 0.01 * 0.86).epsilon(1e-14));
    mean.reset();
    CHECK(mean.value() == 0.0);
}
