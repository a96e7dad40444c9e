#pragma once

// Clip decoder: Clip -> samples.

#include <pacini/clip/Clip.h>
#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/FilteringInterpolator.h>
#include <pacini/filters/PolyphaseInterpolator.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/SizeInMemory.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/CarrierBank.h>
#include <pacini/synthesis/DecoderParams.h>
#include <pacini/synthesis/EnvelopeLeveller.h>
#include <pacini/synthesis/EventGaps.h>
#include <pacini/synthesis/NoiseBank.h>
#include <pacini/synthesis/PartEnvelopes.h>
#include <pacini/synthesis/PlayClock.h>
#include <pacini/synthesis/PulseLevel.h>
#include <pacini/synthesis/PulseTrain.h>
#include <pacini/synthesis/Roles.h>
#include <pacini/synthesis/Variation.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Clip decoder. Plays one clip. Construction allocates and copies what it needs; process() and reset() are real-time
/// safe, and the output does not depend on how it is cut into blocks. Sinusoids are summed at an inner rate of 4-8 kHz
/// (they end at 1-2 kHz), levelled to the envelope, raised to the output rate by a polyphase filter whose delay is
/// taken out, and the pulses of the transients are added at full rate: an event tops the level of the bands up to its
/// own amplitude, so its energy is never played twice. Values outside their ranges are clamped as stated.
///
/// Roles have levels at the output rate, exact to the frame. A role at 0 is not computed: with tones and noise at 0
/// nothing is until one of them is heard, when as much of the past is made up for as what follows depends on. Where
/// tones and noise are levelled together and one of them is at 0, the other goes on at its share of the envelope; the
/// one that was not computed comes back when the leveller has got to it, up to some 30 ms late.
class Decoder
{
public:
    /// `changes` occur during playback, in order of time; changes that are not finite are ignored. `designs` are shared
    /// with earlier decoders; null: the decoder makes its own.
    Decoder(const Clip& clip, const DecoderParams& wanted, std::vector<DecoderChange> changes = {},
            InterpolatorDesigns* designs = nullptr)
        : params(clamped(wanted)),
          playable(isPlayableRate(wanted.sampleRate)),
          scheduled(finiteOnes(std::move(changes))),
          clock(scheduled.size())
    {
        const Clip varied = vary(clip, params.variation);
        const double fs = params.sampleRate;
        transpositionRatio = portable::exp2(params.transposition / 12.0);
        delayFrames = static_cast<std::int64_t>(std::floor(params.delay * fs + 0.5));
        clipFrames = clip.duration * params.stretch * fs;

        double most = params.transposition + params.headroom;
        for (const DecoderChange& change : scheduled)
            most = std::max(most, clampTo(change.transposition, lowestTransposition, highestTransposition));
        const double highest =
            std::max(params.reach, highestFrequency(varied, params.carriers)) * portable::exp2(most / 12.0);
        ratio = params.fullRate
                    ? 1
                    : static_cast<std::size_t>(std::max(1.0, std::floor(fs / std::max(4000.0, 3.3 * highest))));
        innerRate = fs / static_cast<double>(ratio);
        plan.innerRate = innerRate;
        makeParts(varied);
        const double pass = std::clamp(1.05 * highest / innerRate, 0.05, 0.44);
        interpolator = designs != nullptr ? std::make_unique<PolyphaseInterpolator>(designs->get(ratio, pass))
                                          : std::make_unique<PolyphaseInterpolator>(ratio, pass);
        makeEvents(varied);
        wantedEnvelope.resize(hopFrames);
        inner.resize(hopFrames);
        ready.resize(hopFrames * ratio);
        if (apart)
        {
            noiseInterpolator = std::make_unique<PolyphaseInterpolator>(*interpolator);
            innerNoise.resize(inner.size());
            readyNoise.resize(ready.size());
            envelopeBefore.resize(leveller ? hopFrames : 0);
            presenceFrames = static_cast<std::int64_t>(std::ceil(0.005 * fs));
        }
        // What a frame of the output depends on: both windows of the leveller, and the interpolator's taps.
        const std::size_t past = (leveller ? 2 * leveller->latencyFrames() : 0) + interpolator->taps();
        warmHops = static_cast<std::int64_t>((past + hopFrames - 1) / hopFrames);
        reset();
    }

    /// Outputs the clip through `filter` from now on. The clip ends at frame `until` at the latest; the filter then
    /// rings on. This costs a few more taps of the interpolator; a filter at the output rate would cost as much as all
    /// the rest. The start of an event is then decided up to a hop ahead. Allocates; before the first frame. [worker]
    void filterBy(const BiquadCascadeCoefficients& filter, std::int64_t until)
    {
        assert(!apart && !hollow);
        filtering = std::make_unique<FilteringInterpolator>(*interpolator, filter);
        cutFrame = until;
        added.assign(plan.pulses > 0 ? ready.size() : 0, 0.0f);
        reset();
    }

    /// Whether a filter may ring on. [audio]
    [[nodiscard]] bool rings() const noexcept { return filtering && !filtering->silent(); }

    /// Length of the clip with its delay and stretch, as far as changes are known.
    [[nodiscard]] std::int64_t totalFrames() const noexcept { return endFrame; }

    [[nodiscard]] std::int64_t framesLeft() const noexcept { return std::max<std::int64_t>(endFrame - position, 0); }

    /// Frames that have been played.
    [[nodiscard]] std::int64_t framesPlayed() const noexcept { return position; }

    /// The frame of the output at which second `time` of the clip is played, as far as changes are known.
    [[nodiscard]] double frameAt(Seconds time) const noexcept
    {
        return static_cast<double>(delayFrames) + outputFrameOf(time.value * params.stretch * params.sampleRate);
    }

    /// The second of the clip that is played next, or `ahead` frames after that. [audio]
    [[nodiscard]] double clipTime(std::int64_t ahead = 0) const noexcept
    {
        const double frame = static_cast<double>(std::max<std::int64_t>(position + ahead - delayFrames, 0));
        return clock.clipAt(frame / static_cast<double>(ratio)) / (params.stretch * innerRate);
    }

    /// Plays the clip at another pitch and speed from the next frame on. Precomputed samples stay: at most one hop (64
    /// inner frames, up to 16 ms) and the delay of the leveller; scheduled changes occur on their sample. Scheduled
    /// changes in the future are dropped. Clamped like the parameters; a change that is not finite is ignored. [audio]
    void change(double transposition, double stretch) noexcept
    {
        if (!std::isfinite(transposition) || !std::isfinite(stretch))
            return;
        // The clock holds no change ahead of what is computed but scheduled ones. Events are begun where the output is,
        // the envelope is read back by the leveller's delay.
        const auto made = static_cast<double>(framesMade());
        clock.dropAfter(made);
        passSources();
        clock.forgetBefore(static_cast<double>(position - delayFrames) / static_cast<double>(ratio) -
                           static_cast<double>((warmHops + 1) * static_cast<std::int64_t>(hopFrames)));
        addChange(std::max(static_cast<double>(position - delayFrames) / static_cast<double>(ratio), made),
                  transposition, stretch);
    }

    [[nodiscard]] const DecoderReport& report() const noexcept { return plan; }

    /// Back to the start, where only scheduled changes count.
    void reset() noexcept
    {
        clock.reset();
        for (const DecoderChange& change : scheduled)
            addChange((change.time - params.delay) * innerRate, change.transposition, change.stretch);
        setEnd();
        for (Part& part : parts)
        {
            part.carriers.reset();
            part.noise.reset();
        }
        for (Levels& set : levels)
            for (std::size_t pass = 0; pass < set.envelopes.size(); ++pass)
                set.readers[pass] = CurveReader(set.envelopes[pass]);
        forgetPast();
        awake = PerRole<bool>(true);
        presence = PerRole<Presence>();
        sourceFrame = PerRole<std::int64_t>(0);
        levelling = levellingBefore = 0;
        turn = longAgo;
        quiet = stale = mixing = hollow;
        if (filtering)
            filtering->reset();
        innerFrame = 0;
        hopDue = false;
        readyFrom = ready.size();
        unheard = allSkipped();
        position = 0;
        pulses.reset();
    }

    /// Writes the next frames of the drive signal; silence after the end. [audio]
    void process(std::span<float> out) noexcept
    {
        if (filtering)
        {
            processFiltered(out);
            return;
        }
        if (mixing)
        {
            process(out, RoleGains());
            return;
        }
        std::size_t done = 0;
        if (position < delayFrames)
        {
            done = static_cast<std::size_t>(
                std::min<std::int64_t>(delayFrames - position, static_cast<std::int64_t>(out.size())));
            std::fill_n(out.begin(), done, 0.0f);
        }
        while (done < out.size() && position + static_cast<std::int64_t>(done) < endFrame)
        {
            if (readyFrom == ready.size())
                makeHop();
            const std::size_t left = sizeInMemory(endFrame - position - static_cast<std::int64_t>(done));
            const std::size_t n = std::min({out.size() - done, ready.size() - readyFrom, left});
            std::copy_n(ready.begin() + static_cast<std::ptrdiff_t>(readyFrom), n,
                        out.begin() + static_cast<std::ptrdiff_t>(done));
            readyFrom += n;
            done += n;
        }
        std::fill(out.begin() + static_cast<std::ptrdiff_t>(done), out.end(), 0.0f);
        addEvents(out.first(done), position);
        position += static_cast<std::int64_t>(out.size());
    }

    /// The same at levels of the roles, 0 or more. Tones and noise have one of their own each if DecoderParams::apart
    /// says so, else both have that of the tones, or of what there is. Not with a filter. [audio]
    void process(std::span<float> out, const RoleGains& gains) noexcept
    {
        assert(!filtering);
        mixing = true;
        std::size_t done = 0;
        if (position < delayFrames)
        {
            done = static_cast<std::size_t>(
                std::min<std::int64_t>(delayFrames - position, static_cast<std::int64_t>(out.size())));
            std::fill_n(out.begin(), done, 0.0f);
        }
        while (done < out.size() && position + static_cast<std::int64_t>(done) < endFrame)
        {
            if (readyFrom == ready.size())
                goOn(gains, done);
            const std::size_t left = sizeInMemory(endFrame - position - static_cast<std::int64_t>(done));
            std::size_t n = std::min({out.size() - done, ready.size() - readyFrom, left});
            if (quiet)
            {
                n = unheardFrames(gains, done, n);
                if (n == 0)
                {
                    warm(gains, done);
                    continue;
                }
                std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(done), n, 0.0f);
            }
            else
                mixRoles(out.subspan(done, n), gains, done);
            readyFrom += n;
            done += n;
        }
        std::fill(out.begin() + static_cast<std::ptrdiff_t>(done), out.end(), 0.0f);
        pulses.process(
            out.first(done), position, [this](const PulseEvent& event) { return startOf(event); }, gains[Role::events]);
        position += static_cast<std::int64_t>(out.size());
    }

    /// Time after skip() in which the leveller and the interpolator have no past, s.
    static constexpr double settling = 0.03;

    /// Skips `frames` without output, in time that depends on the number of breakpoints and events, not of frames.
    /// Within `settling`, the output equals that of a decoder that has played all of them, except for noise, which is
    /// other noise of the same kind, and pulses that have begun. Not with a filter. [audio]
    void skip(std::int64_t frames) noexcept
    {
        assert(!filtering && frames >= 0);
        position += frames;
        if (position >= endFrame)
            return;
        pulses.skipTo(position, [this](const PulseEvent& event) { return startOf(event); });
        if (position <= delayFrames)
            return;
        if (stale)
        {
            readyFrom = ready.size();
            return;
        }
        const std::int64_t raised = raisedAt(position);
        const auto perHop = static_cast<std::int64_t>(ready.size());
        const std::int64_t from = raised / perHop * static_cast<std::int64_t>(hopFrames);
        if (from < innerFrame) // that hop has been made
        {
            readyFrom = static_cast<std::size_t>(raised % perHop);
            return;
        }
        innerFrame = from;
        passSources();
        forgetPast();
        readyFrom = ready.size();
        unheard = static_cast<std::size_t>(raised % perHop);
        hopDue = unheard > 0;
    }

private:
    static constexpr std::size_t hopFrames = 64; // inner frames made at a time

    static constexpr double lowestTransposition = -96.0, highestTransposition = 96.0; // semitones
    static constexpr double shortest = 1e-3, longest = 1e3;                           // stretch

    static DecoderParams clamped(DecoderParams p)
    {
        const DecoderParams usual;
        const auto within = [](double value, double low, double high, double otherwise)
        {
            return std::isfinite(value) ? clampTo(value, low, high) : otherwise;
        };
        p.sampleRate = within(p.sampleRate, limits::lowestRate, limits::highestRate, usual.sampleRate);
        p.transposition = within(p.transposition, lowestTransposition, highestTransposition, usual.transposition);
        p.stretch = within(p.stretch, shortest, longest, usual.stretch);
        p.gain = within(p.gain, 0.0, limits::amplitude, usual.gain);
        p.delay = within(p.delay, 0.0, 3600.0, usual.delay);
        p.headroom = within(p.headroom, 0.0, highestTransposition - lowestTransposition, usual.headroom);
        p.reach = within(p.reach, 0.0, limits::frequency, usual.reach);
        PulseParams& pulse = p.pulses;
        pulse.frequency = within(pulse.frequency, 1.0, 20000.0, usual.pulses.frequency);
        pulse.cycles = within(pulse.cycles, 0.0, 100.0, usual.pulses.cycles);
        pulse.lowest = within(pulse.lowest, 1.0, 20000.0, usual.pulses.lowest);
        pulse.highest = within(pulse.highest, pulse.lowest, 20000.0, usual.pulses.highest);
        return p;
    }

    static std::vector<DecoderChange> finiteOnes(std::vector<DecoderChange> changes)
    {
        std::erase_if(changes,
                      [](const DecoderChange& change) {
                          return !std::isfinite(change.time) || !std::isfinite(change.transposition) ||
                                 !std::isfinite(change.stretch);
                      });
        return changes;
    }

    void addChange(double from, double transposition, double stretch) noexcept
    {
        const double semitones = clampTo(transposition, lowestTransposition, highestTransposition);
        clock.change(std::max(from, 0.0), params.stretch / clampTo(stretch, shortest, longest),
                     portable::exp2((semitones - params.transposition) / 12.0));
        setEnd();
    }

    /// The end of the clip, as far as the clock knows.
    void setEnd() noexcept
    {
        endFrame = !playable ? 0 : delayFrames + static_cast<std::int64_t>(std::floor(outputFrameOf(clipFrames) + 0.5));
    }

    /// The output frame after the delay at which the clip gets to `clipFrame`, both in output frames.
    [[nodiscard]] double outputFrameOf(double clipFrame) const noexcept
    {
        const auto r = static_cast<double>(ratio);
        return clock.untouched() ? clipFrame : clock.frameOf(clipFrame / r) * r;
    }

    /// Roles that are levelled together.
    struct Part
    {
        CarrierBank carriers;
        NoiseBank noise;
        std::vector<double> re, im; // one hop
        std::vector<double> share;  // of the noise in `im`, where it is kept apart
    };

    /// Target levels of the parts and their sum, in this order; times in inner frames.
    struct Levels
    {
        std::vector<Curve> envelopes;
        std::vector<CurveReader> readers;
    };

    /// Whether a separate role sounds, and the frame of the output from which it does.
    struct Presence
    {
        bool there = true;
        std::int64_t from = longAgo;
    };
    static constexpr std::int64_t longAgo = std::numeric_limits<std::int64_t>::min() / 4;

    /// The parts of the clip that sound, at least one, and the target envelopes of these and their sum; times in inner
    /// frames.
    void makeParts(const Clip& clip)
    {
        auto carriers = makeCarriers(clip);
        auto noise = makeNoise(clip);
        there[Role::tones] = plan.carriers > 0;
        there[Role::noise] = plan.noiseBands > 0;
        apart = params.apart && there[Role::tones] && there[Role::noise];
        const bool lacks = (params.leftOut[Role::tones] && hasRole(clip, Role::tones)) ||
                           (params.leftOut[Role::noise] && hasRole(clip, Role::noise));
        hollow = lacks && !there[Role::tones] && !there[Role::noise];
        const auto inFrames = [&](Curve curve)
        {
            for (Breakpoint& point : curve)
                point.time *= params.stretch * innerRate;
            return curve;
        };
        std::uint64_t seed = params.variation.seed;
        const auto addPart = [&](std::size_t part)
        {
            const std::size_t bands = noise[part].size();
            parts.push_back({CarrierBank(std::move(carriers[part])), NoiseBank(std::move(noise[part]), seed),
                             std::vector<double>(hopFrames), std::vector<double>(hopFrames),
                             std::vector<double>(apart ? hopFrames : 0)});
            seed += bands; // noise of one band is unlike that of another
        };
        plan.levelled = params.followEnvelope && !clip.envelope.empty();
        if (!plan.levelled)
        {
            for (std::size_t part = 1; part < clipParts; ++part)
            {
                std::move(carriers[part].begin(), carriers[part].end(), std::back_inserter(carriers[0]));
                std::move(noise[part].begin(), noise[part].end(), std::back_inserter(noise[0]));
            }
            addPart(0);
            return;
        }
        auto shared = partEnvelopes(clip);
        // Only the sum has the gaps: what comes before it measures over 10 ms.
        const Curve whole = withEventGaps(clip.envelope, clip.transients, params.gaps);
        std::vector<std::size_t> sounding;
        for (std::size_t part = 0; part < clipParts; ++part)
            if (!shared[part].empty())
            {
                addPart(part);
                sounding.push_back(part);
            }
        Levels all;
        for (const std::size_t part : sounding)
            all.envelopes.push_back(inFrames(std::move(shared[part])));
        if (parts.empty())
        {
            addPart(0);
            all.envelopes.push_back(inFrames(clip.envelope));
        }
        all.envelopes.push_back(inFrames(whole));
        const auto alone = [&](Role role)
        {
            const auto shares = roleShares(clip, role);
            Levels of;
            for (const std::size_t part : sounding)
                of.envelopes.push_back(inFrames(productOf(clip.envelope, shares[part])));
            of.envelopes.push_back(inFrames(productOf(whole, shares[clipParts])));
            return of;
        };
        if (lacks && !hollow)
            levels.push_back(alone(there[Role::tones] ? Role::tones : Role::noise));
        else
            levels.push_back(std::move(all));
        if (apart)
        {
            levels.push_back(alone(Role::tones));
            levels.push_back(alone(Role::noise));
        }
        for (Levels& set : levels)
            set.readers.resize(set.envelopes.size());
        leveller = std::make_unique<EnvelopeLeveller>(innerRate, hopFrames, parts.size(), apart);
    }

    /// The sinusoids of each part.
    [[nodiscard]] std::array<std::vector<Carrier>, clipParts> makeCarriers(const Clip& clip)
    {
        std::array<std::vector<Carrier>, clipParts> result;
        const double reference = referenceFrequency(clip);
        if (params.leftOut[Role::tones])
            return result;
        for (const Band& band : clip.bands)
        {
            Carrier carrier;
            carrier.phase = band.phase - std::floor(band.phase);
            for (const Breakpoint& point : band.amplitude)
                carrier.amplitude.push_back({point.time * params.stretch * innerRate, point.value * params.gain});
            const auto addFrequency = [&](double time, double hertz)
            {
                // Nothing may fold: what transposition pushes out of the range stays at its end.
                const double f = std::clamp(hertz * transpositionRatio, 5.0, 0.45 * params.sampleRate);
                carrier.frequency.push_back({time * params.stretch * innerRate, f / innerRate});
            };
            if (params.carriers == CarrierMode::pitch)
                for (const Breakpoint& point : band.pitch)
                    addFrequency(point.time, point.value);
            if (params.carriers == CarrierMode::centroid)
                for (const Breakpoint& point : clip.centroid)
                    addFrequency(point.time, point.value * band.centreFrequency / reference);
            if (params.carriers == CarrierMode::none)
            {
                carrier.frequency = {{0.0, 0.0}};
                carrier.phase = 0.25; // where the sine is 1
            }
            if (carrier.frequency.empty())
                addFrequency(0.0, band.centreFrequency);
            const bool silent = std::all_of(carrier.amplitude.begin(), carrier.amplitude.end(),
                                            [](const Breakpoint& p) { return p.value == 0.0; });
            if (silent)
                ++plan.silentBands;
            else
                result[clipPartOf(band.centreFrequency)].push_back(std::move(carrier));
        }
        for (const auto& carriers : result)
            plan.carriers += carriers.size();
        return result;
    }

    /// The noise of each part.
    [[nodiscard]] std::array<std::vector<NoiseCarrier>, clipParts> makeNoise(const Clip& clip)
    {
        std::array<std::vector<NoiseCarrier>, clipParts> result;
        if (params.leftOut[Role::noise])
            return result;
        for (const NoiseBand& band : clip.noise)
        {
            const double most = 0.45 * params.sampleRate;
            const double low = std::min(band.lowFrequency * transpositionRatio, most);
            const double high = std::min(band.highFrequency * transpositionRatio, most);
            NoiseCarrier carrier{{}, 0.5 * (low + high) / innerRate, 0.5 * (high - low) / innerRate};
            for (const Breakpoint& point : band.amplitude)
                carrier.amplitude.push_back({point.time * params.stretch * innerRate, point.value * params.gain});
            if (carrier.amplitude.empty())
                ++plan.silentBands;
            else
                result[clipPartOf(0.5 * (band.lowFrequency + band.highFrequency))].push_back(std::move(carrier));
        }
        for (const auto& bands : result)
            plan.noiseBands += bands.size();
        return result;
    }

    void makeEvents(const Clip& clip)
    {
        const double fs = params.sampleRate;
        pulses = PulseTrain(params.pulses, fs);
        if (params.leftOut[Role::events])
            return;
        pulses.reserve(clip.transients.size());
        for (std::size_t i = 0; i < clip.transients.size(); ++i)
        {
            const Transient& transient = clip.transients[i];
            double gap = std::numeric_limits<double>::infinity();
            if (i > 0)
                gap = transient.time - clip.transients[i - 1].time;
            if (i + 1 < clip.transients.size())
                gap = std::min(gap, clip.transients[i + 1].time - transient.time);
            gap *= params.stretch;
            const double level = leveller ? pulseLevel(clip.envelope, transient) : transient.amplitude;
            if (level <= 0.0)
            {
                ++plan.maskedTransients;
                continue;
            }
            pulses.add({transient.time * params.stretch * fs, level * params.gain, transient.sharpness, gap});
            ++plan.pulses;
        }
    }

    void processFiltered(std::span<float> out) noexcept
    {
        std::size_t done = 0;
        while (done < out.size() && (position + static_cast<std::int64_t>(done) < lastFrame() || !filtering->silent()))
        {
            const std::int64_t waiting = delayFrames - position - static_cast<std::int64_t>(done);
            if (waiting > 0)
            {
                const auto n =
                    static_cast<std::size_t>(std::min(waiting, static_cast<std::int64_t>(out.size() - done)));
                std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(done), n, 0.0f);
                done += n;
                continue;
            }
            if (readyFrom == ready.size())
                makeHop();
            const std::size_t n = std::min(out.size() - done, ready.size() - readyFrom);
            std::copy_n(ready.begin() + static_cast<std::ptrdiff_t>(readyFrom), n,
                        out.begin() + static_cast<std::ptrdiff_t>(done));
            readyFrom += n;
            done += n;
        }
        std::fill(out.begin() + static_cast<std::ptrdiff_t>(done), out.end(), 0.0f);
        position += static_cast<std::int64_t>(out.size());
    }

    /// Returns the end of a filtered clip.
    [[nodiscard]] std::int64_t lastFrame() const noexcept { return std::min(endFrame, cutFrame); }

    void makeHop() noexcept
    {
        hopDue = false;
        do
        {
            sumSources();
            if (leveller)
            {
                std::array<LevelledPart, clipParts> signals;
                for (std::size_t i = 0; i < parts.size(); ++i)
                    signals[i] = {parts[i].re, parts[i].im, parts[i].share};
                leveller->process(std::span(signals).first(parts.size()),
                                  [this](std::size_t pass) { return envelopeOf(pass); });
            }
            for (std::size_t n = 0; n < hopFrames; ++n)
                inner[n] = toSample(parts[0].im[n]); // sines, as in Eq. 4.13
            if (filtering)
                raiseFiltered();
            else
                interpolator->process(inner, ready);
            if (apart)
                raiseNoise();
            innerFrame += static_cast<std::int64_t>(hopFrames);
            const std::size_t skipped = std::min(unheard, ready.size());
            unheard -= skipped;
            readyFrom = skipped;
        } while (readyFrom == ready.size());
    }

    /// The hop of the noise by itself, at the output rate.
    void raiseNoise() noexcept
    {
        for (std::size_t n = 0; n < hopFrames; ++n)
            innerNoise[n] = toSample(parts[0].share[n]);
        noiseInterpolator->process(innerNoise, readyNoise);
    }

    /// Returns the place of the output among all frames of the interpolator.
    [[nodiscard]] std::int64_t raisedAt(std::int64_t frame) const noexcept
    {
        return frame - delayFrames + static_cast<std::int64_t>(allSkipped());
    }

    /// Inner frames that a decoder with continuous output has computed.
    [[nodiscard]] std::int64_t framesMade() const noexcept
    {
        if (!stale)
            return innerFrame + (hopDue ? static_cast<std::int64_t>(hopFrames) : 0);
        const auto perHop = static_cast<std::int64_t>(ready.size());
        const std::int64_t raised = raisedAt(std::max(position, delayFrames));
        return (raised + perHop - 1) / perHop * static_cast<std::int64_t>(hopFrames);
    }

    /// The inner frame from which a skipped hop is computed again, so that it equals continuous output.
    [[nodiscard]] std::int64_t warmFrom(std::int64_t frame) const noexcept
    {
        const std::int64_t hop = raisedAt(frame) / static_cast<std::int64_t>(ready.size());
        return std::max(innerFrame, (hop - warmHops) * static_cast<std::int64_t>(hopFrames));
    }

    void forgetPast() noexcept
    {
        if (leveller)
            leveller->reset();
        interpolator->reset();
        if (apart)
            noiseInterpolator->reset();
    }

    /// Sinusoids and noise that were not made go on to where the next hop is, or would be made up from. In time that
    /// depends on the number of breakpoints.
    void passSources() noexcept
    {
        const std::int64_t to = stale ? warmFrom(std::max(position, delayFrames)) : innerFrame;
        passSource(Role::tones, to);
        passSource(Role::noise, to);
    }

    void passSource(Role role, std::int64_t to) noexcept
    {
        for (std::int64_t& from = sourceFrame[role]; from < to;)
        {
            const auto at = static_cast<double>(from);
            const double left = std::ceil(clock.nextChange(at) - at);
            const std::int64_t most = to - from;
            const std::int64_t n =
                left < static_cast<double>(most) ? std::max<std::int64_t>(1, static_cast<std::int64_t>(left)) : most;
            for (Part& part : parts)
                if (role == Role::tones)
                {
                    part.carriers.follow(clock.pieceAt(at));
                    part.carriers.skip(n);
                }
                else
                {
                    part.noise.follow(clock.pieceAt(at));
                    part.noise.skip(n);
                }
            from += n;
        }
    }

    [[nodiscard]] bool isUnheard(Role role, const RoleGains& gains, std::size_t frame) const noexcept
    {
        return !there[role] || gains[role].at(frame) == 0.0;
    }

    /// Returns how many of the next `count` frames of a block, from its frame `from` on, have neither tones nor noise.
    [[nodiscard]] std::size_t unheardFrames(const RoleGains& gains, std::size_t from, std::size_t count) const noexcept
    {
        const auto none = [&](std::size_t n)
        {
            return isUnheard(Role::tones, gains, from + n) && isUnheard(Role::noise, gains, from + n);
        };
        if (gains[Role::tones].steady() && gains[Role::noise].steady())
            return none(0) ? count : 0;
        std::size_t n = 0;
        while (n < count && none(n))
            ++n;
        return n;
    }

    /// The hop that begins at or contains frame `from` of a block: none while nothing of it is heard.
    void goOn(const RoleGains& gains, std::size_t from) noexcept
    {
        if (unheardFrames(gains, from, 1) > 0)
        {
            quiet = stale = true;
            readyFrom = static_cast<std::size_t>(raisedAt(position + static_cast<std::int64_t>(from)) %
                                                 static_cast<std::int64_t>(ready.size()));
            return;
        }
        if (stale)
        {
            warm(gains, from);
            return;
        }
        if (apart)
            chooseRoles(gains, from);
        makeHop();
    }

    /// Computes the hop with frame `from` of a block, after skipped hops.
    void warm(const RoleGains& gains, std::size_t from) noexcept
    {
        const std::int64_t frame = position + static_cast<std::int64_t>(from);
        const std::int64_t first = warmFrom(frame);
        if (apart)
            takeRoles(gains, from);
        quiet = stale = hopDue = false;
        if (first > innerFrame)
            forgetPast();
        innerFrame = first;
        readyFrom = ready.size();
        unheard = static_cast<std::size_t>(raisedAt(frame) - innerFrame * static_cast<std::int64_t>(ratio));
        makeHop();
    }

    /// Chooses the roles to compute from now on: those of tones and noise that are heard.
    void takeRoles(const RoleGains& gains, std::size_t from) noexcept
    {
        for (const Role role : {Role::tones, Role::noise})
        {
            awake[role] = gains[role].at(from) != 0.0;
            presence[role] = {awake[role], longAgo};
        }
        levelling = levellingBefore = levellingOfAwake();
        turn = longAgo;
    }

    /// The same in a change from the hop that is made next on. Before another change the leveller must have got
    /// through.
    void chooseRoles(const RoleGains& gains, std::size_t from) noexcept
    {
        if (innerFrame == 0)
        {
            takeRoles(gains, from);
            return;
        }
        const bool tones = gains[Role::tones].at(from) != 0.0, noise = gains[Role::noise].at(from) != 0.0;
        if ((tones == awake[Role::tones] && noise == awake[Role::noise]) || innerFrame - turn < 3 * turnFrames())
            return;
        for (const Role role : {Role::tones, Role::noise})
        {
            const bool heard = role == Role::tones ? tones : noise;
            if (heard != awake[role])
                presence[role] = {heard, delayFrames + innerFrame * static_cast<std::int64_t>(ratio)};
            awake[role] = heard;
        }
        levellingBefore = levelling;
        levelling = levellingOfAwake();
        turn = innerFrame;
    }

    /// Half of the transition time between two envelopes, while the leveller's window moves over the change.
    [[nodiscard]] std::int64_t turnFrames() const noexcept
    {
        return leveller ? static_cast<std::int64_t>(leveller->delayOfPass(0)) : 0;
    }

    [[nodiscard]] std::size_t levellingOfAwake() const noexcept
    {
        return awake[Role::tones] && awake[Role::noise] ? 0 : awake[Role::tones] ? 1 : 2;
    }

    /// Fades in a role that has returned.
    [[nodiscard]] double presenceAt(Role role, std::int64_t frame) const noexcept
    {
        const Presence& of = presence[role];
        if (!of.there)
            return 0.0;
        return clampTo(static_cast<double>(frame - of.from) / static_cast<double>(presenceFrames), 0.0, 1.0);
    }

    /// The computed part of the hop, at the levels of its roles.
    void mixRoles(std::span<float> out, const RoleGains& gains, std::size_t from) const noexcept
    {
        const auto at = [](const std::vector<float>& signal, std::size_t n)
        {
            return static_cast<double>(signal[n]);
        };
        if (!apart)
        {
            const RoleGain gain = gains[there[Role::tones] ? Role::tones : Role::noise];
            for (std::size_t n = 0; n < out.size(); ++n)
                out[n] = static_cast<float>(gain.at(from + n) * at(ready, readyFrom + n));
            return;
        }
        for (std::size_t n = 0; n < out.size(); ++n)
        {
            const std::int64_t frame = position + static_cast<std::int64_t>(from + n);
            const double tones = gains[Role::tones].at(from + n) * presenceAt(Role::tones, frame);
            const double noise = gains[Role::noise].at(from + n) * presenceAt(Role::noise, frame);
            out[n] =
                static_cast<float>(tones * at(ready, readyFrom + n) + (noise - tones) * at(readyNoise, readyFrom + n));
        }
    }

    /// The hop at the output rate, with its events, cut where the clip begins and ends, behind the filter.
    void raiseFiltered() noexcept
    {
        // The output frame at which `ready` begins: less is skipped now only if it has already been.
        const std::int64_t skipped =
            innerFrame * static_cast<std::int64_t>(ratio) - static_cast<std::int64_t>(allSkipped());
        const std::int64_t first = delayFrames + skipped;
        const auto clipped = [&](std::int64_t frame)
        {
            return static_cast<std::size_t>(
                std::clamp<std::int64_t>(frame - first, 0, static_cast<std::int64_t>(ready.size())));
        };
        const FilteringInterpolator::Counted counted{clipped(delayFrames), clipped(lastFrame())};
        if (counted.from == counted.to)
            std::fill(inner.begin(), inner.end(), 0.0f); // only what was before the end still counts, and is cut
        if (!added.empty())
        {
            std::fill(added.begin(), added.end(), 0.0f);
            if (counted.from < counted.to)
                addEvents(std::span(added).subspan(counted.from, counted.to - counted.from),
                          first + static_cast<std::int64_t>(counted.from));
        }
        filtering->process(inner, added, counted, ready);
    }

    /// The frames of the interpolator in front of the clip's first one.
    [[nodiscard]] std::size_t allSkipped() const noexcept
    {
        return interpolator->latencyFrames() + (leveller ? leveller->latencyFrames() * ratio : 0);
    }

    /// One hop of the sinusoids and noise of each part.
    void sumSources() noexcept
    {
        for (const Role role : {Role::tones, Role::noise})
            if (awake[role])
                passSource(role, innerFrame);
        for (Part& part : parts)
        {
            std::fill(part.re.begin(), part.re.end(), 0.0);
            std::fill(part.im.begin(), part.im.end(), 0.0);
        }
        forPieces(static_cast<double>(innerFrame),
                  [this](std::size_t done, std::size_t n, const ClockPiece& piece)
                  {
                      for (Part& part : parts)
                      {
                          const auto re = std::span(part.re).subspan(done, n);
                          const auto im = std::span(part.im).subspan(done, n);
                          if (awake[Role::tones])
                          {
                              part.carriers.follow(piece);
                              part.carriers.process(re, im);
                          }
                          const auto share = std::span(part.share).subspan(apart ? done : 0, apart ? n : 0);
                          std::copy_n(im.begin(), share.size(), share.begin());
                          if (awake[Role::noise])
                          {
                              part.noise.follow(piece);
                              part.noise.process(re, im);
                          }
                          for (std::size_t i = 0; i < share.size(); ++i)
                              share[i] = im[i] - share[i];
                      }
                  });
        for (const Role role : {Role::tones, Role::noise})
            if (awake[role])
                sourceFrame[role] = innerFrame + static_cast<std::int64_t>(hopFrames);
    }

    /// Calls use(done, n, piece) for the n frames of a hop from `done` on that lie in one piece of the clock; the hop
    /// begins at inner frame `from`.
    template <typename Use>
    void forPieces(double from, Use&& use) noexcept
    {
        for (std::size_t done = 0; done < hopFrames;)
        {
            const double at = from + static_cast<double>(done);
            const double left = std::ceil(clock.nextChange(at) - at);
            const std::size_t n = left < static_cast<double>(hopFrames - done)
                                      ? std::max<std::size_t>(1, static_cast<std::size_t>(left))
                                      : hopFrames - done;
            use(done, n, clock.pieceAt(at));
            done += n;
        }
    }

    /// The envelope at the frames that pass `pass` of the leveller puts out in this hop.
    std::span<const double> envelopeOf(std::size_t pass) noexcept
    {
        readEnvelope(levelling, pass, wantedEnvelope);
        if (levelling == levellingBefore)
            return wantedEnvelope;
        const std::int64_t half = std::max<std::int64_t>(turnFrames(), 1);
        const std::int64_t first = innerFrame - static_cast<std::int64_t>(leveller->delayOfPass(pass));
        if (first >= turn + half)
        {
            if (pass + 1 == levels[levelling].envelopes.size())
                levellingBefore = levelling; // the last one is through
            return wantedEnvelope;
        }
        readEnvelope(levellingBefore, pass, envelopeBefore);
        for (std::size_t i = 0; i < hopFrames; ++i)
        {
            const double way = static_cast<double>(first + static_cast<std::int64_t>(i) - (turn - half)) /
                               static_cast<double>(2 * half);
            wantedEnvelope[i] = envelopeBefore[i] + clampTo(way, 0.0, 1.0) * (wantedEnvelope[i] - envelopeBefore[i]);
        }
        return wantedEnvelope;
    }

    void readEnvelope(std::size_t set, std::size_t pass, std::span<double> values) noexcept
    {
        const auto first = static_cast<double>(innerFrame) - static_cast<double>(leveller->delayOfPass(pass));
        CurveReader& reader = levels[set].readers[pass];
        forPieces(first,
                  [&](std::size_t done, std::size_t n, const ClockPiece& piece)
                  {
                      const auto timeOf = [&](std::size_t i)
                      {
                          return piece.clipAt(first + static_cast<double>(i));
                      };
                      for (std::size_t i = done; i < done + n;)
                      {
                          const CurveLine line = reader.lineAt(timeOf(i));
                          const std::size_t end = firstFrom(line.until, i, done + n, timeOf);
                          for (; i < end; ++i)
                              values[i] = params.gain * line.at(timeOf(i));
                      }
                  });
    }

    /// The first frame after `from` and before `to` whose time is not before `until`, or `to`.
    template <typename TimeOf>
    [[nodiscard]] static std::size_t firstFrom(double until, std::size_t from, std::size_t to, TimeOf&& timeOf) noexcept
    {
        if (timeOf(to - 1) < until) // mostly: points are far apart
            return to;
        while (++from < to && timeOf(from) < until)
        {
        }
        return from;
    }

    /// Adds the events to `out`, whose first frame is `from`.
    void addEvents(std::span<float> out, std::int64_t from) noexcept
    {
        pulses.process(out, from, [this](const PulseEvent& event) { return startOf(event); });
    }

    [[nodiscard]] PulseStart startOf(const PulseEvent& event) const noexcept
    {
        const double frame = outputFrameOf(event.clipFrame);
        const ClockPiece& piece = clock.pieceAt(frame / static_cast<double>(ratio));
        return {delayFrames + static_cast<std::int64_t>(std::floor(frame + 0.5)), piece.rate,
                transpositionRatio * piece.pitch};
    }

    DecoderParams params;
    bool playable = true; // at the rate that is wanted
    std::vector<DecoderChange> scheduled;
    PlayClock clock; // in inner frames, from the end of the delay on
    std::int64_t delayFrames = 0;
    std::int64_t endFrame = 0;
    double clipFrames = 0.0; // output frames of the whole clip before changes
    double transpositionRatio = 1.0;
    std::size_t ratio = 1;
    double innerRate = 48000.0;
    std::vector<Part> parts;
    std::unique_ptr<EnvelopeLeveller> leveller;
    std::unique_ptr<PolyphaseInterpolator> interpolator;
    std::unique_ptr<FilteringInterpolator> filtering; ///< in its place, with a filter
    std::int64_t cutFrame = std::numeric_limits<std::int64_t>::max();
    std::vector<Levels> levels; // of all; where tones and noise are apart also of tones alone, of noise alone
    PulseTrain pulses;
    DecoderReport plan;
    PerRole<bool> there; // tones and noise: whether there are any
    bool apart = false;  // both, at levels of their own
    bool hollow = false; // neither: they have been left out
    std::unique_ptr<PolyphaseInterpolator> noiseInterpolator;
    std::int64_t warmHops = 0; // of the past that a hop depends on

    std::vector<double> wantedEnvelope, envelopeBefore;
    std::vector<float> inner, ready, added, innerNoise, readyNoise;
    std::int64_t innerFrame = 0;
    PerRole<std::int64_t> sourceFrame; // inner frame up to which tones and noise have been made or passed over
    PerRole<bool> awake;               // tones and noise: whether they are computed
    PerRole<Presence> presence;
    std::int64_t presenceFrames = 1;
    std::size_t levelling = 0, levellingBefore = 0; // index into `levels`, changed at inner frame `turn`
    std::int64_t turn = longAgo;
    bool mixing = false; // levels of roles were given
    bool quiet = false;  // what is ready is not heard and has not been made
    bool stale = false;  // hops before the next one have not been made
    bool hopDue = false; // after skip(): a decoder that had played would have made the next hop
    std::size_t readyFrom = 0;
    std::size_t unheard = 0; // of the frames that come next
    std::int64_t position = 0;
};

} // namespace pacini
