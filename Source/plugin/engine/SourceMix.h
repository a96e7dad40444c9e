// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Source mixer: main input and sidechain as one mono sound.

#include "plugin/engine/ParameterTable.h"

#include <pacini/foundation/Fade.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace pacini::plugin
{

/// Means of the channels of main input and sidechain, each with a gain that moves within 20 ms.
class SourceMix
{
public:
    void prepare(double sampleRate) noexcept
    {
        for (Fade* gain : {&main, &side})
            gain->prepare(static_cast<std::size_t>(0.020 * sampleRate));
        begun = false;
    }
    void reset() noexcept { begun = false; }

    /// `mix` is that of the source Mix: up to 0.5 the main input counts in full, from there on the sidechain.
    void aim(SourceChoice choice, double mix) noexcept
    {
        const bool both = choice == SourceChoice::mix;
        const double mainGain = both ? std::min(1.0, 2.0 - 2.0 * mix) : choice == SourceChoice::main;
        const double sideGain = both ? std::min(1.0, 2.0 * mix) : choice == SourceChoice::sidechain;
        if (begun)
        {
            main.aim(mainGain);
            side.aim(sideGain);
        }
        else
        {
            main.jump(mainGain);
            side.jump(sideGain);
            begun = true;
        }
    }

    /// All of one length; no channels count as silence.
    void process(std::span<const std::span<float>> mainIn, std::span<const std::span<const float>> sideIn,
                 std::span<float> out) noexcept
    {
        std::fill(out.begin(), out.end(), 0.0f);
        add(mainIn, main, out);
        add(sideIn, side, out);
    }

private:
    template <typename Sample>
    static void add(std::span<const std::span<Sample>> in, Fade& gain, std::span<float> out) noexcept
    {
        if (in.empty())
            return;
        const float share = 1.0f / static_cast<float>(in.size());
        if (!gain.resting())
        {
            for (std::size_t i = 0; i < out.size(); ++i)
            {
                float sum = 0.0f;
                for (const auto& channel : in)
                    sum += channel[i];
                out[i] += static_cast<float>(gain.next()) * share * sum;
            }
            return;
        }
        if (gain.value() == 0.0)
            return;
        const float scale = static_cast<float>(gain.value()) * share;
        for (const auto& channel : in)
        {
            const Sample* x = channel.data();
            float* y = out.data();
            for (std::size_t i = 0; i < out.size(); ++i)
                y[i] += scale * x[i];
        }
    }

    Fade main, side;
    bool begun = false;
};

} // namespace pacini::plugin
