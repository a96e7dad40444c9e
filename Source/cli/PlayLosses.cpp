#include "cli/PlayLosses.h"

#include "devices/ClipEvents.h"
#include "devices/DriveMeasure.h"
#include "devices/PacketStates.h"
#include "devices/WaveformDevice.h"
#include "io/formats/LossList.h"

#include <pacini/clip/edits/TimeEdits.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using devices::ControllerHaptics;
using devices::RumbleTone;

constexpr double driveRate = 48000.0; // Hz
constexpr double samePitch = 0.3;     // octaves: what is nearer is hardly told apart

bool sounds(const Curve& curve)
{
    return std::any_of(curve.begin(), curve.end(),
                       [](const Breakpoint& point) { return point.value > leastAmplitude; });
}

double levelOf(std::span<const RumbleTone> tones)
{
    double square = 0.0;
    for (const RumbleTone& tone : tones)
        square += tone.amplitude * tone.amplitude;
    return std::sqrt(square);
}

double octavesOutside(double frequency, double lowest, double highest)
{
    return std::max({std::log2(lowest / frequency), std::log2(frequency / highest), 0.0});
}

/// Writes down the losses of one clip.
class PlayLosses
{
public:
    PlayLosses(const Clip& clip, const devices::PlayRange& range, Decibels drive, const devices::ControllerModel& model,
               const Profile* profile)
        : whole(clip),
          part(trimClip(clip, {range.from.value, range.to.value})),
          played(range),
          gain(drive),
          device(model),
          actuator(profile),
          interval(devices::pacingOf(model).interval.value)
    {
    }

    [[nodiscard]] std::vector<FormatLoss> all() &&
    {
        if (const auto stream = devices::sampleStream(device))
            addSamples(*stream);
        else
        {
            addSources();
            addEvents();
            addPackets();
        }
        auto losses = std::move(list).sorted();
        for (FormatLoss& loss : losses)
            loss.time += played.from.value;
        return losses;
    }

private:
    [[nodiscard]] bool isHd() const { return device.haptics == ControllerHaptics::hdRumble; }
    [[nodiscard]] bool isWaveforms() const { return device.haptics == ControllerHaptics::waveforms; }
    [[nodiscard]] bool lasts() const { return !isWaveforms() || device.trigger.lasts(); }

    /// Samples lose what is above their rate and beyond full drive.
    void addSamples(const devices::SampleStream& stream)
    {
        const double highest = 0.4 * stream.rate; // Hz, that of DriveRumble's filter
        for (const Band& band : part.bands)
            addHighest(band.amplitude, band.pitch, band.centreFrequency, highest);
        for (const NoiseBand& band : part.noise)
            addHighest(band.amplitude, {}, band.highFrequency, highest);
        LossTrack loud(LossKind::amplitude, "samples beyond full drive are clipped");
        constexpr Decibels headroom{40.0}; // the drive itself is clipped already
        forEachPacket([&](double time, const devices::PacketContent&, float peak)
                      { loud.add(time, static_cast<double>(peak) * headroom.gain() - 1.0); },
                      headroom);
        list.append(loud);
    }

    void addHighest(const Curve& amplitude, const Curve& pitch, double frequency, double highest)
    {
        if (!sounds(amplitude))
            return;
        double top = pitch.empty() ? frequency : 0.0;
        for (const Breakpoint& point : pitch)
            top = std::max(top, point.value);
        if (top > highest)
            list.add(LossKind::frequency, 0.0, part.duration, std::log2(top / highest),
                     fmt::format("what is above {:.0f} Hz is left out", highest));
    }

    /// Bands and noise as a whole.
    void addSources()
    {
        const std::size_t most = isHd() || !isWaveforms() ? 2 : 1;
        const auto count = static_cast<std::size_t>(std::count_if(
            part.bands.begin(), part.bands.end(), [](const Band& band) { return sounds(band.amplitude); }));
        if (count > 0 && !lasts())
            list.add(LossKind::bands, 0.0, part.duration, 0.0,
                     "bands are left out: the device has no continuous waveform");
        else if (count > most)
            list.add(LossKind::bands, 0.0, part.duration, 0.0,
                     fmt::format("{} bands become {}", count,
                                 isHd()          ? "two tones, below and above 226 Hz"
                                 : isWaveforms() ? "one level"
                                                 : "the levels of two motors, below and above 226 Hz"));
        list.addNoise(part, !lasts() ? "residual noise is left out: the device has no continuous waveform"
                            : isHd() ? "residual noise becomes a tone"
                                     : "residual noise becomes a level");
    }

    void addEvents()
    {
        LossTrack steps(LossKind::timeStep, fmt::format("events begin with a packet, every {:.0f} ms", 1e3 * interval));
        LossTrack crowded(LossKind::crowding, crowdingMessage());
        LossTrack sharpness(LossKind::event, isWaveforms()
                                                 ? "an event is a click of the device, whatever its sharpness"
                                                 : "an event is a push of 30 ms, sharpness chooses the motor");
        double last = -HUGE_VAL;
        for (const Transient& event : part.transients)
        {
            const double level = event.amplitude * gain.gain();
            if (!(level > leastAmplitude))
                continue;
            for (LossTrack* track : {&steps, &sharpness})
                track->add(event.time, 0.0); // each stands for itself
            steps.add(event.time, std::abs(event.time - interval * std::round(event.time / interval)));
            if (!isHd())
                sharpness.add(event.time, std::min(level, 1.0));
            crowded.add(event.time, event.time - last < apart() - 1e-9 ? std::min(level, 1.0) : 0.0);
            last = event.time;
        }
        for (LossTrack* track : {&steps, &crowded})
            list.append(*track);
        if (!isWaveforms() || device.trigger.event != 0)
            list.append(sharpness);
    }

    /// Events that are nearer to each other become one, s.
    [[nodiscard]] double apart() const
    {
        if (isHd())
            return interval;
        if (isWaveforms() && device.trigger.event != 0)
            return interval * std::max(std::ceil(device.trigger.eventTime.value / interval - 1e-6), 1.0);
        return devices::PacketStates::motorPulse.value;
    }

    [[nodiscard]] std::string crowdingMessage() const
    {
        return fmt::format("events less than {:.0f} ms apart become one", 1e3 * apart());
    }

    /// What the packets say of the drive.
    void addPackets()
    {
        const devices::RumbleTones home;
        LossTrack pitch(LossKind::frequency,
                        isWaveforms() ? "pitch is lost: a waveform has its own"
                                      : "pitch is lost: the heavy motor has about 160 Hz, the light one 320 Hz");
        LossTrack outside(LossKind::frequency, "frequencies outside 41 to 1253 Hz are moved to these");
        LossTrack loud(LossKind::amplitude, "levels beyond full drive are cut");
        LossTrack faint(LossKind::empty, "too weak for the device");
        constexpr double shortestPitch = 0.05; // s, in which none is felt yet
        constexpr double shortestGap = 0.25;   // s, as for files
        devices::PacketStates states(device);
        const devices::Report silence = devices::reportOf(device, devices::silentState(device), 0);
        double loudest = 0.0;
        std::int64_t packet = 0;
        forEachPacket(
            [&](double time, const devices::PacketContent& content, float)
            {
                double octaves = 0.0, beyond = 0.0;
                for (const RumbleTone& tone : content.tones)
                {
                    if (!(tone.amplitude > leastAmplitude))
                        continue;
                    const double own =
                        (tone.frequency >= devices::carrierBorder ? home.high : home.low).frequency.value;
                    octaves = std::max(octaves, std::abs(std::log2(tone.frequency.value / own)));
                    beyond = std::max(beyond, octavesOutside(tone.frequency.value, 40.88, 1252.57));
                }
                const double level = levelOf(content.tones);
                loudest = std::max(loudest, level);
                if (isHd())
                    outside.add(time, beyond);
                else if (lasts())
                    pitch.add(time, octaves > samePitch ? octaves : 0.0);
                loud.add(time, loudness(content) - 1.0);
                const auto state = states.of(packet++, content);
                if (lasts())
                    faint.add(time,
                              devices::reportOf(device, state, 0) == silence && level > leastAmplitude ? level : 0.0);
            });
        for (LossTrack* track : {&outside, &loud})
            list.append(*track);
        appendLasting(pitch, shortestPitch);
        appendLasting(faint, shortestGap);
        if (!(loudest > leastAmplitude))
            list.add(LossKind::empty, 0.0, part.duration, 0.0, "silent");
    }

    void appendLasting(LossTrack& track, double shortest)
    {
        std::vector<FormatLoss> parts;
        track.appendTo(parts);
        for (const FormatLoss& loss : parts)
            if (loss.duration >= shortest)
                list.add(loss.kind, loss.time, loss.duration, loss.error, loss.message);
    }

    /// Of what is limited to 1.
    [[nodiscard]] double loudness(const devices::PacketContent& content) const
    {
        double low = 0.0, high = 0.0;
        for (const RumbleTone& tone : content.tones)
            (tone.frequency >= devices::carrierBorder ? high : low) += tone.amplitude * tone.amplitude;
        if (isHd()) // both carriers of an actuator share its drive
            return std::sqrt(low) + std::sqrt(high);
        return isWaveforms() ? std::sqrt(low + high) : std::sqrt(std::max(low, high));
    }

    /// Time, content and largest magnitude of each packet.
    template <typename Each>
    void forEachPacket(const Each& each, Decibels quieter = Decibels(0.0))
    {
        auto render = devices::clipDrive(whole, {played.from, played.to, false}, Decibels(gain.value - quieter.value),
                                         driveRate, actuator);
        devices::DriveMeasure measure(driveRate);
        devices::ClipEvents events(whole, {played.from, played.to, false}, Seconds(interval));
        std::array<float, devices::DriveMeasure::blockFrames> block{};
        std::int64_t done = 0;
        for (std::int64_t packet = 0; static_cast<double>(packet) * interval < part.duration; ++packet)
        {
            const auto end = static_cast<std::int64_t>(static_cast<double>(packet + 1) * interval * driveRate);
            float peak = 0.0f;
            while (done < end)
            {
                const auto n = std::min(block.size(), static_cast<std::size_t>(end - done));
                const std::array<std::span<float>, 1> out{std::span(block).first(n)};
                render(out);
                for (const float sample : out[0])
                    peak = std::max(peak, std::abs(sample));
                measure.add(out[0]);
                done += static_cast<std::int64_t>(n);
            }
            each(static_cast<double>(packet) * interval, measure.take(events.at(packet)), peak);
        }
    }

    const Clip& whole;
    Clip part;
    devices::PlayRange played;
    Decibels gain;
    devices::ControllerModel device;
    const Profile* actuator;
    double interval; ///< s
    LossList list;
};
} // namespace

std::vector<FormatLoss> playLosses(const Clip& clip, const devices::PlayRange& range, Decibels gain,
                                   const devices::ControllerModel& model, const Profile* profile)
{
    return PlayLosses(clip, range, gain, model, profile).all();
}

} // namespace pacini::cli
