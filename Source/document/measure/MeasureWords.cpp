#include "document/measure/MeasureWords.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

namespace pacini
{

namespace
{
std::string sentence(std::string text)
{
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    if (!text.empty() && text.back() != '.')
        text += '.';
    return text;
}

/// The name of the input that `channels[1]` or `channels[1][77]` speaks of.
std::optional<std::string> inputOf(std::string_view where, std::span<const std::string> inputs)
{
    constexpr std::string_view start = "channels[";
    std::size_t index = 0;
    if (!where.starts_with(start) ||
        std::from_chars(where.data() + start.size(), where.data() + where.size(), index).ec != std::errc())
        return std::nullopt;
    return index < inputs.size() ? inputs[index] : fmt::format("Channel {}", index + 1);
}

std::string listed(std::span<const std::string> names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : ", ") + ("'" + names[i] + "'");
    return text.empty() ? "the recording" : text;
}

/// `sweep.highFrequency` in words.
std::string settingOf(std::string_view where)
{
    for (const std::string_view prefix : {"sweep.", "measurement."})
        if (where.starts_with(prefix))
            where.remove_prefix(prefix.size());
    return where == "lowFrequency"          ? "the lowest frequency"
           : where == "highFrequency"       ? "the highest frequency"
           : where == "duration"            ? "the length of the sweep"
           : where == "repeats"             ? "the number of sweeps"
           : where == "sampleRate"          ? "the sample rate"
           : where.starts_with("levels")    ? "the level"
           : where.starts_with("fullScale") ? "the calibration"
                                            : std::string(where);
}
} // namespace

std::string explain(const Error& error, std::span<const std::string> inputs)
{
    if (error.where == "channels" && error.code == ErrorCode::invalidData)
        return fmt::format("No sweep detected on {}, only noise. Check that the amplifier is on, that actuator and "
                           "sensor are connected to the chosen output and input, and that the level is high enough.",
                           listed(inputs));
    if (error.where == "channels" && error.code == ErrorCode::truncated)
        return "The recording is too short: its channels " + error.message + ".";
    if (error.where.starts_with("sweeps["))
        return "A sweep is cut off: it " + error.message + ".";
    if (const auto input = inputOf(error.where, inputs))
        return error.code == ErrorCode::notFinite
                   ? fmt::format("'{}' sent invalid samples. Restart the audio device and sweep again.", *input)
                   : fmt::format("'{}' {}", *input, sentence(error.message));
    if (error.where == "clock")
        return fmt::format("Two clocks: {}.", error.message);
    if (error.where.empty())
        return sentence(error.message);
    return sentence(settingOf(error.where) + " " + error.message);
}

std::string explain(const MeasurementWarning& warning, std::span<const std::string> inputs)
{
    const auto input = inputOf(warning.where, inputs);
    const std::string name = input ? "'" + *input + "'" : warning.where;
    switch (warning.code)
    {
    case MeasurementDefect::clipping:
        return fmt::format("Clipping on {}: {}.", name, warning.message);
    case MeasurementDefect::silentChannel:
        return fmt::format("{} is silent. Nothing is connected, or the axis is broken.", name);
    case MeasurementDefect::noiseChannel:
        return fmt::format("{} receives noise but no sweep. Check which input the sensor is connected to.", name);
    case MeasurementDefect::loopback:
        return fmt::format("{} carries the drive signal, not a motion. Choose the input the sensor is connected to.",
                           name);
    case MeasurementDefect::droppedFrames:
        return fmt::format("Audio dropped out at {}: {}.", name, warning.message);
    case MeasurementDefect::clockDrift:
        return fmt::format("Two clocks: {}.", warning.message);
    case MeasurementDefect::lowSnr:
        return fmt::format("Weak {}: {}.", name, warning.message);
    }
    return sentence(name + ": " + warning.message);
}

} // namespace pacini
