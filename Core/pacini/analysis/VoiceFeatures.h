#pragma once

// Features that tell a voice from music and effects, causal: samples of about 8 kHz -> 52 numbers each 16 ms.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/SplitRealFft.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace pacini
{

/// Evidence of one frame. Levels are divided by usual sizes, so that all values lie about 1.
enum class VoiceEvidence : std::size_t
{
    formant1, ///< the first six cosines of the levels in 14 bands, 80 to 3600 Hz, which describe formants
    formant2,
    formant3,
    formant4,
    formant5,
    formant6,
    voiced,     ///< normalised autocorrelation at the pitch, 72 to 420 Hz
    pitch,      ///< octaves above 158 Hz, where the sound is voiced
    glide,      ///< of the pitch from frame to frame: larger than that of a held note, smaller than a step
    steady,     ///< share of frames whose pitch stays within 0.1 %
    step,       ///< share of frames whose pitch jumps
    low,        ///< level from 20 to 70 Hz against that from there to 1 kHz
    noise,      ///< spectral flatness from 300 to 3400 Hz
    flux,       ///< change of the 14 levels from frame to frame
    rise,       ///< of the level
    fall,       ///< of the level
    modulation, ///< of the level, 2 to 8 Hz: syllables
    count
};

inline constexpr std::size_t voiceEvidences = static_cast<std::size_t>(VoiceEvidence::count);

/// Evidence of late (60 ms), its mean and its standard deviation (0.5 s), and how little of the sound was there yet.
inline constexpr std::size_t voiceFeatures = 3 * voiceEvidences + 1;

/// Feature extractor. The pitch is found by the normalised autocorrelation (P. Boersma, "Accurate short-term analysis
/// of the fundamental frequency and the harmonics-to-noise ratio of a sampled sound", 1993, without its path search,
/// which needs the future), spectra in frames of 64 ms. Means stand still in pauses, so that these do not dilute what
/// was heard. No feature depends on the level of the sound above -70 dB.
class VoiceFeatures
{
public:
    /// `fs` is the rate of the samples, 2 kHz or more. Allocates.
    explicit VoiceFeatures(double fs)
        : rate(fs),
          length(std::max<std::size_t>(16, static_cast<std::size_t>(std::lround(0.064 * fs)))),
          hop(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(0.016 * fs)))),
          fft(nextFastFftSize(2 * length)),
          line(length),
          windowed(fft.size()),
          re(fft.bins()),
          im(fft.bins()),
          power(fft.bins()),
          correlation(fft.size()),
          window(length)
    {
        double energy = 0.0;
        for (std::size_t i = 0; i < length; ++i)
        {
            window[i] =
                0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length));
            energy += window[i] * window[i];
        }
        scale = 2.0 / (energy * static_cast<double>(fft.size()));
        firstLag = std::max<std::size_t>(2, static_cast<std::size_t>(rate / 420.0));
        lastLag = std::min(length - 2, static_cast<std::size_t>(rate / 72.0) + 1);
        for (std::size_t lag = firstLag; lag <= lastLag; ++lag)
        {
            double sum = 0.0;
            for (std::size_t i = lag; i < length; ++i)
                sum += window[i] * window[i - lag];
            windowShare.push_back(sum / energy);
        }
        strengths.resize(windowShare.size());
        const double width = rate / static_cast<double>(fft.size());
        for (std::size_t b = 0; b < bands; ++b)
        {
            BandBins& bin = bandBins[b];
            bin.first = std::min(fft.bins(), static_cast<std::size_t>(edges[b] / width));
            bin.end = std::min(fft.bins(), static_cast<std::size_t>(edges[b + 1] / width) + 2);
            for (std::size_t k = bin.first; k < bin.end; ++k)
            {
                const double f = width * static_cast<double>(k);
                weights[b].push_back(clampTo(
                    (std::min(f + 0.5 * width, edges[b + 1]) - std::max(f - 0.5 * width, edges[b])) / width, 0.0, 1.0));
            }
            for (std::size_t c = 0; c < cosines; ++c)
                cosine[c][b] = std::sqrt(2.0 / static_cast<double>(bands)) *
                               std::cos(std::numbers::pi * static_cast<double>(c + 1) * (static_cast<double>(b) + 0.5) /
                                        static_cast<double>(bands));
        }
        seconds = static_cast<double>(hop) / rate;
        fastShare = share(0.025);
        slowShare = share(0.15);
        lateShare = share(0.06);
        meanShare = share(0.5);
        reset();
    }

    [[nodiscard]] std::size_t hopFrames() const noexcept { return hop; }
    [[nodiscard]] double hopSeconds() const noexcept { return seconds; }

    void reset() noexcept
    {
        std::fill(line.begin(), line.end(), 0.0);
        newest = 0;
        untilHop = hop;
        late = means = squares = {};
        levels = {};
        loudest = level = -90.0;
        fast = slow = -80.0;
        octave = voicedBefore = heard = 0.0;
        begun = averaging = active = false;
    }

    /// Takes one sample; true after each hop, when the features are new. Finite input.
    [[nodiscard]] bool push(double sample) noexcept
    {
        line[newest] = sample;
        newest = newest + 1 < length ? newest + 1 : 0;
        if (--untilHop > 0)
            return false;
        untilHop = hop;
        analyse();
        return true;
    }

    /// Is there sound, no pause? Else the features are those of the sound before.
    [[nodiscard]] bool isActive() const noexcept { return active; }

    [[nodiscard]] std::array<double, voiceFeatures> found() const noexcept
    {
        std::array<double, voiceFeatures> all{};
        for (std::size_t i = 0; i < voiceEvidences; ++i)
        {
            all[i] = late[i];
            all[voiceEvidences + i] = means[i];
            all[2 * voiceEvidences + i] = std::sqrt(std::max(0.0, squares[i]));
        }
        all.back() = std::exp(-heard / 0.4);
        return all;
    }

private:
    static constexpr std::size_t bands = 14;
    static constexpr std::size_t cosines = 6;
    static constexpr std::array<double, bands + 1> edges{80,   160,  250,  350,  460,  590,  740, 920,
                                                         1130, 1380, 1680, 2040, 2470, 2980, 3600};
    using Evidence = std::array<double, voiceEvidences>;

    struct BandBins
    {
        std::size_t first = 0;
        std::size_t end = 0;
    };

    /// Share of a step of a one-pole mean with the time constant `tau`, s.
    [[nodiscard]] double share(double tau) const noexcept { return 1.0 - std::exp(-seconds / tau); }

    [[nodiscard]] std::size_t binOf(double frequency) const noexcept
    {
        return std::min(fft.bins(),
                        static_cast<std::size_t>(std::ceil(frequency / rate * static_cast<double>(fft.size()))));
    }

    [[nodiscard]] double powerBetween(double from, double to) const noexcept
    {
        double sum = 0.0;
        for (std::size_t k = binOf(from); k < binOf(to); ++k)
            sum += power[k];
        return sum;
    }

    void transform() noexcept
    {
        for (std::size_t i = 0; i < length; ++i)
        {
            const std::size_t at = newest + i < length ? newest + i : newest + i - length;
            windowed[i] = window[i] * line[at];
        }
        std::fill(windowed.begin() + static_cast<std::ptrdiff_t>(length), windowed.end(), 0.0);
        fft.forward(windowed.data(), re.data(), im.data());
        for (std::size_t k = 0; k < power.size(); ++k)
            power[k] = scale * (re[k] * re[k] + im[k] * im[k]);
    }

    void analyse() noexcept
    {
        transform();
        Evidence now{};
        const auto put = [&now](VoiceEvidence which, double value)
        {
            now[static_cast<std::size_t>(which)] = value;
        };
        const double before = std::exchange(level, spectrum(now));
        loudest = std::max(level, loudest - 10.0 * seconds);
        active = level > loudest - 25.0 && level > -70.0;
        const double change = begun ? level - before : 0.0;
        put(VoiceEvidence::rise, clampTo(change, 0.0, 12.0) / 4.0);
        put(VoiceEvidence::fall, clampTo(-change, 0.0, 12.0) / 4.0);
        const double floored = std::max(level, -80.0);
        fast += fastShare * (floored - fast);
        slow += slowShare * (floored - slow);
        put(VoiceEvidence::modulation, std::min(std::abs(fast - slow), 15.0) / 6.0);
        findPitch(now);
        constexpr double tiny = 1e-10;
        put(VoiceEvidence::low,
            clampTo(10.0 * std::log10((powerBetween(20.0, 70.0) + tiny) / (powerBetween(70.0, 1000.0) + tiny)), -30.0,
                    20.0) /
                20.0);
        put(VoiceEvidence::noise, flatness() / 15.0);
        begun = true;
        if (active)
            average(now);
    }

    /// Cosines and flux of the levels in bands; returns the level of all, dB.
    [[nodiscard]] double spectrum(Evidence& now) noexcept
    {
        std::array<double, bands> powers{};
        double all = 1e-9;
        for (std::size_t b = 0; b < bands; ++b)
        {
            for (std::size_t k = bandBins[b].first; k < bandBins[b].end; ++k)
                powers[b] += weights[b][k - bandBins[b].first] * power[k];
            all += powers[b];
        }
        double change = 0.0;
        for (std::size_t b = 0; b < bands; ++b)
        {
            const double next = 10.0 * std::log10(std::max(powers[b] / all, 1e-4));
            change += begun ? std::abs(next - levels[b]) : 0.0;
            levels[b] = next;
        }
        now[static_cast<std::size_t>(VoiceEvidence::flux)] = std::min(change / static_cast<double>(bands), 8.0) / 4.0;
        for (std::size_t c = 0; c < cosines; ++c)
        {
            double sum = 0.0;
            for (std::size_t b = 0; b < bands; ++b)
                sum += cosine[c][b] * levels[b];
            now[c] = sum / 20.0;
        }
        return 10.0 * std::log10(all);
    }

    /// The autocorrelation is the transform of the power from 60 to 1300 Hz: the pitch and a few harmonics.
    void findPitch(Evidence& now) noexcept
    {
        const std::size_t first = binOf(60.0);
        const std::size_t end = binOf(1300.0);
        std::fill(im.begin(), im.end(), 0.0);
        for (std::size_t k = 0; k < re.size(); ++k)
            re[k] = k >= first && k < end ? power[k] : 0.0;
        fft.inverse(re.data(), im.data(), correlation.data());
        const double whole = correlation.front() + 1e-12;
        double best = 0.0;
        std::size_t pick = 1;
        for (std::size_t i = 0; i < strengths.size(); ++i)
            strengths[i] = clampTo(correlation[firstLag + i] / whole / windowShare[i], -1.0, 1.0);
        if (strengths.size() < 3)
            return;
        for (std::size_t i = 1; i + 1 < strengths.size(); ++i)
            if (strengths[i] > best)
            {
                best = strengths[i];
                pick = i;
            }
        for (std::size_t i = 1; i + 1 < strengths.size(); ++i) // the shortest period that is about as good
            if (strengths[i] >= 0.87 * best && strengths[i] >= strengths[i - 1] && strengths[i] > strengths[i + 1])
            {
                pick = i;
                break;
            }
        const double curve = strengths[pick - 1] - 2.0 * strengths[pick] + strengths[pick + 1];
        const double offset = std::abs(curve) > 1e-9
                                  ? clampTo(0.5 * (strengths[pick - 1] - strengths[pick + 1]) / curve, -0.5, 0.5)
                                  : 0.0;
        const double next = std::log2(rate / (static_cast<double>(firstLag + pick) + offset));
        const double voiced = std::max(0.0, strengths[pick]);
        const double moved = begun ? std::abs(next - octave) : 0.0;
        const bool both = voiced > 0.6 && voicedBefore > 0.6;
        octave = next;
        voicedBefore = voiced;
        const auto put = [&now](VoiceEvidence which, double value)
        {
            now[static_cast<std::size_t>(which)] = value;
        };
        put(VoiceEvidence::voiced, voiced);
        put(VoiceEvidence::pitch, voiced > 0.5 ? next - 7.3 : 0.0);
        put(VoiceEvidence::glide, both && moved < 0.08 ? std::min(moved, 0.04) / 0.04 : 0.0);
        put(VoiceEvidence::steady, both && moved < 0.0015 ? 1.0 : 0.0);
        put(VoiceEvidence::step, both && moved >= 0.08 ? 1.0 : 0.0);
    }

    /// Geometric over arithmetic mean of the power, dB.
    [[nodiscard]] double flatness() const noexcept
    {
        double logarithms = 0.0;
        double sum = 0.0;
        const std::size_t first = binOf(300.0);
        const std::size_t end = binOf(3400.0);
        // The logarithm of a product of a few is that of all with fewer calls; 8 of them stay within the doubles.
        for (std::size_t k = first; k < end;)
        {
            double product = 1.0;
            for (const std::size_t until = std::min(end, k + 8); k < until; ++k)
            {
                const double bounded = clampTo(power[k] + 1e-13, 1e-13, 1e30);
                product *= bounded;
                sum += bounded;
            }
            logarithms += std::log10(product);
        }
        const auto count = static_cast<double>(end - first);
        return end > first ? clampTo(10.0 * (logarithms / count - std::log10(sum / count)), -30.0, 0.0) : 0.0;
    }

    void average(const Evidence& now) noexcept
    {
        heard += seconds;
        if (!std::exchange(averaging, true))
        {
            late = means = now;
            return;
        }
        for (std::size_t i = 0; i < voiceEvidences; ++i)
        {
            late[i] += lateShare * (now[i] - late[i]);
            means[i] += meanShare * (now[i] - means[i]);
            const double away = now[i] - means[i];
            squares[i] += meanShare * (away * away - squares[i]);
            flushTiny(squares[i]);
        }
    }

    double rate;
    std::size_t length;
    std::size_t hop;
    SplitRealFft<double> fft;
    std::vector<double> line; // a ring of the newest samples
    std::vector<double> windowed, re, im, power, correlation, window;
    std::vector<double> windowShare, strengths; // by lag
    std::array<std::vector<double>, bands> weights;
    std::array<BandBins, bands> bandBins{};
    std::array<std::array<double, bands>, cosines> cosine{};
    double scale = 1.0;
    double seconds = 0.016; // of a hop
    double fastShare = 1.0, slowShare = 1.0, lateShare = 1.0, meanShare = 1.0;
    std::size_t firstLag = 1;
    std::size_t lastLag = 1;

    std::size_t newest = 0; // index behind it
    std::size_t untilHop = 1;
    Evidence late{}, means{}, squares{};
    std::array<double, bands> levels{};
    double loudest = 0.0, level = 0.0, fast = 0.0, slow = 0.0;
    double octave = 0.0, voicedBefore = 0.0;
    double heard = 0.0; // s
    bool begun = false, averaging = false, active = false;
};

} // namespace pacini
