#include "document/SoundComparison.h"

#include <pacini/evaluate/Comparison.h>
#include <pacini/synthesis/RenderScene.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace pacini
{

namespace
{
constexpr double comparedRate = 8000.0; // Hz: what is felt ends at 1 kHz

Result<std::vector<float>> driveOf(const Clip& clip, double duration)
{
    const double frames = std::ceil(duration * comparedRate);
    RenderParams params;
    params.compile.sampleRate = comparedRate;
    params.to = frames / comparedRate;
    auto rendered = renderScene(sceneOf(clip), nullptr, params);
    if (!rendered)
        return rendered.error();
    rendered->samples.resize(static_cast<std::size_t>(frames), 0.0f);
    return std::move(rendered->samples);
}

std::vector<std::uint8_t> levelsOf(MonoSource source, double rate, const SoundComparison& of)
{
    SpectrumAnalyzer analyser(std::move(source), rate, of.rows);
    std::vector<std::uint8_t> levels(SoundComparison::columns * of.rows.count);
    for (std::size_t i = 0; i < SoundComparison::columns; ++i)
        analyser.column(of.duration * (static_cast<double>(i) + 0.5) / SoundComparison::columns,
                        std::span(levels).subspan(i * of.rows.count, of.rows.count));
    return levels;
}

/// Raises the drive to the sound's level, which is no difference, and says what is left.
void takeDifference(SoundComparison& found)
{
    const auto loudest =
        static_cast<float>(SpectrumLevel::decibels(*std::max_element(found.sound.begin(), found.sound.end())));
    const auto floor = loudest - SoundComparison::quiet;
    const auto soundAt = [&](std::size_t i)
    {
        return static_cast<float>(SpectrumLevel::decibels(found.sound[i]));
    };
    const auto driveAt = [&](std::size_t i)
    {
        return static_cast<float>(SpectrumLevel::decibels(found.drive[i]));
    };
    std::vector<float> offsets;
    for (std::size_t i = 0; i < found.sound.size(); ++i)
        if (soundAt(i) > floor && found.drive[i] > 0)
            offsets.push_back(soundAt(i) - driveAt(i));
    if (!offsets.empty())
    {
        const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
        std::nth_element(offsets.begin(), middle, offsets.end());
        found.gain = static_cast<double>(*middle);
    }
    const std::size_t rows = found.rows.count;
    found.difference.assign(found.sound.size(), 0.0f);
    found.differenceOfRows.assign(rows, 0.0);
    std::vector<std::size_t> counts(rows);
    for (std::size_t i = 0; i < found.sound.size(); ++i)
    {
        const float sound = std::max(soundAt(i), floor);
        const float drive = std::max(driveAt(i) + static_cast<float>(found.gain), floor);
        if (found.drive[i] > 0)
            found.drive[i] = SpectrumLevel::byteOf(static_cast<double>(driveAt(i)) + found.gain);
        found.difference[i] = drive - sound;
        if (sound > floor)
        {
            found.differenceOfRows[i % rows] += static_cast<double>(std::abs(drive - sound));
            ++counts[i % rows];
        }
    }
    for (std::size_t k = 0; k < rows; ++k)
        if (counts[k] > 0)
            found.differenceOfRows[k] /= static_cast<double>(counts[k]);
}
} // namespace

Result<SoundComparison> compareWithSound(const Clip& clip, const StoredAudio& audio, const std::atomic<bool>& cancelled)
{
    SoundComparison found;
    found.duration = std::min({clip.duration, audio.duration(), SoundComparison::longest});
    auto drive = driveOf(clip, found.duration);
    if (!drive)
        return drive.error();
    std::vector<float> mono(static_cast<std::size_t>(found.duration * audio.rate()));
    audio.readMean(0, mono);
    if (cancelled)
        return wasCancelled();
    found.sound = levelsOf(mono, audio.rate(), found);
    found.drive = levelsOf(*drive, comparedRate, found);
    takeDifference(found);
    if (cancelled)
        return wasCancelled();
    Comparer comparer;
    if (auto done = comparer.setReference(mono, audio.rate()); !done)
        return done.error();
    if (cancelled)
        return wasCancelled();
    if (auto done = comparer.setCandidate(*drive, static_cast<int>(comparedRate)); !done)
        return done.error();
    const Comparison scores = comparer.compare();
    found.score = scores.hts.score;
    found.best = scores.ceiling;
    if (scores.match)
    {
        found.match = predictedMatch(*scores.match);
        found.bestMatch = scores.matchOfSound;
    }
    return found;
}

} // namespace pacini
