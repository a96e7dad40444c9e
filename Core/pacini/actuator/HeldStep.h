#pragma once

// Resonator under zero-order hold: motion of a mass on a spring under a drive that is constant between samples.

#include <cmath>
#include <numbers>

namespace pacini
{

/// Displacement of the mass from rest and its velocity over the resonance's angular frequency, both in metres.
struct ResonatorState
{
    double displacement = 0.0;
    double velocity = 0.0;

    /// The square of the amplitude at which an undamped mass would ring on from here, m^2. Without drive it never
    /// grows: d/dt (x^2 + v^2) = -2 (w0 / q) v^2.
    [[nodiscard]] double energy() const noexcept { return displacement * displacement + velocity * velocity; }
};

/// One step of x'' + (w0/q) x' + w0^2 x = w0^2 e u, e the static displacement in metres at a drive u of 1.
/// The matrix is stored without its unit part, which would swallow the digits of the small steps of high rates.
struct HeldStep
{
    double xx = 0.0, xv = 0.0, vx = 0.0, vv = 0.0;
    double driveToX = 0.0, driveToV = 0.0;

    /// Returns the state of the resonator after the step without a drive.
    [[nodiscard]] ResonatorState free(const ResonatorState& z) const noexcept
    {
        return {z.displacement + (xx * z.displacement + xv * z.velocity),
                z.velocity + (vx * z.displacement + vv * z.velocity)};
    }

    [[nodiscard]] ResonatorState next(const ResonatorState& z, double drive) const noexcept
    {
        const ResonatorState z0 = free(z);
        return {z0.displacement + driveToX * drive, z0.velocity + driveToV * drive};
    }

    /// This step and another after it under the same drive.
    [[nodiscard]] HeldStep then(const HeldStep& b) const noexcept
    {
        return {xx + b.xx + b.xx * xx + b.xv * vx,
                xv + b.xv + b.xx * xv + b.xv * vv,
                vx + b.vx + b.vx * xx + b.vv * vx,
                vv + b.vv + b.vx * xv + b.vv * vv,
                driveToX + b.driveToX + b.xx * driveToX + b.xv * driveToV,
                driveToV + b.driveToV + b.vx * driveToX + b.vv * driveToV};
    }
};

/// The exact step of `duration` s of a resonator of `frequency` Hz and quality `q`, `excursion` m at a drive of 1, by
/// the power series of the matrix exponential with scaling and doubling (C. Moler and C. Van Loan, "Nineteen dubious
/// ways to compute the exponential of a matrix", SIAM Review 1978, method 3). Exact for the drive of a converter that
/// holds its samples, where the bilinear transform would bend the resonance; one form for any damping.
[[nodiscard]] inline HeldStep designHeldStep(double frequency, double q, double excursion, double duration) noexcept
{
    double angle = 2.0 * std::numbers::pi * frequency * duration;
    int doublings = 0;
    for (; angle * (1.0 + 1.0 / q) > 0.5; ++doublings)
        angle *= 0.5;

    // p: powers of M = angle [0 1; -1 -1/q] over the factorial, each from the one before as p M / k
    double pxx = 1.0;
    double pxv = 0.0;
    double pvx = 0.0;
    double pvv = 1.0;
    HeldStep step;
    for (int k = 1; k <= 16; ++k)
    {
        const double scale = angle / k;
        const double x = pxx;
        const double v = pvx;
        pxx = -scale * pxv;
        pvx = -scale * pvv;
        pxv = scale * (x - pxv / q);
        pvv = scale * (v - pvv / q);
        step.xx += pxx;
        step.xv += pxv;
        step.vx += pvx;
        step.vv += pvv;
    }
    // A constant drive moves the point of rest; the distance from there decays freely.
    step.driveToX = -step.xx * excursion;
    step.driveToV = -step.vx * excursion;
    for (; doublings > 0; --doublings)
        step = step.then(step);
    return step;
}

} // namespace pacini
