#pragma once

// The thesis's transient detector: where a fast envelope runs ahead of a slow one.

#include <pacini/analysis/DecayTime.h>
#include <pacini/analysis/EnvelopeFollower.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/FixedVector.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace pacini
{

enum class TransientScore
{
    absolute, ///< |fast - slow|: the thesis's; depends on the level of the sound
    relative, ///< (fast - slow) / (slow + floor)
};

/// The defaults give the thesis's rate of about two transients per second on peak-normalised recordings; its own
/// settings are lost. Times are clamped like those of EnvelopeFollowerParams.
struct TransientDetectorParams
{
    TransientScore score = TransientScore::absolute;
    double threshold = 0.3; ///< of the score, reached or exceeded
    double floor = 0.03;    ///< of the relative score, linear amplitude, 1e-9 and above
    Seconds fastAttack{0.001};
    Seconds slowAttack{0.030};
    Seconds hold{0.016};    ///< of both followers
    Seconds release{0.100}; ///< of both followers
    DecayDefinition decay = DecayDefinition::percent99;
    Seconds minimumWindow{0.0};     ///< the peak is looked for at least this long
    Seconds minimumDistance{0.010}; ///< of two events; the larger one stays
    double minimumAmplitude = 0.05; ///< linear
    bool operator==(const TransientDetectorParams&) const = default;
};

/// The relative score with times for up to 80 events per second.
[[nodiscard]] inline TransientDetectorParams relativeTransientParams() noexcept
{
    TransientDetectorParams params;
    params.score = TransientScore::relative;
    params.threshold = 2.0;
    params.fastAttack = Seconds(0.0005);
    params.slowAttack = Seconds(0.020);
    params.hold = Seconds(0.005);
    params.release = Seconds(0.010);
    params.minimumWindow = Seconds(0.002);
    params.minimumDistance = Seconds(0.008);
    return params;
}

/// An event: the frame (counted from reset) and the level |x| of its peak.
struct DetectedTransient
{
    std::size_t frame = 0;
    double amplitude = 0.0;
    bool operator==(const DetectedTransient&) const = default;
};

/// The transient score sample by sample (Weber 2020, Algorithm 4.2, lines 3 to 5).
class TransientScorer
{
public:
    void prepare(const ProcessSpec& spec) noexcept
    {
        fast.prepare(spec);
        slow.prepare(spec);
    }
    void setParams(const TransientDetectorParams& params) noexcept
    {
        score = params.score;
        floor = clampTo(params.floor, 1e-9, 1e9);
        EnvelopeFollowerParams follower{.attack = params.fastAttack,
                                        .hold = params.hold,
                                        .release = params.release,
                                        .decay = params.decay,
                                        .slope = RisingSlope::level};
        fast.setParams(follower);
        follower.attack = params.slowAttack;
        slow.setParams(follower);
    }
    void reset() noexcept
    {
        fast.reset();
        slow.reset();
    }

    /// The score after one more sample (finite).
    double tick(double x) noexcept
    {
        const double ahead = fast.tick(x);
        const double behind = slow.tick(x);
        return score == TransientScore::absolute ? std::abs(ahead - behind) : (ahead - behind) / (behind + floor);
    }

    void flush() noexcept
    {
        fast.flush();
        slow.flush();
    }

private:
    TransientScore score = TransientScore::absolute;
    double floor = 0.03;
    EnvelopeFollower fast;
    EnvelopeFollower slow;
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
        scorer.prepare(spec);
        setParams(current);
        reset();
    }
    void setParams(const Params& params) noexcept
    {
        current = params;
        scorer.setParams(params);
        windowFrames = roundedFrames(params.minimumWindow, fs);
        distanceFrames = roundedFrames(params.minimumDistance, fs);
    }
    void reset() noexcept
    {
        scorer.reset();
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
            ++now;
        }
        scorer.flush();
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
        std::size_t begin = 0;
        bool running = true; ///< the score is still above the threshold
        DetectedTransient peak;
    };

    template <typename Sink>
    void tick(double x, Sink& sink)
    {
        const bool above = scorer.tick(x) >= current.threshold;
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

        const std::size_t earliestNext = open.empty() ? now + 1 : open.front().begin;
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
    TransientScorer scorer;
    std::size_t windowFrames = 0;
    std::size_t distanceFrames = 0;
    FixedVector<Window, 32> open; ///< in order of their begin
    std::optional<DetectedTransient> pending;
    bool active = false;
    std::size_t now = 0;
};

/// The score of a whole signal, one value per sample; fs in Hz.
[[nodiscard]] inline std::vector<double> transientScore(std::span<const float> signal, double fs,
                                                        const TransientDetectorParams& params)
{
    TransientScorer scorer;
    scorer.prepare({fs, signal.size()});
    scorer.setParams(params);
    std::vector<double> score(signal.size());
    std::transform(signal.begin(), signal.end(), score.begin(),
                   [&scorer](float x) { return scorer.tick(finiteOrZero(x)); });
    return score;
}

/// The events of a whole signal in order of time; fs in Hz. Empty for an empty or silent signal.
[[nodiscard]] inline std::vector<DetectedTransient> detectTransients(std::span<const float> signal, double fs,
                                                                     const TransientDetectorParams& params)
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
