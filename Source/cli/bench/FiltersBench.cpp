#include "cli/bench/Bench.h"
#include "cli/bench/ExactSection.h"
#include "cli/bench/Timed.h"

#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/Random.h>
#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr std::size_t frames = std::size_t{1} << 18;

/// The cookbook's polynomials, in the precision of the form that runs them.
template <typename T>
struct Polynomials
{
    Polynomials(const BiquadParams& params, double fs)
    {
        const auto c = designBiquad(params, fs);
        b0 = static_cast<T>(c.b0);
        b1 = static_cast<T>(c.b1);
        b2 = static_cast<T>(c.b2);
        a1 = static_cast<T>(c.a1);
        a2 = static_cast<T>(c.a2);
    }
    T b0, b1, b2, a1, a2;
};

template <typename T>
struct DirectForm1 : Polynomials<T>
{
    using Polynomials<T>::Polynomials;
    T x1 = 0, x2 = 0, y1 = 0, y2 = 0;

    T tick(T x) noexcept
    {
        const T y = (this->b0 * x + this->b1 * x1 + this->b2 * x2 - this->a2 * y2) - this->a1 * y1;
        x2 = x1;
        x1 = x;
        y2 = y1;
        y1 = y;
        return y;
    }
};

template <typename T>
struct DirectForm2 : Polynomials<T>
{
    using Polynomials<T>::Polynomials;
    T w1 = 0, w2 = 0;

    T tick(T x) noexcept
    {
        const T w = (x - this->a2 * w2) - this->a1 * w1;
        const T y = this->b0 * w + this->b1 * w1 + this->b2 * w2;
        w2 = w1;
        w1 = w;
        return y;
    }
};

template <typename T>
struct Transposed : Polynomials<T>
{
    using Polynomials<T>::Polynomials;
    T s1 = 0, s2 = 0;

    T tick(T x) noexcept
    {
        const T y = this->b0 * x + s1;
        s1 = (this->b1 * x + s2) - this->a1 * y;
        s2 = this->b2 * x - this->a2 * y;
        return y;
    }
};

/// A. Simper's update of the integrators, 2013.
template <typename T>
struct UsualStateVariable
{
    UsualStateVariable(const BiquadParams& params, double fs)
    {
        const auto c = designStateVariable(params, fs);
        a1 = static_cast<T>(c.loop.a1);
        a2 = static_cast<T>(c.loop.a2);
        a3 = static_cast<T>(c.loop.a3);
        m0 = static_cast<T>(c.high);
        m1 = static_cast<T>(c.band - c.high * c.loop.k);
        m2 = static_cast<T>(c.low - c.high);
    }
    T a1, a2, a3, m0, m1, m2;
    T s1 = 0, s2 = 0;

    T tick(T x) noexcept
    {
        const T v3 = x - s2;
        const T v1 = a1 * s1 + a2 * v3;
        const T v2 = s2 + a2 * s1 + a3 * v3;
        s1 = T(2) * v1 - s1;
        s2 = T(2) * v2 - s2;
        return m0 * x + m1 * v1 + m2 * v2;
    }
};

/// Pacini's section, unchanged.
struct Section
{
    Section(const BiquadParams& params, double fs) : coefficients(designStateVariable(params, fs)) {}
    StateVariableCoefficients coefficients;
    StateVariableState state;

    double tick(double x) noexcept { return state.tick(coefficients, x); }
};

/// The same in float.
struct FloatSection
{
    FloatSection(const BiquadParams& params, double fs)
    {
        const auto c = designStateVariable(params, fs);
        factors = {static_cast<float>(c.drive),    static_cast<float>(c.loop.damping), static_cast<float>(c.step1),
                   static_cast<float>(c.coupling), static_cast<float>(c.step2),        static_cast<float>(c.through),
                   static_cast<float>(c.from1),    static_cast<float>(c.from2)};
    }
    std::array<float, 8> factors;
    float s1 = 0.0f, s2 = 0.0f;

    float tick(float x) noexcept
    {
        const float before1 = s1, before2 = s2;
        const float u = (factors[0] * x - before2) - factors[1] * before1;
        s1 = before1 + factors[2] * u;
        s2 = (before2 + factors[3] * before1) + factors[4] * u;
        return factors[5] * x + (factors[6] * before1 + factors[7] * before2);
    }
};

template <typename Form, typename Number>
std::vector<double> run(const BiquadParams& params, double fs, std::span<const float> x)
{
    Form form(params, fs);
    std::vector<double> y(x.size());
    for (std::size_t n = 0; n < x.size(); ++n)
        y[n] = static_cast<double>(form.tick(static_cast<Number>(x[n])));
    return y;
}

struct Form
{
    const char* name;
    std::vector<double> (*run)(const BiquadParams& params, double fs, std::span<const float> x);
};

constexpr std::array forms = {
    Form{"direct form I", run<DirectForm1<double>, double>},
    Form{"direct form II", run<DirectForm2<double>, double>},
    Form{"transposed form II", run<Transposed<double>, double>},
    Form{"transposed form II, float", run<Transposed<float>, float>},
    Form{"state variable, usual", run<UsualStateVariable<double>, double>},
    Form{"state variable, increments", run<Section, double>},
    Form{"state variable, increments, float", run<FloatSection, float>},
};

struct Place
{
    double fs, frequency; ///< Hz
};

constexpr std::array places = {Place{8e3, 100.0},  Place{48e3, 100.0}, Place{48e3, 20.0},
                               Place{192e3, 20.0}, Place{768e3, 20.0}, Place{768e3, 1.0}};

/// White noise and the section's own frequency, both within +-0.5.
std::vector<float> noiseAndTone(const Place& place)
{
    Random random(1);
    std::vector<float> x(frames);
    for (std::size_t n = 0; n < frames; ++n)
        x[n] = static_cast<float>(random.uniform(-0.5, 0.5) + 0.5 * std::sin(2.0 * std::numbers::pi * place.frequency /
                                                                             place.fs * static_cast<double>(n)));
    return x;
}

void measureFilters(const BenchSound&, const BenchSettings& settings, BenchTable& rows)
{
    for (const Place& place : places)
    {
        const auto x = noiseAndTone(place);
        for (const double q : {0.7, 20.0})
        {
            const BiquadParams params{BiquadType::lowpass, Hertz(place.frequency), q};
            ExactSection exact(params, place.fs);
            std::vector<long double> right(frames);
            long double energy = 0;
            for (std::size_t n = 0; n < frames; ++n)
            {
                right[n] = exact.tick(static_cast<long double>(x[n]));
                energy += right[n] * right[n];
            }
            for (const Form& form : forms)
            {
                const auto found = timed(settings.repeats, [&] { return form.run(params, place.fs, x); });
                long double difference = 0;
                for (std::size_t n = 0; n < frames; ++n)
                    difference += std::pow(static_cast<long double>(found.result[n]) - right[n], 2.0L);
                const auto share = static_cast<double>(std::sqrt(difference / energy));
                BenchCell error, level; // what is not finite has none
                if (std::isfinite(share))
                {
                    error = 100.0 * share;
                    level = Decibels::fromGain(share).value;
                }
                rows.add({"noise and tone", fmt::format("{:g} kHz", place.fs / 1e3),
                          fmt::format("{:g} Hz", place.frequency), fmt::format("Q {:g}", q), form.name,
                          static_cast<double>(frames), found.seconds, error, level});
            }
        }
    }
}
} // namespace

Bench filtersBench()
{
    const auto figure = [](int kilohertz)
    {
        return figureAtRate("Second-order filters", "form", "frequency", kilohertz);
    };
    return {
        "filters",
        "Forms of second-order filters",
        "Low-passes on 262144 frames of white noise and a tone at the filter's own frequency. The error is the RMS "
        "difference from the sum of the filter's two exact modes in long double, over the RMS of that; level is "
        "the same in dB. Samples in and out are as precise as the form. Streams run the state variable by "
        "increments in double.",
        columnsOf({"rate", "frequency", "q", "form"}, {summed("frames"),
                                                       summed("seconds", "s"),
                                                       {"error", "%"},
                                                       {"level", "dB"},
                                                       {"time", "ns/frame", Reduction::ratio, "seconds", "frames", 1e9},
                                                       {"relativeTime", "", Reduction::relative, "time", "rate"}}),
        {figure(48), figure(768)},
        {},
        measureFilters,
        false};
}

} // namespace pacini::cli
