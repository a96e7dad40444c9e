#include "document/ActuatorTrace.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/OutputFilter.h>
#include <pacini/clip/BandPriority.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/ClipAdaptation.h>
#include <pacini/synthesis/RenderScene.h>
#include <pacini/synthesis/Transparency.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace pacini
{

namespace
{
constexpr double traceRate = 16000.0;  // Hz: peaks of 1 kHz are within 0.2 dB
constexpr double leastWanted = 1e-4;   // of a band: what is softer is as good as silent
constexpr float leastReduction = 0.1f; // dB
constexpr std::size_t stepFrames = 80; // of ActuatorTrace::step

static_assert(static_cast<double>(stepFrames) == ActuatorTrace::step * traceRate);

double decibelsOf(double linear)
{
    return linear > 0.0 ? std::max(static_cast<double>(ActuatorTrace::silent), Decibels::fromGain(linear).value)
                        : static_cast<double>(ActuatorTrace::silent);
}

std::string hertz(double frequency)
{
    return frequency < 1000.0 ? fmt::format("{:.0f} Hz", frequency) : fmt::format("{:.2f} kHz", frequency / 1000.0);
}

/// Gain of output filter and overdrive for a tone, linear, over frequency.
class OutputGain
{
public:
    explicit OutputGain(const RenderPlan& plan)
    {
        const OutputFilterParams params{plan.profile->equalizer, plan.flattening};
        const auto filter = designOutputFilter(params, traceRate);
        for (std::size_t i = 0; i < gains.size(); ++i)
        {
            const double f = lowest * std::exp2(static_cast<double>(i) / perOctave);
            gains[i] = plan.motor ? 1.0 : std::abs(filter.response(Hertz(f), traceRate));
            gains[i] /= plan.profile->drive.overdrive;
        }
    }

    [[nodiscard]] double at(double frequency) const noexcept
    {
        const double octaves = std::log2(std::max(frequency, lowest) / lowest);
        return gains[std::min(gains.size() - 1, static_cast<std::size_t>(std::lround(perOctave * octaves)))];
    }

private:
    static constexpr double lowest = 4.0, perOctave = 24.0;
    std::array<double, static_cast<std::size_t>(10.0 * perOctave)> gains{}; // to 4 kHz
};

/// State of the actuator in each time step.
class Steps : public RenderSink
{
public:
    Steps(std::size_t count, const std::atomic<bool>& toWatch)
        : peaks(count), reductions(count), limits(count), cancelled(toWatch)
    {
    }

    Result<void> begin(const RenderPlan& plan, std::uint64_t) override
    {
        isMotor = plan.motor;
        gain.emplace(plan);
        return {};
    }
    Result<void> take(const RenderBlock& block) override
    {
        if (done == peaks.size())
            return {};
        for (const float sample : block.channels.front())
            peaks[done] = std::max(peaks[done], std::abs(sample));
        if (block.meter != nullptr)
        {
            reductions[done] = static_cast<float>(std::max(0.0, block.meter->gainReduction));
            limits[done] = static_cast<std::uint8_t>((block.meter->level ? ActuatorTrace::fullDrive : 0) |
                                                     (block.meter->excursion ? ActuatorTrace::travel : 0) |
                                                     (block.meter->heat ? ActuatorTrace::heat : 0));
        }
        ++done;
        return {};
    }
    Result<void> progress(double) override
    {
        return cancelled.load(std::memory_order_relaxed) ? wasCancelled() : Result<void>();
    }

    std::vector<float> peaks, reductions;
    std::vector<std::uint8_t> limits;
    bool isMotor = false;
    std::optional<OutputGain> gain;

private:
    const std::atomic<bool>& cancelled;
    std::size_t done = 0;
};

/// A clip adapted to the actuator.
struct FittedClip
{
    const AdaptationParams& adaptation;
    bool isMotor = false;
    const std::vector<LeftOut>& leftOut;
    const OutputGain& gain;
};

/// The range of frequencies that an adapted clip may have.
TimeRange reachOf(const Profile& profile, double strength)
{
    const ActuatorRange range = fitActuator(profile, {.strength = strength}).range;
    return {range.lowFrequency, range.highFrequency};
}

/// Everything that is asked about one source at each step.
struct SourceCurves
{
    const Curve& wantedLevel;
    const Curve* wantedPitch; ///< null or empty: the centre
    double wantedCentre;
    const Curve* playedLevel; ///< null: it is not played
    const Curve* playedPitch;
    double playedCentre;
};

void follow(ActuatorTrace::Source& source, const SourceCurves& curves, const ActuatorTrace& trace, TimeRange reach,
            const OutputGain& gain)
{
    const std::size_t steps = trace.peaks.size();
    source.losses.assign(steps, Loss::none);
    source.levels.assign(steps, ActuatorTrace::silent);
    source.wanted.resize(steps);
    source.played.resize(steps);
    const auto readerOf = [](const Curve* curve)
    {
        return CurveReader(curve != nullptr ? std::span<const Breakpoint>(*curve) : std::span<const Breakpoint>());
    };
    CurveReader wantedLevel(curves.wantedLevel), wantedPitch = readerOf(curves.wantedPitch);
    CurveReader playedLevel = readerOf(curves.playedLevel), playedPitch = readerOf(curves.playedPitch);
    const bool pitched = curves.wantedPitch != nullptr && !curves.wantedPitch->empty();
    const bool playsPitch = curves.playedPitch != nullptr && !curves.playedPitch->empty();
    for (std::size_t i = 0; i < steps; ++i)
    {
        const double t = ActuatorTrace::step * (static_cast<double>(i) + 0.5);
        const double f = pitched ? wantedPitch.at(t) : curves.wantedCentre;
        const double g = playsPitch ? playedPitch.at(t) : curves.playedCentre;
        source.wanted[i] = static_cast<float>(f);
        source.played[i] = static_cast<float>(g);
        if (wantedLevel.at(t) < leastWanted)
            continue;
        if (curves.playedLevel != nullptr)
            source.levels[i] = static_cast<float>(decibelsOf(playedLevel.at(t) * gain.at(g)));
        Loss& loss = source.losses[i];
        if (source.whole == Loss::dropped)
            loss = Loss::dropped;
        else if (f < reach.from || f > reach.to)
            loss = Loss::outOfRange;
        else if (static_cast<double>(source.levels[i]) < trace.touch)
            loss = Loss::belowTouch;
        else
            loss = source.whole;
    }
}

/// Which of the clip's bands share the voice of a band of the adapted clip: the strongest has it.
std::vector<std::size_t> voicesOf(const std::vector<Band>& bands, const std::vector<Band>& voices, double duration)
{
    std::vector<std::size_t> owners(voices.size(), bands.size());
    for (std::size_t v = 0; v < voices.size(); ++v)
        for (std::size_t k = 0; k < bands.size(); ++k)
        {
            // Merged bands reach from the lowest to the highest frequency of those within.
            const bool within =
                bands[k].lowFrequency >= voices[v].lowFrequency && bands[k].highFrequency <= voices[v].highFrequency;
            const bool stronger = owners[v] == bands.size() || curveEnergy(bands[k].amplitude, duration) >
                                                                   curveEnergy(bands[owners[v]].amplitude, duration);
            if (within && stronger)
                owners[v] = k;
        }
    return owners;
}

void addBands(ActuatorTrace& trace, const Clip& clip, const FittedClip& made)
{
    const bool adapts = trace.actuator.technology != Technology::pcm;
    const TimeRange reach = adapts && trace.actuator.polyphony > 0 ? reachOf(trace.actuator, made.adaptation.strength)
                                                                   : TimeRange{0.0, 1e9};
    AdaptationParams separate = made.adaptation;
    separate.voices = false;
    const Clip moved = adapts ? adaptClip(clip, trace.actuator, separate).clip : clip;
    const Clip fitted = adapts ? adaptClip(clip, trace.actuator, made.adaptation).clip : clip;
    const bool shared = fitted.bands.size() < moved.bands.size();
    const auto owners = shared ? voicesOf(moved.bands, fitted.bands, clip.duration) : std::vector<std::size_t>{};
    for (std::size_t k = 0; k < clip.bands.size(); ++k)
    {
        const Band& band = clip.bands[k];
        const Band& to = moved.bands[k];
        ActuatorTrace::Source source;
        source.lane = {LaneKind::amplitude, k};
        if (shared && std::find(owners.begin(), owners.end(), k) == owners.end())
        {
            source.whole = Loss::noVoice;
            source.why = made.isMotor ? "ERM motors have one strength and no pitch; this band only adds to the strength"
                                      : "is merged into a neighbouring band";
        }
        for (const LeftOut& left : made.leftOut)
        {
            // Bands are counted as in the adapted clip; a play that is left out takes all its bands along.
            const std::size_t index =
                shared ? static_cast<std::size_t>(std::find(owners.begin(), owners.end(), k) - owners.begin()) : k;
            const bool mine = left.where == "plays[0]" || left.where == "plays[0]" + detail::indexed(".bands", index);
            if (!mine || left.reason == "is silent")
                continue;
            source.whole = Loss::dropped;
            source.why = std::isfinite(left.error)
                             ? fmt::format("left out with an error of {:.0f} dB: {}", left.error, left.reason)
                             : left.reason;
        }
        const SourceCurves curves{band.amplitude, &band.pitch, band.centreFrequency,
                                  &to.amplitude,  &to.pitch,   to.centreFrequency};
        follow(source, curves, trace, reach, made.gain);
        trace.sources.push_back(std::move(source));
    }
    for (std::size_t k = 0; k < clip.noise.size(); ++k)
    {
        const NoiseBand& band = clip.noise[k];
        const double centre = std::sqrt(std::max(1.0, band.lowFrequency) * std::max(1.0, band.highFrequency));
        // Levels of the adapted clip; what is out of range is not in it.
        const auto found = std::find_if(moved.noise.begin(), moved.noise.end(),
                                        [&](const NoiseBand& other) {
                                            return other.lowFrequency == band.lowFrequency &&
                                                   other.highFrequency == band.highFrequency;
                                        });
        const bool played = found != moved.noise.end() && !made.isMotor;
        ActuatorTrace::Source source;
        source.lane = {LaneKind::noise, k};
        if (!played)
        {
            source.whole = Loss::dropped;
            source.why = made.isMotor ? "ERM motors cannot play noise; the envelope covers it"
                                      : "is outside the actuator's range";
        }
        const SourceCurves curves{band.amplitude, nullptr, centre, played ? &found->amplitude : nullptr,
                                  nullptr,        centre};
        follow(source, curves, trace, {0.0, 1e9}, made.gain);
        trace.sources.push_back(std::move(source));
    }
}
} // namespace

ActuatorTrace::ActuatorTrace(Profile profile, double seconds, std::vector<float> drivePeaks,
                             std::vector<float> gainReductions, std::vector<std::uint8_t> limitsReached)
    : actuator(std::move(profile)),
      duration(seconds),
      touch(-actuator.range.dynamicRange),
      peaks(std::move(drivePeaks)),
      reductions(std::move(gainReductions)),
      limits(std::move(limitsReached)),
      drive(peaks, 1.0 / step),
      reduction(reductions, 1.0 / step),
      losses(peaks.size(), Loss::none)
{
    for (std::size_t i = 0; i < peaks.size(); ++i)
        if (reductions[i] > leastReduction)
            losses[i] = Loss::limited;
        else if (const double level = decibelsOf(static_cast<double>(peaks[i])); peaks[i] > 1e-5f && level < touch)
            losses[i] = Loss::belowTouch;
}

std::optional<std::size_t> ActuatorTrace::stepAt(double time) const noexcept
{
    if (!(time >= 0.0 && time < step * static_cast<double>(peaks.size())))
        return std::nullopt;
    return std::min(peaks.size() - 1, static_cast<std::size_t>(time / step));
}

std::string ActuatorTrace::textOf(std::size_t i) const
{
    if (losses[i] == Loss::belowTouch)
        return fmt::format("not felt: {:.0f} dB below the touch threshold",
                           touch - decibelsOf(static_cast<double>(peaks[i])));
    if (losses[i] != Loss::limited)
        return {};
    std::string why;
    for (const auto& [bit, name] : {std::pair(Limit::fullDrive, "full drive"), std::pair(Limit::travel, "travel"),
                                    std::pair(Limit::heat, "heat")})
        if ((limits[i] & bit) != 0)
            why += (why.empty() ? "" : ", ") + std::string(name);
    return why.empty() ? fmt::format("protection reduces by {:.1f} dB", reductions[i])
                       : fmt::format("protection reduces by {:.1f} dB: {}", reductions[i], why);
}

std::string ActuatorTrace::textOf(const Source& source, std::size_t i) const
{
    switch (source.losses[i])
    {
    case Loss::belowTouch:
        if (source.levels[i] <= silent)
            return "not felt: nothing left";
        return fmt::format("not felt: {:.0f} dB below the touch threshold",
                           touch - static_cast<double>(source.levels[i]));
    case Loss::outOfRange:
        return fmt::format("out of range: {} is played at {}", hertz(static_cast<double>(source.wanted[i])),
                           hertz(static_cast<double>(source.played[i])));
    case Loss::noVoice:
    case Loss::dropped:
        return source.why;
    default:
        return {};
    }
}

std::vector<LostPart> ActuatorTrace::parts(std::span<const Loss> losses)
{
    std::vector<LostPart> result;
    for (std::size_t i = 0; i < losses.size();)
    {
        std::size_t end = i + 1;
        while (end < losses.size() && losses[end] == losses[i])
            ++end;
        if (losses[i] != Loss::none)
            result.push_back({{step * static_cast<double>(i), step * static_cast<double>(end)}, losses[i]});
        i = end;
    }
    return result;
}

Result<std::shared_ptr<const ActuatorTrace>> traceActuator(const Clip& clip, const Profile& profile, double strength,
                                                           const std::atomic<bool>& cancelled)
{
    RenderParams params;
    params.compile.sampleRate = traceRate;
    params.compile.adaptation.strength = strength;
    params.blockFrames = stepFrames;
    Steps steps(static_cast<std::size_t>(std::ceil(clip.duration / ActuatorTrace::step)), cancelled);
    auto report = renderScene(sceneOf(clip), &profile, params, steps);
    if (!report)
        return report.error();
    auto trace = std::make_shared<ActuatorTrace>(profile, clip.duration, std::move(steps.peaks),
                                                 std::move(steps.reductions), std::move(steps.limits));
    for (Adaptation& adaptation : report->adaptations)
        trace->changes.push_back(std::move(adaptation.what));
    addBands(*trace, clip, {params.compile.adaptation, steps.isMotor, report->leftOut, *steps.gain});
    return std::shared_ptr<const ActuatorTrace>(std::move(trace));
}

Clip fittedClip(const Clip& clip, const Profile& profile, double strength)
{
    AdaptationParams params;
    params.strength = strength;
    return adaptClip(clip, profile, params).clip;
}

bool canBeAlike(const Profile& profile) noexcept
{
    return profile.body && profile.technology != Technology::erm;
}

Result<AlikeClip> feltAlike(const Clip& clip, const Profile& designedOn, const Profile& actuator, double strength)
{
    AdaptationParams params;
    params.strength = strength;
    auto made = transparentClip(clip, designedOn, actuator, params);
    if (!made)
        return made.error();
    return AlikeClip{std::move(made->clip), std::move(made->lost)};
}

} // namespace pacini
