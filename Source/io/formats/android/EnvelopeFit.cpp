#include "io/formats/android/EnvelopeFit.h"

#include "io/formats/VoiceReduction.h"

#include <pacini/simplify/Refit.h>
#include <pacini/simplify/Simplify.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace pacini
{

namespace
{
constexpr double tolerance = 0.5 * leastAmplitude;
constexpr double octaveWeight = 0.25; // in amplitude, of an octave at full amplitude
constexpr double infinite = std::numeric_limits<double>::infinity();

/// How much an error of the frequency of a node counts, per Hz.
double frequencyWeight(const EnvelopeNode& node) noexcept
{
    return octaveWeight * node.amplitude / (node.frequency * std::numbers::ln2);
}

std::int64_t piecesOf(std::int64_t length, std::int64_t longest) noexcept
{
    return (length + longest - 1) / longest;
}

/// Weighted sums over the nodes within a segment, relative to its end, from which the squared error of any line that
/// ends there follows.
struct LineSums
{
    double w = 0.0, wt = 0.0, wtt = 0.0, wy = 0.0, wty = 0.0, wyy = 0.0;

    void add(double weight, double t, double y) noexcept
    {
        w += weight;
        wt += weight * t;
        wtt += weight * t * t;
        wy += weight * y;
        wty += weight * t * y;
        wyy += weight * y * y;
    }

    /// Of the line through the end with this slope.
    [[nodiscard]] double squaredError(double slope) const noexcept
    {
        return std::max(wyy - 2.0 * slope * wty + slope * slope * wtt, 0.0);
    }
};

class Segmenter
{
public:
    Segmenter(std::span<const EnvelopeNode> allNodes, const EnvelopeLimits& deviceLimits, std::size_t nodesOfSegment)
        : nodes(allNodes),
          limits(deviceLimits),
          window(nodesOfSegment),
          best(nodes.size()),
          from(nodes.size()),
          pieces(nodes.size())
    {
    }

    /// The nodes with the least sum of squared error and price of points.
    [[nodiscard]] std::vector<std::size_t> chosen(double price)
    {
        best[0] = 0.0;
        pieces[0] = 0;
        for (std::size_t j = 1; j < nodes.size(); ++j)
            reach(j, price);
        std::vector<std::size_t> kept;
        for (std::size_t j = nodes.size() - 1; j > 0; j = from[j])
            kept.push_back(j);
        kept.push_back(0);
        std::reverse(kept.begin(), kept.end());
        return kept;
    }

    /// Control points of the last choice.
    [[nodiscard]] std::int64_t points() const noexcept { return pieces.back(); }

private:
    void reach(std::size_t j, double price)
    {
        best[j] = infinite;
        LineSums amplitude, frequency;
        const EnvelopeNode& end = nodes[j];
        for (std::size_t i = j; i-- > 0;)
        {
            const EnvelopeNode& start = nodes[i];
            const std::int64_t length = end.tick - start.tick;
            if (i + 1 < j)
                addWithin(i + 1, end, amplitude, frequency);
            if (length >= limits.shortest && best[i] < infinite)
            {
                const auto ticks = static_cast<double>(length);
                double error = amplitude.squaredError((end.amplitude - start.amplitude) / ticks) +
                               frequency.squaredError((end.frequency - start.frequency) / ticks);
                if (error <= tolerance * tolerance * amplitude.w && isWithinTolerance(i, j))
                    error = 0.0;
                const std::int64_t more = piecesOf(length, limits.longest);
                const double cost = best[i] + error + price * static_cast<double>(more);
                if (cost < best[j])
                {
                    best[j] = cost;
                    from[j] = i;
                    pieces[j] = pieces[i] + more;
                }
            }
            if (j - i >= window && length >= 4 * limits.shortest && best[j] < infinite)
                return;
        }
    }

    void addWithin(std::size_t k, const EnvelopeNode& end, LineSums& amplitude, LineSums& frequency) const noexcept
    {
        const EnvelopeNode& node = nodes[k];
        const double weight = 0.5 * static_cast<double>(nodes[k + 1].tick - nodes[k - 1].tick);
        const auto t = static_cast<double>(node.tick - end.tick);
        amplitude.add(weight, t, node.amplitude - end.amplitude);
        const double of = frequencyWeight(node);
        frequency.add(weight * of * of, t, node.frequency - end.frequency);
    }

    [[nodiscard]] bool isWithinTolerance(std::size_t i, std::size_t j) const noexcept
    {
        const auto length = static_cast<double>(nodes[j].tick - nodes[i].tick);
        for (std::size_t k = i + 1; k < j; ++k)
        {
            const double place = static_cast<double>(nodes[k].tick - nodes[i].tick) / length;
            const double level = nodes[i].amplitude + place * (nodes[j].amplitude - nodes[i].amplitude);
            const double hertz = nodes[i].frequency + place * (nodes[j].frequency - nodes[i].frequency);
            if (std::hypot(level - nodes[k].amplitude, frequencyWeight(nodes[k]) * (hertz - nodes[k].frequency)) >
                tolerance)
                return false;
        }
        return true;
    }

    std::span<const EnvelopeNode> nodes;
    const EnvelopeLimits& limits;
    std::size_t window;
    std::vector<double> best;
    std::vector<std::size_t> from;
    std::vector<std::int64_t> pieces;
};

/// Those that matter most to the amplitude, where there are many more than may be kept.
std::vector<EnvelopeNode> fewerNodes(const std::vector<EnvelopeNode>& nodes, std::size_t most)
{
    if (nodes.size() <= most)
        return nodes;
    Curve curve;
    for (const EnvelopeNode& node : nodes)
        curve.push_back({androidTime(node.tick), node.amplitude});
    const auto kept = lagrangianToCount(curve, most);
    std::vector<EnvelopeNode> fewer;
    for (const std::size_t i : kept)
        fewer.push_back(nodes[i]);
    return fewer;
}

/// With places around each node, up to twice as far as the next may be nearest: what stands there bends no more, but
/// can be chosen where the node is too near to another.
std::vector<EnvelopeNode> withNeighbours(const std::vector<EnvelopeNode>& nodes, std::int64_t distance)
{
    std::vector<std::int64_t> ticks;
    for (const EnvelopeNode& node : nodes)
        for (const std::int64_t tick : {node.tick - distance, node.tick - distance / 2, node.tick,
                                        node.tick + distance / 2, node.tick + distance, node.tick + 2 * distance})
            if (tick >= nodes.front().tick && tick <= nodes.back().tick)
                ticks.push_back(tick);
    std::sort(ticks.begin(), ticks.end());
    ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
    std::vector<EnvelopeNode> more;
    more.reserve(ticks.size());
    std::size_t next = 0;
    for (const std::int64_t tick : ticks)
    {
        while (nodes[next].tick < tick)
            ++next;
        const EnvelopeNode& after = nodes[next];
        if (after.tick == tick)
        {
            more.push_back(after);
            continue;
        }
        const EnvelopeNode& before = nodes[next - 1];
        const double place = static_cast<double>(tick - before.tick) / static_cast<double>(after.tick - before.tick);
        more.push_back({tick, before.amplitude + place * (after.amplitude - before.amplitude),
                        before.frequency + place * (after.frequency - before.frequency)});
    }
    return more;
}

std::vector<EnvelopeNode> pick(const std::vector<EnvelopeNode>& nodes, const std::vector<std::size_t>& kept)
{
    std::vector<EnvelopeNode> picked;
    picked.reserve(kept.size());
    for (const std::size_t i : kept)
        picked.push_back(nodes[i]);
    return picked;
}

/// The same places with the levels that are nearest to all nodes, where they are not near enough as they are.
std::vector<EnvelopeNode> levelled(const std::vector<EnvelopeNode>& nodes, std::vector<EnvelopeNode> chosen)
{
    Curve dense, vertices;
    std::vector<double> weights;
    for (std::size_t k = 0; k < nodes.size(); ++k)
    {
        dense.push_back({androidTime(nodes[k].tick), nodes[k].amplitude});
        weights.push_back(static_cast<double>(nodes[std::min(k + 1, nodes.size() - 1)].tick -
                                              nodes[std::max<std::size_t>(k, 1) - 1].tick));
    }
    weights.front() = weights.back() = 1e6 * static_cast<double>(nodes.back().tick); // the ends stay
    for (const EnvelopeNode& node : chosen)
        vertices.push_back({androidTime(node.tick), node.amplitude});
    double worst = 0.0;
    for (const Breakpoint& point : dense)
        worst = std::max(worst, std::abs(valueAt(vertices, point.time) - point.value));
    if (worst <= 1.5 * tolerance)
        return chosen;
    const Curve best = refit(dense, vertices, weights, {.lowest = 0.0});
    for (std::size_t n = 1; n + 1 < chosen.size(); ++n)
        chosen[n].amplitude = std::min(best[n].value, 1.0);
    return chosen;
}

/// The choice with the most points that are allowed; none when that is too few for the segmenter. `dearest`: a price
/// that nothing is worth.
std::vector<std::size_t> cheapest(Segmenter& segmenter, std::size_t points, double dearest)
{
    constexpr double nearlyFree = 1e-12;
    const auto most = points > 0 ? static_cast<std::int64_t>(points) : std::numeric_limits<std::int64_t>::max();
    auto kept = segmenter.chosen(nearlyFree);
    if (segmenter.points() <= most)
        return kept;
    kept = segmenter.chosen(dearest);
    if (segmenter.points() > most)
        return {};
    double low = nearlyFree, high = dearest;
    for (int step = 0; step < 60; ++step)
    {
        const double price = std::sqrt(low * high);
        auto tried = segmenter.chosen(price);
        if (segmenter.points() > most)
            low = price;
        else
        {
            high = price;
            kept = std::move(tried);
            if (segmenter.points() == most)
                break;
        }
    }
    return kept;
}
} // namespace

AndroidEnvelope envelopeThrough(const std::vector<EnvelopeNode>& nodes, std::int64_t longest)
{
    AndroidEnvelope envelope;
    envelope.initialFrequency = nodes.front().frequency;
    for (std::size_t n = 1; n < nodes.size(); ++n)
    {
        const EnvelopeNode &before = nodes[n - 1], &target = nodes[n];
        const std::int64_t length = target.tick - before.tick;
        const std::int64_t pieces = piecesOf(length, longest);
        for (std::int64_t i = 1; i <= pieces; ++i)
        {
            const double place = static_cast<double>(i) / static_cast<double>(pieces);
            envelope.points.push_back({(length * i) / pieces - (length * (i - 1)) / pieces,
                                       before.amplitude + place * (target.amplitude - before.amplitude),
                                       before.frequency + place * (target.frequency - before.frequency)});
        }
    }
    return envelope;
}

Result<std::vector<EnvelopeNode>> fittedNodes(std::vector<EnvelopeNode> nodes, const EnvelopeLimits& limits)
{
    if (limits.shortest < 1 || limits.longest < 2 * limits.shortest)
        return Error{ErrorCode::invalidArgument, "envelope.longest",
                     "the longest segment must be at least twice as long as the shortest, and that 1 ms"};
    EnvelopeNode& last = nodes.back();
    last.tick = std::max(last.tick, nodes.front().tick + limits.shortest);
    const std::int64_t length = last.tick - nodes.front().tick;
    if (limits.points > 0 && piecesOf(length, limits.longest) > static_cast<std::int64_t>(limits.points))
        return Error{ErrorCode::invalidArgument, "envelope.points",
                     fmt::format("{} control points of at most {} ms are less than the {} ms of the clip",
                                 limits.points, limits.longest, length)};
    if (limits.shortest > 1)
        nodes = withNeighbours(nodes, limits.shortest);
    std::size_t window = 64;
    if (limits.points > 0)
    {
        nodes = fewerNodes(nodes, std::max<std::size_t>(2048, 16 * limits.points));
        window = std::max(window, 8 * nodes.size() / limits.points);
    }
    for (;;)
    {
        Segmenter segmenter(nodes, limits, window);
        if (auto kept = cheapest(segmenter, limits.points, static_cast<double>(length)); !kept.empty())
            return levelled(nodes, pick(nodes, kept));
        window = nodes.size(); // few points that are far apart
    }
}

void addFitLosses(LossList& losses, const std::vector<EnvelopeNode>& nodes, const std::vector<EnvelopeNode>& fitted)
{
    constexpr double leastOctaves = 0.1;
    LossTrack amplitudes(LossKind::points, "envelope: simplified to the limit of control points");
    LossTrack frequencies(LossKind::frequency, "envelope: frequency simplified to the limit of control points");
    Curve amplitude, frequency;
    for (const EnvelopeNode& node : fitted)
    {
        amplitude.push_back({androidTime(node.tick), node.amplitude});
        frequency.push_back({androidTime(node.tick), node.frequency});
    }
    for (const EnvelopeNode& node : nodes)
    {
        const double time = androidTime(node.tick);
        const double error = std::abs(valueAt(amplitude, time) - node.amplitude);
        amplitudes.add(time, error > leastAmplitude ? error : 0.0);
        const double octaves = std::abs(std::log2(valueAt(frequency, time) / node.frequency));
        frequencies.add(time, octaves > leastOctaves && node.amplitude > leastAmplitude ? octaves : 0.0);
    }
    losses.append(amplitudes);
    losses.append(frequencies);
    const double longer = androidTime(fitted.back().tick - nodes.back().tick);
    if (longer > 0.0)
        losses.add(LossKind::length, androidTime(nodes.back().tick), 0.0, longer,
                   "envelope: extended to the shortest segment");
}

} // namespace pacini
