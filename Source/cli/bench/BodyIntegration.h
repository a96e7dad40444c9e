#pragma once

// Numerical integration of the body model (Euler, Runge-Kutta, trapezoidal), to compare its filter with.

#include <pacini/actuator/BodyChain.h>
#include <pacini/foundation/DspBlock.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini::cli
{

/// Method of numerical integration.
enum class BodyIntegrator
{
    semiImplicitEuler, ///< velocities first, then positions with the new velocities (L. Euler; symplectic)
    rungeKutta4,       ///< the classic one (W. Kutta, 1901), the force in the middle interpolated
    trapezoidal,       ///< implicit; as a filter it is the bilinear transform (A. Tustin, 1947)
    matrixExponential  ///< exact for a force that is linear between frames, by scaling and squaring
};

/// State-space form of the body model. Positions and velocities of moving mass, device and skin: x' = a x + b u.
struct BodyStateSpace
{
    using Matrix = Eigen::Matrix<double, 6, 6>;
    using Vector = Eigen::Matrix<double, 6, 1>;
    Matrix a = Matrix::Zero();
    Vector b = Vector::Zero();
};

/// The equations of motion of a whole chain, driven by its coil, for a drive u.
[[nodiscard]] inline BodyStateSpace bodyStateSpace(const BodyChain& chain) noexcept
{
    assert(chain.shape == BodyShape::elastic && chain.driven == BodyForce::coil);
    const Eigen::Vector3d inverseMass(1.0 / chain.movingMass, 1.0 / chain.deviceMass, 1.0 / chain.skinMass);
    const auto coupled = [](double suspension, double joint, double skin)
    {
        Eigen::Matrix3d m;
        m << suspension, -suspension, 0.0,           //
            -suspension, suspension + joint, -joint, //
            0.0, -joint, joint + skin;
        return m;
    };
    BodyStateSpace system;
    system.a.topRightCorner<3, 3>().setIdentity();
    system.a.bottomLeftCorner<3, 3>() =
        -(inverseMass.asDiagonal() * coupled(chain.suspensionStiffness, chain.jointStiffness, chain.skinStiffness));
    system.a.bottomRightCorner<3, 3>() =
        -(inverseMass.asDiagonal() * coupled(chain.suspensionDamping, chain.jointDamping, chain.skinDamping));
    system.b.tail<3>() = chain.force * inverseMass.cwiseProduct(Eigen::Vector3d(1.0, -1.0, 0.0));
    return system;
}

/// The acceleration of the skin in m/s^2 by stepping the equations of motion, one step per frame. Semi-implicit Euler
/// and Runge-Kutta compute the forces anew in every step; trapezoidal rule and matrix exponential multiply by a dense
/// matrix that is computed once. Not for use in products: see designBodyModel.
class BodyIntegration
{
public:
    using Matrix = BodyStateSpace::Matrix;
    using Vector = BodyStateSpace::Vector;

    /// A whole chain driven by its coil, at `sampleRate` Hz.
    BodyIntegration(BodyIntegrator integrator, const BodyChain& chainToRun, double sampleRate) noexcept
        : method(integrator), chain(chainToRun), fs(sampleRate), system(bodyStateSpace(chainToRun))
    {
        designStep();
    }

    /// Spans of equal length. An unstable integrator gives 0 or the largest number in the end.
    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        forEachSample(
            in, out,
            [this](double u)
            {
                x = stepped(x, previous, u);
                previous = u;
                return skinAcceleration(x);
            },
            [this]
            {
                for (double& v : x)
                    flushTiny(v);
            });
    }
    void reset() noexcept
    {
        x.setZero();
        previous = 0.0;
    }

    /// The largest magnitude of an eigenvalue of one step, to 1e-9: the integrator is unstable above 1. By squaring the
    /// matrix (I. M. Gelfand, 1941: the limit of |M^k|^(1/k)).
    [[nodiscard]] double spectralRadius() const
    {
        Matrix power = linearStep().matrix;
        if (!power.allFinite())
            return HUGE_VAL;
        double logRadius = 0.0, weight = 1.0;
        for (int squaring = 0; squaring < 40; ++squaring, weight *= 0.5)
        {
            const double norm = power.norm();
            if (!(norm > 0.0))
                return 0.0;
            logRadius += weight * std::log(norm);
            power /= norm;
            power = (power * power).eval();
        }
        return std::exp(logRadius);
    }

    /// The complex gain at f, the integrator seen as a filter.
    [[nodiscard]] std::complex<double> response(Hertz f) const
    {
        const LinearStep step = linearStep();
        const std::complex<double> z = std::polar(1.0, 2.0 * std::numbers::pi * f.value / fs);
        const Eigen::Matrix<std::complex<double>, 6, 6> resolvent =
            z * Matrix::Identity().cast<std::complex<double>>() - step.matrix.cast<std::complex<double>>();
        const Eigen::Matrix<std::complex<double>, 6, 1> input =
            step.before.cast<std::complex<double>>() + z * step.after.cast<std::complex<double>>();
        const Eigen::Matrix<std::complex<double>, 6, 1> state = resolvent.partialPivLu().solve(input);
        return (system.a.row(5).cast<std::complex<double>>() * state)(0);
    }

private:
    /// x[n + 1] = matrix x[n] + before u[n] + after u[n + 1]
    struct LinearStep
    {
        Matrix matrix;
        Vector before, after;
    };

    /// The coil does not act on the skin, so that there is no u in its acceleration.
    [[nodiscard]] double skinAcceleration(const Vector& state) const noexcept
    {
        return (chain.jointStiffness * (state[1] - state[2]) + chain.jointDamping * (state[4] - state[5]) -
                chain.skinStiffness * state[2] - chain.skinDamping * state[5]) /
               chain.skinMass;
    }

    /// d/dt of the state, spring by spring.
    [[nodiscard]] Vector derivative(const Vector& s, double u) const noexcept
    {
        const double suspension =
            chain.suspensionStiffness * (s[0] - s[1]) + chain.suspensionDamping * (s[3] - s[4]) - chain.force * u;
        const double joint = chain.jointStiffness * (s[1] - s[2]) + chain.jointDamping * (s[4] - s[5]);
        const double skin = chain.skinStiffness * s[2] + chain.skinDamping * s[5];
        Vector d;
        d << s[3], s[4], s[5], -suspension / chain.movingMass, (suspension - joint) / chain.deviceMass,
            (joint - skin) / chain.skinMass;
        return d;
    }

    [[nodiscard]] Vector stepped(const Vector& s, double u0, double u1) const noexcept
    {
        const double h = 1.0 / fs;
        if (method == BodyIntegrator::semiImplicitEuler)
        {
            Vector next = s;
            next.tail<3>() += h * derivative(s, u0).tail<3>();
            next.head<3>() += h * next.tail<3>();
            return next;
        }
        if (method == BodyIntegrator::rungeKutta4)
        {
            const double middle = 0.5 * (u0 + u1);
            const Vector k1 = derivative(s, u0);
            const Vector k2 = derivative(s + 0.5 * h * k1, middle);
            const Vector k3 = derivative(s + 0.5 * h * k2, middle);
            const Vector k4 = derivative(s + h * k3, u1);
            return s + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
        }
        return dense.matrix * s + (dense.before * u0 + dense.after * u1);
    }

    void designStep() noexcept
    {
        const double h = 1.0 / fs;
        if (method == BodyIntegrator::trapezoidal)
        {
            const Eigen::PartialPivLU<Matrix> implicit(Matrix::Identity() - 0.5 * h * system.a);
            dense.matrix = implicit.solve(Matrix::Identity() + 0.5 * h * system.a);
            dense.before = dense.after = implicit.solve(0.5 * h * system.b);
        }
        else if (method == BodyIntegrator::matrixExponential)
        {
            // Two more states hold the force and its slope, so that one exponential gives everything (C. Van Loan,
            // "Computing integrals involving the matrix exponential", 1978).
            using Extended = Eigen::Matrix<double, 8, 8>;
            Extended m = Extended::Zero();
            m.topLeftCorner<6, 6>() = h * system.a;
            m.block<6, 1>(0, 6) = h * system.b;
            m(6, 7) = 1.0;
            int squarings = 0;
            for (double norm = m.cwiseAbs().rowwise().sum().maxCoeff(); norm > 0.5; norm *= 0.5)
                ++squarings;
            m *= std::ldexp(1.0, -squarings);
            Extended power = Extended::Identity();
            for (int k = 16; k > 0; --k) // 0.5^17 / 17! is far below the last place
                power = Extended::Identity() + (m * power / k).eval();
            for (int i = 0; i < squarings; ++i)
                power = (power * power).eval();
            dense.matrix = power.topLeftCorner<6, 6>();
            dense.after = power.block<6, 1>(0, 7);
            dense.before = power.block<6, 1>(0, 6) - dense.after;
        }
    }

    [[nodiscard]] LinearStep linearStep() const noexcept
    {
        LinearStep step;
        for (Eigen::Index i = 0; i < 6; ++i)
            step.matrix.col(i) = stepped(Vector::Unit(i), 0.0, 0.0);
        step.before = stepped(Vector::Zero(), 1.0, 0.0);
        step.after = stepped(Vector::Zero(), 0.0, 1.0);
        return step;
    }

    BodyIntegrator method;
    BodyChain chain;
    double fs;
    BodyStateSpace system;
    LinearStep dense{Matrix::Zero(), Vector::Zero(), Vector::Zero()};
    Vector x = Vector::Zero();
    double previous = 0.0;
};

} // namespace pacini::cli
