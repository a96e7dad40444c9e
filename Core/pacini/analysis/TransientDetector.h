#pragma once

// The thesis's transient detector: where a fast envelope runs ahead of a slow one.

#include <pacini/analysis/DecayTime.h>
#include <pacini/analysis/TransientScore.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/FixedVector.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace pacini
{

/// Parameters of the transient detector. The defaults give 2.3 transients per second on 30 peak-normalised recordings
/// (the thesis assumes 2; its own settings are lost).
struct TransientDetectorParams
{
    TransientScoreParams score;
    double threshold = 0.3;         ///< of the score, reached or exceeded
    Seconds minimumWindow{0.0};     ///< the peak is looked for at least this long
    Seconds minimumDistance{0.010}; ///< of two events; the larger one stays
    double minimumAmplitude = 0.05; ///< linear
    bool operator==(const TransientDetectorParams&) const = default;
};

/// An event: the frame (counted from reset) and the level |x| of its peak.
struct DetectedTransient
{
    std::uint64_t frame = 0;
    double amplitude = 0.0;
    bool operator==(const DetectedTransient&) const = default;
};

/// Transient detector (Weber 2020, section 4.3.1, Algorithm 4.2): while the score is at or above the threshold a window
/// is open; the event is the first largest |x| in it. Then the masks: events below the minimum amplitude are dropped;
/// of events closer than the minimum distance the later one replaces the earlier if it is larger, else it is dropped.
/// Chunks of any size give the same events as the whole signal. At most 32 windows may be open at once (with a minimum
/// window they can overlap); one more is not opened.
class TransientDetector
{
public:
    using Params = TransientDetectorParams;

    void prepare(const ProcessSpec& spec) noexcept
    {
        fs = spec.sampleRate;
        score.prepare(spec);
        setParams(current);
        reset();
    }
    void setParams(const Params& params) noexcept
    {
        current = params;
        score.setParams(params.score);
        windowFrames = roundedFrames(params.minimumWindow, fs);
        distanceFrames = roundedFrames(params.minimumDistance, fs);
    }
    void reset() noexcept
    {
        score.reset();
        open.clear();
        pending.reset();
        active = false;
        now = 0;
    }

    /// Calls sink(DetectedTransient) for every event that nothing later can replace any more: about the length of its
    /// window and the minimum distance after it happened.
    template <typename Sink>
    void process(std::span<const float> in, Sink&& sink) noexcept(isNothrow<Sink>)
    {
        for (const float sample : in)
        {
            tick(finiteOrZero(sample), sink);
            if (++now % flushInterval == 0)
                score.flush();
        }
    }

    /// The end of the signal: open windows close, and the last event leaves. Then reset() before the next signal.
    template <typename Sink>
    void finish(Sink&& sink) noexcept(isNothrow<Sink>)
    {
        for (const Window& window : open)
            consider(window.peak, sink);
        open.clear();
        emitPending(sink);
    }

private:
    template <typename Sink>
    static constexpr bool isNothrow = std::is_nothrow_invocable_v<Sink&, const DetectedTransient&>;

    struct Window
    {
        std::uint64_t begin = 0;
        bool running = true; ///< the score is still above the threshold
        DetectedTransient peak;
    };

    template <typename Sink>
    void tick(double x, Sink& sink)
    {
        const bool above = score.tick(x) >= current.threshold;
        if (above && !active && open.size() < open.capacity())
            open.pushBack({now, true, {now, -1.0}});
        else if (!above && active && !open.empty())
            open[open.size() - 1].running = false;
        active = above;

        while (!open.empty() && !open.front().running && now >= open.front().begin + windowFrames)
        {
            consider(open.front().peak, sink);
            open.popFront();
        }
        const double level = std::abs(x);
        for (Window& window : open)
            if (level > window.peak.amplitude)
                window.peak = {now, level};

        const std::uint64_t earliestNext = open.empty() ? now + 1 : open.front().begin;
        if (pending && pending->frame + distanceFrames <= earliestNext)
            emitPending(sink);
    }

    template <typename Sink>
    void consider(const DetectedTransient& candidate, Sink& sink)
    {
        if (candidate.amplitude < current.minimumAmplitude)
            return;
        if (pending && candidate.frame < pending->frame + distanceFrames)
        {
            if (candidate.amplitude > pending->amplitude)
                pending = candidate;
            return;
        }
        emitPending(sink);
        pending = candidate;
    }

    template <typename Sink>
    void emitPending(Sink& sink)
    {
        if (pending)
            sink(*pending);
        pending.reset();
    }

    double fs = ProcessSpec{}.sampleRate;
    Params current;
    TransientScore score;
    std::size_t windowFrames = 0;
    std::size_t distanceFrames = 0;
    FixedVector<Window, 32> open; ///< in order of their begin
    std::optional<DetectedTransient> pending;
    bool active = false;
    std::uint64_t now = 0;
};

/// The events of a whole signal in order of time; fs in Hz. Empty for an empty or silent signal.
[[nodiscard]] inline std::vector<DetectedTransient> detectTransients(std::span<const float> signal, double fs,
                                                                     const TransientDetectorParams& params = {})
{
    TransientDetector detector;
    detector.setParams(params);
    detector.prepare({fs, signal.size()});
    std::vector<DetectedTransient> events;
    const auto keep = [&events](const DetectedTransient& event)
    {
        events.push_back(event);
    };
    detector.process(signal, keep);
    detector.finish(keep);
    return events;
}

} // namespace pacini
