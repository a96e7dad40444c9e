#pragma once

// Bodies to try, and their discretisation by a matrix exponential in long double: slow, and unlike the code under test.

#include <pacini/actuator/BodyChain.h>
#include <pacini/foundation/Random.h>

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace pacini::test
{

#if defined(__SANITIZE_ADDRESS__)
inline constexpr int bodyDraws = 100;
#else
inline constexpr int bodyDraws = 2000;
#endif

struct DrawnBody
{
    BodyParams body;
    Resonance resonance{65.93, 3.969};
};

/// Sets the damping of a body's joint to a ratio of the critical.
inline void setJointDampingRatio(BodyParams& body, double ratio)
{
    const double reduced = body.deviceMass * body.skinMass / (body.deviceMass + body.skinMass);
    body.jointDamping = 2.0 * ratio * std::sqrt(body.jointStiffness * reduced);
}

/// Joints of 1e4-1e12 N/m with damping ratios of 1e-4 to 2; every second draw with other masses, skins and actuators.
class BodyDraws
{
public:
    DrawnBody next()
    {
        DrawnBody drawn;
        BodyParams& body = drawn.body;
        body.jointStiffness = between(1e4, 1e12);
        const double ratio = between(1e-4, 2.0);
        if (++count % 2 == 0)
        {
            body.movingMass *= between(0.3, 3.0);
            body.deviceMass *= between(0.2, 10.0);
            body.skinMass *= between(0.3, 3.0);
            body.skinStiffness *= between(0.2, 5.0);
            body.skinDamping *= between(0.1, 10.0);
            drawn.resonance = {between(40.0, 300.0), between(0.3, 30.0)};
        }
        setJointDampingRatio(body, ratio);
        return drawn;
    }

private:
    double between(double low, double high) { return low * std::pow(high / low, random.uniform()); }

    Random random{20201};
    int count = 0;
};

/// A chain's output at every frame for a force that is linear between frames, by stepping the equations of motion with
/// their matrix exponential. Its coordinates are the stretches of suspension and joint and the place of the skin, so
/// that a stiff joint does not wipe out the slow motion; velocities count per 1/`scale` s to balance the matrix.
class ReferenceBody
{
public:
    using Real = long double;
    using Matrix = Eigen::Matrix<Real, 8, 8>;
    using Vector = Eigen::Matrix<Real, 8, 1>;

    ReferenceBody(const BodyChain& c, double fs) : chain(c)
    {
        const Real scale[3] = {std::sqrt(Real(c.suspensionStiffness) / Real(c.movingMass)),
                               std::sqrt(Real(c.jointStiffness) / Real(std::min(c.deviceMass, c.skinMass))),
                               std::sqrt(Real(c.jointStiffness) / Real(c.skinMass))};
        // Column by column: the accelerations that a unit of each state causes.
        Matrix m = Matrix::Zero();
        for (int i = 0; i < 3; ++i)
        {
            velocityScale[i] = scale[i];
            m(i, 3 + i) = scale[i];
        }
        for (int i = 0; i < 7; ++i)
        {
            Vector state = Vector::Zero();
            state[i] = 1;
            const auto a = accelerations(state);
            m(3, i) = (a.mass - a.device) / scale[0];
            m(4, i) = (a.device - a.skin) / scale[1];
            m(5, i) = a.skin / scale[2];
        }
        m *= Real(1) / Real(fs);
        m(6, 7) = 1;
        int squarings = 0;
        for (Real norm = m.cwiseAbs().rowwise().sum().maxCoeff(); norm > Real(0.25); norm /= 2)
            ++squarings;
        m *= std::ldexp(Real(1), -squarings);
        step = Matrix::Identity();
        for (int k = 20; k > 0; --k)
            step = Matrix::Identity() + (m * step / Real(k)).eval();
        for (int i = 0; i < squarings; ++i)
            step = (step * step).eval();
    }

    std::vector<double> run(std::span<const double> force, BodyPoint point) const
    {
        std::vector<double> out;
        Vector state = Vector::Zero();
        for (std::size_t n = 0; n < force.size(); ++n)
        {
            state[6] = Real(force[n]);
            const auto a = accelerations(state);
            out.push_back(static_cast<double>(point == BodyPoint::movingMass ? a.mass
                                              : point == BodyPoint::device   ? a.device
                                              : point == BodyPoint::skin     ? a.skin
                                                                             : state[0]));
            state[7] = Real(n + 1 < force.size() ? force[n + 1] : 0.0) - state[6];
            state = (step * state).eval();
        }
        return out;
    }

private:
    struct Accelerations
    {
        Real mass, device, skin;
    };
    Accelerations accelerations(const Vector& s) const
    {
        const Real force = Real(chain.force) * s[6];
        const Real suspension =
            Real(chain.suspensionStiffness) * s[0] + Real(chain.suspensionDamping) * velocityScale[0] * s[3];
        const Real joint = Real(chain.jointStiffness) * s[1] + Real(chain.jointDamping) * velocityScale[1] * s[4];
        const Real skin = Real(chain.skinStiffness) * s[2] + Real(chain.skinDamping) * velocityScale[2] * s[5];
        return {(force - suspension) / Real(chain.movingMass), (-force + suspension - joint) / Real(chain.deviceMass),
                (joint - skin) / Real(chain.skinMass)};
    }

    BodyChain chain;
    Real velocityScale[3]{};
    Matrix step;
};

} // namespace pacini::test
