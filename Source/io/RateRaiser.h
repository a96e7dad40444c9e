#pragma once

// Sounds at a whole multiple of their sample rate, piece by piece.

#include <pacini/filters/Resampler.h>
#include <pacini/foundation/Result.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pacini
{

/// Raises a low rate to at least `lowestRate` Hz, since the encoder takes no lower ones.
class RateRaiser
{
public:
    RateRaiser(int rate, int lowestRate, std::size_t channels)
        : factor((lowestRate + rate - 1) / rate), resampler(rate, rate * factor), inputs(channels)
    {
    }

    [[nodiscard]] int multiple() const noexcept { return factor; }

    /// Fills `interleaved` from what take(span) delivers, a Result of frames that are 0 only at the end.
    template <typename Take>
    [[nodiscard]] Result<std::size_t> read(std::span<float> interleaved, Take take)
    {
        constexpr std::size_t pieceFrames = 1024;
        const std::size_t channels = inputs.size();
        const std::size_t wanted = interleaved.size() / channels;
        std::size_t done = 0;
        while (done < wanted)
        {
            const std::size_t ready = readyOutputs();
            if (ready == 0 && ended)
                break;
            if (ready == 0)
            {
                block.resize(pieceFrames * channels);
                const auto got = take(std::span(block));
                if (!got)
                    return got.error();
                ended = *got == 0;
                for (std::size_t i = 0; i < *got * channels; ++i)
                    inputs[i % channels].push_back(block[i]);
                continue;
            }
            const std::size_t n = std::min({ready, wanted - done, pieceFrames});
            column.resize(n);
            for (std::size_t c = 0; c < channels; ++c)
            {
                resampler.process(inputs[c], begin, next, column);
                for (std::size_t i = 0; i < n; ++i)
                    interleaved[(done + i) * channels + c] = column[i];
            }
            done += n;
            next += n;
            forget(resampler.firstInput(next));
        }
        return done;
    }

private:
    [[nodiscard]] std::size_t readyOutputs() const noexcept
    {
        const auto end = begin + static_cast<std::int64_t>(inputs.front().size());
        if (ended)
            return static_cast<std::size_t>(end) * static_cast<std::size_t>(factor) - next;
        // Each input lets as many more outputs be made as the rate is raised by.
        const auto missing = end - 1 - resampler.lastInput(next);
        return missing < 0 ? 0 : static_cast<std::size_t>(missing) * static_cast<std::size_t>(factor) + 1;
    }

    void forget(std::int64_t before)
    {
        const auto size = static_cast<std::int64_t>(inputs.front().size());
        const auto count = std::clamp<std::int64_t>(before - begin, 0, size);
        if (count < 1024)
            return;
        for (auto& channel : inputs)
            channel.erase(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(count));
        begin += count;
    }

    int factor;
    Resampler<float> resampler;
    std::vector<std::vector<float>> inputs; ///< of each channel, from frame `begin` on
    std::vector<float> block;
    std::vector<float> column;
    std::int64_t begin = 0;
    std::size_t next = 0; ///< output frame
    bool ended = false;
};

} // namespace pacini
