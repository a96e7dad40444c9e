#include "cli/plot/ProfileFigure.h"

#include "cli/ProfileReport.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/MotorDrive.h>
#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Wearer.h>
#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace pacini::plot
{

namespace
{
constexpr double lowest = 10.0;    // Hz
constexpr double highest = 1500.0; // Hz
constexpr double sampleRate = 48000.0;

bool isMotor(const Profile& profile)
{
    return profile.technology == Technology::erm;
}

/// The pole pair that a wearer feels as the resonance.
Resonance resonanceOf(const Profile& profile)
{
    return profile.body && !isMotor(profile) ? loadedResonance(*profile.body, profile.resonance) : profile.resonance;
}

/// Evenly in octaves, and the top of the resonance, which may be narrower than that.
std::vector<double> shownFrequencies(const Profile& profile)
{
    constexpr int count = 700;
    std::vector<double> frequencies;
    for (int i = 0; i < count; ++i)
        frequencies.push_back(lowest * std::pow(highest / lowest, static_cast<double>(i) / (count - 1)));
    const double top = resonanceOf(profile).frequency;
    if (top > lowest && top < highest)
        frequencies.insert(std::lower_bound(frequencies.begin(), frequencies.end(), top), top);
    return frequencies;
}

double decibels(double gain)
{
    return Decibels::fromGain(std::max(gain, 1e-30)).value;
}

/// m/s^2 at full drive on a wearer, dB, at the frequencies that the actuator reaches.
std::vector<Point> feltResponse(const Profile& profile, unsigned wearer, const std::vector<double>& frequencies)
{
    const bool spins = isMotor(profile);
    const double rated = profile.resonance.frequency;
    const MotorDriveParams motor = motorDriveParams(profile);
    const BodyChain chain =
        makeBodyChain(bodyOn(wearer, *profile.body), profile.resonance, spins ? BodyForce::device : BodyForce::coil);
    std::vector<Point> points;
    for (const double f : frequencies)
    {
        const double speed = f / rated;
        if (spins && (speed < motor.stallVoltage || speed > motor.overdrive))
            continue;
        const double force = spins ? speed * speed : 1.0;
        points.push_back({f, decibels(force * std::abs(chain.response(BodyPoint::skin, Hertz(f))))});
    }
    return points;
}

struct ShownFilter
{
    std::vector<Point> response; ///< dB; empty without a filter
    std::string title;
};

ShownFilter outputFilter(const Profile& profile, const std::vector<double>& frequencies)
{
    const ActuatorFit fit = fitActuator(profile, {});
    const auto& flattening = fit.flattening;
    const auto filter = designOutputFilter({fit.equalizer, flattening}, sampleRate);
    ShownFilter shown;
    for (const double f : frequencies)
        shown.response.push_back({f, decibels(std::abs(filter.response(Hertz(f), sampleRate)))});
    shown.title = flattening ? fmt::format("Output filter: resonance at {:.0f} Hz flattened down to {:.0f} Hz",
                                           flattening->actuator.frequency, flattening->target.frequency)
                  : profile.equalizer.empty() ? "No output filter"
                                              : "Output filter: equaliser of the profile";
    return shown;
}

Axis frequencyAxis()
{
    return {"Frequency (Hz)", Scale::logarithmic, lowest, highest, {}};
}

/// Whole tens around the values, at least 20 dB and at most `most` dB below the top; above it room for labels.
Axis levelAxis(std::string title, const std::vector<double>& levels, double most)
{
    const auto [weakest, strongest] = std::minmax_element(levels.begin(), levels.end());
    const double high = 10.0 * std::ceil((*strongest + 3.0) / 10.0);
    const double low = std::max(10.0 * std::floor((*weakest - 1.0) / 10.0), high - most);
    return {std::move(title), Scale::linear, std::min(low, high - 20.0), high, {}};
}

/// The actuator's range as a ground behind what else is in the panel.
void markRange(Panel& panel, const ActuatorRange& range, bool listed, const Look& look)
{
    const Area area{fmt::format("range {:.0f}\u2013{:.0f} Hz", range.lowFrequency, range.highFrequency),
                    {{range.lowFrequency, panel.y.high}, {range.highFrequency, panel.y.high}},
                    {panel.y.low, panel.y.low},
                    look.theme.series(2).withAlpha(0.09),
                    listed};
    panel.series.insert(panel.series.begin(), area);
}

Panel feltPanel(const Profile& profile, const ShownFilter& filter, const std::vector<double>& frequencies,
                const Look& look)
{
    const Colour plain = look.theme.series(0);
    const Stroke thin{plain.withAlpha(0.35), look.metrics.hair()};
    const double thick = 2.2 * look.metrics.hair();
    Panel panel;
    panel.title =
        isMotor(profile) ? "Felt acceleration of the motor at a steady speed" : "Felt acceleration at full drive";
    panel.x = frequencyAxis();
    panel.share = 2.0;
    std::vector<Line> lines;
    for (unsigned wearer = 1; wearer <= simulatedWearers; ++wearer)
        lines.push_back({fmt::format("{} other wearers", simulatedWearers),
                         feltResponse(profile, wearer, frequencies),
                         thin,
                         {},
                         {},
                         wearer == 1});
    Line own{isMotor(profile) ? "motor to skin" : "drive to skin",
             feltResponse(profile, 0, frequencies),
             Stroke{plain, thick},
             {}};
    lines.push_back(own);
    if (!isMotor(profile))
    {
        own.name = "after the output filter";
        own.stroke = Stroke{look.theme.series(1), thick};
        for (std::size_t i = 0; i < own.points.size(); ++i)
            own.points[i].y += filter.response[i].y;
        lines.push_back(std::move(own));
    }
    std::vector<double> levels;
    for (const Line& line : lines)
        for (const Point& point : line.points)
            levels.push_back(point.y);
    panel.y = levelAxis("dB re 1 m/s\u00b2", levels, 80.0);
    panel.series.assign(std::make_move_iterator(lines.begin()), std::make_move_iterator(lines.end()));
    markRange(panel, profile.range, true, look);
    return panel;
}

Panel filterPanel(const Profile& profile, const ShownFilter& filter, const Look& look)
{
    Panel panel;
    panel.title = filter.title;
    panel.x = frequencyAxis();
    std::vector<double> levels;
    for (const Point& point : filter.response)
        levels.push_back(point.y);
    panel.y = levelAxis("Gain (dB)", levels, 40.0);
    panel.series.push_back(
        Line{"output filter", filter.response, Stroke{look.theme.series(1), 2.0 * look.metrics.hair()}, {}});
    markRange(panel, profile.range, !profile.body, look);
    return panel;
}

std::string subtitleFor(const Profile& profile)
{
    std::string text = cli::technologyText(profile.technology);
    if (isMotor(profile))
        text += fmt::format(" \u00b7 rated speed {:.0f} Hz", profile.resonance.frequency);
    else if (profile.technology != Technology::pcm)
        text += fmt::format(" \u00b7 resonance {:.0f} Hz, Q {:.3g}, on a base held still", profile.resonance.frequency,
                            profile.resonance.q);
    if (profile.body)
        text += " \u00b7 wearers: mass, stiffness and damping of the skin \u00d7 \u00bd to 2, assumed";
    return text;
}
} // namespace

Figure makeProfileFigure(const Profile& profile, const FigureStyle& style)
{
    const Look look = lookFor(style);
    const auto frequencies = shownFrequencies(profile);
    const ShownFilter filter = outputFilter(profile, frequencies);
    Figure figure{profile.name, subtitleFor(profile), {}};
    if (profile.body)
        figure.panels.push_back(feltPanel(profile, filter, frequencies, look));
    if (!isMotor(profile) || !profile.body)
        figure.panels.push_back(filterPanel(profile, filter, look));
    if (profile.technology != Technology::pcm)
    {
        const double f = resonanceOf(profile).frequency;
        const char* what = isMotor(profile) ? "rated speed" : profile.body ? "resonance as worn" : "resonance";
        for (Panel& panel : figure.panels)
            panel.rules.push_back(
                {f, &panel == &figure.panels.front() ? fmt::format("{}, {:.0f} Hz", what, f) : std::string()});
    }
    return figure;
}

} // namespace pacini::plot
