#pragma once

// Dense curves that the simplifier tests share.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pacini::test
{

/// Evenly spaced curve of `values`, `step` seconds apart.
inline Curve curveOfValues(const std::vector<double>& values, double step = 1e-3)
{
    Curve curve;
    for (std::size_t i = 0; i < values.size(); ++i)
        curve.push_back({static_cast<double>(i) * step, values[i]});
    return curve;
}

inline std::vector<double> valuesOf(const Curve& curve)
{
    std::vector<double> values;
    for (const Breakpoint& p : curve)
        values.push_back(p.value);
    return values;
}

inline std::vector<double> uniformNoise(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> x(n);
    for (double& v : x)
        v = random.uniform(0.0, 1.0);
    return x;
}

/// Like the envelope of struck sounds: attacks of 5-20 samples every few hundred, exponential decays, and a ripple.
inline std::vector<double> strikes(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> x(n);
    double level = 0.0, target = 0.0, ripple = 0.0, decay = 0.99;
    std::size_t next = 10;
    for (std::size_t i = 0; i < n; ++i)
    {
        if (i == next)
        {
            target = random.uniform(0.2, 1.0);
            decay = random.uniform(0.97, 0.997);
            next += 60 + static_cast<std::size_t>(random.uniform(0.0, 500.0));
        }
        level = target > level ? level + 0.15 : level * decay;
        if (level >= target)
            target = 0.0;
        ripple += 0.2 * (random.uniform(-1.0, 1.0) - ripple);
        x[i] = level * (1.0 + 0.2 * ripple);
    }
    return x;
}

/// Irregular times, some of them twice or more (steps), values at random.
inline Curve irregular(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    Curve curve;
    double time = random.uniform(0.0, 1.0);
    for (std::size_t i = 0; i < n; ++i)
    {
        curve.push_back({time, random.uniform(-1.0, 1.0)});
        if (random.uniform() > 0.2)
            time += random.uniform(1e-4, 0.3);
    }
    return curve;
}

/// The curves that properties are checked on, with names.
inline std::vector<std::pair<std::string, Curve>> testCurves(std::size_t n)
{
    std::vector<std::pair<std::string, Curve>> curves;
    curves.emplace_back("noise", curveOfValues(uniformNoise(n, 1)));
    curves.emplace_back("strikes", curveOfValues(strikes(n, 2)));
    curves.emplace_back("irregular", irregular(n, 3));
    curves.emplace_back("constant", curveOfValues(std::vector<double>(n, 0.25)));
    std::vector<double> sine(n), gated(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        sine[i] = 300.0 + 200.0 * std::sin(0.05 * static_cast<double>(i));
    curves.emplace_back("sine", curveOfValues(sine));
    for (std::size_t i = n / 3; i < 2 * n / 3; ++i)
        gated[i] = sine[i] / 500.0;
    curves.emplace_back("gated", curveOfValues(gated));
    std::vector<double> zigzag(n);
    for (std::size_t i = 0; i < n; ++i)
        zigzag[i] = static_cast<double>(i % 2);
    curves.emplace_back("zigzag", curveOfValues(zigzag));
    return curves;
}

/// Every choice of inner points of a curve of n points, as bit sets over the inner points.
template <typename Use>
void forEachChoice(std::size_t n, Use use)
{
    for (std::uint32_t bits = 0; bits < (1u << (n - 2)); ++bits)
    {
        std::vector<std::size_t> kept{0};
        for (std::size_t i = 1; i + 1 < n; ++i)
            if (bits & (1u << (i - 1)))
                kept.push_back(i);
        kept.push_back(n - 1);
        use(kept);
    }
}

} // namespace pacini::test
