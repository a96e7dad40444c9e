#include "study/Latency.h"

#include <pacini/evaluate/EventMatching.h>
#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace pacini::study
{

namespace
{
constexpr double period = 1.0; // s between bursts: a delay of up to half of it can be told
constexpr double periodsOfBurst = 5.0;
constexpr double slowRate = 3000.0;  // Hz, of envelopes: far above what a burst's changes with
constexpr double aboveNoise = 5.0;   // of a burst, times the median of the envelope, which is that of the noise
constexpr double belowOthers = 0.25; // of the loudest bursts' median: what is weaker is no burst
constexpr double quietest = 1e-5;    // full scale 1

double raisedCosine(double at) // 0 to 1
{
    return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * at);
}
} // namespace

Result<void> validate(const LatencyProbe& probe)
{
    const auto outside = [](const char* name, const char* range)
    {
        return Error{ErrorCode::invalidArgument, name, range};
    };
    if (probe.sampleRate < 8000 || probe.sampleRate > 768000)
        return outside("sampleRate", "must be 8000 to 768000 Hz");
    if (!(probe.duration >= 3.0 && probe.duration <= 36000.0))
        return outside("duration", "must be 3 to 36000 s");
    if (!(probe.frequency >= 40.0 && probe.frequency <= 1000.0))
        return outside("frequency", "must be 40 to 1000 Hz");
    if (!(probe.level >= -80.0 && probe.level <= 0.0))
        return outside("level", "must be -80 to 0 dB");
    return {};
}

std::vector<float> latencyBurst(const LatencyProbe& probe)
{
    const double fs = probe.sampleRate;
    std::vector<float> signal(static_cast<std::size_t>(std::llround(period * fs)), 0.0f);
    const double gain = Decibels(probe.level).gain();
    const auto length = static_cast<std::size_t>(std::llround(periodsOfBurst / probe.frequency * fs));
    const std::size_t begin = (signal.size() - length) / 2;
    for (std::size_t n = 0; n < length; ++n)
    {
        const auto at = static_cast<double>(n);
        signal[begin + n] = static_cast<float>(gain * raisedCosine(at / static_cast<double>(length)) *
                                               std::sin(2.0 * std::numbers::pi * probe.frequency * at / fs));
    }
    return signal;
}

LatencyMeter::LatencyMeter(const LatencyProbe& probe)
    : fs(probe.sampleRate),
      decimation(static_cast<std::size_t>(std::max(1.0, std::floor(fs / slowRate)))),
      turn(std::polar(1.0, -2.0 * std::numbers::pi * probe.frequency / fs))
{
    const double slow = fs / static_cast<double>(decimation);
    window.resize(static_cast<std::size_t>(std::ceil(periodsOfBurst / probe.frequency * slow)));
    double sum = 0.0;
    for (std::size_t i = 0; i < window.size(); ++i)
        sum += window[i] = raisedCosine((static_cast<double>(i) + 0.5) / static_cast<double>(window.size()));
    for (double& weight : window)
        weight /= sum;
    heard.last.resize(window.size());
    felt.last.resize(window.size());
}

void LatencyMeter::push(std::span<const float> sound, std::span<const float> touch)
{
    for (std::size_t n = 0; n < sound.size(); ++n)
    {
        heard.sum += static_cast<double>(sound[n]) * phase;
        felt.sum += static_cast<double>(touch[n]) * phase;
        phase *= turn;
        if (++filled < decimation)
            continue;
        filled = 0;
        phase /= std::abs(phase);
        step(heard);
        step(felt);
    }
}

void LatencyMeter::step(Channel& channel) const
{
    channel.last[channel.next] = channel.sum / static_cast<double>(decimation);
    channel.next = (channel.next + 1) % channel.last.size();
    channel.sum = 0.0;
    std::complex<double> matched = 0.0;
    for (std::size_t i = 0; i < window.size(); ++i)
        matched += window[i] * channel.last[(channel.next + i) % channel.last.size()];
    // A sinusoid's two halves, and the mean of the burst's own square under the window: 2 / .75.
    channel.envelope.push_back(static_cast<float>(std::abs(matched) * 2.0 / 0.75));
}

std::vector<LatencyMeter::Burst> LatencyMeter::burstsOf(const Channel& channel) const
{
    const double slow = fs / static_cast<double>(decimation);
    const std::vector<float>& envelope = channel.envelope;
    if (envelope.size() < 3)
        return {};
    const double noise = median(std::vector<double>(envelope.begin(), envelope.end())).value_or(0.0);
    const double threshold = std::max(quietest, aboveNoise * noise);
    std::vector<Burst> bursts;
    // The loudest in each stretch, where it is louder than all that is less than .4 periods from it.
    const auto reach = static_cast<std::size_t>(0.4 * period * slow);
    for (std::size_t begin = 0; begin < envelope.size(); begin += reach)
    {
        const auto from = envelope.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto to = envelope.begin() + static_cast<std::ptrdiff_t>(std::min(begin + reach, envelope.size()));
        const auto peak = static_cast<std::size_t>(std::max_element(from, to) - envelope.begin());
        if (peak == 0 || peak + 1 == envelope.size() || !(static_cast<double>(envelope[peak]) > threshold))
            continue;
        const std::size_t left = peak > reach ? peak - reach : 0, right = std::min(peak + reach, envelope.size());
        const auto loudest = std::max_element(envelope.begin() + static_cast<std::ptrdiff_t>(left),
                                              envelope.begin() + static_cast<std::ptrdiff_t>(right));
        if (static_cast<std::size_t>(loudest - envelope.begin()) != peak)
            continue;
        const auto level = [&](std::size_t i)
        {
            return static_cast<double>(envelope[i]);
        };
        const double before = level(peak - 1), here = level(peak), after = level(peak + 1);
        const double bend = before - 2.0 * here + after;
        const double offset = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
        bursts.push_back({(static_cast<double>(peak) + offset) / slow, here});
    }
    if (bursts.empty())
        return {};
    std::vector<double> levels;
    for (const Burst& burst : bursts)
        levels.push_back(burst.level);
    const double usual = median(levels).value_or(0.0);
    std::erase_if(bursts, [&](const Burst& burst) { return burst.level < belowOthers * usual; });
    return bursts;
}

Result<Latency> LatencyMeter::latency() const
{
    const auto sounds = burstsOf(heard), touches = burstsOf(felt);
    constexpr std::size_t fewest = 3;
    for (const auto& [name, bursts] : {std::pair("sound", &sounds), std::pair("touch", &touches)})
        if (bursts->size() < fewest)
            return Error{ErrorCode::invalidData, name,
                         fmt::format("{} in this channel; is its cable or sensor connected, and loud enough?",
                                     bursts->empty() ? "there is no burst"
                                                     : fmt::format("there are only {} bursts", bursts->size()))};
    std::vector<double> times, delays, soundLevels, touchLevels;
    std::size_t next = 0;
    for (const Burst& sound : sounds)
    {
        while (next + 1 < touches.size() &&
               std::abs(touches[next + 1].time - sound.time) < std::abs(touches[next].time - sound.time))
            ++next;
        const double delay = touches[next].time - sound.time;
        if (std::abs(delay) >= 0.5 * period)
            continue;
        times.push_back(sound.time);
        delays.push_back(delay);
        soundLevels.push_back(sound.level);
        touchLevels.push_back(touches[next].level);
    }
    Latency latency;
    latency.bursts = static_cast<int>(delays.size());
    latency.missed = static_cast<int>(sounds.size() + touches.size() - 2 * delays.size());
    if (delays.size() < fewest || latency.missed > latency.bursts)
        return Error{ErrorCode::invalidData, "touch",
                     fmt::format("{} bursts have a partner in the other channel and {} have none; are the two of one "
                                 "recording?",
                                 latency.bursts, latency.missed)};
    const auto count = static_cast<double>(delays.size());
    latency.delay = median(delays).value_or(0.0);
    latency.soundLevel = Decibels::fromGain(median(soundLevels).value_or(0.0)).value;
    latency.touchLevel = Decibels::fromGain(median(touchLevels).value_or(0.0)).value;
    double meanTime = 0.0, meanDelay = 0.0;
    for (std::size_t i = 0; i < delays.size(); ++i)
    {
        meanTime += times[i] / count;
        meanDelay += delays[i] / count;
        latency.largest = std::max(latency.largest, std::abs(delays[i] - latency.delay));
    }
    double square = 0.0, product = 0.0, spread = 0.0;
    for (std::size_t i = 0; i < delays.size(); ++i)
    {
        square += (times[i] - meanTime) * (times[i] - meanTime);
        product += (times[i] - meanTime) * (delays[i] - meanDelay);
        spread += (delays[i] - meanDelay) * (delays[i] - meanDelay);
    }
    constexpr double hour = 3600.0;
    latency.drift = square > 0.0 ? product / square * hour : 0.0;
    latency.deviation = std::sqrt(spread / (count - 1.0));
    return latency;
}

} // namespace pacini::study
