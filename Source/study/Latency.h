#pragma once

// Measurement of the delay between sound and touch: bursts played at the same sample, and their arrival.

#include <pacini/foundation/Result.h>

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::study
{

struct LatencyProbe
{
    int sampleRate = 48000;   ///< Hz, 8000 to 768000
    double duration = 10.0;   ///< s, 3 to 36000; a burst each second
    double frequency = 160.0; ///< Hz, 40 to 1000: one that the actuator plays and the sensor hears
    double level = -12.0;     ///< dB re full scale, at most 0
};

/// Errors: invalidArgument with the name of the value outside its range.
[[nodiscard]] Result<void> validate(const LatencyProbe& probe);

/// Returns a second of the signal that both outputs repeat: a burst of five periods with a raised-cosine envelope in
/// its middle. Precondition: valid.
[[nodiscard]] std::vector<float> latencyBurst(const LatencyProbe& probe);

/// Delay of the touch against the sound. A burst arrives when most of its energy has arrived, so the slow start of an
/// actuator is included, as for its wearer.
struct Latency
{
    double delay = 0.0;                        ///< s, median; negative: the touch comes first
    double deviation = 0.0;                    ///< s, standard deviation of the single ones
    double largest = 0.0;                      ///< s, of a single one from the median
    double drift = 0.0;                        ///< s in an hour: two clocks that run apart
    int bursts = 0;                            ///< received on both inputs
    int missed = 0;                            ///< received on one input only
    double soundLevel = 0.0, touchLevel = 0.0; ///< dB re full scale, of the bursts (median)
};

/// Detects the bursts in two recorded channels of any length, in constant memory except for 24 kB per second.
class LatencyMeter
{
public:
    /// Precondition: valid.
    explicit LatencyMeter(const LatencyProbe& probe);

    /// Both of the same length.
    void push(std::span<const float> sound, std::span<const float> touch);

    /// Errors: invalidData at `sound` or `touch` where fewer than three bursts came, or most of one have no partner.
    [[nodiscard]] Result<Latency> latency() const;

private:
    /// One channel: brought down to 0 Hz, fewer samples, matched to the burst.
    struct Channel
    {
        std::complex<double> sum;
        std::vector<std::complex<double>> last; ///< as long as a burst, the newest at `next`
        std::size_t next = 0;
        std::vector<float> envelope; ///< level of bursts, full scale 1
    };
    struct Burst
    {
        double time = 0.0; ///< s
        double level = 0.0;
    };
    void step(Channel& channel) const;
    [[nodiscard]] std::vector<Burst> burstsOf(const Channel& channel) const;

    double fs;
    std::size_t decimation;
    std::complex<double> turn, phase = 1.0;
    std::vector<double> window; ///< of a burst, sums to 1
    std::size_t filled = 0;     ///< samples since the last of the slow rate
    Channel heard, felt;
};

} // namespace pacini::study
