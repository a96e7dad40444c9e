#include "io/formats/samples/DriveSamples.h"

#include <pacini/synthesis/RenderScene.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini
{

Result<std::vector<float>> driveSignal(const Clip& clip, double sampleRate, const std::optional<Profile>& profile,
                                       double strength)
{
    RenderParams params;
    params.compile.sampleRate = sampleRate;
    params.compile.adaptation.strength = strength;
    auto rendered = renderScene(sceneOf(clip), profile ? &*profile : nullptr, params);
    if (!rendered)
        return rendered.error();
    return std::move(rendered->samples);
}

Result<DriveSamples> driveSamples(const Clip& clip, const ExportParams& params, int usualRate)
{
    DriveSamples drive;
    drive.sampleRate = params.sampleRate.value_or(usualRate);
    if (drive.sampleRate < 2000 || drive.sampleRate > 48000)
        return Error{ErrorCode::invalidArgument, "sampleRate", "must be 2000 to 48000 Hz"};
    auto samples = driveSignal(clip, drive.sampleRate, params.profile, params.strength);
    if (!samples)
        return samples.error();
    drive.samples = std::move(samples).value();
    LossTrack cut(LossKind::amplitude, "samples beyond full scale are clipped");
    double loudest = 0.0;
    for (std::size_t n = 0; n < drive.samples.size(); ++n)
    {
        const double beyond = std::abs(static_cast<double>(drive.samples[n])) - 1.0;
        cut.add(static_cast<double>(n) / drive.sampleRate, beyond);
        drive.samples[n] = std::clamp(drive.samples[n], -1.0f, 1.0f);
        loudest = std::max(loudest, 1.0 + beyond);
    }
    drive.losses.append(cut);
    drive.losses.addText(clip, false);
    const double highest = 0.45 * drive.sampleRate;
    for (const Band& band : clip.bands)
        if (band.centreFrequency > highest)
            drive.losses.add(LossKind::frequency, 0.0, clip.duration, std::log2(band.centreFrequency / highest),
                             "frequencies are limited to 0.45 of the sample rate");
    if (!(loudest > 0.0))
        drive.losses.add(LossKind::empty, 0.0, clip.duration, 0.0, "nothing sounds");
    return drive;
}

} // namespace pacini
