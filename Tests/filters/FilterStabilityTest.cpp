#include "cli/bench/ExactSection.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/filters/Butterworth.h>
#include <pacini/filters/StateVariable.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <utility>

using namespace pacini;
using namespace pacini::test;
using cli::ExactSection;

namespace
{
constexpr std::array everyType{BiquadType::lowpass, BiquadType::highpass, BiquadType::bandpass, BiquadType::notch,
                               BiquadType::allpass, BiquadType::peak,     BiquadType::lowShelf, BiquadType::highShelf};
constexpr std::array extremeRates{8e3, 48e3, 192e3, 384e3, 768e3}; // Hz

/// Gains of a type: both signs where it has one.
std::vector<double> gainsOf(BiquadType type, double gain)
{
    const bool has = type == BiquadType::peak || type == BiquadType::lowShelf || type == BiquadType::highShelf;
    return has ? std::vector<double>{-gain, gain} : std::vector<double>{0.0};
}

/// RMS of the difference from what is right over the RMS of that, dB.
class ErrorLevel
{
public:
    void add(double found, long double right)
    {
        const auto difference = static_cast<double>(static_cast<long double>(found) - right);
        error += difference * difference;
        energy += static_cast<double>(right * right);
    }
    [[nodiscard]] double decibels() const { return 10.0 * std::log10(error / energy + 1e-40); }

private:
    double error = 0.0;
    double energy = 0.0;
};

struct Levels
{
    double direct = 0.0;        ///< the cookbook's polynomials in double
    double stateVariable = 0.0; ///< the section that streams run, in double
    double block = 0.0;         ///< the block, float to float
};

Levels measure(const BiquadParams& params, double fs, std::span<const float> x)
{
    ExactSection exact(params, fs);
    const auto polynomials = designBiquad(params, fs);
    const auto section = designStateVariable(params, fs);
    BiquadState directState;
    StateVariableState state;
    StateVariable block;
    block.setParams(params);
    block.prepare({fs, x.size()});
    std::vector<float> y(x.size());
    block.process(x, y);
    ErrorLevel direct, stateVariable, streamed;
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const auto in = static_cast<double>(x[n]);
        const long double right = exact.tick(static_cast<long double>(x[n]));
        direct.add(directState.tick(polynomials, in), right);
        stateVariable.add(state.tick(section, in), right);
        streamed.add(static_cast<double>(y[n]), right);
    }
    return {direct.decibels(), stateVariable.decibels(), streamed.decibels()};
}

double logUniform(Random& random, double low, double high)
{
    return low * std::exp(random.uniform() * std::log(high / low));
}
} // namespace

TEST_CASE("Over the product's range a section is right to -240 dB in double and -140 dB in float, polynomials of low Q "
          "to -150 dB",
          "[filters][stability]")
{
    for (const double fs : extremeRates)
        for (const double f : {20.0, 100.0, 1000.0})
            for (const double q : {0.1, 0.7, 3.0, 20.0})
            {
                // Noise, which is heard through the whole filter, and its own frequency, where its decay counts.
                const auto frames = static_cast<std::size_t>(std::clamp(4.0 * fs / f * (q + 1.0), 2e4, 2e5));
                for (const auto& x : {noise(frames, 3), sine(frames, f, fs)})
                    for (const BiquadType type : everyType)
                        for (const double gain : gainsOf(type, 12.0))
                        {
                            CAPTURE(fs, f, q, static_cast<int>(type), gain);
                            const auto levels = measure({type, Hertz(f), q, Decibels(gain)}, fs, x);
                            CHECK(levels.stateVariable < -240.0);
                            CHECK(levels.block < -140.0);
                            CHECK(levels.direct < (q <= 1.0 ? -150.0 : -130.0));
                        }
            }
}

TEST_CASE("The fifth-order high-pass at 20 Hz is right to -140 dB in float at 384 and 768 kHz", "[filters][stability]")
{
    for (const double fs : {384e3, 768e3})
    {
        const double f = 20.0;
        auto offset = noise(200000, 5);
        for (float& v : offset)
            v = 1.0f + 0.01f * v;
        for (const auto& x : {noise(200000, 4), sine(200000, f, fs), sine(200000, 150.0, fs), offset})
        {
            // Q = 1 / (2 sin(pi (2 k + 1) / 10)), and s / (s + 1).
            std::array sections{
                ExactSection({BiquadType::highpass, Hertz(f), 0.5 / std::sin(0.3 * std::numbers::pi)}, fs),
                ExactSection({BiquadType::highpass, Hertz(f), 0.5 / std::sin(0.1 * std::numbers::pi)}, fs)};
            const long double g = std::tan(std::numbers::pi_v<long double> * 20.0L / static_cast<long double>(fs));
            long double before = 0.0L, first = 0.0L;
            Butterworth block;
            block.setParams({ButterworthType::highpass, 5, Hertz(f), 0_Hz});
            block.prepare({fs, x.size()});
            std::vector<float> y(x.size());
            block.process(x, y);
            ErrorLevel level;
            for (std::size_t n = 0; n < x.size(); ++n)
            {
                const auto in = static_cast<long double>(x[n]);
                first = ((1.0L - g) * first + in - before) / (1.0L + g);
                before = in;
                level.add(static_cast<double>(y[n]), sections[1].tick(sections[0].tick(first)));
            }
            CHECK(level.decibels() < -140.0);
        }
    }
}

TEST_CASE("From 0.5 Hz to 0.49 of the sample rate, at Q 0.1 to 1e4 and +-60 dB, a section stays finite and right",
          "[filters][stability]")
{
    for (const double fs : extremeRates)
        for (const double f : {0.5, 3.0, 100.0, 0.02 * fs, 0.25 * fs, 0.4 * fs, 0.49 * fs})
            for (const double q : {0.1, 0.9, 30.0, 1e4})
                for (const BiquadType type : everyType)
                    for (const double gain : gainsOf(type, 60.0))
                    {
                        CAPTURE(fs, f, q, static_cast<int>(type), gain);
                        const BiquadParams params{type, Hertz(f), q, Decibels(gain)};
                        const auto levels = measure(params, fs, noise(10000, 6));
                        REQUIRE(levels.stateVariable < -100.0); // NaN fails
                        REQUIRE(levels.block < -100.0);
                    }
}

namespace
{
/// The range of parameters that jump.
struct Jumps
{
    double lowestFrequency, highestFrequency; ///< Hz
    double lowestQ, highestQ;
    double gain; ///< dB, up and down

    BiquadParams draw(BiquadType type, Random& random) const
    {
        const double f = logUniform(random, lowestFrequency, highestFrequency);
        const double q = logUniform(random, lowestQ, highestQ);
        return {type, Hertz(f), q, Decibels(random.uniform(-gain, gain))};
    }
};

/// The largest magnitude that noise within +-1 reaches while a type of `types` and its parameters are drawn anew every
/// `framesEach` frames; infinite when something is not finite.
double largestUnderJumps(const std::vector<BiquadType>& types, const Jumps& jumps, double fs, std::size_t framesEach)
{
    const auto x = noise(200000, 7);
    Random random(12);
    StateVariable filter;
    filter.prepare({fs, framesEach});
    std::vector<float> y(framesEach);
    double largest = 0.0;
    for (std::size_t i = 0; i + framesEach <= x.size(); i += framesEach)
    {
        filter.setParams(jumps.draw(types[random.next() % types.size()], random));
        filter.process(std::span(x).subspan(i, framesEach), y);
        for (const float v : y)
            largest = std::isfinite(v) ? std::max(largest, std::abs(static_cast<double>(v)))
                                       : std::numeric_limits<double>::infinity();
    }
    return largest;
}

const std::vector<BiquadType> shelves{BiquadType::lowShelf, BiquadType::highShelf};
const std::vector<BiquadType> others{BiquadType::lowpass, BiquadType::highpass, BiquadType::bandpass,
                                     BiquadType::notch,   BiquadType::allpass,  BiquadType::peak};
} // namespace

TEST_CASE("Random jumps of all parameters with every sample stay below 3000", "[filters][stability]")
{
    for (const double fs : extremeRates)
    {
        CAPTURE(fs);
        CHECK(largestUnderJumps(others, {0.5, 0.49 * fs, 0.1, 1e4, 60.0}, fs, 1) <= 3000.0);
        CHECK(largestUnderJumps({BiquadType::peak}, {0.5, 0.49 * fs, 0.1, 1e4, 60.0}, fs, 1) <= 3000.0);
        // A shelf lets a whole half of the spectrum through at its gain.
        CHECK(largestUnderJumps(shelves, {0.5, 0.49 * fs, 0.1, 1e4, 36.0}, fs, 1) <= 3000.0);
        CHECK(largestUnderJumps(shelves, {20.0, 1000.0, 0.1, 20.0, 12.0}, fs, 1) <= 30.0);
    }
}

TEST_CASE("Jumps within the product's range every millisecond stay below 6", "[filters][stability]")
{
    for (const double fs : extremeRates)
    {
        const auto millisecond = static_cast<std::size_t>(fs / 1000.0);
        for (const BiquadType type : others)
        {
            // A high-pass of Q 0.1 weighs its band-pass with 10, also what rings from a Q of 20 before.
            const double lowestQ = type == BiquadType::highpass ? 0.5 : 0.1;
            CAPTURE(fs, static_cast<int>(type));
            CHECK(largestUnderJumps({type}, {20.0, 1000.0, lowestQ, 20.0, 12.0}, fs, millisecond) <= 6.0);
        }
        // A steady shelf of +12 dB and Q 20 would already have a peak of 45.
        CHECK(largestUnderJumps(shelves, {20.0, 1000.0, 0.5, 1.0, 12.0}, fs, millisecond) <= 6.0);
    }
}

TEST_CASE("After 75 time constants of silence the output is 0, and hardly a call on the way computes with denormals",
          "[filters][stability]")
{
    constexpr std::size_t callFrames = 512;
    const std::vector<float> silence(callFrames, 0.0f);
    for (const auto& [fs, f, q] : std::vector<std::array<double, 3>>{{8e3, 20.0, 20.0},
                                                                     {8e3, 1000.0, 0.1},
                                                                     {48e3, 20.0, 0.1},
                                                                     {48e3, 100.0, 0.7},
                                                                     {48e3, 1000.0, 20.0},
                                                                     {768e3, 1000.0, 0.7}})
        for (const BiquadType type : everyType)
        {
            CAPTURE(fs, f, q, static_cast<int>(type));
            const double gain = 12.0;
            StateVariable filter;
            filter.setParams({type, Hertz(f), q, Decibels(gain)});
            filter.prepare({fs, callFrames});
            auto y = noise(callFrames, 9);
            for (int i = 0; i < 20; ++i)
                filter.process(noise(callFrames, static_cast<std::uint64_t>(i)), y);

            const auto& loop = filter.coefficients().loop;
            const double half = 0.5 * loop.k;
            const double decay = half < 1.0 ? half : half - std::sqrt(half * half - 1.0);
            const double frames = 75.0 / std::log((1.0 + loop.g * decay) / (1.0 - loop.g * decay));
            std::size_t slowCalls = 0, subnormals = 0;
            for (double done = 0.0; done < frames; done += static_cast<double>(callFrames))
            {
                std::feclearexcept(FE_UNDERFLOW);
                filter.process(silence, y);
                slowCalls += std::fetestexcept(FE_UNDERFLOW) != 0 ? 1u : 0u;
                subnormals += static_cast<std::size_t>(
                    std::count_if(y.begin(), y.end(), [](float v) { return std::fpclassify(v) == FP_SUBNORMAL; }));
            }
            filter.process(silence, y);
            CHECK(std::all_of(y.begin(), y.end(), [](float v) { return v == 0.0f; }));
            CHECK(subnormals == 0);
            CHECK(slowCalls <= 1);
        }
}
