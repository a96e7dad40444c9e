#pragma once

// A clip ready for playback: stored packed and unpacked when it plays, or stored unpacked.

#include <pacini/clip/Clip.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/Roles.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// A clip in memory, shared by all that plays of it: a thousand of them cost little more than their packed bytes.
class LoadedClip
{
public:
    /// Keeps bytes that packClip() made. Errors: those of unpackClip().
    [[nodiscard]] static Result<std::shared_ptr<const LoadedClip>> ofPacked(std::span<const std::byte> bytes)
    {
        auto clip = unpackClip(bytes);
        if (!clip)
            return clip.error();
        return std::shared_ptr<const LoadedClip>(new LoadedClip(*clip, {bytes.begin(), bytes.end()}));
    }

    /// Packs a clip. Errors: those of validate().
    [[nodiscard]] static Result<std::shared_ptr<const LoadedClip>> ofClip(const Clip& clip)
    {
        if (auto valid = validate(clip); !valid)
            return valid.error();
        std::vector<std::byte> bytes = packClip(clip, packParamsFor(clip));
        bytes.shrink_to_fit();
        return std::shared_ptr<const LoadedClip>(new LoadedClip(clip, std::move(bytes)));
    }

    /// Keeps a clip as it is, without the rounding of packing: for one that is edited. Errors: those of validate().
    [[nodiscard]] static Result<std::shared_ptr<const LoadedClip>> asItIs(Clip clip)
    {
        if (auto valid = validate(clip); !valid)
            return valid.error();
        std::shared_ptr<LoadedClip> made(new LoadedClip(clip, {}));
        made->whole = std::move(clip);
        return std::shared_ptr<const LoadedClip>(std::move(made));
    }

    [[nodiscard]] Result<Clip> unpack() const { return whole ? Result<Clip>(*whole) : unpackClip(packed); }

    [[nodiscard]] const std::string& name() const noexcept { return title; }
    [[nodiscard]] double duration() const noexcept { return length; } ///< s
    [[nodiscard]] std::size_t events() const noexcept { return transients; }
    [[nodiscard]] std::size_t bytes() const noexcept { return packed.size(); } ///< packed; 0 as it is

    /// In order of time, as the clip had them before it was packed.
    [[nodiscard]] const std::vector<Marker>& markers() const noexcept { return points; }

    /// Mean of the drive's square, 1 = full drive, shared by tones and noise; events are not counted.
    [[nodiscard]] const PerRole<double>& power() const noexcept { return meanPower; }

private:
    LoadedClip(const Clip& clip, std::vector<std::byte> bytes)
        : title(clip.name),
          length(clip.duration),
          transients(clip.transients.size()),
          points(clip.markers),
          meanPower(powerOf(clip)),
          packed(std::move(bytes))
    {
    }

    /// Of a curve of amplitudes of sines, over its time.
    static double powerOf(const Curve& curve, double duration)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < curve.size(); ++i)
        {
            const double a = curve[i].value, b = curve[i + 1].value;
            sum += (curve[i + 1].time - curve[i].time) * (a * a + a * b + b * b) / 6.0;
        }
        if (!curve.empty())
            sum += std::max(0.0, duration - curve.back().time) * 0.5 * curve.back().value * curve.back().value;
        return duration > 0.0 ? sum / duration : 0.0;
    }

    static PerRole<double> powerOf(const Clip& clip)
    {
        PerRole<double> power;
        double noise = 0.0, sum = 0.0;
        for (const Band& band : clip.bands)
            sum += powerOf(band.amplitude, clip.duration);
        for (const NoiseBand& band : clip.noise)
            noise += powerOf(band.amplitude, clip.duration);
        sum += noise;
        const double whole = clip.envelope.empty() ? sum : powerOf(clip.envelope, clip.duration);
        power[Role::noise] = sum > 0.0 ? whole * (noise / sum) : 0.0;
        power[Role::tones] = whole - power[Role::noise];
        return power;
    }

    std::string title;
    double length;
    std::size_t transients;
    std::vector<Marker> points;
    PerRole<double> meanPower;
    std::vector<std::byte> packed;
    std::optional<Clip> whole; ///< in the place of the packed one
};

} // namespace pacini
