#pragma once

// Choice of an envelope's control points within the limits of a device.

#include "io/formats/android/AndroidEffects.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pacini
{

/// A place where an envelope bends.
struct EnvelopeNode
{
    std::int64_t tick = 0; ///< ms, rising
    double amplitude = 0.0;
    double frequency = 0.0; ///< Hz, above 0
};

/// The control points that go through `nodes`, of which the first is the start, at 0 ms and amplitude 0: segments
/// longer than `longest` ms are several.
[[nodiscard]] AndroidEnvelope envelopeThrough(const std::vector<EnvelopeNode>& nodes, std::int64_t longest);

/// The nodes that a device plays within its limits: the first and the last, and of the others, and of places up to
/// twice `shortest` around them, those with the least error. An error is that of the amplitude, together with that of
/// the frequency, an octave of which at full amplitude counts as much as a quarter of full amplitude. Segments that err
/// by half a step of 8 bits at most are without error, so that no point is spent on them; what errs by more has the
/// least sum of squares over time. It is found by dynamic programming over all segments of up to 64 nodes, or eight
/// times as many as there are for a point; the price of a point that leaves as many as there may be, by bisection. In
/// the end the levels of what was chosen become those with the least squared error. (Events that count for more, so
/// that each keeps its peak, cost one to three points of HTS: peaks with wide feet are felt too early and too long.) If
/// the last node is too near to the first it is moved. Errors: invalidArgument: limits that contradict each other
/// (`envelope.longest`), or fewer points than an envelope of this length needs (`envelope.points`).
[[nodiscard]] Result<std::vector<EnvelopeNode>> fittedNodes(std::vector<EnvelopeNode> nodes,
                                                            const EnvelopeLimits& limits);

/// Adds the places where the envelope through `fitted` differs from the one through `nodes`.
void addFitLosses(LossList& losses, const std::vector<EnvelopeNode>& nodes, const std::vector<EnvelopeNode>& fitted);

} // namespace pacini
