#include "io/formats/hjif/BakedClip.h"

#include <pacini/synthesis/CarrierBank.h>
#include <pacini/synthesis/DecoderChoice.h>
#include <pacini/synthesis/EnvelopeLeveller.h>
#include <pacini/synthesis/PulseLevel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace pacini
{

namespace
{
constexpr double gainStep = 0.001; // s

/// Bands as they are played by the decoder's carrier mode: their pitch is what sounds.
void resolvePitch(Clip& clip, CarrierMode carriers)
{
    const double reference = referenceFrequency(clip);
    for (Band& band : clip.bands)
    {
        if (carriers == CarrierMode::fixed)
            band.pitch.clear();
        if (carriers == CarrierMode::centroid)
        {
            band.pitch = clip.centroid;
            for (Breakpoint& point : band.pitch)
                point.value = std::max(1.0, point.value * band.centreFrequency / reference);
        }
    }
}

void roundPitch(Clip& clip, double pitchStep, double timeStep)
{
    const auto rounded = [](double value, double step)
    {
        return step > 0.0 ? step * std::round(value / step) : value;
    };
    for (Band& band : clip.bands)
    {
        if (band.pitch.empty())
            band.pitch = {{0.0, std::max(band.centreFrequency, 1.0)}};
        for (Breakpoint& point : band.pitch)
            point = {std::min(rounded(point.time, timeStep), clip.duration),
                     std::max(rounded(point.value, pitchStep), std::max(pitchStep, 1e-3))};
    }
}

/// The gain by which the decoder levels the sum of the bands to the envelope, every gainStep.
std::vector<double> levellingGain(const Clip& clip)
{
    constexpr std::size_t hop = 64;
    const double highest = highestFrequency(clip, CarrierMode::pitch);
    const auto framesPerStep = static_cast<std::size_t>(std::ceil(std::max(4000.0, 3.3 * highest) * gainStep));
    const double fs = static_cast<double>(framesPerStep) / gainStep;
    std::vector<Carrier> carriers;
    for (const Band& band : clip.bands)
    {
        Carrier carrier;
        carrier.phase = band.phase;
        for (const Breakpoint& point : band.amplitude)
            carrier.amplitude.push_back({point.time * fs, point.value});
        for (const Breakpoint& point : band.pitch)
            carrier.frequency.push_back({point.time * fs, std::clamp(point.value / fs, 0.0, 0.45)});
        if (carrier.frequency.empty())
            carrier.frequency.push_back({0.0, std::clamp(band.centreFrequency / fs, 0.0, 0.45)});
        carriers.push_back(std::move(carrier));
    }
    CarrierBank bank(std::move(carriers));
    EnvelopeLeveller leveller(fs, hop);
    Curve envelope = clip.envelope;
    for (Breakpoint& point : envelope)
        point.time *= fs;
    std::array<CurveReader, 2> readers{CurveReader(envelope), CurveReader(envelope)};

    const auto steps = static_cast<std::size_t>(std::ceil(clip.duration / gainStep)) + 1;
    const std::size_t latency = leveller.latencyFrames();
    std::vector<double> before(steps), gains(steps, 1.0);
    std::vector<double> re(hop), im(hop), wanted(hop);
    double last = 1.0;
    for (std::uint64_t frame = 0; frame < std::uint64_t{steps} * framesPerStep + latency; frame += hop)
    {
        std::fill(re.begin(), re.end(), 0.0);
        std::fill(im.begin(), im.end(), 0.0);
        bank.process(re, im);
        for (std::size_t n = 0; n < hop; ++n)
            if ((frame + n) % framesPerStep == 0 && (frame + n) / framesPerStep < steps)
                before[static_cast<std::size_t>((frame + n) / framesPerStep)] = std::hypot(re[n], im[n]);
        leveller.process(std::array{LevelledPart{re, im}},
                         [&](std::size_t pass) -> std::span<const double>
                         {
                             const double first =
                                 static_cast<double>(frame) - static_cast<double>(leveller.delayOfPass(pass));
                             for (std::size_t n = 0; n < hop; ++n)
                                 wanted[n] = readers[pass].at(first + static_cast<double>(n));
                             return wanted;
                         });
        for (std::size_t n = 0; n < hop; ++n)
        {
            const std::uint64_t at = frame + n;
            if (at < latency || (at - latency) % framesPerStep != 0 || (at - latency) / framesPerStep >= steps)
                continue;
            const auto step = static_cast<std::size_t>((at - latency) / framesPerStep);
            // Where the sum vanishes for a moment the gain goes on as it was.
            if (before[step] > 1e-7)
                last = std::hypot(re[n], im[n]) / before[step];
            gains[step] = last;
        }
    }
    return gains;
}

Curve scaledBy(const Curve& curve, const std::vector<double>& gains, double duration)
{
    Curve scaled;
    CurveReader reader(curve);
    for (std::size_t n = 0; n < gains.size(); ++n)
    {
        const double time = std::min(gainStep * static_cast<double>(n), duration);
        scaled.push_back({time, std::min(reader.at(time) * gains[n], limits::amplitude)});
    }
    return scaled;
}
} // namespace

Clip bakedClip(const Clip& clip, double pitchStep, double timeStep)
{
    const DecoderParams params = decoderParamsFor(clip, {}, {}, 67.0);
    Clip played = clip;
    resolvePitch(played, params.carriers);
    roundPitch(played, pitchStep, timeStep);
    const bool levelled = params.followEnvelope && !clip.envelope.empty();
    if (levelled)
    {
        const std::vector<double> gains = levellingGain(played);
        for (Band& band : played.bands)
            if (!band.amplitude.empty())
                band.amplitude = scaledBy(band.amplitude, gains, clip.duration);
        for (Transient& event : played.transients)
            event.amplitude = pulseLevel(clip.envelope, event);
    }
    played.envelope.clear();
    played.centroid.clear();
    return played;
}

} // namespace pacini
