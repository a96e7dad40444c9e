#pragma once

// Loudness and sharpness of a sound over time (ISO 532-1 for time-varying sounds, DIN 45692).

#include <pacini/hearing/LoudnessDecay.h>
#include <pacini/hearing/SpecificLoudness.h>
#include <pacini/hearing/ThirdOctaveLevels.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Measures loudness and sharpness after Zwicker (ISO 532-1:2017, clause 6, free field), piece by piece. Silence has
/// loudness 0; the tables end at 120 dB. Not real-time safe. The standard finds levels each .5 ms; `pacini bench match`
/// measures the error and the run time of longer steps.
class LoudnessMeter
{
public:
    static constexpr double sampleRate = ThirdOctaveLevels::sampleRate; ///< Hz
    static constexpr double rate = 500.0;                               ///< Hz, of the output
    static constexpr std::size_t standardHop = 24; ///< samples from one set of levels to the next, .5 ms

    /// `hop`: 12, 24, 48, 96 or a multiple of 96.
    explicit LoudnessMeter(std::size_t hop = standardHop)
        : thirdOctaves(hop),
          decay(sampleRate / static_cast<double>(hop)),
          memory(sampleRate / static_cast<double>(hop)),
          spacing(std::max<std::size_t>(1, value / hop)),
          copies(std::max<std::size_t>(1, hop / value))
    {
    }

    /// The next samples of the pressure in Pa at 48 kHz, as many as there are. Calls sink(total, pattern) for each 2 ms
    /// from the first sample on: `total` in sone with the memory of short sounds (6.5), and the LoudnessPattern of that
    /// moment without it. The last set comes with the next samples or with finish().
    template <typename Sink>
    void process(std::span<const float> pressure, Sink&& sink)
    {
        constexpr std::size_t piece = 4800; // so that the levels stay in the cache
        for (std::size_t done = 0; done < pressure.size(); done += piece)
        {
            levels.clear();
            thirdOctaves.process(pressure.subspan(done).first(std::min(piece, pressure.size() - done)), levels);
            for (const BandPowers& set : levels)
                push(coreLoudness(set), sink);
        }
    }

    /// After the last samples comes silence.
    template <typename Sink>
    void finish(Sink&& sink)
    {
        levels.clear();
        thirdOctaves.finish(levels);
        for (const BandPowers& set : levels)
            push(coreLoudness(set), sink);
        push(CoreLoudness{}, sink);
        waiting.reset();
    }

private:
    static constexpr std::size_t value = 96; // samples from one to the next

    template <typename Sink>
    void push(const CoreLoudness& core, Sink& sink)
    {
        if (waiting)
        {
            const CoreLoudness heard = decay.step(*waiting, core);
            if (sets++ % spacing != 0)
                memory.next(totalLoudness(heard)); // no one asks for the pattern between two values
            else
            {
                const auto pattern = loudnessPattern(heard);
                const double total = memory.next(pattern.total);
                for (std::size_t i = 0; i < copies; ++i)
                    sink(total, pattern);
            }
        }
        waiting = core;
    }

    ThirdOctaveLevels thirdOctaves;
    LoudnessDecay decay;
    LoudnessMemory memory;
    std::vector<BandPowers> levels;
    std::optional<CoreLoudness> waiting;
    std::size_t sets = 0;
    std::size_t spacing; // of the sets that become values
    std::size_t copies;  // values that a set becomes
};

} // namespace pacini
