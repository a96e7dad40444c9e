#pragma once

// Making of plays: LoadedClip -> PlayContent for the actuators of an engine.

#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/runtime/ActuatorKind.h>
#include <pacini/runtime/LoadedClip.h>
#include <pacini/runtime/PlayContent.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// How a play begins.
struct PlaySettings
{
    PlayControls controls;
    double from = 0.0;                      ///< s of the clip
    double loop = 0.0;                      ///< s of the clip that are repeated, 0.005 at least; 0 plays it once
    std::size_t passes = 0;                 ///< of a loop; 0 = until it is stopped
    double headroom = 0.0;                  ///< semitones by which it may be transposed up later without loss, 0 to 48
    Seconds fadeIn{0.0};                    ///< 0 to an hour
    std::uint32_t group = 0;                ///< below limits::groups
    int priority = 0;                       ///< 0 is kept longest
    VariationParams variation;              ///< of each pass
    std::shared_ptr<const Texture> texture; ///< plays for as long as the clip, which is silent
};

namespace limits
{
inline constexpr std::size_t groups = 32;
}

/// Makes plays. Caches adapted clips for their next play, up to a maximum number of points.
/// [message]
class PlayMaker
{
public:
    PlayMaker(const std::vector<ActuatorKind>& playedOn, double sampleRate, Seconds longestDelay)
        : kinds(playedOn), fs(sampleRate), liveDelay(longestDelay)
    {
    }

    /// Errors: invalidArgument with the setting (`loop`), those of LoadedClip::unpack(), tooLarge (`passes`).
    [[nodiscard]] Result<std::unique_ptr<PlayContent>> make(const std::shared_ptr<const LoadedClip>& clip,
                                                            const PlaySettings& settings)
    {
        if (auto valid = check(settings, clip->duration()); !valid)
            return valid.error();
        auto fitted = fittedTo(clip);
        if (!fitted)
            return fitted.error();
        const bool endless = settings.loop > 0.0 && settings.passes == 0;
        // A long unrolled stretch, so that the joints between two of them are rare.
        const double stretch =
            endless ? settings.loop * std::max(1.0, std::ceil(leastStretch / settings.loop)) : clip->duration();
        PlayContent::Params params;
        params.sampleRate = fs;
        params.power = clip->power();
        std::shared_ptr<const TextureTable> texture;
        if (settings.texture)
        {
            auto found = tableOf(settings.texture);
            if (!found)
                return found.error();
            texture = std::move(*found);
            const auto fastest = TextureTable::placeOf(1.0);
            params.power[Role::noise] = texture->level(fastest) * texture->level(fastest);
            params.power[Role::tones] = texture->tonesLevel(fastest) * texture->tonesLevel(fastest);
        }
        params.transposition = settings.controls.transposition;
        params.speed = settings.controls.speed;
        params.loop = endless ? stretch : 0.0;
        double from = settings.from;
        if (settings.loop > 0.0 && from >= settings.loop)
            from = std::fmod(from, settings.loop);
        if (settings.loop == 0.0 && from > longestSkip)
            params.offset = from;
        std::vector<std::vector<PlayContent::Voice>> passes(endless ? 2 : 1);
        for (auto& pass : passes)
            for (std::size_t k = 0; k < kinds.size(); ++k)
            {
                auto voice = makeVoice((*fitted)->clips[k], kinds[k], settings, stretch, params.offset, texture);
                if (!voice)
                    return voice.error();
                pass.push_back(std::move(voice).value());
            }
        if (from > params.offset)
        {
            params.played = std::llround((from - params.offset) / settings.controls.speed * fs);
            for (PlayContent::Voice& v : passes[0])
                v.voice.skip(params.played, *buffers);
        }
        return std::make_unique<PlayContent>(std::move(passes), params);
    }

    /// Plays the next frames of what has not begun unheard.
    void advance(PlayContent& content, std::int64_t frames) { content.advance(frames, *buffers); }

    /// Forgets what was made of a clip, for one that is replaced or unloaded.
    void forget(const LoadedClip* clip)
    {
        std::erase_if(known,
                      [&](const auto& entry)
                      {
                          if (entry->source != clip)
                              return false;
                          points -= entry->points;
                          return true;
                      });
    }

private:
    static constexpr double leastStretch = 10.0;               // s
    static constexpr double longestSkip = 10.0;                // s that are played unheard rather than cut off
    static constexpr std::size_t rememberedPoints = 1'000'000; // 16 bytes each
    static constexpr double mostPoints = 2'000'000.0;          // of one play

    /// A clip for one kind of actuator.
    struct FittedClip
    {
        Clip clip;
        std::optional<DecoderParams> decoder; ///< where it is planned as rendered
        std::optional<BiquadCascadeCoefficients> filter;
    };

    struct Fitted
    {
        const LoadedClip* source = nullptr;
        std::vector<FittedClip> clips; ///< for each kind
        std::size_t points = 0;
    };

    static Result<void> check(const PlaySettings& settings, double duration)
    {
        const auto wrong = [](const char* where, const char* what)
        {
            return Error{ErrorCode::invalidArgument, where, what};
        };
        const auto within = [](double value, double low, double high)
        {
            return std::isfinite(value) && value >= low && value <= high;
        };
        if (!within(settings.from, 0.0, limits::duration))
            return wrong("from", "must be 0 s or more");
        if (settings.loop != 0.0 && !within(settings.loop, limits::shortestLoop, limits::duration))
            return wrong("loop", "must be 0 (play once) or 0.005 s and longer");
        if (settings.loop > duration)
            return wrong("loop", "is longer than the clip");
        if (!within(settings.headroom, 0.0, 48.0))
            return wrong("headroom", "must be 0 to 48 semitones");
        if (!within(settings.fadeIn.value, 0.0, 3600.0))
            return wrong("fadeIn", "must be 0 to 3600 s");
        if (settings.group >= limits::groups)
            return wrong("group", "must be 0 to 31");
        if (!within(settings.variation.amount, 0.0, 1.0))
            return wrong("variation", "must be 0 to 1");
        return {};
    }

    /// The table of a texture; the last ones are kept. Errors: invalidArgument where nothing can play one.
    Result<std::shared_ptr<const TextureTable>> tableOf(const std::shared_ptr<const Texture>& texture)
    {
        constexpr std::size_t kept = 16;
        if (std::all_of(kinds.begin(), kinds.end(), [](const ActuatorKind& kind) { return kind.plan.motor; }))
            return Error{ErrorCode::invalidArgument, "texture", "cannot be followed by a motor; take another actuator"};
        if (std::any_of(kinds.begin(), kinds.end(), [](const ActuatorKind& kind) { return kind.filtersVoices; }))
            return Error{ErrorCode::invalidArgument, "texture",
                         "cannot play in an engine that plays clips as rendered"};
        const auto found =
            std::find_if(tables.begin(), tables.end(), [&](const auto& entry) { return entry.first == texture; });
        if (found != tables.end())
            return found->second;
        if (tables.size() >= kept)
            tables.erase(tables.begin());
        return tables.emplace_back(texture, std::make_shared<const TextureTable>(*texture, fs)).second;
    }

    /// The clip as it is fitted to each kind of actuator.
    Result<Fitted*> fittedTo(const std::shared_ptr<const LoadedClip>& clip)
    {
        const auto found =
            std::find_if(known.begin(), known.end(), [&](const auto& entry) { return entry->source == clip.get(); });
        if (found != known.end())
        {
            known.splice(known.begin(), known, found); // used last
            return known.front().get();
        }
        auto unpacked = clip->unpack();
        if (!unpacked)
            return unpacked.error();
        auto fitted = std::make_unique<Fitted>();
        fitted->source = clip.get();
        for (const ActuatorKind& kind : kinds)
        {
            auto made = fitTo(kind, *unpacked);
            if (!made)
                return made.error();
            fitted->points += breakpointCount(made->clip) + made->clip.transients.size();
            fitted->clips.push_back(std::move(made).value());
        }
        points += fitted->points;
        known.push_front(std::move(fitted));
        while (points > rememberedPoints && known.size() > 1)
        {
            points -= known.back()->points;
            known.pop_back();
        }
        return known.front().get();
    }

    static Result<FittedClip> fitTo(const ActuatorKind& kind, const Clip& clip)
    {
        if (!kind.asRendered)
            return FittedClip{kind.fit ? adaptClip(clip, *kind.profile(), kind.compile.adaptation).clip : clip, {}, {}};
        Scene scene;
        scene.clips = {clip};
        scene.plays.emplace_back();
        auto plan = compilePlan(scene, kind.wanted ? &*kind.wanted : nullptr, kind.compile);
        if (!plan)
            return plan.error();
        FittedClip fitted;
        fitted.clip.duration = clip.duration;
        if (!plan->plays.empty()) // else it is silent
        {
            fitted.clip = std::move(plan->plays.front().clip);
            fitted.decoder = plan->plays.front().decoder;
        }
        if (kind.filtersVoices)
        {
            fitted.filter = designOutputFilter({plan->profile->equalizer, plan->flattening}, kind.compile.sampleRate);
            if (fitted.filter->sections.empty())
                fitted.filter.reset();
        }
        return fitted;
    }

    Result<PlayContent::Voice> makeVoice(const FittedClip& forKind, const ActuatorKind& kind,
                                         const PlaySettings& settings, double stretch, double offset,
                                         const std::shared_ptr<const TextureTable>& texture) const
    {
        const Clip& fitted = forKind.clip;
        Clip clip;
        if (settings.loop > 0.0)
        {
            const double passes =
                settings.passes > 0 ? static_cast<double>(settings.passes) : std::round(stretch / settings.loop) + 1.0;
            const auto perPass = static_cast<double>(breakpointCount(fitted) + fitted.transients.size() + 2);
            if (passes * perPass > mostPoints)
                return Error{ErrorCode::tooLarge, "passes",
                             "unroll to more than 2 million breakpoints; use fewer loops or an endless one"};
            clip = unrollLoop(fitted, settings.loop, static_cast<std::size_t>(passes), settings.variation);
            if (settings.passes == 0)
            {
                const double needed = stretch + 2.0 * PlayContent::joint * settings.controls.speed;
                const TimeRange kept{0.0, std::min(clip.duration, needed)};
                clip = trimClip(std::move(clip), kept);
            }
        }
        else
            clip = vary(offset > 0.0 ? trimClip(fitted, {std::min(offset, fitted.duration), fitted.duration}) : fitted,
                        settings.variation);
        ScenePlay play;
        play.transposition = settings.controls.transposition;
        play.stretch = 1.0 / settings.controls.speed;
        play.variation.seed = settings.variation.seed;
        DecoderParams decoder = detail::planDecoder(kind.plan, clip, play, kind.compile, kind.fit);
        if (forKind.decoder)
        {
            // Without what was left out it would be another one.
            DecoderParams planned = *forKind.decoder;
            planned.transposition = decoder.transposition;
            planned.stretch = decoder.stretch;
            planned.variation = decoder.variation;
            planned.gaps = decoder.gaps;
            decoder = planned;
        }
        decoder.headroom = settings.headroom;
        decoder.apart = !forKind.filter;
        PlayContent::Voice made{{0, std::move(clip), 0.0, decoder, steadyTimeline(kind.actuators.size())},
                                PlayVoice({}, kind.actuators.size(), fs)};
        if (texture && !kind.plan.motor)
        {
            made.planned.texture = texture;
            made.planned.textureSeed = settings.variation.seed;
        }
        made.voice.prepare(made.planned,
                           {forKind.filter ? &*forKind.filter : nullptr, std::numeric_limits<std::int64_t>::max(),
                            &kind.plan.row, liveDelay, designs.get()});
        made.planned.clip = {};
        return made;
    }

    /// All of the level is live.
    static PlayTimeline steadyTimeline(std::size_t actuators)
    {
        PlayTimeline timeline;
        timeline.gains.assign(actuators, {{0.0, 1.0}});
        timeline.level = {{0.0, 1.0}};
        return timeline;
    }

    const std::vector<ActuatorKind>& kinds;
    double fs;
    Seconds liveDelay;
    std::list<std::unique_ptr<Fitted>> known; // used last first
    std::size_t points = 0;
    std::vector<std::pair<std::shared_ptr<const Texture>, std::shared_ptr<const TextureTable>>> tables;
    std::unique_ptr<MixBuffers> buffers = std::make_unique<MixBuffers>();
    std::unique_ptr<InterpolatorDesigns> designs = std::make_unique<InterpolatorDesigns>();
};

} // namespace pacini
