#pragma once

// Interpolator with a recursive filter behind it, whose recursion runs at the lower rate.

#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/PolyphaseInterpolator.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Pair.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

namespace pacini
{

/// What PolyphaseInterpolator and a cascade behind it put out, to the rounding of floats, for little more than the
/// interpolator costs: at the higher rate nothing waits for its own last value.
///
/// With g the interpolator's impulse response, h the cascade's, its states s' = A s + B x and output C s + D x, an
/// input frame answers with the convolution g * h as long as it is among the newest `taps` ones: one more polyphase
/// filter. What is older lies in the states alone. Over the L frames of an input frame these move by A^L (no input) and
/// put out C A^p s in frame p, so that they are like a few further taps; what falls out of the newest `taps` is added
/// to them as the state that a g of it has left behind. A block form of recursive filters (C. Burrus, "Block
/// realization of digital filters", IEEE Transactions on Audio and Electroacoustics 20, 1972) in which the block's
/// input has one degree of freedom. States are double and in the coordinates of the sections (see StateVariable.h).
///
/// Like PolyphaseInterpolator no DspBlock.
class FilteringInterpolator
{
public:
    /// Allocates.
    FilteringInterpolator(const PolyphaseInterpolator& interpolator, const BiquadCascadeCoefficients& filter)
        : ratio(interpolator.factor()),
          taps(interpolator.taps()),
          plain(interpolator.rows()),
          cascade(filter),
          history(taps),
          filtered(ratio, taps + stateCount()),
          rounded(stateCount()),
          wanted(ratio)
    {
        if (ratio == 1)
            return; // then the cascade itself is the shortest form
        designTaps();
        designStates();
    }

    [[nodiscard]] std::size_t factor() const noexcept { return ratio; }
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return (taps / 2) * ratio; }

    void reset() noexcept
    {
        history.reset();
        states = {};
    }

    /// Whether nothing comes any more, without input.
    [[nodiscard]] bool silent() const noexcept
    {
        return history.silent() && std::all_of(states.begin(), states.begin() + sectionCount(),
                                               [](const Pair& s) { return s.first() == 0.0 && s.second() == 0.0; });
    }

    /// The frames of an output, from `from` to before `to`, in which the interpolated signal counts; outside, the
    /// filter's input is 0.
    struct Counted
    {
        std::size_t from = 0;
        std::size_t to = 0;
    };

    /// `out` has factor() times as many frames as `in`; `added`, as many or none, is added to the interpolated signal.
    /// [audio]
    void process(std::span<const float> in, std::span<const float> added, Counted counted,
                 std::span<float> out) noexcept
    {
        assert(out.size() == in.size() * ratio && (added.empty() || added.size() == out.size()));
        const bool anyMoved = sounds(added); // seldom: events are far apart
        for (std::size_t i = 0, n = 0; i < in.size(); ++i, n += ratio)
        {
            const std::span<float> to = out.subspan(n, ratio);
            const auto more = added.empty() ? added : added.subspan(n, ratio);
            const bool counts = n >= counted.from && n + ratio <= counted.to;
            const bool moved = anyMoved && sounds(more);
            const std::span<const float> newest = history.push(in[i]);
            if (ratio == 1)
            {
                const double x = (counts ? finiteOrZero(newest.front()) : 0.0) + (moved ? finiteOrZero(more[0]) : 0.0);
                States s = sectionStates();
                to[0] = toSample(tick(s, x));
                keep(s);
                continue;
            }
            roundStates();
            filtered.process(newest, rounded, to.data());
            advance(static_cast<double>(newest.back()));
            if (!counts || moved)
                addApart(newest, more, n, counted, to);
        }
        States s = sectionStates();
        for (std::size_t k = 0; k < cascade.sections.size(); ++k)
            s[k].flush();
        keep(s);
    }

private:
    using States = std::array<StateVariableState, maxBiquadSections>;

    [[nodiscard]] std::size_t stateCount() const noexcept { return 2 * cascade.sections.size(); }
    [[nodiscard]] std::ptrdiff_t sectionCount() const noexcept
    {
        return static_cast<std::ptrdiff_t>(cascade.sections.size());
    }

    [[nodiscard]] States sectionStates() const noexcept
    {
        States s;
        for (std::size_t k = 0; k < cascade.sections.size(); ++k)
            s[k] = {states[k].first(), states[k].second()};
        return s;
    }
    void keep(const States& s) noexcept
    {
        for (std::size_t k = 0; k < cascade.sections.size(); ++k)
            states[k] = Pair(s[k].s1, s[k].s2);
    }

    /// One frame of the cascade.
    double tick(States& s, double x) const noexcept
    {
        for (std::size_t k = 0; k < cascade.sections.size(); ++k)
            x = s[k].tick(cascade.sections[k], x);
        return x;
    }

    /// Whether any sample is not 0; without branches, so that several are asked at once.
    [[nodiscard]] static bool sounds(std::span<const float> samples) noexcept
    {
        std::uint32_t bits = 0;
        for (const float x : samples)
            bits |= std::bit_cast<std::uint32_t>(x);
        return bits << 1 != 0; // -0 is 0, too
    }

    /// toSample() of all states.
    void roundStates() noexcept
    {
        constexpr double largest = static_cast<double>(std::numeric_limits<float>::max());
        for (std::size_t k = 0; k < cascade.sections.size(); ++k)
        {
            const Pair audible = cleared(states[k], 1e-30);
            const Pair state = smaller(larger(audible, Pair(-largest)), Pair(largest));
            rounded[2 * k] = static_cast<float>(state.first());
            rounded[2 * k + 1] = static_cast<float>(state.second());
        }
    }

    /// The response to an input frame, and the state that it leaves.
    void designTaps() noexcept
    {
        States s{};
        for (std::size_t i = 0; i < taps; ++i)
            for (std::size_t p = 0; p < ratio; ++p)
                filtered.at(i, p) = static_cast<float>(tick(s, static_cast<double>(plain.at(i, p))));
        for (std::size_t k = 0; k < cascade.sections.size(); ++k)
            left[k] = {s[k].s1, s[k].s2};
    }

    /// The response of each state, and its next value.
    void designStates()
    {
        for (std::size_t j = 0; j < stateCount(); ++j)
        {
            States s{};
            (j % 2 == 0 ? s[j / 2].s1 : s[j / 2].s2) = 1.0;
            for (std::size_t p = 0; p < ratio; ++p)
                filtered.at(taps + j, p) = static_cast<float>(tick(s, 0.0));
            for (std::size_t k = 0; k < cascade.sections.size(); ++k)
                transitions.push_back({s[k].s1, s[k].s2});
        }
    }

    /// Moves the states on by all frames of an input frame; `oldest` is the one that falls out of the taps.
    void advance(double oldest) noexcept
    {
        // Usual numbers of sections as constants, which keeps all sums in registers.
        switch (cascade.sections.size())
        {
        case 0:
            return;
        case 1:
            return advanceAll(std::integral_constant<std::size_t, 1>{}, oldest);
        case 2:
            return advanceAll(std::integral_constant<std::size_t, 2>{}, oldest);
        case 3:
            return advanceAll(std::integral_constant<std::size_t, 3>{}, oldest);
        case 4:
            return advanceAll(std::integral_constant<std::size_t, 4>{}, oldest);
        case 5:
            return advanceAll(std::integral_constant<std::size_t, 5>{}, oldest);
        case 6:
            return advanceAll(std::integral_constant<std::size_t, 6>{}, oldest);
        default:
            return advanceAll(cascade.sections.size(), oldest);
        }
    }

    /// The same for `count` sections. Each state moves its own section and those behind it.
    template <typename Count>
    void advanceAll(Count count, double oldest) noexcept
    {
        constexpr bool known = !std::is_same_v<Count, std::size_t>;
        // In two sums each, which do not wait for each other.
        std::array<Pair, known ? Count{} : maxBiquadSections> next, more;
        for (std::size_t k = 0; k < count; ++k)
        {
            next[k] = Pair(oldest) * left[k];
            more[k] = Pair(0.0);
        }
        const Pair* column = transitions.data();
        for (std::size_t j = 0; j < count; ++j, column += 2 * count)
            for (std::size_t k = j; k < count; ++k)
            {
                next[k] = next[k] + Pair(states[j].first()) * column[k];
                more[k] = more[k] + Pair(states[j].second()) * column[count + k];
            }
        for (std::size_t k = 0; k < count; ++k)
            states[k] = next[k] + more[k];
    }

    /// Adds the cascade's response to all other input than the interpolated signal, from rest, since it is linear.
    void addApart(std::span<const float> newest, std::span<const float> added, std::size_t first,
                  const Counted& counted, std::span<float> out) noexcept
    {
        plain.process(newest, {}, wanted.data());
        States s{};
        for (std::size_t p = 0; p < ratio; ++p)
        {
            double x = added.empty() ? 0.0 : finiteOrZero(added[p]);
            if (first + p < counted.from || first + p >= counted.to)
                x -= static_cast<double>(wanted[p]);
            out[p] = toSample(static_cast<double>(out[p]) + tick(s, x));
        }
        for (std::size_t k = 0; k < cascade.sections.size(); ++k)
            states[k] = states[k] + Pair(s[k].s1, s[k].s2);
    }

    std::size_t ratio;
    std::size_t taps;
    PolyphaseRows plain;
    BiquadCascadeCoefficients cascade;
    NewestFirst history;
    PolyphaseRows filtered; ///< of the taps, then of the states
    std::vector<float> rounded, wanted;
    std::array<Pair, maxBiquadSections> states{}; ///< s1 and s2 of each section
    std::array<Pair, maxBiquadSections> left{};   ///< by an input frame of 1, at the end of its taps
    std::vector<Pair> transitions;                ///< for each state, those of all sections
};

} // namespace pacini
