#pragma once

// Automation of one play of a scene: levels and delays towards every actuator, changes of pitch and speed.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Portable.h>
#include <pacini/synthesis/DecoderParams.h>
#include <pacini/synthesis/PlayClock.h>
#include <pacini/synthesis/Scene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Curves over seconds of the scene.
struct PlayTimeline
{
    std::vector<Curve> gains;           ///< one for each actuator, linear, with the scene's gain
    std::vector<Curve> delays;          ///< one for each actuator, s; empty where nothing is ever late
    Curve level;                        ///< as gains, without the pan
    Curve delay;                        ///< as delays, without the pan; empty where it is 0
    std::vector<DecoderChange> changes; ///< times from the play's start; in order
    PerRole<Curve> roles;               ///< levels of the roles of the clip, linear; empty where one is always 1
    Curve speed = {}, force = {};       ///< of a texture, 0 to 1; empty without one
    bool operator==(const PlayTimeline&) const = default;
};

/// Whether anything moves the levels of roles apart from 1.
[[nodiscard]] inline bool hasRoleLevels(const PlayTimeline& timeline) noexcept
{
    return std::any_of(timeline.roles.begin(), timeline.roles.end(), [](const Curve& curve) { return !curve.empty(); });
}

/// Whether a role is silent throughout.
[[nodiscard]] inline bool isMuted(const PlayTimeline& timeline, Role role) noexcept
{
    const Curve& curve = timeline.roles[role];
    return !curve.empty() &&
           std::all_of(curve.begin(), curve.end(), [](const Breakpoint& point) { return point.value == 0.0; });
}

/// The clock of a play that begins with `stretch`: from seconds after its start to seconds of the clip.
[[nodiscard]] inline PlayClock makeClock(double stretch, const PlayTimeline& timeline)
{
    PlayClock clock(timeline.changes.size());
    clock.change(0.0, 1.0 / stretch, 1.0);
    for (const DecoderChange& change : timeline.changes)
        clock.change(change.time, 1.0 / change.stretch, 1.0);
    return clock;
}

/// Gain of each of `actuators` for a pan of 0-1: between two neighbours sine and cosine of the way, so that the power
/// stays 1; the same for all with pure delay panning.
[[nodiscard]] inline double panGain(PanLaw law, double pan, std::size_t actuator, std::size_t actuators) noexcept
{
    if (law == PanLaw::delay || actuators == 1)
        return 1.0 / std::sqrt(static_cast<double>(actuators));
    const double distance = std::abs(pan * static_cast<double>(actuators - 1) - static_cast<double>(actuator));
    return distance < 1.0 ? portable::turnBy(0.25 * distance).real() : 0.0;
}

/// Delay of an actuator: its distance from the pan, at most `longest` s for the whole row.
[[nodiscard]] inline double panDelay(double pan, std::size_t actuator, std::size_t actuators, double longest) noexcept
{
    if (actuators == 1)
        return 0.0;
    return longest * std::abs(pan - static_cast<double>(actuator) / static_cast<double>(actuators - 1));
}

namespace detail
{
/// A parameter over time: linear glides that start from whatever has been reached.
class GlideCurve
{
public:
    explicit GlideCurve(double value) : points{{0.0, value}} {}

    void glideTo(double value, double time, double glide)
    {
        const double reached = valueAt(points, time);
        while (!points.empty() && points.back().time > time)
            points.pop_back();
        points.push_back({time, reached});
        points.push_back({time + glide, value});
    }

    [[nodiscard]] const Curve& curve() const noexcept { return points; }

private:
    Curve points;
};

/// All times at which one of two curves bends, `pieces` to each piece of the second, where it moves.
inline std::vector<double> bends(const Curve& a, const Curve& b, int pieces)
{
    std::vector<double> times;
    for (const Breakpoint& point : a)
        times.push_back(point.time);
    for (std::size_t i = 0; i < b.size(); ++i)
    {
        times.push_back(b[i].time);
        if (i + 1 < b.size() && b[i].value != b[i + 1].value)
            for (int k = 1; k < pieces; ++k)
                times.push_back(b[i].time + (b[i + 1].time - b[i].time) * k / pieces);
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

/// Both sides of each time where a curve steps.
template <typename Value>
void appendSides(Curve& result, double time, Value&& at)
{
    constexpr double before = 1e-9; // s: far below a sample, far above the rounding of a day in double
    if (time > before)
        if (const double left = at(time - before); std::abs(left - at(time)) > 1e-6)
            result.push_back({time, left});
    result.push_back({time, at(time)});
}

/// Curves of all that changes in a play.
struct PlayMoves
{
    GlideCurve level, pan, delay;
    PerRole<std::optional<GlideCurve>> roles; ///< those that are ever off 1
    GlideCurve speed, force;                  ///< of a texture
    bool late;                                ///< the delay is ever above 0
    std::vector<DecoderChange> changes;       ///< of pitch and speed

    PlayMoves(const ScenePlay& play, std::span<const SceneChange> moved)
        : level(sceneGain(play.gain)),
          pan(play.pan),
          delay(play.delay),
          speed(play.speed),
          force(play.force),
          late(play.delay > 0.0)
    {
        for (const Role role : allRoles)
            if (const double start = sceneGain(roleLevel(play, role)); start != 1.0)
                roles[role].emplace(start);
        double transposition = play.transposition, stretch = play.stretch;
        for (const SceneChange& change : moved)
        {
            switch (change.parameter)
            {
            case SceneParameter::gain:
                level.glideTo(sceneGain(change.value), change.time, change.glide);
                continue;
            case SceneParameter::pan:
                pan.glideTo(change.value, change.time, change.glide);
                continue;
            case SceneParameter::delay:
                delay.glideTo(change.value, change.time, change.glide);
                late = late || change.value > 0.0;
                continue;
            case SceneParameter::speed:
                speed.glideTo(change.value, change.time, change.glide);
                continue;
            case SceneParameter::force:
                force.glideTo(change.value, change.time, change.glide);
                continue;
            case SceneParameter::transposition:
                transposition = change.value;
                break;
            case SceneParameter::stretch:
                stretch = change.value;
                break;
            case SceneParameter::tones:
            case SceneParameter::events:
            case SceneParameter::noise:
            {
                auto& role = roles[*roleOf(change.parameter)];
                if (!role)
                    role.emplace(1.0);
                role->glideTo(sceneGain(change.value), change.time, change.glide);
                continue;
            }
            }
            changes.push_back({std::max(0.0, change.time - play.start), transposition, stretch});
        }
    }
};
} // namespace detail

/// The timeline of play `index` in a valid scene.
[[nodiscard]] inline PlayTimeline makeTimeline(const Scene& scene, std::size_t index,
                                               std::span<const SceneChange> changes)
{
    detail::PlayMoves moves(scene.plays[index], changes);
    const Curve &level = moves.level.curve(), &pan = moves.pan.curve(), &delay = moves.delay.curve();
    PlayTimeline timeline;
    timeline.changes = std::move(moves.changes);
    if (scene.plays[index].texture)
    {
        timeline.speed = moves.speed.curve();
        timeline.force = moves.force.curve();
    }
    for (const Role role : allRoles)
        if (moves.roles[role])
            timeline.roles[role] = moves.roles[role]->curve();

    // Levels follow a pan along a cosine, which 64 chords between neighbours hold within -80 dB.
    const int chords = 64 * std::max(1, scene.actuators - 1);
    const auto times = detail::bends(level, pan, chords);
    const auto actuators = static_cast<std::size_t>(scene.actuators);
    const double whole = sceneGain(scene.gain);
    for (const Breakpoint& point : level)
        timeline.level.push_back({point.time, whole * point.value});
    const bool panDelays = scene.panLaw != PanLaw::constantPower && actuators > 1;
    if (moves.late)
        timeline.delay = delay;
    const auto delayTimes = moves.late ? detail::bends(delay, pan, chords) : times;
    for (std::size_t a = 0; a < actuators; ++a)
    {
        Curve gains, delays;
        for (double time : times)
            detail::appendSides(
                gains, time,
                [&](double t)
                { return whole * valueAt(level, t) * panGain(scene.panLaw, valueAt(pan, t), a, actuators); });
        timeline.gains.push_back(std::move(gains));
        if (!moves.late && !panDelays)
            continue;
        for (double time : delayTimes)
        {
            const double position = panDelays ? panDelay(valueAt(pan, time), a, actuators, scene.panDelay) : 0.0;
            delays.push_back({time, valueAt(delay, time) + position});
        }
        timeline.delays.push_back(std::move(delays));
    }
    return timeline;
}

} // namespace pacini
