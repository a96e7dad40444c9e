#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/methods/ZeroPhaseLowpass.h>

#include <algorithm>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("The low-pass has the squared response of its Butterworth filter and no phase", "[methods]")
{
    for (const double fs : {8000.0, 48000.0, 384000.0})
        for (const double cutoff : {300.0, 1000.0})
        {
            const auto middle = static_cast<std::size_t>(0.1 * fs);
            const auto response = zeroPhaseLowpass(impulse(2 * middle + 1, middle), fs, {Hertz(cutoff), 4});
            for (const double f : {0.0, 50.0, 250.0, 900.0, 1000.0, 1500.0, 3000.0, 3900.0})
            {
                const double warped = std::tan(std::numbers::pi * f / fs) / std::tan(std::numbers::pi * cutoff / fs);
                const auto delay = std::polar(1.0, 2.0 * std::numbers::pi * f * static_cast<double>(middle) / fs);
                CAPTURE(fs, cutoff, f);
                CHECK(std::abs(spectrumAt<float>(response, f, fs) * delay - 1.0 / (1.0 + std::pow(warped, 8.0))) <
                      1e-6);
            }
        }
}

TEST_CASE("The low-passed signal is the same forwards and backwards", "[methods]")
{
    auto sound = noise(5000, 2);
    const auto forwards = zeroPhaseLowpass(sound, 16000.0);
    std::reverse(sound.begin(), sound.end());
    auto backwards = zeroPhaseLowpass(sound, 16000.0);
    std::reverse(backwards.begin(), backwards.end());
    for (std::size_t i = 0; i < sound.size(); ++i)
        REQUIRE(std::abs(forwards[i] - backwards[i]) < 2e-6f);
}

TEST_CASE("The ends of a signal are filtered as if silence lay beyond", "[methods]")
{
    const auto sound = noise(3000, 5);
    std::vector<float> padded(9000, 0.0f);
    std::copy(sound.begin(), sound.end(), padded.begin() + 3000);
    for (const double fs : {8000.0, 44100.0, 384000.0})
    {
        const auto alone = zeroPhaseLowpass(sound, fs);
        const auto within = zeroPhaseLowpass(padded, fs);
        CAPTURE(fs);
        REQUIRE(alone.size() == sound.size());
        for (std::size_t i = 0; i < sound.size(); ++i)
            REQUIRE(std::abs(alone[i] - within[i + 3000]) < 2e-6f);
    }
}

TEST_CASE("Without parameters the low-pass halves 1 kHz", "[methods]")
{
    const double fs = 16000.0;
    const auto response = zeroPhaseLowpass(impulse(4001, 2000), fs);
    CHECK(std::abs(spectrumAt<float>(response, 1000.0, fs)) == Approx(0.5).epsilon(1e-4));
    CHECK(std::abs(spectrumAt<float>(response, 500.0, fs)) > 0.99);
    CHECK(std::abs(spectrumAt<float>(response, 2000.0, fs)) < 0.004);
}

TEST_CASE("What a slow low-pass rings beyond the end comes back whole", "[methods]")
{
    for (const int order : {1, 4})
    {
        std::vector<float> x(3000, 1.0f);
        const auto found = zeroPhaseLowpass(x, 8000.0, {Hertz(20.0), order});
        x.resize(20000, 0.0f);
        const auto expected = zeroPhaseLowpass(x, 8000.0, {Hertz(20.0), order});
        for (std::size_t n = 0; n < found.size(); ++n)
            REQUIRE(found[n] == Approx(expected[n]).epsilon(0.0).margin(3e-7));
    }
}
