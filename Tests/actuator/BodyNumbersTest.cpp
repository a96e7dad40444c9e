// The numbers of body models: chains, their poles and modes, filters, plans and what is felt.

#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/actuator/PoleGroups.h>
#include <pacini/actuator/TravelModes.h>
#include <pacini/actuator/Wearer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{

struct BodyExample
{
    std::string name;
    BodyParams body;
    Resonance resonance;
};

/// Unlike each other: a wristband, a stiff joint, an overdamped actuator on damped skin, a heavy device with a sharp
/// resonance, free in the air, all slow.
std::vector<BodyExample> bodyExamples()
{
    return {
        {"wristband", {1.342, 0.012, 0.040, 4.0e4, 5.0, 0.010, 800.0, 2.5}, {67.0, 3.97}},
        {"stiff", {2.0, 0.01, 0.05, 3.0e8, 20.0, 0.02, 500.0, 3.0}, {150.0, 8.0}},
        {"overdamped", {1.0, 0.02, 0.03, 2.0e3, 30.0, 0.01, 900.0, 40.0}, {90.0, 0.2}},
        {"heavy", {5.0, 0.001, 1.0, 1.0e6, 2.0, 0.3, 2000.0, 8.0}, {235.0, 40.0}},
        {"free", {1.0, 0.012, 0.040, 1.0e5, 1.0, 0.010, 0.0, 0.0}, {65.0, 4.0}},
        {"slow", {0.1, 0.5, 0.3, 40.0, 0.2, 0.6, 10.0, 9.0}, {1.5, 0.45}},
    };
}

constexpr std::array examplePoints = {BodyPoint::movingMass, BodyPoint::device, BodyPoint::skin, BodyPoint::excursion};

/// The order of size of a number with its sign, so that small ones count beside large ones.
double orderOf(double x)
{
    return std::asinh(1e9 * x);
}

void addTo(std::vector<double>& numbers, const std::complex<double>& z)
{
    numbers.push_back(z.real());
    numbers.push_back(z.imag());
}

/// The slowest first: rounding decides which are found first.
std::vector<PoleGroup> bySpeed(const PoleGroupList& groups)
{
    std::vector<PoleGroup> sorted(groups.begin(), groups.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const PoleGroup& x, const PoleGroup& y) { return x.slowest() < y.slowest(); });
    return sorted;
}

} // namespace

TEST_CASE("Responses of body chains stay as they were", "[actuator][body]")
{
    for (const auto& [name, body, resonance] : bodyExamples())
        for (const BodyForce driven : {BodyForce::coil, BodyForce::device})
            for (const BodyShape shape : {BodyShape::elastic, BodyShape::rigid, BodyShape::skinless})
            {
                auto chain = makeBodyChain(body, resonance, driven);
                CHECK(chain.driven == driven);
                CHECK(chain.shape == BodyShape::elastic);
                chain.shape = shape;
                std::vector<double> numbers;
                for (const BodyPoint point : examplePoints)
                    for (const double f : {0.0, 3.0, 71.0, 900.0})
                        addTo(numbers, (point == BodyPoint::excursion ? 1e5 : 1.0) * chain.response(point, Hertz(f)));
                checkPinned("actuator/body response, " + name + (driven == BodyForce::coil ? ", coil " : ", device ") +
                                std::to_string(static_cast<int>(shape)),
                            numbers);
            }
}

TEST_CASE("A chain has the numbers of its body, with the suspension of its resonance, clamped to what can be reckoned",
          "[actuator][body]")
{
    CHECK(BodyChain{} ==
          BodyChain{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, BodyShape::elastic, BodyForce::coil});
    const BodyParams body{3.0, 0.02, 0.3, 4e4, 5.0, 0.6, 700.0, 8.0};
    const auto chain = makeBodyChain(body, {50.0, 4.0});
    const double w = 100.0 * std::numbers::pi;
    CHECK(chain.force == 3.0);
    CHECK(chain.movingMass == 0.02);
    CHECK(chain.suspensionStiffness == Approx(0.02 * w * w).epsilon(1e-14));
    CHECK(chain.suspensionDamping == Approx(0.02 * w / 4.0).epsilon(1e-14));
    CHECK(test::asNumbers(chain.deviceMass, chain.jointStiffness, chain.jointDamping, chain.skinMass,
                          chain.skinStiffness, chain.skinDamping) == test::Numbers{0.3, 4e4, 5.0, 0.6, 700.0, 8.0});
    CHECK(chain.jointFrequency().value == Approx(std::sqrt(4e4 * (1.0 / 0.3 + 1.0 / 0.6)) / (2.0 * std::numbers::pi)));

    const auto ends = [&](double BodyParams::*member, double BodyChain::*result, double low, double high)
    {
        for (const auto& [value, wanted] :
             {std::pair(low, low), std::pair(high, high), std::pair(0.7 * high, 0.7 * high),
              std::pair(3.0 * high, high), std::pair(low - std::max(0.1, std::abs(low)), low)})
        {
            CAPTURE(value, wanted);
            BodyParams other = body;
            other.*member = value;
            CHECK(makeBodyChain(other, {50.0, 4.0}).*result == wanted);
        }
        if (low > 0.0)
        {
            BodyParams other = body;
            other.*member = 1.5 * low;
            CHECK(makeBodyChain(other, {50.0, 4.0}).*result == 1.5 * low);
        }
    };
    ends(&BodyParams::force, &BodyChain::force, -1e6, 1e6);
    ends(&BodyParams::movingMass, &BodyChain::movingMass, 1e-9, 1e3);
    ends(&BodyParams::deviceMass, &BodyChain::deviceMass, 1e-9, 1e3);
    ends(&BodyParams::skinMass, &BodyChain::skinMass, 1e-9, 1e3);
    ends(&BodyParams::jointStiffness, &BodyChain::jointStiffness, 1e-3, 1e14);
    ends(&BodyParams::jointDamping, &BodyChain::jointDamping, 0.0, 1e10);
    ends(&BodyParams::skinDamping, &BodyChain::skinDamping, 0.0, 1e10);
    const double lowest = (0.02 + 0.3 + 0.6) * std::pow(0.02 * std::numbers::pi, 2.0);
    for (const auto& [value, wanted] :
         {std::pair(0.0, lowest), std::pair(1.1 * lowest, 1.1 * lowest), std::pair(1e15, 1e14)})
    {
        BodyParams other = body;
        other.skinStiffness = value;
        CHECK(makeBodyChain(other, {50.0, 4.0}).skinStiffness == Approx(wanted).epsilon(1e-12));
    }
    const auto suspended = [&](const Resonance& a, const Resonance& b)
    {
        return makeBodyChain(body, a) == makeBodyChain(body, b);
    };
    CHECK(suspended({0.01, 4.0}, {0.1, 4.0}));
    CHECK_FALSE(suspended({0.11, 4.0}, {0.1, 4.0}));
    CHECK(suspended({1e6, 4.0}, {1e5, 4.0}));
    CHECK_FALSE(suspended({0.9e5, 4.0}, {1e5, 4.0}));
    CHECK(suspended({50.0, 1e-4}, {50.0, 1e-3}));
    CHECK_FALSE(suspended({50.0, 1.1e-3}, {50.0, 1e-3}));
    CHECK(suspended({50.0, 1e5}, {50.0, 1e4}));
    CHECK_FALSE(suspended({50.0, 0.9e4}, {50.0, 1e4}));
}

TEST_CASE("Pole groups and modes of body chains stay as they were, in their order", "[actuator][body]")
{
    for (const auto& [name, body, resonance] : bodyExamples())
        for (const BodyForce driven : {BodyForce::coil, BodyForce::device})
        {
            auto chain = makeBodyChain(body, resonance, driven);
            const std::string which = name + (driven == BodyForce::coil ? ", coil" : ", device");
            std::vector<double> numbers;
            for (const PoleGroup& group : bySpeed(findPoleGroups(chain.denominator(RealPolynomial::identity()))))
                for (const double number :
                     {group.centre, group.spread, group.single ? 1.0 : 0.0, group.slowest(), group.fastest()})
                    numbers.push_back(orderOf(number));
            checkPinned("actuator/pole groups, " + which, numbers);
            if (driven == BodyForce::device)
                continue;
            numbers.clear();
            for (const TravelMode& mode : travelModes(chain))
            {
                const auto rest = mode.rest();
                const auto step = mode.step(1e-3);
                for (const double number :
                     {mode.w, mode.q, mode.toX, mode.toV, mode.single ? 1.0 : 0.0, rest.displacement, rest.velocity,
                      mode.push(), mode.worst(), step.xx, step.xv, step.vx, step.vv, step.driveToX, step.driveToV})
                    numbers.push_back(orderOf(number));
            }
            checkPinned("actuator/travel modes, " + which, numbers);
            checkPinned("actuator/worst travel, " + which, {worstTravel(chain)});
        }
}

TEST_CASE("Two real poles of an actuator are one mode where that says less of a constant drive", "[actuator]")
{
    for (const double q : {0.05, 0.15, 0.3, 0.45, 0.49, 0.5, 0.51})
    {
        std::vector<double> numbers;
        for (const double damping : {0.5, 20.0, 300.0})
        {
            BodyParams body;
            body.skinDamping = damping;
            body.jointDamping = 2.0 * damping;
            const auto modes = travelModes(makeBodyChain(body, {80.0, q}));
            double before = 0.0;
            for (const TravelMode& mode : modes)
            {
                CHECK(mode.w >= before); // the slowest first
                before = mode.w;
                for (const double number : {mode.single ? 1.0 : mode.q, mode.worst(), mode.push()})
                    numbers.push_back(orderOf(number));
            }
        }
        checkPinned("actuator/travel of damped chain, " + std::to_string(q), numbers, 1e-6);
    }
}

TEST_CASE("A mode of one real pole is a first-order lag", "[actuator]")
{
    CHECK(TravelMode{}.w == 1.0);
    CHECK(TravelMode{}.q == 1.0);
    CHECK(TravelMode{}.toX == 0.0);
    CHECK(TravelMode{}.toV == 0.0);
    CHECK_FALSE(TravelMode{}.single);
    TravelMode mode;
    mode.single = true;
    mode.w = 50.0;
    mode.toX = -3.0;
    mode.toV = 7.0; // none counts
    CHECK(mode.rest().displacement == -0.06);
    CHECK(mode.rest().velocity == 0.0);
    CHECK(mode.worst() == 0.06);
    const HeldStep step = mode.step(0.01);
    CHECK(step.xx == Approx(std::exp(-0.5) - 1.0).epsilon(1e-14));
    CHECK(step.driveToX == Approx(-0.06 * (1.0 - std::exp(-0.5))).epsilon(1e-14));
    CHECK(step.xv == 0.0);
    CHECK(step.vx == 0.0);
    CHECK(step.vv == 0.0);
    CHECK(step.driveToV == 0.0);
}

TEST_CASE("The rest of a mode is where its equations stand still, and its push the size of their drive", "[actuator]")
{
    for (const double q : {0.1, 0.5, 0.5000001, 0.50001, 3.0, 200.0})
    {
        std::vector<double> worst;
        for (const double angle : {0.0, 0.7, 1.5707, 2.5, 3.14159, 4.0, 5.5})
        {
            CAPTURE(q, angle);
            TravelMode mode;
            mode.w = 300.0;
            mode.q = q;
            mode.toX = 2.0 * std::cos(angle);
            mode.toV = 2.0 * std::sin(angle);
            const auto z = mode.rest();
            CHECK(mode.w * z.velocity + mode.toX == Approx(0.0).margin(1e-12));
            CHECK(-mode.w * z.displacement - mode.w / mode.q * z.velocity + mode.toV == Approx(0.0).margin(1e-12));
            CHECK(mode.push() == Approx(2.0).epsilon(1e-14));
            worst.push_back(mode.worst());
        }
        checkPinned("actuator/worst of a mode, " + std::to_string(q), worst, 1e-5);
    }
}

TEST_CASE("Filters of bodies stay as they were, by either hold", "[actuator][body]")
{
    for (const auto& [name, body, resonance] : bodyExamples())
        for (const double fs : {2000.0, 8000.0, 48000.0})
            for (const BodyHold hold : {BodyHold::corrected, BodyHold::linear})
            {
                std::vector<double> numbers;
                for (const BodyForce driven : {BodyForce::coil, BodyForce::device})
                    for (const BodyPoint point : examplePoints)
                    {
                        const auto chain = makeBodyChain(body, resonance, driven);
                        const auto filter = designBodyModel(chain, point, fs, hold);
                        for (const double f : {0.0, 20.0, 66.0, 300.0, 999.0})
                        {
                            // The device alone has no travel.
                            const double size = std::abs(chain.response(point, Hertz(f > 0.0 ? f : 66.0)));
                            addTo(numbers, filter.response(Hertz(f), fs) / (size > 0.0 ? size : 1.0));
                        }
                        numbers.push_back(static_cast<double>(filter.sections.size()));
                    }
                checkPinned("actuator/body filter, " + name + " " + std::to_string(static_cast<int>(fs)) + " " +
                                std::to_string(static_cast<int>(hold)),
                            numbers, 1e-6);
            }
}

TEST_CASE("A filter of any numbers runs as its difference equations say, and answers as its transform",
          "[actuator][body]")
{
    for (std::size_t count = 0; count <= 3; ++count)
    {
        CAPTURE(count);
        BodyModelCoefficients c;
        c.tap = {0.5, -0.25, 2.0, 0.75, -1.5};
        for (std::size_t k = 0; k < count; ++k)
        {
            const double j = static_cast<double>(k + 1);
            c.sections.pushBack({0.3 + 0.1 * j, -0.2 * j, 0.25, 0.5 - 0.1 * j, 0.7 * j, 1.5 - j, 0.4 + j});
        }
        std::vector<float> x(700, 0.0f);
        for (std::size_t n = 0; n < 60; ++n)
            x[n] = static_cast<float>(std::sin(0.37 * static_cast<double>(n * n)));
        std::vector<double> wanted;
        std::array<double, 3> x1{}, x2{};
        const auto at = [&](std::size_t n, std::size_t late)
        {
            return n >= late ? static_cast<double>(x[n - late]) : 0.0;
        };
        for (std::size_t n = 0; n < x.size(); ++n)
        {
            double y = 0.0;
            for (std::size_t i = 0; i < 5; ++i)
                y += c.tap[i] * at(n, i);
            for (std::size_t k = 0; k < count; ++k)
            {
                const BodySection& s = c.sections[k];
                y += s.out1 * x1[k] + s.out2 * x2[k];
                const double a = s.a * x1[k] + s.b * x2[k] + s.g * at(n, 2), b = s.c * x1[k] + s.d * x2[k] + at(n, 2);
                x1[k] = a;
                x2[k] = b;
            }
            wanted.push_back(y);
        }
        BodyFilter filter;
        filter.setCoefficients(c);
        CHECK(filter.coefficients() == c);
        std::vector<float> y(x.size());
        filter.process(std::span<const float>(x).first(33), std::span(y).first(33));
        filter.process(std::span<const float>(x).subspan(33), std::span(y).subspan(33));
        for (std::size_t n = 0; n < x.size(); ++n)
            REQUIRE(static_cast<double>(y[n]) == Approx(wanted[n]).margin(1e-6));
        filter.setCoefficients(c); // from rest
        float first = 1.0f;
        filter.process(std::span(&first, 1), std::span(&first, 1));
        CHECK(first == 0.5f);
        filter.reset();
        first = 1.0f;
        filter.process(std::span(&first, 1), std::span(&first, 1));
        CHECK(first == 0.5f);

        // The transform of the impulse response.
        filter.reset();
        std::vector<float> h(800, 0.0f);
        h[0] = 1.0f;
        filter.process(h, h);
        for (const double f : {0.0, 37.0, 250.0, 500.0})
        {
            std::complex<double> sum = 0.0;
            for (std::size_t n = 0; n < h.size(); ++n)
                sum += static_cast<double>(h[n]) *
                       std::polar(1.0, -2.0 * std::numbers::pi * f / 1000.0 * static_cast<double>(n));
            CHECK(std::abs(sum - c.response(Hertz(f), 1000.0)) < 1e-5);
        }
    }
    CHECK(BodySection{} == BodySection{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
}

TEST_CASE("What is left out of a body, and at what cost, stays as it was", "[actuator][body]")
{
    for (const auto& [name, body, resonance] : bodyExamples())
    {
        std::vector<double> numbers;
        BodyParams loose = body;
        loose.deviceMass *= 300.0;
        loose.skinMass *= 1e-3;
        loose.skinDamping *= 1e-3;
        for (const double stiffer : {1.0, 30.0, 1e4, 1e7})
            for (const BodyParams& start : {body, loose})
                for (const double tolerance : {-80.0, -50.0, -20.0})
                    for (const BodyPoint point : {BodyPoint::skin, BodyPoint::excursion})
                    {
                        BodyParams one = start;
                        one.jointStiffness *= stiffer;
                        const auto plan = planBody(one, resonance, Decibels(tolerance), point);
                        const std::string part = plan.omissions.empty() ? "" : std::string(plan.omissions[0].part);
                        CHECK(part == (plan.chain.shape == BodyShape::elastic ? ""
                                       : plan.chain.shape == BodyShape::rigid ? "joint"
                                                                              : "skin"));
                        numbers.push_back(static_cast<double>(plan.chain.shape));
                        numbers.push_back(plan.omissions.empty() ? 0.0 : plan.omissions[0].predictedError);
                    }
        checkPinned("actuator/body plan, " + name, numbers, 1e-5);
        const auto chain = makeBodyChain(body, resonance);
        auto rigid = chain;
        rigid.shape = BodyShape::rigid;
        numbers.clear();
        for (const double f : comparedFrequencies(chain, rigid))
            numbers.push_back(f);
        std::sort(numbers.begin(), numbers.end());
        checkPinned("actuator/compared frequencies, " + name, numbers);
        numbers.resize(5);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i] = relativeDifference(chain, rigid, examplePoints[i % 4], 30.0 + 100.0 * static_cast<double>(i));
        checkPinned("actuator/cost of a rigid joint, " + name, numbers, 1e-6);
    }
    CHECK(BodyOmission{}.predictedError == 0.0);
    CHECK(BodyOmission{}.part.empty());
    // A response of 0 is no divisor.
    auto nothing = makeBodyChain({}, {});
    nothing.force = 0.0;
    CHECK(relativeDifference(nothing, nothing, BodyPoint::skin, 100.0) == 0.0);
}

TEST_CASE("A body model is designed for its parameters and its rate, and starts from rest with new ones alone",
          "[actuator][body]")
{
    BodyModelParams params;
    CHECK(params == BodyModelParams{BodyParams{}, Resonance{}, BodyPoint::skin, BodyForce::coil, Decibels(-60.0)});
    BodyModel model;
    model.prepare({8000.0, 64});
    model.setParams(params);
    CHECK(model.coefficients() == designBodyModel(planBody({}, {}).chain, BodyPoint::skin, 8000.0));
    CHECK(model.latencyFrames() == 2);
    std::vector<float> x(64, 0.5f), y(64);
    model.process(x, y);
    model.setParams(params); // the same ones: it goes on
    std::vector<float> rest(64, 0.0f);
    model.process(rest, y);
    CHECK(y[10] != 0.0f);
    params.body.force = 2.0;
    params.point = BodyPoint::device;
    params.driven = BodyForce::device;
    params.tolerance = Decibels(-20.0);
    model.setParams(params);
    model.process(rest, y);
    CHECK(y == rest);
    const auto plan = planBody(params.body, {}, Decibels(-20.0), BodyPoint::device, BodyForce::device);
    CHECK(model.plan().chain == plan.chain);
    CHECK(model.coefficients() == designBodyModel(plan.chain, BodyPoint::device, 8000.0));
    model.process(x, y);
    model.reset();
    model.process(rest, y);
    CHECK(y == rest);
}

TEST_CASE("What is felt of a profile is that of its motor or its coil, and starts anew after a reset",
          "[actuator][body]")
{
    Profile profile;
    profile.body = BodyParams{};
    profile.resonance = {120.0, 6.0};
    profile.response = {0.03, 0.05};
    for (const Technology technology :
         {Technology::erm, Technology::lra, Technology::piezo, Technology::eap, Technology::vca, Technology::pcm})
    {
        const bool spins = technology == Technology::erm;
        profile.technology = technology;
        const auto params = feltModelParams(profile, BodyPoint::device, Decibels(-50.0));
        REQUIRE(params.has_value());
        CHECK(params->technology == technology);
        CHECK(params->response == profile.response);
        CHECK(params->body == BodyModelParams{BodyParams{}, profile.resonance, BodyPoint::device,
                                              spins ? BodyForce::device : BodyForce::coil, Decibels(-50.0)});
        CHECK(feltModelParams(profile)->body.point == BodyPoint::skin);
        CHECK(feltModelParams(profile)->body.tolerance == Decibels(-60.0));

        FeltModelParams turned = *params; // the technology alone says what is driven
        turned.body.driven = spins ? BodyForce::coil : BodyForce::device;
        std::vector<float> x(800);
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] = n < 500 ? static_cast<float>(0.8 + 0.2 * std::sin(0.3 * static_cast<double>(n))) : 0.0f;
        const auto run = [&](const FeltModelParams& p, FeltModel& felt)
        {
            felt.setParams(p);
            felt.prepare({8000.0, 800});
            std::vector<float> y(x.size());
            felt.process(x, y);
            return y;
        };
        FeltModel felt, other;
        const auto y = run(*params, felt);
        CHECK(run(turned, other) == y);
        felt.reset();
        std::vector<float> again(x.size());
        felt.process(x, again);
        CHECK(again == y);
        CHECK(felt.latencyFrames() == 2);
        CHECK(felt.plan().chain.driven == (spins ? BodyForce::device : BodyForce::coil));
        checkPinned(std::string("actuator/felt, ") + (spins ? "motor" : "coil"),
                    std::vector<double>(y.begin(), y.end()), 1e-5);
    }
    CHECK(FeltModelParams{}.technology == Technology::vca);
}

TEST_CASE("The simulated wearers stay the same people", "[wearer]")
{
    CHECK(simulatedWearers == 14);
    std::vector<double> numbers;
    for (unsigned wearer = 0; wearer <= simulatedWearers; ++wearer)
    {
        BodyParams one;
        one.skinMass = one.skinStiffness = one.skinDamping = 1.0;
        const BodyParams worn = bodyOn(wearer, one);
        numbers.insert(numbers.end(), {worn.skinMass, worn.skinStiffness, worn.skinDamping});
    }
    checkPinned("actuator/wearers", numbers);
    checkPinned("actuator/wearer 3", std::span<const double>(numbers).subspan(9, 3));
}

TEST_CASE("Roots of polynomials that are no chain's are found as well", "[actuator]")
{
    const std::vector<std::vector<double>> polynomials{
        {1.0, 1.0},            // a single real one
        {6.0, 5.0, 1.0},       // -2 and -3: close, one group
        {20.0, 12.0, 1.0},     // -2 and -10: apart
        {5.0, 2.0, 1.0},       // a conjugate pair
        {4.0, 4.0, 1.0},       // critical
        {1.0, 2.0, 2.0, 1.0},  // Butterworth of third order
        {1e6, 3e5, 2e3, 10.0}, // with a leading coefficient
        {1.0, 2.61312593, 3.41421356, 2.61312593, 1.0},
        {1e-8, 1.0, 1e3, 1.0},     // eleven decades
        {4.0, 0.0, 5.0, 0.0, 1.0}, // undamped
        {1.0, 3.86370331, 7.46410162, 9.14162017, 7.46410162, 3.86370331, 1.0},
    };
    for (std::size_t i = 0; i < polynomials.size(); ++i)
    {
        RealPolynomial p;
        for (std::size_t k = 0; k < polynomials[i].size(); ++k)
            p.c[k] = polynomials[i][k];
        std::vector<double> numbers;
        std::size_t found = 0;
        for (const PoleGroup& group : bySpeed(findPoleGroups(p)))
        {
            found += group.single ? 1 : 2;
            numbers.insert(numbers.end(), {group.centre, group.spread, group.single ? 1.0 : 0.0});
        }
        CHECK(found == p.degree());
        if (i != 5 && i != 7 && i < 9) // of those all are as fast, or undamped: rounding orders them
            checkPinned("actuator/roots " + std::to_string(i), numbers, 1e-6);
        numbers.clear();
        for (const auto& root : detail::guessRoots(p))
            addTo(numbers, root);
        if (i < 9) // nothing lies exactly on the hull
            checkPinned("actuator/guesses " + std::to_string(i), numbers);
        numbers.clear();
        for (const auto& root : detail::findRoots(p))
        {
            numbers.push_back(std::abs(root));
            CHECK(std::abs(p.at(root)) < 1e-9 * (p.c[0] + std::pow(std::abs(root), static_cast<double>(p.degree()))));
        }
    }
}

TEST_CASE("Numbers of pole groups follow the rules of complex numbers", "[actuator]")
{
    using Complex = std::complex<double>;
    const double spread = -4.0; // e = 2 i
    const auto asComplex = [](const PoleNumber& x)
    {
        return Complex(x.a, 2.0 * x.b);
    };
    const PoleNumber x{1.5, -0.5, spread}, y{-2.0, 0.75, spread};
    const auto same = [&](const PoleNumber& found, const Complex& wanted)
    {
        CHECK(found.spread == spread);
        CHECK(std::abs(asComplex(found) - wanted) < 1e-14);
    };
    same(x + y, asComplex(x) + asComplex(y));
    same(x + 3.0, asComplex(x) + 3.0);
    same(3.0 * x, 3.0 * asComplex(x));
    same(x * y, asComplex(x) * asComplex(y));
    same(x / y, asComplex(x) / asComplex(y));
    // Two real poles: the values there are a + 3 b and a - 3 b.
    const PoleNumber u{1.5, -0.25, 9.0}, v{-2.0, 0.5, 9.0};
    const auto ends = [](const PoleNumber& n)
    {
        return std::pair(n.a + 3.0 * n.b, n.a - 3.0 * n.b);
    };
    const PoleNumber quotient = u / v, product = u * v;
    CHECK(ends(quotient).first == Approx(ends(u).first / ends(v).first));
    CHECK(ends(quotient).second == Approx(ends(u).second / ends(v).second));
    CHECK(ends(product).first == Approx(ends(u).first * ends(v).first));
    CHECK(ends(product).second == Approx(ends(u).second * ends(v).second));
    CHECK(PoleNumber{}.a == 0.0);
    CHECK(PoleNumber{}.b == 0.0);
    CHECK(PoleNumber{}.spread == 0.0);
    CHECK(PoleGroup{} == PoleGroup{0.0, 0.0, false});

    CHECK(PoleGroup{-3.0, -16.0}.slowest() == 5.0);
    CHECK(PoleGroup{-3.0, -16.0}.fastest() == 5.0);
    CHECK(PoleGroup{-3.0, 4.0}.slowest() == 1.0);
    CHECK(PoleGroup{-3.0, 4.0}.fastest() == 5.0);
    CHECK(PoleGroup{-3.0, 0.0, true}.fastest() == 3.0);
    CHECK(PoleGroup{-3.0, 4.0, true}.perFrame(0.5) == PoleGroup{-1.5, 1.0, true});
    CHECK(valueAt({-3.0, 4.0}).b == 1.0);
    CHECK(valueAt({-3.0, 0.0, true}).b == 0.0);
    CHECK(valueAt({-3.0, 4.0}).a == -3.0);
    CHECK(valueAt({-3.0, 4.0}).spread == 4.0);

    // (s + 1)(s + 5) at the poles -2 and -4 of another group, and at a single one.
    const PoleNumber factor = factorAt({-3.0, 4.0}, {-3.5, 1.0});
    CHECK(factor.a + factor.b == Approx((-2.5 + 1.0) * (-2.5 + 5.0)));
    CHECK(factor.a - factor.b == Approx((-4.5 + 1.0) * (-4.5 + 5.0)));
    CHECK(factor.spread == 1.0);
    const PoleNumber alone = factorAt({-3.0, 4.0}, {-7.0, 0.0, true});
    CHECK(alone.a == Approx(-6.0 * -2.0));
    CHECK(alone.b == 0.0);
    const PoleNumber single = factorAt({-3.0, 0.0, true}, {-3.5, 1.0});
    CHECK(single.a == -0.5);
    CHECK(single.b == 1.0);
    CHECK(factorAt({-3.0, 0.0, true}, {-7.0, 0.0, true}).a == -4.0);
    CHECK(factorAt({-3.0, 0.0, true}, {-7.0, 0.0, true}).b == 0.0);
    PoleGroupList groups;
    groups.pushBack({-3.0, 4.0});
    groups.pushBack({-9.0, 0.0, true});
    groups.pushBack({-3.5, 1.0});
    const PoleNumber others = otherFactors(groups, 2);
    CHECK(others.a + others.b == Approx((-2.5 + 1.0) * (-2.5 + 5.0) * (-2.5 + 9.0)));
    CHECK(others.a - others.b == Approx((-4.5 + 1.0) * (-4.5 + 5.0) * (-4.5 + 9.0)));

    for (const double root : {0.0, 1e-9, 0.5, 0.999, 1.0, 1.001, 4.0})
    {
        CAPTURE(root);
        const PoleNumber e = expAt({-5.0, root * root});
        CHECK(e.a == Approx(0.5 * (std::exp(-5.0 + root) + std::exp(-5.0 - root))).epsilon(1e-14));
        CHECK(e.b == Approx(std::exp(-5.0) * (root > 0.0 ? std::sinh(root) / root : 1.0)).epsilon(1e-13));
        CHECK(e.spread == root * root);
    }
    CHECK(expAt({-0.5, 0.0, true}).a == std::exp(-0.5));
    CHECK(expAt({-0.5, 0.0, true}).b == 0.0);
    for (const double centre : {-0.4, -0.999, -1.001, -30.0})
    {
        const PoleNumber one = phiAt({centre, 0.0, true}, 1), two = phiAt({centre, 0.0, true}, 2);
        CHECK(one.a == Approx(std::expm1(centre) / centre).epsilon(1e-13));
        CHECK(two.a == Approx((std::expm1(centre) - centre) / (centre * centre)).epsilon(1e-12));
    }
}
