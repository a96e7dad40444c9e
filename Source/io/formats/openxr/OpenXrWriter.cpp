#include "io/formats/ForeignText.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/openxr/OpenXrFormat.h"
#include "io/formats/samples/DriveSamples.h"

#include <pacini/foundation/NumberText.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t maxSamples = 4000; // in one buffer or envelope
constexpr int usualRate = 2000;          // Hz, that of Quest controllers

struct OpenXrClip
{
    std::string name;
    DriveSamples drive;
    std::vector<double> amplitudes;
    std::int64_t duration = 0; ///< ns, of the amplitudes
};

std::string number(double value)
{
    return shortDecimalText(value, 5);
}

/// A number that C takes for a float.
std::string floatNumber(double value)
{
    const std::string text = number(value);
    return text + (text.find('.') == std::string::npos ? ".0f" : "f");
}

Result<OpenXrClip> openXrOf(const Clip& clip, const ExportParams& params)
{
    auto drive = driveSamples(clip, params, usualRate);
    if (!drive)
        return drive.error();
    OpenXrClip result{nameOfClip(clip, params.name), std::move(drive).value(), {}, 0};
    SingleVoice voice = oneVoice(clip, params.profile);
    const double rate = params.amplitudePoints.value_or(100.0);
    const double wanted = std::ceil(clip.duration * rate);
    const double count = std::clamp(wanted, 1.0, static_cast<double>(maxSamples));
    LossList& losses = result.drive.losses;
    if (wanted > count)
        losses.add(LossKind::points, 0.0, clip.duration, 0.0,
                   fmt::format("amplitude envelope: {} amplitudes instead of {}", count, wanted));
    if (!clip.bands.empty())
        losses.add(LossKind::frequency, 0.0, clip.duration, 0.0, "amplitude envelope: no frequency");
    const double step = std::max(clip.duration, 1e-3) / count;
    for (const Transient& event : voice.events)
        losses.add(LossKind::event, event.time, 0.0, 0.0, "amplitude envelope: events become bursts");
    losses.add(LossKind::timeStep, 0.0, clip.duration, 0.5 * step,
               "amplitude envelope: times are rounded to its steps");
    losses.limit(voice.amplitude, 1.0);
    losses.limit(voice.events, 1.0);
    result.duration = std::llround(1e9 * step * count);
    constexpr double burst = 0.020;
    result.amplitudes = strengthOf(voice, step, burst);
    result.amplitudes.resize(static_cast<std::size_t>(count), 0.0);
    for (double& amplitude : result.amplitudes)
        amplitude = std::min(amplitude, 1.0);
    return result;
}

std::vector<std::span<const float>> buffersOf(const std::vector<float>& samples)
{
    std::vector<std::span<const float>> buffers;
    for (std::size_t at = 0; at < samples.size(); at += maxSamples)
        buffers.push_back(std::span(samples).subspan(at, std::min(maxSamples, samples.size() - at)));
    return buffers;
}
} // namespace

Result<ExportedClip> writeOpenXrHeader(const Clip& clip, const ExportParams& params)
{
    auto made = openXrOf(clip, params);
    if (!made)
        return made.error();
    const std::string name = identifierOf(made->name);
    const std::vector<float> silence{0.0f};
    const std::vector<float>& samples = made->drive.samples.empty() ? silence : made->drive.samples;
    return oneFile(
        fmt::format(
            R"(/* XR_FB_haptic_pcm: submit at most {0} samples at a time with append = XR_TRUE after the first buffer.
   XR_FB_haptic_amplitude_envelope: all amplitudes last {1}_amplitude_duration_ns together. */
#pragma once
#include <stdint.h>

static const float {1}_pcm_sample_rate = {2}.0f;
static const uint32_t {1}_pcm_count = {3};
static const float {1}_pcm[{3}] = {{{4}
}};

static const int64_t {1}_amplitude_duration_ns = INT64_C({5});
static const uint32_t {1}_amplitude_count = {6};
static const float {1}_amplitudes[{6}] = {{{7}
}};
)",
            maxSamples, name, made->drive.sampleRate, samples.size(),
            numbersInLines(samples, 10, [](float x) { return floatNumber(static_cast<double>(x)); }), made->duration,
            made->amplitudes.size(), numbersInLines(made->amplitudes, 10, floatNumber)),
        std::move(made->drive.losses));
}

Result<ExportedClip> writeOpenXrJson(const Clip& clip, const ExportParams& params)
{
    auto made = openXrOf(clip, params);
    if (!made)
        return made.error();
    std::string buffers;
    for (const auto& buffer : buffersOf(made->drive.samples))
        buffers += fmt::format("{}\n    {{\"append\": {}, \"bufferSize\": {}, \"buffer\": [{}]}}",
                               buffers.empty() ? "" : ",", buffers.empty() ? "false" : "true", buffer.size(),
                               numbersInLines(buffer, 10, [](float x) { return number(static_cast<double>(x)); }));
    return oneFile(fmt::format(R"({{
  "name": {},
  "pcmVibration": {{
    "sampleRate": {},
    "buffers": [{}]
  }},
  "amplitudeEnvelopeVibration": {{
    "duration": {},
    "amplitudeCount": {},
    "amplitudes": [{}]
  }}
}}
)",
                               inQuotes(made->name), made->drive.sampleRate, buffers, made->duration,
                               made->amplitudes.size(), numbersInLines(made->amplitudes, 10, number)),
                   std::move(made->drive.losses));
}

} // namespace pacini
