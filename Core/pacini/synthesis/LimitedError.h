#pragma once

// Error bound behind a limiter, for parts that are skipped before it.

#include <pacini/actuator/LimiterGain.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/ProtectionParams.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/PlayClock.h>
#include <pacini/synthesis/PlayEnergy.h>
#include <pacini/synthesis/RenderPlan.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini::detail
{

/// Operating point of an actuator's limiter, and its behaviour there.
struct LimiterModel
{
    double perDrive = 1.0; ///< the largest level, in parts of its limit, that a drive of 1 (the clip's) can cause
    double spread = 1.0;   ///< the same for a sample of 1 in front of the limiter
    double hold = 0.0;     ///< s
    bool soft = false;     ///< knee

    [[nodiscard]] double gain(double levelSquared) const noexcept
    {
        return soft && levelSquared > SoftKnee::startSquared ? SoftKnee::gain(levelSquared)
                                                             : HardKnee::gain(levelSquared);
    }
};

/// The limiter that ScenePlayer puts before an actuator.
inline LimiterModel limiterModel(const Profile* profile)
{
    constexpr double lookAhead = 0.001;
    if (profile == nullptr)
        return {1.0, 1.0, limiterHold(Hertz(20.0)) + lookAhead, false};
    const ProtectionNeeds needs = protectionNeeds(*profile);
    LimiterModel model;
    if (needs.excursion == ProtectionNeeds::Limit::guarded)
        model.spread = std::max(model.spread, needs.worstExcursion / *profile->drive.maxExcursion);
    if (needs.heat == ProtectionNeeds::Limit::guarded)
        model.spread = std::max(model.spread, std::sqrt(needs.worstPower / *profile->drive.maxPower));
    model.perDrive = model.spread / profile->drive.overdrive;
    model.hold = limiterHold(Hertz(profile->range.lowFrequency)) + lookAhead;
    model.soft = true;
    return model;
}

/// Scene time in cells of equal length, at least 20 ms, at most 5000 of them: long scenes take longer cells, and with
/// them a coarser bound, so that planning takes no longer than reading their points.
struct TimeCells
{
    explicit TimeCells(double duration)
        : length(std::max(0.02, duration / 5'000.0)), count(static_cast<std::size_t>(duration / length) + 1)
    {
    }
    [[nodiscard]] std::size_t at(double time) const noexcept
    {
        return std::min(static_cast<std::size_t>(std::max(time, 0.0) / length), count - 1);
    }
    /// Returns the number of cells that a time may reach into.
    [[nodiscard]] std::size_t covering(double time) const noexcept
    {
        return static_cast<std::size_t>(std::ceil(time / length)) + 1;
    }
    double length; ///< s
    std::size_t count;
};

/// The largest value of something in each cell from `first` on.
struct CellTrack
{
    std::size_t first = 0;
    std::vector<double> values;

    void include(std::size_t cell, double value)
    {
        if (cell >= first && cell - first < values.size())
            values[cell - first] = std::max(values[cell - first], value);
    }
    void add(const CellTrack& other, double factor)
    {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] += factor * other.values[i];
    }
};

/// Power that a play sends to an actuator over time, computed from its curves: squared amplitudes, summed over bands.
/// The mean square is half of that.
class PlaySquares
{
public:
    PlaySquares(const PlannedPlay& plannedPlay, const PlayEnergy& playEnergy, double sceneDuration,
                const TimeCells& timeCells)
        : planned(plannedPlay),
          energy(playEnergy),
          clock(makeClock(planned.decoder.stretch, planned.timeline)),
          cells(timeCells),
          end(std::min(sceneDuration, planned.start + clock.frameOf(planned.clip.duration)))
    {
        double latest = 0.0;
        for (const Curve& curve : planned.timeline.delays)
            for (const Breakpoint& point : curve)
                latest = std::max(latest, point.value);
        reach = cells.covering(latest); // at least 1: filters ring, limiters look ahead
        extent = end > planned.start ? cells.at(end) - cells.at(planned.start) + reach + 1 : 0;
    }

    /// The power of an actuator's gain, the scale of the squares below.
    [[nodiscard]] CellTrack ofGain(const Curve& gain) const
    {
        CellTrack track = squares(gain, [](double time) { return time; });
        for (double& value : track.values)
            value *= planned.decoder.gain * planned.decoder.gain;
        if (!hasRoleLevels(planned.timeline))
            return track;
        // The highest level of any role is that of all: a limiter is then expected to do more than it may.
        CellTrack levels = none();
        for (const Curve& curve : planned.timeline.roles)
        {
            const CellTrack level = curve.empty() ? squares({{0.0, 1.0}}, [](double time) { return time; })
                                                  : squares(curve, [](double time) { return time; });
            for (std::size_t i = 0; i < levels.values.size(); ++i)
                levels.values[i] = std::max(levels.values[i], level.values[i]);
        }
        for (std::size_t i = 0; i < track.values.size(); ++i)
            track.values[i] *= levels.values[i];
        return track;
    }

    [[nodiscard]] CellTrack ofBand(std::size_t band, const CellTrack& gain) const
    {
        return ofCurve(planned.clip.bands[band].amplitude, energy.gains.bands[band], gain);
    }

    [[nodiscard]] CellTrack ofWhole(const CellTrack& gain) const
    {
        CellTrack sum = none();
        const Clip& clip = planned.clip;
        if (energy.levelled)
            sum.add(ofCurve(clip.envelope, energy.gains.largest(), gain), PlayEnergy::fastBeats);
        else
        {
            for (std::size_t k = 0; k < clip.bands.size(); ++k)
                sum.add(ofBand(k, gain), 1.0);
            for (std::size_t k = 0; k < clip.noise.size(); ++k)
                sum.add(ofCurve(clip.noise[k].amplitude, energy.gains.noise[k], gain), 2.0);
        }
        CellTrack events = none();
        for (const Transient& event : clip.transients)
        {
            const double time = planned.start + clock.frameOf(event.time);
            if (time >= end)
                break;
            const double peak = event.amplitude * energy.gains.events;
            events.include(cells.at(time), peak * peak);
            events.include(cells.at(time) + 1, peak * peak);
        }
        sum.add(reached(std::move(events), 1.0, gain), 1.0);
        return sum;
    }

    /// The largest ratio of the play's peak to the root of its square (Cauchy and Schwarz); noise has no peak but
    /// seldom exceeds four times its RMS value, as eight bands would.
    [[nodiscard]] double peakRatio() const
    {
        const double bands = static_cast<double>(planned.clip.bands.size()) +
                             8.0 * static_cast<double>(planned.clip.noise.size()) +
                             (planned.clip.transients.empty() ? 0.0 : 1.0);
        return std::sqrt(bands);
    }

private:
    [[nodiscard]] CellTrack none() const { return {cells.at(planned.start), std::vector<double>(extent, 0.0)}; }

    [[nodiscard]] CellTrack ofCurve(const Curve& curve, double scale, const CellTrack& gain) const
    {
        return reached(squares(curve, [&](double time) { return planned.start + clock.frameOf(time); }), scale * scale,
                       gain);
    }

    /// The largest square of a curve in each cell of the play; `inScene` gives the scene's time of the curve's.
    template <typename InScene>
    [[nodiscard]] CellTrack squares(const Curve& curve, InScene&& inScene) const
    {
        CellTrack track = none();
        if (curve.empty() || extent == 0)
            return track;
        const auto line = [&](double t0, double v0, double t1, double v1)
        {
            const double from = std::max(t0, planned.start), to = std::min(t1, end);
            if (!(to >= from))
                return;
            const auto at = [&](double t)
            {
                return t1 > t0 ? v0 + (v1 - v0) * ((t - t0) / (t1 - t0)) : v1;
            };
            double value = t0 < from ? at(from) : v0;
            const std::size_t last = cells.at(to);
            for (std::size_t cell = cells.at(from); cell <= last; ++cell)
            {
                const double next = cell < last ? at(static_cast<double>(cell + 1) * cells.length)
                                    : t1 > to   ? at(to)
                                                : v1;
                track.include(cell, std::max(value * value, next * next));
                value = next;
            }
        };
        double time = inScene(curve.front().time), value = curve.front().value;
        line(planned.start, value, time, value);
        for (const Breakpoint& point : curve)
        {
            const double next = inScene(point.time);
            line(time, value, next, point.value);
            time = next;
            value = point.value;
        }
        line(time, value, end, value);
        return track;
    }

    /// Squares times those of the gain, and what may come later by the delays.
    [[nodiscard]] CellTrack reached(CellTrack track, double scale, const CellTrack& gain) const
    {
        for (std::size_t i = 0; i < track.values.size(); ++i)
            track.values[i] *= scale * gain.values[i];
        for (std::size_t i = track.values.size(); i-- > 0;)
            for (std::size_t k = 1; k <= std::min(reach, i); ++k)
                track.values[i] = std::max(track.values[i], track.values[i - k]);
        return track;
    }

    const PlannedPlay& planned;
    const PlayEnergy& energy;
    PlayClock clock;
    TimeCells cells;
    double end;
    std::size_t reach = 1;
    std::size_t extent = 0;
};

/// The highest recent square, as a limiter sees it: held, then released.
class LimiterMemory
{
public:
    LimiterMemory(double hold, const TimeCells& cells)
        : window(cells.covering(hold)), decay(Decibels(-KneeLimiterGain<HardKnee>::releaseRate * cells.length).power())
    {
    }

    /// In cell `i` of `squares` (silence after their end); cells in turn from 0.
    double at(std::size_t i, std::span<const double> squares)
    {
        double newest = 0.0;
        for (std::size_t k = i - std::min(i, window); k <= i && k < squares.size(); ++k)
            newest = std::max(newest, squares[k]);
        level = std::max(level * decay, newest);
        return level;
    }

private:
    std::size_t window;
    double decay;
    double level = 0.0;
};

/// Limiter behaviour of a scene: how much a limiter can take of a scene, and what it makes of errors.
///
/// Let x be a scene, y = x - e what is left of it, L the level that a limiter answers: the largest |x| of late, held
/// and let go (KneeLimiterGain). L is a maximum, so that L(x) and L(y) differ by no more than |e| where x or y is
/// largest; the gain g(L) falls no faster than 1 / L; so that
///     |g(x) x - g(y) y| <= g (|e| + |e where x or y was largest of late|).
/// Behind the limiter there is the error that was before it, and at most as much as one of its values of late. What is
/// left out is neither largest where all the rest is, nor does it go with its own later values there: of those values
/// the RMS value counts, the highest of late, and energies add up. This second part is there only where the gain moves
/// at all.
class LimitedScene
{
public:
    LimitedScene(const RenderPlan& plan, std::span<const PlayEnergy> energies, const LimiterModel& limiterModel)
        : model(limiterModel), cells(plan.duration)
    {
        std::vector<double> peaks(cells.count, 0.0), squares(cells.count, 0.0);
        for (std::size_t i = 0; i < plan.plays.size(); ++i)
        {
            const PlaySquares play(plan.plays[i], energies[i], plan.duration, cells);
            CellTrack most; // on any actuator
            for (const Curve& gain : plan.plays[i].timeline.gains)
            {
                CellTrack found = play.ofWhole(play.ofGain(gain));
                if (most.values.empty())
                    most = std::move(found);
                else
                    for (std::size_t k = 0; k < found.values.size(); ++k)
                        most.include(found.first + k, found.values[k]);
            }
            const double ratio = play.peakRatio();
            for (std::size_t k = 0; k < most.values.size() && most.first + k < cells.count; ++k)
            {
                peaks[most.first + k] += ratio * std::sqrt(most.values[k]);
                squares[most.first + k] += most.values[k];
            }
        }
        // Of many sounds at once the peaks do not meet. As seldom more than three times, mostly less than twice their
        // RMS value, and at least the peak of a sinusoid.
        const double scale = model.perDrive * model.perDrive;
        const auto gainAt = [&](double crest)
        {
            std::vector<double> gain(cells.count);
            for (std::size_t k = 0; k < cells.count; ++k)
                gain[k] = scale * std::min(peaks[k] * peaks[k], crest * crest * 0.5 * squares[k]);
            LimiterMemory memory(model.hold, cells);
            std::vector<double> levels(cells.count);
            for (std::size_t k = 0; k < cells.count; ++k)
                levels[k] = model.gain(memory.at(k, gain));
            return levels;
        };
        const auto least = gainAt(3.0), usual = gainAt(2.0), most = gainAt(std::numbers::sqrt2);
        gains.resize(cells.count);
        for (std::size_t k = 0; k < cells.count; ++k)
        {
            gains[k] = {usual[k] * usual[k], most[k] * most[k], least[k] < 1.0};
            moves = moves || least[k] < 1.0;
        }
    }

    /// Whether anything can be limited at all.
    [[nodiscard]] bool limits() const noexcept { return moves; }

    /// Makes a play's energies those behind the limiter.
    void limit(const PlannedPlay& planned, double duration, PlayEnergy& energy) const
    {
        const PlaySquares play(planned, energy, duration, cells);
        double all = 0.0, least = 0.0, most = 0.0, whole = 0.0;
        std::vector<double> bands(energy.bands.size(), 0.0);
        for (const Curve& curve : planned.timeline.gains)
        {
            const CellTrack gain = play.ofGain(curve);
            const CellTrack squares = play.ofWhole(gain);
            for (std::size_t k = 0; k < squares.values.size() && squares.first + k < cells.count; ++k)
            {
                all += squares.values[k];
                least += squares.values[k] * gains[squares.first + k].usual;
                most += squares.values[k] * gains[squares.first + k].most;
            }
            whole += spreadOf(squares);
            for (std::size_t b = 0; b < bands.size(); ++b)
                bands[b] += energy.bandErrors * spreadOf(play.ofBand(b, gain));
        }
        if (all > 0.0)
            energy.least *= least / all;
        energy.most = (all > 0.0 ? energy.most * most / all : energy.most) + whole;
        for (std::size_t b = 0; b < bands.size(); ++b)
            energy.bands[b] += bands[b];
    }

    /// Returns the error of a change of the whole scene by a factor close to 1: the energy of its error by this factor.
    static constexpr double wholeScene = 2.0;

private:
    /// The gain's square.
    struct PowerGain
    {
        double usual = 1.0;
        double most = 1.0;
        bool moves = false; ///< not certainly 1
    };

    /// The energy of the highest RMS value of late, where the gain moves.
    [[nodiscard]] double spreadOf(const CellTrack& squares) const
    {
        double largest = 0.0;
        for (const double value : squares.values)
            largest = std::max(largest, value);
        LimiterMemory memory(model.hold, cells);
        double sum = 0.0;
        for (std::size_t k = 0; squares.first + k < cells.count; ++k)
        {
            const double level = memory.at(k, squares.values);
            if (k >= squares.values.size() && level <= 1e-6 * largest)
                break;
            if (const PowerGain& power = gains[squares.first + k]; power.moves)
                sum += level * power.most;
        }
        return 0.5 * sum * model.spread * model.spread * cells.length;
    }

    LimiterModel model;
    TimeCells cells;
    std::vector<PowerGain> gains; // of each cell
    bool moves = false;
};

} // namespace pacini::detail
