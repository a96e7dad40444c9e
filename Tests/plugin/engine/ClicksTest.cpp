// No parameter that moves while sound plays makes a click.

#include "plugin/engine/Rig.h"

#include <pacini/filters/Butterworth.h>

#include <optional>
#include <string>

using namespace pacini;
using namespace pacini::test;
using plugin::channelParameter;
using plugin::ChannelSetting;
using plugin::OutputMode;
using plugin::PanChoice;
using plugin::ParameterId;
using plugin::ParameterRow;
using plugin::ParameterUnit;
using plugin::rowOf;

namespace
{
constexpr double fs = 48000.0;
constexpr std::size_t block = 480; // 10 ms
constexpr RigLayout wide{fs, 6, 1, 3}, widest{fs, 6, 1, 8};

/// A steady sound of some sinusoids, with other phases on each channel.
struct Tone
{
    double frequency, amplitude;
};

Channels tones(const std::vector<Tone>& parts, std::size_t channels, std::size_t frames)
{
    Channels sound(channels, std::vector<float>(frames));
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < frames; ++i)
        {
            double x = 0.0;
            for (const Tone& part : parts)
                x += part.amplitude * std::sin(2.0 * std::numbers::pi * part.frequency * static_cast<double>(i) / fs +
                                               0.3 * static_cast<double>(c));
            sound[c][i] = static_cast<float>(x);
        }
    return sound;
}

/// What of a signal lies beyond 1.5 kHz.
std::vector<double> beyond(const std::vector<float>& x)
{
    const auto filter =
        designButterworth({.type = ButterworthType::highpass, .order = 16, .frequency = Hertz(1500.0)}, fs);
    std::vector<StateVariableState> states(filter.sections.size());
    std::vector<double> y(x.begin(), x.end());
    for (double& sample : y)
        for (std::size_t s = 0; s < states.size(); ++s)
            sample = states[s].tick(filter.sections[s], sample);
    return y;
}

template <typename Samples>
double largest(const Samples& x, std::size_t begin, std::size_t end)
{
    double most = 0.0;
    for (std::size_t i = begin; i < end; ++i)
        most = std::max(most, std::abs(static_cast<double>(x[i])));
    return most;
}

double largestStep(const std::vector<float>& x, std::size_t begin, std::size_t end)
{
    double most = 0.0;
    for (std::size_t i = begin; i < end; ++i)
        most = std::max(most, std::abs(static_cast<double>(x[i]) - static_cast<double>(x[i - 1])));
    return most;
}

/// The values that a parameter takes in turn: from end to end, both ways, and each choice.
std::vector<double> valuesOf(const ParameterRow& row)
{
    if (row.unit == ParameterUnit::choice)
    {
        std::vector<double> values;
        for (std::size_t i = 0; i < row.choices.size(); ++i)
            if (!plugin::hasNoActuator(row.choices[i]))
                values.push_back(static_cast<double>(i));
        values.push_back(0.0);
        return values;
    }
    // Higher tones would be beyond 1.5 kHz themselves.
    const double high = row.parameter == ParameterId::transposition ? 24.0 : row.high;
    if (row.unit == ParameterUnit::toggle)
        return {0.0, 1.0, 0.0};
    return {row.standard, row.low, high, 0.5 * (row.low + high), row.low, row.standard};
}

/// What lets a parameter matter.
void setAround(Rig& rig, ParameterId parameter)
{
    using enum ParameterId;
    rig.set(pan, static_cast<double>(PanChoice::position));
    rig.set(panLaw, 2.0);
    rig.set(position, 0.3);
    rig.set(outputMode, static_cast<double>(OutputMode::addToChannel));
    rig.set(outputChannel, 3.0);
    if (parameter == inputGain)
        rig.set(gateThreshold, -120.0); // or it opens
    if (parameter == sourceMix)
        rig.set(source, 2.0);
    if (parameter == bypass)
        rig.set(outputMode, static_cast<double>(OutputMode::monoAndHaptic));
    for (std::size_t c = 0; c < plugin::maxHapticChannels; ++c)
        if (parameter == channelParameter(c, ChannelSetting::place))
            rig.set(places, 1.0);
        else if (parameter == channelParameter(c, ChannelSetting::delay))
            rig.set(pan, 0.0);
}

/// A sound that a parameter matters to. It stays below every limiter, which would distort it.
std::vector<Tone> soundFor(ParameterId parameter, bool oneVoice)
{
    using enum ParameterId;
    const double gain = parameter == inputGain ? 0.04 : 1.0;
    switch (parameter)
    {
    case brightness:
        return {{450.0, 0.02}};
    case audible:
        return {{80.0, 0.1}, {3000.0, 0.4}};
    case rumbleLevel:
    case rumbleMute:
        if (oneVoice) // in which two tones would beat
            return {{80.0, 0.03}};
        break;
    default:
        if (oneVoice)
            return {{170.0, 0.03 * gain}};
        break;
    }
    return {{80.0, 0.03 * gain}, {190.0, 0.02 * gain}};
}

struct Found
{
    double beyond = 0.0; ///< dB re peak
    double step = 0.0;   ///< as often as the usual one
    std::string where = {};
};

/// Moves a parameter again and again while a steady sound plays, and returns the worst of what the outputs then hold.
Found moved(ParameterId parameter, double actuator)
{
    const bool slow = std::string(rowOf(parameter).id).starts_with("delay");
    const std::size_t hold = slow ? 150 * block : 70 * block, rest = 20 * block;
    const auto values = valuesOf(rowOf(parameter));
    const std::size_t frames = values.size() * hold;
    Rig rig(parameter > channelParameter(2, ChannelSetting::place) ? widest : wide);
    rig.plugin.setNonRealtime(true); // actuators are taken at once
    setAround(rig, parameter);
    rig.set(ParameterId::profile, actuator);
    rig.set(parameter, values[0]);
    rig.plugin.prepareToPlay(fs, static_cast<int>(block));
    const auto sound = tones(soundFor(parameter, actuator > 0.0), 6, frames);
    const auto out = rig.run(sound, tones({{170.0, 0.03}}, 1, frames), {static_cast<int>(block)},
                             [&](std::size_t done)
                             {
                                 if (done * block % hold == 0)
                                     rig.set(parameter, values[done * block / hold]);
                             });
    Found worst{-300.0, 0.0};
    std::size_t heard = 0;
    const auto judge = [&](const std::vector<float>& y, const std::vector<float>& under, const std::string& name)
    {
        const auto high = beyond(y);
        for (std::size_t k = 1; k < values.size(); ++k)
        {
            const std::size_t at = k * hold, before = at - rest, after = at + hold - rest;
            const double peak = std::max(largest(y, before, at), largest(y, after, after + rest));
            if (peak < 1e-4)
                continue;
            ++heard;
            const double there = std::max(largest(high, before, at), largest(high, after, after + rest));
            double usual = std::max(largestStep(y, before, at), largestStep(y, after, after + rest));
            if (!under.empty()) // the sound, which the drive may have cancelled
                usual = std::max(usual, largestStep(under, before, at));
            const double heardThere = largest(high, at, after);
            // Carriers have some of it always: as much again is no click.
            const double level = heardThere > 2.0 * there ? 20.0 * std::log10(heardThere / peak) : -300.0;
            const double step = largestStep(y, at, after) / usual;
            if (level > worst.beyond || step > worst.step)
                worst.where += " " + name + "@" + std::to_string(values[k - 1]) + ">" + std::to_string(values[k]) +
                               ": " + std::to_string(level) + " dB, " + std::to_string(step);
            worst.beyond = std::max(worst.beyond, level);
            worst.step = std::max(worst.step, step);
        }
    };
    for (std::size_t c = 0; c < out.haptic.size(); ++c)
        judge(out.haptic[c], {}, "haptic " + std::to_string(c + 1));
    if (parameter != ParameterId::audible) // whose sound is beyond 1.5 kHz itself
        for (std::size_t c = 0; c < out.main.size(); ++c)
            judge(out.main[c], sound[c], "main " + std::to_string(c + 1));
    CHECK(heard > 0);
    return worst;
}
} // namespace

TEST_CASE("No parameter clicks when it moves while sound plays")
{
    for (const ParameterRow& row : plugin::parameterTable)
        for (const double actuator : {0.0, 3.0})
        {
            const auto worst = moved(row.parameter, actuator);
            CAPTURE(row.id, actuator, worst.where);
            CHECK(worst.beyond < -60.0);
            CHECK(worst.step < 2.0);
        }
}
