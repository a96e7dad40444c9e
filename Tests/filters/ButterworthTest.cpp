#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <pacini/filters/Butterworth.h>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("Butterworth responses equal the reference", "[filters][golden]")
{
    const auto data = golden("butterworth");
    for (const auto& entry : data["cases"])
    {
        const std::string type = entry["type"];
        const auto& edges = entry["edges"];
        ButterworthParams params;
        params.type = type == "lowpass"    ? ButterworthType::lowpass
                      : type == "highpass" ? ButterworthType::highpass
                                           : ButterworthType::bandpass;
        params.order = entry["order"];
        params.frequency = Hertz(edges[0].get<double>());
        if (edges.size() > 1)
            params.highFrequency = Hertz(edges[1].get<double>());
        const double fs = entry["fs"];
        const auto filter = designButterworth(params, fs);
        for (std::size_t i = 0; i < entry["freqs"].size(); ++i)
        {
            const double f = entry["freqs"][i];
            const std::complex<double> expected{entry["re"][i], entry["im"][i]};
            CAPTURE(type, params.order, fs, f);
            CHECK(std::abs(filter.response(Hertz(f), fs) - expected) < data["tol_abs"].get<double>());
        }
    }
}

TEST_CASE("Butterworth magnitudes are maximally flat at every order and far below the sample rate", "[filters]")
{
    const auto warped = [](double f, double fs)
    {
        return std::tan(std::numbers::pi * f / fs);
    };
    for (int order = 1; order <= maxButterworthOrder; ++order)
        for (const double fs : {8000.0, 48000.0, 384000.0})
            for (const double f0 : {30.0, 1000.0, 3500.0})
            {
                const double high = std::min(2.0 * f0, 0.49 * fs);
                const auto low = designButterworth({ButterworthType::lowpass, order, Hertz(f0), 0_Hz}, fs);
                const auto up = designButterworth({ButterworthType::highpass, order, Hertz(f0), 0_Hz}, fs);
                const auto band = designButterworth({ButterworthType::bandpass, order, Hertz(f0), Hertz(high)}, fs);
                const double w1 = warped(f0, fs);
                const double w2 = warped(high, fs);
                for (const double x : {0.3, 0.8, 1.0, 1.1, 1.7, 3.0})
                {
                    const double f = x * f0;
                    if (f >= 0.5 * fs)
                        continue;
                    CAPTURE(order, fs, f0, x);
                    const double w = warped(f, fs);
                    const double power = std::pow(w / w1, 2.0 * order);
                    CHECK(std::norm(low.response(Hertz(f), fs)) == Approx(1.0 / (1.0 + power)).epsilon(1e-6));
                    CHECK(std::norm(up.response(Hertz(f), fs)) == Approx(power / (1.0 + power)).epsilon(1e-6));
                    const double detuned = (w * w - w1 * w2) / (w * (w2 - w1));
                    const double bandPower = 1.0 / (1.0 + std::pow(detuned * detuned, order));
                    CHECK(std::norm(band.response(Hertz(f), fs)) == Approx(bandPower).epsilon(1e-6));
                }
            }
}

TEST_CASE("Butterworth filters are stable at any parameters", "[filters]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double fs = 48000.0;
    for (const auto type : {ButterworthType::lowpass, ButterworthType::highpass, ButterworthType::bandpass})
        for (const int order : {-3, 1, 2, 7, 16, 99})
            for (const double f : {0.0, 0.05, 5.0, 1000.0, 23900.0, 24000.0, 1e6, nan})
                for (const double high : {0.0, f * 1.001, 100.0, 23990.0, 1e9, nan})
                {
                    CAPTURE(static_cast<int>(type), order, f, high);
                    const auto filter = designButterworth({type, order, Hertz(f), Hertz(high)}, fs);
                    REQUIRE(!filter.sections.empty());
                    for (const auto& section : filter.sections)
                    {
                        const auto c = section.directForm();
                        REQUIRE(std::abs(c.a2) < 1.0);
                        REQUIRE((1.0 - std::abs(c.a1)) + c.a2 > 0.0);
                        REQUIRE(std::isfinite(c.b0 + c.b1 + c.b2));
                    }
                }
}

TEST_CASE("A Butterworth filter's measured response equals response()", "[filters]")
{
    const double fs = 8000.0;
    Butterworth filter;
    filter.setParams({ButterworthType::bandpass, 3, 60_Hz, 250_Hz});
    filter.prepare({fs, 16384});
    auto h = impulse(16384);
    filter.process(h, h);
    for (const double f : {20.0, 60.0, 120.0, 250.0, 700.0, 3000.0})
        CHECK(std::abs(spectrumAt<float>(h, f, fs) - filter.coefficients().response(Hertz(f), fs)) < 1e-5);
}

TEST_CASE("Butterworth keeps the contract of blocks", "[filters][contract]")
{
    checkBlockContract<Butterworth>({ButterworthType::highpass, 5, 20_Hz, 0_Hz}, {.delay = MeasuredDelay::firstFrame});
    checkBlockContract<Butterworth>({ButterworthType::bandpass, 3, 60_Hz, 250_Hz});
    checkBlockContract<Butterworth>({ButterworthType::lowpass, 16, 1000_Hz, 0_Hz});
    checkSilenceIsCheap<Butterworth>({ButterworthType::bandpass, 3, 60_Hz, 250_Hz});
}
