#include "study/TrialSound.h"

#include <pacini/foundation/Gaussian.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace pacini::study
{

namespace
{
/// Adds stimuli at the end of a trial.
class Assembly
{
public:
    Assembly(TrialSound& toFill, const Block& ofBlock, const StimulusMaker& maker)
        : trial(toFill), block(ofBlock), fs(maker.params().sampleRate)
    {
        trial.more.resize(static_cast<std::size_t>(maker.study().row.actuators) - 1);
    }

    /// Sound and touch as the block presents them, the touch `delay` s later.
    void add(const PreparedStimulus& stimulus, double delay)
    {
        const std::size_t begin = trial.sound.size();
        switch (block.presentation)
        {
        case Presentation::sound:
            put(stimulus.sound, nullptr, 0.0);
            break;
        case Presentation::touch:
            put({}, &stimulus, 0.0);
            break;
        case Presentation::simultaneous:
            put(stimulus.sound, &stimulus, delay);
            break;
        case Presentation::consecutive:
            put(stimulus.sound, nullptr, 0.0);
            pause();
            alone.push_back({trial.sound.size(), trial.sound.size() + stimulus.touch.size()});
            put({}, &stimulus, 0.0);
            break;
        }
        trial.parts.push_back({begin, trial.sound.size()});
    }

    void pause() { lengthen(framesOf(block.pause)); }

    /// Where something is felt and nothing heard, for the noise that hides the actuator: of touches alone the whole, so
    /// that its ends tell nothing.
    [[nodiscard]] std::vector<FrameRange> feltAlone() const
    {
        if (block.presentation == Presentation::touch && !trial.sound.empty())
            return {{0, trial.sound.size()}};
        return alone;
    }

private:
    [[nodiscard]] std::size_t framesOf(double seconds) const
    {
        return static_cast<std::size_t>(std::llround(std::max(seconds, 0.0) * fs));
    }
    void lengthen(std::size_t frames)
    {
        trial.sound.resize(trial.sound.size() + frames, 0.0f);
        trial.touch.resize(trial.sound.size(), 0.0f);
        for (std::vector<float>& drive : trial.more)
            drive.resize(trial.sound.size(), 0.0f);
    }
    /// `felt`: whose touches; null for none.
    void put(std::span<const float> sound, const PreparedStimulus* felt, double delay)
    {
        const std::size_t begin = trial.sound.size();
        const std::size_t soundAt = begin + framesOf(-delay), touchAt = begin + framesOf(delay);
        const std::size_t soundEnd = sound.empty() ? begin : soundAt + sound.size();
        const std::size_t touchEnd = felt == nullptr ? begin : touchAt + felt->touch.size();
        lengthen(std::max(soundEnd, touchEnd) - begin);
        if (!sound.empty())
            std::copy(sound.begin(), sound.end(), trial.sound.begin() + static_cast<std::ptrdiff_t>(soundAt));
        if (felt == nullptr)
            return;
        const auto at = static_cast<std::ptrdiff_t>(touchAt);
        std::copy(felt->touch.begin(), felt->touch.end(), trial.touch.begin() + at);
        for (std::size_t a = 0; a < felt->more.size(); ++a)
            std::copy(felt->more[a].begin(), felt->more[a].end(), trial.more[a].begin() + at);
    }

    TrialSound& trial;
    const Block& block;
    double fs;
    std::vector<FrameRange> alone;
};

std::optional<std::size_t> onsetOf(const std::vector<float>& samples)
{
    const auto found = std::find_if(samples.begin(), samples.end(), [](float sample) { return sample != 0.0f; });
    return found == samples.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - samples.begin()));
}

/// Band-limited Gaussian noise with short fades on a stretch of the sound.
void addMasking(std::span<float> sound, const Masking& masking, int sampleRate, Random& random)
{
    const double fs = sampleRate;
    std::vector<double> noise(sound.size());
    // One pole each way is enough for a mask.
    const double low = std::exp(-2.0 * std::numbers::pi * masking.lowFrequency / fs);
    const double high = std::exp(-2.0 * std::numbers::pi * std::min(masking.highFrequency, 0.45 * fs) / fs);
    double slow = 0.0, fast = 0.0, power = 0.0;
    for (double& sample : noise)
    {
        fast = (1.0 - high) * normalNumber(random) + high * fast;
        slow = (1.0 - low) * fast + low * slow;
        sample = fast - slow;
        power += sample * sample;
    }
    if (!(power > 0.0))
        return;
    const double gain = Decibels(masking.level).gain() / std::sqrt(power / static_cast<double>(noise.size()));
    const double fade = 0.05 * fs;
    for (std::size_t n = 0; n < noise.size(); ++n)
    {
        const auto fromEnd = static_cast<double>(std::min(n, noise.size() - 1 - n));
        sound[n] += static_cast<float>(gain * std::min(1.0, fromEnd / fade) * noise[n]);
    }
}

void finish(TrialSound& trial, const Assembly& assembly, const StimulusMaker& maker, const Block& block,
            std::uint64_t seed)
{
    trial.soundOnset = onsetOf(trial.sound);
    trial.touchOnset = onsetOf(trial.touch);
    for (const std::vector<float>& drive : trial.more)
        if (const auto other = onsetOf(drive); other && (!trial.touchOnset || *other < *trial.touchOnset))
            trial.touchOnset = other;
    if (!block.masking)
        return;
    Random random(seed);
    for (const FrameRange& range : assembly.feltAlone())
        addMasking(std::span(trial.sound).subspan(range.begin, range.end - range.begin), maker.study().masking,
                   maker.params().sampleRate, random);
}

/// Of the touch after the sound, so that what comes out has the delay that the study asks for.
double delayOf(const StimulusMaker& maker, const Block& block, const std::optional<Variation>& variation)
{
    const double asked =
        block.delay + (variation && variation->variable == Variable::delay ? variation->value / 1000.0 : 0.0);
    return asked - maker.params().touchLatency;
}
} // namespace

Result<TrialSound> makeTrial(StimulusMaker& maker, const Trial& trial, std::optional<double> level,
                             std::uint64_t maskingSeed)
{
    const Block& block = maker.study().blocks[trial.block];
    TrialSound made;
    Assembly assembly(made, block, maker);
    for (std::size_t i = 0; i < trial.stimuli.size(); ++i)
    {
        std::optional<Variation> variation;
        if (level && static_cast<int>(i) == trial.right)
            variation = Variation{block.adaptive.variable, *level};
        auto stimulus = maker.make(trial.stimuli[i], variation);
        if (!stimulus)
            return stimulus.error();
        if (level && block.adaptive.variable == Variable::level && !variation)
        {
            std::fill(stimulus->touch.begin(), stimulus->touch.end(), 0.0f);
            for (std::vector<float>& drive : stimulus->more)
                std::fill(drive.begin(), drive.end(), 0.0f);
        }
        if (i > 0)
            assembly.pause();
        assembly.add(*stimulus, delayOf(maker, block, variation));
    }
    finish(made, assembly, maker, block, maskingSeed);
    return made;
}

Result<TrialSound> makePart(StimulusMaker& maker, const Block& block, std::size_t stimulus, std::uint64_t maskingSeed)
{
    const auto prepared = maker.make(stimulus);
    if (!prepared)
        return prepared.error();
    TrialSound made;
    Assembly assembly(made, block, maker);
    assembly.add(*prepared, delayOf(maker, block, std::nullopt));
    finish(made, assembly, maker, block, maskingSeed);
    return made;
}

} // namespace pacini::study
