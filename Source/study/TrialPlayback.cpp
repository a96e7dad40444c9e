#include "study/TrialPlayback.h"

#include <algorithm>
#include <utility>

namespace pacini::study
{

TrialPlayback::~TrialPlayback()
{
    collect();
    delete given.exchange(nullptr);
    delete current;
}

void TrialPlayback::collect() noexcept
{
    delete done.exchange(nullptr, std::memory_order_acq_rel);
}

void TrialPlayback::prepare(double sampleRate) noexcept
{
    fs.store(sampleRate);
    clock = 0;
}

void TrialPlayback::play(TrialSound trial)
{
    collect();
    soundAt = trial.soundOnset;
    touchAt = trial.touchOnset;
    complete.store(false);
    dropouts.store(0);
    startFrame.store(-1);
    frame.store(0);
    stopping.store(false);
    playing.store(true);
    delete given.exchange(new Running{std::move(trial), 0}, std::memory_order_acq_rel);
}

void TrialPlayback::stop() noexcept
{
    stopping.store(true);
    // What has not begun does not begin.
    if (Running* waiting = given.exchange(nullptr, std::memory_order_acq_rel))
    {
        delete waiting;
        playing.store(false);
    }
}

PlaybackReport TrialPlayback::report() const noexcept
{
    PlaybackReport report;
    report.playing = playing.load();
    report.complete = complete.load();
    report.frame = frame.load();
    report.dropouts = dropouts.load();
    if (const std::int64_t start = startFrame.load(); start >= 0)
    {
        const auto at = [&](std::size_t offset)
        {
            return (static_cast<double>(start) + static_cast<double>(offset)) / fs.load();
        };
        if (soundAt)
            report.soundOnset = at(*soundAt);
        if (touchAt)
            report.touchOnset = at(*touchAt);
    }
    return report;
}

void TrialPlayback::drop() noexcept
{
    if (playing.load())
        dropouts.fetch_add(1);
}

void TrialPlayback::process(std::span<float> left, std::span<float> right,
                            std::span<const std::span<float>> touches) noexcept
{
    std::fill(left.begin(), left.end(), 0.0f);
    std::fill(right.begin(), right.end(), 0.0f);
    for (const std::span<float> touch : touches)
        std::fill(touch.begin(), touch.end(), 0.0f);
    // What was played goes back to be freed; while the one before has not been fetched, nothing new begins.
    const auto giveBack = [this]
    {
        Running* none = nullptr;
        if (current != nullptr && done.compare_exchange_strong(none, current, std::memory_order_acq_rel))
            current = nullptr;
        return current == nullptr;
    };
    if (given.load(std::memory_order_acquire) != nullptr && giveBack())
    {
        current = given.exchange(nullptr, std::memory_order_acq_rel);
        gain = 1.0;
        if (current != nullptr)
            startFrame.store(clock);
    }
    if (current != nullptr && playing.load())
    {
        const TrialSound& trial = current->trial;
        const std::size_t count = std::min(left.size(), trial.sound.size() - current->next);
        const bool fades = stopping.load();
        const double step = 1.0 / (0.005 * fs.load());
        for (std::size_t n = 0; n < count; ++n)
        {
            if (fades)
                gain = std::max(0.0, gain - step);
            const auto scale = static_cast<float>(gain);
            left[n] = right[n] = scale * trial.sound[current->next + n];
            for (std::size_t a = 0; a < std::min(touches.size(), trial.more.size() + 1); ++a)
                touches[a][n] = scale * (a == 0 ? trial.touch : trial.more[a - 1])[current->next + n];
        }
        current->next += count;
        frame.store(current->next);
        const bool ended = current->next == trial.sound.size();
        if (ended || (fades && gain == 0.0))
        {
            complete.store(ended && !fades);
            playing.store(false);
        }
    }
    clock += static_cast<std::int64_t>(left.size());
}

} // namespace pacini::study
