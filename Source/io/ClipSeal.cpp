#include "io/ClipSeal.h"

#include "io/Fingerprint.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace pacini
{

namespace
{
bool isSeal(const EncoderParameter& parameter)
{
    return parameter.name == clipSealName;
}

/// Takes in the parts of a clip one after another, each with its length where it has one.
class ClipFingerprint
{
public:
    void add(double value)
    {
        value += 0.0; // no two zeros
        all.add(std::as_bytes(std::span(&value, 1)));
    }
    void add(const std::string& text)
    {
        add(static_cast<double>(text.size()));
        all.add(std::string_view(text));
    }
    void add(const Curve& curve)
    {
        add(static_cast<double>(curve.size()));
        for (const Breakpoint& point : curve)
        {
            add(point.time);
            add(point.value);
        }
    }
    void add(const EncoderParameter& parameter)
    {
        add(parameter.name);
        std::visit([this](const auto& value) { add(value); }, parameter.value);
    }
    void add(bool value) { add(value ? 1.0 : 0.0); }

    [[nodiscard]] std::uint64_t value() const { return all.value(); }

private:
    Fingerprint all;
};

/// Of everything but the seal; a number, whose digits pack better than letters.
double checksum(const Clip& clip)
{
    ClipFingerprint all;
    all.add(clip.name);
    all.add(clip.duration);
    all.add(clip.source.file);
    all.add(clip.source.sampleRate);
    all.add(static_cast<double>(clip.source.channels));
    for (const EncoderParameter& parameter : clip.encoder)
        if (!isSeal(parameter))
            all.add(parameter);
    all.add(clip.envelope);
    all.add(clip.centroid);
    all.add(static_cast<double>(clip.bands.size()));
    for (const Band& band : clip.bands)
    {
        for (const double frequency : {band.lowFrequency, band.centreFrequency, band.highFrequency})
            all.add(frequency);
        all.add(static_cast<double>(band.priority));
        all.add(band.amplitude);
        all.add(band.pitch);
    }
    all.add(static_cast<double>(clip.transients.size()));
    for (const Transient& transient : clip.transients)
        for (const double value : {transient.time, transient.amplitude, transient.sharpness})
            all.add(value);
    all.add(static_cast<double>(clip.noise.size()));
    for (const NoiseBand& band : clip.noise)
    {
        all.add(band.lowFrequency);
        all.add(band.highFrequency);
        all.add(band.amplitude);
    }
    for (const Marker& marker : clip.markers)
    {
        all.add(marker.time);
        all.add(marker.name);
    }
    return static_cast<double>(static_cast<std::uint32_t>(all.value() ^ (all.value() >> 32)));
}
} // namespace

void sealClip(Clip& clip)
{
    const double sum = checksum(clip);
    std::erase_if(clip.encoder, isSeal);
    clip.encoder.push_back({clipSealName, sum});
}

ClipSeal sealOf(const Clip& clip)
{
    const auto seal = std::find_if(clip.encoder.begin(), clip.encoder.end(), isSeal);
    if (seal == clip.encoder.end())
        return ClipSeal::missing;
    const auto* sum = std::get_if<double>(&seal->value);
    return sum != nullptr && *sum == checksum(clip) ? ClipSeal::whole : ClipSeal::broken;
}

} // namespace pacini
