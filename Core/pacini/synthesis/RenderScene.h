#pragma once

// Rendering of a scene: adjustment, plan, and playback into a sink, part by part.

#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/SizeInMemory.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/RenderParams.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/SceneAdjustment.h>
#include <pacini/synthesis/SignalPlayer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// The next frames of a rendering.
struct RenderBlock
{
    std::span<const std::span<float>> channels; ///< one for each actuator, all of the same length, 1 or more
    const ProtectionMeter* meter = nullptr;     ///< of the first actuator in these frames; null: nothing is protected

    [[nodiscard]] std::size_t frames() const noexcept { return channels.front().size(); }
};

/// Receiver of a rendering. An error that it returns ends the rendering, which returns it.
class RenderSink
{
public:
    virtual ~RenderSink() = default;

    /// Called once before anything plays, with how many frames will come.
    [[nodiscard]] virtual Result<void> begin(const RenderPlan& /*plan*/, std::uint64_t /*frames*/) { return {}; }

    [[nodiscard]] virtual Result<void> take(const RenderBlock& block) = 0;

    /// Called repeatedly with the share that is done, also while content before the output is skipped.
    [[nodiscard]] virtual Result<void> progress(double /*share*/) { return {}; }
};

namespace detail
{
/// Energies of a signal and of its difference from another, over all channels.
class SignalError
{
public:
    void add(std::span<const std::span<float>> wanted, std::span<const std::span<float>> found)
    {
        for (std::size_t a = 0; a < wanted.size(); ++a)
            for (std::size_t n = 0; n < wanted[a].size(); ++n)
            {
                const auto x = static_cast<double>(wanted[a][n]);
                const double d = static_cast<double>(found[a][n]) - x;
                energy += x * x;
                difference += d * d;
            }
    }
    [[nodiscard]] double decibels() const
    {
        return difference > 0.0 ? Decibels::fromPower(difference / energy).value
                                : -std::numeric_limits<double>::infinity();
    }

private:
    double energy = 0.0, difference = 0.0;
};

/// A buffer for each actuator.
class RenderBuffers
{
public:
    RenderBuffers(std::size_t count, std::size_t frames) : samples(count, std::vector<float>(frames)), spans(count) {}

    [[nodiscard]] std::span<const std::span<float>> first(std::size_t frames)
    {
        for (std::size_t a = 0; a < samples.size(); ++a)
            spans[a] = std::span(samples[a]).first(frames);
        return spans;
    }

private:
    std::vector<std::vector<float>> samples;
    std::vector<std::span<float>> spans;
};

/// The part of a rendering that is output, in frames.
struct RenderPart
{
    std::uint64_t first = 0, last = 0;
};

/// Errors: invalidArgument where nothing is left.
inline Result<RenderPart> renderPart(const RenderParams& params, std::uint64_t total)
{
    const double fs = params.compile.sampleRate;
    const auto frameOf = [fs](double time)
    {
        return static_cast<std::uint64_t>(std::llround(time * fs));
    };
    const RenderPart part{frameOf(params.from), params.to ? std::min(total, frameOf(*params.to)) : total};
    if (part.first >= part.last && (part.first > 0 || part.last < total))
        return Error{ErrorCode::invalidArgument, "",
                     "has nothing from " + numberText(params.from) + " s on" +
                         (params.to ? " to " + numberText(*params.to) + " s" : "") + "; it lasts " +
                         decimalText(static_cast<double>(total) / fs, 3) + " s"};
    return part;
}
} // namespace detail

/// First half of renderScene(): adjusts `scene` and compiles its plan for an actuator. Errors: as there.
[[nodiscard]] inline Result<RenderPlan> planScene(Scene scene, const Profile* profile, const RenderParams& params)
{
    scene = adjusted(std::move(scene), params.adjustment);
    double length = scene.duration;
    if (length == 0.0 && scene.changes.empty() && scene.plays.size() == 1 &&
        scene.plays.front().clip < scene.clips.size())
    {
        const ScenePlay& play = scene.plays.front();
        length = play.start + scene.clips[play.clip].duration * play.stretch;
    }
    if (length > limits::duration)
        return Error{ErrorCode::tooLarge, "",
                     "would last " + decimalText(length / 3600.0, 1) + " hours, at most 24 are written"};
    return compilePlan(scene, profile, params.compile);
}

/// Second half of renderScene(): plays a plan into `sink`. `felt` is the model of the felt acceleration to render
/// instead of the drive signal; `everything` is the plan of the same scene with nothing left out, for comparison.
/// Errors: as there.
[[nodiscard]] inline Result<RenderReport> renderPlan(RenderPlan plan, const RenderParams& params, RenderSink& sink,
                                                     const std::optional<FeltSettings>& felt = {},
                                                     std::optional<RenderPlan> everything = {})
{
    ScenePlayerParams playing;
    playing.sampleRate = params.compile.sampleRate;
    playing.protect = params.protect;
    const auto part = detail::renderPart(params, static_cast<std::uint64_t>(frameCount(plan, playing.sampleRate)));
    if (!part)
        return part.error();
    RenderReport report;
    report.actuators = plan.actuators;
    report.frames = part->last - part->first;
    report.keptPlays = plan.plays.size();
    report.culledError = plan.culledError;
    report.predictedError = plan.predictedError;
    if (auto begun = sink.begin(plan, report.frames); !begun)
        return begun.error();
    report.adaptations = std::move(plan.adaptations);
    report.leftOut = std::move(plan.leftOut);

    SignalPlayer player(std::move(plan), playing, felt);
    std::optional<SignalPlayer> whole;
    if (everything)
        whole.emplace(std::move(*everything), playing, felt);
    detail::RenderBuffers block(report.actuators, params.blockFrames);
    detail::RenderBuffers wholeBlock(whole ? report.actuators : 0, params.blockFrames);
    detail::SignalError error;
    // A part is played from the start like the whole, so that it is equal to that part of the whole.
    for (std::uint64_t done = 0; done < part->last;)
    {
        // Blocks end where the part starts.
        const bool heard = done >= part->first;
        const auto frames = static_cast<std::size_t>(
            std::min<std::uint64_t>(params.blockFrames, (heard ? part->last : part->first) - done));
        const auto found = block.first(frames);
        player.process(found);
        if (whole)
        {
            const auto wanted = wholeBlock.first(frames);
            whole->process(wanted);
            if (heard)
                error.add(wanted, found);
        }
        done += frames;
        if (auto told = sink.progress(static_cast<double>(done) / static_cast<double>(part->last)); !told)
            return told.error();
        if (heard)
            if (auto taken = sink.take({found, player.protectionMeter()}); !taken)
                return taken.error();
    }
    if (whole)
        report.measuredError = error.decibels();
    report.maxSounding = player.maxSounding();
    report.reduction = player.maxReduction();
    if (params.describe)
        report.decoded = player.decodedPlays();
    return report;
}

/// Renders a scene for an actuator (null: the plain drive signal) into `sink`: its drive signals, or the accelerations
/// felt from them. Errors: those of compilePlan() and of the sink; invalidArgument if the part to render is empty, and
/// at `profile` if felt accelerations are requested without a profile; those of notFelt(); tooLarge for more than 24
/// hours. [worker]
[[nodiscard]] inline Result<RenderReport> renderScene(Scene scene, const Profile* profile, const RenderParams& params,
                                                      RenderSink& sink)
{
    std::optional<FeltSettings> felt;
    if (params.felt)
    {
        if (profile == nullptr)
            return Error{ErrorCode::invalidArgument, "profile", "is needed to predict the acceleration of the skin"};
        felt = feltSettingsOf(*profile, params.felt->wearer, params.felt->fullScale);
        if (!felt)
            return notFelt(*profile, params.felt->wearer);
    }
    const std::size_t plays = scene.plays.size();
    std::vector<std::string> names;
    for (const ScenePlay& play : scene.plays)
        if (params.describe && play.clip < scene.clips.size())
            names.push_back(play.name.empty() ? scene.clips[play.clip].name : play.name);
    std::optional<RenderPlan> everything;
    if (params.measure)
    {
        RenderParams all = params;
        all.compile.leaveOut = false;
        auto planned = planScene(scene, profile, all);
        if (!planned)
            return planned.error();
        everything = std::move(*planned);
    }
    auto plan = planScene(std::move(scene), profile, params);
    if (!plan)
        return plan.error();
    auto report = renderPlan(std::move(*plan), params, sink, felt, std::move(everything));
    if (report)
    {
        report->givenPlays = plays;
        report->playNames = std::move(names);
    }
    return report;
}

/// A whole rendering in memory.
struct RenderedScene
{
    RenderReport report;
    std::vector<float> samples; ///< of one actuator after the other

    [[nodiscard]] std::span<const float> channel(std::size_t actuator) const noexcept
    {
        const std::size_t frames = sizeInMemory(report.frames);
        return std::span(samples).subspan(actuator * frames, frames);
    }
};

/// Sink that keeps all samples, those of one actuator after the other.
class RenderMemory : public RenderSink
{
public:
    /// `tell`: called as progress() is; may be empty.
    explicit RenderMemory(std::function<Result<void>(double)> tell = {}) : told(std::move(tell)) {}

    [[nodiscard]] Result<void> begin(const RenderPlan& plan, std::uint64_t frames) override
    {
        // Four bytes each, and copies of them: never all of the memory that a machine can address.
        constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / 10;
        if (frames > most / plan.actuators)
            return Error{ErrorCode::tooLarge, "",
                         "makes more samples than fit into memory; choose a lower sample rate"};
        length = sizeInMemory(frames);
        samples.resize(plan.actuators * length);
        return {};
    }
    [[nodiscard]] Result<void> take(const RenderBlock& block) override
    {
        for (std::size_t a = 0; a < block.channels.size(); ++a)
            std::copy(block.channels[a].begin(), block.channels[a].end(),
                      samples.begin() + static_cast<std::ptrdiff_t>(a * length + done));
        done += block.frames();
        return {};
    }
    [[nodiscard]] Result<void> progress(double share) override { return told ? told(share) : Result<void>(); }

    std::vector<float> samples;

private:
    std::function<Result<void>(double)> told;
    std::size_t length = 0, done = 0; // frames
};

/// The same into memory; `progress` as RenderSink has it.
[[nodiscard]] inline Result<RenderedScene> renderScene(Scene scene, const Profile* profile, const RenderParams& params,
                                                       std::function<Result<void>(double)> progress = {})
{
    RenderMemory memory(std::move(progress));
    auto report = renderScene(std::move(scene), profile, params, memory);
    if (!report)
        return report.error();
    return RenderedScene{std::move(*report), std::move(memory.samples)};
}

} // namespace pacini
