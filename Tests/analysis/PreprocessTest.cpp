#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <pacini/analysis/methods/MethodSound.h>

#include <limits>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("Band limit, normalisation and active time equal the reference", "[analysis][golden]")
{
    const auto data = golden("preprocess");
    const double fs = data["fs"];
    const auto left = data["left"].get<std::vector<float>>();
    auto x = left;
    for (float& v : x)
        v *= 0.5f; // the mean of it and a silent right channel
    BandLimit limit;
    limit.prepare({fs, x.size()});
    limit.process(x, x);
    const double tolerance = data["tol"];
    CHECK(std::abs(normalise(x) - data["peak"].get<double>()) <= tolerance);
    for (std::size_t i = 0; i < x.size(); ++i)
        CHECK(std::abs(static_cast<double>(x[i]) - data["out"][i].get<double>()) <= tolerance);

    CHECK(activeTime(left, fs).value == Approx(data["active_block_s"].get<double>()));
    CHECK(activeTime(std::vector<float>(800, 0.0f), fs).value == data["silence_active"].get<double>());
}

TEST_CASE("The band limit has the reference's magnitudes at 48 kHz", "[analysis][golden]")
{
    const auto data = golden("preprocess")["mag48k"];
    const auto filter = designBandLimit({}, 48000.0);
    // The reference sums its sections' polynomials plainly, which costs it eight digits at 1 Hz.
    for (std::size_t i = 0; i < data["freqs"].size(); ++i)
        CHECK(std::abs(filter.response(Hertz(data["freqs"][i].get<double>()), 48000.0)) ==
              Approx(data["mag"][i].get<double>()).epsilon(2e-8));
}

TEST_CASE("Limits that lie outside the spectrum are left out", "[analysis]")
{
    CHECK(designBandLimit({}, 48000.0).sections.size() == 3);
    CHECK(designBandLimit({}, 3000.0).sections.size() == 1);
    CHECK(designBandLimit({0_Hz, 1800_Hz}, 48000.0).sections.size() == 2);
    CHECK(designBandLimit({0_Hz, 24_kHz}, 48000.0).sections.empty());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(designBandLimit({Hertz(nan), Hertz(nan)}, 48000.0).sections.empty());
}

TEST_CASE("BandLimit keeps the contract of blocks", "[analysis][contract]")
{
    checkBlockContract<BandLimit>({}, {.bound = 4.0, .delay = MeasuredDelay::firstFrame});
    checkSilenceIsCheap<BandLimit>({});
}

TEST_CASE("Normalising brings the peak to 1 and leaves silence alone", "[analysis]")
{
    for (const float peak : {1e-38f, 0.1f, 1.0f, 3e38f})
    {
        std::vector<float> x{0.0f, peak / 2.0f, -peak};
        CHECK(normalise(x) == static_cast<double>(peak));
        CHECK(x == std::vector<float>{0.0f, 0.5f, -1.0f});
    }
    std::vector<float> silence(3, 0.0f);
    CHECK(normalise(silence) == 0.0);
    CHECK(silence == std::vector<float>(3, 0.0f));
    CHECK(normalise({}) == 0.0);
    std::vector<float> bad{std::numeric_limits<float>::quiet_NaN(), 0.5f, std::numeric_limits<float>::infinity()};
    CHECK(normalise(bad) == 0.5);
    CHECK(bad == std::vector<float>{0.0f, 1.0f, 0.0f});
}

TEST_CASE("Active time counts the blocks in which a tone sounds", "[analysis]")
{
    for (const double fs : {8000.0, 44100.0, 384000.0})
    {
        const auto ms = [fs](double t)
        {
            return static_cast<std::size_t>(t * fs / 1000.0);
        };
        std::vector<float> x(ms(1000.0), 0.0f);
        const auto tone = sine(ms(300.0), 100.0, fs, 0.5);
        std::copy(tone.begin(), tone.end(), x.begin() + static_cast<std::ptrdiff_t>(ms(200.0)));
        CAPTURE(fs);
        CHECK(activeTime(x, fs).value == Approx(0.3).margin(0.011));
    }
    CHECK(activeTime({}, 8000.0).value == 0.0);
    CHECK(activeTime(std::vector<float>(1, 1.0f), 8000.0).value == Approx(1.0 / 8000.0));
    CHECK(activeTime(std::vector<float>(81, 1.0f), 8000.0).value == Approx(81.0 / 8000.0));
}

TEST_CASE("A band limit has no low-pass from 0.49 of the sample rate on, and no high-pass at 0 Hz", "[analysis]")
{
    const auto sections = [](double low, double high)
    {
        return designBandLimit({Hertz(low), Hertz(high)}, 8000.0).sections.size();
    };
    CHECK(sections(5.0, 0.49 * 8000.0) == 1);
    CHECK(sections(5.0, 0.4899 * 8000.0) == 3);
    CHECK(sections(0.0, 0.49 * 8000.0) == 0);
    CHECK(sections(0.1, 0.49 * 8000.0) == 1);
}
