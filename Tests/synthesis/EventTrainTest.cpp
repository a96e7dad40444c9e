#include "support/Catch.h"

#include <pacini/analysis/Encoder.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/synthesis/Decoder.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace pacini;

namespace
{
constexpr double trainRate = 44100.0;

/// Two seconds of clicks: decaying sines of `f` Hz.
std::vector<float> clicks(double rate, double f, double decay)
{
    std::vector<float> x(static_cast<std::size_t>(2.2 * trainRate), 0.0f);
    for (int k = 0; k < 2.0 * rate; ++k)
    {
        const auto at = static_cast<std::size_t>((0.05 + k / rate) * trainRate);
        for (std::size_t n = 0; n < 500; ++n)
        {
            const double t = static_cast<double>(n) / trainRate;
            x[at + n] += static_cast<float>(0.7 * std::exp(-t / decay) * std::sin(2.0 * std::numbers::pi * f * t));
        }
    }
    return x;
}

/// Mean over the periods of a train of (greatest - least) / (greatest + least) of the signal's short-time amplitude
/// (root mean square under a Hann window of 5 ms).
double modulationDepth(std::span<const float> x, double sampleRate, double rate)
{
    const auto width = static_cast<std::size_t>(0.005 * sampleRate);
    std::vector<double> window(width);
    for (std::size_t n = 0; n < width; ++n)
        window[n] =
            0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(width));
    const auto levelAt = [&](std::size_t centre)
    {
        double sum = 0.0, weight = 0.0;
        for (std::size_t n = 0; n < width; ++n)
        {
            const double v = static_cast<double>(x[centre + n - width / 2]);
            sum += window[n] * v * v;
            weight += window[n];
        }
        return std::sqrt(sum / weight);
    };
    double depth = 0.0;
    const int periods = static_cast<int>(rate);
    for (int k = 0; k < periods; ++k)
    {
        double least = 1e9, greatest = 0.0;
        const auto from = static_cast<std::size_t>((0.55 + k / rate) * sampleRate);
        const auto to = static_cast<std::size_t>((0.55 + (k + 1) / rate) * sampleRate);
        for (std::size_t i = from; i < to; i += 12)
        {
            least = std::min(least, levelAt(i));
            greatest = std::max(greatest, levelAt(i));
        }
        depth += (greatest - least) / (greatest + least);
    }
    return depth / periods;
}
} // namespace

TEST_CASE("Fast trains of clicks stay apart on a resonant actuator", "[synthesis][events]")
{
    struct Train
    {
        double rate;
        double depth;
    };
    for (const auto& [f, decay] : {std::pair{1000.0, 0.0015}, std::pair{3000.0, 0.001}, std::pair{250.0, 0.003}})
        for (const Train train : {Train{30.0, 0.98}, Train{50.0, 0.95}, Train{60.0, 0.88}})
        {
            CAPTURE(f, train.rate);
            Encoder encoder{EncoderParams{}};
            encoder.start(44100, 1);
            encoder.push(clicks(train.rate, f, decay));
            const Clip clip = encoder.finish();
            CHECK(clip.transients.size() == static_cast<std::size_t>(2.0 * train.rate));

            DecoderParams params;
            Decoder decoder(clip, params);
            std::vector<float> drive(static_cast<std::size_t>(decoder.totalFrames()));
            decoder.process(drive);
            // The L5 of the thesis as a second-order high-pass: resonance 65.9 Hz, quality 3.97.
            StateVariable actuator;
            actuator.prepare({params.sampleRate, drive.size()});
            actuator.setParams({BiquadType::highpass, Hertz(65.93), 3.969});
            actuator.process(drive, drive);
            CHECK(modulationDepth(drive, params.sampleRate, train.rate) >= train.depth);
        }
}
