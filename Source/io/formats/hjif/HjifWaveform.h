#pragma once

// Waveform channels of an HJIF file: drawn as samples and translated to a clip.

#include "io/formats/ImportReport.h"
#include "io/formats/hjif/HjifFile.h"
#include "io/formats/hjif/HjifWaves.h"

#include <pacini/clip/Clip.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// Draws WaveletWave and Curve bands as samples and translates them like a sound: a wavelet band contains a waveform,
/// and the two bands of the reference encoder belong together, as one contains the error of the other. All channels are
/// drawn at one rate.
class HjifWaveform
{
public:
    /// `sampleRate` Hz of the fastest wavelet band. Slower bands are resampled.
    explicit HjifWaveform(int sampleRate) : fs(sampleRate) {}

    [[nodiscard]] bool empty() const noexcept { return channels.empty(); }

    /// Starts a channel that the following bands belong to.
    void addChannel() { channels.emplace_back(); }

    /// Lays the blocks of a band end to end, as the reference player does. Errors: invalidData with the place of what
    /// makes no block, tooLarge.
    void addWavelet(const HjifBand& band, std::span<const HjifPlaced> blocks, double ticks, ImportReport& report,
                    const std::string& where);

    /// Draws waves through their keyframes: straight for the curve type Linear, otherwise levelling off at each
    /// keyframe, which is near enough to the splines of the other types. Errors: tooLarge.
    void addCurve(const HjifBand& band, std::span<const HjifPlaced> waves, double ticks, ImportReport& report,
                  const std::string& where);

    /// Ends a band: players cut the sum of the bands at full scale after each.
    void endBand();

    /// Ends the channel.
    void scale(double level);

    /// What all channels sum to, as a clip of at most `duration` s (0: until the last sample).
    [[nodiscard]] Clip translated(double duration);

private:
    /// Samples from `first` on of the channel, of which there are as many now; none where that would be too many.
    [[nodiscard]] std::span<float> room(std::size_t first, std::size_t count, ImportReport& report,
                                        const std::string& where);

    int fs;
    std::size_t drawn = 0;     ///< samples of all channels
    std::size_t resampled = 0; ///< bands
    std::vector<std::vector<float>> channels;
};

} // namespace pacini
