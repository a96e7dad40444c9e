#include "actuator/BodyReference.h"
#include "support/Catch.h"

#include <pacini/actuator/BodyDesign.h>

#include <array>
#include <limits>

using namespace pacini;
using namespace pacini::test;

namespace
{
constexpr std::array bodyPoints = {BodyPoint::movingMass, BodyPoint::device, BodyPoint::skin, BodyPoint::excursion};

double spectralRadius(const BodyModelCoefficients& filter)
{
    double largest = 0.0;
    for (const BodySection& s : filter.sections)
    {
        const double middle = 0.5 * (s.a + s.d);
        const double square = 0.25 * (s.a - s.d) * (s.a - s.d) + s.b * s.c;
        largest = std::max(largest,
                           square < 0.0 ? std::sqrt(middle * middle - square) : std::abs(middle) + std::sqrt(square));
    }
    return largest;
}

/// The filter's output in double precision, latency taken away.
std::vector<double> run(const BodyModelCoefficients& filter, const std::vector<double>& in)
{
    constexpr std::size_t latency = BodyModelCoefficients::latency;
    std::vector<double> out(in.size());
    std::array<std::array<double, 2>, 3> x{};
    const auto at = [&in](std::size_t n, std::size_t i)
    {
        return n >= i && n - i < in.size() ? in[n - i] : 0.0;
    };
    for (std::size_t n = 0; n < in.size() + latency; ++n)
    {
        double y = 0.0;
        for (std::size_t i = 0; i < BodyModelCoefficients::taps; ++i)
            y += filter.tap[i] * at(n, i);
        for (std::size_t k = 0; k < filter.sections.size(); ++k)
        {
            const BodySection& s = filter.sections[k];
            const auto old = x[k];
            y += s.out1 * old[0] + s.out2 * old[1];
            x[k] = {s.a * old[0] + s.b * old[1] + s.g * at(n, latency), s.c * old[0] + s.d * old[1] + at(n, latency)};
        }
        if (n >= latency)
            out[n - latency] = y;
    }
    return out;
}

/// The largest difference of the linear hold from the matrix exponential, over the largest output.
double holdError(const BodyChain& chain, double fs, std::size_t frames = 120)
{
    Random random(5);
    std::vector<double> force(frames);
    for (std::size_t n = 1; n < frames; ++n) // from 0, as every ramp needs a beginning
        force[n] = random.uniform(-1.0, 1.0);
    const ReferenceBody reference(chain, fs);
    double worst = 0.0;
    for (const BodyPoint point : bodyPoints)
    {
        const auto wanted = reference.run(force, point);
        const auto found = run(designBodyModel(chain, point, fs, BodyHold::linear), force);
        double largest = 0.0, difference = 0.0;
        for (std::size_t n = 0; n < frames; ++n)
        {
            largest = std::max(largest, std::abs(wanted[n]));
            difference = std::max(difference, std::abs(wanted[n] - found[n]));
        }
        worst = std::max(worst, difference / largest);
    }
    return worst;
}

/// The largest relative error of the filter against the continuous response, 30-1000 Hz: on a grid, at the modes, and
/// where modes above half the sample rate have their images.
double responseError(const BodyChain& chain, BodyPoint point, double fs)
{
    const auto filter = designBodyModel(chain, point, fs);
    double largest = 0.0;
    const auto look = [&](double f)
    {
        if (!(f >= 30.0 && f <= 1000.0))
            return;
        const auto wanted = chain.response(point, Hertz(f));
        const double delay = static_cast<double>(BodyModelCoefficients::latency);
        const auto found = filter.response(Hertz(f), fs) * std::polar(1.0, 2.0 * std::numbers::pi * f / fs * delay);
        largest = std::max(largest, std::abs(found - wanted) / std::abs(wanted));
    };
    for (int i = 0; i <= 100; ++i)
        look(30.0 * std::pow(1000.0 / 30.0, i / 100.0));
    for (const PoleGroup& pair : findPoleGroups(chain.denominator(RealPolynomial::identity())))
        if (pair.spread < 0.0)
        {
            const double f = std::sqrt(-pair.spread) / (2.0 * std::numbers::pi);
            const double image = std::abs(f - fs * std::round(f / fs));
            for (const double factor : {0.999, 0.9999, 1.0, 1.0001, 1.001})
            {
                look(f * factor);
                look(image * factor);
            }
        }
    return largest;
}

struct Limit
{
    double fs, error;
};
constexpr std::array rateLimits = {Limit{48000.0, 5e-4}, Limit{16000.0, 5e-3}, Limit{8000.0, 3e-2}};
} // namespace

TEST_CASE("The body is stable for every joint, and for every profile that is valid", "[actuator][body]")
{
    BodyDraws draws;
    double largest = 0.0;
    for (int i = 0; i < bodyDraws; ++i)
    {
        const auto drawn = i == 0 ? DrawnBody{} : draws.next();
        for (const Limit& limit : rateLimits)
            for (const BodyHold hold : {BodyHold::corrected, BodyHold::linear})
                largest = std::max(largest, spectralRadius(designBodyModel(makeBodyChain(drawn.body, drawn.resonance),
                                                                           BodyPoint::skin, limit.fs, hold)));
    }
    CHECK(largest <= 1.0 + 1e-12);
    CHECK(largest > 0.99);

    // Anything that validate() lets through.
    Random random(9);
    const auto between = [&random](double low, double high)
    {
        return random.next() % 8 == 0 ? (random.next() % 2 == 0 ? low : high)
                                      : low * std::pow(high / low, random.uniform());
    };
    const auto orNothing = [&](double low, double high)
    {
        return random.next() % 8 == 0 ? 0.0 : between(low, high);
    };
    for (int i = 0; i < bodyDraws; ++i)
    {
        CAPTURE(i);
        const BodyParams body{between(1e-6, 1e3),   between(1e-7, 10.0),  between(1e-6, 100.0), between(1.0, 1e13),
                              orNothing(1e-9, 1e9), between(1e-7, 100.0), orNothing(1e-6, 1e9), orNothing(1e-9, 1e6)};
        const auto chain = makeBodyChain(body, {between(1.0, 20000.0), between(0.01, 100.0)});
        for (const double fs : {2000.0, 48000.0, 768000.0})
        {
            const auto filter = designBodyModel(chain, bodyPoints[random.next() % 4], fs);
            REQUIRE(spectralRadius(filter) <= 1.0 + 1e-12);
            for (const double tap : filter.tap)
                REQUIRE(std::isfinite(tap));
            REQUIRE(std::isfinite(std::abs(filter.response(100_Hz, fs))));
        }
    }
}

TEST_CASE("The linear hold is the matrix exponential's", "[actuator][body]")
{
    CHECK(holdError(makeBodyChain({}, {65.93, 3.969}), 48000.0, 4000) <= 1e-11);
    BodyDraws draws;
    double largest = 0.0;
    for (int i = 0; i < bodyDraws; ++i)
    {
        const auto drawn = draws.next();
        largest =
            std::max(largest, holdError(makeBodyChain(drawn.body, drawn.resonance), rateLimits[std::size_t(i) % 3].fs));
    }
    CAPTURE(largest);
    CHECK(largest <= 1e-8);
}

TEST_CASE("The filter follows the continuous response", "[actuator][body]")
{
    for (const Limit& limit : rateLimits)
    {
        for (const BodyPoint point : bodyPoints)
            CHECK(responseError(makeBodyChain({}, {65.93, 3.969}), point, limit.fs) <= 0.01 * limit.error);
        BodyDraws draws;
        double largest = 0.0;
        for (int i = 0; i < bodyDraws; ++i)
        {
            const auto drawn = draws.next();
            const auto chain = makeBodyChain(drawn.body, drawn.resonance);
            largest = std::max(largest, responseError(chain, bodyPoints[std::size_t(i) % 4], limit.fs));
            largest = std::max(largest, responseError(chain, BodyPoint::skin, limit.fs));
        }
        CAPTURE(limit.fs, largest);
        CHECK(largest <= 0.1 * limit.error);
    }
}

TEST_CASE("A lightly damped joint near a multiple of the sample rate leaves no image in the band of touch",
          "[actuator][body]")
{
    for (const Limit& limit : rateLimits)
    {
        double largest = 0.0, largestOfHold = 0.0;
        for (int i = 0; i < 500; ++i)
        {
            // From 0.1 to 10 times the sample rate; every second one within 1000 Hz of a multiple of it.
            double f = 0.1 * limit.fs * std::pow(100.0, i / 499.0);
            if (i % 2 == 1)
                f = limit.fs * std::max(1.0, std::round(f / limit.fs)) + 30.0 + 970.0 * (i % 97) / 97.0;
            BodyParams body;
            const double reduced = body.deviceMass * body.skinMass / (body.deviceMass + body.skinMass);
            body.jointStiffness = reduced * std::pow(2.0 * std::numbers::pi * f, 2.0);
            setJointDampingRatio(body, 1e-4);
            const auto chain = makeBodyChain(body, {65.93, 3.969});
            largest = std::max(largest, responseError(chain, BodyPoint::skin, limit.fs));
            if (i % 2 == 1)
            {
                const double image = f - limit.fs * std::round(f / limit.fs);
                const auto wanted = chain.response(BodyPoint::skin, Hertz(image));
                const auto found = designBodyModel(chain, BodyPoint::skin, limit.fs, BodyHold::linear)
                                       .response(Hertz(image), limit.fs);
                largestOfHold = std::max(largestOfHold, std::abs(std::abs(found) / std::abs(wanted) - 1.0));
            }
        }
        CAPTURE(limit.fs, largest);
        CHECK(largest <= 0.1 * limit.error);
        CHECK(largestOfHold > 10.0 * limit.error); // which is why such modes are left to the taps
    }
}

TEST_CASE("Critical damping is a case like all others", "[actuator][body]")
{
    double largest = 0.0;
    for (int k = 0; k <= 16; ++k)
        for (const double sign : {-1.0, 0.0, 1.0})
        {
            const double ratio = 1.0 + sign * std::pow(10.0, -k);
            for (const double stiffness : {1e4, 4e4, 1e6, 1e9})
            {
                BodyParams body;
                body.jointStiffness = stiffness;
                setJointDampingRatio(body, ratio);
                largest = std::max(largest, holdError(makeBodyChain(body, {65.93, 3.969}), 48000.0));
                if (ratio > 0.0)
                    largest = std::max(largest, holdError(makeBodyChain(body, {65.93, 0.5 / ratio}), 48000.0));
                // A device so heavy that the actuator's pair stands alone: then it is critical itself.
                body.deviceMass = 1e9;
                if (ratio > 0.0)
                    largest = std::max(largest, holdError(makeBodyChain(body, {65.93, 0.5 / ratio}), 8000.0));
            }
        }
    CAPTURE(largest);
    CHECK(largest <= 1e-10);
}

TEST_CASE("Constant drive gives no acceleration and the static excursion", "[actuator][body]")
{
    BodyDraws draws;
    for (int i = 0; i < 100; ++i)
    {
        const auto drawn = draws.next();
        const auto chain = makeBodyChain(drawn.body, drawn.resonance);
        for (const Limit& limit : rateLimits)
            for (const BodyPoint point : bodyPoints)
            {
                const double still = std::abs(chain.response(point, 0_Hz));
                const double usual = std::abs(chain.response(point, 100_Hz));
                const auto found = designBodyModel(chain, point, limit.fs).response(0_Hz, limit.fs);
                CHECK(std::abs(std::abs(found) - still) <= 1e-8 * std::max(usual, still));
            }
    }
}

TEST_CASE("Where two modes of the chain coincide nothing blows up", "[actuator][body]")
{
    // Joint stiffness and damping, resonance, skin damping: found by bringing the roots of the characteristic
    // polynomial together numerically. Both poles and shapes of the two modes are then the same: the state matrix is
    // defective.
    struct Case
    {
        double jointStiffness, jointDamping, frequency, q, skinDamping;
    };
    for (const Case& c :
         {Case{3191.3457364924348, 3.108475429087094, 97.13237358061636, 2.1900997670248, 2.3842159303518624},
          Case{54797.91933562978, 9.409472519606872, 370.8546400437932, 8.0569908982927, 3.9332544652436114},
          Case{7477.961445050422, 4.284697790280788, 143.8705200360761, 5.040817569490104, 1.109887222955111}})
    {
        BodyParams body;
        body.jointStiffness = c.jointStiffness;
        body.jointDamping = c.jointDamping;
        body.skinDamping = c.skinDamping;
        const auto chain = makeBodyChain(body, {c.frequency, c.q});
        const auto groups = findPoleGroups(chain.denominator(RealPolynomial::identity()));
        double closest = HUGE_VAL;
        for (std::size_t i = 0; i < groups.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                closest = std::min(closest, std::abs(groups[i].centre / groups[j].centre - 1.0) +
                                                std::abs(groups[i].spread / groups[j].spread - 1.0));
        REQUIRE(closest < 1e-6);
        const double error = holdError(chain, 48000.0, 2000);
        CAPTURE(closest, error);
        CHECK(error <= 2e-6);
        for (const Limit& limit : rateLimits)
            for (const BodyPoint point : bodyPoints)
                CHECK(responseError(chain, point, limit.fs) <= 0.01 * limit.error);
    }
}
