#pragma once

// Second-order section in extended precision: the reference for the rounding errors of its other forms.

#include <pacini/filters/Biquad.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace pacini::cli
{

/// A cookbook section (parameters inside their limits, q not 0.5, nor q A = 0.5 for a peak) as the sum of its two
/// poles, each a recursion of its own, in long double. With 64 bits of mantissa it is right to -320 dB for poles at
/// 1e-5 of the sample rate, and nothing in it is a state-variable or a direct form.
class ExactSection
{
public:
    using Number = long double;

    ExactSection(const BiquadParams& params, double fs)
    {
        const Number q = params.q;
        const Number a = std::pow(Number(10), Number(params.gain.value) / 40);
        const Number g = std::tan(std::numbers::pi_v<Number> * Number(params.frequency.value) / Number(fs));
        const Number root = std::sqrt(a);
        switch (params.type)
        {
        case BiquadType::lowpass:
            design(g, 1 / q, 0, 0, 1);
            break;
        case BiquadType::highpass:
            design(g, 1 / q, 1, 0, 0);
            break;
        case BiquadType::bandpass:
            design(g, 1 / q, 0, 1 / q, 0);
            break;
        case BiquadType::notch:
            design(g, 1 / q, 1, 0, 1);
            break;
        case BiquadType::allpass:
            design(g, 1 / q, 1, -1 / q, 1);
            break;
        case BiquadType::peak:
            design(g, 1 / (q * a), 1, a / q, 1);
            break;
        case BiquadType::lowShelf:
            design(g / root, 1 / q, 1, a / q, a * a);
            break;
        case BiquadType::highShelf:
            design(g * root, 1 / q, a * a, a / q, 1);
            break;
        }
    }

    [[nodiscard]] Number tick(Number x) noexcept
    {
        y1 = {pole1.real() * y1.real() - pole1.imag() * y1.imag() + x,
              pole1.real() * y1.imag() + pole1.imag() * y1.real()};
        if (conjugate)
            return direct * x + 2 * (residue1.real() * y1.real() - residue1.imag() * y1.imag());
        y2 = pole2 * y2 + x;
        return direct * x + residue1.real() * y1.real() + residue2 * y2;
    }

private:
    using Complex = std::complex<Number>;

    /// (n2 s^2 + n1 s + n0) / (s^2 + k s + 1), s = (z - 1) / (z + 1) / g
    void design(Number g, Number k, Number n2, Number n1, Number n0)
    {
        const Complex root = std::sqrt(Complex(k * k / 4 - 1));
        conjugate = root.imag() != 0;
        const Complex second = -k / 2 - root;
        const Complex first = conjugate ? std::conj(second) : Number(1) / second; // real poles: their product is 1
        direct = n2;
        const auto mode = [&](Complex s, Complex other, Complex& pole, Complex& residue)
        {
            // n2 + sum r / (s - p), and 1 / (s - p) = g (1 + v) / (1 - g p) / (1 - pole v), v = z^-1
            const Complex r = ((n1 - n2 * k) * s + (n0 - n2)) / (s - other);
            pole = (Number(1) + g * s) / (Number(1) - g * s);
            const Complex scaled = g * r / (Number(1) - g * s);
            residue = scaled * (Number(1) + Number(1) / pole);
            direct -= (scaled / pole).real();
        };
        Complex real, residueOfReal;
        mode(first, second, pole1, residue1);
        mode(second, first, real, residueOfReal);
        pole2 = real.real();
        residue2 = residueOfReal.real();
    }

    bool conjugate = false;
    Complex pole1, residue1, y1;
    Number pole2 = 0, residue2 = 0, y2 = 0, direct = 0;
};

} // namespace pacini::cli
