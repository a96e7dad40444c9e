#include "io/formats/android/EnvelopeFit.h"

#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
// Nodes that wander, every 1 to 40 ms, from 0 to 0.
std::vector<EnvelopeNode> wanderingNodes(std::size_t count, std::uint64_t seed)
{
    Random random(seed);
    std::vector<EnvelopeNode> nodes{{0, 0.0, 100.0}};
    while (nodes.size() + 1 < count)
        nodes.push_back({nodes.back().tick + 1 + static_cast<std::int64_t>(39.0 * random.uniform()), random.uniform(),
                         60.0 + 200.0 * random.uniform()});
    nodes.push_back({nodes.back().tick + 30, 0.0, 100.0});
    return nodes;
}

// At every ms.
std::vector<double> levelsOf(const std::vector<EnvelopeNode>& nodes)
{
    std::vector<double> levels;
    for (std::size_t n = 1; n < nodes.size(); ++n)
        for (std::int64_t t = nodes[n - 1].tick; t < nodes[n].tick; ++t)
            levels.push_back(std::lerp(nodes[n - 1].amplitude, nodes[n].amplitude,
                                       static_cast<double>(t - nodes[n - 1].tick) /
                                           static_cast<double>(nodes[n].tick - nodes[n - 1].tick)));
    levels.push_back(nodes.back().amplitude);
    return levels;
}

double worstOf(const std::vector<EnvelopeNode>& a, const std::vector<EnvelopeNode>& b)
{
    const auto x = levelsOf(a), y = levelsOf(b);
    REQUIRE(x.size() == y.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        worst = std::max(worst, std::abs(x[i] - y[i]));
    return worst;
}

// The error that fittedNodes() promises to be least, over the nodes.
double costOf(const std::vector<EnvelopeNode>& nodes, const std::vector<EnvelopeNode>& fitted)
{
    const auto levels = levelsOf(fitted);
    double sum = 0.0;
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
    {
        const double off = levels[static_cast<std::size_t>(nodes[k].tick)] - nodes[k].amplitude;
        sum += 0.5 * static_cast<double>(nodes[k + 1].tick - nodes[k - 1].tick) * off * off;
    }
    return sum;
}
} // namespace

TEST_CASE("An envelope keeps the limits of a device, whatever it is made of", "[formats]")
{
    for (const std::size_t count : {2u, 3u, 20u, 300u, 5000u})
        for (const std::int64_t shortest : {1, 5, 20, 100})
            for (const std::size_t points : {0u, 16u, 200u})
            {
                CAPTURE(count, shortest, points);
                const auto nodes = wanderingNodes(count, 7 + count);
                EnvelopeLimits limits{points, shortest, 1000};
                if (points > 0)
                    limits.longest =
                        std::max<std::int64_t>(1000, nodes.back().tick / static_cast<std::int64_t>(points) + 1);
                const auto fitted = fittedNodes(nodes, limits);
                REQUIRE(fitted);
                const AndroidEnvelope envelope = envelopeThrough(*fitted, limits.longest);
                std::int64_t end = 0;
                for (const AndroidPoint& point : envelope.points)
                {
                    CHECK(point.duration >= limits.shortest);
                    CHECK(point.duration <= limits.longest);
                    end += point.duration;
                }
                CHECK((points == 0 || envelope.points.size() <= points));
                CHECK(envelope.points.back().amplitude == 0.0);
                CHECK(end == std::max(nodes.back().tick, shortest));
            }
}

TEST_CASE("Without limits no level is off by more than half a step of 8 bits, and what says nothing is left out",
          "[formats]")
{
    for (std::uint64_t seed = 1; seed < 20; ++seed)
    {
        const auto nodes = wanderingNodes(200, seed);
        const auto fitted = fittedNodes(nodes, {});
        REQUIRE(fitted);
        CHECK(worstOf(nodes, *fitted) <= 0.5 * leastAmplitude + 1e-12);
    }
    std::vector<EnvelopeNode> line{{0, 0.0, 100.0}};
    for (std::int64_t t = 1; t <= 500; ++t)
        line.push_back({t, 0.001 * static_cast<double>(t), 100.0});
    for (std::int64_t t = 501; t <= 800; ++t)
        line.push_back({t, 0.5 * static_cast<double>(800 - t) / 300.0, 100.0});
    const auto fitted = fittedNodes(line, {});
    REQUIRE(fitted);
    CHECK(fitted->size() <= 15); // 64 nodes at a time
    CHECK(worstOf(line, *fitted) <= 0.5 * leastAmplitude + 1e-12);
}

TEST_CASE("With few points an envelope is nearest among all choices of as many", "[formats]")
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
    {
        CAPTURE(seed);
        auto nodes = wanderingNodes(12, seed);
        for (EnvelopeNode& node : nodes)
            node.frequency = 100.0;
        const auto fitted = fittedNodes(nodes, {5, 1, 1000});
        REQUIRE(fitted);
        REQUIRE(fitted->size() <= 6);
        double best = 1e9;
        for (unsigned chosen = 0; chosen < 1u << 10u; ++chosen)
        {
            std::vector<EnvelopeNode> some{nodes.front()};
            for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
                if ((chosen >> (k - 1) & 1u) != 0)
                    some.push_back(nodes[k]);
            some.push_back(nodes.back());
            if (some.size() == fitted->size())
                best = std::min(best, costOf(nodes, some));
        }
        CHECK(costOf(nodes, *fitted) <= best + 1e-3); // what is within half a step is free
    }
}

TEST_CASE("Where points may not be near, the envelope is nearer than through the places that are left, and it is told",
          "[formats]")
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        CAPTURE(seed);
        const auto nodes = wanderingNodes(60, seed);
        const auto fitted = fittedNodes(nodes, {0, 40, 1000});
        REQUIRE(fitted);
        std::vector<EnvelopeNode> asTheyAre = *fitted;
        const auto levels = levelsOf(nodes);
        for (EnvelopeNode& node : asTheyAre)
            node.amplitude = levels[static_cast<std::size_t>(node.tick)];
        CHECK(costOf(nodes, *fitted) < costOf(nodes, asTheyAre));
        LossList losses;
        addFitLosses(losses, nodes, *fitted);
        double told = 0.0;
        for (const FormatLoss& loss : std::move(losses).sorted())
            if (loss.kind == LossKind::points)
                told = std::max(told, loss.error);
        CHECK(told == Approx(worstOf(nodes, *fitted)).margin(1e-9));
    }
}

TEST_CASE("Limits that cannot be kept are refused", "[formats]")
{
    const auto nodes = wanderingNodes(300, 3); // 6 s
    for (const EnvelopeLimits& wrong : {EnvelopeLimits{0, 600, 1000}, EnvelopeLimits{0, 0, 1000}})
    {
        const auto fitted = fittedNodes(nodes, wrong);
        REQUIRE_FALSE(fitted);
        CHECK(fitted.error().code == ErrorCode::invalidArgument);
        CHECK(fitted.error().where == "envelope.longest");
    }
    const auto fitted = fittedNodes(nodes, {4, 1, 1000});
    REQUIRE_FALSE(fitted);
    CHECK(fitted.error().where == "envelope.points");
    CHECK(fittedNodes({{0, 0.0, 100.0}, {3, 0.0, 100.0}}, {0, 20, 1000}).value().back().tick == 20);
}
